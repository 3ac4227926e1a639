//! One-shot codes: G4, G27 .. G30, G31, G53 and the dispatch of the others.

use super::Machine;
use super::block::Block;
use super::kernel::Io;
use super::table::Meaning;
use crate::canon::{Canon, Position, Probe};
use crate::ngc::execute::Done;
use crate::ngc::modal::scaled;
use crate::ngc::motion::{check_feed, checked};
use crate::ngc::request::{AXES, missing, not_now};
use takt_base::{Code, Diag, Span};

/// Parameters of the first and second reference point.
const REFERENCE_FIRST: [u16; 2] = [5161, 5181];
/// Parameters of the skip position, and the one that says whether the probe tripped.
const SKIPPED: u16 = 5061;
const TRIPPED: u16 = 5070;

impl Machine {
    pub(super) fn one_shot(&mut self, b: &Block, io: &mut Io) -> Done {
        for code in &b.codes {
            match code.meaning {
                Meaning::Dwell => self.dwell(b, code.span, io)?,
                Meaning::Data => self.data(b, code.span, io)?,
                Meaning::ReferenceCheck => self.reference_check(b, code.span, io)?,
                Meaning::Reference => self.reference(b, 0, code.span, io)?,
                Meaning::OtherReference => self.other_reference(b, code.span, io)?,
                Meaning::FromReference => self.leave_reference(b, code.span, io)?,
                Meaning::Skip => self.skip(b, code.span, io)?,
                Meaning::Coordinates => self.coordinates(b, code.span, io)?,
                Meaning::CoordinatesReset => self.coordinates_reset(code.span, b, io)?,
                Meaning::Local => self.local(b, code.span, io)?,
                Meaning::Machine => self.machine(b, code.span, io)?,
                // Words of codes without effect.
                Meaning::Nothing(_) => b.use_all("PQRIJKXYZ"),
                _ => {}
            }
        }
        Ok(())
    }

    /// X and U in seconds, P in milliseconds.
    fn dwell(&mut self, b: &Block, at: Span, io: &mut Io) -> Done {
        let seconds = match (b.take(b'X').or_else(|| b.take(b'U')), b.take(b'P')) {
            (Some(word), _) if !word.exact && !self.modes.settings.calculator => word.value / 1000.0,
            (Some(word), _) => word.value,
            (None, Some(word)) => word.value / 1000.0,
            (None, None) => {
                return Err(Box::new(missing(at, "X or P").help("write the time: G4 X0.5 in seconds, G4 P500 in ms")));
            }
        };
        if seconds < 0.0 {
            return Err(Box::new(Diag::new(Code::BadValue, at, "a time below zero").help("write zero or more")));
        }
        if seconds > 0.0 {
            io.emit(Canon::Dwell(seconds));
        }
        Ok(())
    }

    /// Axes that the block names, as words or increments.
    fn named(&self, b: &Block) -> [bool; 6] {
        std::array::from_fn(|i| {
            let increment = ["U", "V", "W", "", "", "H"][i];
            b.any(&AXES[i].to_string()) || (self.modes.turn() && !increment.is_empty() && b.any(increment))
        })
    }

    fn rapid_to(&mut self, to: Position, at: Span, io: &mut Io) -> Done {
        self.modes.at = to;
        io.straight(self.modes.transform.apply(to), true, at)
    }

    /// Machine position of a reference point in work coordinates, axes that are named alone.
    fn reference_point(&self, which: usize, named: [bool; 6], io: &Io) -> Position {
        let modal = &io.state.modal;
        let home = scaled(modal.offsets.program(io.state.stored(REFERENCE_FIRST[which])), 1.0 / io.state.unit());
        let (mut end, home): ([f64; 6], [f64; 6]) = (modal.position.into(), home.into());
        for i in 0..6 {
            if named[i] {
                end[i] = home[i];
            }
        }
        end.into()
    }

    fn reference(&mut self, b: &Block, which: usize, at: Span, io: &mut Io) -> Done {
        self.free(at, "a reference point", io)?;
        let named = self.named(b);
        if !named.contains(&true) {
            return Err(Box::new(
                missing(at, "an axis word").help("write the axes that go there, such as G91 G28 Z0 or G28 U0 W0"),
            ));
        }
        let middle = self.target(b, io)?;
        self.rapid_to(middle, at, io)?;
        self.modes.middle = Some(io.state.modal.machine(io.state.modal.position));
        let end = self.reference_point(which, named, io);
        io.straight(end, true, at)?;
        self.sync(io);
        Ok(())
    }

    fn other_reference(&mut self, b: &Block, at: Span, io: &mut Io) -> Done {
        match Self::whole_word(b, b'P', "write P2")? {
            None | Some(2) => self.reference(b, 1, at, io),
            Some(_) => {
                let diag = Diag::new(Code::NotOfThisControl, at, "a third or fourth reference point");
                Err(Box::new(diag.help("go there with G53: G53 X.. Y.. Z..")))
            }
        }
    }

    fn reference_check(&mut self, b: &Block, at: Span, io: &mut Io) -> Done {
        self.free(at, "a reference point", io)?;
        let named = self.named(b);
        let to = self.target(b, io)?;
        self.rapid_to(to, at, io)?;
        let (want, is): ([f64; 6], [f64; 6]) = (self.reference_point(0, named, io).into(), io.state.modal.position.into());
        match (0..6).find(|&i| (want[i] - is[i]).abs() * io.state.unit() > 1e-3) {
            None => Ok(()),
            Some(i) => {
                let label = format!("{} is not at its reference point", AXES[i]);
                Err(Box::new(Diag::new(Code::BadValue, at, label).help("check the position, or go there with G28")))
            }
        }
    }

    /// G29: over the intermediate point of the last G28 to the target.
    fn leave_reference(&mut self, b: &Block, at: Span, io: &mut Io) -> Done {
        self.free(at, "a reference point", io)?;
        let Some(middle) = self.modes.middle else {
            return Err(Box::new(not_now(at, "G29 without G28", "write G28 first, or G0")));
        };
        let end = self.target(b, io)?;
        let middle = scaled(io.state.modal.offsets.program(middle), 1.0 / io.state.unit());
        io.straight(middle, true, at)?;
        self.rapid_to(end, at, io)
    }

    /// G31: a feed move that ends where the signal comes. Where that is, nobody knows while the program is read ahead: its end stands for it.
    fn skip(&mut self, b: &Block, at: Span, io: &mut Io) -> Done {
        self.free(at, "a skip move", io)?;
        b.use_all("P");
        if !self.named(b).contains(&true) {
            return Err(Box::new(missing(at, "an axis word").help("write where the move ends, such as G31 Z-10 F100")));
        }
        self.say_feed_mode(io);
        let to = self.target(b, io)?;
        let end = self.modes.transform.apply(to);
        let mut run = io.run();
        check_feed(&mut run, crate::ngc::modal::Motion::Linear)?;
        run.emit(Canon::TurnProbeOn);
        checked(&mut run, Canon::StraightProbe(end, Probe { towards: true, must_trip: false }), at);
        run.emit(Canon::TurnProbeOff);
        run.state.outside.awaits = Some(crate::ngc::outside::Awaits::Probe);
        run.modal().position = end;
        let values: [f64; 6] = end.into();
        for (i, value) in values.into_iter().enumerate() {
            io.state.params.set(SKIPPED + i as u16, value);
        }
        io.state.params.set(TRIPPED, 1.0);
        (self.modes.at, self.skipped) = (to, true);
        Ok(())
    }

    /// G53: the axis words are machine coordinates, at traverse.
    fn machine(&mut self, b: &Block, at: Span, io: &mut Io) -> Done {
        self.free(at, "G53", io)?;
        if self.modes.incremental || (self.modes.turn() && b.any("UVWH")) {
            return Err(Box::new(not_now(at, "G53 with increments", "write G90, and X, Y, Z")));
        }
        let (unit, modal) = (io.state.unit(), &io.state.modal);
        let mut machine: [f64; 6] = scaled(modal.machine(modal.position), 1.0 / unit).into();
        for (i, letter) in AXES.into_iter().enumerate() {
            if let Some(word) = b.take(letter as u8) {
                machine[i] = self.along(i, word);
            }
        }
        let end = scaled(modal.offsets.program(scaled(machine.into(), unit)), 1.0 / unit);
        io.straight(end, true, at)?;
        self.sync(io);
        Ok(())
    }
}
