//! Path speed and acceleration from the limits of the axes.
//! Runs: background. Invariant: with these, every axis stays within its limits at every point of the path.
//! From: R1-157, R1-164. The feed that the book gives for arcs exceeds the limit of an axis; here the acceleration budget is split
//! between centripetal and tangential.

use crate::geometry::{AXES, Arc, Path, Point, Shape};

/// Limits of the axes of a channel by path coordinate; infinite where there is no axis.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct AxisLimits {
    /// Speed, mm/s or degrees/s.
    pub v: Point,
    /// Acceleration, mm/s2 or degrees/s2.
    pub a: Point,
}

impl AxisLimits {
    /// The same on every axis.
    pub fn uniform(v: f64, a: f64) -> Self {
        Self { v: [v; AXES], a: [a; AXES] }
    }
}

/// Limits along one path element.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PathLimits {
    /// Speed.
    pub v: f64,
    /// Acceleration and deceleration.
    pub a: f64,
}

/// Most of the acceleration that an arc may spend on its curvature. The rest, 0.6 by Pythagoras, accelerates along the path.
const CENTRIPETAL_SHARE: f64 = 0.8;

/// Limits of `path` at a programmed speed of `feed` mm/s, using the share `budget` of the accelerations.
pub fn path_limits(path: &Path, axes: &AxisLimits, feed: f64, budget: f64) -> PathLimits {
    let mut limits = PathLimits { v: feed, a: f64::INFINITY };
    let plane = match &path.shape {
        Shape::Arc(arc) => Some(arc),
        Shape::Line => None,
    };
    let rates = path.tangent(0.0);
    for i in (0..AXES).filter(|&i| plane.is_none_or(|arc| i != arc.first && i != arc.second)) {
        let rate = rates[i].abs();
        if rate > 0.0 {
            limits.v = limits.v.min(axes.v[i] / rate);
            limits.a = limits.a.min(axes.a[i] * budget / rate);
        }
    }
    plane.map_or(limits, |arc| in_plane(path, arc, axes, budget, limits))
}

fn in_plane(path: &Path, arc: &Arc, axes: &AxisLimits, budget: f64, rest: PathLimits) -> PathLimits {
    let (i, j) = (arc.first, arc.second);
    let turned = arc.radius.min(arc.radius_end) * arc.sweep.abs();
    // Start and end radius may differ by the tolerance of the part program: a spiral is a little faster than a circle.
    let slack = 1.0 / (1.0 + 3.0 * (arc.radius_end - arc.radius).abs() / turned);
    let a = axes.a[i].min(axes.a[j]) * budget * slack;
    let flat = arc.radius.max(arc.radius_end) * arc.sweep.abs() / path.length;
    let curvature = path.curvature();
    let v = rest.v.min(axes.v[i].min(axes.v[j]) * slack / flat).min((CENTRIPETAL_SHARE * a / curvature).sqrt());
    let centripetal = v * v * curvature;
    PathLimits { v, a: rest.a.min((a * a - centripetal * centripetal).max(0.0).sqrt() / flat) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// R1-164: the acceleration of both axes stays below the limit at every angle.
    #[test]
    fn budget_of_an_arc_holds_for_each_axis() {
        let path = Path::arc([10., 0., 0., 0., 0., 0.], [10., 0., 7., 0., 0., 0.], 0, 1, [0., 0.], 1);
        let axes = AxisLimits { v: [400., 300., 50., 1., 1., 1.], a: [5000., 4000., 900., 1., 1., 1.] };
        let limits = path_limits(&path, &axes, 1e9, 1.0);
        for k in 0..=1000 {
            let s = path.length * f64::from(k) / 1000.0;
            let t = path.tangent(s);
            let Shape::Arc(arc) = path.shape else { panic!("an arc") };
            let (sin, cos) = libm::sincos(arc.angle + arc.sweep * s / path.length);
            let normal = [-cos, -sin, 0.0];
            for i in 0..3 {
                assert!(t[i].abs() * limits.v <= axes.v[i] * (1.0 + 1e-9));
                for sign in [-1.0, 1.0] {
                    let a = sign * limits.a * t[i] + limits.v * limits.v * path.curvature() * normal[i];
                    assert!(a.abs() <= axes.a[i] * (1.0 + 1e-9), "axis {i} at {s}: {a}");
                }
            }
        }
    }
}
