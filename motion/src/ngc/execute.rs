//! One block, in the order of RS274/NGC: comment, F, S, T, tool change, spindle, coolant, overrides, user M code, dwell, plane, units,
//! work offset, path control, distance modes, motion, stop.

use super::block::{Block, Comment};
use super::limits;
use super::modal::{Modal, mm_per_unit, scaled};
use super::motion;
use super::options::Options;
use super::request::{Request, bad_value};
use super::word::{Action, Coolant, Group, Stop};
use crate::canon::{Canon, Direction, Plane, ProgramEnd};
use takt_base::units::MmPerMin;
use takt_base::{Diag, Severity};

/// What came of a block.
#[derive(Debug, Default)]
pub struct Outcome {
    /// Commands, in order; of no use if there are errors.
    pub commands: Vec<Canon>,
    /// Errors and warnings.
    pub diags: Vec<Diag>,
    /// M2 or M30: nothing behind it is read.
    pub end: bool,
}

impl Outcome {
    /// True if the block may not run.
    pub fn has_errors(&self) -> bool {
        self.diags.iter().any(|d| d.severity == Severity::Error)
    }
}

/// Runs `block` against `modal`. After an error `modal` is as if the block had been right as far as that is known, so that the next
/// block can be checked.
pub fn execute(block: &Block, modal: &mut Modal, options: &Options) -> Outcome {
    let mut outcome = Outcome::default();
    let request = Request::new(block, modal, &mut outcome.diags);
    let mut run = Run { request: &request, modal, options, out: outcome };
    run.comments(block);
    run.rates();
    run.tools();
    run.switches();
    run.dwell();
    run.modes();
    run.motion();
    run.stop();
    run.out
}

struct Run<'a> {
    request: &'a Request,
    modal: &'a mut Modal,
    options: &'a Options,
    out: Outcome,
}

impl Run<'_> {
    fn emit(&mut self, command: Canon) {
        self.out.commands.push(command);
    }

    fn comments(&mut self, block: &Block) {
        for comment in &block.comments {
            self.emit(match comment {
                Comment::Plain(text) => Canon::Comment(text.clone()),
                Comment::Message(text) => Canon::Message(text.clone()),
            });
        }
    }

    /// F counts in the units before a G20 or G21 of the same block, as in RS274/NGC.
    fn rates(&mut self) {
        if let Some(feed) = self.request.value('F') {
            self.check_feed(feed);
            self.modal.feed = Some(feed);
            self.emit(Canon::SetFeedRate(feed));
        }
        if let Some(speed) = self.request.value('S') {
            self.modal.speed = speed;
            self.emit(Canon::SetSpindleSpeed(speed));
        }
    }

    fn check_feed(&mut self, feed: f64) {
        let (Some(MmPerMin(max)), Some(word)) = (self.options.feed_max, self.request.word('F')) else { return };
        let max = max / mm_per_unit(self.modal.units);
        if feed > max {
            self.out.diags.push(bad_value(
                word,
                &format!("the largest feed is {max:.4}"),
                "write a smaller feed, or raise the limit",
            ));
        }
    }

    fn tools(&mut self) {
        if let Some(tool) = self.request.word('T').and_then(|w| w.whole()) {
            self.modal.tool = tool;
            self.emit(Canon::SelectTool(tool));
        }
        if self.request.code(Group::ToolChange).is_some() {
            self.modal.spindle = None;
            self.emit(Canon::StopSpindleTurning);
            self.emit(Canon::ChangeTool(self.modal.tool));
        }
    }

    fn switches(&mut self) {
        if let Some(Action::Spindle(direction)) = self.request.code(Group::Spindle) {
            self.spindle(direction);
        }
        if let Some(Action::Coolant(coolant)) = self.request.code(Group::Coolant) {
            self.coolant(coolant);
        }
        if let Some(Action::Overrides(enabled)) = self.request.code(Group::Overrides) {
            self.overrides(enabled);
        }
        if let Some(Action::User(code)) = self.request.code(Group::User) {
            self.emit(Canon::UserMCode { code, p: self.request.value('P'), q: self.request.value('Q') });
        }
    }

    fn spindle(&mut self, direction: Option<Direction>) {
        self.modal.spindle = direction;
        self.emit(match direction {
            Some(Direction::Clockwise) => Canon::StartSpindleClockwise,
            Some(Direction::Counterclockwise) => Canon::StartSpindleCounterclockwise,
            None => Canon::StopSpindleTurning,
        });
    }

    fn coolant(&mut self, coolant: Coolant) {
        match coolant {
            Coolant::Mist => self.emit(Canon::MistOn),
            Coolant::Flood => self.emit(Canon::FloodOn),
            Coolant::Off => {
                self.emit(Canon::MistOff);
                self.emit(Canon::FloodOff);
            }
        }
        self.modal.mist = coolant == Coolant::Mist || (self.modal.mist && coolant == Coolant::Flood);
        self.modal.flood = coolant == Coolant::Flood || (self.modal.flood && coolant == Coolant::Mist);
    }

    fn overrides(&mut self, enabled: bool) {
        self.modal.overrides = enabled;
        self.emit(if enabled { Canon::EnableFeedOverride } else { Canon::DisableFeedOverride });
        self.emit(if enabled { Canon::EnableSpeedOverride } else { Canon::DisableSpeedOverride });
    }

    /// A dwell of no time is no command (report §3.6.2).
    fn dwell(&mut self) {
        let dwell = self.request.code(Group::NonModal) == Some(Action::Dwell);
        if let Some(seconds) = self.request.value('P').filter(|&p| dwell && p > 0.0) {
            self.emit(Canon::Dwell(seconds));
        }
    }

    fn modes(&mut self) {
        if let Some(Action::Plane(plane)) = self.request.code(Group::Plane) {
            self.modal.plane = plane;
            self.emit(Canon::SelectPlane(plane));
        }
        if let Some(Action::Units(units)) = self.request.code(Group::Units) {
            self.modal.change_units(units);
            self.emit(Canon::UseLengthUnits(units));
        }
        if let Some(Action::WorkOffset(index)) = self.request.code(Group::WorkOffset) {
            self.work_offset(index);
        }
        if let Some(Action::Control(control)) = self.request.code(Group::Control) {
            self.modal.control = control.mode(self.request.tolerance(control));
            self.emit(Canon::SetMotionControlMode(self.modal.control));
        }
        if let Some(Action::Distance(distance)) = self.request.code(Group::Distance) {
            self.modal.distance = distance;
        }
        if let Some(Action::ArcDistance(distance)) = self.request.code(Group::ArcDistance) {
            self.modal.arc_distance = distance;
        }
    }

    /// Choosing the work offset that is in force changes nothing and emits nothing.
    fn work_offset(&mut self, index: usize) {
        if index == self.modal.work_offset {
            return;
        }
        let table = &self.options.work_offsets;
        self.modal.change_offset(table[self.modal.work_offset], table[index]);
        self.modal.work_offset = index;
        self.emit(origin(self.modal, self.options));
    }

    fn motion(&mut self) {
        if let Some(Action::Motion(motion)) = self.request.code(Group::Motion) {
            self.modal.motion = motion;
        }
        let Some(motion) = self.request.motion else { return };
        let (end, command) = motion::command(motion, self.request, self.modal, &mut self.out.diags);
        match command {
            Ok(command) => {
                self.out.diags.extend(limits::check(&command, self.request.span, self.modal, self.options));
                self.emit(command);
            }
            Err(diag) => {
                self.forgive(&diag);
                self.out.diags.push(diag);
            }
        }
        self.modal.position = end;
    }

    /// A missing feed is reported once, not for each move behind it.
    fn forgive(&mut self, diag: &Diag) {
        if diag.code == takt_base::Code::NoFeed {
            self.modal.feed = Some(1.0);
        }
    }

    fn stop(&mut self) {
        let Some(Action::Stop(stop)) = self.request.code(Group::Stopping) else { return };
        match stop {
            Stop::Program => self.emit(Canon::ProgramStop),
            Stop::Optional => self.emit(Canon::OptionalProgramStop),
            Stop::PalletShuttle => {
                self.emit(Canon::PalletShuttle);
                self.emit(Canon::ProgramStop);
            }
            Stop::End(end) => self.end(end),
        }
    }

    /// M2 and M30 bring back what a program may have changed (R1-40), each only if it did.
    fn end(&mut self, end: ProgramEnd) {
        self.out.end = true;
        self.work_offset(0);
        if self.modal.plane != Plane::Xy {
            self.modal.plane = Plane::Xy;
            self.emit(Canon::SelectPlane(Plane::Xy));
        }
        if !self.modal.overrides {
            self.overrides(true);
        }
        if self.modal.spindle.is_some() {
            self.spindle(None);
        }
        if self.modal.mist || self.modal.flood {
            self.coolant(Coolant::Off);
        }
        self.emit(Canon::ProgramEnd(end));
    }
}

/// The command for the work offset in force, in length units.
pub fn origin(modal: &Modal, options: &Options) -> Canon {
    let offset = options.work_offsets[modal.work_offset];
    Canon::SetOriginOffsets(scaled(offset, 1.0 / mm_per_unit(modal.units)))
}
