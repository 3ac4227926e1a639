//! Lines and arcs of a tool path as exact geometry: length, point, tangent and curvature by arc length.
//! Runs: both. Invariant: `at(0)` is the start and `at(length)` the end, bit for bit.
//! From: CM-20, CM-21, CM-41..CM-43, CM-48, CM-60..CM-62.

use std::f64::consts::TAU;

/// Coordinates of a path: X, Y, Z in millimetres, A, B, C in degrees.
pub const AXES: usize = 6;
/// A point in machine coordinates.
pub type Point = [f64; AXES];

/// What a path looks like.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Shape {
    /// Straight: every axis at an equal share of its move (CM-29).
    Line,
    /// Circle or helix.
    Arc(Arc),
}

/// The circular part of an arc. The axes outside of the plane go along at a constant rate.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Arc {
    /// First axis of the plane, an index into [`Point`].
    pub first: usize,
    /// Second axis of the plane.
    pub second: usize,
    /// Centre.
    pub centre: [f64; 2],
    /// Radius at the start.
    pub radius: f64,
    /// Radius at the end: the same but for the tolerance of the part program.
    pub radius_end: f64,
    /// Angle of the start point in radians.
    pub angle: f64,
    /// Angle swept in radians, positive from first to second axis.
    pub sweep: f64,
}

/// One element of a tool path.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Path {
    /// First point.
    pub start: Point,
    /// Last point.
    pub end: Point,
    /// Path length: millimetres over X, Y, Z; degrees if only rotary axes move (CM-41..CM-43).
    pub length: f64,
    /// Between them.
    pub shape: Shape,
}

impl Path {
    /// The straight path from `start` to `end`.
    pub fn line(start: Point, end: Point) -> Self {
        let linear = norm3(&start, &end);
        let length = if linear > 0.0 { linear } else { (3..AXES).map(|i| square(end[i] - start[i])).sum::<f64>().sqrt() };
        Self { start, end, length, shape: Shape::Line }
    }

    /// The arc from `start` to `end` round `centre` in the plane of axes `first` and `second`. `turns` as CM-61: positive from
    /// first to second axis, (|turns| - 1) * 360 < sweep <= |turns| * 360 degrees; 0 gives the straight path (CM-62).
    pub fn arc(start: Point, end: Point, first: usize, second: usize, centre: [f64; 2], turns: i32) -> Self {
        let polar = |p: &Point| {
            let (x, y) = (p[first] - centre[0], p[second] - centre[1]);
            (libm::hypot(x, y), libm::atan2(y, x))
        };
        let ((radius, angle), (radius_end, angle_end)) = (polar(&start), polar(&end));
        if turns == 0 || radius == 0.0 {
            return Self::line(start, end);
        }
        let sweep = sweep(angle_end - angle, turns);
        let mean = 0.5 * (radius + radius_end);
        let third = (0..3).filter(|&i| i != first && i != second).map(|i| end[i] - start[i]).next().unwrap_or(0.0);
        let length = libm::hypot(mean * sweep, third);
        Self { start, end, length, shape: Shape::Arc(Arc { first, second, centre, radius, radius_end, angle, sweep }) }
    }

    /// The point at arc length `s`.
    pub fn at(&self, s: f64) -> Point {
        if s <= 0.0 {
            return self.start;
        }
        if s >= self.length {
            return self.end;
        }
        let u = s / self.length;
        let mut p: Point = std::array::from_fn(|i| self.start[i] + (self.end[i] - self.start[i]) * u);
        if let Shape::Arc(arc) = &self.shape {
            let (sin, cos) = libm::sincos(arc.angle + arc.sweep * u);
            let r = arc.radius + (arc.radius_end - arc.radius) * u;
            p[arc.first] = arc.centre[0] + r * cos;
            p[arc.second] = arc.centre[1] + r * sin;
        }
        p
    }

    /// Derivative of the point by arc length: the unit tangent over X, Y, Z, and the rates of the rotary axes.
    pub fn tangent(&self, s: f64) -> Point {
        let mut t: Point = std::array::from_fn(|i| (self.end[i] - self.start[i]) / self.length);
        if let Shape::Arc(arc) = &self.shape {
            let (sin, cos) = libm::sincos(arc.angle + arc.sweep * (s / self.length).clamp(0.0, 1.0));
            let (r, dr) = (arc.radius, (arc.radius_end - arc.radius) / self.length);
            let w = arc.sweep / self.length;
            t[arc.first] = -r * w * sin + dr * cos;
            t[arc.second] = r * w * cos + dr * sin;
        }
        t
    }

    /// Curvature in 1/mm: 0 for lines, constant on an arc.
    pub fn curvature(&self) -> f64 {
        match &self.shape {
            Shape::Line => 0.0,
            Shape::Arc(arc) => arc.radius.max(arc.radius_end) * square(arc.sweep / self.length),
        }
    }

    /// Distance of `p` from the nearest point of the path over X, Y, Z (for a rotary path: over all axes).
    pub fn distance_to(&self, p: &Point) -> f64 {
        let u = match &self.shape {
            Shape::Line => self.nearest_on_line(p),
            Shape::Arc(arc) => self.nearest_on_arc(arc, p),
        };
        norm3(p, &self.at(u * self.length))
    }

    fn nearest_on_line(&self, p: &Point) -> f64 {
        let d: [f64; 3] = std::array::from_fn(|i| self.end[i] - self.start[i]);
        let dd = d.iter().map(|d| d * d).sum::<f64>();
        if dd == 0.0 {
            return 0.0;
        }
        ((0..3).map(|i| d[i] * (p[i] - self.start[i])).sum::<f64>() / dd).clamp(0.0, 1.0)
    }

    /// Share of the sweep at the angle of `p`, in the turn that fits its third coordinate.
    fn nearest_on_arc(&self, arc: &Arc, p: &Point) -> f64 {
        let angle = libm::atan2(p[arc.second] - arc.centre[1], p[arc.first] - arc.centre[0]);
        let third = 3 - arc.first - arc.second;
        let rise = self.end[third] - self.start[third];
        let near = if rise.abs() > 1e-9 { ((p[third] - self.start[third]) / rise).clamp(0.0, 1.0) } else { 0.5 };
        let want = arc.sweep * near;
        let off = angle - arc.angle;
        ((off + TAU * ((want - off) / TAU).round()) / arc.sweep).clamp(0.0, 1.0)
    }

    /// Smallest and largest value of axis `i` on the path.
    pub fn bounds(&self, i: usize) -> (f64, f64) {
        let (mut low, mut high) = (self.start[i].min(self.end[i]), self.start[i].max(self.end[i]));
        if let Shape::Arc(arc) = &self.shape {
            let (centre, quarter) = if i == arc.first {
                (arc.centre[0], 0.0)
            } else if i == arc.second {
                (arc.centre[1], TAU / 4.0)
            } else {
                return (low, high);
            };
            if arc.passes(quarter) {
                high = high.max(centre + arc.radius);
            }
            if arc.passes(quarter + TAU / 2.0) {
                low = low.min(centre - arc.radius);
            }
        }
        (low, high)
    }
}

impl Arc {
    /// True if the arc crosses this angle strictly inside.
    fn passes(&self, angle: f64) -> bool {
        let off = (angle - self.angle) * self.sweep.signum();
        let off = off - TAU * (off / TAU).floor();
        off > 1e-9 && off < self.sweep.abs() - 1e-9
    }
}

/// CM-61: the sweep for an angle difference and a count of turns. A difference of less than a nanoradian is a full turn.
fn sweep(difference: f64, turns: i32) -> f64 {
    let sense = f64::from(turns.signum());
    let mut part = difference * sense;
    part -= TAU * (part / TAU).floor();
    if !(1e-9..=TAU - 1e-9).contains(&part) {
        part = TAU;
    }
    sense * (part + TAU * (f64::from(turns.unsigned_abs()) - 1.0))
}

/// Distance over X, Y, Z.
pub fn norm3(a: &Point, b: &Point) -> f64 {
    (0..3).map(|i| square(a[i] - b[i])).sum::<f64>().sqrt()
}

fn square(x: f64) -> f64 {
    x * x
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64, z: f64) -> Point {
        [x, y, z, 0.0, 0.0, 0.0]
    }

    /// CM-T7, CM-T8
    #[test]
    fn sweeps_of_arcs() {
        for (end, turns, degrees) in [
            (p(0., 1., 0.), 1, 90.0),
            (p(0., 1., 0.), -1, -270.0),
            (p(0., 1., 0.), 2, 450.0),
            (p(0., 1., 0.), -2, -630.0),
            (p(1., 0., 0.), 1, 360.0),
            (p(1., 0., 0.), 3, 1080.0),
        ] {
            let path = Path::arc(p(1., 0., 0.), end, 0, 1, [0.0, 0.0], turns);
            let Shape::Arc(arc) = path.shape else { panic!("an arc") };
            assert!((arc.sweep.to_degrees() - degrees).abs() < 1e-9, "{degrees}: {}", arc.sweep.to_degrees());
        }
    }

    /// CM-T3: the feed refers to the distance along the helix.
    #[test]
    fn helix_length() {
        let path = Path::arc(p(10., 0., 0.), p(10., 0., 20.), 0, 1, [0.0, 0.0], 1);
        assert!((path.length - 65.938).abs() < 1e-3);
        assert!((path.at(path.length / 4.0)[2] - 5.0).abs() < 1e-12);
        assert!((path.at(path.length / 4.0)[1] - 10.0).abs() < 1e-12);
    }

    /// CM-T1, CM-T2
    #[test]
    fn rotary_axes_go_along() {
        let turn = Path::line([0.0; 6], [0., 0., 0., 30., 40., 0.]);
        assert_eq!(turn.length, 50.0);
        let both = Path::line([0.0; 6], [3., 4., 0., 0., 0., 90.]);
        assert_eq!((both.length, both.tangent(0.0)[5]), (5.0, 18.0));
    }

    #[test]
    fn nearest_point_and_bounds() {
        let arc = Path::arc(p(72., 90., 0.), p(88., 106., 0.), 0, 1, [72., 106.], 1);
        assert!((arc.distance_to(&p(72., 106., 0.)) - 16.0).abs() < 1e-9);
        assert!(arc.distance_to(&arc.at(7.0)) < 1e-12);
        assert_eq!(arc.bounds(1), (90.0, 106.0));
        let full = Path::arc(p(1., 0., 0.), p(1., 0., 0.), 0, 1, [0., 0.], -1);
        assert_eq!((full.bounds(0), full.bounds(1)), ((-1.0, 1.0), (-1.0, 1.0)));
        let line = Path::line(p(0., 0., 0.), p(10., 0., 0.));
        assert!((line.distance_to(&p(5., 3., 4.)) - 5.0).abs() < 1e-12);
    }
}
