//! Looks through a program without a machine: for CNC_LoadProgram and CNC_CheckProgram.
//! Runs: background. Answers of the machine are assumed: behind the first one only errors count that do not depend on values.

use super::FeederConfig;
use super::running::{Opened, note_of_diag, note_of_error};
use crate::geometry::{AXES, Point};
use crate::lookahead::Planner;
use crate::run::{Item, RunReader, Work};
use crate::segment::{Action, ErrorNote, Mark};
use crate::sync::waits_for_answer;
use takt_base::Code;

/// Steps read when a program is checked; a longer one is checked no further.
const STEPS_MAX: usize = 2_000_000;
/// The same behind the first answer that is assumed: a loop may wait for it.
const ASSUMED_MAX: usize = 20_000;

/// Measures of a program.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Found {
    /// Time in seconds without waiting for anybody.
    pub time_s: f64,
    /// Smallest machine coordinates.
    pub min: Point,
    /// Largest machine coordinates.
    pub max: Point,
}

/// Errors that are there whatever the values are.
fn is_of_form(code: Code) -> bool {
    matches!(
        code,
        Code::BadCharacter
            | Code::BadWord
            | Code::UnknownCode
            | Code::ModalConflict
            | Code::DuplicateWord
            | Code::CommentNotClosed
            | Code::BadExpression
            | Code::MissingSub
            | Code::NotInThisVersion
            | Code::UnknownPlcVariable
            | Code::PlcVariableType
            | Code::TooManyReads
    )
}

/// The first error of the program, whatever the position of the machine; of its travel too, if `limits` says so.
pub fn first_error(opened: Opened, config: &FeederConfig, start: &Point, limits: bool) -> Result<(), Box<ErrorNote>> {
    let work = if limits { config.work } else { Work { exists: config.work.exists, ..Work::default() } };
    let mut run = RunReader::new(work, *start).with_symbols(opened.environment.symbols.clone());
    let (mut left, mut assumed) = (STEPS_MAX, false);
    for step in opened.steps {
        let (found, mark) = match &step {
            Ok(step) => {
                let mark = Mark::from(step);
                (run.read(step, &mut |_, _| {}).err().map(|e| note_of_error(&e, mark)), mark)
            }
            Err(diag) => (Some(note_of_diag(diag, &opened.host.sources())), Mark::default()),
        };
        match found {
            Some(note) if !assumed || is_of_form(note.code) => return Err(Box::new(note)),
            Some(_) => return Ok(()),
            None => {}
        }
        if !assumed && mark.block > 0 && step.is_ok_and(|s| waits_for_answer(&s.command)) {
            (assumed, left) = (true, ASSUMED_MAX.min(left));
        }
        left -= 1;
        if left == 0 {
            return Ok(());
        }
    }
    Ok(())
}

/// Time and extent of a program without errors.
pub fn measure(opened: Opened, config: &FeederConfig, start: &Point) -> Found {
    let mut run = RunReader::new(Work { exists: config.work.exists, ..Work::default() }, *start)
        .with_symbols(opened.environment.symbols.clone());
    let mut planner = Planner::new(config.axes, config.period_s, 0);
    let mut found = Found { time_s: 0.0, min: *start, max: *start };
    for step in opened.steps.take(STEPS_MAX) {
        let Ok(step) = step else { break };
        let mut emit = |mark, item| match item {
            Item::Move(m) => planner.push_move(mark, m),
            Item::Special(m, special) => planner.push_special(mark, m, special),
            Item::Action(action) => planner.push(mark, action),
        };
        if run.read(&step, &mut emit).is_err() {
            break;
        }
        take(&mut planner, &mut found);
    }
    planner.flush();
    take(&mut planner, &mut found);
    found
}

fn take(planner: &mut Planner, found: &mut Found) {
    while let Some(step) = planner.pop() {
        match &step.action {
            Action::Move(segment) | Action::Special(segment, _) => {
                found.time_s += segment.profile.duration();
                for i in 0..AXES {
                    let (low, high) = segment.path.bounds(i);
                    (found.min[i], found.max[i]) = (found.min[i].min(low), found.max[i].max(high));
                }
            }
            Action::Dwell(seconds) => found.time_s += seconds,
            _ => {}
        }
    }
}
