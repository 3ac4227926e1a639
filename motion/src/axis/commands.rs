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

/// Ends remembered.
const REMEMBERED: usize = 32;

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
        self.history.outcome(id, self.command)
    }

    pub(super) fn end_command(&mut self, outcome: Outcome) {
        self.history.end(self.command, outcome);
    }

    fn take(&mut self, event: AxisEvent) -> Result<CommandId, Code> {
        if self.joined && event != AxisEvent::Stop {
            return Err(Code::AxisGrouped);
        }
        if self.state == AxisState::Disabled {
            return Err(Code::NotPowered);
        }
        if !self.power.enable || !self.event(event) {
            return Err(Code::WrongState);
        }
        self.end_command(Outcome::Aborted);
        self.command = self.history.number();
        Ok(self.command)
    }

    /// MC_MoveAbsolute: to `target` in mm. Acceleration or deceleration 0: the limit of the axis.
    pub fn move_absolute(&mut self, target: f64, v: f64, a: f64, d: f64) -> Result<CommandId, Code> {
        let m = self.dynamics(v, a, d)?;
        if !target.is_finite() || m.v == 0.0 {
            return Err(Code::ParameterOutOfRange);
        }
        if target < self.config.travel_min_mm || target > self.config.travel_max_mm {
            return Err(Code::LimitExceeded);
        }
        let up = target > self.set.position;
        if target != self.set.position && !(if up { self.power.positive } else { self.power.negative }) {
            return Err(Code::DirectionBlocked);
        }
        let id = self.take(AxisEvent::Move)?;
        self.generator = Some(Generator::to_position(self.set.position, self.set.velocity, target, m));
        Ok(id)
    }

    /// MC_MoveRelative: by `distance` from the set position.
    pub fn move_relative(&mut self, distance: f64, v: f64, a: f64, d: f64) -> Result<CommandId, Code> {
        self.move_absolute(self.set.position + distance, v, a, d)
    }

    /// MC_MoveVelocity: endless, at signed velocity `v`.
    pub fn move_velocity(&mut self, v: f64, a: f64, d: f64) -> Result<CommandId, Code> {
        let m = self.dynamics(v.abs(), a, d)?;
        let allowed = v == 0.0 || if v > 0.0 { self.power.positive } else { self.power.negative };
        if !allowed {
            return Err(Code::DirectionBlocked);
        }
        let id = self.take(AxisEvent::MoveVelocity)?;
        self.generator = Some(Generator::to_velocity(self.set.position, self.set.velocity, v.signum() * m.v, m));
        Ok(id)
    }

    /// True if command `id` moves the axis at its velocity (R10).
    pub fn is_in_velocity(&self, id: CommandId) -> bool {
        self.outcome(id) == Outcome::Running && self.generator.as_ref().is_some_and(Generator::is_in_velocity)
    }

    /// MC_Halt.
    pub fn halt(&mut self, d: f64) -> Result<CommandId, Code> {
        let m = self.dynamics(0.0, 0.0, d)?;
        let id = self.take(AxisEvent::Halt)?;
        self.brake(m.d);
        Ok(id)
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

    /// MC_Home, direct: the position where the axis stands becomes `position`.
    pub fn home(&mut self, position: f64) -> Result<CommandId, Code> {
        if !position.is_finite() {
            return Err(Code::ParameterOutOfRange);
        }
        let id = self.take(AxisEvent::Home)?;
        let by = position - self.set.position;
        self.set.position = position;
        self.actual += by;
        self.shift += by;
        self.homed = true;
        Ok(id)
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
            self.end_command(Outcome::Aborted);
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
