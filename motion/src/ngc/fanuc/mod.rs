//! Fanuc-style dialects for milling and turning (R1-32..R1-103, book appendix A, R2-340..R2-343).
//!
//! A program has its own reader and flow ([`reader`], [`flow`]), variables (`vars`) and code tables ([`table`]); a block ([`block`]) becomes
//! moves in work coordinates and blocks of the kernel ([`kernel`]), so that compensation, tools, limits and canonical commands are the same as
//! in RS274/NGC. Runs: background. Invariant: one row at a time, calls, loops, passes and points bounded.

mod assign;
pub mod block;
mod calls;
mod corner;
mod data;
mod drill;
mod drill_turn;
mod exec;
pub mod expr;
pub mod flow;
pub mod kernel;
mod modes;
mod moves;
mod nurbs;
mod offsets;
mod profile;
pub mod reader;
mod reference;
pub mod settings;
mod switches;
pub mod table;
mod thread;
mod transform;
mod turn_cycles;
mod turn_multi;
mod turn_passes;
mod vars;
mod virtual_axis;

pub use settings::{Dialect, Language, MacroCall, Settings, UserCode};

use super::code::CommentKind;
use super::options::Options;
use super::state::State;
use crate::canon::{Canon, Plane, ProgramEnd};
use crate::ngc::text::Text;
use block::Block;
use flow::{Flow, Next};
use kernel::Io;
use modes::Modes;
use reader::{Control, Row};
use takt_base::{Code, Diag, SourceId, Span};
use vars::{Vars, View};

/// A program at work.
#[derive(Clone, Debug)]
pub struct Machine {
    flow: Flow,
    vars: Vars,
    modes: Modes,
    block: Block,
    stack: expr::Stack,
    /// The row at hand may be the first of its program.
    fresh: bool,
    /// A corner that waits for the move behind it.
    corner: Option<corner::Corner>,
    /// Moves of a contour, where one is read for a cycle.
    recording: Option<Vec<moves::Seg>>,
    /// The last row was a skip move: the machine says where it ended.
    skipped: bool,
    /// The blocks of a contour are being run.
    in_profile: bool,
    nurbs: Option<nurbs::Curve>,
    modal_macro: Option<calls::ModalMacro>,
    /// The feed mode at the start was given out.
    said_feed_mode: bool,
    /// A `%` that ends the program, or stands inside of it if a row follows.
    stray: Option<Span>,
    /// Text of the comment of the row at hand, for alarms.
    said: String,
}

/// What a row does to the program.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Went {
    /// The next row.
    On,
    /// M2, M30, or an alarm: nothing follows.
    Ended,
    /// The end of the text without M2 or M30.
    Out,
    /// M99 in the main program: it starts anew.
    Again,
}

/// Sets what the dialect has in force before the first block.
pub fn prepare(state: &mut State, dialect: Dialect) {
    if dialect == Dialect::FanucTurn {
        state.modal.feed_mode = super::modal::FeedMode::PerRevolution;
        if state.modal.plane == Plane::Xy {
            state.modal.plane = Plane::Xz;
        }
    }
}

impl Machine {
    /// At the start of a text.
    pub fn new(source: SourceId, text: Text, options: &Options, state: &State) -> Self {
        let language = &options.language;
        let mut flow = Flow::new(source, text, options.style);
        flow.lenient = language.lenient;
        Machine {
            flow,
            vars: Vars::new(state),
            modes: Modes::new(language.dialect, language.fanuc.clone(), state),
            block: Block::default(),
            stack: Vec::new(),
            fresh: true,
            corner: None,
            recording: None,
            skipped: false,
            in_profile: false,
            nurbs: None,
            modal_macro: None,
            said_feed_mode: language.dialect != Dialect::FanucTurn,
            stray: None,
            said: String::new(),
        }
    }

    /// File of the row at hand, for diagnostics.
    pub fn source(&self) -> SourceId {
        self.flow.source()
    }

    /// Errors of rows that did not run.
    pub fn unread(&mut self) -> Vec<Diag> {
        self.flow.unread()
    }

    /// Goes to a line (from 1) of the main program. False if there are fewer.
    ///
    /// # Errors
    /// The file can't be read.
    pub fn seek(&mut self, line: u32) -> Result<bool, crate::ngc::fault::Fault> {
        self.fresh = false;
        (self.corner, self.recording, self.nurbs, self.modal_macro) = (None, None, None, None);
        self.in_profile = false;
        self.flow.seek(line)
    }

    /// Back to the start.
    pub fn restart(&mut self) {
        self.flow.restart();
        self.fresh = true;
    }

    /// Reads and executes one row.
    pub fn advance(&mut self, io: &mut Io) -> Went {
        let next = self.flow.next_row();
        io.out.diags.append(&mut self.flow.notes);
        let went = match next {
            Next::Row(row) => self.row(&row, io),
            Next::Percent(start, end) => self.percent(start, end, io),
            Next::Wrong(fault, line) => {
                io.at(self.flow.source(), (0, 0), line, None);
                io.wrong(fault.diag(self.flow.source()));
                self.fresh = false;
                Went::On
            }
            Next::End => self.end_of_text(io),
        };
        if self.flow.broken { Went::Ended } else { went }
    }

    /// A line with `%` opens a text, and ends the program later.
    fn percent(&mut self, start: usize, end: usize, io: &mut Io) -> Went {
        let span = Span::new(self.flow.source(), start, end);
        let lenient = io.state.options.language.lenient;
        if self.flow.here(start..end).trim_matches([' ', '\t']) != "%" && !lenient {
            io.wrong(Diag::new(Code::BadCharacter, span, "text beside `%`").help("put `%` on a line of its own"));
            return Went::On;
        }
        if self.fresh {
            return Went::On;
        }
        if lenient && self.flow.depth() == 0 {
            self.stray = Some(span);
            return Went::On;
        }
        self.end_of_text(io)
    }

    fn end_of_text(&mut self, io: &mut Io) -> Went {
        if self.flow.depth() > 0 {
            let at = self.flow.end_of_text();
            let span = Span::new(self.flow.source(), at.saturating_sub(1), at);
            let help = "write M99 in its last row";
            io.wrong(Diag::new(Code::BadMacro, span, "the program ends without M99").help(help));
            return Went::Ended;
        }
        self.close(io);
        Went::Out
    }

    /// Gives out what waits, before the program ends.
    fn close(&mut self, io: &mut Io) {
        self.end_corner(io);
        self.end_nurbs(io);
    }

    fn row(&mut self, row: &Row, io: &mut Io) -> Went {
        if std::mem::take(&mut self.skipped) {
            self.sync(io);
        }
        if let Some(span) = self.stray.take() {
            io.wrong(Diag::new(Code::LeftOut, span, "`%` inside of the program").help("the program goes on behind it"));
        }
        if row.skip && io.state.options.skip_deleted {
            return Went::On;
        }
        if let Some(program) = row.program {
            if !self.fresh {
                return self.end_of_text(io);
            }
            self.modes.program = program;
        }
        self.fresh &= row.is_empty();
        io.at(self.flow.source(), row.place, row.line, row.n);
        if let Some(n) = row.n {
            self.modes.n = n;
        }
        self.said.clear();
        self.comments(row, io);
        if !row.is_empty() || row.n.is_some() {
            io.out.block = io.out.block.saturating_add(1);
        }
        if row.is_empty() {
            return Went::On;
        }
        let wrong = io.out.diags.len();
        let went = self.statements(row, io);
        if went != Went::On || row.words.is_empty() || io.out.diags.len() > wrong && io.failed() {
            return went;
        }
        self.words(row, io)
    }

    fn comments(&mut self, row: &Row, io: &mut Io) {
        if row.comments.is_empty() || self.recording.is_some() {
            return;
        }
        for comment in &row.comments {
            let text = row.texts.get(comment.text.range()).unwrap_or("").to_owned();
            self.said.clone_from(&text);
            io.emit(if comment.kind == CommentKind::Message { Canon::Message(text) } else { Canon::Comment(text) });
        }
    }

    /// Settings and macro statements.
    fn statements(&mut self, row: &Row, io: &mut Io) -> Went {
        let source = self.flow.source();
        if let Control::Then(holds) = row.control {
            match self.truth(holds, row, io) {
                Ok(true) => {}
                Ok(false) => return Went::On,
                Err(fault) => {
                    io.wrong(fault.diag(source));
                    return Went::On;
                }
            }
        }
        let went = self.settings(row, io);
        if let Err(fault) = self.control(row, io) {
            io.wrong(fault.diag(source));
        }
        went
    }

    fn value(&mut self, value: expr::Value, row: &Row, io: &Io) -> Result<Option<f64>, super::fault::Fault> {
        let view = View { vars: &self.vars, modes: &self.modes, state: io.state };
        expr::eval(value, &row.ops, &view, &mut self.stack)
    }

    fn truth(&mut self, value: expr::Value, row: &Row, io: &Io) -> Result<bool, super::fault::Fault> {
        Ok(self.value(value, row, io)?.unwrap_or(0.0) != 0.0)
    }

    fn control(&mut self, row: &Row, io: &Io) -> Result<(), super::fault::Fault> {
        match row.control {
            Control::None | Control::Then(_) => Ok(()),
            Control::Goto(condition, target) => {
                let holds = match condition {
                    Some(value) => self.truth(value, row, io)?,
                    None => true,
                };
                if !holds {
                    return Ok(());
                }
                let n = self.value(target, row, io)?.and_then(super::word::whole);
                let missing = || {
                    let (start, end) = row.place;
                    super::fault::Fault::at(Code::MissingBlock, start, end, "no block number", "write the N number of a block")
                };
                self.flow.goto(n.ok_or_else(missing)?, row.place)
            }
            Control::Do(condition, number) => {
                let holds = match condition {
                    Some(value) => self.truth(value, row, io)?,
                    None => true,
                };
                self.flow.begin(holds, number, row.place)
            }
            Control::End(number) => self.flow.end(number, row.place),
        }
    }

    /// The words of a row as a block.
    fn words(&mut self, row: &Row, io: &mut Io) -> Went {
        let mut block = std::mem::take(&mut self.block);
        let view = View { vars: &self.vars, modes: &self.modes, state: io.state };
        block.fill(row, self.flow.source(), &view, &mut self.stack, io.out.diags);
        let went = if block.is_empty() || io.failed() { Went::On } else { self.block(&block, io) };
        self.block = block;
        went
    }

    /// The end of M2 and M30.
    fn finish(&mut self, end: ProgramEnd, io: &mut Io, at: Span) -> Went {
        self.close(io);
        if self.modes.turn() {
            // Turning goes back to its own plane, not to that of the kernel.
            io.state.modal.plane = Plane::Xy;
        }
        io.obey(&[super::word::Action::Stop(super::word::Stop::End(end))], &[], at);
        Went::Ended
    }
}
