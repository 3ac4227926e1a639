//! M0, M1, M2, M30, M60, M98, M99.

use super::{Out, Run, Then};
use crate::canon::{Canon, MotionMode, Plane, ProgramEnd};
use crate::ngc::modal::{Distance, FeedMode, scaled};
use crate::ngc::request::{bad_value, missing};
use crate::ngc::state::State;
use crate::ngc::word::{Action, Coolant, Group, Stop};

impl Run<'_, '_> {
    pub(super) fn stop(&mut self) {
        match self.request.code(Group::Stopping) {
            Some(Action::Stop(Stop::Program)) => self.emit(Canon::ProgramStop),
            Some(Action::Stop(Stop::Optional)) => self.emit(Canon::OptionalProgramStop),
            Some(Action::Stop(Stop::PalletShuttle)) => {
                self.emit(Canon::PalletShuttle);
                self.emit(Canon::ProgramStop);
            }
            Some(Action::Stop(Stop::End(end))) => self.end(end),
            Some(Action::Call) => self.call(),
            Some(Action::Return) => self.then = Then::Return,
            _ => {}
        }
    }

    fn call(&mut self) {
        let at = self.request.code_span(Group::Stopping);
        let Some(word) = self.request.word('P') else {
            let diag = missing(at, "P").help("write the number of the subprogram, such as M98 P100");
            return self.out.diags.push(diag);
        };
        let Some(number) = word.whole() else {
            return self.out.diags.push(bad_value(word, "not the number of a subprogram", "write a whole number"));
        };
        let times = match self.request.word('L') {
            None => 1,
            Some(word) => match word.whole() {
                Some(times) => times,
                None => return self.out.diags.push(bad_value(word, "not a number of times", "write a whole number")),
            },
        };
        self.then = Then::Call(number, times);
    }

    /// M2 and M30 bring back what a program may have changed (R1-40), each only if it did.
    fn end(&mut self, end: ProgramEnd) {
        self.then = Then::End;
        self.flush_compensation();
        if self.state.options.drop_in {
            return epilogue(self.state, self.out, end);
        }
        self.modal().side = None;
        self.work_offset(0);
        self.use_plane(Plane::Xy);
        if !self.state.modal.overrides || !self.state.modal.speed_override {
            self.overrides(true, true);
        }
        if self.state.modal.spindle.is_some() {
            self.spindle(None);
        }
        if self.state.modal.mist || self.state.modal.flood {
            self.coolant(Coolant::Off);
        }
        self.emit(Canon::ProgramEnd(end));
    }
}

/// What LinuxCNC's M2 brings back, in its order.
pub fn epilogue(state: &mut State, out: &mut Out, end: ProgramEnd) {
    let (work, rotation) = state.work(0);
    state.params.set(5220, 1.0);
    state.modal.work_offset = 0;
    let offsets = crate::ngc::modal::Offsets { work, rotation, ..state.modal.offsets };
    state.modal.change_offsets(offsets);
    out.emit(Canon::SetG5xOffset(1, scaled(work, 1.0 / state.unit())));
    out.emit(Canon::SetXyRotation(rotation));
    if state.modal.plane != Plane::Xy {
        state.modal.plane = Plane::Xy;
        out.emit(Canon::SelectPlane(Plane::Xy));
    }
    state.modal.distance = Distance::Absolute;
    state.modal.feed_mode = FeedMode::PerMinute;
    out.emit(Canon::SetFeedMode(false));
    state.modal.feed = None;
    out.emit(Canon::SetFeedRate(0.0));
    if !state.modal.overrides {
        state.modal.overrides = true;
        out.emit(Canon::EnableFeedOverride);
    }
    state.modal.spindle = None;
    out.emit(Canon::StopSpindleTurning);
    state.modal.surface_speed = None;
    out.emit(Canon::SetSpindleMode(None));
    if std::mem::take(&mut state.modal.mist) {
        out.emit(Canon::MistOff);
    }
    if std::mem::take(&mut state.modal.flood) {
        out.emit(Canon::FloodOff);
    }
    state.modal.control = MotionMode::Continuous(0.0);
    state.modal.side = None;
    if end == ProgramEnd::M30 {
        out.emit(Canon::PalletShuttle);
    }
    out.emit(Canon::ProgramEnd(end));
}
