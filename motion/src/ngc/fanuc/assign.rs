//! `#5 = ..`: what a setting does, to variables and to the system (offsets, alarms, stops).

use super::kernel::Io;
use super::reader::{Row, Setting};
use super::vars::{self, NUMBERS};
use super::{Machine, Went};
use crate::canon::{Canon, Position};
use crate::ngc::fault::Fault;
use crate::ngc::state::WORK_FIRST;
use takt_base::Code;

impl Machine {
    /// All settings of a row.
    pub(super) fn settings(&mut self, row: &Row, io: &mut Io) -> Went {
        let mut went = Went::On;
        for setting in &row.settings {
            match self.set(setting, row, io) {
                Ok(Went::On) => {}
                Ok(other) => went = other,
                Err(fault) => {
                    io.wrong(fault.diag(self.flow.source()));
                    return went;
                }
            }
        }
        went
    }

    fn set(&mut self, setting: &Setting, row: &Row, io: &mut Io) -> Result<Went, Fault> {
        let (start, end) = setting.place;
        let target = self.value(setting.target, row, io)?;
        let Some(n) = target.and_then(vars::number) else {
            return Err(Fault::at(Code::BadVariable, start, end, "no number of a variable", NUMBERS));
        };
        let value = self.value(setting.value, row, io)?;
        if self.vars.set(n, value) {
            if (500..=999).contains(&n) {
                io.state.params.set(n as u16, value.unwrap_or(0.0));
            }
            return Ok(Went::On);
        }
        self.set_system(n, value.unwrap_or(0.0), setting.place, io)
    }

    fn set_system(&mut self, n: u32, value: f64, place: (u32, u32), io: &mut Io) -> Result<Went, Fault> {
        match n {
            3000 => return Err(self.alarm(value, place)),
            3001..=3003 | 3005 | 3007 | 3008 => {}
            3004 => {
                let bits = value as u32;
                io.emit(if bits & 1 == 0 { Canon::EnableFeedHold } else { Canon::DisableFeedHold });
                io.emit(if bits & 2 == 0 { Canon::EnableFeedOverride } else { Canon::DisableFeedOverride });
            }
            3006 => {
                let text = std::mem::take(&mut self.said);
                io.emit(Canon::Message(text));
                io.emit(Canon::ProgramStop);
            }
            1100..=1135 => {
                if !io.state.options.host.set_value(&format!("_plc_uo{}", n - 1100), value) {
                    let label = format!("the PLC program offers no _plc_uo{}", n - 1100);
                    return Err(Fault::at(Code::BadVariable, place.0, place.1, label, "it has to offer a variable of this name"));
                }
            }
            2001..=2964 | 10001..=13999 => self.set_offset(n, value, io).ok_or_else(|| read_only(n, place))?,
            5201..=5206 => {
                let mm = self.stored(n - 5201, value, io);
                put(&mut self.modes.external, n - 5201, mm);
                self.apply_origin(io);
            }
            5221..=5326 if (n - 5221) % 20 < 6 => {
                let (first, axis) = (WORK_FIRST + 20 * ((n - 5221) / 20) as u16, (n - 5221) % 20);
                let mm = self.stored(axis, value, io);
                let mut p = io.state.stored(first);
                put(&mut p, axis, mm);
                io.state.store(first, p);
                self.apply_origin(io);
            }
            7001..=7946 | 14001..=19986 => {
                let base = if n < 14001 { 7001 } else { 14001 };
                let (i, axis) = ((n - base) / 20, (n - base) % 20);
                let mm = self.stored(axis, value, io);
                if axis > 5 {
                    return Err(read_only(n, place));
                }
                put(self.more_system(i as usize), axis, mm);
                self.apply_origin(io);
            }
            _ => return Err(read_only(n, place)),
        }
        Ok(Went::On)
    }

    fn alarm(&mut self, value: f64, place: (u32, u32)) -> Fault {
        let text = if self.said.is_empty() { "#3000 is set here".to_owned() } else { self.said.trim().to_owned() };
        let help = "the macro program found a state in which it can't go on";
        Fault::at(Code::MacroAlarm, place.0, place.1, format!("alarm {value}"), help).message(text)
    }

    /// A coordinate that the program writes, in mm.
    pub(super) fn stored(&self, axis: u32, value: f64, io: &Io) -> f64 {
        match axis {
            0 if self.modes.diameter() => value / 2.0 * io.state.unit(),
            0..=2 => value * io.state.unit(),
            _ => value,
        }
    }

    /// One of the further work systems; the table grows to it.
    pub(super) fn more_system(&mut self, i: usize) -> &mut Position {
        let i = i.min(super::modes::MORE_SYSTEMS - 1);
        if self.modes.more.len() <= i {
            self.modes.more.resize(i + 1, Position::default());
        }
        &mut self.modes.more[i]
    }

    /// Tool offsets: see `vars`.
    fn set_offset(&mut self, n: u32, value: f64, io: &mut Io) -> Option<()> {
        let mm = value * io.state.unit();
        let (bank, i) = if n > 10000 { (n / 1000, n % 1000) } else { ((n - 2001) / 100, (n - 2001) % 100 + 1) };
        let mut entry = io.state.tools.find(i)?;
        let mut wear = self.modes.wear_of(i);
        let half = if self.modes.diameter() { 0.5 } else { 1.0 };
        match (self.modes.turn(), bank) {
            (true, 0) => wear.x = mm * half,
            (true, 1) | (false, 0 | 10) => wear.z = mm,
            (true, 2) | (_, 12) => wear.radius = mm,
            (true, 3) => entry.orientation = crate::ngc::word::whole(value).filter(|&q| q <= 9)?,
            (true, 7) => entry.offset[0] = mm * half,
            (true, 8) | (false, 2 | 11) => entry.offset[2] = mm,
            (true, 9) | (_, 13) => entry.diameter = 2.0 * mm,
            _ => return None,
        }
        self.modes.wear.insert(i, wear);
        io.state.tools.set(entry);
        io.emit(Canon::SetToolTableEntry(Box::new(entry)));
        Some(())
    }
}

fn put(p: &mut Position, axis: u32, value: f64) {
    let mut all: [f64; 6] = (*p).into();
    if let Some(place) = all.get_mut(axis as usize) {
        *place = value;
    }
    *p = all.into();
}

fn read_only(n: u32, place: (u32, u32)) -> Fault {
    Fault::at(Code::BadVariable, place.0, place.1, format!("#{n} can't be set"), NUMBERS)
}
