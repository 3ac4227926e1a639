//! The one place where a Fanuc-style dialect meets the kernel of the interpreter: moves in work coordinates, and blocks of RS274/NGC.
//! Runs: background.

use crate::canon::{Arc, Canon, Position};
use crate::ngc::comp;
use crate::ngc::execute::{self, Done, Out, Run, Then};
use crate::ngc::modal::{Motion, Offsets};
use crate::ngc::motion::{check_feed, checked, inverse_time};
use crate::ngc::request::Request;
use crate::ngc::state::State;
use crate::ngc::word::Action;
use takt_base::{Diag, Severity, SourceId, Span};

/// The kernel's state and where its commands go.
pub struct Io<'a, 'b> {
    /// Modes, parameters, tools.
    pub state: &'a mut State,
    /// Commands and diagnostics.
    pub out: Out<'b>,
    /// A block of the kernel.
    pub request: &'a mut Request,
    /// The block at hand.
    pub span: Span,
}

/// A code and the words that it reads, in length units.
pub type Words<'w> = &'w [(char, f64)];

impl<'b> Io<'_, 'b> {
    /// The block at hand is `span` of line `line`.
    pub fn at(&mut self, source: SourceId, place: (u32, u32), line: u32, n: Option<u32>) {
        self.span = Span { source, start: place.0, end: place.1 };
        (self.out.line, self.out.n) = (line, n);
        self.state.line = line;
        self.request.reset(self.span, n);
    }

    /// The kernel at work on the block that was put together.
    pub fn run(&mut self) -> Run<'_, 'b> {
        Run { request: self.request, state: self.state, out: &mut self.out, then: Then::Next }
    }

    /// Adds a command, behind a move that waits for compensation.
    pub fn emit(&mut self, command: Canon) {
        self.run().emit(command);
    }

    /// A mistake; the program goes no further than this block.
    pub fn wrong(&mut self, diag: Diag) {
        self.out.diags.push(diag);
    }

    /// True if the block has an error.
    pub fn failed(&self) -> bool {
        self.out.diags.iter().any(|d| d.severity == Severity::Error)
    }

    /// Executes a block with these codes and words.
    pub fn obey(&mut self, actions: &[Action], words: Words, at: Span) {
        self.request.reset(self.span, self.out.n);
        for &action in actions {
            self.request.put_code(action, at);
        }
        for &(letter, value) in words {
            self.request.put_word(letter, value, at);
        }
        let before = self.out.diags.len();
        execute::execute(self.request, &crate::ngc::code::Row::bare(), &Default::default(), self.state, &mut self.out);
        // What the kernel says in its own code is said of this block.
        for diag in &mut self.out.diags[before..] {
            if diag.span.end <= diag.span.start {
                diag.span = at;
            }
        }
    }

    /// A straight move to `end` in work coordinates.
    ///
    /// # Errors
    /// No feed, or compensation can't follow.
    pub fn straight(&mut self, end: Position, rapid: bool, at: Span) -> Done {
        let mut run = self.run();
        if !rapid {
            check_feed(&mut run, Motion::Linear)?;
        }
        let command = if rapid { Canon::StraightTraverse(end) } else { Canon::StraightFeed(end) };
        follow(&mut run, command, end, at)
    }

    /// An arc to `end` in work coordinates.
    ///
    /// # Errors
    /// No feed, or compensation can't follow.
    pub fn arc(&mut self, arc: Arc, end: Position, at: Span) -> Done {
        let mut run = self.run();
        check_feed(&mut run, Motion::ArcCw)?;
        follow(&mut run, Canon::ArcFeed(arc), end, at)
    }

    /// A straight move past compensation and feed, with what is around it given out by the caller.
    pub fn place(&mut self, command: Canon, end: Position, at: Span) {
        let mut run = self.run();
        checked(&mut run, command, at);
        run.modal().position = end;
    }

    /// Other offsets of work and local coordinates (mm, degrees).
    pub fn origin(&mut self, work: Position, local: Position) {
        let before = self.state.modal.offsets;
        if (before.work, before.local, before.rotation) == (work, local, 0.0) {
            return;
        }
        self.state.modal.change_offsets(Offsets { work, local, rotation: 0.0, ..before });
        let origin = execute::origin(&self.state.modal);
        self.emit(origin);
    }
}

fn follow(run: &mut Run, command: Canon, end: Position, at: Span) -> Done {
    if run.state.comp.active(&run.state.modal) {
        comp::follow(run, command, end)?;
    } else {
        inverse_time(run, &command)?;
        checked(run, command, at);
    }
    run.modal().position = end;
    Ok(())
}
