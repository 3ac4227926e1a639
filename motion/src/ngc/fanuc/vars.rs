//! Variables of macro B: #0 vacant, #1 to #33 of the macro that runs, #100 to #199 and #500 to #999 common, from #1000 on the system's.
//! Runs: background. From: R1-43, book table 2.2; the numbers are those that programs of Fanuc-style controls use.

use super::modes::Modes;
use crate::canon::Position;
use crate::ngc::modal::mm_per_unit;
use crate::ngc::state::{State, WORK_FIRST};
use takt_base::Code;

/// Variables of one macro.
pub type Locals = [Option<f64>; LOCALS];
/// `#1` to this belong to the macro that runs.
pub const LOCALS: usize = 33;
/// What [`number`] takes.
pub const NUMBERS: &str = "variables are #1 to #33, #100 to #199, #500 to #999, and the system's from #1000 on";

type Why = (Code, String, &'static str);

/// The number of a variable: whole and not negative.
pub fn number(value: f64) -> Option<u32> {
    let near = value.round();
    ((value - near).abs() <= 1e-4 && (0.0..=999_999.0).contains(&near)).then_some(near as u32)
}

/// All variables that a program can set.
#[derive(Clone, Debug)]
pub struct Vars {
    /// Of each macro in progress; the main program's first. Never empty.
    pub locals: Vec<Locals>,
    common: Vec<Option<f64>>,
}

impl Vars {
    /// Vacant ones, and those of the parameter file.
    pub fn new(state: &State) -> Self {
        let mut vars = Vars { locals: vec![[None; LOCALS]], common: vec![None; 1000] };
        for &(index, value) in state.options.parameters.iter() {
            if is_common(u32::from(index)) {
                vars.common[usize::from(index)] = Some(value);
            }
        }
        vars
    }

    fn local(&self, n: u32) -> Option<f64> {
        self.locals.last().and_then(|l| l[n as usize - 1])
    }

    /// Sets a local or common variable; false if it is neither.
    pub fn set(&mut self, n: u32, value: Option<f64>) -> bool {
        match n {
            1..=33 => {
                if let Some(locals) = self.locals.last_mut() {
                    locals[n as usize - 1] = value;
                }
            }
            _ if is_common(n) => self.common[n as usize] = value,
            _ => return false,
        }
        true
    }
}

fn is_common(n: u32) -> bool {
    matches!(n, 100..=199 | 500..=999)
}

/// What expressions can see.
#[derive(Clone, Copy)]
pub struct View<'a> {
    /// Variables.
    pub vars: &'a Vars,
    /// Modes of this dialect.
    pub modes: &'a Modes,
    /// The kernel's state.
    pub state: &'a State,
}

impl View<'_> {
    /// G20 is in force.
    pub fn inches(&self) -> bool {
        self.state.modal.units == crate::canon::Units::Inches
    }

    /// A coordinate as the program writes it: from mm, X of turning as a diameter.
    fn shown(&self, axis: usize, mm: f64) -> f64 {
        match axis {
            0 if self.modes.diameter() => mm * 2.0 / mm_per_unit(self.state.modal.units),
            0..=2 => mm / mm_per_unit(self.state.modal.units),
            _ => mm,
        }
    }

    fn axis_of(&self, p: Position, axis: u32) -> Option<f64> {
        let all: [f64; 6] = p.into();
        Some(self.shown(axis as usize, *all.get(axis as usize)?))
    }

    /// Value of a variable; `None` if it is vacant.
    ///
    /// # Errors
    /// There is none, or it can't be read.
    pub fn get(&self, n: u32) -> Result<Option<f64>, Why> {
        match n {
            0 => Ok(None),
            1..=33 => Ok(self.vars.local(n)),
            _ if is_common(n) => Ok(self.vars.common[n as usize]),
            1000..=1035 => self.outside(n - 1000, "ui"),
            1100..=1135 => self.outside(n - 1100, "uo"),
            3001 | 3002 | 3011 | 3012 => {
                let help = "the program is read ahead of the motion, so it has no clock: wait with G4";
                Err((Code::BadVariable, "a clock".to_owned(), help))
            }
            _ => match self.system(n) {
                Some(value) => Ok(Some(value)),
                None => Err((Code::BadVariable, format!("no variable #{n}"), NUMBERS)),
            },
        }
    }

    /// Inputs and outputs: variables of the PLC program.
    fn outside(&self, i: u32, kind: &str) -> Result<Option<f64>, Why> {
        let name = format!("_plc_{kind}{i}");
        match self.state.options.host.value(&name) {
            Some(value) => Ok(Some(value)),
            None => {
                Err((Code::BadVariable, format!("the PLC program offers no {name}"), "it has to offer a variable of this name"))
            }
        }
    }

    fn system(&self, n: u32) -> Option<f64> {
        let modal = &self.state.modal;
        let unit = mm_per_unit(modal.units);
        Some(match n {
            2001..=2964 => self.offset(n)?,
            10001..=13999 => self.memory_c(n)?,
            3003..=3008 => 0.0,
            4001..=4023 => f64::from(*self.modes.codes.get(n as usize - 4000)?) / 10.0,
            4102 | 4107 | 4108 | 4109 | 4111 | 4113 | 4114 | 4115 | 4119 | 4120 | 4130 => self.word(n),
            5001..=5006 => self.axis_of(in_mm(self.modes.at, unit), n - 5001)?,
            5021..=5026 => self.axis_of(modal.machine(modal.position), n - 5021)?,
            5041..=5046 => self.axis_of(in_mm(modal.position, unit), n - 5041)?,
            5061..=5066 => {
                let value = self.state.params.get(n as u16);
                if n == 5061 && self.modes.diameter() { value * 2.0 } else { value }
            }
            5081..=5086 => self.axis_of(modal.offsets.tool, n - 5081)?,
            5201..=5206 => self.axis_of(self.modes.external, n - 5201)?,
            5221..=5326 => {
                let (i, axis) = ((n - 5221) / 20, (n - 5221) % 20);
                self.axis_of(self.state.stored(WORK_FIRST + 20 * i as u16), axis)?
            }
            7001..=7946 => {
                let p = self.modes.more.get((n as usize - 7001) / 20).copied().unwrap_or_default();
                self.axis_of(p, (n - 7001) % 20)?
            }
            14001..=19986 => {
                let p = self.modes.more.get((n as usize - 14001) / 20).copied().unwrap_or_default();
                self.axis_of(p, (n - 14001) % 20)?
            }
            _ => return None,
        })
    }

    fn word(&self, n: u32) -> f64 {
        let last = |letter: u8| self.modes.last[usize::from(letter - b'A')];
        match n {
            4102 => last(b'B'),
            4107 => f64::from(self.modes.d),
            4108 => last(b'E'),
            4109 => self.state.modal.feed.unwrap_or(0.0),
            4111 => f64::from(self.modes.h),
            4113 => last(b'M'),
            4114 => f64::from(self.modes.n),
            4115 => f64::from(self.modes.program),
            4119 => self.state.modal.speed,
            4120 => last(b'T'),
            _ => (self.modes.work as f64 - 5.0).max(0.0),
        }
    }

    /// #2001 ..: of turning X, Z, R wear and tip, then geometry; of milling lengths.
    fn offset(&self, n: u32) -> Option<f64> {
        let (bank, i) = ((n - 2001) / 100, (n - 2001) % 100 + 1);
        let entry = self.state.tools.find(i).unwrap_or_default();
        let wear = self.modes.wear_of(i);
        if !self.modes.turn() {
            return match bank {
                0 | 1 => Some(self.shown(2, if bank == 0 { wear.z } else { 0.0 })),
                _ => Some(self.shown(2, if bank == 2 { entry.offset[2] } else { 0.0 })),
            };
        }
        Some(match bank {
            0 => self.shown(0, wear.x),
            1 => self.shown(2, wear.z),
            2 => self.shown(2, wear.radius),
            3 => f64::from(entry.orientation),
            7 => self.shown(0, entry.offset[0]),
            8 => self.shown(2, entry.offset[2]),
            9 => self.shown(2, entry.diameter / 2.0),
            _ => return None,
        })
    }

    /// #10001 ..: length wear, length, radius wear, radius.
    fn memory_c(&self, n: u32) -> Option<f64> {
        let i = n % 1000;
        let (entry, wear) = (self.state.tools.find(i).unwrap_or_default(), self.modes.wear_of(i));
        Some(self.shown(
            2,
            match n / 1000 {
                10 => wear.z,
                11 => entry.offset[2],
                12 => wear.radius,
                13 => entry.diameter / 2.0,
                _ => return None,
            },
        ))
    }
}

fn in_mm(p: Position, unit: f64) -> Position {
    crate::ngc::modal::scaled(p, unit)
}
