//! Cutter radius compensation G40, G41, G42 and their .1 forms (RS274/NGC appendix B, LinuxCNC "Cutter Compensation").
//! Runs: background. One move waits until the next one is known, since an inside corner moves its end; commands behind it wait with it.
//! Invariant: what is emitted runs at the tool radius beside the contour; at outside corners an arc leads round the corner.

mod contour;
pub(in crate::ngc) mod corner;

use super::arc::Point;
use super::execute::{Done, Run};
use super::modal::{Modal, Side};
use super::request::{bad_value, not_now};
use super::word::{Action, Group};
use crate::canon::{Plane, Step};
use contour::Pending;
pub use contour::{follow, release};
use takt_base::{Code, Diag, Span};

/// The state of compensation.
#[derive(Clone, Debug, Default)]
pub struct Comp {
    /// Radius in mm; negative for the other side.
    radius_mm: f64,
    /// Orientation of a lathe tool, 0 to 9.
    orientation: u32,
    /// The next move leads to the contour.
    first: bool,
    /// The move that waits.
    pending: Option<Pending>,
    /// What waits behind it.
    held: Vec<Held>,
}

/// Commands that may wait behind a move.
const HELD_MAX: usize = 20_000;

/// A command behind the move that waits.
#[derive(Clone, Debug)]
struct Held {
    step: Step,
    /// A move of the third axis alone: it stays over the end of the move that waits.
    follows: bool,
}

impl Comp {
    /// True if moves have to be compensated.
    pub fn active(&self, modal: &Modal) -> bool {
        modal.side.is_some()
    }

    /// True while a move waits for the next one.
    pub fn waits(&self) -> bool {
        self.pending.is_some()
    }

    /// True if no more commands can wait.
    pub fn is_full(&self) -> bool {
        self.held.len() >= HELD_MAX
    }

    /// Takes a command that comes while a move waits.
    pub fn hold(&mut self, step: Step) {
        self.held.push(Held { step, follows: false });
    }

    /// Forgets what waits, behind an error.
    pub fn reset(&mut self) {
        self.pending = None;
        self.held.clear();
    }

    /// Tool radius in length units of `unit` mm, with its sign.
    fn radius(&self, unit: f64) -> f64 {
        self.radius_mm / unit
    }

    /// Where the control point of a lathe tool lies when the centre of its tip is at `p` in (Z, X).
    fn control_point(&self, [z, x]: Point, unit: f64, plane: Plane) -> Point {
        if plane != Plane::Xz || self.orientation == 0 {
            return [z, x];
        }
        let r = self.radius_mm.abs() / unit;
        let x = match self.orientation {
            1 | 2 | 6 => x - r,
            3 | 4 | 8 => x + r,
            _ => x,
        };
        let z = match self.orientation {
            2 | 3 | 7 => z - r,
            1 | 4 | 5 => z + r,
            _ => z,
        };
        [z, x]
    }
}

impl Run<'_, '_> {
    pub(super) fn compensation(&mut self) -> Done {
        let Some(Action::Compensation(side, dynamic)) = self.request.code(Group::Compensation) else { return Ok(()) };
        let Some(side) = side else {
            self.compensation_off();
            return Ok(());
        };
        let at = self.request.code_span(Group::Compensation);
        if self.state.modal.side.is_some() {
            return Err(Box::new(not_now(at, "compensation is in force already", "write G40 before another G41 or G42")));
        }
        if self.state.modal.plane == Plane::Yz {
            return Err(Box::new(not_now(at, "compensation in the plane YZ", "write G17 or G18 before it")));
        }
        let (radius_mm, orientation) = if dynamic { self.given_tool()? } else { self.table_tool()? };
        self.state.comp = Comp { radius_mm, orientation, first: true, ..Comp::default() };
        let modal = self.modal();
        modal.side = Some(side);
        modal.side_dynamic = dynamic;
        Ok(())
    }

    /// Radius and orientation of the tool that D names, or of the one in the spindle.
    fn table_tool(&self) -> Result<(f64, u32), Box<Diag>> {
        let entry = match self.request.word('D') {
            None => self.state.tools.in_spindle(),
            Some(word) => match word.whole() {
                Some(0) => self.state.tools.in_spindle(),
                Some(number) => self.tool(number, word.span)?,
                None => return Err(Box::new(bad_value(word, "not the number of a tool", "write a whole number from 0"))),
            },
        };
        Ok((entry.diameter / 2.0, entry.orientation))
    }

    /// Radius from the diameter in D, orientation from L.
    fn given_tool(&self) -> Result<(f64, u32), Box<Diag>> {
        let at = self.request.code_span(Group::Compensation);
        let Some(word) = self.request.word('D') else {
            let help = "write the diameter, such as G41.1 D6";
            return Err(Box::new(super::request::missing(at, "D").help(help)));
        };
        let orientation = match self.request.word('L') {
            None => 0,
            Some(l) => match l.whole().filter(|&o| o <= 9 && (o == 0 || self.state.modal.plane == Plane::Xz)) {
                Some(o) => o,
                None => return Err(Box::new(bad_value(l, "no orientation", "write L0 to L9; it needs the plane XZ (G18)"))),
            },
        };
        Ok((word.value / 2.0 * self.state.unit(), orientation))
    }

    /// G40: what waits goes out as it is.
    fn compensation_off(&mut self) {
        self.flush_compensation();
        self.modal().side = None;
        self.state.comp = Comp::default();
    }

    /// Emits the move that waits, and what waits behind it.
    pub fn flush_compensation(&mut self) {
        contour::release(self.state, self.out);
    }
}

/// Compensation ends a move when it knows the next one: what lies between has to wait.
pub fn too_many_wait(at: Span) -> Diag {
    let label = "20000 commands wait for the next move in the plane";
    Diag::new(Code::ProgramTooLarge, at, label).help("write G40 before work without motion in the plane")
}

/// Left is 1, right is -1.
fn sign(side: Side) -> f64 {
    match side {
        Side::Left => 1.0,
        Side::Right => -1.0,
    }
}
