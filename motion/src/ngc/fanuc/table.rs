//! G codes of the two machine types: number, modal group, meaning (R2-340, R2-341; book tables A.1, A.2, A.3).
//! Beside the book's codes stand those of the same groups that programs of Fanuc-style controls use.

use super::settings::Dialect;

/// What a G code asks for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Meaning {
    Rapid,
    Line,
    /// G2 (true), G3.
    Arc(bool),
    Dwell,
    /// Taken without effect; the text says why there is none.
    Nothing(&'static str),
    /// Known, but not done here: what to do instead.
    Refused(&'static str),
    Data,
    /// G15 (false), G16.
    Polar(bool),
    Plane(crate::canon::Plane),
    Inches(bool),
    ReferenceCheck,
    Reference,
    FromReference,
    OtherReference,
    Skip,
    Thread,
    /// G40, G41, G42.
    Side(i8),
    /// G43, G44, G49.
    Length(i8),
    /// G50, G51 of milling.
    Scale(bool),
    /// G50.1, G51.1.
    Mirror(bool),
    /// G68, G69 of milling.
    Rotate(bool),
    /// G68, G69 of turning: mirror for the other turret.
    Turret(bool),
    /// G92 of milling, G50 of turning: coordinates and largest speed.
    Coordinates,
    CoordinatesReset,
    Local,
    Machine,
    /// G54 .. G59: 0 to 5; a P word selects further systems.
    Work(u8),
    MoreWork,
    /// G9, one block.
    ExactBlock,
    /// G61, G64, G63.
    Path(PathMode),
    Macro,
    ModalMacro,
    MacroOff,
    /// Drilling of milling: G73 .. G89, by number; 842 and 843 are the rigid ones.
    Drill(u16),
    /// Drilling of turning: G83 .. G89.
    TurnDrill(u16),
    DrillOff,
    Incremental(bool),
    /// G93, G94, G95 as 3, 4, 5.
    Feed(u8),
    Surface(bool),
    /// G98 (true), G99 of milling.
    InitialLevel(bool),
    /// G90, G92, G94 of turning.
    Pass(Pass),
    /// G70 .. G76 of turning.
    Multi(u8),
    Cylinder,
    PolarPlane(bool),
    Nurbs,
}

/// Single passes of turning.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Pass {
    Along,
    Thread,
    Face,
}

/// Group 15.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum PathMode {
    ExactStop,
    Cutting,
    Tapping,
}

/// Number of groups.
pub const GROUPS: usize = 24;

/// Names of the groups (table A.3).
pub const NAMES: [&str; GROUPS] = [
    "one-shot codes",
    "motion",
    "constant surface speed",
    "absolute or incremental",
    "mirror image",
    "feed unit",
    "length units",
    "tool radius compensation",
    "spindle monitor",
    "stroke limit",
    "canned cycle",
    "scaling",
    "macro call",
    "tool length compensation",
    "work coordinates",
    "cutting mode",
    "plane",
    "polar coordinates",
    "coordinate rotation",
    "return level of cycles",
    "polar interpolation",
    "high-speed machining",
    "cylindrical interpolation",
    "programmable mirror",
];

type Row = (u32, u8, Meaning);
use crate::canon::Plane;
use Meaning as M;

const MONITOR: &str = "the PLC program watches the spindle";
const SMOOTH: &str = "look-ahead is always on";
const OTHER_KINEMATICS: &str = "five-axis kinematics are not part of this control: let the CAM system write X Y Z moves";

/// Codes that mean the same on both machines.
const BOTH: &[Row] = &[
    (0, 1, M::Rapid),
    (10, 1, M::Line),
    (20, 1, M::Arc(true)),
    (30, 1, M::Arc(false)),
    (40, 0, M::Dwell),
    (50, 0, M::Nothing(SMOOTH)),
    (51, 0, M::Nothing(SMOOTH)),
    (61, 1, M::Refused("write the curve as G6.2 with knots, or as short lines")),
    (62, 1, M::Nurbs),
    (71, 22, M::Cylinder),
    (80, 0, M::Nothing(SMOOTH)),
    (90, 0, M::ExactBlock),
    (100, 0, M::Data),
    (110, 0, M::Nothing("G10 ends with its block")),
    (121, 20, M::PolarPlane(true)),
    (131, 20, M::PolarPlane(false)),
    (170, 16, M::Plane(Plane::Xy)),
    (180, 16, M::Plane(Plane::Xz)),
    (190, 16, M::Plane(Plane::Yz)),
    (200, 6, M::Inches(true)),
    (210, 6, M::Inches(false)),
    (220, 9, M::Refused("set the travel of the axes in the project file: it is checked for every block")),
    (230, 9, M::Nothing("the travel of the axes is that of the project file")),
    (270, 0, M::ReferenceCheck),
    (280, 0, M::Reference),
    (290, 0, M::FromReference),
    (300, 0, M::OtherReference),
    (310, 0, M::Skip),
    (400, 7, M::Side(0)),
    (410, 7, M::Side(1)),
    (420, 7, M::Side(-1)),
    (412, 7, M::Refused(OTHER_KINEMATICS)),
    (422, 7, M::Refused(OTHER_KINEMATICS)),
    (520, 0, M::Local),
    (530, 0, M::Machine),
    (531, 0, M::Refused(OTHER_KINEMATICS)),
    (540, 14, M::Work(0)),
    (541, 14, M::MoreWork),
    (542, 23, M::Refused("a rotary table with its own centre is not part of this control")),
    (550, 14, M::Work(1)),
    (560, 14, M::Work(2)),
    (570, 14, M::Work(3)),
    (580, 14, M::Work(4)),
    (590, 14, M::Work(5)),
    (650, 0, M::Macro),
    (660, 12, M::ModalMacro),
    (661, 12, M::Refused("call the macro with G65 in each block")),
    (670, 12, M::MacroOff),
    (800, 10, M::DrillOff),
    (960, 2, M::Surface(true)),
    (970, 2, M::Surface(false)),
    (1070, 22, M::Cylinder),
    (1120, 20, M::PolarPlane(true)),
    (1130, 20, M::PolarPlane(false)),
    (501, 23, M::Mirror(false)),
    (511, 23, M::Mirror(true)),
];

const MILL: &[Row] = &[
    (150, 17, M::Polar(false)),
    (160, 17, M::Polar(true)),
    (330, 1, M::Thread),
    (390, 0, M::Nothing("compensation leads round every outside corner by an arc")),
    (401, 7, M::Refused("a C axis that follows the path is not part of this control")),
    (430, 13, M::Length(1)),
    (434, 13, M::Refused(OTHER_KINEMATICS)),
    (435, 13, M::Refused(OTHER_KINEMATICS)),
    (440, 13, M::Length(-1)),
    (490, 13, M::Length(0)),
    (500, 11, M::Scale(false)),
    (510, 11, M::Scale(true)),
    (600, 0, M::Refused("write two G0 blocks: past the point, then to it from the side that you want")),
    (610, 15, M::Path(PathMode::ExactStop)),
    (620, 15, M::Refused("write a smaller F before inside corners, and G64")),
    (630, 15, M::Path(PathMode::Tapping)),
    (640, 15, M::Path(PathMode::Cutting)),
    (680, 18, M::Rotate(true)),
    (682, 18, M::Refused(OTHER_KINEMATICS)),
    (690, 18, M::Rotate(false)),
    (730, 10, M::Drill(730)),
    (740, 10, M::Drill(740)),
    (760, 10, M::Drill(760)),
    (810, 10, M::Drill(810)),
    (820, 10, M::Drill(820)),
    (830, 10, M::Drill(830)),
    (840, 10, M::Drill(840)),
    (842, 10, M::Drill(842)),
    (843, 10, M::Drill(843)),
    (850, 10, M::Drill(850)),
    (860, 10, M::Drill(860)),
    (870, 10, M::Drill(870)),
    (880, 10, M::Drill(880)),
    (890, 10, M::Drill(890)),
    (900, 3, M::Incremental(false)),
    (910, 3, M::Incremental(true)),
    (920, 0, M::Coordinates),
    (921, 0, M::CoordinatesReset),
    (930, 5, M::Feed(3)),
    (940, 5, M::Feed(4)),
    (950, 5, M::Feed(5)),
    (980, 19, M::InitialLevel(true)),
    (990, 19, M::InitialLevel(false)),
];

const TURN: &[Row] = &[
    (250, 8, M::Nothing(MONITOR)),
    (260, 8, M::Refused("watch the spindle in the PLC program")),
    (320, 1, M::Thread),
    (340, 1, M::Refused("a lead that changes along the thread can't be cut here: write several G32 blocks with their own F")),
    (360, 0, M::Refused("measure with G31 and store the offset with G10 P")),
    (370, 0, M::Refused("measure with G31 and store the offset with G10 P")),
    (500, 0, M::Coordinates),
    (503, 0, M::CoordinatesReset),
    (680, 4, M::Turret(true)),
    (690, 4, M::Turret(false)),
    (700, 0, M::Multi(70)),
    (710, 0, M::Multi(71)),
    (720, 0, M::Multi(72)),
    (730, 0, M::Multi(73)),
    (740, 0, M::Multi(74)),
    (750, 0, M::Multi(75)),
    (760, 0, M::Multi(76)),
    (830, 10, M::TurnDrill(830)),
    (840, 10, M::TurnDrill(840)),
    (850, 10, M::TurnDrill(850)),
    (870, 10, M::TurnDrill(870)),
    (880, 10, M::TurnDrill(880)),
    (890, 10, M::TurnDrill(890)),
    (900, 1, M::Pass(Pass::Along)),
    (920, 1, M::Pass(Pass::Thread)),
    (940, 1, M::Pass(Pass::Face)),
    (980, 5, M::Feed(4)),
    (990, 5, M::Feed(5)),
];

/// The code with this number in tenths, and its group.
pub fn find(dialect: Dialect, tenths: u32) -> Option<(Meaning, usize)> {
    let own = if dialect == Dialect::FanucTurn { TURN } else { MILL };
    let row = own.iter().chain(BOTH).find(|row| row.0 == tenths)?;
    Some((row.2, usize::from(row.1)))
}

/// What to write instead of a code that the machine does not have.
pub fn instead(dialect: Dialect, tenths: u32) -> &'static str {
    match (dialect, tenths) {
        (Dialect::FanucTurn, 910) => "turning writes increments as U, V, W and H",
        (Dialect::FanucTurn, 950) => "turning writes G99 for feed a revolution, G98 for feed a minute",
        (Dialect::FanucTurn, 330) => "turning writes G32 for a thread",
        (Dialect::FanucTurn, 430 | 440 | 490) => "turning takes the tool offset from T, such as T0101",
        (Dialect::FanucTurn, _) => {
            "see the table of turning codes in the guide; a macro can stand behind a code: --set G100=9010"
        }
        (_, 320) => "milling writes G33 for a thread",
        (_, 70..=72) => "this is a code of turning: --dialect fanuc-turn",
        _ => "see the table of milling codes in the guide; a macro can stand behind a code: --set G100=9010",
    }
}
