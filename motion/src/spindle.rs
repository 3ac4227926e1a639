//! A simulated spindle: speed and direction as commanded, reached with constant acceleration, with an encoder.
//! Runs: cyclic. From: R1-75..R1-77 (S, surface speed, modes), G96 as in LinuxCNC: speed = V / (pi d), clamped.

use crate::geometry::Point;
use std::f64::consts::TAU;

/// What S means.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Speed {
    /// Revolutions a second (G97).
    Constant(f64),
    /// Cutting speed (G96).
    Surface {
        /// mm/s at the work piece.
        mm_s: f64,
        /// Highest revolutions a second.
        max: f64,
        /// Machine coordinate X of the axis of the work piece.
        x0: f64,
    },
}

/// What the part program wants of the spindle.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct SpindleCommand {
    /// 1 for M3, -1 for M4, 0 for M5.
    pub direction: i8,
    /// How fast.
    pub speed: Speed,
}

impl Speed {
    /// Revolutions a second where the tool is `r` mm from the axis.
    pub fn at_radius(&self, r: f64) -> f64 {
        match *self {
            Speed::Constant(rps) => rps,
            Speed::Surface { mm_s, max, .. } => {
                let rps = mm_s / (TAU * r.abs());
                if rps < max { rps } else { max }
            }
        }
    }

    fn at(&self, position: &Point) -> f64 {
        match *self {
            Speed::Constant(rps) => rps,
            Speed::Surface { x0, .. } => self.at_radius(position[0] - x0),
        }
    }
}

/// The spindle of a channel.
#[derive(Clone, Debug)]
pub struct Spindle {
    command: SpindleCommand,
    /// rev/s2; infinite: at once.
    acceleration: f64,
    /// Override, and whether it counts (M51).
    share: f64,
    override_on: bool,
    /// Turned against the command, inside of a tapping cycle.
    reversed: bool,
    /// rev/s, positive clockwise.
    speed: f64,
    /// Encoder, in revolutions.
    revolutions: f64,
}

impl Spindle {
    /// Standing; `acceleration` in rev/s2, 0: it has its speed at once.
    pub fn new(acceleration: f64) -> Self {
        Self {
            command: SpindleCommand { direction: 0, speed: Speed::Constant(0.0) },
            acceleration: if acceleration > 0.0 { acceleration } else { f64::INFINITY },
            share: 1.0,
            override_on: true,
            reversed: false,
            speed: 0.0,
            revolutions: 0.0,
        }
    }

    /// Takes a command of the part program.
    pub fn obey(&mut self, command: SpindleCommand) {
        self.command = command;
        self.reversed = false;
    }

    /// Stops.
    pub fn stop(&mut self) {
        self.command.direction = 0;
        self.reversed = false;
    }

    /// Turns the other way round.
    pub fn reverse(&mut self) {
        self.reversed = !self.reversed;
    }

    /// Share of the commanded speed.
    pub fn set_override(&mut self, share: f64) {
        self.share = share;
    }

    /// The override counts (M51) or not.
    pub fn use_override(&mut self, on: bool) {
        self.override_on = on;
    }

    /// One servo period of `dt` seconds with the tool at `position`.
    pub fn tick(&mut self, dt: f64, position: &Point) {
        let share = if self.override_on { self.share } else { 1.0 };
        let sense = f64::from(self.command.direction) * if self.reversed { -1.0 } else { 1.0 };
        let wanted = if sense == 0.0 { 0.0 } else { sense * share * self.command.speed.at(position) };
        let before = self.speed;
        let step = self.acceleration * dt;
        self.speed =
            if (wanted - before).abs() <= step * (1.0 + 1e-9) { wanted } else { before + step.copysign(wanted - before) };
        self.revolutions += 0.5 * (before + self.speed) * dt;
    }

    /// Actual speed in rev/s, positive clockwise.
    pub fn speed(&self) -> f64 {
        self.speed
    }
    /// Commanded revolutions a second, at `position`; without sign and override.
    pub fn commanded(&self, position: &Point) -> f64 {
        if self.command.direction == 0 { 0.0 } else { self.command.speed.at(position) }
    }
    /// 1 for M3, -1 for M4, 0 for M5.
    pub fn sense(&self) -> f64 {
        f64::from(self.command.direction)
    }
    /// Encoder: revolutions since the start, positive clockwise.
    pub fn revolutions(&self) -> f64 {
        self.revolutions
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ORIGIN: Point = [0.0; crate::geometry::AXES];

    #[test]
    fn ramps_and_counts() {
        let mut spindle = Spindle::new(100.0);
        spindle.obey(SpindleCommand { direction: -1, speed: Speed::Constant(10.0) });
        (0..100).for_each(|_| spindle.tick(0.001, &ORIGIN));
        assert!((spindle.speed() + 10.0).abs() < 1e-9);
        assert!((spindle.revolutions() + 0.5).abs() < 1e-9, "{}", spindle.revolutions());
        spindle.reverse();
        (0..200).for_each(|_| spindle.tick(0.001, &ORIGIN));
        assert!((spindle.speed() - 10.0).abs() < 1e-9);
        assert!((spindle.revolutions() + 0.5).abs() < 1e-9);
        spindle.stop();
        (0..100).for_each(|_| spindle.tick(0.001, &ORIGIN));
        assert_eq!(spindle.speed(), 0.0);
    }

    /// R1-76: V = 100 m/min at a diameter of 50 mm is 1000 V / (pi d) = 636.6 rpm; towards the axis the limit counts.
    #[test]
    fn surface_speed() {
        let speed = Speed::Surface { mm_s: 100_000.0 / 60.0, max: 2000.0 / 60.0, x0: 10.0 };
        let mut spindle = Spindle::new(0.0);
        spindle.obey(SpindleCommand { direction: 1, speed });
        for (x, rpm) in [(35.0, 636.619_772), (-15.0, 636.619_772), (10.0, 2000.0), (15.0, 2000.0)] {
            let mut p = ORIGIN;
            p[0] = x;
            spindle.tick(0.001, &p);
            assert!((spindle.speed() * 60.0 - rpm).abs() < 1e-5, "{x}: {}", spindle.speed() * 60.0);
        }
        let axis = [10.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        spindle.set_override(0.5);
        spindle.tick(0.001, &axis);
        assert!((spindle.speed() * 60.0 - 1000.0).abs() < 1e-9);
        spindle.use_override(false);
        spindle.tick(0.001, &axis);
        assert!((spindle.speed() * 60.0 - 2000.0).abs() < 1e-9);
    }
}
