//! Geometry of compensation in the plane: curves beside the contour and where they meet. Kernels of plain numbers in any one length unit;
//! a radius above zero lies to the left of the direction.

use crate::ngc::arc::{Point, distance};
use libm::atan2;
use std::f64::consts::{PI, TAU};

/// A line or an arc.
#[derive(Clone, Copy, PartialEq, Debug)]
#[allow(missing_docs)]
pub enum Curve {
    Line { start: Point, end: Point },
    Arc { start: Point, end: Point, centre: Point, counterclockwise: bool },
}

impl Curve {
    /// Where it starts.
    pub fn start(&self) -> Point {
        match self {
            Curve::Line { start, .. } | Curve::Arc { start, .. } => *start,
        }
    }
    /// Where it ends.
    pub fn end(&self) -> Point {
        match self {
            Curve::Line { end, .. } | Curve::Arc { end, .. } => *end,
        }
    }
    /// Centre of an arc; of a line, its start.
    fn center_or_start(&self) -> Point {
        match self {
            Curve::Line { start, .. } => *start,
            Curve::Arc { centre, .. } => *centre,
        }
    }
    /// Starts it elsewhere on itself.
    pub fn start_at(&mut self, p: Point) {
        match self {
            Curve::Line { start, .. } | Curve::Arc { start, .. } => *start = p,
        }
    }
    /// Ends it elsewhere on itself.
    pub fn end_at(&mut self, p: Point) {
        match self {
            Curve::Line { end, .. } | Curve::Arc { end, .. } => *end = p,
        }
    }
    /// Unit tangent at the start.
    pub fn direction_at_start(&self) -> Point {
        self.direction(self.start())
    }
    /// Unit tangent at the end.
    pub fn direction_at_end(&self) -> Point {
        self.direction(self.end())
    }

    fn direction(&self, at: Point) -> Point {
        match self {
            Curve::Line { start, end } => unit(minus(*end, *start)),
            Curve::Arc { centre, counterclockwise, .. } => {
                let out = unit(minus(at, *centre));
                if *counterclockwise { left(out) } else { scale(left(out), -1.0) }
            }
        }
    }

    /// True if `p` lies on the curve's way from its start to its end, or at its start.
    pub fn reaches(&self, p: Point) -> bool {
        match self {
            Curve::Line { start, .. } => dot(minus(p, *start), self.direction_at_start()) >= -1e-9,
            Curve::Arc { start, end, centre, counterclockwise } => {
                let swept = |to: Point| {
                    let turn = angle(minus(*start, *centre), minus(to, *centre));
                    let turn = if *counterclockwise { turn } else { -turn };
                    if turn < 0.0 { turn + TAU } else { turn }
                };
                let whole = swept(*end);
                swept(p) <= if whole < 1e-9 { TAU } else { whole } + 1e-9
            }
        }
    }
}

/// The curve beside `curve` at `radius`, whose directions at start and end are known; `None` if an arc would vanish.
pub fn offset(curve: &Curve, radius: f64, [starts, ends]: [Point; 2]) -> Option<Curve> {
    let beside = |p: Point, direction: Point| add(p, scale(left(direction), radius));
    let (start, end) = (beside(curve.start(), starts), beside(curve.end(), ends));
    match *curve {
        Curve::Line { .. } => Some(Curve::Line { start, end }),
        Curve::Arc { centre, counterclockwise, start: from, .. } => {
            let inside = (radius > 0.0) == counterclockwise;
            let vanishes = inside && distance(from, centre) <= radius.abs() * (1.0 + 1e-9);
            (!vanishes).then_some(Curve::Arc { start, end, centre, counterclockwise })
        }
    }
}

/// The way from beside nothing to beside the contour: ends at `radius` beside the end of `curve`; `None` if it is too short.
pub fn entry(curve: &Curve, radius: f64) -> Option<Curve> {
    let direction = curve.direction_at_end();
    let end = add(curve.end(), scale(left(direction), radius));
    let start = curve.start();
    match *curve {
        Curve::Line { .. } => (distance(start, curve.end()) > radius.abs()).then_some(Curve::Line { start, end }),
        Curve::Arc { counterclockwise, .. } => {
            // An arc that ends in the same direction: its centre is on the normal there, equally far from both ends.
            let (normal, chord) = (left(direction), minus(end, start));
            let along = dot(chord, normal);
            if distance(curve.center_or_start(), start) <= radius.abs() {
                return None;
            }
            let t = -dot(chord, chord) / (2.0 * along);
            let centre = add(end, scale(normal, t));
            let turns_left = t > 0.0;
            (along != 0.0 && t.is_finite() && turns_left == counterclockwise).then_some(Curve::Arc {
                start,
                end,
                centre,
                counterclockwise,
            })
        }
    }
}

/// Where two curves meet, near the end of the first and where it comes by.
pub fn intersection(a: &Curve, b: &Curve) -> Option<Point> {
    let near = a;
    match (a, b) {
        (Curve::Line { .. }, Curve::Line { .. }) => line_line(a, b),
        (Curve::Line { .. }, Curve::Arc { centre, start, .. }) => line_circle(a, *centre, distance(*centre, *start), near),
        (Curve::Arc { centre, end, .. }, Curve::Line { .. }) => line_circle(b, *centre, distance(*centre, *end), near),
        (Curve::Arc { centre: p, end, .. }, Curve::Arc { centre: q, start, .. }) => {
            circle_circle(*p, distance(*p, *end), *q, distance(*q, *start), near)
        }
    }
}

fn line_line(a: &Curve, b: &Curve) -> Option<Point> {
    let (d, e) = (a.direction_at_end(), b.direction_at_start());
    let cross = cross(d, e);
    if cross.abs() < 1e-12 {
        return None;
    }
    let gap = minus(b.start(), a.end());
    let t = (gap[0] * e[1] - gap[1] * e[0]) / cross;
    Some(add(a.end(), scale(d, t)))
}

fn line_circle(line: &Curve, centre: Point, radius: f64, near: &Curve) -> Option<Point> {
    let (start, d) = (line.start(), line.direction_at_start());
    let along = dot(minus(centre, start), d);
    let foot = add(start, scale(d, along));
    let off = distance(foot, centre);
    let half = (radius * radius - off * off).sqrt();
    nearest([add(foot, scale(d, half)), add(foot, scale(d, -half))], near)
}

fn circle_circle(p: Point, r: f64, q: Point, s: f64, near: &Curve) -> Option<Point> {
    let d = distance(p, q);
    let along = (d * d + r * r - s * s) / (2.0 * d);
    let half = (r * r - along * along).sqrt();
    let e = scale(minus(q, p), 1.0 / d);
    let foot = add(p, scale(e, along));
    nearest([add(foot, scale(left(e), half)), add(foot, scale(left(e), -half))], near)
}

/// The nearer one to the end of `near`, or else the one that it reaches; `None` if they are no points.
fn nearest([a, b]: [Point; 2], near: &Curve) -> Option<Point> {
    if !a.iter().chain(&b).all(|v| v.is_finite()) {
        return None;
    }
    let (far_a, far_b) = (distance(a, near.end()), distance(b, near.end()));
    let tie = (far_a - far_b).abs() < 1e-9 * far_a;
    let takes_a = if tie { near.reaches(a) } else { far_a < far_b };
    Some(if takes_a { a } else { b })
}

/// Angle from one direction to the other, -PI to PI; to the left is positive.
pub fn angle(from: Point, to: Point) -> f64 {
    let angle = atan2(from[0] * to[1] - from[1] * to[0], dot(from, to));
    if angle > PI { angle - TAU } else { angle }
}

/// A quarter turn to the left.
pub fn left([x, y]: Point) -> Point {
    [-y, x]
}

pub(super) fn add(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1]]
}

pub(super) fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

pub(super) fn scale(a: Point, k: f64) -> Point {
    [a[0] * k, a[1] * k]
}

pub(super) fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub(super) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn unit(a: Point) -> Point {
    let length = dot(a, a).sqrt();
    if length > 0.0 { scale(a, 1.0 / length) } else { [1.0, 0.0] }
}
