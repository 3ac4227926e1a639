//! From programmed to work coordinates: mirror, then scaling, then rotation (G51.1, G51, G68), as controls of this kind do it (R1-50..R1-52,
//! R1-102). Kernels of plain numbers in length units; rotary axes stay as they are.

use crate::canon::{Plane, Position};
use crate::ngc::arc::Point;
use crate::ngc::modal::{from_plane, in_plane};

/// The transformation in force.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Transform {
    /// Axis of symmetry of X, Y, Z.
    pub mirror: [Option<f64>; 3],
    /// Factors and centre.
    pub scale: Option<([f64; 3], [f64; 3])>,
    /// Plane, centre, degrees counterclockwise.
    pub rotation: Option<(Plane, Point, f64)>,
}

impl Transform {
    /// True if nothing is changed.
    pub fn is_identity(&self) -> bool {
        *self == Transform::default()
    }

    /// Where a programmed point is.
    pub fn apply(&self, p: Position) -> Position {
        if self.is_identity() {
            return p;
        }
        let mut v = [p.x, p.y, p.z];
        for (v, mirror) in v.iter_mut().zip(self.mirror) {
            if let Some(axis) = mirror {
                *v = 2.0 * axis - *v;
            }
        }
        if let Some((factors, centre)) = self.scale {
            for i in 0..3 {
                v[i] = centre[i] + factors[i] * (v[i] - centre[i]);
            }
        }
        self.rotated(Position { x: v[0], y: v[1], z: v[2], ..p }, 1.0)
    }

    /// The programmed point that is at `p`.
    pub fn undo(&self, p: Position) -> Position {
        if self.is_identity() {
            return p;
        }
        let p = self.rotated(p, -1.0);
        let mut v = [p.x, p.y, p.z];
        if let Some((factors, centre)) = self.scale {
            for i in 0..3 {
                v[i] = centre[i] + (v[i] - centre[i]) / factors[i];
            }
        }
        for (v, mirror) in v.iter_mut().zip(self.mirror) {
            if let Some(axis) = mirror {
                *v = 2.0 * axis - *v;
            }
        }
        Position { x: v[0], y: v[1], z: v[2], ..p }
    }

    fn rotated(&self, p: Position, way: f64) -> Position {
        let Some((plane, centre, degrees)) = self.rotation else { return p };
        let [a, b, c] = in_plane(p, plane);
        let (sin, cos) = libm::sincos((degrees * way).to_radians());
        let (a, b) = (a - centre[0], b - centre[1]);
        from_plane([centre[0] + a * cos - b * sin, centre[1] + a * sin + b * cos, c], plane, p)
    }

    /// Whether arcs of a plane change their sense; `None` if they would become ellipses, or leave the plane.
    pub fn turns_arcs(&self, plane: Plane) -> Option<bool> {
        if self.rotation.is_some_and(|(p, _, degrees)| p != plane && degrees != 0.0) {
            return None;
        }
        let [i, j] = axes_of(plane);
        let factor = |i: usize| self.scale.map_or(1.0, |(factors, _)| factors[i]);
        if (factor(i).abs() - factor(j).abs()).abs() > 1e-12 {
            return None;
        }
        let negative = |i: usize| (factor(i) < 0.0) != self.mirror[i].is_some();
        Some(negative(i) != negative(j))
    }

    /// The same in another length unit.
    pub fn change_units(&mut self, ratio: f64) {
        self.mirror.iter_mut().flatten().for_each(|v| *v *= ratio);
        if let Some((_, centre)) = &mut self.scale {
            centre.iter_mut().for_each(|v| *v *= ratio);
        }
        if let Some((_, centre, _)) = &mut self.rotation {
            centre.iter_mut().for_each(|v| *v *= ratio);
        }
    }
}

/// Indices of the first and second axis of a plane.
pub fn axes_of(plane: Plane) -> [usize; 2] {
    match plane {
        Plane::Xy => [0, 1],
        Plane::Yz => [1, 2],
        Plane::Xz => [2, 0],
    }
}
