//! Set values of a single-axis move: constant-acceleration phases from the speed at hand.
//! Runs: cyclic. Sampled in closed form, so the end is exact. From: PLCopen part 1 §3 (trapezoids), scenarios S06, S11.

use crate::profile::trapezoid;

/// Most phases: brake and turn round, accelerate, keep, decelerate.
const PHASES: usize = 4;

/// A move in progress.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Generator {
    x: f64,
    v: f64,
    /// Duration and acceleration.
    phases: [(f64, f64); PHASES],
    elapsed: f64,
    end: f64,
    /// Velocity that is kept for ever after the phases.
    cruise: Option<f64>,
}

/// Dynamics of a move, all positive: mm/s, mm/s2.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Dynamics {
    /// Highest speed.
    pub v: f64,
    /// Acceleration.
    pub a: f64,
    /// Deceleration.
    pub d: f64,
}

impl Generator {
    /// From position `x` and velocity `v` to rest at `target`. Turns round where it can't stop in time.
    pub fn to_position(x: f64, v: f64, target: f64, m: Dynamics) -> Self {
        let brake = v * v / (2.0 * m.d);
        let distance = target - x;
        let sign = distance.signum();
        if v != 0.0 && (v * distance <= 0.0 || distance.abs() < brake) {
            let stop = x + v.signum() * brake;
            let [p1, p2, p3] = straight(target - stop, 0.0, m);
            return Self {
                x,
                v,
                phases: [(v.abs() / m.d, -v.signum() * m.d), p1, p2, p3],
                elapsed: 0.0,
                end: target,
                cruise: None,
            };
        }
        if v.abs() > m.v {
            let slower = (v.abs() - m.v) / m.d;
            let phases = [(slower, -sign * m.d), ((distance.abs() - brake) / m.v, 0.0), (m.v / m.d, -sign * m.d), (0.0, 0.0)];
            return Self { x, v, phases, elapsed: 0.0, end: target, cruise: None };
        }
        let [p1, p2, p3] = straight(distance, v.abs(), m);
        Self { x, v, phases: [p1, p2, p3, (0.0, 0.0)], elapsed: 0.0, end: target, cruise: None }
    }

    /// From position `x` and velocity `v` to rest with deceleration `d`.
    pub fn to_rest(x: f64, v: f64, d: f64) -> Self {
        let end = x + v.signum() * v * v / (2.0 * d);
        let phases = [(v.abs() / d, -v.signum() * d), (0.0, 0.0), (0.0, 0.0), (0.0, 0.0)];
        Self { x, v, phases, elapsed: 0.0, end, cruise: None }
    }

    /// From position `x` and velocity `v` to an endless motion at velocity `to`.
    pub fn to_velocity(x: f64, v: f64, to: f64, m: Dynamics) -> Self {
        let change = |from: f64, to: f64, a: f64| ((to - from).abs() / a, (to - from).signum() * a);
        let phases = if v * to < 0.0 {
            [change(v, 0.0, m.d), change(0.0, to, m.a), (0.0, 0.0), (0.0, 0.0)]
        } else {
            let a = if to.abs() > v.abs() { m.a } else { m.d };
            [change(v, to, a), (0.0, 0.0), (0.0, 0.0), (0.0, 0.0)]
        };
        Self { x, v, phases, elapsed: 0.0, end: f64::NAN, cruise: Some(to) }
    }

    /// True if an endless motion has its velocity.
    pub fn is_in_velocity(&self) -> bool {
        self.cruise.is_some() && self.elapsed >= self.duration() - 1e-9
    }

    /// Moves on by `dt` seconds; position and velocity.
    pub fn advance(&mut self, dt: f64) -> (f64, f64) {
        self.elapsed += dt;
        if self.is_done() {
            return (self.end, 0.0);
        }
        let (mut x, mut v, mut left) = (self.x, self.v, self.elapsed);
        for (t, a) in self.phases {
            let t = t.min(left);
            x += t * (v + 0.5 * a * t);
            v += a * t;
            left -= t;
        }
        if let Some(cruise) = self.cruise
            && self.is_in_velocity()
        {
            return (x + cruise * left.max(0.0), cruise);
        }
        (x, v)
    }

    /// True at the end.
    pub fn is_done(&self) -> bool {
        self.cruise.is_none() && self.elapsed >= self.duration() - 1e-9
    }

    /// Seconds in all.
    pub fn duration(&self) -> f64 {
        self.phases.iter().map(|(t, _)| t).sum()
    }
}

fn straight(distance: f64, v: f64, m: Dynamics) -> [(f64, f64); 3] {
    let p = trapezoid(distance.abs(), v, 0.0, m.v, m.a, m.d);
    let sign = distance.signum();
    [(p.t_acc, sign * m.a), (p.t_const, 0.0), (p.t_dec, -sign * m.d)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every start speed leads to the target within the dynamics.
    #[test]
    fn reaches_the_target_from_any_speed() {
        let m = Dynamics { v: 100.0, a: 1000.0, d: 500.0 };
        for v0 in [-150.0, -100.0, -3.0, 0.0, 3.0, 99.0, 100.0, 150.0] {
            for target in [-200.0, -1.0, -1e-3, 0.0, 1e-3, 1.0, 12.0, 200.0] {
                let mut g = Generator::to_position(0.0, v0, target, m);
                let (mut x, mut v) = (0.0, v0);
                let mut steps = 0;
                while !g.is_done() {
                    let (x1, v1) = g.advance(0.001);
                    assert!((v1 - v).abs() <= 1000.0 * 0.001 + 1e-9, "{v0} {target}: {v} to {v1}");
                    assert!((x1 - x - 0.5 * (v + v1) * 0.001).abs() < 1e-3, "{v0} {target}");
                    assert!(v1.abs() <= 100.0 + (v0.abs() - 100.0).max(0.0) + 1e-9);
                    (x, v) = (x1, v1);
                    steps += 1;
                    assert!(steps < 100_000);
                }
                assert_eq!((x, v), (target, 0.0));
            }
        }
    }
}
