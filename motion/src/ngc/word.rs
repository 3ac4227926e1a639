//! The G and M codes that are understood: what each asks for, its modal group, its operands (R1-35..R1-37).
//! The one list; reader, interpreter and status display ask it. From: RS274/NGC §3.5, §3.6, LinuxCNC "G Codes" and "M Codes".

use super::modal::{Distance, FeedMode, Motion, Retract, Side};
use crate::canon::{Direction, Plane, ProgramEnd, Units};

/// What one G or M word asks for.
#[derive(Clone, Copy, PartialEq, Debug)]
#[allow(missing_docs)]
pub enum Action {
    /// G0..G3 and the other codes of the group, or none (G80).
    Motion(Option<Motion>),
    Dwell,
    Plane(Plane),
    Units(Units),
    Distance(Distance),
    ArcDistance(Distance),
    Feed(FeedMode),
    /// Index into the table of work offsets, 0 for G54.
    WorkOffset(usize),
    Control(Control),
    /// G7 (true), G8.
    Diameter(bool),
    /// G10.
    SetData,
    /// G28, G30: the index of the reference position.
    Reference(usize),
    /// G28.1, G30.1.
    StoreReference(usize),
    /// G53.
    Machine,
    Offset(Offset),
    /// G40, G41, G42; the second word: G41.1, G42.1.
    Compensation(Option<Side>, bool),
    Length(Length),
    Retract(Retract),
    /// G96 (true), G97.
    SurfaceSpeed(bool),
    Stop(Stop),
    ToolChange,
    /// M61.
    ToolNumber,
    /// M3, M4, or none (M5).
    Spindle(Option<Direction>),
    /// M19.
    Orient,
    Coolant(Coolant),
    /// M48 enables the override switches, M49 disables them.
    Overrides(bool),
    /// M50..M53.
    Override(Override),
    /// M62..M68.
    Io(u32),
    /// M70..M73.
    Modes(Modes),
    /// M98, M99.
    Call,
    Return,
    /// An M code for the PLC program.
    User(u32),
}

/// G61, G61.1, G64.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Control {
    ExactPath,
    ExactStop,
    Continuous,
}

/// G52, G92, G92.1, G92.2, G92.3.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Offset {
    Local,
    Set,
    Clear,
    Suspend,
    Restore,
}

/// G43, G43.1, G43.2, G49.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Length {
    Tool,
    Dynamic,
    Additional,
    Off,
}

/// M0, M1, M2, M30, M60.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Stop {
    Program,
    Optional,
    End(ProgramEnd),
    PalletShuttle,
}

/// M7, M8, M9.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Coolant {
    Mist,
    Flood,
    Off,
}

/// M50, M51, M52, M53.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Override {
    Feed,
    Speed,
    Adaptive,
    Hold,
}

/// M70, M71, M72, M73.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Modes {
    Save,
    Invalidate,
    Restore,
    SaveForCall,
}

/// Codes of one group exclude each other within a block (R1-37). The G groups first, then those of M.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Group {
    NonModal,
    Motion,
    Plane,
    Distance,
    ArcDistance,
    FeedMode,
    Units,
    WorkOffset,
    Control,
    Lathe,
    Compensation,
    Length,
    Retract,
    SpindleMode,
    Stopping,
    ToolChange,
    Spindle,
    Coolant,
    Overrides,
    Io,
    Modes,
    User,
}

/// Number of [`Group`]s.
pub const GROUPS: usize = 22;

impl Group {
    /// Name in messages.
    pub const fn name(self) -> &'static str {
        match self {
            Group::NonModal => "non-modal codes",
            Group::Motion => "motion",
            Group::Plane => "plane selection",
            Group::Distance => "distance mode",
            Group::ArcDistance => "arc distance mode",
            Group::FeedMode => "feed mode",
            Group::Units => "length units",
            Group::WorkOffset => "work offsets",
            Group::Control => "path control",
            Group::Lathe => "diameter or radius",
            Group::Compensation => "cutter compensation",
            Group::Length => "tool length",
            Group::Retract => "retract mode",
            Group::SpindleMode => "spindle speed mode",
            Group::Stopping => "stopping",
            Group::ToolChange => "tool change",
            Group::Spindle => "spindle",
            Group::Coolant => "coolant",
            Group::Overrides => "override switches",
            Group::Io => "inputs and outputs",
            Group::Modes => "saved modes",
            Group::User => "user M codes",
        }
    }
}

impl Action {
    /// The modal group.
    pub const fn group(self) -> Group {
        match self {
            Action::Dwell
            | Action::SetData
            | Action::Reference(_)
            | Action::StoreReference(_)
            | Action::Machine
            | Action::Offset(_) => Group::NonModal,
            Action::Motion(_) => Group::Motion,
            Action::Plane(_) => Group::Plane,
            Action::Distance(_) => Group::Distance,
            Action::ArcDistance(_) => Group::ArcDistance,
            Action::Feed(_) => Group::FeedMode,
            Action::Units(_) => Group::Units,
            Action::WorkOffset(_) => Group::WorkOffset,
            Action::Control(_) => Group::Control,
            Action::Diameter(_) => Group::Lathe,
            Action::Compensation(..) => Group::Compensation,
            Action::Length(_) => Group::Length,
            Action::Retract(_) => Group::Retract,
            Action::SurfaceSpeed(_) => Group::SpindleMode,
            Action::Stop(_) | Action::Call | Action::Return => Group::Stopping,
            Action::ToolChange | Action::ToolNumber => Group::ToolChange,
            Action::Spindle(_) | Action::Orient => Group::Spindle,
            Action::Coolant(_) => Group::Coolant,
            Action::Overrides(_) | Action::Override(_) => Group::Overrides,
            Action::Io(_) => Group::Io,
            Action::Modes(_) => Group::Modes,
            Action::User(_) => Group::User,
        }
    }

    /// Letters beside F, S, T and `$` that the code reads. Axis words belong to the motion, whichever block set it.
    pub const fn operands(self) -> &'static str {
        match self {
            Action::Motion(Some(motion)) => motion.operands(),
            Action::Dwell | Action::Override(_) => "P",
            Action::Control(Control::Continuous) => "PQ",
            Action::SetData => "XYZABCPLRIJQ",
            Action::Reference(_) | Action::Offset(Offset::Local | Offset::Set) => "XYZABC",
            Action::Compensation(Some(_), false) => "D",
            Action::Compensation(Some(_), true) => "DL",
            Action::Length(Length::Tool) => "H",
            Action::Length(Length::Dynamic) => "XYZABC",
            Action::Length(Length::Additional) => "HXYZABC",
            Action::SurfaceSpeed(_) => "D",
            Action::ToolNumber => "Q",
            Action::Orient => "RQP",
            Action::Io(62..=65) => "P",
            Action::Io(66) => "PELQ",
            Action::Io(_) => "EQ",
            Action::Call => "PLQ",
            Action::User(_) => "PQ",
            _ => "",
        }
    }

    /// True for codes that take the axis words for themselves, so that the motion in force has none.
    pub const fn takes_axes(self) -> bool {
        matches!(
            self,
            Action::SetData
                | Action::Reference(_)
                | Action::Offset(Offset::Local | Offset::Set)
                | Action::Length(Length::Dynamic | Length::Additional)
        )
    }
}

/// Whole to within the rounding of decimal numbers.
pub fn whole(value: f64) -> Option<u32> {
    let near = (value + 0.5) as i64;
    ((value - near as f64).abs() < 1e-6).then(|| u32::try_from(near).ok()).flatten()
}

/// The G code with this number.
pub fn g_of(value: f64) -> Option<Action> {
    g(whole(value * 10.0)?)
}

/// The M code with this number.
pub fn m_of(value: f64) -> Option<Action> {
    m(whole(value)?)
}

/// The G code with this number in tenths (`911` is G91.1).
pub fn g(tenths: u32) -> Option<Action> {
    if let Some(motion) = Motion::of_code(tenths) {
        return Some(Action::Motion(Some(motion)));
    }
    Some(match tenths {
        40 => Action::Dwell,
        70 | 80 => Action::Diameter(tenths == 70),
        100 => Action::SetData,
        170 => Action::Plane(Plane::Xy),
        180 => Action::Plane(Plane::Xz),
        190 => Action::Plane(Plane::Yz),
        200 => Action::Units(Units::Inches),
        210 => Action::Units(Units::Mm),
        280 | 300 => Action::Reference((tenths as usize - 280) / 20),
        281 | 301 => Action::StoreReference((tenths as usize - 281) / 20),
        400 => Action::Compensation(None, false),
        410 | 411 => Action::Compensation(Some(Side::Left), tenths == 411),
        420 | 421 => Action::Compensation(Some(Side::Right), tenths == 421),
        430 => Action::Length(Length::Tool),
        431 => Action::Length(Length::Dynamic),
        432 => Action::Length(Length::Additional),
        490 => Action::Length(Length::Off),
        520 => Action::Offset(Offset::Local),
        530 => Action::Machine,
        540 | 550 | 560 | 570 | 580 | 590 => Action::WorkOffset((tenths as usize - 540) / 10),
        591..=593 => Action::WorkOffset(tenths as usize - 585),
        610 => Action::Control(Control::ExactPath),
        611 => Action::Control(Control::ExactStop),
        640 => Action::Control(Control::Continuous),
        800 => Action::Motion(None),
        900 => Action::Distance(Distance::Absolute),
        910 => Action::Distance(Distance::Incremental),
        901 => Action::ArcDistance(Distance::Absolute),
        911 => Action::ArcDistance(Distance::Incremental),
        920 => Action::Offset(Offset::Set),
        921 => Action::Offset(Offset::Clear),
        922 => Action::Offset(Offset::Suspend),
        923 => Action::Offset(Offset::Restore),
        930 => Action::Feed(FeedMode::InverseTime),
        940 => Action::Feed(FeedMode::PerMinute),
        950 => Action::Feed(FeedMode::PerRevolution),
        960 | 970 => Action::SurfaceSpeed(tenths == 960),
        980 => Action::Retract(Retract::OldZ),
        990 => Action::Retract(Retract::R),
        _ => return None,
    })
}

/// The M code with this number. 10..=199 without a meaning here belong to the PLC program.
pub fn m(number: u32) -> Option<Action> {
    Some(match number {
        0 => Action::Stop(Stop::Program),
        1 => Action::Stop(Stop::Optional),
        2 => Action::Stop(Stop::End(ProgramEnd::M2)),
        30 => Action::Stop(Stop::End(ProgramEnd::M30)),
        60 => Action::Stop(Stop::PalletShuttle),
        3 => Action::Spindle(Some(Direction::Clockwise)),
        4 => Action::Spindle(Some(Direction::Counterclockwise)),
        5 => Action::Spindle(None),
        6 => Action::ToolChange,
        7 => Action::Coolant(Coolant::Mist),
        8 => Action::Coolant(Coolant::Flood),
        9 => Action::Coolant(Coolant::Off),
        19 => Action::Orient,
        48 => Action::Overrides(true),
        49 => Action::Overrides(false),
        50 => Action::Override(Override::Feed),
        51 => Action::Override(Override::Speed),
        52 => Action::Override(Override::Adaptive),
        53 => Action::Override(Override::Hold),
        61 => Action::ToolNumber,
        62..=68 => Action::Io(number),
        70 => Action::Modes(Modes::Save),
        71 => Action::Modes(Modes::Invalidate),
        72 => Action::Modes(Modes::Restore),
        73 => Action::Modes(Modes::SaveForCall),
        98 => Action::Call,
        99 => Action::Return,
        10..=199 => Action::User(number),
        _ => return None,
    })
}

/// What to write instead of a G code of other controls or of a later version; empty if there is nothing to say.
pub fn instead_of_g(tenths: u32) -> &'static str {
    match tenths {
        700..=729 => "the cycles of a contour are G70, G71, G71.1, G71.2, G72, G72.1 and G72.2",
        500 | 510 | 501 | 511 | 680 | 690 => "scale, mirror or rotate in the CAM system, or use G10 L2 P1 R for a rotation",
        310 => "probe with G38.2",
        440 => "write a negative length into the tool table and use G43",
        650 | 660 | 670 => "write the macro as a subroutine: o100 sub, o100 call",
        _ => "the codes are G0-G5.3, G7, G8, G10, G17-G21, G28, G30, G33, G38, G40-G43, G49, G52-G64, G73-G99; see the guide",
    }
}
