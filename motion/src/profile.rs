//! Speed over one path element: accelerate, keep, decelerate, in closed form.
//! Runs: both. Pure functions; nothing is rounded to whole periods, so the samples never leave the limits.
//! From: R1-144..R1-147 (normal and short block), R1-165, O-31.

/// Trapezoid of one element. Times in s, lengths in mm, speeds in mm/s.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Profile {
    /// Speed at the start.
    pub v_in: f64,
    /// Highest speed.
    pub v_peak: f64,
    /// Speed at the end.
    pub v_out: f64,
    /// Acceleration of the first part, mm/s2.
    pub a: f64,
    /// Deceleration of the last part, mm/s2.
    pub d: f64,
    /// Time of acceleration.
    pub t_acc: f64,
    /// Time at the highest speed.
    pub t_const: f64,
    /// Time of deceleration.
    pub t_dec: f64,
    /// Length of the acceleration.
    pub s_acc: f64,
    /// Length of acceleration and constant part.
    pub s_dec: f64,
    /// Whole length.
    pub length: f64,
}

/// A part of a profile with constant acceleration, by length.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Phase {
    /// Where it starts.
    pub start: f64,
    /// Where it ends.
    pub end: f64,
    /// Square of the speed at its start.
    pub start_v2: f64,
    /// Acceleration, signed.
    pub a: f64,
}

/// Square of the highest speed that a move of `length` can reach between `v_in` and `v_out`.
pub fn peak_v2(length: f64, v_in: f64, v_out: f64, a: f64, d: f64) -> f64 {
    (2.0 * a * d * length + d * v_in * v_in + a * v_out * v_out) / (a + d)
}

/// The fastest profile within the limits. `v_in` and `v_out` must be reachable from each other within `length`.
pub fn trapezoid(length: f64, v_in: f64, v_out: f64, v_max: f64, a: f64, d: f64) -> Profile {
    let v_peak = peak_v2(length, v_in, v_out, a, d).sqrt().min(v_max).max(v_in).max(v_out);
    let (t_acc, t_dec) = ((v_peak - v_in) / a, (v_peak - v_out) / d);
    let s_acc = (0.5 * (v_in + v_peak) * t_acc).min(length);
    let s_dec = (length - 0.5 * (v_out + v_peak) * t_dec).max(s_acc);
    let t_const = if v_peak > 0.0 { (s_dec - s_acc) / v_peak } else { 0.0 };
    Profile { v_in, v_peak, v_out, a, d, t_acc, t_const, t_dec, s_acc, s_dec, length }
}

impl Profile {
    /// Whole time.
    pub fn duration(&self) -> f64 {
        self.t_acc + self.t_const + self.t_dec
    }

    /// Length travelled at time `t`.
    pub fn s(&self, t: f64) -> f64 {
        let left = self.duration() - t;
        if t <= self.t_acc {
            t.max(0.0) * (self.v_in + 0.5 * self.a * t.max(0.0))
        } else if left > self.t_dec {
            self.s_acc + self.v_peak * (t - self.t_acc)
        } else {
            self.length - left.max(0.0) * (self.v_out + 0.5 * self.d * left.max(0.0))
        }
    }

    /// Speed at time `t`.
    pub fn v(&self, t: f64) -> f64 {
        let left = self.duration() - t;
        if t <= self.t_acc {
            self.v_in + self.a * t.max(0.0)
        } else if left > self.t_dec {
            self.v_peak
        } else {
            self.v_out + self.d * left.max(0.0)
        }
    }

    /// The part at length `s`, the later one at a border.
    pub fn phase(&self, s: f64) -> Phase {
        if s < self.s_acc {
            Phase { start: 0.0, end: self.s_acc, start_v2: self.v_in * self.v_in, a: self.a }
        } else if s < self.s_dec {
            Phase { start: self.s_acc, end: self.s_dec, start_v2: self.v_peak * self.v_peak, a: 0.0 }
        } else {
            Phase { start: self.s_dec, end: self.length, start_v2: self.v_peak * self.v_peak, a: -self.d }
        }
    }

    /// Speed at length `s`.
    pub fn v_at(&self, s: f64) -> f64 {
        self.phase(s).v2(s).sqrt()
    }

    /// Time at length `s`: the inverse of [`Profile::s`].
    pub fn time_at(&self, s: f64) -> f64 {
        let phase = self.phase(s);
        let before = if phase.a > 0.0 {
            0.0
        } else if phase.a == 0.0 {
            self.t_acc
        } else {
            self.t_acc + self.t_const
        };
        let speeds = phase.start_v2.sqrt() + phase.v2(s).sqrt();
        before + if speeds > 0.0 { 2.0 * (s - phase.start) / speeds } else { 0.0 }
    }
}

impl Phase {
    /// Square of the speed at length `s`.
    pub fn v2(&self, s: f64) -> f64 {
        (self.start_v2 + 2.0 * self.a * (s - self.start)).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(got: f64, want: f64) {
        assert!((got - want).abs() < 1e-6, "{got} is not {want}");
    }

    /// O-31
    #[test]
    fn normal_and_short_block() {
        let p = trapezoid(50.0, 0.0, 0.0, 100.0, 1000.0, 500.0);
        [(p.t_acc, 0.1), (p.t_const, 0.35), (p.t_dec, 0.2)].into_iter().for_each(|(got, want)| close(got, want));
        let p = trapezoid(10.0, 0.0, 0.0, 100.0, 1000.0, 500.0);
        [(p.v_peak, 81.649_658), (p.t_acc, 0.0816497), (p.t_const, 0.0), (p.t_dec, 0.1632993)].into_iter().for_each(
            |(got, want)| {
                assert!((got - want).abs() < 1e-6, "{got} is not {want}");
            },
        );
    }

    /// O-31: ten displacements .05, .15, ..., .95 that sum to 5.
    #[test]
    fn displacements_per_period() {
        let p = trapezoid(50.0, 0.0, 0.0, 100.0, 1000.0, 500.0);
        for i in 0..10 {
            close(p.s(0.01 * f64::from(i + 1)) - p.s(0.01 * f64::from(i)), 0.05 + 0.1 * f64::from(i));
        }
        close(p.s(0.1), 5.0);
    }

    /// O-32 f: pairs of short blocks follow from the general solution.
    #[test]
    fn peak_of_a_pair() {
        close(peak_v2(4.0, 0.0, 44.721_359_549_995_8, 1000.0, 500.0).sqrt(), 63.245_553_2);
    }

    #[test]
    fn time_and_length_are_inverse() {
        for (l, v0, v1) in [(50.0, 0.0, 0.0), (10.0, 30.0, 0.0), (3.0, 60.0, 80.0), (0.001, 0.0, 1.0)] {
            let p = trapezoid(l, v0, v1, 100.0, 1000.0, 1000.0);
            for k in 0..=100 {
                let t = p.duration() * f64::from(k) / 100.0;
                assert!((p.time_at(p.s(t)) - t).abs() < 1e-7, "{l} {t}");
                assert!((p.v_at(p.s(t)) - p.v(t)).abs() < 1e-5, "{l} {t}");
            }
            assert_eq!(p.s(p.duration()), l);
        }
    }
}
