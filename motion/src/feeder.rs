//! The background half of a channel: file -> interpreter -> run reader -> look-ahead -> ring.
//! Runs: background, in the caller of `tick` or in a thread of its own. What it releases depends on the program and on the answers of the
//! machine alone, so both give the same set points. Commands and events go through rings.

pub mod check;
pub mod environment;
pub mod running;
pub mod tables;

pub use environment::{ChannelHost, Environment};

use crate::canon::{Position, Step};
use crate::geometry::Point;
use crate::lookahead::AxisLimits;
use crate::ngc::modal::Modal;
use crate::ngc::{HostRef, Interpreter, Language, Options};
use crate::run::Work;
use crate::segment::{ErrorNote, Planned};
use crate::sync::Answer;
use running::{Program, Running};
use std::sync::Arc;
use tables::{Kept, Tables};
use takt_base::ring::{Rx, Tx};
use takt_base::{Code, Diag, SourceId};

/// Canonical commands of a part program, or its first error. Behind a command for which [`crate::sync::waits_for_answer`] holds, the
/// next one is asked for when the answer has been given.
pub trait Commands: Iterator<Item = Result<Step, Box<Diag>>> + Send {
    /// What the machine says to the command that was given out last.
    fn answer(&mut self, _: &Answer) {}
    /// What outlives the program, as it is behind the last command.
    fn kept(&self) -> Option<Kept> {
        None
    }
    /// Modes behind the last command.
    fn modal(&self) -> Option<Modal> {
        None
    }
    /// Value of the subroutine that returned last.
    fn result(&self) -> f64 {
        0.0
    }
    /// True if the last command came from a row of the main program.
    fn in_main(&self) -> bool {
        true
    }
}

/// Commands that need no answers.
pub struct Plain<I>(pub I);

impl<I: Iterator> Iterator for Plain<I> {
    type Item = I::Item;
    fn next(&mut self) -> Option<I::Item> {
        self.0.next()
    }
}

impl<I: Iterator<Item = Result<Step, Box<Diag>>> + Send> Commands for Plain<I> {}

/// See [`Commands`].
pub type Steps = Box<dyn Commands>;
/// Opens a part program.
pub type Reader = Box<dyn Fn(&PartProgram) -> Steps + Send>;
/// Reads a file by name.
pub type Files = Box<dyn Fn(&str) -> Result<String, String> + Send + Sync>;

/// A part program that is to be read.
#[derive(Clone, Debug)]
pub struct PartProgram {
    /// Its file in the spans of diagnostics.
    pub source: SourceId,
    /// Its text.
    pub text: Arc<str>,
    /// Machine position at its start: mm, degrees.
    pub start: Position,
    /// Codes that stand before every program of this channel.
    pub modes: String,
    /// Dialect, strictness and settings.
    pub language: Language,
    /// Subroutines in files, PLC variables.
    pub host: HostRef,
    /// Parameters and tools.
    pub kept: Kept,
    /// Rows with `/` are left out.
    pub skip_deleted: bool,
    /// Modes to go on with, of a block that was typed in before.
    pub modal: Option<Modal>,
}

/// Parameter with the work offset system in force.
const WORK_SYSTEM: u16 = 5220;

/// Reads RS274/NGC text.
pub fn ngc_reader() -> Reader {
    Box::new(|program| {
        let options = Options {
            start: program.start,
            language: program.language.clone(),
            host: program.host.clone(),
            // The system that the configuration names is in force at the start, not the one that the last program left.
            parameters: program.kept.parameters.iter().copied().filter(|p| p.0 != WORK_SYSTEM).collect(),
            tools: program.kept.tools.clone(),
            tool: program.kept.tool,
            skip_deleted: program.skip_deleted,
            ..Options::default()
        };
        match options.with_modes(program.source, &program.modes) {
            Ok(options) => {
                let interpreter = Interpreter::new(program.source, program.text.clone(), options);
                Box::new(match &program.modal {
                    Some(modal) => interpreter.going_on(modal),
                    None => interpreter,
                })
            }
            Err(diag) => Box::new(Plain(std::iter::once(Err(diag)))),
        }
    })
}

/// Bytes of a file name in a command: STRING\[255\].
pub const NAME_BYTES: usize = 256;
/// Arguments of a subroutine.
pub const ARGS: usize = 30;

/// How a program is run.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct How {
    /// Line of the main program where motion starts; 0 and 1: at the top.
    pub start_line: u32,
    /// Rows before that line are not even read.
    pub raw: bool,
    /// Rows with `/` are left out.
    pub block_skip: bool,
    /// Feed moves take the feed of the dry run.
    pub dry_run: bool,
}

/// From the channel.
#[derive(Clone, Copy, Debug)]
#[allow(clippy::large_enum_variant)] // it passes a ring: no heap
pub enum Command {
    /// Read a file.
    Load {
        /// Number of the request.
        request: u32,
        /// Name, ended by a zero byte.
        name: [u8; NAME_BYTES],
        /// Where the axes stand.
        start: Point,
    },
    /// Look through the loaded program without moving.
    Check {
        /// Number of the request.
        request: u32,
        /// Where the axes stand.
        start: Point,
        /// Moves out of the travel are errors.
        limits: bool,
    },
    /// Feed the loaded program.
    Run {
        /// Number of the run.
        run: u32,
        /// Where the axes stand.
        start: Point,
        /// Start line and modes.
        how: How,
    },
    /// Feed one block.
    Block {
        /// Number of the run.
        run: u32,
        /// Where the axes stand.
        start: Point,
        /// Text, ended by a zero byte.
        text: [u8; NAME_BYTES],
        /// Modes.
        how: How,
    },
    /// Feed a subroutine.
    Call {
        /// Number of the run.
        run: u32,
        /// Where the axes stand.
        start: Point,
        /// Its name, ended by a zero byte.
        name: [u8; NAME_BYTES],
        /// `#1`, `#2`, ...
        args: [f64; ARGS],
        /// How many of them.
        count: u8,
        /// Modes.
        how: How,
    },
    /// What the machine says to a command that waits.
    Answer {
        /// Number of the run.
        run: u32,
        /// The answer.
        answer: Answer,
    },
    /// The run has come to its end.
    Ended {
        /// Number of the run.
        run: u32,
    },
    /// Stop feeding.
    Abort,
}

/// To the channel.
#[derive(Clone, Copy, Debug)]
#[allow(clippy::large_enum_variant)] // as above
pub enum Event {
    /// The file is loaded.
    Loaded {
        /// Number of the request.
        request: u32,
        /// Lines of the file.
        lines: u32,
    },
    /// The file is not loaded; the program before it still is.
    LoadFailed {
        /// Number of the request.
        request: u32,
        /// Why.
        note: ErrorNote,
    },
    /// The loaded program has been looked through.
    Checked {
        /// Number of the request.
        request: u32,
        /// The first error.
        note: Option<ErrorNote>,
        /// Time in seconds, extent in machine coordinates.
        found: check::Found,
    },
    /// Value that the subroutine of [`Command::Call`] has returned.
    Returned {
        /// Number of the run.
        run: u32,
        /// Its value.
        value: f64,
    },
    /// Parameters or tools could not be stored.
    NotStored(ErrorNote),
}

/// What the feeder knows of its channel.
#[derive(Clone, Debug)]
pub struct FeederConfig {
    /// Limits of the axes.
    pub axes: AxisLimits,
    /// Axes and travel.
    pub work: Work,
    /// Servo period in seconds.
    pub period_s: f64,
    /// Reference pulses: basic length unit in mm and largest batch.
    pub pulse: Option<(f64, u32)>,
    /// Read the whole program before it counts as loaded.
    pub check_on_load: bool,
    /// Codes before every program.
    pub modes: String,
    /// Dialect, strictness and settings.
    pub language: Language,
    /// Folders of subroutines.
    pub subs: Vec<String>,
    /// File of the parameters.
    pub parameter_file: Option<String>,
    /// File of the tools.
    pub tool_table: Option<String>,
    /// Feed of the dry run in mm/s.
    pub dry_run_mm_s: f64,
}

impl Default for FeederConfig {
    fn default() -> Self {
        Self {
            axes: AxisLimits::uniform(f64::INFINITY, f64::INFINITY),
            work: Work::default(),
            period_s: 0.001,
            pulse: None,
            check_on_load: true,
            modes: String::new(),
            language: Language::default(),
            subs: Vec::new(),
            parameter_file: None,
            tool_table: None,
            dry_run_mm_s: 50.0,
        }
    }
}

/// Feeds one channel.
pub struct Feeder {
    config: FeederConfig,
    commands: Rx<Command>,
    events: Tx<Event>,
    out: Tx<Planned>,
    program: Option<Program>,
    running: Option<Running>,
    tables: Tables,
    /// Modes behind the last block that was typed in.
    modal: Option<Modal>,
    /// What a program that is fed to its end has left, until the channel has executed it.
    fed: Option<(u32, Option<Kept>)>,
}

impl Feeder {
    /// A feeder with nothing loaded.
    pub fn new(config: FeederConfig, commands: Rx<Command>, events: Tx<Event>, out: Tx<Planned>) -> Self {
        let tables = Tables::new(config.parameter_file.clone(), config.tool_table.clone());
        Self { config, commands, events, out, program: None, running: None, tables, modal: None, fed: None }
    }

    /// Does what can be done without waiting; false if there was nothing.
    pub fn pump(&mut self, environment: &Environment, reader: &Reader) -> bool {
        let mut busy = false;
        while self.may_obey()
            && let Some(command) = self.commands.pop()
        {
            busy = true;
            self.command(&command, environment, reader);
        }
        self.feed() || busy
    }

    /// Stores what is not stored yet, at the end of the machine.
    pub fn close(&mut self, environment: &Environment) {
        let _ = self.tables.store(environment);
    }

    /// A command waits, and there is room for its events: each has two at most.
    fn may_obey(&self) -> bool {
        !self.commands.is_empty() && self.events.len() + 2 <= self.events.capacity()
    }

    fn command(&mut self, command: &Command, environment: &Environment, reader: &Reader) {
        match command {
            Command::Load { request, name, start } => self.load(*request, name, start, environment, reader),
            Command::Check { request, start, limits } => self.check(*request, start, *limits, environment, reader),
            Command::Run { run, start, how } => {
                self.modal = None;
                let program = self.program.clone();
                self.start(*run, start, program, how, environment, reader);
            }
            Command::Block { run, start, text, how } => {
                let program = Program::of_text("block", &text_of(text));
                self.start(*run, start, Some(program), how, environment, reader);
            }
            Command::Call { run, start, name, args, count, how } => {
                let args = args.iter().take(usize::from(*count)).map(|a| format!(" [{a}]")).collect::<String>();
                let program = Program::of_text("call", &format!("o<{}> call{args}", text_of(name)));
                self.start(*run, start, Some(program), how, environment, reader);
            }
            Command::Answer { run, answer } => self.answer(*run, answer),
            Command::Ended { run } => self.ended(*run, environment),
            Command::Abort => {
                (self.running, self.fed) = (None, None);
                self.store(environment);
            }
        }
    }

    fn load(&mut self, request: u32, name: &[u8; NAME_BYTES], start: &Point, environment: &Environment, reader: &Reader) {
        let event = match self.read(text_of(name), start, environment, reader) {
            Ok((program, lines)) => {
                self.program = Some(program);
                Event::Loaded { request, lines }
            }
            Err(note) => Event::LoadFailed { request, note: *note },
        };
        // There is room: see `may_obey`.
        let _ = self.events.push(event);
    }

    fn read(
        &mut self,
        name: String,
        start: &Point,
        environment: &Environment,
        reader: &Reader,
    ) -> Result<(Program, u32), Box<ErrorNote>> {
        let text = (environment.files)(&name)
            .map_err(|why| Box::new(ErrorNote::new(Code::ProgramFile, 0, 0, &format!("{name}: {why}"))))?;
        self.tables.refresh(environment)?;
        let program = Program { name, text: text.into() };
        let lines = program.text.lines().count() as u32;
        if self.config.check_on_load {
            let opened = program.open(&self.config, start, &How::default(), environment, reader, &self.tables.kept, None);
            check::first_error(opened, &self.config, start, false)?;
        }
        Ok((program, lines))
    }

    fn check(&mut self, request: u32, start: &Point, limits: bool, environment: &Environment, reader: &Reader) {
        let (note, found) = match &self.program {
            None => (Some(ErrorNote::new(Code::ProgramNotLoaded, 0, 0, Code::ProgramNotLoaded.title())), check::Found::default()),
            Some(program) => {
                let how = How::default();
                let open = || program.open(&self.config, start, &how, environment, reader, &self.tables.kept, None);
                match check::first_error(open(), &self.config, start, limits) {
                    Err(note) => (Some(*note), check::Found::default()),
                    Ok(()) => (None, check::measure(open(), &self.config, start)),
                }
            }
        };
        let _ = self.events.push(Event::Checked { request, note, found });
    }

    fn start(
        &mut self,
        run: u32,
        start: &Point,
        program: Option<Program>,
        how: &How,
        environment: &Environment,
        reader: &Reader,
    ) {
        self.fed = None;
        let config = &self.config;
        let modal = self.modal.as_ref();
        self.running = program.map(|program| {
            let opened = program.open(config, start, how, environment, reader, &self.tables.kept, modal);
            Running::new(run, opened, config, start, how)
        });
    }

    fn answer(&mut self, run: u32, answer: &Answer) {
        if let Some(running) = &mut self.running
            && running.run == run
            && let Some(kept) = running.answer(answer)
        {
            self.tables.kept = kept;
        }
    }

    /// The channel has executed everything: what the program has left counts from now on.
    fn ended(&mut self, run: u32, environment: &Environment) {
        if let Some((_, Some(kept))) = self.fed.take().filter(|(fed, _)| *fed == run) {
            self.tables.kept = kept;
        }
        self.store(environment);
    }

    fn store(&mut self, environment: &Environment) {
        if let Err(note) = self.tables.store(environment) {
            let _ = self.events.push(Event::NotStored(*note));
        }
    }

    /// Feeds until the ring is full, the program waits or has ended, or there is a new command.
    fn feed(&mut self) -> bool {
        let mut busy = false;
        loop {
            let Some(running) = &mut self.running else { return busy };
            while let Some(step) = running.planner.pop() {
                busy = true;
                if let Err(back) = self.out.push(step) {
                    running.planner.unpop(back);
                    return false;
                }
            }
            if running.ended {
                self.fed_all();
                return busy;
            }
            if running.waits {
                return busy;
            }
            running.advance(&self.config);
            if self.may_obey() {
                return true;
            }
        }
    }

    fn fed_all(&mut self) {
        let Some(running) = self.running.take() else { return };
        if running.failed {
            return;
        }
        self.fed = Some((running.run, running.steps.kept()));
        if running.typed {
            self.modal = running.steps.modal();
            // An event can always be had: the channel empties its ring in every tick.
            let _ = self.events.push(Event::Returned { run: running.run, value: running.steps.result() });
        }
    }
}

fn text_of(bytes: &[u8; NAME_BYTES]) -> String {
    let end = bytes.iter().position(|&b| b == 0).unwrap_or(NAME_BYTES);
    String::from_utf8_lossy(&bytes[..end]).into_owned()
}
