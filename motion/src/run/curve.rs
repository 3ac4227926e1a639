//! A NURBS as short straight moves.
//! Runs: background. From: R1-91 (curve data executed by the control), G5 .. G5.3 of LinuxCNC: clamped uniform knots.
//! Invariant: no point of the curve is farther than [`TOLERANCE_MM`] from the moves, as far as its middle between two points tells.

use super::{Emit, RunError, RunReader};
use crate::canon::{Nurbs, Position};
use crate::geometry::Path;
use crate::segment::Mark;
use takt_base::Code;

/// Largest distance of the moves from the curve.
pub const TOLERANCE_MM: f64 = 0.001;
/// Pieces that each span of the knots has at least, so that no symmetry hides a bend.
const PIECES: u32 = 4;
/// How often a piece is halved.
const HALVINGS: u32 = 12;

impl RunReader {
    pub(super) fn nurbs(&mut self, mark: Mark, nurbs: &Nurbs, emit: Emit) -> Result<(), RunError> {
        let (order, count) = (nurbs.order as usize, nurbs.points.len());
        let sound = nurbs.points.iter().all(|p| p.iter().all(|v| v.is_finite()) && p[2] > 0.0);
        if !(2..=32).contains(&order) || count < order || !sound {
            return Err(RunError { code: Code::BadValue, text: "the NURBS has too few points, or weights of 0".to_owned() });
        }
        let spans = count - order + 1;
        for span in 0..spans {
            for piece in 0..PIECES {
                let at = |k: u32| span as f64 + f64::from(k) / f64::from(PIECES);
                let (from, to) = (Sample::new(nurbs, at(piece), span), Sample::new(nurbs, at(piece + 1), span));
                self.piece(mark, nurbs, span, [from, to], HALVINGS, emit)?;
            }
        }
        Ok(())
    }

    fn piece(
        &mut self,
        mark: Mark,
        nurbs: &Nurbs,
        span: usize,
        [from, to]: [Sample; 2],
        halvings: u32,
        emit: Emit,
    ) -> Result<(), RunError> {
        let middle = Sample::new(nurbs, 0.5 * (from.t + to.t), span);
        if halvings > 0 && distance(middle.p, from.p, to.p) * self.unit_mm > TOLERANCE_MM {
            self.piece(mark, nurbs, span, [from, middle], halvings - 1, emit)?;
            return self.piece(mark, nurbs, span, [middle, to], halvings - 1, emit);
        }
        let end = self.machine(&Position { x: to.p[0], y: to.p[1], ..Position::default() });
        let mut path_end = self.position;
        (path_end[0], path_end[1]) = (end[0], end[1]);
        self.go(mark, Path::line(self.position, path_end), false, emit)
    }
}

/// A point of the curve.
#[derive(Clone, Copy)]
struct Sample {
    t: f64,
    p: [f64; 2],
}

impl Sample {
    fn new(nurbs: &Nurbs, t: f64, span: usize) -> Self {
        Self { t, p: point(nurbs, t, span) }
    }
}

/// De Boor's algorithm in homogeneous coordinates; knots 0 (`order` times), 1, 2, .., and the last one `order` times.
pub fn point(nurbs: &Nurbs, t: f64, span: usize) -> [f64; 2] {
    let order = nurbs.order as usize;
    let last = (nurbs.points.len() + 1 - order) as f64;
    let knot = |i: usize| (i as f64 - (order as f64 - 1.0)).clamp(0.0, last);
    let mut d: Vec<[f64; 3]> = nurbs.points[span..span + order].iter().map(|&[x, y, w]| [x * w, y * w, w]).collect();
    for level in 1..order {
        for i in (level..order).rev() {
            let (low, high) = (knot(span + i), knot(span + i + order - level));
            let share = if high > low { (t - low) / (high - low) } else { 0.0 };
            d[i] = std::array::from_fn(|k| d[i - 1][k] * (1.0 - share) + d[i][k] * share);
        }
    }
    let [x, y, w] = d[order - 1];
    [x / w, y / w]
}

/// Distance of `p` from the line through `a` and `b`, or from `a` if they are one point.
fn distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length = libm::hypot(dx, dy);
    if length == 0.0 {
        return libm::hypot(p[0] - a[0], p[1] - a[1]);
    }
    ((p[0] - a[0]) * dy - (p[1] - a[1]) * dx).abs() / length
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quarter circle is a NURBS of order 3 with the weights 1, cos 45, 1: every point has the radius.
    #[test]
    fn quarter_circle() {
        let w = std::f64::consts::FRAC_1_SQRT_2;
        let nurbs = Nurbs { order: 3, points: vec![[10.0, 0.0, 1.0], [10.0, 10.0, w], [0.0, 10.0, 1.0]] };
        for k in 0..=100 {
            let [x, y] = point(&nurbs, f64::from(k) / 100.0, 0);
            assert!((libm::hypot(x, y) - 10.0).abs() < 1e-12, "{x} {y}");
        }
        assert_eq!((point(&nurbs, 0.0, 0), point(&nurbs, 1.0, 0)), ([10.0, 0.0], [0.0, 10.0]));
    }

    /// A cubic with equal weights and 4 points is Bezier's: the middle is (p0 + 3 p1 + 3 p2 + p3) / 8.
    #[test]
    fn cubic() {
        let nurbs = Nurbs { order: 4, points: vec![[0.0, 0.0, 1.0], [8.0, 0.0, 1.0], [8.0, 8.0, 1.0], [0.0, 8.0, 1.0]] };
        assert_eq!(point(&nurbs, 0.5, 0), [6.0, 4.0]);
    }

    /// Spans meet: order 3 with 5 points has knots 0 0 0 1 2 3 3 3.
    #[test]
    fn spans_meet() {
        let nurbs =
            Nurbs { order: 3, points: vec![[0.0, 0.0, 1.0], [1.0, 2.0, 0.5], [3.0, 2.0, 2.0], [4.0, 0.0, 1.0], [6.0, 1.0, 1.0]] };
        for t in [1.0, 2.0] {
            let (left, right) = (point(&nurbs, t, t as usize - 1), point(&nurbs, t, t as usize));
            assert!((left[0] - right[0]).abs() < 1e-12 && (left[1] - right[1]).abs() < 1e-12, "{left:?} {right:?}");
        }
        // At a knot a quadratic without weights lies in the middle of its control points.
        let plain = Nurbs { order: 3, points: nurbs.points.iter().map(|p| [p[0], p[1], 1.0]).collect() };
        assert_eq!(point(&plain, 1.0, 1), [2.0, 2.0]);
    }
}
