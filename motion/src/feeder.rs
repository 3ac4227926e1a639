//! The background half of a channel: file -> interpreter -> run reader -> look-ahead -> ring.
//! Runs: background, in the caller of `tick` or in a thread of its own. What it releases depends on the program alone, so both give the
//! same set points. Commands and events go through rings.

use crate::canon::{Position, Step};
use crate::geometry::Point;
use crate::lookahead::{AxisLimits, Move, Planner};
use crate::ngc::{Interpreter, Language, Options};
use crate::pulse::pulse_move;
use crate::run::{Item, RunError, RunReader, Work};
use crate::segment::{Action, ErrorNote, Mark, Planned};
use std::sync::Arc;
use takt_base::ring::{Rx, Tx};
use takt_base::{Code, Diag, SourceId, Sources};

/// Canonical commands of a part program, or its first error.
pub type Steps = Box<dyn Iterator<Item = Result<Step, Box<Diag>>> + Send>;
/// Opens a part program.
pub type Reader = Box<dyn Fn(&PartProgram) -> Steps + Send>;
/// Reads a file by name.
pub type Files = Box<dyn Fn(&str) -> Result<String, String> + Send>;

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
}

/// Reads RS274/NGC text.
pub fn ngc_reader() -> Reader {
    Box::new(|program| {
        let options = Options { start: program.start, language: program.language.clone(), ..Options::default() };
        match options.with_modes(program.source, &program.modes) {
            Ok(options) => Box::new(Interpreter::new(program.source, program.text.clone(), options)),
            Err(diag) => Box::new(std::iter::once(Err(diag))),
        }
    })
}

/// Bytes of a file name in a command: STRING\[255\].
pub const NAME_BYTES: usize = 256;

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
    /// Feed the loaded program.
    Run {
        /// Number of the run.
        run: u32,
        /// Where the axes stand.
        start: Point,
    },
    /// Stop feeding.
    Abort,
}

/// To the channel.
#[derive(Clone, Copy, Debug)]
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
}

/// Steps read when a program is checked; a longer one is checked no further.
const CHECKED_STEPS: usize = 2_000_000;

struct Program {
    name: String,
    text: Arc<str>,
}

struct Running {
    sources: Sources,
    steps: Steps,
    reader: RunReader,
    planner: Planner,
    mark: Mark,
    ended: bool,
}

/// Feeds one channel.
pub struct Feeder {
    config: FeederConfig,
    commands: Rx<Command>,
    events: Tx<Event>,
    out: Tx<Planned>,
    program: Option<Program>,
    running: Option<Running>,
}

impl Feeder {
    /// A feeder with nothing loaded.
    pub fn new(config: FeederConfig, commands: Rx<Command>, events: Tx<Event>, out: Tx<Planned>) -> Self {
        Self { config, commands, events, out, program: None, running: None }
    }

    /// Does what can be done without waiting; false if there was nothing.
    pub fn pump(&mut self, files: &Files, reader: &Reader) -> bool {
        let mut busy = false;
        while self.may_obey()
            && let Some(command) = self.commands.pop()
        {
            busy = true;
            self.command(&command, files, reader);
        }
        self.feed() || busy
    }

    /// A command waits, and there is room for its event.
    fn may_obey(&self) -> bool {
        !self.commands.is_empty() && !self.events.is_full()
    }

    fn command(&mut self, command: &Command, files: &Files, reader: &Reader) {
        match command {
            Command::Load { request, name, start } => self.load(*request, name, start, files, reader),
            Command::Run { run, start } => self.run(*run, start, reader),
            Command::Abort => self.running = None,
        }
    }

    fn load(&mut self, request: u32, name: &[u8; NAME_BYTES], start: &Point, files: &Files, reader: &Reader) {
        let end = name.iter().position(|&b| b == 0).unwrap_or(NAME_BYTES);
        let name = String::from_utf8_lossy(&name[..end]).into_owned();
        let event = match self.read(name, start, files, reader) {
            Ok((program, lines)) => {
                self.program = Some(program);
                Event::Loaded { request, lines }
            }
            Err(note) => Event::LoadFailed { request, note: *note },
        };
        // There is room: see `may_obey`.
        let _ = self.events.push(event);
    }

    fn read(&self, name: String, start: &Point, files: &Files, reader: &Reader) -> Result<(Program, u32), Box<ErrorNote>> {
        let text = files(&name).map_err(|why| Box::new(ErrorNote::new(Code::ProgramFile, 0, 0, &format!("{name}: {why}"))))?;
        let program = Program { name, text: text.into() };
        let lines = program.text.lines().count() as u32;
        if self.config.check_on_load {
            self.check(&program, start, reader)?;
        }
        Ok((program, lines))
    }

    /// The first error of the program, whatever the position of the machine. Travel is checked when it runs.
    fn check(&self, program: &Program, start: &Point, reader: &Reader) -> Result<(), Box<ErrorNote>> {
        let (sources, steps) = open(program, start, reader, &self.config);
        let work = Work { exists: self.config.work.exists, ..Work::default() };
        let mut run = RunReader::new(work, *start);
        for step in steps.take(CHECKED_STEPS) {
            let step = step.map_err(|diag| Box::new(note_of_diag(&diag, &sources)))?;
            let mark = Mark::from(&step);
            run.read(&step, &mut |_, _| {}).map_err(|e| Box::new(note_of_error(&e, mark)))?;
        }
        Ok(())
    }

    fn run(&mut self, run: u32, start: &Point, reader: &Reader) {
        self.running = self.program.as_ref().map(|program| {
            let (sources, steps) = open(program, start, reader, &self.config);
            Running {
                sources,
                steps,
                reader: RunReader::new(self.config.work, *start),
                planner: Planner::new(self.config.axes, self.config.period_s, run),
                mark: Mark::default(),
                ended: false,
            }
        });
    }

    /// Feeds until the ring is full, the program has ended, or there is a new command.
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
                self.running = None;
                return busy;
            }
            running.advance(&self.config);
            if self.may_obey() {
                return true;
            }
        }
    }
}

impl Running {
    /// Reads one command.
    fn advance(&mut self, config: &FeederConfig) {
        match self.steps.next() {
            Some(Ok(step)) => {
                self.mark = Mark::from(&step);
                if let Err(error) = self.read(&step, config) {
                    self.fail(note_of_error(&error, self.mark));
                }
            }
            Some(Err(diag)) => self.fail(note_of_diag(&diag, &self.sources)),
            None => self.end(config),
        }
    }

    fn read(&mut self, step: &Step, config: &FeederConfig) -> Result<(), RunError> {
        let (planner, mut failed) = (&mut self.planner, None);
        let mut emit = |mark, item| match put(planner, config, mark, item) {
            Ok(end) => self.ended |= end,
            Err(error) => failed = failed.take().or(Some(error)),
        };
        self.reader.read(step, &mut emit)?;
        failed.map_or(Ok(()), Err)
    }

    /// Everything before the wrong block is executed, then the channel stops.
    fn fail(&mut self, note: ErrorNote) {
        self.planner.push(Mark { line: note.line, ..self.mark }, Action::Fault(note));
        self.ended = true;
    }

    fn end(&mut self, config: &FeederConfig) {
        let planner = &mut self.planner;
        self.reader.finish(&mut |mark, item| {
            let _ = put(planner, config, mark, item);
        });
        self.planner.push(self.mark, Action::End { m: 0 });
        self.ended = true;
    }
}

/// Hands an item on; true for the end of the program.
fn put(planner: &mut Planner, config: &FeederConfig, mark: Mark, item: Item) -> Result<bool, RunError> {
    match (item, config.pulse) {
        (Item::Move(m), Some((blu_mm, batch_max))) => {
            let pulses = pulses(&m, config, blu_mm, batch_max)?;
            planner.push(mark, Action::Pulse(pulses));
        }
        (Item::Move(m), None) => planner.push_move(mark, m),
        (Item::Action(action), _) => {
            planner.push(mark, action);
            return Ok(matches!(action, Action::End { .. }));
        }
    }
    Ok(false)
}

/// PC-13: what does not fit the tick is refused, never slowed down.
fn pulses(m: &Move, config: &FeederConfig, blu_mm: f64, batch_max: u32) -> Result<crate::pulse::PulseMove, RunError> {
    let slowest = (0..6).filter(|&i| m.path.end[i] != m.path.start[i]).map(|i| config.axes.v[i]).fold(f64::INFINITY, f64::min);
    // Positioning has no feed of its own: it is as fast as axes and tick allow.
    let fastest = slowest.min(f64::from(batch_max) * blu_mm / config.period_s);
    let speed = if m.rapid { m.feed.min(fastest) } else { m.feed };
    let pulses = pulse_move(&m.path, m.rapid, speed, blu_mm).map_err(|code| RunError {
        code,
        text: match code {
            Code::UnknownCode => "a helix can't be made of reference pulses".to_owned(),
            _ => code.title().to_owned(),
        },
    })?;
    if pulses.frequency * config.period_s > f64::from(batch_max) * (1.0 + 1e-9) {
        let text = format!("{} pulses a second are more than {batch_max} a tick", pulses.frequency.round());
        return Err(RunError { code: Code::ParameterOutOfRange, text });
    }
    Ok(pulses)
}

fn open(program: &Program, start: &Point, reader: &Reader, config: &FeederConfig) -> (Sources, Steps) {
    let mut sources = Sources::new();
    let source = sources.add(program.name.clone(), &*program.text);
    let start = (*start).into();
    let FeederConfig { modes, language, .. } = config;
    let program = PartProgram { source, text: program.text.clone(), start, modes: modes.clone(), language: language.clone() };
    let steps = reader(&program);
    (sources, steps)
}

fn note_of_error(error: &RunError, mark: Mark) -> ErrorNote {
    ErrorNote::new(error.code, mark.line, 1, &error.text)
}

fn note_of_diag(diag: &Diag, sources: &Sources) -> ErrorNote {
    let at = sources.line_col(diag.span.source, diag.span.start);
    ErrorNote::new(diag.code, at.line, at.column, &diag.message)
}
