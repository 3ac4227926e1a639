//! A part program on its way to the ring.
//! Runs: background.

use super::{ChannelHost, Environment, FeederConfig, How, Kept, PartProgram, Reader, Steps};
use crate::canon::{Canon, Step};
use crate::geometry::Point;
use crate::lookahead::{Move, Planner, path_limits};
use crate::ngc::HostRef;
use crate::ngc::modal::Modal;
use crate::pulse::{PulseMove, pulse_move};
use crate::run::{Item, RunError, RunReader};
use crate::segment::{Action, ErrorNote, Mark};
use crate::sync::{Answer, Special, waits_for_answer};
use std::sync::Arc;
use takt_base::{Code, Diag, Sources};

/// A file that is loaded, or a block that was typed in.
#[derive(Clone, Debug)]
pub struct Program {
    /// Name of the file.
    pub name: String,
    /// Its text.
    pub text: Arc<str>,
}

/// A program that is being read.
pub struct Opened {
    /// Its commands.
    pub steps: Steps,
    /// Files that its diagnostics may name.
    pub host: Arc<ChannelHost>,
    /// Variables of the PLC program.
    pub environment: Environment,
    /// It was typed in.
    typed: bool,
}

impl Program {
    /// A text without a file.
    pub fn of_text(name: &str, text: &str) -> Self {
        Self { name: format!("<{name}>"), text: text.into() }
    }

    /// Opens it for a run from `start`.
    #[allow(clippy::too_many_arguments)] // what a run depends on
    pub fn open(
        &self,
        config: &FeederConfig,
        start: &Point,
        how: &How,
        environment: &Environment,
        reader: &Reader,
        kept: &Kept,
        modal: Option<&Modal>,
    ) -> Opened {
        let mut sources = Sources::new();
        let source = sources.add(self.name.clone(), &*self.text);
        let host = Arc::new(ChannelHost::new(environment.clone(), &self.name, &config.subs, sources));
        let text = if how.raw && how.start_line > 1 { behind(&self.text, how.start_line) } else { self.text.clone() };
        let typed = self.name.starts_with('<');
        let program = PartProgram {
            source,
            text,
            start: (*start).into(),
            modes: config.modes.clone(),
            language: config.language.clone(),
            host: HostRef::new(host.clone()),
            kept: kept.clone(),
            skip_deleted: how.block_skip,
            modal: modal.copied().filter(|_| typed),
        };
        Opened { steps: reader(&program), host, environment: environment.clone(), typed }
    }
}

/// The text with the rows before `line` empty: lines keep their numbers.
fn behind(text: &str, line: u32) -> Arc<str> {
    let mut out = String::with_capacity(text.len());
    for (row, number) in text.split_inclusive('\n').zip(1..) {
        out.push_str(if number < line { "\n" } else { row });
    }
    out.into()
}

/// A program that is fed.
pub struct Running {
    /// Number of the run.
    pub run: u32,
    /// Its commands.
    pub steps: Steps,
    /// Where planned steps come out.
    pub planner: Planner,
    /// Everything has been read.
    pub ended: bool,
    /// It ends with an error.
    pub failed: bool,
    /// Nothing is read until the answer is there.
    pub waits: bool,
    /// One block or a subroutine, not a file.
    pub typed: bool,
    host: Arc<ChannelHost>,
    reader: RunReader,
    mark: Mark,
    /// Line where motion starts, as long as it has not come.
    search: Option<u32>,
}

impl Running {
    /// Before the first command.
    pub fn new(run: u32, opened: Opened, config: &FeederConfig, start: &Point, how: &How) -> Self {
        let mut reader = RunReader::new(config.work, *start).with_symbols(opened.environment.symbols.clone());
        if how.dry_run {
            reader = reader.with_dry_run(config.dry_run_mm_s);
        }
        let search = (how.start_line > 1 && !how.raw).then_some(how.start_line);
        Self {
            run,
            steps: opened.steps,
            planner: Planner::new(config.axes, config.period_s, run),
            ended: false,
            failed: false,
            waits: false,
            typed: opened.typed,
            host: opened.host,
            reader,
            mark: Mark::default(),
            search,
        }
    }

    /// Reads one command.
    pub fn advance(&mut self, config: &FeederConfig) {
        match self.steps.next() {
            Some(Ok(step)) => {
                self.mark = Mark::from(&step);
                let done = match self.search {
                    Some(line) => self.look_for(line, &step, config),
                    None => self.read(&step, config),
                };
                if let Err(error) = done {
                    self.fail(note_of_error(&error, self.mark));
                }
            }
            Some(Err(diag)) => {
                let note = note_of_diag(&diag, &self.host.sources());
                self.fail(note);
            }
            None if self.search.is_some() => self.fail(no_start(self.search)),
            None => self.end(config),
        }
    }

    /// Block search: what stands before the line changes modes and position, and nothing moves.
    fn look_for(&mut self, line: u32, step: &Step, config: &FeederConfig) -> Result<(), RunError> {
        if matches!(step.command, Canon::ProgramEnd(_)) {
            self.fail(no_start(Some(line)));
            return Ok(());
        }
        if step.line < line || !self.steps.in_main() || step.block == 0 {
            return self.reader.read_silently(step);
        }
        self.search = None;
        let (planner, mut failed) = (&mut self.planner, None);
        self.reader.take_up(Mark::from(step), &mut |mark, item| {
            failed = failed.take().or(put(planner, config, mark, item).err());
        })?;
        failed.map_or_else(|| self.read(step, config), Err)
    }

    fn read(&mut self, step: &Step, config: &FeederConfig) -> Result<(), RunError> {
        let (planner, mut failed) = (&mut self.planner, None);
        let mut emit = |mark, item| match put(planner, config, mark, item) {
            Ok(end) => self.ended |= end,
            Err(error) => failed = failed.take().or(Some(error)),
        };
        self.reader.read(step, &mut emit)?;
        self.waits = waits_for_answer(&step.command);
        failed.map_or(Ok(()), Err)
    }

    /// Goes on with the answer. What the program keeps is what it has now: everything read so far has been executed.
    pub fn answer(&mut self, answer: &Answer) -> Option<Kept> {
        if !std::mem::take(&mut self.waits) {
            return None;
        }
        self.steps.answer(answer);
        if let Answer::Probe { stop, .. } = answer {
            self.reader.stand_at(*stop);
        }
        self.steps.kept()
    }

    /// Everything before the wrong block is executed, then the channel stops.
    fn fail(&mut self, note: ErrorNote) {
        self.planner.push(Mark { line: note.line, ..self.mark }, Action::Fault(note));
        (self.ended, self.failed) = (true, true);
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
        (Item::Special(..), Some(_)) => {
            let text = "probing and motion in step with the spindle are not for reference pulses".to_owned();
            return Err(RunError { code: Code::UnknownCode, text });
        }
        (Item::Move(m), None) => planner.push_move(mark, m),
        (Item::Special(m, special), None) => {
            let fastest = path_limits(&m.path, &config.axes, f64::INFINITY, 1.0).v;
            if m.feed > fastest && !matches!(special, Special::Probe(_)) {
                let text = format!("the thread needs {:.0} mm/min, the axes allow {:.0}", 60.0 * m.feed, 60.0 * fastest);
                return Err(RunError { code: Code::ThreadTooFast, text });
            }
            planner.push_special(mark, m, special);
        }
        (Item::Action(action), _) => {
            planner.push(mark, action);
            return Ok(matches!(action, Action::End { .. }));
        }
    }
    Ok(false)
}

/// PC-13: what does not fit the tick is refused, never slowed down.
fn pulses(m: &Move, config: &FeederConfig, blu_mm: f64, batch_max: u32) -> Result<PulseMove, RunError> {
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

fn no_start(line: Option<u32>) -> ErrorNote {
    let text = format!("the program ends before line {}", line.unwrap_or(0));
    ErrorNote::new(Code::NoStartLine, 0, 0, &text)
}

/// An error of the run reader as a note.
pub fn note_of_error(error: &RunError, mark: Mark) -> ErrorNote {
    ErrorNote::new(error.code, mark.line, 1, &error.text)
}

/// An error of the interpreter as a note; one in a file of subroutines names it.
pub fn note_of_diag(diag: &Diag, sources: &Sources) -> ErrorNote {
    let at = sources.line_col(diag.span.source, diag.span.start);
    let text = match diag.span.source.0 {
        0 => diag.message.clone(),
        _ => format!("{}: {}", sources.get(diag.span.source).name, diag.message),
    };
    ErrorNote::new(diag.code, at.line, at.column, &text)
}
