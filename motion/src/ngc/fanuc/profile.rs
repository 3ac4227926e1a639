//! The blocks N P to N Q of a turning cycle: executed for G70, or read as a contour for G71, G72, G73.

use super::Machine;
use super::Went;
use super::block::Block;
use super::flow::Next;
use super::kernel::Io;
use super::moves::{Seg, Shape};
use super::table::Meaning;
use crate::ngc::arc::Point;
use crate::ngc::comp::corner::Curve;
use crate::ngc::execute::Done;
use crate::ngc::request::missing;
use takt_base::{Code, Diag, Span};

/// Rows that a contour may have.
const ROWS_MAX: u32 = 100_000;

/// P and Q: the first and the last block.
pub type Bounds = (u32, u32);

impl Machine {
    /// P and Q of a block.
    pub(super) fn bounds(&self, b: &Block, at: Span) -> Result<Bounds, Box<Diag>> {
        let help = "write the N numbers of the first and the last block of the contour: P100 Q200";
        let word = |letter| {
            Self::whole_word(b, letter, help)?.ok_or_else(|| Box::new(missing(at, &super::block::name(letter)).help(help)))
        };
        Ok((word(b'P')?, word(b'Q')?))
    }

    /// Executes the blocks of a contour; the program then goes on behind the cycle.
    /// A contour that is read and stands directly behind its cycle is not executed once more: the program goes on behind its last block.
    pub(super) fn run_profile(&mut self, (first, last): Bounds, at: Span, io: &mut Io) -> Done {
        if self.in_profile {
            let diag = Diag::new(Code::BadContour, at, "a cycle inside of a contour");
            return Err(Box::new(diag.help("a contour has G0, G1, G2 and G3 blocks alone")));
        }
        let source = self.flow.source();
        let saved = self.flow.save();
        let follows = self.recording.is_some() && self.next_number() == Some(first);
        self.flow.restore(saved.clone());
        self.flow.goto(first, (at.start, at.end)).map_err(|fault| Box::new(fault.diag(source)))?;
        self.in_profile = true;
        let done = self.profile_rows(last, at, io);
        self.in_profile = false;
        let behind = self.flow.spot();
        self.flow.restore(saved);
        if follows && done.is_ok() {
            self.flow.go(behind);
        }
        io.span = at;
        done
    }

    /// N of the next row that is more than a comment.
    fn next_number(&mut self) -> Option<u32> {
        for _ in 0..ROWS_MAX {
            match self.flow.next_row() {
                Next::Row(row) if row.is_empty() && row.n.is_none() => {}
                Next::Row(row) => return row.n,
                _ => return None,
            }
        }
        None
    }

    fn profile_rows(&mut self, last: u32, at: Span, io: &mut Io) -> Done {
        let depth = self.flow.depth();
        for _ in 0..ROWS_MAX {
            let row = match self.flow.next_row() {
                Next::Row(row) => row,
                Next::Wrong(fault, _) => return Err(Box::new(fault.diag(self.flow.source()))),
                Next::Percent(..) | Next::End => break,
            };
            if row.program.is_some() {
                break;
            }
            let errors = io.out.diags.len();
            let went = self.row(&row, io);
            let here = self.flow.depth() == depth;
            if (here && row.n == Some(last)) || (io.out.diags.len() > errors && io.failed()) {
                return Ok(());
            }
            if went != Went::On || self.flow.depth() < depth {
                break;
            }
        }
        let label = format!("the contour does not come to N{last}");
        Err(Box::new(
            Diag::new(Code::MissingBlock, at, label).help("write its last block, with this number, behind the first one"),
        ))
    }

    /// Reads a contour: its moves, the way to its start first.
    pub(super) fn contour(&mut self, bounds: Bounds, at: Span, io: &mut Io) -> Result<Vec<Seg>, Box<Diag>> {
        let modes = self.modes.clone();
        let (block, line, n) = (io.out.block, io.out.line, io.out.n);
        self.recording = Some(Vec::new());
        let done = self.run_profile(bounds, at, io);
        self.end_corner(io);
        let segs = self.recording.take().unwrap_or_default();
        self.modes = modes;
        (io.out.block, io.out.line, io.out.n) = (block, line, n);
        io.request.reset(at, n);
        done?;
        if segs.len() < 2 && !io.failed() {
            let diag = Diag::new(Code::BadContour, at, "fewer than two moves");
            return Err(Box::new(diag.help("the first block leads to the contour, the others along it")));
        }
        Ok(segs)
    }

    /// One block of a contour that is read: its move alone counts.
    pub(super) fn record(&mut self, b: &Block, io: &mut Io) -> Done {
        for code in &b.codes {
            match code.meaning {
                Meaning::Rapid | Meaning::Line | Meaning::Arc(_) => self.modes.codes[1] = code.tenths,
                Meaning::Side(_) | Meaning::Surface(_) | Meaning::Feed(_) | Meaning::Nothing(_) | Meaning::Plane(_) => {}
                _ => {
                    let diag = Diag::new(Code::BadContour, code.span, "this code can't stand in a contour");
                    return Err(Box::new(diag.help("a contour has G0, G1, G2 and G3 blocks alone")));
                }
            }
        }
        let codes = self.modes.codes;
        if !matches!(codes[1], 0 | 10 | 20 | 30) {
            self.modes.codes[1] = 0;
        }
        if !self.names_axis(b) && !b.any("IJKR") {
            return Ok(());
        }
        self.plain_motion(b, io)
    }
}

/// The contour behind its first move as curves in (Z, X).
pub fn curves(segs: &[Seg]) -> Vec<Curve> {
    let flat = |p: crate::canon::Position| -> Point { [p.z, p.x] };
    segs.iter()
        .skip(1)
        .filter(|s| s.from != s.to)
        .map(|s| match s.shape {
            Shape::Arc { centre, turns } => {
                Curve::Arc { start: flat(s.from), end: flat(s.to), centre, counterclockwise: turns > 0 }
            }
            _ => Curve::Line { start: flat(s.from), end: flat(s.to) },
        })
        .collect()
}
