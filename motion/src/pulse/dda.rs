//! Software DDA for lines and arcs, and positioning.
//! Runs: cyclic. Invariant: exactly the increments of the move are made, the radial error of an arc is at most one BLU.
//! From: PC-20..PC-24, R1-110, R1-111. The sequential update keeps an arc on its radius; the preload halves the error of its start.

use super::{PulseArc, PulseKind, PulseMove};

/// One iteration: which axes step, and which way they count.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Pulse {
    /// A pulse on X, Y, Z.
    pub step: [bool; 3],
    /// Direction bit: up.
    pub up: [bool; 3],
}

impl Pulse {
    /// Counts the steps of this iteration.
    pub fn count(&self, at: &mut [i64; 3]) {
        for (at, (step, up)) in at.iter_mut().zip(self.step.iter().zip(self.up)) {
            *at += i64::from(*step) * if up { 1 } else { -1 };
        }
    }
}

/// Start value of the accumulators (PC-22).
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Preload {
    /// Half of the modulus: L/2, R/2.
    #[default]
    Half,
    /// Zero, as in the paper.
    Zero,
}

/// A move in progress.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Dda {
    kind: Kind,
    preload: f64,
}

#[derive(Clone, Copy, PartialEq, Debug)]
enum Kind {
    Line(Line),
    Arc(Circle),
    Position(Line),
}

#[derive(Clone, Copy, PartialEq, Debug)]
struct Line {
    increment: [i64; 3],
    left: [i64; 3],
    length: f64,
    q: [f64; 3],
}

#[derive(Clone, Copy, PartialEq, Debug)]
struct Circle {
    arc: PulseArc,
    radius: f64,
    /// Position relative to the centre.
    at: [i64; 2],
    /// End of the part in this quadrant.
    goal: [i64; 2],
    q: [f64; 2],
    /// Quadrant parts still to come, this one included; bounds the work.
    parts: u32,
    last: bool,
}

impl Dda {
    /// Starts a move.
    pub fn new(m: &PulseMove, preload: Preload) -> Self {
        let preload = if preload == Preload::Half { 0.5 } else { 0.0 };
        let kind = match m.kind {
            PulseKind::Line(d) => Kind::Line(Line::new(d, preload)),
            PulseKind::Position(d) => Kind::Position(Line::new(d, preload)),
            PulseKind::Arc(arc) => Kind::Arc(Circle::new(arc, preload)),
        };
        Self { kind, preload }
    }

    /// One iteration; `None` if the move has ended.
    pub fn step(&mut self) -> Option<Pulse> {
        match &mut self.kind {
            Kind::Line(line) => line.step(),
            Kind::Position(line) => line.position(),
            Kind::Arc(circle) => circle.step(self.preload),
        }
    }
}

impl Line {
    fn new(increment: [i64; 3], preload: f64) -> Self {
        let length = increment.iter().map(|&d| d as f64 * d as f64).sum::<f64>().sqrt();
        Self { increment, left: increment.map(i64::abs), length, q: [preload * length; 3] }
    }

    fn done(&self) -> bool {
        self.left == [0; 3]
    }

    fn up(&self) -> [bool; 3] {
        self.increment.map(|d| d > 0)
    }

    /// PC-20
    fn step(&mut self) -> Option<Pulse> {
        if self.done() {
            return None;
        }
        let mut pulse = Pulse { step: [false; 3], up: self.up() };
        for i in 0..3 {
            self.q[i] += self.increment[i].abs() as f64;
            if self.q[i] >= self.length && self.left[i] > 0 {
                self.q[i] -= self.length;
                self.left[i] -= 1;
                pulse.step[i] = true;
            }
        }
        Some(pulse)
    }

    /// PC-24
    fn position(&mut self) -> Option<Pulse> {
        if self.done() {
            return None;
        }
        let step = self.left.map(|n| n > 0);
        self.left = self.left.map(|n| (n - 1).max(0));
        Some(Pulse { step, up: self.up() })
    }
}

impl Circle {
    fn new(arc: PulseArc, preload: f64) -> Self {
        let [x, y] = arc.start.map(|c| c as f64);
        let parts = arc.turns.saturating_mul(4).saturating_add(6);
        let mut circle = Self { arc, radius: libm::hypot(x, y), at: arc.start, goal: arc.start, q: [0.0; 2], parts, last: false };
        if circle.radius < 0.5 {
            // Centre and start fall on one grid point: what is left is the way to the end.
            circle.last = true;
            circle.goal = arc.end;
        } else {
            circle.next_part(preload);
        }
        circle
    }

    /// Direction of each axis here: along the circle (PC-21), on a coordinate axis that of the quadrant to come (PC-23).
    fn direction(&self) -> [i64; 2] {
        let sense = if self.arc.ccw { 1 } else { -1 };
        let [sx, sy] = self.at.map(i64::signum);
        let sx = if sx != 0 { sx } else { -sense * sy };
        let sy = if sy != 0 { sy } else { sense * sx };
        [-sense * sy, sense * sx]
    }

    /// The next part ends on a coordinate axis or, if it lies before that, at the end point.
    fn next_part(&mut self, preload: f64) {
        self.q = [preload * self.radius; 2];
        self.parts = self.parts.saturating_sub(1);
        let [dx, dy] = self.direction();
        let r = self.radius.round() as i64;
        // One coordinate goes to zero, the other grows to the radius.
        let crossing = if self.at[0] != 0 && self.at[0].signum() == -dx { [0, dy * r] } else { [dx * r, 0] };
        let end_here = self.ahead(self.arc.end, crossing, [dx, dy]);
        self.last = self.parts == 0 || (end_here && self.arc.turns == 0);
        if end_here {
            self.arc.turns = self.arc.turns.saturating_sub(1);
        }
        self.goal = if self.last { self.arc.end } else { crossing };
    }

    /// True if `p` lies between here and `crossing` in the sense of travel, but not here: that is a whole turn away.
    fn ahead(&self, p: [i64; 2], crossing: [i64; 2], d: [i64; 2]) -> bool {
        p != self.at && (0..2).all(|i| (p[i] - self.at[i]) * d[i] >= 0 && (crossing[i] - p[i]) * d[i] >= 0)
    }

    /// PC-21
    fn step(&mut self, preload: f64) -> Option<Pulse> {
        while self.at == self.goal {
            if self.last {
                return None;
            }
            self.next_part(preload);
        }
        let d = self.direction_to_goal();
        let mut pulse = Pulse::default();
        for (i, &direction) in d.iter().enumerate() {
            let other = self.at[1 - i].abs() as f64;
            // An axis whose partner has arrived has nothing left to follow: it goes on by itself.
            self.q[i] += if self.at[1 - i] == self.goal[1 - i] { self.radius.max(1.0) } else { other };
            let axis = self.arc.axes[i];
            if self.q[i] >= self.radius && self.at[i] != self.goal[i] {
                self.q[i] -= self.radius;
                self.at[i] += direction;
                pulse.step[axis] = true;
            }
            pulse.up[axis] = direction > 0;
        }
        Some(pulse)
    }

    fn direction_to_goal(&self) -> [i64; 2] {
        let along = self.direction();
        std::array::from_fn(|i| if self.goal[i] == self.at[i] { along[i] } else { (self.goal[i] - self.at[i]).signum() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(kind: PulseKind, preload: Preload) -> Vec<Pulse> {
        let mut dda = Dda::new(&PulseMove { kind, frequency: 1.0, feed_mm: 0.0 }, preload);
        std::iter::from_fn(|| dda.step()).take(10_000_000).collect()
    }

    fn counts(pulses: &[Pulse]) -> [i64; 3] {
        let mut at = [0; 3];
        pulses.iter().for_each(|p| p.count(&mut at));
        at
    }

    /// PC-T9: 37 ticks with preload 0.
    #[test]
    fn pc_t9_line() {
        let pulses = run(PulseKind::Line([20, 30, 0]), Preload::Zero);
        assert_eq!((pulses.len(), counts(&pulses)), (37, [20, 30, 0]));
    }

    #[test]
    fn pc_20_axis_parallel_line() {
        for preload in [Preload::Zero, Preload::Half] {
            let pulses = run(PulseKind::Line([0, -60, 0]), preload);
            assert_eq!((pulses.len(), counts(&pulses)), (60, [0, -60, 0]));
            assert!(pulses.iter().all(|p| p.step == [false, true, false]));
        }
    }

    #[test]
    fn pc_24_positioning() {
        let pulses = run(PulseKind::Position([20, 30, -5]), Preload::Half);
        assert_eq!((pulses.len(), counts(&pulses)), (30, [20, 30, -5]));
    }

    fn quarter(r: i64, quadrant: usize, ccw: bool) -> PulseArc {
        let corners = [[r, 0], [0, r], [-r, 0], [0, -r]];
        let (a, b) = (corners[quadrant], corners[(quadrant + 1) % 4]);
        let (start, end) = if ccw { (a, b) } else { (b, a) };
        PulseArc { axes: [0, 1], start, end, ccw, turns: 0 }
    }

    fn radial_error(arc: PulseArc, preload: Preload) -> (f64, usize, bool) {
        let pulses = run(PulseKind::Arc(arc), preload);
        let (mut at, mut worst) = ([arc.start[0], arc.start[1], 0], 0.0f64);
        let r = libm::hypot(at[0] as f64, at[1] as f64);
        for p in &pulses {
            p.count(&mut at);
            worst = worst.max((libm::hypot(at[0] as f64, at[1] as f64) - r).abs());
        }
        (worst, pulses.len(), at[..2] == arc.end)
    }

    /// PC-22: R = 1..800, both senses, all quadrants: radial error, end point, number of ticks.
    #[test]
    fn pc_22_quarter_arcs() {
        for r in 1..=800 {
            for quadrant in 0..4 {
                for ccw in [true, false] {
                    let (error, ticks, exact) = radial_error(quarter(r, quadrant, ccw), Preload::Half);
                    assert!(error <= 1.0, "R{r} quadrant {quadrant} ccw {ccw}: {error}");
                    assert!(exact);
                    let ideal = std::f64::consts::FRAC_PI_2 * r as f64;
                    assert!((ticks as f64 - ideal).abs() <= 2.0, "R{r}: {ticks} ticks, ideal {ideal}");
                }
            }
        }
    }

    /// PC-22: arcs over several quadrants and from any point of the grid end exactly.
    #[test]
    fn pc_23_arcs_over_quadrants() {
        let points = [[5, 0], [4, 3], [3, 4], [0, 5], [-3, 4], [-4, 3], [-5, 0], [-4, -3], [0, -5], [3, -4], [4, -3]];
        for start in points {
            for end in points {
                for ccw in [true, false] {
                    for turns in [0, 1] {
                        let (error, ticks, exact) =
                            radial_error(PulseArc { axes: [0, 1], start, end, ccw, turns }, Preload::Half);
                        assert!(exact && error <= 1.0, "{start:?} {end:?} {ccw} {turns}: {error}, {ticks} ticks, {exact}");
                        let angle = |p: [i64; 2]| libm::atan2(p[1] as f64, p[0] as f64);
                        let mut sweep = (angle(end) - angle(start)) * if ccw { 1.0 } else { -1.0 };
                        if sweep < 1e-9 {
                            sweep += std::f64::consts::TAU;
                        }
                        let ideal = 5.0 * (sweep + std::f64::consts::TAU * f64::from(turns));
                        assert!(
                            (ticks as f64 - ideal).abs() < 8.0 + 8.0 * f64::from(turns),
                            "{start:?} {end:?} {ccw} {turns}: {ticks} {ideal}"
                        );
                    }
                }
            }
        }
    }
}
