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
    /// Extension, drop-in listing only: what LinuxCNC says of a mode that no command shows.
    Remark(&'static str),
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
    /// Extension: rotation of the program about Z in degrees; turns what `SET_ORIGIN_OFFSETS` then shifts (G10 L2 R).
    SetXyRotation(f64),
    /// Extension, drop-in listing only: work offset with its number from 1.
    SetG5xOffset(u32, Position),
    /// Extension, drop-in listing only: offset of G92 and G52.
    SetG92Offset(Position),
    /// Extension: G43 with offsets of other axes than Z: X Y Z A B C.
    UseToolLengthOffsets(Position),
    /// Extension: G95 (true), G94.
    SetFeedMode(bool),
    /// Extension: G96 with its largest speed; `None`: G97.
    SetSpindleMode(Option<f64>),
    /// Extension: naive CAM tolerance, the Q of G64.
    SetNaivecamTolerance(f64),
    /// Extension: M6 begins; drop-in listing only.
    StartChange,
    /// Extension: M61.
    ChangeToolNumber(u32),
    /// Extension: G10 L1, L10, L11.
    SetToolTableEntry(Box<ToolEntry>),
    /// Extension, drop-in listing only: M19 with its P word.
    OrientSpindleMode(f64, u32),
    /// Extension: M19 waits up to this many seconds.
    WaitOrientComplete(f64),
    /// Extension: motion in step with the spindle: length units a revolution (G33).
    StartSpeedFeedSync(f64),
    /// Probe towards a point.
    StraightProbe(Position, Probe),
    TurnProbeOn,
    TurnProbeOff,
    /// Extension: down and up again in step with the spindle (G33.1).
    RigidTap(Position),
    /// Extension: a NURBS.
    NurbsFeed(Nurbs),
    /// Extension: M52.
    EnableAdaptiveFeed,
    DisableAdaptiveFeed,
    /// Extension: M53.
    EnableFeedHold,
    DisableFeedHold,
    /// Extension: M62, M63 with the next move.
    SetMotionOutputBit(u32),
    ClearMotionOutputBit(u32),
    /// Extension: M64, M65 at once.
    SetAuxOutputBit(u32),
    ClearAuxOutputBit(u32),
    /// Extension: M67 with the next move, M68 at once.
    SetMotionOutputValue(u32, f64),
    SetAuxOutputValue(u32, f64),
    /// Extension: M66: wait for an input.
    WaitInput(Input),
    /// Extension: the program reads variables of the PLC program, by path, when the motion before has ended.
    ReadPlc(Vec<String>),
    /// Extension: sets a variable of the PLC program when the motion before has ended; the path goes on.
    SetPlc(String, f64),
    /// Extension: text for the console, the log and its file.
    Print(String),
    Log(String),
    LogOpen(String),
    LogAppend(String),
    LogClose,
    /// Extension: an M code that has no meaning of its own here; the PLC program gives it one. With its P and Q words.
    UserMCode {
        code: u32,
        p: Option<f64>,
        q: Option<f64>,
    },
}

/// G38.2 .. G38.5.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Probe {
    /// Towards the contact; else away from it.
    pub towards: bool,
    /// No contact is an error.
    pub must_trip: bool,
}

/// A row of the tool table, in millimetres and degrees.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct ToolEntry {
    /// Index in the changer; 0 is the spindle.
    pub index: u32,
    /// T word.
    pub tool: u32,
    /// Pocket.
    pub pocket: u32,
    /// X Y Z A B C U V W.
    pub offset: [f64; 9],
    /// Diameter.
    pub diameter: f64,
    /// Front angle.
    pub front: f64,
    /// Back angle.
    pub back: f64,
    /// Orientation of a lathe tool, 0 to 9.
    pub orientation: u32,
}

/// M66.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Input {
    /// Number of the input.
    pub number: u32,
    /// Analog instead of digital.
    pub analog: bool,
    /// L word: 0 at once, 1 rise, 2 fall, 3 high, 4 low.
    pub wait: u32,
    /// Seconds.
    pub timeout: f64,
}

/// A NURBS in the XY plane: control points with weights; knots are uniform and clamped at both ends.
#[derive(Clone, PartialEq, Debug)]
pub struct Nurbs {
    /// Degree + 1.
    pub order: u32,
    /// x, y, weight in program coordinates.
    pub points: Vec<[f64; 3]>,
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
