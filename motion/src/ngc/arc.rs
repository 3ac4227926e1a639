//! Geometry of arcs: centre, radius, sweep, length, extent (CM-60..CM-63). Kernels of plain numbers: lengths in any one unit, angles in radians;
//! points are first and second coordinate of the plane.

use super::modal::{from_plane, in_plane};
use crate::canon::{Arc, Plane, Position};
use libm::{atan2, cos, hypot, sin};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A point in the plane of an arc.
pub type Point = [f64; 2];

/// An arc below both of these is a full turn: end and start are the same but for rounding. In radians, and in length units, so that a
/// short arc of a very large radius stays short.
const SAME_DIRECTION: f64 = 1e-6;
const SAME_PLACE: f64 = 1e-5;

/// Distance of `p` and `q`.
pub fn distance(p: Point, q: Point) -> f64 {
    let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
    (dx * dx + dy * dy).sqrt()
}

/// Centre of the arc of radius `r` from `start` to `end`; `r` > 0: at most half a turn, `r` < 0: at least half a turn (R1-57).
/// A radius that is too small by up to `slack` counts as half the chord. `None` if it is smaller, or if start and end are the same.
pub fn centre_by_radius(start: Point, end: Point, r: f64, counterclockwise: bool, slack: f64) -> Option<Point> {
    let chord = distance(start, end);
    let half = chord / 2.0;
    if half == 0.0 || r.abs() < half - slack {
        return None;
    }
    let height = (r * r - half * half).max(0.0).sqrt();
    let side = if (r > 0.0) == counterclockwise { height } else { -height };
    let (dx, dy) = (end[0] - start[0], end[1] - start[1]);
    Some([start[0] + dx / 2.0 - side * dy / chord, start[1] + dy / 2.0 + side * dx / chord])
}

/// Signed sweep of an arc with `rotation` turns; counterclockwise is positive. With N = |rotation|, (N-1)*360 < sweep <= N*360 degrees
/// (CM-61). `None` for rotation 0 with an end that is not the start (CM-62).
pub fn sweep(start: Point, end: Point, centre: Point, rotation: i32) -> Option<f64> {
    if rotation == 0 {
        return (start == end).then_some(0.0);
    }
    let (sx, sy) = (start[0] - centre[0], start[1] - centre[1]);
    let (ex, ey) = (end[0] - centre[0], end[1] - centre[1]);
    let ccw = atan2(sx * ey - sy * ex, sx * ex + sy * ey);
    let mut first = if rotation > 0 { ccw } else { -ccw };
    if first < 0.0 || (first < SAME_DIRECTION && first * hypot(sx, sy) < SAME_PLACE) {
        first += TAU;
    }
    let magnitude = first.min(TAU) + f64::from(rotation.unsigned_abs() - 1) * TAU;
    Some(if rotation > 0 { magnitude } else { -magnitude })
}

/// An arc with all that its drawing and length need.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Sweep {
    /// Plane.
    pub plane: Plane,
    /// Start, all axes.
    pub from: Position,
    /// End, all axes.
    pub to: Position,
    /// Centre in the plane.
    pub centre: Point,
    /// Radius at the start.
    pub radius: f64,
    /// Radius at the end: the same within the tolerance of the interpreter.
    pub end_radius: f64,
    /// Signed, counterclockwise is positive. Radians.
    pub sweep: f64,
}

impl Sweep {
    /// The arc that `ARC_FEED` asks for from `from`; `None` if rotation is 0 and the end moved (CM-62).
    pub fn new(plane: Plane, from: Position, arc: &Arc) -> Option<Self> {
        let rotary = Position { a: arc.a, b: arc.b, c: arc.c, ..Position::default() };
        let to = from_plane([arc.first_end, arc.second_end, arc.axis_end_point], plane, rotary);
        let (start, end) = (flat(from, plane), flat(to, plane));
        let centre = [arc.first_axis, arc.second_axis];
        let sweep = sweep(start, end, centre, arc.rotation)?;
        Some(Sweep { plane, from, to, centre, radius: distance(centre, start), end_radius: distance(centre, end), sweep })
    }

    /// Length along the helix (CM-48).
    pub fn length(&self) -> f64 {
        let axial = in_plane(self.to, self.plane)[2] - in_plane(self.from, self.plane)[2];
        hypot((self.radius + self.end_radius) / 2.0 * self.sweep, axial)
    }

    /// The point at share `t` of the sweep, 0 to 1. Start and end are exact; a difference of the radii is spread evenly.
    pub fn at(&self, t: f64) -> Position {
        if t <= 0.0 || t >= 1.0 {
            return if t <= 0.0 { self.from } else { self.to };
        }
        let mix = |p: f64, q: f64| p + (q - p) * t;
        let start = flat(self.from, self.plane);
        let angle = atan2(start[1] - self.centre[1], start[0] - self.centre[0]) + self.sweep * t;
        let r = mix(self.radius, self.end_radius);
        let third = mix(in_plane(self.from, self.plane)[2], in_plane(self.to, self.plane)[2]);
        let rotary = Position {
            a: mix(self.from.a, self.to.a),
            b: mix(self.from.b, self.to.b),
            c: mix(self.from.c, self.to.c),
            ..self.to
        };
        from_plane([self.centre[0] + r * cos(angle), self.centre[1] + r * sin(angle), third], self.plane, rotary)
    }

    /// Start, end and the places where a coordinate of the plane turns round: the corners of the extent lie on these.
    pub fn extremes(&self) -> Vec<Position> {
        let start = flat(self.from, self.plane);
        let first = atan2(start[1] - self.centre[1], start[0] - self.centre[0]);
        let turning = (0..4).filter_map(|quarter| self.share_of(f64::from(quarter) * FRAC_PI_2 - first));
        let inner: Vec<Position> = turning.map(|t| self.at(t)).collect();
        [self.from, self.to].into_iter().chain(inner).collect()
    }

    /// Share of the sweep at which the arc first has turned by `angle` modulo a turn; `None` if it never does.
    fn share_of(&self, angle: f64) -> Option<f64> {
        let turn = angle * self.sweep.signum();
        let turn = turn - (turn / TAU).floor() * TAU;
        (turn < self.sweep.abs()).then(|| turn / self.sweep.abs())
    }

    /// `n` + 1 points along the arc, start and end among them.
    pub fn points(&self, n: u32) -> impl Iterator<Item = Position> {
        let n = n.max(1);
        (0..=n).map(move |i| self.at(f64::from(i) / f64::from(n)))
    }
}

fn flat(p: Position, plane: Plane) -> Point {
    let [first, second, _] = in_plane(p, plane);
    [first, second]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn degrees(start: Point, end: Point, rotation: i32) -> Option<f64> {
        sweep(start, end, [0.0, 0.0], rotation).map(f64::to_degrees)
    }

    fn near(a: f64, b: f64) -> bool {
        (a - b).abs() < 1e-9 * b.abs().max(1.0)
    }

    /// CM-T7, CM-T8
    #[test]
    fn turns() {
        for (rotation, want) in [(1, 90.0), (-1, -270.0), (2, 450.0), (-2, -630.0)] {
            assert!(near(degrees([1.0, 0.0], [0.0, 1.0], rotation).unwrap(), want), "{rotation}");
        }
        for (rotation, want) in [(1, 360.0), (3, 1080.0), (-1, -360.0)] {
            assert!(near(degrees([1.0, 0.0], [1.0, 0.0], rotation).unwrap(), want), "{rotation}");
        }
        assert!(near(degrees([1.0, 0.0], [1.0, 1e-12], 1).unwrap(), 360.0));
        assert!(near(degrees([1.0, 0.0], [1.0, -1e-12], -1).unwrap(), -360.0));
        assert!(near(degrees([1.0, 0.0], [1.0, -1e-12], 1).unwrap(), 360.0));
        assert!(degrees([1e6, 0.0], [1e6, 0.5], 1).unwrap() < 1e-3);
    }

    /// CM-T9: ARC_FEED(0, 1, 0, 0, 1, 0) in XZ from Z1 X0 turns 90 degrees from +Z to +X.
    #[test]
    fn plane_xz_counts_z_first() {
        let from = Position { z: 1.0, ..Position::default() };
        let arc = Arc {
            first_end: 0.0,
            second_end: 1.0,
            first_axis: 0.0,
            second_axis: 0.0,
            rotation: 1,
            axis_end_point: 0.0,
            a: 0.0,
            b: 0.0,
            c: 0.0,
        };
        let sweep = Sweep::new(Plane::Xz, from, &arc).unwrap();
        assert!(near(sweep.sweep.to_degrees(), 90.0));
        assert_eq!(sweep.to, Position { x: 1.0, ..Position::default() });
        let middle = sweep.at(0.5);
        assert!(near(middle.x, 0.5f64.sqrt()) && near(middle.z, 0.5f64.sqrt()));
    }

    /// CM-T10
    #[test]
    fn rotation_0_must_not_move() {
        assert_eq!(sweep([1.0, 0.0], [0.0, 1.0], [0.0, 0.0], 0), None);
        assert_eq!(sweep([1.0, 0.0], [1.0, 0.0], [0.0, 0.0], 0), Some(0.0));
    }

    /// CM-T3: the length of a helix counts along the helix.
    #[test]
    fn helix_length() {
        let from = Position { x: 10.0, ..Position::default() };
        let arc = Arc {
            first_end: 10.0,
            second_end: 0.0,
            first_axis: 0.0,
            second_axis: 0.0,
            rotation: 1,
            axis_end_point: 20.0,
            a: 0.0,
            b: 0.0,
            c: 0.0,
        };
        assert!((Sweep::new(Plane::Xy, from, &arc).unwrap().length() - 65.938).abs() < 5e-4);
    }

    /// Report A.3: the R format is not stable near half a turn.
    #[test]
    fn radius_format() {
        let centre = |end, r, ccw| centre_by_radius([0.0, 0.0], end, r, ccw, 0.00127);
        assert_eq!(centre([2.0, 0.0], 1.0, false), Some([1.0, 0.0]));
        let moved = centre([1.9999, 0.0], 1.0, false).unwrap();
        assert!((moved[1] + 0.01).abs() < 1e-4, "{moved:?}");
        let full = centre([0.0002, 0.0], -1.0, false).unwrap();
        assert!(near(full[0], 0.0001) && (full[1] - 1.0).abs() < 1e-8);
        let full = centre([0.0001, 0.0001], -1.0, false).unwrap();
        assert!((full[0] + 0.5f64.sqrt()).abs() < 1e-4 && (full[1] - 0.5f64.sqrt()).abs() < 1e-4, "{full:?}");
        assert_eq!(centre([2.0, 0.0], 0.99, false), None);
        assert_eq!(centre([0.0, 0.0], 1.0, false), None);
    }

    #[test]
    fn extremes_hold_the_extent() {
        let from = Position { x: 1.0, ..Position::default() };
        let arc = Arc {
            first_end: 0.0,
            second_end: 1.0,
            first_axis: 0.0,
            second_axis: 0.0,
            rotation: -1,
            axis_end_point: 0.0,
            a: 0.0,
            b: 0.0,
            c: 0.0,
        };
        let points = Sweep::new(Plane::Xy, from, &arc).unwrap().extremes();
        assert!(near(points.iter().map(|p| p.x).fold(0.0, f64::min), -1.0));
        assert!(near(points.iter().map(|p| p.y).fold(0.0, f64::min), -1.0));
    }
}
