//! Commands of the function blocks to an axis, and what became of them.
//! Runs: cyclic. A command is known by its number; the axis remembers the ends of the last ones for blocks that ask late.
//! From: PLCopen part 1 §2.2 (R1, R6, R9), acceptance matrix, MC_Power, MC_Stop.

use super::generator::Generator;
use super::{Axis, AxisEvent, AxisState};
use takt_base::Code;

/// Number of a command; unique per axis or channel.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct CommandId(pub u32);

impl CommandId {
    /// No command.
    pub const NONE: CommandId = CommandId(0);
}

/// What became of a command.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Outcome {
    /// It has the axis.
    Running,
    /// Its goal is reached.
    Done,
    /// Another command or the loss of power ended it.
    Aborted,
    /// An error ended it.
    Error(Code),
}

/// Ends remembered: more than can wait on one axis.
const REMEMBERED: usize = 64;

/// Numbers commands and remembers how they ended.
#[derive(Clone, Debug)]
pub struct History {
    last: u32,
    ends: [(CommandId, Outcome); REMEMBERED],
    next: usize,
}

impl Default for History {
    fn default() -> Self {
        Self { last: 0, ends: [(CommandId::NONE, Outcome::Aborted); REMEMBERED], next: 0 }
    }
}

impl History {
    /// A new number.
    pub fn number(&mut self) -> CommandId {
        self.last = self.last.wrapping_add(1).max(1);
        CommandId(self.last)
    }

    /// Notes an end; the first one counts.
    pub fn end(&mut self, id: CommandId, outcome: Outcome) {
        if id != CommandId::NONE && !self.ends.iter().any(|(i, _)| *i == id) {
            self.ends[self.next] = (id, outcome);
            self.next = (self.next + 1) % REMEMBERED;
        }
    }

    /// What became of `id`, when `current` is the command at work. A forgotten one was aborted.
    pub fn outcome(&self, id: CommandId, current: CommandId) -> Outcome {
        let end = self.ends.iter().find(|(i, _)| *i == id && id != CommandId::NONE);
        end.map_or(if id == current { Outcome::Running } else { Outcome::Aborted }, |(_, o)| *o)
    }
}

impl Axis {
    /// What became of a command.
    pub fn outcome(&self, id: CommandId) -> Outcome {
        if self.queue.contains(id) { Outcome::Running } else { self.history.outcome(id, self.command) }
    }

    pub(super) fn end_command(&mut self, outcome: Outcome) {
        self.history.end(self.command, outcome);
    }

    /// Ends the command at work and all that wait behind it.
    pub(super) fn end_all(&mut self, outcome: Outcome) {
        self.end_command(outcome);
        while let Some(waiting) = self.queue.pop() {
            self.history.end(waiting.id, outcome);
        }
    }

    /// Gives the axis to a new command; everything before it is aborted.
    pub(super) fn take(&mut self, event: AxisEvent) -> Result<CommandId, Code> {
        if self.joined && event != AxisEvent::Stop {
            return Err(Code::AxisGrouped);
        }
        if self.state == AxisState::Disabled {
            return Err(Code::NotPowered);
        }
        if !self.power.enable || !self.event(event) {
            return Err(Code::WrongState);
        }
        self.end_all(Outcome::Aborted);
        self.command = self.history.number();
        Ok(self.command)
    }

    /// True if command `id` moves the axis now (R8).
    pub fn is_active(&self, id: CommandId) -> bool {
        id == self.command && self.outcome(id) == Outcome::Running
    }

    /// True if command `id` moves the axis at its velocity (R10).
    pub fn is_in_velocity(&self, id: CommandId) -> bool {
        self.is_active(id) && self.generator.as_ref().is_some_and(Generator::is_in_velocity)
    }

    /// MC_Stop. A channel that has the axis stops on its path first.
    pub fn stop(&mut self, d: f64) -> Result<CommandId, Code> {
        let m = self.dynamics(0.0, 0.0, d)?;
        let id = self.take(AxisEvent::Stop)?;
        self.stop_held = true;
        if !self.joined {
            self.brake(m.d);
        }
        Ok(id)
    }

    /// Execute of the MC_Stop that has the axis: while it is TRUE the axis stays in Stopping (A15).
    pub fn hold_stop(&mut self, id: CommandId, execute: bool) {
        if id == self.command && self.state == AxisState::Stopping {
            self.stop_held = execute;
            if self.outcome(id) == Outcome::Done {
                self.release_stop();
            }
        }
    }

    /// MC_Reset: leaves ErrorStop if what caused it is gone.
    pub fn reset(&mut self) -> Result<(), Code> {
        if self.state == AxisState::ErrorStop {
            if self.stage.has_fault() {
                return Err(Code::DriveFault);
            }
            if self.is_moving() || self.joined {
                return Err(Code::WrongState);
            }
            self.error = None;
            self.rest_at_actual();
        }
        let on = self.stage.is_on() && self.power.enable;
        self.event(if on { AxisEvent::ResetOn } else { AxisEvent::ResetOff });
        Ok(())
    }

    /// MC_Power: `owner` is the instance. One instance per axis.
    pub fn set_power(&mut self, owner: u32, enable: bool, positive: bool, negative: bool) -> bool {
        if self.power.owner != 0 && self.power.owner != owner {
            return false;
        }
        let enable = enable && !self.locked;
        let off = self.power.enable && !enable;
        self.power = super::PowerRequest { owner, enable, positive, negative };
        if off && self.state != AxisState::ErrorStop {
            self.end_all(Outcome::Aborted);
            self.stop_held = false;
            if !self.joined {
                self.brake(self.config.a_max_mm_s2);
            }
            if self.is_moving() || self.joined {
                self.event(AxisEvent::PowerBrake);
            } else {
                self.event(AxisEvent::PowerOff);
            }
        }
        true
    }
}
