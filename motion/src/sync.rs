//! What a part program waits for: while one of these commands is on its way nothing behind it is read, since what it does depends on
//! the answer.
//! Runs: both. Everything is `Copy`: it passes the rings between background and cyclic side.

use crate::canon::{Canon, Probe};
use crate::geometry::Point;
use crate::plc::{READS, Variable};

/// The machine's answer.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Answer {
    /// M66: the value of the input, 1 or 0 if it is digital; -1 if the time was up.
    Input(f64),
    /// G38: machine positions in mm and degrees.
    Probe {
        /// Where the probe tripped, if it did.
        trip: Option<Point>,
        /// Where the machine stands.
        stop: Point,
    },
    /// Values of PLC variables, in the order of the request.
    Values([f64; READS]),
}

/// PLC variables that a row reads.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Reads {
    /// The first `count` count.
    pub variables: [Variable; READS],
    /// How many.
    pub count: u8,
}

/// What a planned move does apart from moving.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Special {
    /// Looks at the probe (G38.2 .. G38.5).
    Probe(Probe),
    /// Follows the spindle (G33).
    Thread {
        /// mm a revolution.
        pitch: f64,
        /// It begins at the mark of the encoder; else it goes on behind the thread before it.
        starts: bool,
    },
    /// The same to the end and back (G33.1).
    Tap(f64),
}

/// True if the program goes on only when the machine has answered.
pub fn waits_for_answer(command: &Canon) -> bool {
    matches!(command, Canon::WaitInput(_) | Canon::StraightProbe(..) | Canon::ReadPlc(_))
}
