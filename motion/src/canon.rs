//! The canonical machining commands of NISTIR 5970 as data (CM-01..CM-07): the boundary between interpreter and motion.
//!
//! Lengths are in the active length unit and in program coordinates, angles in degrees, as the report defines them (CM-25, CM-26);
//! [`crate::run`] turns them into millimetres and machine coordinates. Commands that the report does not have are marked
//! *extension* and carry the names of LinuxCNC's listing.
//! Three readers: [`crate::print`] writes the listing, [`crate::run`] feeds the planner, [`crate::draw`] draws the tool path.

/// X, Y, Z in length units, A, B, C in degrees.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
#[allow(missing_docs)]
pub struct Position {
    pub x: f64,
    pub y: f64,
    pub z: f64,
    pub a: f64,
    pub b: f64,
    pub c: f64,
}

impl From<[f64; 6]> for Position {
    fn from([x, y, z, a, b, c]: [f64; 6]) -> Self {
        Self { x, y, z, a, b, c }
    }
}

impl From<Position> for [f64; 6] {
    fn from(p: Position) -> Self {
        [p.x, p.y, p.z, p.a, p.b, p.c]
    }
}

/// Selected plane (CM-28). The first and second axis of XZ are Z and X (report §3.6.1).
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[allow(missing_docs)]
pub enum Plane {
    #[default]
    Xy,
    Yz,
    Xz,
}

/// Length unit (CM-25).
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[allow(missing_docs)]
pub enum Units {
    Inches,
    #[default]
    Mm,
    Cm,
}

/// Motion control mode (CM-50..CM-52).
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub enum MotionMode {
    /// Stop at every end point.
    ExactStop,
    /// Stay on the path, keep speed over tangent joints.
    #[default]
    ExactPath,
    /// Corners may be rounded by up to this length; 0: no tolerance given.
    Continuous(f64),
}

/// Sense of rotation.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Direction {
    Clockwise,
    Counterclockwise,
}

/// What a feed rate refers to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum FeedReference {
    Workpiece,
    Xyz,
}

/// Circular or helical arc; `first`, `second` and `axis` belong to the plane (report §3.6.1).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Arc {
    /// End point, first coordinate.
    pub first_end: f64,
    /// End point, second coordinate.
    pub second_end: f64,
    /// Centre, first coordinate, absolute in program coordinates (CM-60).
    pub first_axis: f64,
    /// Centre, second coordinate.
    pub second_axis: f64,
    /// Turns: positive counterclockwise seen from the positive end of the third axis (CM-61).
    pub rotation: i32,
    /// End point on the third axis.
    pub axis_end_point: f64,
    /// Rotary end points in degrees.
    #[allow(missing_docs)]
    pub a: f64,
    #[allow(missing_docs)]
    pub b: f64,
    #[allow(missing_docs)]
    pub c: f64,
}

/// One canonical command. The listing name is the variant in upper case (`StraightFeed` is `STRAIGHT_FEED`).
#[derive(Clone, PartialEq, Debug)]
#[allow(missing_docs)] // the report's names
pub enum Canon {
    InitCanon,
    EndCanon,
    SelectPlane(Plane),
    SetOriginOffsets(Position),
    UseLengthUnits(Units),
    SetTraverseRate(f64),
    StraightTraverse(Position),
    SetFeedRate(f64),
    SetFeedReference(FeedReference),
    SetMotionControlMode(MotionMode),
    StartSpeedFeedSynch,
    StopSpeedFeedSynch,
    ArcFeed(Arc),
    Dwell(f64),
    Stop,
    StraightFeed(Position),
    SetSpindleSpeed(f64),
    StartSpindleClockwise,
    StartSpindleCounterclockwise,
    StopSpindleTurning,
    OrientSpindle(f64, Direction),
    ChangeTool(u32),
    SelectTool(u32),
    UseToolLengthOffset(f64),
    Comment(String),
    Message(String),
    FloodOff,
    FloodOn,
    MistOff,
    MistOn,
    DisableFeedOverride,
    DisableSpeedOverride,
    EnableFeedOverride,
    EnableSpeedOverride,
    PalletShuttle,
    /// Extension: M0.
    ProgramStop,
    /// Extension: M1.
    OptionalProgramStop,
    /// Extension: M2, M30, or the end of a program without either.
    ProgramEnd(ProgramEnd),
    /// Extension: an M code that has no meaning of its own here; the PLC program gives it one. With its P and Q words.
    UserMCode {
        code: u32,
        p: Option<f64>,
        q: Option<f64>,
    },
}

/// How a program ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum ProgramEnd {
    M2,
    M30,
    EndOfFile,
}

/// A command and the block it came from.
#[derive(Clone, PartialEq, Debug)]
pub struct Step {
    /// Block number in execution order, from 1; 0 for what stands before the first block.
    pub block: u32,
    /// Source line, from 1.
    pub line: u32,
    /// N word of the block.
    pub n: Option<u32>,
    /// What to do.
    pub command: Canon,
}
