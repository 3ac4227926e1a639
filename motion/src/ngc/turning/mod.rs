//! Geometry of roughing: a contour and a depth of cut become passes (R2-180..R2-184). Kernels of plain numbers in any one length unit.
//! Points are [along, across]: a pass is cut along at a level across. Facing swaps the two. Runs: background.

mod passes;
pub mod walk;

pub use passes::{Pass, levels, passes};

use super::arc::{self, Point};
use super::comp::corner::Curve;
use crate::canon::{Arc, Plane, Position};

/// Points that a contour may have as chords.
pub const POINTS_MAX: usize = 200_000;

/// The contour as a chain of points whose chords leave it by `tolerance` at most; `None` if there are too many.
pub fn flattened(contour: &[Curve], tolerance: f64) -> Option<Vec<Point>> {
    let mut points = Vec::new();
    for curve in contour {
        if points.is_empty() {
            points.push(curve.start());
        }
        match *curve {
            Curve::Line { end, .. } => points.push(end),
            Curve::Arc { start, end, centre, counterclockwise } => {
                let at = |p: Point| Position { x: p[0], y: p[1], ..Position::default() };
                let arc = Arc {
                    first_end: end[0],
                    second_end: end[1],
                    first_axis: centre[0],
                    second_axis: centre[1],
                    rotation: if counterclockwise { 1 } else { -1 },
                    axis_end_point: 0.0,
                    a: 0.0,
                    b: 0.0,
                    c: 0.0,
                };
                let sweep = arc::Sweep::new(Plane::Xy, at(start), &arc)?;
                let step = 2.0 * libm::acos((1.0 - tolerance / sweep.radius.max(tolerance)).clamp(-1.0, 1.0));
                let n = (sweep.sweep.abs() / step.max(1e-9)).ceil();
                if n > POINTS_MAX as f64 || points.len() + n as usize > POINTS_MAX {
                    return None;
                }
                points.extend(sweep.points((n as u32).max(1)).skip(1).map(|p| [p.x, p.y]));
            }
        }
    }
    Some(points)
}

/// The same with both coordinates exchanged: arcs turn the other way.
pub fn swapped(curve: &Curve) -> Curve {
    let swap = |p: Point| [p[1], p[0]];
    match *curve {
        Curve::Line { start, end } => Curve::Line { start: swap(start), end: swap(end) },
        Curve::Arc { start, end, centre, counterclockwise } => {
            Curve::Arc { start: swap(start), end: swap(end), centre: swap(centre), counterclockwise: !counterclockwise }
        }
    }
}

/// The same, moved.
pub fn shifted(curve: &Curve, [along, across]: Point) -> Curve {
    let add = |p: Point| [p[0] + along, p[1] + across];
    match *curve {
        Curve::Line { start, end } => Curve::Line { start: add(start), end: add(end) },
        Curve::Arc { start, end, centre, counterclockwise } => {
            Curve::Arc { start: add(start), end: add(end), centre: add(centre), counterclockwise }
        }
    }
}
