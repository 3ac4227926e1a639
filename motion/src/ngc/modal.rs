//! Modal state: what stays from one block to the next (R1-36).

use super::options::Options;
use crate::canon::{Direction, MotionMode, Plane, Position, Units};

/// Code of the motion group that is in force.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Motion {
    /// G0.
    Rapid,
    /// G1.
    Linear,
    /// G2.
    ArcCw,
    /// G3.
    ArcCcw,
}

impl Motion {
    /// The code as text.
    pub const fn text(self) -> &'static str {
        match self {
            Motion::Rapid => "G0",
            Motion::Linear => "G1",
            Motion::ArcCw => "G2",
            Motion::ArcCcw => "G3",
        }
    }
    /// G2 or G3.
    pub const fn is_arc(self) -> bool {
        matches!(self, Motion::ArcCw | Motion::ArcCcw)
    }
}

/// What axis words or I, J, K mean: a place, or a step from the present place.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Distance {
    Absolute,
    Incremental,
}

/// The state between two blocks. Lengths are in the active length unit and in program coordinates.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Modal {
    /// G0..G3; `None` after G80 and at the start.
    pub motion: Option<Motion>,
    /// G17, G18, G19.
    pub plane: Plane,
    /// G20, G21.
    pub units: Units,
    /// G90, G91.
    pub distance: Distance,
    /// G90.1, G91.1.
    pub arc_distance: Distance,
    /// G61, G61.1, G64; a tolerance is in length units.
    pub control: MotionMode,
    /// Work offset in force, 0 for G54.
    pub work_offset: usize,
    /// F in length units a minute.
    pub feed: Option<f64>,
    /// S in revolutions a minute.
    pub speed: f64,
    /// T: the tool that the next M6 brings.
    pub tool: u32,
    /// M3, M4, M5.
    pub spindle: Option<Direction>,
    /// M8.
    pub flood: bool,
    /// M7.
    pub mist: bool,
    /// M48, M49.
    pub overrides: bool,
    /// Where the controlled point is.
    pub position: Position,
}

impl Modal {
    /// The state before the first block.
    pub fn new(options: &Options) -> Self {
        let mut modal = Modal {
            motion: options.motion,
            plane: options.plane,
            units: options.units,
            distance: options.distance,
            arc_distance: options.arc_distance,
            control: options.control,
            work_offset: options.work_offset.min(options.work_offsets.len() - 1),
            feed: None,
            speed: 0.0,
            tool: 0,
            spindle: None,
            flood: false,
            mist: false,
            overrides: true,
            position: Position::default(),
        };
        let offset = options.work_offsets[modal.work_offset];
        modal.position = scaled(minus(options.start, offset), 1.0 / mm_per_unit(modal.units));
        modal
    }

    /// Renumbers everything that is a length (CM-25, CM-27).
    pub fn change_units(&mut self, to: Units) {
        if to == self.units {
            return;
        }
        let ratio = mm_per_unit(self.units) / mm_per_unit(to);
        self.position = scaled(self.position, ratio);
        self.feed = self.feed.map(|f| f * ratio);
        if let MotionMode::Continuous(tolerance) = &mut self.control {
            *tolerance *= ratio;
        }
        self.units = to;
    }

    /// Renumbers the position when another work offset comes into force; `from` and `to` in millimetres (CM-27).
    pub fn change_offset(&mut self, from: Position, to: Position) {
        let shift = scaled(minus(from, to), 1.0 / mm_per_unit(self.units));
        self.position = plus(self.position, shift);
    }
}

/// Millimetres in a length unit.
pub const fn mm_per_unit(units: Units) -> f64 {
    match units {
        Units::Inches => takt_base::units::MM_PER_INCH,
        Units::Mm => 1.0,
        Units::Cm => 10.0,
    }
}

/// Lengths times `ratio`; angles stay.
pub fn scaled(p: Position, ratio: f64) -> Position {
    Position { x: p.x * ratio, y: p.y * ratio, z: p.z * ratio, ..p }
}

/// Sum by axis.
pub fn plus(p: Position, q: Position) -> Position {
    Position { x: p.x + q.x, y: p.y + q.y, z: p.z + q.z, a: p.a + q.a, b: p.b + q.b, c: p.c + q.c }
}

/// Difference by axis.
pub fn minus(p: Position, q: Position) -> Position {
    Position { x: p.x - q.x, y: p.y - q.y, z: p.z - q.z, a: p.a - q.a, b: p.b - q.b, c: p.c - q.c }
}

/// First, second and third coordinate of the plane (report §3.6.1: XZ counts Z first).
pub fn in_plane(p: Position, plane: Plane) -> [f64; 3] {
    match plane {
        Plane::Xy => [p.x, p.y, p.z],
        Plane::Yz => [p.y, p.z, p.x],
        Plane::Xz => [p.z, p.x, p.y],
    }
}

/// Inverse of [`in_plane`]; rotary axes from `rotary`.
pub fn from_plane([first, second, third]: [f64; 3], plane: Plane, rotary: Position) -> Position {
    let (x, y, z) = match plane {
        Plane::Xy => (first, second, third),
        Plane::Yz => (third, first, second),
        Plane::Xz => (second, third, first),
    };
    Position { x, y, z, ..rotary }
}
