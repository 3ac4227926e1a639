//! Spindle, feed a revolution, threads, rigid tapping, probing.
//! Runs: background. The plan counts with the commanded speed; the cyclic side holds it back where the spindle is slower.

use super::{Emit, Item, RunError, RunReader};
use crate::canon::{Canon, Position, Probe};
use crate::geometry::Path;
use crate::lookahead::Move;
use crate::segment::Mark;
use crate::spindle::{Speed, SpindleCommand};
use crate::sync::Special;
use takt_base::Code;

/// What the program has said about the spindle.
#[derive(Clone, Debug, Default)]
pub struct SpindleState {
    /// 1, -1, 0.
    direction: i8,
    /// S word.
    s: f64,
    /// G96: highest speed in revolutions a minute.
    surface: Option<f64>,
    /// Feed is a revolution (G95).
    pub per_rev: bool,
    /// G33: mm a revolution.
    pitch: Option<f64>,
    /// A thread has begun and goes on with the next move.
    chained: bool,
    /// Given out last.
    shown: Option<SpindleCommand>,
}

impl SpindleState {
    /// Looks at a command that may be for the spindle.
    pub fn see(&mut self, command: &Canon) {
        match command {
            Canon::SetSpindleSpeed(s) => self.s = *s,
            Canon::StartSpindleClockwise => self.direction = 1,
            Canon::StartSpindleCounterclockwise => self.direction = -1,
            Canon::StopSpindleTurning => self.direction = 0,
            _ => {}
        }
    }

    /// G96 with its limit, G97.
    pub fn set_mode(&mut self, max: Option<f64>) {
        self.surface = max;
    }

    /// G33 begins.
    pub fn start_sync(&mut self, pitch_mm: f64) {
        self.pitch = Some(pitch_mm.abs());
    }

    /// G33 ends; the next one goes on with the thread if nothing moves between them.
    pub fn stop_sync(&mut self) {
        self.pitch = None;
    }

    /// The command comes again: nobody has seen it.
    pub fn forget_shown(&mut self) {
        self.shown = None;
    }

    /// The codes that bring the spindle to its state.
    pub fn codes(&self) -> Vec<Canon> {
        match self.direction {
            0 => Vec::new(),
            1 => vec![Canon::SetSpindleSpeed(self.s), Canon::StartSpindleClockwise],
            _ => vec![Canon::SetSpindleSpeed(self.s), Canon::StartSpindleCounterclockwise],
        }
    }

    /// What makes a feed move a thread.
    pub fn thread(&self) -> Option<Special> {
        self.pitch.map(|pitch| Special::Thread { pitch, starts: !self.chained })
    }

    /// A move has been given out.
    pub fn moved(&mut self, thread: bool) {
        self.chained = thread;
    }

    fn command(&self, unit_mm: f64, x0: f64) -> SpindleCommand {
        let speed = match self.surface {
            None => Speed::Constant(self.s / 60.0),
            // S is metres a minute with G21, feet a minute with G20.
            Some(max) => {
                let foot_or_metre = if unit_mm == 25.4 { 304.8 } else { 1000.0 };
                Speed::Surface { mm_s: self.s * foot_or_metre / 60.0, max: max / 60.0, x0 }
            }
        };
        SpindleCommand { direction: self.direction, speed }
    }

    /// The command for the spindle, if it is another one than before.
    pub fn changed(&mut self, unit_mm: f64, x0: f64) -> Option<SpindleCommand> {
        let command = self.command(unit_mm, x0);
        let before = self.shown.unwrap_or(SpindleCommand { direction: 0, speed: Speed::Constant(0.0) });
        let silent = command.direction == 0 && before.direction == 0;
        (command != before && !silent).then(|| {
            self.shown = Some(command);
            command
        })
    }
}

impl RunReader {
    /// Highest speed of the spindle on a path, in rev/s.
    pub(super) fn fastest(&self, path: &Path) -> Result<f64, RunError> {
        let x0 = self.origin[0] + self.tool[0];
        let command = self.spindle.command(self.unit_mm, x0);
        let (low, high) = path.bounds(0);
        let nearest = if low <= x0 && x0 <= high { 0.0 } else { (low - x0).abs().min((high - x0).abs()) };
        let rps = command.speed.at_radius(nearest);
        if command.direction == 0 || rps.is_nan() || rps <= 0.0 {
            return Err(RunError {
                code: Code::SpindleStopped,
                text: "the spindle does not turn: write S and M3 before it".to_owned(),
            });
        }
        Ok(rps)
    }

    /// Speed of a thread in mm/s at the commanded speed of the spindle.
    pub(super) fn nominal(&self, path: &Path) -> Result<f64, RunError> {
        Ok(self.spindle.pitch.unwrap_or(0.0) * self.fastest(path)?)
    }

    pub(super) fn tap(&mut self, mark: Mark, to: &Position, emit: Emit) -> Result<(), RunError> {
        let path = Path::line(self.position, self.machine(to));
        self.check(&path)?;
        if self.dry_run.is_some() {
            let back = Path::line(path.end, path.start);
            self.go(mark, path, false, emit)?;
            return self.go(mark, back, false, emit);
        }
        let (Some(pitch), feed) = (self.spindle.pitch, self.nominal(&path)?) else {
            return Err(super::unsupported("rigid tapping without a pitch"));
        };
        self.flush_aux(emit);
        self.flush_outputs(mark, emit);
        if path.length > 0.0 {
            let m = Move { path, feed, rapid: false, exact_stop: true, per_rev: 0.0 };
            emit(mark, Item::Special(m, Special::Tap(pitch)));
        }
        self.spindle.moved(false);
        Ok(())
    }

    pub(super) fn probe(&mut self, mark: Mark, to: &Position, probe: Probe, emit: Emit) -> Result<(), RunError> {
        let path = Path::line(self.position, self.machine(to));
        self.check(&path)?;
        let (feed, _) = self.feed(&path, false)?;
        if path.length <= 0.0 {
            return Err(RunError { code: Code::ProbeMissed, text: "the probe move has no length".to_owned() });
        }
        self.flush_aux(emit);
        self.flush_outputs(mark, emit);
        self.position = path.end;
        self.spindle.moved(false);
        let m = Move { path, feed, rapid: false, exact_stop: true, per_rev: 0.0 };
        emit(mark, Item::Special(m, Special::Probe(probe)));
        Ok(())
    }
}
