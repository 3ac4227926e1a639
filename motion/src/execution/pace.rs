//! The path speed: along the plan, or below it with constant acceleration.
//! Runs: cyclic. Invariant: never above the plan, and above the cap only as long as the acceleration of the element needs to come down.

use super::ramp::{Ramp, meets};
use super::{END_MM, Pace, PathExecutor};

impl PathExecutor {
    /// Uses up to `left` seconds on the current element, not above `cap` mm/s; returns what is left.
    pub(super) fn step(&mut self, left: f64, cap: f64) -> f64 {
        match self.pace {
            Pace::Plan => self.on_plan(left, cap),
            Pace::Free(w) => self.off_plan(left, w, cap),
        }
    }

    /// Along the plan until it has a speed above the cap. Where it brakes it brakes as hard as a cap could ask for.
    fn on_plan(&mut self, left: f64, cap: f64) -> f64 {
        let Some(c) = &mut self.current else { return left };
        let p = &c.segment.profile;
        let mut time = f64::INFINITY;
        if p.v_peak > cap && c.tau < p.t_acc + p.t_const {
            let v = p.v(c.tau);
            time = if c.tau < p.t_acc && v < cap { (cap - v) / p.a } else { 0.0 };
        }
        if time < left {
            let v = p.v(c.tau);
            c.tau += time;
            c.s = p.s(c.tau);
            self.pace = Pace::Free(if time > 0.0 { cap } else { v });
            return left - time;
        }
        let over = c.tau + left - p.duration();
        if over < 0.0 {
            c.tau += left;
            c.s = p.s(c.tau);
            return 0.0;
        }
        self.finish();
        over
    }

    /// Below the plan at path speed `w`, towards the cap with the acceleration of the element, until the plan is met again.
    fn off_plan(&mut self, left: f64, w: f64, cap: f64) -> f64 {
        let Some(c) = &mut self.current else { return left };
        if w == 0.0 && cap == 0.0 {
            return 0.0;
        }
        let phase = c.segment.profile.phase(c.s);
        let a = if w < cap {
            c.segment.accel
        } else if w > cap {
            -c.segment.accel
        } else {
            0.0
        };
        // Where a ramp met the plan, rounding may have left the speed a hair above the cap.
        if a >= phase.a && w <= cap * (1.0 + 1e-9) && meets(w * w, phase.v2(c.s)) {
            self.back_to_plan();
            return left;
        }
        let ramp = Ramp::new(w, a, cap, c.s, &phase);
        let time = ramp.time(w);
        if time > left {
            c.s += left * (w + 0.5 * a * left);
            self.pace = Pace::Free((w + a * left).max(0.0));
            return 0.0;
        }
        c.s = if ramp.to_phase_end { phase.end } else { c.s + ramp.length };
        self.pace = Pace::Free(ramp.v_end);
        if c.s >= c.segment.path.length - END_MM {
            self.finish();
        }
        left - time
    }

    fn back_to_plan(&mut self) {
        if let Some(c) = &mut self.current {
            c.tau = c.segment.profile.time_at(c.s);
            self.pace = Pace::Plan;
        }
    }
}
