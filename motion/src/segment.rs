//! What passes the ring from look-ahead to execution.
//! Runs: both. Everything is `Copy` and of fixed size: the cyclic side neither allocates nor frees.

use crate::canon::{Input, Step};
use crate::geometry::Path;
use crate::plc::Variable;
use crate::profile::Profile;
use crate::pulse::PulseMove;
use crate::run::outputs::Output;
use crate::spindle::SpindleCommand;
use crate::sync::{Reads, Special};
use takt_base::Code;

/// Where in the part program something comes from.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Mark {
    /// Block in execution order, from 1.
    pub block: u32,
    /// Source line, from 1.
    pub line: u32,
    /// N word; 0 if there is none.
    pub n: u32,
}

impl From<&Step> for Mark {
    fn from(step: &Step) -> Self {
        Self { block: step.block, line: step.line, n: step.n.unwrap_or(0) }
    }
}

/// A planned path element.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Segment {
    /// Geometry.
    pub path: Path,
    /// Speed along it.
    pub profile: Profile,
    /// Path acceleration that all axes can follow everywhere on it, mm/s2.
    pub accel: f64,
    /// Programmed speed in mm/s, which the plan may not reach; that of a positioning move is its limit.
    pub feed: f64,
    /// Positioning move: the rapid override counts.
    pub rapid: bool,
    /// mm a revolution of the spindle, which caps the speed (G95); 0: none.
    pub per_rev: f64,
}

/// Switches that a part program turns on and off.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Switch {
    /// M50: the feed override counts.
    Feed,
    /// M52.
    Adaptive,
    /// M53.
    FeedHold,
    /// M51.
    Spindle,
}

/// M, S and T codes of one block that are shown together (scenario S39).
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct AuxCodes {
    /// M codes.
    pub m: [u16; 4],
    /// How many of them.
    pub m_count: u8,
    /// P and Q words of each M code.
    pub m_param: [[f64; 2]; 4],
    /// Spindle speed.
    pub s: Option<f64>,
    /// Tool number.
    pub t: Option<u32>,
    /// Wait for the PLC program before going on.
    pub wait: bool,
}

/// A program error that stops the channel.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ErrorNote {
    /// What is wrong.
    pub code: Code,
    /// Source line, from 1; 0 if it has none.
    pub line: u32,
    /// Column, from 1; 0 if it has none.
    pub column: u32,
    /// Message, UTF-8, padded with zeros.
    pub text: [u8; ErrorNote::TEXT],
}

impl ErrorNote {
    /// Bytes of message.
    pub const TEXT: usize = 120;

    /// A note; a long text is cut at a character border.
    pub fn new(code: Code, line: u32, column: u32, text: &str) -> Self {
        let mut cut = text.len().min(Self::TEXT);
        while !text.is_char_boundary(cut) {
            cut -= 1;
        }
        let mut bytes = [0; Self::TEXT];
        bytes[..cut].copy_from_slice(&text.as_bytes()[..cut]);
        Self { code, line, column, text: bytes }
    }

    /// The message.
    pub fn message(&self) -> &str {
        let end = self.text.iter().position(|&b| b == 0).unwrap_or(Self::TEXT);
        std::str::from_utf8(&self.text[..end]).unwrap_or("")
    }
}

/// One step of a planned program.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Action {
    /// Move with planned speed.
    Move(Segment),
    /// The same from rest to rest with a probe or in step with the spindle.
    Special(Segment, Special),
    /// Reference pulses.
    Pulse(PulseMove),
    /// Axes still for this many seconds.
    Dwell(f64),
    /// Show codes; with `wait` at rest.
    Aux(AuxCodes),
    /// A switch is turned on or off.
    Switch(Switch, bool),
    /// Speed and direction of the spindle.
    Spindle(SpindleCommand),
    /// An output gets a value.
    Output(Output),
    /// A variable of the PLC program gets a value.
    Write(Variable, f64),
    /// The program waits for variables of the PLC program.
    Read(Reads),
    /// The program waits for an input.
    WaitInput(Input),
    /// M0 or, with `optional`, M1.
    ProgramStop {
        /// M1.
        optional: bool,
    },
    /// End of program; the M code, 0 at the end of the file.
    End {
        /// 0, 2 or 30.
        m: u16,
    },
    /// A wrong block: everything before it has been executed.
    Fault(ErrorNote),
}

impl Action {
    /// True if the path is at rest when this begins.
    pub fn is_stop(&self) -> bool {
        match self {
            Action::Aux(codes) => codes.wait,
            Action::Special(..)
            | Action::Dwell(_)
            | Action::Read(_)
            | Action::WaitInput(_)
            | Action::ProgramStop { .. }
            | Action::End { .. }
            | Action::Fault(_) => true,
            Action::Move(_)
            | Action::Pulse(_)
            | Action::Switch(..)
            | Action::Spindle(_)
            | Action::Output(_)
            | Action::Write(..) => false,
        }
    }

    /// True if nothing comes behind it before the machine has answered.
    pub fn is_question(&self) -> bool {
        matches!(self, Action::Read(_) | Action::WaitInput(_) | Action::Special(_, Special::Probe(_)))
    }
}

/// An action and its place.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Planned {
    /// Which run of the channel it belongs to; left-overs of an aborted run are dropped.
    pub run: u32,
    /// Place in the part program.
    pub mark: Mark,
    /// What to do.
    pub action: Action,
}
