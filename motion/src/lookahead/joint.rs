//! Speed at the joint of two path elements.
//! Runs: background. Invariant: the jumps of axis speed at all joints within one servo period, together, stay within the share
//! `JOINT_BUDGET` of the acceleration of each axis; the elements beside such a joint plan with the rest.
//! From: R1-158, R1-159, R1-202 (axis-difference method), RS274/NGC §3.5.14 (G61, G64).

use super::limits::AxisLimits;
use crate::geometry::{AXES, Path};

/// Share of the acceleration for speed jumps at joints that are not quite tangent.
pub const JOINT_BUDGET: f64 = 0.2;
/// Joints closer than a period add up; the sampling kernel weighs them by up to this factor more than a lone one.
const CLUSTER: f64 = 1.5;
/// Change of a tangent component from which the joint is a corner and the path stops.
const CORNER: f64 = 0.1;
/// Jump, as a share of what one servo period can do, that is lost in the noise of the arithmetic.
const NOISE: f64 = 1e-8;

/// What a joint allows.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Joint {
    /// Highest speed.
    pub v: f64,
    /// True if the joint is passed with a jump, so that the elements beside it must leave it its share.
    pub jump: bool,
}

/// The joint between `before` and `after`, at most `v` mm/s fast.
pub fn joint(before: &Path, after: &Path, axes: &AxisLimits, period: f64, v: f64) -> Joint {
    let (t1, t2) = (before.tangent(before.length), after.tangent(0.0));
    let shorter = before.length.min(after.length);
    let mut joint = Joint { v, jump: false };
    for i in 0..AXES {
        let change = (t2[i] - t1[i]).abs();
        if change > CORNER {
            return Joint { v: 0.0, jump: false };
        }
        if change * v <= NOISE * axes.a[i] * period && change * v * v <= NOISE * axes.a[i] * shorter {
            continue;
        }
        let budget = axes.a[i] * JOINT_BUDGET / CLUSTER;
        joint.v = joint.v.min(budget * period / change).min((budget * shorter / change).sqrt());
        joint.jump = true;
    }
    joint
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bend(degrees: f64) -> Joint {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        let before = Path::line([0.0; 6], [100., 0., 0., 0., 0., 0.]);
        let after = Path::line(before.end, [100. + 100. * cos, 100. * sin, 0., 0., 0., 0.]);
        joint(&before, &after, &AxisLimits::uniform(1000.0, 2000.0), 0.001, 100.0)
    }

    /// R1-159
    #[test]
    fn straight_bend_and_corner() {
        assert_eq!(bend(0.0), Joint { v: 100.0, jump: false });
        assert_eq!(bend(90.0), Joint { v: 0.0, jump: false });
        assert_eq!(bend(180.0), Joint { v: 0.0, jump: false });
        let small = bend(1.0);
        assert!(small.jump && (small.v - 2.0 * JOINT_BUDGET / CLUSTER / 0.0174524).abs() < 1e-3, "{small:?}");
    }

    #[test]
    fn line_into_tangent_arc_keeps_speed() {
        let before = Path::line([20., 90., 0., 0., 0., 0.], [72., 90., 0., 0., 0., 0.]);
        let after = Path::arc(before.end, [88., 106., 0., 0., 0., 0.], 0, 1, [72., 106.], 1);
        assert_eq!(joint(&before, &after, &AxisLimits::uniform(1000.0, 20000.0), 0.001, 400.0), Joint { v: 400.0, jump: false });
    }
}
