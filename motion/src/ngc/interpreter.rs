//! The interpreter: an iterator of canonical commands that reads one block when it has none left.
//!
//! First come the modes that the options set, as block 0: `USE_LENGTH_UNITS`, `SET_ORIGIN_OFFSETS`, `SET_FEED_REFERENCE`, `SELECT_PLANE`,
//! `SET_MOTION_CONTROL_MODE`; so the commands can be run or drawn without the options. `INIT_CANON` and `END_CANON` belong to whoever opens
//! and closes the machine. The last command is always `PROGRAM_END`: from M2 or M30, or from the end of the text or a closing `%`.
//! A comment does not count as a block; its commands carry the number of the block before.

mod check;
mod commands;
mod inside;

pub use check::{check, check_each};

use super::code::Row;
use super::execute::{self, Out, Then};
use super::expr::run::Stack;
use super::fanuc::{self, Went};
use super::fault::Fault;
use super::flow::files::Files;
use super::flow::owords::After;
use super::flow::{Flow, Next};
use super::lines::{Style, trimmed};
use super::modal::Modal;
use super::options::Options;
use super::request::Request;
use super::state::{SavedModes, State};
use super::text::Text;
use crate::canon::{Canon, FeedReference, ProgramEnd, Step};
use std::collections::VecDeque;
use std::sync::Arc;
use takt_base::{Code, Diag, Severity, SourceId, Span};

/// Reads a part program. Owns its text, so it can be sent to a background thread.
#[derive(Clone, Debug)]
pub struct Interpreter {
    pub(super) flow: Flow,
    pub(super) state: State,
    pub(super) request: Request,
    stack: Stack,
    pub(super) queue: VecDeque<Step>,
    /// The first command of the queue has been looked at.
    seen: bool,
    pub(super) diags: Vec<Diag>,
    /// A row that waits for PLC variables.
    pub(super) held: Option<Row>,
    failed: Option<Box<Diag>>,
    pub(super) block: u32,
    /// Rows since the last command.
    silent: u32,
    pub(super) opened: bool,
    percent: bool,
    ended: bool,
    /// M99 in the main program ends it: errors are looked for, or one run is asked for.
    once: bool,
    /// A `%` of a lenient program that ends it, or stands inside of it if a row follows.
    stray: Option<Span>,
    /// Reads a Fanuc-style dialect in place of `flow`.
    fanuc: Option<Box<fanuc::Machine>>,
}

impl Interpreter {
    /// At the start of `text`, which is file `source` of the diagnostics.
    pub fn new(source: SourceId, text: impl Into<Text>, options: Options) -> Self {
        let options = Arc::new(options);
        let text = text.into();
        let mut state = State::new(options.clone());
        let dialect = options.language.dialect;
        let fanuc = dialect.is_fanuc().then(|| {
            fanuc::prepare(&mut state, dialect);
            Box::new(fanuc::Machine::new(source, text.clone(), &options, &state))
        });
        // A Fanuc-style program is read by its own flow.
        let style = if fanuc.is_some() { Style::Ngc } else { options.style };
        let mut flow = Flow::new(Files::new(source, text, style));
        flow.lenient = options.language.lenient;
        let queue = prologue(&state, &options).into_iter().map(|command| Step { block: 0, line: 0, n: None, command }).collect();
        Interpreter {
            flow,
            state,
            request: Request::default(),
            stack: Stack::new(),
            queue,
            seen: false,
            ended: false,
            diags: Vec::new(),
            held: None,
            failed: None,
            block: 0,
            silent: 0,
            opened: false,
            percent: false,
            once: options.drop_in,
            stray: None,
            fanuc,
        }
    }

    /// Gives out the modes in force, before the first row.
    pub(super) fn reopen(&mut self) {
        let options = self.state.options.clone();
        let modal = self.state.modal;
        let mut all = prologue(&self.state, &options);
        all.extend(modal.feed.map(Canon::SetFeedRate));
        all.push(Canon::UseToolLengthOffsets(super::modal::scaled(modal.offsets.tool, 1.0 / self.state.unit())));
        if modal.feed_mode == super::modal::FeedMode::PerRevolution {
            all.push(Canon::SetFeedMode(true));
        }
        if modal.surface_speed.is_some() {
            all.push(Canon::SetSpindleMode(modal.surface_speed));
        }
        self.queue = all.into_iter().map(|command| Step { block: 0, line: 0, n: None, command }).collect();
    }

    /// The modal state behind the last block that was read.
    pub fn modal(&self) -> &Modal {
        &self.state.modal
    }

    /// Everything that the program can read or change.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Goes on behind an error with the next row of the main program (`rs274 -n 0`).
    pub fn go_on(&mut self) {
        self.flow.unwind(&mut self.state);
        self.ended = self.flow.files.broken;
    }

    /// Goes to line `line`, from 1: nothing before it is executed (block search). The index of lines makes it quick.
    ///
    /// # Errors
    /// The program has fewer lines, or can't be read.
    pub fn seek(&mut self, line: u32) -> Result<(), Box<Diag>> {
        self.flow.leave_all(&mut self.state);
        (self.opened, self.percent, self.seen) = (true, true, false);
        self.queue.clear();
        self.state.comp.reset();
        let source = self.flow.files.source();
        let found = match &mut self.fanuc {
            Some(machine) => machine.seek(line.max(1)),
            None => self.flow.files.seek(line.max(1)),
        };
        if found.map_err(|fault| Box::new(fault.diag(source)))? {
            return Ok(());
        }
        self.ended = true;
        let at = self.flow.files.end();
        let span = Span::new(source, at.saturating_sub(1), at);
        let diag = Diag::new(Code::NoSuchLine, span, "the last line").message(format!("the part program has no line {line}"));
        Err(Box::new(diag.help("choose a line of the program")))
    }

    /// Reads one row: its commands go to the queue, what is wrong to `diags`.
    fn advance(&mut self) {
        if let Some(row) = self.held.take() {
            self.obey(&row);
            if self.held.is_none() {
                self.state.outside.values.clear();
            }
            return;
        }
        if let Some(machine) = self.fanuc.take() {
            self.fanuc = Some(self.advance_fanuc(machine));
            return;
        }
        let next = self.flow.next_row();
        self.diags.append(&mut self.flow.notes);
        match next {
            Next::Row(row) => self.row(&row),
            Next::Percent(start, end) => self.percent(start, end),
            Next::Wrong(fault, line) => {
                self.opened = true;
                self.state.line = line;
                self.block = self.block.saturating_add(1);
                self.fail(fault);
            }
            Next::End => self.end_of_text(),
        }
        self.ended |= self.flow.files.broken;
    }

    /// The same in a Fanuc-style dialect.
    fn advance_fanuc(&mut self, mut machine: Box<fanuc::Machine>) -> Box<fanuc::Machine> {
        let (mark, before) = (self.queue.len(), self.diags.len());
        let out = Out { queue: &mut self.queue, diags: &mut self.diags, block: self.block, line: self.state.line, n: None };
        let span = Span::new(machine.source(), 0, 0);
        let mut io = fanuc::kernel::Io { state: &mut self.state, out, request: &mut self.request, span };
        let went = machine.advance(&mut io);
        self.block = io.out.block;
        let line = io.out.line;
        if self.failed_now(before) {
            self.queue.truncate(mark);
            self.state.comp.reset();
        }
        match went {
            Went::On => {}
            Went::Ended => self.ended = true,
            Went::Again if !self.once => machine.restart(),
            Went::Again | Went::Out => self.finish(),
        }
        let place = (self.request.span.start, self.request.span.end);
        self.count_silence(&Row { place, line, ..Row::bare() }, mark);
        machine
    }

    pub(super) fn fail(&mut self, fault: Fault) {
        self.diags.push(fault.diag(self.flow.files.source()));
    }

    fn row(&mut self, row: &Row) {
        self.opened = true;
        if let Some(span) = self.stray.take() {
            let diag = Diag::new(Code::LeftOut, span, "`%` inside of the program").help("the program goes on behind it");
            self.diags.push(diag);
        }
        if row.deleted && self.state.options.skip_deleted {
            return;
        }
        self.state.line = row.line;
        if !self.asks_first(row) {
            self.obey(row);
        }
    }

    fn obey(&mut self, row: &Row) {
        let before = self.queue.len();
        if let Some(word) = &row.oword {
            self.comments(row);
            let back = (self.flow.files.spot(), self.flow.here());
            match self.flow.obey(word, &mut self.state, &mut self.stack) {
                Ok(After::Returned(saved)) => self.returned(saved, row),
                Ok(After::Next) => {}
                Err(_) if self.asks_again(row, back) => {}
                Err(fault) => self.fail(fault),
            }
        } else {
            self.block(row);
        }
        // Rows that run once end with the text, however many do nothing.
        if self.flow.may_repeat() {
            self.count_silence(row, before);
        }
    }

    /// An endless loop that does nothing must not hang whoever waits for a command.
    fn count_silence(&mut self, row: &Row, before: usize) {
        if self.queue.len() != before {
            self.silent = 0;
            return;
        }
        self.silent += 1;
        if self.silent > self.state.options.silent_rows_max {
            let help = "check the condition that ends the loop";
            self.fail(Fault::at(Code::EndlessProgram, row.place.0, row.place.1, "no command for a very long time", help));
            self.ended = true;
        }
    }

    fn comments(&mut self, row: &Row) {
        if row.comments.is_empty() {
            return;
        }
        let quiet = Row { words: Default::default(), settings: Default::default(), ..*row };
        self.block(&quiet);
    }

    fn block(&mut self, row: &Row) {
        if row.n.is_some() || !row.words.is_empty() || !row.settings.is_empty() {
            self.block = self.block.saturating_add(1);
        }
        let (source, mark) = (self.flow.files.source(), self.queue.len());
        let diags_before = self.diags.len();
        self.request.fill(row, source, &self.flow.code, &mut self.state, &mut self.stack, &mut self.diags);
        if self.state.options.drop_in && self.failed_now(diags_before) {
            return;
        }
        if self.failed_now(diags_before) {
            self.state.outside.sets.clear();
        }
        let mut out = Out { queue: &mut self.queue, diags: &mut self.diags, block: self.block, line: row.line, n: row.n };
        let then = execute::execute(&self.request, row, &self.flow.code, &mut self.state, &mut out);
        if self.failed_now(diags_before) {
            if !self.state.options.drop_in {
                self.queue.truncate(mark);
            }
            self.state.comp.reset();
            self.ended |= then == Then::End && !self.state.options.drop_in;
            return;
        }
        self.then(then, row);
        if self.failed_now(diags_before) && !self.state.options.drop_in {
            self.queue.truncate(mark);
        }
    }

    fn failed_now(&self, before: usize) -> bool {
        self.diags[before..].iter().any(|d| d.severity == Severity::Error)
    }

    fn then(&mut self, then: Then, row: &Row) {
        match then {
            Then::Next => {}
            Then::End => {
                self.ended = true;
                self.state.params.leave_all();
            }
            Then::Call(number, times) => {
                if let Err(fault) = self.flow.call_program(number, times, row.place, &mut self.state) {
                    self.fail(fault);
                }
            }
            Then::Contour(tenths) => self.contour_cycle(tenths, row),
            Then::Return => match self.flow.leave(&mut self.state) {
                None => self.again(),
                Some(After::Returned(saved)) => self.returned(saved, row),
                Some(After::Next) => {}
            },
        }
    }

    /// M99 in the main program starts it anew.
    fn again(&mut self) {
        if self.state.options.drop_in {
            self.ended = true;
            let line = self.state.line;
            let mut out = Out { queue: &mut self.queue, diags: &mut self.diags, block: self.block, line, n: None };
            execute::epilogue(&mut self.state, &mut out, ProgramEnd::M2);
        } else if self.once {
            self.finish();
        } else {
            self.flow.restart();
        }
    }

    /// A subroutine has ended: modes that it saved for that come back.
    fn returned(&mut self, saved: Option<Box<SavedModes>>, row: &Row) {
        if let Some(saved) = saved
            && saved.automatic
        {
            let mut out = Out { queue: &mut self.queue, diags: &mut self.diags, block: self.block, line: row.line, n: row.n };
            execute::restore(&mut self.state, &self.request, &mut out, &saved.modal);
        }
    }

    /// A line with `%`: before the first block it opens the program, later it ends it.
    fn percent(&mut self, start: usize, end: usize) {
        if trimmed(self.flow.files.bytes(start..end)) != b"%" {
            let span = Span::new(self.flow.files.source(), start, end);
            let diag = Diag::new(Code::BadCharacter, span, "text beside `%`").help("put `%` on a line of its own");
            self.diags.push(diag);
            return;
        }
        if self.opened && self.state.options.drop_in && !self.percent {
            let span = Span::new(self.flow.files.source(), start, end);
            let help = "`%` ends a program only if one stands before it";
            self.diags.push(Diag::new(Code::BadCharacter, span, "`%` inside of the program").help(help));
            return;
        }
        if self.opened && self.state.options.language.lenient {
            self.stray = Some(Span::new(self.flow.files.source(), start, end));
            return;
        }
        if self.opened {
            self.finish();
        }
        self.percent = true;
        self.opened = true;
    }

    fn end_of_text(&mut self) {
        if self.flow.depth() > 0 || self.flow.block_is_open() {
            self.ended = true;
            let at = self.flow.files.end();
            let span = Span::new(self.flow.files.source(), at.saturating_sub(1), at);
            let help = "end it with endsub, endif, endwhile, endrepeat or M99";
            self.diags.push(Diag::new(Code::BadFlow, span, "the file ends inside of a subroutine or block").help(help));
            return;
        }
        if self.state.options.drop_in {
            self.ended = true;
            let at = self.flow.files.end();
            let span = Span::new(self.flow.files.source(), at.saturating_sub(1), at);
            let diag = Diag::new(Code::MissingWord, span, "the file ends without M2, M30 or `%`");
            self.diags.push(diag.help("write M2 in the last row"));
            return;
        }
        self.finish();
    }

    fn finish(&mut self) {
        self.ended = true;
        let line = self.flow.files.lines().line();
        let mut out = Out { queue: &mut self.queue, diags: &mut self.diags, block: self.block, line, n: None };
        execute::release(&mut self.state, &mut out);
        self.queue.push_back(Step { block: self.block, line, n: None, command: Canon::ProgramEnd(ProgramEnd::EndOfFile) });
    }

    /// Errors of rows that are not executed.
    fn take_found(&mut self) {
        let source = self.flow.files.source();
        let found = std::mem::take(&mut self.flow.found);
        self.diags.extend(found.into_iter().map(|fault| fault.diag(source)));
    }
}

fn prologue(state: &State, options: &Options) -> Vec<Canon> {
    let modal = &state.modal;
    if options.drop_in {
        return vec![
            Canon::UseLengthUnits(modal.units),
            Canon::SetG5xOffset(modal.work_offset as u32 + 1, super::modal::scaled(modal.offsets.work, 1.0 / state.unit())),
            Canon::SetG92Offset(super::modal::scaled(modal.offsets.local, 1.0 / state.unit())),
            Canon::SetXyRotation(modal.offsets.rotation),
            Canon::SetFeedReference(FeedReference::Xyz),
        ];
    }
    let mut all = vec![
        Canon::UseLengthUnits(modal.units),
        execute::origin(modal),
        Canon::SetFeedReference(FeedReference::Xyz),
        Canon::SelectPlane(modal.plane),
        Canon::SetMotionControlMode(modal.control),
    ];
    if modal.offsets.rotation != 0.0 {
        all.push(Canon::SetXyRotation(modal.offsets.rotation));
    }
    all
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
