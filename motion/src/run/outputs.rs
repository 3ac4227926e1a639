//! Outputs, inputs and PLC variables: M62 .. M68, `#<_plc_...>`.
//! Runs: background. M62, M63 and M67 act where the next move begins, the others where they stand; none of them stops the path.

use super::{Emit, Item, RunError, RunReader};
use crate::canon::{Canon, Input};
use crate::plc::{READS, Symbols, Variable};
use crate::segment::{Action, Mark};
use crate::sync::Reads;
use takt_base::Code;

/// Digital inputs and outputs of a channel.
pub const DIGITAL: usize = 64;
/// Analog inputs and outputs.
pub const ANALOG: usize = 16;

/// An output that gets a value.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Output {
    /// M62 .. M65.
    Digital(u8, bool),
    /// M67, M68.
    Analog(u8, f64),
}

/// The output of a command, and whether it waits for the next move.
pub(super) fn output(command: &Canon) -> Result<Option<(Output, bool)>, RunError> {
    let digital = |i: u32, on| Ok(Output::Digital(number(i, DIGITAL, "digital output")?, on));
    let analog = |i: u32, value| Ok(Output::Analog(number(i, ANALOG, "analog output")?, value));
    Ok(Some(match *command {
        Canon::SetMotionOutputBit(i) => (digital(i, true)?, true),
        Canon::ClearMotionOutputBit(i) => (digital(i, false)?, true),
        Canon::SetAuxOutputBit(i) => (digital(i, true)?, false),
        Canon::ClearAuxOutputBit(i) => (digital(i, false)?, false),
        Canon::SetMotionOutputValue(i, v) => (analog(i, v)?, true),
        Canon::SetAuxOutputValue(i, v) => (analog(i, v)?, false),
        _ => return Ok(None),
    }))
}

/// M66 with an input that exists.
pub(super) fn checked(input: Input) -> Result<Input, RunError> {
    let (count, what) = if input.analog { (ANALOG, "analog input") } else { (DIGITAL, "digital input") };
    number(input.number, count, what).map(|_| input)
}

fn number(i: u32, count: usize, what: &str) -> Result<u8, RunError> {
    match u8::try_from(i) {
        Ok(n) if usize::from(n) < count => Ok(n),
        _ => Err(RunError { code: Code::NoSuchInput, text: format!("there is no {what} {i}: they go from 0 to {}", count - 1) }),
    }
}

impl RunReader {
    pub(super) fn output(&mut self, mark: Mark, output: Output, with_move: bool, emit: Emit) -> Result<(), RunError> {
        if with_move {
            self.pending.push(output);
            return Ok(());
        }
        self.action(mark, Action::Output(output), emit)
    }

    /// What waited for this move.
    pub(super) fn flush_outputs(&mut self, mark: Mark, emit: Emit) {
        for output in self.pending.drain(..) {
            emit(mark, Item::Action(Action::Output(output)));
        }
    }

    pub(super) fn read_plc(&mut self, mark: Mark, names: &[String], emit: Emit) -> Result<(), RunError> {
        let Some(symbols) = self.symbols.clone() else { return Ok(()) };
        let Some(first) = names.first() else { return Ok(()) };
        let mut reads = Reads { variables: [find(&*symbols, first)?; READS], count: 0 };
        for name in names.iter().take(READS) {
            reads.variables[usize::from(reads.count)] = find(&*symbols, name)?;
            reads.count += 1;
        }
        self.action(mark, Action::Read(reads), emit)
    }

    pub(super) fn set_plc(&mut self, mark: Mark, name: &str, value: f64, emit: Emit) -> Result<(), RunError> {
        let Some(symbols) = self.symbols.clone() else { return Ok(()) };
        let variable = find(&*symbols, name)?;
        if !variable.writable || !variable.fits(value) {
            return Err(RunError { code: Code::PlcValue, text: format!("`{name}` can't take {value}") });
        }
        self.action(mark, Action::Write(variable, value), emit)
    }
}

fn find(symbols: &dyn Symbols, name: &str) -> Result<Variable, RunError> {
    symbols.find(name).map_err(|e| RunError { code: e.code, text: e.label })
}
