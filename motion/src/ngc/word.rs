//! The G and M codes that are understood: what each asks for, its modal group, its operands (R1-35..R1-37).
//! The one list; reader, interpreter and status display ask it.

use super::modal::{Distance, Motion};
use crate::canon::{Direction, Plane, ProgramEnd, Units};

/// What one G or M word asks for.
#[derive(Clone, Copy, PartialEq, Debug)]
#[allow(missing_docs)]
pub enum Action {
    /// G0..G3, or none (G80).
    Motion(Option<Motion>),
    Dwell,
    Plane(Plane),
    Units(Units),
    Distance(Distance),
    ArcDistance(Distance),
    FeedPerMinute,
    /// Index into the table of work offsets, 0 for G54.
    WorkOffset(usize),
    Control(Control),
    Stop(Stop),
    ToolChange,
    /// M3, M4, or none (M5).
    Spindle(Option<Direction>),
    Coolant(Coolant),
    /// M48 enables the override switches, M49 disables them.
    Overrides(bool),
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
    Stopping,
    ToolChange,
    Spindle,
    Coolant,
    Overrides,
    User,
}

/// Number of [`Group`]s.
pub const GROUPS: usize = 15;

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
            Group::Stopping => "stopping",
            Group::ToolChange => "tool change",
            Group::Spindle => "spindle",
            Group::Coolant => "coolant",
            Group::Overrides => "override switches",
            Group::User => "user M codes",
        }
    }
}

impl Action {
    /// The modal group.
    pub const fn group(self) -> Group {
        match self {
            Action::Dwell => Group::NonModal,
            Action::Motion(_) => Group::Motion,
            Action::Plane(_) => Group::Plane,
            Action::Distance(_) => Group::Distance,
            Action::ArcDistance(_) => Group::ArcDistance,
            Action::FeedPerMinute => Group::FeedMode,
            Action::Units(_) => Group::Units,
            Action::WorkOffset(_) => Group::WorkOffset,
            Action::Control(_) => Group::Control,
            Action::Stop(_) => Group::Stopping,
            Action::ToolChange => Group::ToolChange,
            Action::Spindle(_) => Group::Spindle,
            Action::Coolant(_) => Group::Coolant,
            Action::Overrides(_) => Group::Overrides,
            Action::User(_) => Group::User,
        }
    }

    /// Letters beside F, S, T that the code reads. Axis words belong to the motion, whichever block set it.
    pub const fn operands(self) -> &'static str {
        match self {
            Action::Motion(Some(Motion::Rapid | Motion::Linear)) => "XYZABC",
            Action::Motion(Some(Motion::ArcCw | Motion::ArcCcw)) => "XYZABCIJKRP",
            Action::Dwell | Action::Control(Control::Continuous) => "P",
            Action::User(_) => "PQ",
            _ => "",
        }
    }
}

/// The G code with this number in tenths (`911` is G91.1).
pub fn g(tenths: u32) -> Option<Action> {
    Some(match tenths {
        0 => Action::Motion(Some(Motion::Rapid)),
        10 => Action::Motion(Some(Motion::Linear)),
        20 => Action::Motion(Some(Motion::ArcCw)),
        30 => Action::Motion(Some(Motion::ArcCcw)),
        40 => Action::Dwell,
        170 => Action::Plane(Plane::Xy),
        180 => Action::Plane(Plane::Xz),
        190 => Action::Plane(Plane::Yz),
        200 => Action::Units(Units::Inches),
        210 => Action::Units(Units::Mm),
        540 | 550 | 560 | 570 | 580 | 590 => Action::WorkOffset((tenths as usize - 540) / 10),
        610 => Action::Control(Control::ExactPath),
        611 => Action::Control(Control::ExactStop),
        640 => Action::Control(Control::Continuous),
        800 => Action::Motion(None),
        900 => Action::Distance(Distance::Absolute),
        910 => Action::Distance(Distance::Incremental),
        901 => Action::ArcDistance(Distance::Absolute),
        911 => Action::ArcDistance(Distance::Incremental),
        940 => Action::FeedPerMinute,
        _ => return None,
    })
}

/// The M code with this number. 10..=199 without a meaning here belong to the PLC program, but not the subprogram calls M98, M99.
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
        48 => Action::Overrides(true),
        49 => Action::Overrides(false),
        98 | 99 => return None,
        10..=199 => Action::User(number),
        _ => return None,
    })
}

/// What to write instead of a G code of other controls or of a later version; empty if there is nothing to say.
pub fn instead_of_g(tenths: u32) -> &'static str {
    match tenths {
        50 | 51 | 52 | 53 | 61 | 62 => "approximate the spline by G1 or G2/G3 blocks",
        100 | 280 | 300 | 520 | 530 | 920 | 921 | 922 | 923 => {
            "offsets come from the work offset table: select one with G54 .. G59"
        }
        400 | 410 | 420 | 430 | 431 | 440 | 490 => {
            "let the CAM system compensate the tool; compensation is not part of this version"
        }
        730..=739 | 760 | 810 | 820 | 830 | 840 | 850 | 860 | 870 | 880 | 890 => "write the cycle as G0, G1 and G4 blocks",
        930 | 950 => "write feeds in length units a minute (G94)",
        _ => "supported are G0 G1 G2 G3 G4 G17 G18 G19 G20 G21 G54..G59 G61 G61.1 G64 G80 G90 G90.1 G91 G91.1 G94",
    }
}
