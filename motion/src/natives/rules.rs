//! The rules of Execute and Enable, once for all blocks.
//! Runs: cyclic. From: PLCopen part 1 §2.2 (R1..R12) and §2.3 (E1..E4).

use super::{Core, Frame};
use crate::axis::{CommandId, Outcome};
use takt_base::Code;

/// Pins of a block with Execute. A pin that a block does not have is [`ABSENT`].
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs)] // the standard's names
pub struct ExecutePins {
    pub execute: usize,
    pub done: usize,
    pub busy: usize,
    pub active: usize,
    pub aborted: usize,
    pub error: usize,
    pub error_id: usize,
    /// Execute of the call before.
    pub previous: usize,
    /// Number of the command.
    pub command: usize,
    /// Reference latched at the edge (R12).
    pub reference: usize,
}

/// A pin that there is not.
pub const ABSENT: usize = usize::MAX;

/// Builds [`ExecutePins`] from the `P` of a block.
#[macro_export]
#[doc(hidden)]
macro_rules! execute_pins {
    ($p:ident, $active:expr, $aborted:expr) => {
        execute_pins!(@ $p, Done, $active, $aborted)
    };
    (@ $p:ident, $done:ident, $active:expr, $aborted:expr) => {
        $crate::natives::rules::ExecutePins {
            execute: $p::Execute as usize,
            done: $p::$done as usize,
            busy: $p::Busy as usize,
            active: $active,
            aborted: $aborted,
            error: $p::Error as usize,
            error_id: $p::ErrorID as usize,
            previous: $p::Previous as usize,
            command: $p::Command as usize,
            reference: $p::Reference as usize,
        }
    };
    ($p:ident) => {
        execute_pins!($p, $crate::natives::rules::ABSENT, $crate::natives::rules::ABSENT)
    };
    ($p:ident motion) => {
        execute_pins!(@ $p, Done, $p::Active as usize, $p::CommandAborted as usize)
    };
    ($p:ident continuous) => {
        $crate::natives::rules::ExecutePins {
            done: $crate::natives::rules::ABSENT,
            ..execute_pins!(@ $p, InVelocity, $p::Active as usize, $p::CommandAborted as usize)
        }
    };
}

/// Where a command stands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Progress {
    /// Its end, or that it runs.
    pub outcome: Outcome,
    /// It moves the axes now (R8).
    pub active: bool,
}

impl Progress {
    /// Active as long as it runs.
    pub fn of(outcome: Outcome) -> Self {
        Self { outcome, active: outcome == Outcome::Running }
    }
}

/// What a reference leads to: the index of the axis or channel.
pub type Target = Result<usize, Code>;

/// Index of axis number `number`.
pub fn axis(core: &Core, number: u16) -> Target {
    index(number, core.axes.len())
}

/// Index of channel number `number`.
pub fn channel(core: &Core, number: u16) -> Target {
    index(number, core.channels.len())
}

fn index(number: u16, count: usize) -> Target {
    let i = usize::from(number).wrapping_sub(1);
    if i < count { Ok(i) } else { Err(Code::UnknownReference) }
}

/// What a block with Execute does with its target.
pub struct Action {
    /// At the edge: starts the command and returns its number.
    pub start: fn(&mut Core, &mut Frame, usize) -> Result<u32, Code>,
    /// In the calls after it.
    pub poll: fn(&mut Core, usize, u32) -> Progress,
}

/// One call of a block with Execute, for the axis that `pin` refers to. Returns that axis, if there is one.
pub fn execute_axis(core: &mut Core, f: &mut Frame, pins: &ExecutePins, pin: impl Into<usize>, action: &Action) -> Option<usize> {
    let number = f.reference(pin);
    let target = axis(core, number);
    execute(core, f, pins, number, target, action);
    target.ok()
}

/// One call of a block with Execute, for the channel that `pin` refers to. Returns that channel, if there is one.
pub fn execute_channel(
    core: &mut Core,
    f: &mut Frame,
    pins: &ExecutePins,
    pin: impl Into<usize>,
    action: &Action,
) -> Option<usize> {
    let number = f.reference(pin);
    let target = channel(core, number);
    execute(core, f, pins, number, target, action);
    target.ok()
}

/// Poll of a block whose start does everything.
pub fn at_once(_: &mut Core, _: usize, _: u32) -> Progress {
    Progress::of(Outcome::Done)
}

/// Poll of a block that runs a program, a block or a subroutine in a channel.
pub fn run_of_channel(core: &mut Core, channel: usize, command: u32) -> Progress {
    let channel = &core.channels[channel];
    Progress { outcome: channel.outcome(CommandId(command)), active: channel.is_working() }
}

/// `number` is what the reference holds, `target` what it leads to.
fn execute(core: &mut Core, f: &mut Frame, pins: &ExecutePins, number: u16, target: Target, action: &Action) {
    let execute = f.bool(pins.execute);
    let edge = execute && !f.bool(pins.previous);
    f.set_bool(pins.previous, execute);
    if edge {
        pins.clear(f);
        match target.and_then(|t| (action.start)(core, f, t)) {
            Ok(command) => {
                f.set_u32(pins.command, command);
                f.set_u16(pins.reference, number);
                f.set_bool(pins.busy, true);
                // What ends at once is shown with the next call.
                let target = target.unwrap_or_default();
                let waits = (action.poll)(core, target, command);
                f.set_bool(pins.active, waits.active || waits.outcome != Outcome::Running);
            }
            Err(code) => pins.fail(f, code),
        }
    } else if f.bool(pins.busy) {
        if f.u16(pins.reference) != number {
            return pins.fail(f, Code::UnknownReference);
        }
        let Ok(target) = target else { return pins.fail(f, Code::UnknownReference) };
        let progress = (action.poll)(core, target, f.u32(pins.command));
        pins.show(f, progress);
    } else if !execute {
        pins.clear(f);
    }
}

impl ExecutePins {
    fn clear(&self, f: &mut Frame) {
        for pin in [self.done, self.busy, self.active, self.aborted, self.error] {
            f.set_bool(pin, false);
        }
        f.set_u16(self.error_id, 0);
    }

    fn fail(&self, f: &mut Frame, code: Code) {
        self.clear(f);
        f.set_bool(self.error, true);
        f.set_u16(self.error_id, code.error_id());
    }

    fn show(&self, f: &mut Frame, progress: Progress) {
        match progress.outcome {
            Outcome::Running => f.set_bool(self.active, progress.active),
            Outcome::Done => self.end(f, self.done),
            // A block without CommandAborted can't say more than that it failed.
            Outcome::Aborted if self.aborted == ABSENT => self.fail(f, Code::WrongState),
            Outcome::Aborted => self.end(f, self.aborted),
            Outcome::Error(code) => self.fail(f, code),
        }
    }

    fn end(&self, f: &mut Frame, pin: usize) {
        self.clear(f);
        f.set_bool(pin, true);
    }
}

/// Pins of a block with Enable.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs)]
pub struct EnablePins {
    pub enable: usize,
    pub valid: usize,
    pub busy: usize,
    pub error: usize,
    pub error_id: usize,
}

/// Builds [`EnablePins`] from the `P` of a block; `$valid` is Valid or Enabled.
#[macro_export]
#[doc(hidden)]
macro_rules! enable_pins {
    ($p:ident, $valid:ident) => {
        $crate::natives::rules::EnablePins {
            enable: $p::Enable as usize,
            valid: $p::$valid as usize,
            busy: $p::Busy as usize,
            error: $p::Error as usize,
            error_id: $p::ErrorID as usize,
        }
    };
}

/// One call of a block with Enable: shows `result`, or nothing without Enable (E1, E2). A wrong reference is not recoverable (E4):
/// Busy falls. Anything else is (E3). True if the outputs are valid.
pub fn enable(f: &mut Frame, pins: &EnablePins, result: Result<(), Code>) -> bool {
    let on = f.bool(pins.enable);
    let error = result.err().filter(|_| on);
    let valid = on && error.is_none();
    f.set_bool(pins.valid, valid);
    f.set_bool(pins.busy, on && error != Some(Code::UnknownReference));
    f.set_bool(pins.error, error.is_some());
    f.set_u16(pins.error_id, error.map_or(0, Code::error_id));
    valid
}

/// [`enable`] of a block that reads: what it reads from, if its outputs are valid.
pub fn read(f: &mut Frame, pins: &EnablePins, target: Target) -> Option<usize> {
    let valid = enable(f, pins, target.map(drop));
    target.ok().filter(|_| valid)
}
