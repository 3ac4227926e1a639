//! G6.2: a NURBS by control points, weights and knots, as chords within a tolerance (R1-61, R1-91, O-11).

use super::Machine;
use super::block::Block;
use super::calls::bad;
use super::kernel::Io;
use super::moves::{Seg, Shape};
use crate::canon::Position;
use crate::ngc::execute::Done;
use crate::ngc::request::{missing, not_now};
use takt_base::{Code, Diag, Span};

/// Control points that a curve may have.
const POINTS_MAX: usize = 100_000;
/// Chords that it may become.
const CHORDS_MAX: usize = 200_000;
/// How often a span may be halved.
const DEPTH_MAX: u32 = 12;
/// Largest order.
const ORDER_MAX: usize = 10;

/// A curve in the making.
#[derive(Clone, Debug)]
pub struct Curve {
    order: usize,
    /// x, y, z, weight.
    points: Vec<[f64; 4]>,
    knots: Vec<f64>,
    at: Span,
}

impl Machine {
    /// One block: `G6.2 P4 K0 X Y Z R1`, then `K X Y Z R`, at the end K alone.
    pub(super) fn nurbs_block(&mut self, b: &Block, io: &mut Io) -> Done {
        if !self.names_axis(b) && !b.any("K") {
            return Ok(());
        }
        self.free(b.span, "a NURBS", io)?;
        if self.nurbs.is_none() {
            let order = Self::whole_word(b, b'P', "write the order: P3 or P4")?.map_or(3, |p| p as usize);
            if !(2..=ORDER_MAX).contains(&order) {
                return Err(Box::new(Diag::new(Code::BadValue, b.span, "no order of a NURBS").help("write P2 to P10")));
            }
            self.nurbs = Some(Curve { order, points: Vec::new(), knots: Vec::new(), at: b.span });
        }
        let Some(k) = b.take(b'K') else {
            return Err(Box::new(missing(b.span, "K").help("each control point has its knot K")));
        };
        let weight = b.take(b'R').map_or(1.0, |w| w.value);
        if weight <= 0.0 || weight > 1e9 {
            return Err(bad(k, "no weight in the block", "write R above 0"));
        }
        let point = if self.names_axis(b) { Some(self.target(b, io)?) } else { None };
        let Some(curve) = &mut self.nurbs else { return Ok(()) };
        if curve.knots.last().is_some_and(|&last| k.value < last) {
            return Err(bad(k, "knots do not go back", "write a knot that is not smaller than the one before"));
        }
        if curve.knots.len() >= 2 * POINTS_MAX {
            return Err(bad(k, "more than 100000 control points", "write several curves"));
        }
        curve.knots.push(k.value);
        if let Some(p) = point {
            curve.points.push([p.x, p.y, p.z, weight]);
            self.modes.at = p;
        }
        Ok(())
    }

    /// The curve is complete: its moves go out.
    pub(super) fn end_nurbs(&mut self, io: &mut Io) {
        if let Some(curve) = self.nurbs.take() {
            let done = self.draw(&curve, io);
            self.done(done, io);
        }
    }

    fn draw(&mut self, curve: &Curve, io: &mut Io) -> Done {
        let (n, order) = (curve.points.len(), curve.order);
        if n < order || curve.knots.len() != n + order {
            let label = format!("{n} control points and {} knots", curve.knots.len());
            let help = format!("a NURBS of order {order} has at least {order} control points, and {order} knots more than those");
            return Err(Box::new(Diag::new(Code::BadValue, curve.at, label).help(help)));
        }
        let end = self.modes.at;
        let start = self.modes.transform.undo(io.state.modal.position);
        let tolerance = self.modes.settings.chord_tolerance_mm / io.state.unit();
        let first = curve.point(curve.knots[order - 1], order - 1);
        if apart(first, [start.x, start.y, start.z]) > 10.0 * tolerance {
            let help = "the first control point is where the tool stands";
            return Err(Box::new(not_now(curve.at, "the curve does not start where the tool is", help)));
        }
        let (mut from, mut chords) = (start, 0);
        for span in order - 1..n {
            let (t, u) = (curve.knots[span], curve.knots[span + 1]);
            if u <= t {
                continue;
            }
            let mut points = Vec::new();
            // A span may turn to and fro: parts of it are looked at one by one.
            let parts = 2 * order as u32;
            for part in 0..parts {
                let [a, b] = [part, part + 1].map(|p| t + (u - t) * f64::from(p) / f64::from(parts));
                curve.halve([a, b], span, tolerance, DEPTH_MAX, &mut points);
            }
            chords += points.len();
            if chords > CHORDS_MAX {
                let help = "set a larger chord_tolerance, or write several curves";
                return Err(Box::new(Diag::new(Code::BadValue, curve.at, "more than 200000 chords").help(help)));
            }
            for [x, y, z] in points {
                let to = Position { x, y, z, ..end };
                self.deliver(Seg { from, to, shape: Shape::Line, at: curve.at }, io)?;
                from = to;
            }
        }
        self.modes.at = from;
        Ok(())
    }
}

impl Curve {
    /// Points behind that of `a` up to that of `b`, near enough to each other.
    fn halve(&self, [a, b]: [f64; 2], span: usize, tolerance: f64, depth: u32, out: &mut Vec<[f64; 3]>) {
        let m = (a + b) / 2.0;
        let (p, q, middle) = (self.point(a, span), self.point(b, span), self.point(m, span));
        let chord = std::array::from_fn(|i| (p[i] + q[i]) / 2.0);
        if depth > 0 && apart(middle, chord) > tolerance {
            self.halve([a, m], span, tolerance, depth - 1, out);
            self.halve([m, b], span, tolerance, depth - 1, out);
        } else {
            out.push(q);
        }
    }

    /// De Boor's algorithm in homogeneous coordinates; `span` is the index of the knot at or before `t`.
    fn point(&self, t: f64, span: usize) -> [f64; 3] {
        let degree = self.order - 1;
        let mut d = [[0.0; 4]; ORDER_MAX];
        for (j, place) in d.iter_mut().enumerate().take(self.order) {
            let [x, y, z, w] = self.points[(span - degree + j).min(self.points.len() - 1)];
            *place = [x * w, y * w, z * w, w];
        }
        for r in 1..=degree {
            for j in (r..=degree).rev() {
                let low = self.knots[span - degree + j];
                let high = self.knots[(j + 1 + span - r).min(self.knots.len() - 1)];
                let share = if high > low { (t - low) / (high - low) } else { 0.0 };
                d[j] = std::array::from_fn(|i| (1.0 - share) * d[j - 1][i] + share * d[j][i]);
            }
        }
        let [x, y, z, w] = d[degree];
        [x / w, y / w, z / w]
    }
}

fn apart(p: [f64; 3], q: [f64; 3]) -> f64 {
    p.iter().zip(q).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}
