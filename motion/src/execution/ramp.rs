//! Constant path acceleration below the planned speed.
//! Runs: cyclic. Pure functions of numbers: over a phase of the plan both squares of speed are straight lines over the length, so
//! where they meet is a quotient.

use crate::profile::Phase;

/// True if the square of a speed is that of the plan, but for rounding.
pub fn meets(w2: f64, plan_v2: f64) -> bool {
    w2 >= plan_v2 * (1.0 - 1e-12)
}

/// A stretch of constant path acceleration: to the end of the phase, to the plan, to the cap or to rest.
pub struct Ramp {
    /// Length of the stretch.
    pub length: f64,
    /// Speed at its end.
    pub v_end: f64,
    /// It ends with the phase.
    pub to_phase_end: bool,
}

impl Ramp {
    /// From speed `w` at length `s` with acceleration `a`, which leads to the cap.
    pub fn new(w: f64, a: f64, cap: f64, s: f64, phase: &Phase) -> Self {
        let mut ramp = Ramp { length: phase.end - s, v_end: 0.0, to_phase_end: true };
        ramp.v_end = (w * w + 2.0 * a * ramp.length).max(0.0).sqrt();
        if a > phase.a {
            let meet = (phase.v2(s) - w * w) / (2.0 * (a - phase.a));
            ramp.shorten(meet.max(0.0), phase.v2(s + meet.max(0.0)).sqrt());
        }
        if a != 0.0 {
            ramp.shorten((cap * cap - w * w) / (2.0 * a), cap);
        }
        ramp
    }

    fn shorten(&mut self, length: f64, v_end: f64) {
        if length < self.length {
            *self = Ramp { length, v_end, to_phase_end: false };
        }
    }

    /// Seconds that it takes from speed `w`.
    pub fn time(&self, w: f64) -> f64 {
        let speeds = w + self.v_end;
        if speeds > 0.0 { 2.0 * self.length / speeds } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KEEP: Phase = Phase { start: 0.0, end: 100.0, start_v2: 2500.0, a: 0.0 };
    const BRAKE: Phase = Phase { start: 0.0, end: 1.25, start_v2: 2500.0, a: -1000.0 };

    #[test]
    fn meets_the_plan_the_cap_or_rest() {
        // From rest to the plan at 50 mm/s: 1.25 mm with 1000 mm/s2.
        let up = Ramp::new(0.0, 1000.0, f64::INFINITY, 10.0, &KEEP);
        assert_eq!((up.length, up.v_end, up.to_phase_end, up.time(0.0)), (1.25, 50.0, false, 0.05));
        // Only to a cap of 20.
        let cap = Ramp::new(0.0, 1000.0, 20.0, 10.0, &KEEP);
        assert_eq!((cap.length, cap.v_end), (0.2, 20.0));
        // At the cap until the plan brakes below it.
        let keep = Ramp::new(20.0, 0.0, 20.0, 0.0, &BRAKE);
        assert!((keep.length - 1.05).abs() < 1e-12 && !keep.to_phase_end);
        // To rest.
        let down = Ramp::new(20.0, -1000.0, 0.0, 10.0, &KEEP);
        assert_eq!((down.length, down.v_end), (0.2, 0.0));
        // Beside a plan that accelerates as hard there is nothing to meet.
        let beside = Phase { start: 0.0, end: 1.25, start_v2: 100.0, a: 1000.0 };
        assert!(Ramp::new(0.0, 1000.0, f64::INFINITY, 0.0, &beside).to_phase_end);
    }
}
