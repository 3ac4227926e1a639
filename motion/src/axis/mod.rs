//! An axis: state, set and actual values, limits, single-axis moves, power, following error.
//! Runs: cyclic. No allocation. Invariant: the set value never jumps while the axis has power (homing renumbers it).
//! From: PLCopen part 1 §2.1, §2.4, §3; R1-183.

pub mod commands;
pub mod generator;
pub mod orders;
pub mod state;

pub use commands::{CommandId, Outcome};
pub use state::{AxisEvent, AxisState};

use crate::machine::config::AxisConfig;
use crate::plant::{Plant, PowerStage};
use crate::servo::{Gains, Servo, SetPoint};
use commands::History;
use generator::{Dynamics, Generator};
use orders::Queue;
use takt_base::Code;

/// What MC_Power asks for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct PowerRequest {
    /// Offset of the MC_Power instance that owns the axis; 0: nobody yet.
    owner: u32,
    enable: bool,
    positive: bool,
    negative: bool,
}

/// One axis with its simulated drive.
#[derive(Clone, Debug)]
pub struct Axis {
    config: AxisConfig,
    gains: Gains,
    dt: f64,
    state: AxisState,
    error: Option<Code>,
    homed: bool,
    /// Set position, velocity and acceleration.
    set: SetPoint,
    /// Actual position and velocity.
    actual: f64,
    actual_velocity: f64,
    /// Coordinate minus encoder.
    shift: f64,
    generator: Option<Generator>,
    command: CommandId,
    history: History,
    queue: Queue,
    stop_held: bool,
    power: PowerRequest,
    stage: PowerStage,
    servo: Servo,
    plant: Plant,
    open_loop: bool,
    joined: bool,
    followed: Option<f64>,
    /// Shut down: power is not given again.
    locked: bool,
}

impl Axis {
    /// A disabled axis, sampled every `dt` seconds.
    pub fn new(config: AxisConfig, dt: f64) -> Self {
        let gains = Gains {
            kp: config.kp,
            ki: config.ki,
            kd: config.kd,
            kff_velocity: config.kff_velocity,
            kff_acceleration: config.kff_acceleration,
            output_max: 1.5 * config.v_max_mm_s,
        };
        Self {
            gains,
            dt,
            state: AxisState::Disabled,
            error: None,
            homed: false,
            set: SetPoint::default(),
            actual: 0.0,
            actual_velocity: 0.0,
            shift: 0.0,
            generator: None,
            command: CommandId::NONE,
            history: History::default(),
            queue: Queue::default(),
            stop_held: false,
            power: PowerRequest { owner: 0, enable: false, positive: true, negative: true },
            stage: PowerStage::new(config.drive_enable_delay_s),
            servo: Servo::default(),
            plant: Plant::new(config.plant_time_constant_s, dt),
            open_loop: false,
            joined: false,
            followed: None,
            locked: false,
            config,
        }
    }

    /// State.
    pub fn state(&self) -> AxisState {
        self.state
    }
    /// Why it is in ErrorStop.
    pub fn error(&self) -> Option<Code> {
        self.error
    }
    /// A home position is known.
    pub fn is_homed(&self) -> bool {
        self.homed
    }
    /// Set position in mm.
    pub fn set_position(&self) -> f64 {
        self.set.position
    }
    /// Set velocity in mm/s.
    pub fn set_velocity(&self) -> f64 {
        self.set.velocity
    }
    /// Actual position in mm.
    pub fn actual_position(&self) -> f64 {
        self.actual
    }
    /// Actual velocity in mm/s.
    pub fn actual_velocity(&self) -> f64 {
        self.actual_velocity
    }
    /// Distance that the servo loop lags behind, in mm.
    pub fn following_error(&self) -> f64 {
        self.servo.error()
    }
    /// The power stage is on.
    pub fn has_power(&self) -> bool {
        self.stage.is_on()
    }
    /// Configuration.
    pub fn config(&self) -> &AxisConfig {
        &self.config
    }
    /// Makes or clears a fault of the simulated drive.
    pub fn set_drive_fault(&mut self, fault: bool) {
        self.stage.set_fault(fault);
    }
    /// Pushes the simulated axis away from where it is, in mm: a disturbance.
    pub fn disturb(&mut self, mm: f64) {
        self.plant.position += mm;
    }
    /// The axis is driven by steps, without feedback.
    pub fn set_open_loop(&mut self) {
        self.open_loop = true;
    }
    /// True if the set value moves.
    pub fn is_moving(&self) -> bool {
        self.set.velocity != 0.0 || self.generator.is_some()
    }

    /// One servo period.
    pub fn tick(&mut self) {
        self.power_tick();
        self.set_tick();
        self.servo_tick();
        self.finish_tick();
    }

    fn power_tick(&mut self) {
        let on_before = self.stage.is_on();
        // An axis of a channel keeps its power until the path stands, even where it does not move itself.
        let braking = (self.is_moving() || self.joined) && self.state != AxisState::Disabled;
        self.stage.step(self.power.enable || braking, self.dt);
        if self.stage.has_fault() && self.power.enable || (on_before && !self.stage.is_on() && self.power.enable) {
            self.fault(Code::DriveFault);
        }
        if self.stage.is_on() && self.power.enable && self.state == AxisState::Disabled {
            self.event(AxisEvent::PowerOn);
            self.rest_at_actual();
        }
        if !self.power.enable && !braking && !self.joined && self.state != AxisState::Disabled {
            self.event(AxisEvent::PowerOff);
        }
        if !self.stage.is_on() {
            self.rest_at_actual();
        }
    }

    /// Without power there is nothing to follow: the set value stays with the actual one.
    fn rest_at_actual(&mut self) {
        self.generator = None;
        self.servo.reset();
        self.set = SetPoint { position: self.actual, ..SetPoint::default() };
    }

    fn set_tick(&mut self) {
        let from_channel = self.followed.is_some();
        let (position, velocity) = match (self.followed.take(), &mut self.generator) {
            (Some(p), _) => (p, (p - self.set.position) / self.dt),
            (None, Some(g)) => g.advance(self.dt),
            (None, None) => (self.set.position, 0.0),
        };
        let mean = (position - self.set.position) / self.dt;
        let acceleration = (velocity - self.set.velocity) / self.dt;
        // The loop follows one period behind: where the axis shall be when this period ends.
        let target = SetPoint { position: self.set.position, velocity: mean, acceleration };
        // The last position from a channel is where the path rests.
        let rests = from_channel && !self.joined;
        self.set = SetPoint { position, velocity: if rests { 0.0 } else { velocity }, acceleration };
        let u = if !self.stage.is_on() { 0.0 } else { self.servo.step(&self.gains, &target, self.actual, self.dt) };
        if self.open_loop && self.stage.is_on() {
            self.plant.position = position - self.shift;
            self.plant.velocity = velocity;
        } else {
            self.plant.step(u);
        }
    }

    fn servo_tick(&mut self) {
        let encoder = if self.open_loop { self.plant.position } else { self.plant.encoder(self.config.encoder_resolution_mm) };
        let before = self.actual;
        self.actual = encoder + self.shift;
        self.actual_velocity = (self.actual - before) / self.dt;
        let limit = self.config.following_error_max_mm;
        if limit > 0.0 && !self.open_loop && self.stage.is_on() && self.servo.error().abs() > limit {
            self.fault(Code::FollowingError);
        }
    }

    fn finish_tick(&mut self) {
        self.watch_direction();
        self.watch_travel();
        if self.generator.as_ref().is_some_and(Generator::is_done) {
            self.generator = None;
            self.set.velocity = 0.0;
        }
        if self.generator.as_ref().is_some_and(Generator::is_in_velocity) && self.next_order() {
            return;
        }
        if self.generator.is_some() || self.joined {
            return;
        }
        match self.state {
            AxisState::Homing | AxisState::DiscreteMotion => {
                self.end_command(Outcome::Done);
                if !self.next_order() {
                    self.event(AxisEvent::Done);
                }
            }
            AxisState::Stopping => {
                self.end_command(Outcome::Done);
                self.release_stop();
            }
            _ => {}
        }
    }

    /// MC_Power.EnablePositive, EnableNegative: a direction that is not enabled brakes, without an axis error.
    fn watch_direction(&mut self) {
        let v = self.set.velocity;
        let blocked = v > 0.0 && !self.power.positive || v < 0.0 && !self.power.negative;
        if blocked
            && matches!(self.state, AxisState::DiscreteMotion | AxisState::ContinuousMotion)
            && self.is_active(self.command)
        {
            self.end_all(Outcome::Error(Code::DirectionBlocked));
            self.event(AxisEvent::Halt);
            self.brake(self.config.a_max_mm_s2);
        }
    }

    /// An endless motion ends in front of the software limit, as an axis error.
    fn watch_travel(&mut self) {
        if self.state != AxisState::ContinuousMotion {
            return;
        }
        let v = self.set.velocity;
        let stop = self.set.position + v * self.dt + v * v.abs() / (2.0 * self.config.a_max_mm_s2);
        if (v > 0.0 && stop > self.config.travel_max_mm) || (v < 0.0 && stop < self.config.travel_min_mm) {
            self.fault(Code::LimitExceeded);
        }
    }

    fn release_stop(&mut self) {
        if !self.stop_held && self.power.enable {
            self.event(AxisEvent::StopReleased);
        }
    }

    fn event(&mut self, event: AxisEvent) -> bool {
        match state::next(self.state, event) {
            Some(next) => {
                self.state = next;
                true
            }
            None => false,
        }
    }

    fn brake(&mut self, deceleration: f64) {
        self.generator =
            (self.set.velocity != 0.0).then(|| Generator::to_rest(self.set.position, self.set.velocity, deceleration));
    }

    /// Axis error: the command fails, the axis brakes if it can (A2).
    pub fn fault(&mut self, code: Code) {
        if self.state == AxisState::ErrorStop {
            return;
        }
        self.error = Some(code);
        self.event(AxisEvent::Fault);
        self.end_all(Outcome::Error(code));
        if !self.joined {
            self.brake(self.config.a_max_mm_s2);
        }
    }

    /// A channel takes the axis.
    pub fn join(&mut self) -> bool {
        self.joined = self.event(AxisEvent::Join);
        self.joined
    }

    /// A channel gives the axis back; it stands still.
    pub fn leave(&mut self) {
        self.joined = false;
        if self.state == AxisState::SynchronizedMotion {
            self.event(AxisEvent::Done);
        }
    }

    /// Set position of this tick, from the channel that has the axis.
    pub fn follow(&mut self, position: f64) {
        if self.joined {
            self.followed = Some(position);
        }
    }

    /// Ends everything and takes the power away when the axis stands.
    pub fn shut_down(&mut self) {
        self.set_power(self.power.owner.max(1), false, true, true);
        self.locked = true;
    }

    fn dynamics(&self, v: f64, a: f64, d: f64) -> Result<Dynamics, Code> {
        let limit = |value: f64, max: f64, zero: f64| match value {
            x if !x.is_finite() || x < 0.0 => Err(Code::ParameterOutOfRange),
            0.0 => Ok(zero),
            x => Ok(x.min(max)),
        };
        let a_max = self.config.a_max_mm_s2;
        let v = limit(v, self.config.v_max_mm_s, 0.0)?;
        Ok(Dynamics { v, a: limit(a, a_max, a_max)?, d: limit(d, a_max, a_max)? })
    }
}
