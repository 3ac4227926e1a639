//! Motion commands that may wait for the one before them.
//! Runs: cyclic. From: PLCopen part 1 §2.5 (mcAborting, mcBuffered), scenarios S02, S24.

use super::generator::{Dynamics, Generator};
use super::{Axis, AxisEvent, AxisState, CommandId, Outcome};
use takt_base::Code;

/// Dynamics as a block gives them: mm/s, mm/s2; acceleration and deceleration 0: the limit of the axis.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Wanted {
    /// Highest speed.
    pub v: f64,
    /// Acceleration.
    pub a: f64,
    /// Deceleration.
    pub d: f64,
}

/// A motion command.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Order {
    /// MC_MoveAbsolute: to a position in mm.
    Absolute(f64, Wanted),
    /// MC_MoveRelative: by a distance from the set position.
    Relative(f64, Wanted),
    /// MC_MoveVelocity: endless, signed speed.
    Velocity(f64, Wanted),
    /// MC_Halt.
    Halt(Wanted),
    /// MC_Home, direct: the position where the axis stands gets this coordinate.
    Home(f64),
}

/// A command that waits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Waiting {
    pub id: CommandId,
    pub order: Order,
}

/// Commands that may wait on one axis.
const DEPTH: usize = 32;

/// Commands in the order given.
#[derive(Clone, Debug)]
pub(super) struct Queue {
    waiting: [Option<Waiting>; DEPTH],
    first: usize,
    count: usize,
}

impl Default for Queue {
    fn default() -> Self {
        Self { waiting: [None; DEPTH], first: 0, count: 0 }
    }
}

impl Queue {
    fn push(&mut self, waiting: Waiting) -> Result<(), Code> {
        if self.count == DEPTH {
            return Err(Code::QueueFull);
        }
        self.waiting[(self.first + self.count) % DEPTH] = Some(waiting);
        self.count += 1;
        Ok(())
    }

    pub(super) fn pop(&mut self) -> Option<Waiting> {
        let waiting = self.waiting[self.first].take()?;
        self.first = (self.first + 1) % DEPTH;
        self.count -= 1;
        Some(waiting)
    }

    pub(super) fn contains(&self, id: CommandId) -> bool {
        self.waiting.iter().flatten().any(|w| w.id == id)
    }
}

impl Order {
    const fn event(&self) -> AxisEvent {
        match self {
            Order::Absolute(..) | Order::Relative(..) => AxisEvent::Move,
            Order::Velocity(..) => AxisEvent::MoveVelocity,
            Order::Halt(_) => AxisEvent::Halt,
            Order::Home(_) => AxisEvent::Home,
        }
    }
}

impl Axis {
    /// Takes a motion command: at once, or with `buffered` when the one before it is done.
    pub fn order(&mut self, order: Order, buffered: bool) -> Result<CommandId, Code> {
        self.check(&order)?;
        let busy = matches!(self.state, AxisState::DiscreteMotion | AxisState::ContinuousMotion);
        if buffered && busy && !self.joined {
            let id = self.history.number();
            self.queue.push(Waiting { id, order })?;
            return Ok(id);
        }
        let id = self.take(order.event())?;
        self.begin(&order);
        Ok(id)
    }

    /// Parameters that can be wrong whatever the axis does meanwhile.
    fn check(&self, order: &Order) -> Result<(), Code> {
        match *order {
            Order::Absolute(target, m) => {
                self.moving(&m)?;
                self.check_target(target)
            }
            Order::Relative(distance, m) => {
                self.moving(&m)?;
                if distance.is_finite() { Ok(()) } else { Err(Code::ParameterOutOfRange) }
            }
            Order::Velocity(v, m) => {
                self.dynamics(v.abs(), m.a, m.d)?;
                self.check_direction(v)
            }
            Order::Halt(m) => self.dynamics(0.0, 0.0, m.d).map(|_| ()),
            Order::Home(position) if position.is_finite() => Ok(()),
            Order::Home(_) => Err(Code::ParameterOutOfRange),
        }?;
        match *order {
            // A waiting move starts elsewhere; it is checked when it begins.
            Order::Relative(distance, _) if self.queue.count == 0 && !self.is_moving() => {
                self.check_target(self.set.position + distance)
            }
            _ => Ok(()),
        }
    }

    fn moving(&self, m: &Wanted) -> Result<Dynamics, Code> {
        let dynamics = self.dynamics(m.v, m.a, m.d)?;
        if dynamics.v > 0.0 { Ok(dynamics) } else { Err(Code::ParameterOutOfRange) }
    }

    fn check_target(&self, target: f64) -> Result<(), Code> {
        if !target.is_finite() {
            return Err(Code::ParameterOutOfRange);
        }
        if target < self.config.travel_min_mm || target > self.config.travel_max_mm {
            return Err(Code::LimitExceeded);
        }
        self.check_direction(target - self.set.position)
    }

    fn check_direction(&self, v: f64) -> Result<(), Code> {
        let allowed = v == 0.0 || if v > 0.0 { self.power.positive } else { self.power.negative };
        if allowed { Ok(()) } else { Err(Code::DirectionBlocked) }
    }

    /// Starts an order that has the axis.
    fn begin(&mut self, order: &Order) {
        let (x, v) = (self.set.position, self.set.velocity);
        let generator = match *order {
            Order::Absolute(target, m) => self.moving(&m).map(|m| Generator::to_position(x, v, target, m)),
            Order::Relative(distance, m) => self
                .moving(&m)
                .and_then(|m| self.check_target(x + distance).map(|()| Generator::to_position(x, v, x + distance, m))),
            Order::Velocity(to, m) => {
                self.dynamics(to.abs(), m.a, m.d).map(|m| Generator::to_velocity(x, v, to.signum() * m.v, m))
            }
            Order::Halt(m) => self.dynamics(0.0, 0.0, m.d).map(|m| Generator::to_rest(x, v, m.d)),
            Order::Home(position) => {
                self.renumber(position);
                return;
            }
        };
        match generator {
            Ok(generator) => self.generator = Some(generator),
            Err(code) => {
                self.end_command(Outcome::Error(code));
                self.brake(self.config.a_max_mm_s2);
            }
        }
    }

    /// The next command takes over from one that is done, or from an endless one that has its velocity.
    pub(super) fn next_order(&mut self) -> bool {
        let Some(waiting) = self.queue.pop() else { return false };
        // The command before has ended already, or is an endless one, which has no end of its own.
        self.end_command(Outcome::Aborted);
        self.command = waiting.id;
        if self.event(waiting.order.event()) {
            self.begin(&waiting.order);
        } else {
            self.end_command(Outcome::Error(Code::WrongState));
        }
        true
    }

    /// The position where the axis stands becomes `position`.
    fn renumber(&mut self, position: f64) {
        let by = position - self.set.position;
        self.set.position = position;
        self.actual += by;
        self.shift += by;
        self.homed = true;
    }
}
