//! One block, in the order of RS274/NGC (LinuxCNC "Order of Execution"): comment, feed mode, F, spindle mode, S, T, tool change, inputs
//! and outputs, spindle, coolant, overrides, user M code, dwell, plane, units, compensation, tool length, work offset, path control,
//! distance modes, retract mode, offsets, motion, stop.

mod comments;
mod data;
mod offsets;
mod rates;
mod stop;
mod switches;
mod tools;

pub use offsets::origin;
pub use stop::epilogue;

use super::code::{Code as Arena, Row};
use super::modal::{Distance, Modal, Retract};
use super::motion;
use super::request::{Request, not_now};
use super::state::State;
use super::word::{Action, Control, Group};
use crate::canon::{Canon, Step};
use std::collections::VecDeque;
use takt_base::{Diag, Severity, Span};

/// Where commands go.
#[derive(Debug)]
pub struct Out<'a> {
    /// Commands that wait to be read.
    pub queue: &'a mut VecDeque<Step>,
    /// Errors and warnings.
    pub diags: &'a mut Vec<Diag>,
    /// Block number of the commands.
    pub block: u32,
    /// Their line.
    pub line: u32,
    /// Their N word.
    pub n: Option<u32>,
}

impl Out<'_> {
    /// Adds a command.
    #[inline]
    pub fn emit(&mut self, command: Canon) {
        self.queue.push_back(Step { block: self.block, line: self.line, n: self.n, command });
    }

    /// True if something is wrong.
    pub fn failed(&self) -> bool {
        self.diags.iter().any(|d| d.severity == Severity::Error)
    }
}

/// What a block does to the flow of the program.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub enum Then {
    /// The next row.
    #[default]
    Next,
    /// M2, M30: nothing behind it is read.
    End,
    /// M98: the subroutine of this number, so many times.
    Call(u32, u32),
    /// M99.
    Return,
    /// G70 to G72: the contour has to be read.
    Contour(u16),
}

/// Runs a block that `request` holds. After an error the modes are as if the block had been right as far as that is known, so that the
/// next block can be checked.
pub fn execute(request: &Request, row: &Row, arena: &Arena, state: &mut State, out: &mut Out) -> Then {
    let mut run = Run { request, state, out, then: Then::Next };
    // Settings of PLC variables that the row has made.
    for (name, value) in std::mem::take(&mut run.state.outside.sets) {
        run.emit(Canon::SetPlc(name, value));
    }
    if !row.comments.is_empty() {
        run.comments(row, arena);
    }
    if run.halted() {
        return run.then;
    }
    if !request.is_empty() {
        run.block();
    }
    run.then
}

/// A block at work.
pub struct Run<'a, 'b> {
    /// Its words.
    pub request: &'a Request,
    /// What it changes.
    pub state: &'a mut State,
    /// Where its commands go.
    pub out: &'a mut Out<'b>,
    /// What comes next.
    pub then: Then,
}

/// Result of a part of a block.
pub type Done = Result<(), Box<Diag>>;

impl Run<'_, '_> {
    /// Adds a command; it waits behind a move that waits.
    #[inline]
    pub fn emit(&mut self, command: Canon) {
        if !self.state.comp.waits() {
            return self.out.emit(command);
        }
        self.wait(command);
    }

    /// An error while G41 or G42 is in force.
    pub fn uncompensated(&self, at: Span, what: &str) -> Done {
        match self.state.modal.side {
            None => Ok(()),
            Some(_) => Err(Box::new(not_now(at, format!("{what} while G41 or G42 is in force"), "write G40 first"))),
        }
    }

    /// What LinuxCNC says in its listing of a mode that no canonical command shows.
    pub fn say(&mut self, what: &'static str) {
        if self.state.options.drop_in {
            self.emit(Canon::Remark(what));
        }
    }

    #[cold]
    fn wait(&mut self, command: Canon) {
        let said = matches!(command, Canon::Comment(_) | Canon::Message(_) | Canon::Print(_) | Canon::Log(_));
        if said && self.state.options.drop_in {
            return self.out.emit(command);
        }
        if self.state.comp.is_full() {
            return self.out.diags.push(super::comp::too_many_wait(self.request.span));
        }
        let step = Step { block: self.out.block, line: self.out.line, n: self.out.n, command };
        self.state.comp.hold(step);
    }

    /// The modes.
    pub fn modal(&mut self) -> &mut Modal {
        &mut self.state.modal
    }

    /// LinuxCNC's interpreter stops at the first error of a block; ours looks for more.
    fn halted(&self) -> bool {
        self.state.options.drop_in && self.out.failed()
    }

    /// True if the next part of the block is to run.
    fn goes_on(&mut self, done: Done) -> bool {
        if let Err(diag) = done {
            self.out.diags.push(*diag);
        }
        !self.halted()
    }

    fn block(&mut self) {
        if self.request.only_moves() {
            let rates = self.rates();
            if self.goes_on(rates) {
                self.motion();
            }
            return;
        }
        let parts: [fn(&mut Self) -> Done; 13] = [
            Self::feed_mode,
            Self::rates,
            Self::tools,
            Self::outputs,
            Self::switches,
            Self::dwell,
            Self::plane_and_units,
            Self::compensation,
            Self::tool_length,
            Self::work_offset_code,
            Self::modes,
            Self::non_modal,
            Self::motion_part,
        ];
        for part in parts {
            let done = part(self);
            if !self.goes_on(done) {
                return;
            }
        }
        self.stop();
    }

    fn motion_part(&mut self) -> Done {
        self.motion();
        Ok(())
    }

    /// A dwell of no time is no command (report §3.6.2).
    fn dwell(&mut self) -> Done {
        let dwell = self.request.code(Group::NonModal) == Some(Action::Dwell);
        let zero = self.state.options.drop_in;
        if let Some(seconds) = self.request.value('P').filter(|&p| dwell && (p > 0.0 || zero)) {
            self.emit(Canon::Dwell(seconds));
        }
        Ok(())
    }

    fn modes(&mut self) -> Done {
        if let Some(Action::Control(control)) = self.request.code(Group::Control) {
            self.control(control)?;
        }
        if let Some(Action::Distance(distance)) = self.request.code(Group::Distance)
            && std::mem::replace(&mut self.modal().distance, distance) != distance
        {
            self.say(match distance {
                Distance::Absolute => "distance mode changed to absolute",
                Distance::Incremental => "distance mode changed to incremental",
            });
        }
        if let Some(Action::ArcDistance(distance)) = self.request.code(Group::ArcDistance)
            && std::mem::replace(&mut self.modal().arc_distance, distance) != distance
        {
            self.say(match distance {
                Distance::Absolute => "IJK distance mode changed to absolute",
                Distance::Incremental => "IJK distance mode changed to incremental",
            });
        }
        if let Some(Action::Retract(retract)) = self.request.code(Group::Retract) {
            self.modal().retract = retract;
            self.say(match retract {
                Retract::R => "retract mode set to r_plane",
                Retract::OldZ => "retract mode set to old_z",
            });
        }
        Ok(())
    }

    fn control(&mut self, control: Control) -> Done {
        if self.state.options.drop_in {
            self.uncompensated(self.request.code_span(Group::Control), "another path control")?;
        }
        let mode = control.mode(self.request.tolerance(control));
        self.modal().control = mode;
        self.emit(Canon::SetMotionControlMode(mode));
        let naive = self.request.value('Q');
        if control == Control::Continuous && (naive.is_some() || self.state.options.drop_in) {
            let tolerance = naive.or(self.request.value('P')).unwrap_or(0.0);
            self.modal().naive_tolerance = tolerance;
            self.emit(Canon::SetNaivecamTolerance(tolerance));
        }
        Ok(())
    }

    fn motion(&mut self) {
        if let Some(Action::Motion(motion)) = self.request.code(Group::Motion) {
            self.modal().motion = motion;
            if motion.is_none() {
                super::cycle::forget(&mut self.state.sticky);
                self.say("motion mode set to none");
            }
        }
        if let Some(motion) = self.request.motion
            && let Err(diag) = motion::run(self, motion)
        {
            self.forgive(&diag);
            self.out.diags.push(*diag);
        }
    }

    /// A missing feed is reported once, not for each move behind it.
    fn forgive(&mut self, diag: &Diag) {
        if diag.code == takt_base::Code::NoFeed && !self.state.options.drop_in {
            self.modal().feed = Some(1.0);
        }
    }
}

/// Brings back modes that a subroutine saved (M73).
pub fn restore(state: &mut State, request: &Request, out: &mut Out, saved: &Modal) {
    Run { request, state, out, then: Then::Next }.restore_modes(saved);
}

/// Lets a move out that waits for the next one (cutter compensation), at the end of a program.
pub fn release(state: &mut State, out: &mut Out) {
    super::comp::release(state, out);
}
