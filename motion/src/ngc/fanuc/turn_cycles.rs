//! G74 and G75 of turning: pecks along Z or X, beside each other along the other axis. In two blocks (`R`, then `X Z P Q R F`) or in one
//! (`X Z I K D F`).

use super::Machine;
use super::block::Block;
use super::kernel::Io;
use super::moves::Shape;
use crate::canon::Position;
use crate::ngc::execute::Done;
use takt_base::{Code, Diag, Span};

/// Pecks that one cycle may have.
const PECKS_MAX: f64 = 100_000.0;

impl Machine {
    /// `across`: G75, which pecks along X.
    pub(super) fn groove(&mut self, b: &Block, across: bool, at: Span, io: &mut Io) -> Done {
        let unit = io.state.unit();
        if !b.any("XZUW") {
            if let Some(word) = b.take(b'R') {
                self.modes.groove = self.length_of(word).abs() * unit;
            }
            return Ok(());
        }
        let start = self.modes.at;
        let end = self.target(b, io)?;
        // P or I steps along X (a radius), Q or K along Z; D or R goes aside at the bottom.
        let step = |lengths: u8, counts: u8| match (b.take(lengths), b.take(counts)) {
            (Some(word), _) => self.length_of(word).abs(),
            (None, Some(word)) => self.increments_of(word).abs(),
            (None, None) => 0.0,
        };
        let (step_x, step_z) = (step(b'I', b'P'), step(b'K', b'Q'));
        let aside = b.take(b'R').or_else(|| b.take(b'D')).map_or(0.0, |w| self.length_of(w).abs());
        let back = self.modes.groove / unit;
        let (peck, over) = if across { (step_x, step_z) } else { (step_z, step_x) };
        let (depth, width) = if across { (end.x - start.x, end.z - start.z) } else { (end.z - start.z, end.x - start.x) };
        let columns = if over > 0.0 { (width.abs() / over - 1e-9).ceil() } else { f64::from(u8::from(width != 0.0)) };
        let pecks = if peck > 0.0 { (depth.abs() / peck).ceil() } else { 1.0 };
        if (columns + 1.0) * pecks > PECKS_MAX {
            let help = "make P and Q larger: they count thousandths, P2000 is 2 mm";
            return Err(Box::new(Diag::new(Code::BadValue, at, "more than 100000 pecks").help(help)));
        }
        let place = |along: f64, beside: f64| match across {
            true => Position { x: start.x + along, z: start.z + beside, ..start },
            false => Position { z: start.z + along, x: start.x + beside, ..start },
        };
        for column in 0..=columns as u32 {
            let beside =
                if over > 0.0 { (over * f64::from(column)).min(width.abs()) * width.signum() } else { width * f64::from(column) };
            self.step(place(0.0, beside), Shape::Rapid, at, io)?;
            let mut reached = peck;
            while peck > 0.0 && reached < depth.abs() - 1e-9 {
                self.step(place(reached * depth.signum(), beside), Shape::Line, at, io)?;
                self.step(place((reached - back).max(0.0) * depth.signum(), beside), Shape::Rapid, at, io)?;
                reached += peck;
            }
            self.step(place(depth, beside), Shape::Line, at, io)?;
            // Not in the first column: the wall beside it still stands.
            if aside > 0.0 && column > 0 {
                self.step(place(depth, beside - aside * width.signum()), Shape::Rapid, at, io)?;
            }
            let behind = if aside > 0.0 && column > 0 { beside - aside * width.signum() } else { beside };
            self.step(place(0.0, behind), Shape::Rapid, at, io)?;
        }
        self.step(start, Shape::Rapid, at, io)
    }
}
