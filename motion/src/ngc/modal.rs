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
    /// G5: cubic spline.
    Cubic,
    /// G5.1: quadratic spline.
    Quadratic,
    /// G5.2: control points of a NURBS.
    Nurbs,
    /// G5.3: end of a NURBS.
    NurbsEnd,
    /// G33: in step with the spindle.
    Synchronized,
    /// G33.1: rigid tapping.
    RigidTap,
    /// G38.2 .. G38.5.
    Probe(u8),
    /// G76: threading.
    Thread,
    /// G73, G74, G81 .. G89.
    Canned(u8),
    /// G70, G71, G71.1, G71.2, G72, G72.1, G72.2, in tenths: a contour of a lathe.
    Contour(u16),
}

impl Motion {
    /// The code with this number in tenths.
    pub const fn of_code(tenths: u32) -> Option<Self> {
        Some(match tenths {
            0 => Motion::Rapid,
            10 => Motion::Linear,
            20 => Motion::ArcCw,
            30 => Motion::ArcCcw,
            50 => Motion::Cubic,
            51 => Motion::Quadratic,
            52 => Motion::Nurbs,
            53 => Motion::NurbsEnd,
            330 => Motion::Synchronized,
            331 => Motion::RigidTap,
            382..=385 => Motion::Probe((tenths - 380) as u8),
            760 => Motion::Thread,
            700 | 710..=712 | 720..=722 => Motion::Contour(tenths as u16),
            730 | 740 | 810 | 820 | 830 | 840 | 850 | 860 | 870 | 880 | 890 => Motion::Canned((tenths / 10) as u8),
            _ => return None,
        })
    }

    /// Its number in tenths.
    pub const fn code(self) -> u32 {
        match self {
            Motion::Rapid => 0,
            Motion::Linear => 10,
            Motion::ArcCw => 20,
            Motion::ArcCcw => 30,
            Motion::Cubic => 50,
            Motion::Quadratic => 51,
            Motion::Nurbs => 52,
            Motion::NurbsEnd => 53,
            Motion::Synchronized => 330,
            Motion::RigidTap => 331,
            Motion::Probe(n) => 380 + n as u32,
            Motion::Thread => 760,
            Motion::Canned(n) => n as u32 * 10,
            Motion::Contour(tenths) => tenths as u32,
        }
    }

    /// The code as text.
    pub const fn text(self) -> &'static str {
        match self {
            Motion::Rapid => "G0",
            Motion::Linear => "G1",
            Motion::ArcCw => "G2",
            Motion::ArcCcw => "G3",
            Motion::Cubic => "G5",
            Motion::Quadratic => "G5.1",
            Motion::Nurbs => "G5.2",
            Motion::NurbsEnd => "G5.3",
            Motion::Synchronized => "G33",
            Motion::RigidTap => "G33.1",
            Motion::Probe(2) => "G38.2",
            Motion::Probe(3) => "G38.3",
            Motion::Probe(4) => "G38.4",
            Motion::Probe(_) => "G38.5",
            Motion::Thread => "G76",
            Motion::Contour(700) => "G70",
            Motion::Contour(710..=712) => "G71",
            Motion::Contour(_) => "G72",
            Motion::Canned(73) => "G73",
            Motion::Canned(74) => "G74",
            Motion::Canned(81) => "G81",
            Motion::Canned(82) => "G82",
            Motion::Canned(83) => "G83",
            Motion::Canned(84) => "G84",
            Motion::Canned(85) => "G85",
            Motion::Canned(86) => "G86",
            Motion::Canned(87) => "G87",
            Motion::Canned(88) => "G88",
            Motion::Canned(_) => "G89",
        }
    }

    /// Letters that the code reads.
    pub const fn operands(self) -> &'static str {
        match self {
            Motion::Rapid | Motion::Linear | Motion::Probe(_) => "XYZABC@^",
            Motion::ArcCw | Motion::ArcCcw => "XYZABCIJKRP@^",
            Motion::Cubic => "XYZABCIJPQ",
            Motion::Quadratic => "XYZABCIJ",
            Motion::Nurbs => "XYZABCPL",
            Motion::NurbsEnd => "",
            Motion::Synchronized => "XYZABCK@^",
            Motion::RigidTap => "XYZABCKI@^",
            Motion::Thread => "ZPIJRKQHEL",
            Motion::Contour(700) => "QXYZABCDEP",
            Motion::Contour(_) => "QXYZABCDIR",
            Motion::Canned(73 | 83) => "XYZRLQ@^",
            Motion::Canned(74 | 82 | 84 | 86 | 88 | 89) => "XYZRLP@^",
            Motion::Canned(87) => "XYZRLIJK@^",
            Motion::Canned(_) => "XYZRL@^",
        }
    }

    /// G2 or G3.
    pub const fn is_arc(self) -> bool {
        matches!(self, Motion::ArcCw | Motion::ArcCcw)
    }

    /// True if the code needs a feed.
    pub const fn feeds(self) -> bool {
        !matches!(
            self,
            Motion::Rapid | Motion::Synchronized | Motion::RigidTap | Motion::Thread | Motion::NurbsEnd | Motion::Canned(_)
        )
    }
}

/// G93, G94, G95.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[allow(missing_docs)]
pub enum FeedMode {
    InverseTime,
    #[default]
    PerMinute,
    PerRevolution,
}

/// G98, G99: how far a canned cycle goes back.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[allow(missing_docs)]
pub enum Retract {
    OldZ,
    #[default]
    R,
}

/// Side of the contour on which the tool runs.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Side {
    Left,
    Right,
}

/// Offsets between program and machine coordinates, in mm and degrees: machine = rotated(program + `local`) + `work` + `tool`.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Offsets {
    /// Origin of G54 .. G59.3.
    pub work: Position,
    /// Rotation of that system about Z, degrees.
    pub rotation: f64,
    /// G52, G92.
    pub local: Position,
    /// G43.
    pub tool: Position,
}

impl Offsets {
    /// Sum of the offsets where there is no rotation.
    fn total(&self) -> Position {
        plus(plus(self.work, self.local), self.tool)
    }

    /// Machine position of program position `p` in mm.
    pub fn machine(&self, p: Position) -> Position {
        plus(plus(rotated(plus(p, self.local), self.rotation), self.work), self.tool)
    }

    /// Inverse of [`Offsets::machine`].
    pub fn program(&self, p: Position) -> Position {
        minus(rotated(minus(minus(p, self.tool), self.work), -self.rotation), self.local)
    }

    /// The one origin of the report: what program position 0 is without the tool.
    pub fn origin(&self) -> Position {
        plus(rotated(self.local, self.rotation), self.work)
    }
}

/// X and Y turned about Z by `degrees`.
pub fn rotated(p: Position, degrees: f64) -> Position {
    if degrees == 0.0 {
        return p;
    }
    let (sin, cos) = libm::sincos(degrees.to_radians());
    Position { x: p.x * cos - p.y * sin, y: p.x * sin + p.y * cos, ..p }
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
    /// F in length units a minute (or revolution); nothing with G93.
    pub feed: Option<f64>,
    /// G93, G94, G95.
    pub feed_mode: FeedMode,
    /// G98, G99.
    pub retract: Retract,
    /// G7: X words are diameters.
    pub diameter: bool,
    /// Offsets in force.
    pub offsets: Offsets,
    /// G43 and its kin are in force.
    pub length_on: bool,
    /// G41, G42.
    pub side: Option<Side>,
    /// G41.1, G42.1.
    pub side_dynamic: bool,
    /// G96: largest speed in revolutions a minute.
    pub surface_speed: Option<f64>,
    /// Naive CAM tolerance of G64 in length units.
    pub naive_tolerance: f64,
    /// M52.
    pub adaptive_feed: bool,
    /// M53.
    pub feed_hold: bool,
    /// Tool in the spindle, and its pocket.
    pub tool_in_spindle: u32,
    /// Speed override switch counts (M48, M51).
    pub speed_override: bool,
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
    /// Feed override switch counts (M48, M50).
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
            feed_mode: FeedMode::PerMinute,
            retract: Retract::R,
            diameter: false,
            offsets: Offsets::default(),
            length_on: false,
            side: None,
            side_dynamic: false,
            surface_speed: None,
            naive_tolerance: 0.0,
            adaptive_feed: false,
            feed_hold: true,
            tool_in_spindle: 0,
            speed_override: true,
            speed: 0.0,
            tool: 0,
            spindle: None,
            flood: false,
            mist: false,
            overrides: true,
            position: Position::default(),
        };
        let offset = options.work_offsets[modal.work_offset];
        modal.offsets.work = offset;
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
        self.naive_tolerance *= ratio;
        self.units = to;
    }

    /// Puts other offsets into force and renumbers the position (CM-27).
    pub fn change_offsets(&mut self, to: Offsets) {
        let from = std::mem::replace(&mut self.offsets, to);
        let unit = mm_per_unit(self.units);
        if from.rotation == 0.0 && to.rotation == 0.0 {
            let shift = scaled(minus(from.total(), to.total()), 1.0 / unit);
            self.position = plus(self.position, shift);
        } else {
            self.position = scaled(to.program(from.machine(scaled(self.position, unit))), 1.0 / unit);
        }
    }

    /// Machine position of program position `p`: mm, degrees.
    pub fn machine(&self, p: Position) -> Position {
        self.offsets.machine(scaled(p, mm_per_unit(self.units)))
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
