//! The interpreter: an iterator of canonical commands that reads one block when it has none left.
//!
//! First come the modes that the options set, as block 0: `USE_LENGTH_UNITS`, `SET_ORIGIN_OFFSETS`, `SET_FEED_REFERENCE`, `SELECT_PLANE`,
//! `SET_MOTION_CONTROL_MODE`; so the commands can be run or drawn without the options. `INIT_CANON` and `END_CANON` belong to whoever opens
//! and closes the machine. The last command is always `PROGRAM_END`: from M2 or M30, or from the end of the text or a closing `%`.
//! A comment does not count as a block; its commands carry the number of the block before.

use super::block;
use super::execute::{self, Outcome};
use super::lines::{Lines, Piece};
use super::modal::Modal;
use super::options::Options;
use crate::canon::{Canon, FeedReference, ProgramEnd, Step};
use std::collections::VecDeque;
use std::sync::Arc;
use takt_base::{Code, Diag, Severity, SourceId, Span};

/// Reads a part program. Owns its text, so it can be sent to a background thread.
#[derive(Clone, Debug)]
pub struct Interpreter {
    source: SourceId,
    text: Arc<str>,
    options: Options,
    lines: Lines,
    modal: Modal,
    queue: VecDeque<Step>,
    block: u32,
    opened: bool,
    ended: bool,
}

/// All errors and warnings of a program, in the order of the text up to M2, M30 or a closing `%`. Goes on behind a wrong block with the
/// state that it would have left.
pub fn check(source: SourceId, text: impl Into<Arc<str>>, options: Options) -> Vec<Diag> {
    let mut interpreter = Interpreter::new(source, text, options);
    let mut diags = Vec::new();
    while !interpreter.ended {
        interpreter.queue.clear();
        diags.extend(interpreter.advance());
    }
    diags
}

impl Interpreter {
    /// At the start of `text`, which is file `source` of the diagnostics.
    pub fn new(source: SourceId, text: impl Into<Arc<str>>, options: Options) -> Self {
        let text = text.into();
        let lines = Lines::new(&text, options.style);
        let modal = Modal::new(&options);
        let queue = prologue(&modal, &options).map(|command| Step { block: 0, line: 0, n: None, command }).into();
        Interpreter { source, text, options, lines, modal, queue, block: 0, opened: false, ended: false }
    }

    /// The modal state behind the last block that was read.
    pub fn modal(&self) -> &Modal {
        &self.modal
    }

    /// Reads one piece of the text: its commands go to the queue, its diagnostics are returned.
    fn advance(&mut self) -> Vec<Diag> {
        let Some(piece) = self.lines.next(&self.text) else {
            self.finish();
            return Vec::new();
        };
        let text = self.text.clone();
        let text = &text[piece.range.clone()];
        if text.trim_start_matches([' ', '\t']).starts_with('%') {
            return self.percent(text, &piece).into_iter().collect();
        }
        self.opened = true;
        match block::read(self.source, piece.range.start, piece.line, text) {
            Ok(block) => self.run(&block),
            Err(diag) => {
                self.block = self.block.saturating_add(1);
                vec![diag]
            }
        }
    }

    fn run(&mut self, block: &block::Block) -> Vec<Diag> {
        if block.deleted && self.options.skip_deleted {
            return Vec::new();
        }
        if block.n.is_some() || !block.words.is_empty() {
            self.block = self.block.saturating_add(1);
        }
        let outcome = execute::execute(block, &mut self.modal, &self.options);
        self.ended = outcome.end;
        if !outcome.has_errors() { self.accept(block, outcome) } else { outcome.diags }
    }

    fn accept(&mut self, block: &block::Block, outcome: Outcome) -> Vec<Diag> {
        let number = self.block;
        let step = |command| Step { block: number, line: block.line, n: block.n, command };
        self.queue.extend(outcome.commands.into_iter().map(step));
        outcome.diags
    }

    /// A line with `%`: before the first block it opens the program, later it ends it.
    fn percent(&mut self, text: &str, piece: &Piece) -> Option<Diag> {
        if text.trim_matches([' ', '\t']) != "%" {
            let span = Span::new(self.source, piece.range.start, piece.range.end);
            return Some(Diag::new(Code::BadCharacter, span, "text beside `%`").help("put `%` on a line of its own"));
        }
        if self.opened {
            self.finish();
        }
        self.opened = true;
        None
    }

    fn finish(&mut self) {
        self.ended = true;
        let line = self.lines.line();
        self.queue.push_back(Step { block: self.block, line, n: None, command: Canon::ProgramEnd(ProgramEnd::EndOfFile) });
    }
}

impl Iterator for Interpreter {
    type Item = Result<Step, Box<Diag>>;

    /// The next command, or the error of the next block: then nothing of that block has been given out, and nothing follows.
    /// Warnings are left to [`check`].
    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let Some(step) = self.queue.pop_front() {
                return Some(Ok(step));
            }
            if self.ended {
                return None;
            }
            let error = self.advance().into_iter().find(|d| d.severity == Severity::Error);
            if let Some(diag) = error {
                self.ended = true;
                self.queue.clear();
                return Some(Err(Box::new(diag)));
            }
        }
    }
}

impl std::iter::FusedIterator for Interpreter {}

fn prologue(modal: &Modal, options: &Options) -> [Canon; 5] {
    [
        Canon::UseLengthUnits(modal.units),
        execute::origin(modal, options),
        Canon::SetFeedReference(FeedReference::Xyz),
        Canon::SelectPlane(modal.plane),
        Canon::SetMotionControlMode(modal.control),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canon::Position;

    fn near(p: Position, x: f64, y: f64) -> bool {
        (p.x - x).abs() < 5e-6 && (p.y - y).abs() < 5e-6 && p.z == 0.0
    }

    /// CM-T4, CM-T5: offsets and units renumber the position and the feed, and nothing moves.
    #[test]
    fn renumbering() {
        let place = |x, y| Position { x, y, ..Position::default() };
        let mut options = Options { start: place(100.0, 50.0), ..Options::default() };
        options.work_offsets[1] = place(10.0, 20.0);
        let behind = |text: &str| {
            let mut interpreter = Interpreter::new(SourceId(0), text, options.clone());
            assert!(interpreter.by_ref().all(|s| s.is_ok_and(|s| !matches!(s.command, Canon::StraightTraverse(_)))));
            *interpreter.modal()
        };
        assert!(near(behind("F1000 G55").position, 90.0, 30.0));
        let modal = behind("F1000 G55\nG20");
        assert!(near(modal.position, 3.54331, 1.18110), "{modal:?}");
        assert!(modal.feed.is_some_and(|f| (f - 39.3701).abs() < 5e-5));
    }
}
