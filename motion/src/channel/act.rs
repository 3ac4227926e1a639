//! What the path asks of the channel, and what the channel asks of the path.
//! Runs: cyclic.

use super::{Channel, CncEvent, CncState, Wait};
use crate::execution::Demand;
use crate::segment::{Action, AuxCodes, Planned, Switch};

impl Channel {
    pub(super) fn demand_now(&self) -> Demand {
        let still = if self.modes.feed_disable { 0.0 } else { 1.0 };
        Demand {
            feed: self.demand.feed * still,
            rapid: self.demand.rapid * still,
            hold: self.state != CncState::Running,
            abort: matches!(self.state, CncState::Aborting | CncState::Fault),
            adaptive: self.io.adaptive,
            feed_hold: self.io.feed_hold,
            contact: self.io.probe,
            single: self.stops_at_blocks(),
            spindle_rev: self.spindle.revolutions(),
            spindle_rps: self.spindle.speed(),
            spindle_sense: self.spindle.sense(),
        }
    }

    /// Does what the path has reached; true if the path goes on at once.
    pub(super) fn act(&mut self, step: &Planned) -> bool {
        self.mark = step.mark;
        match &step.action {
            Action::Pulse(m) => self.pulses.as_mut().map(|p| p.start(m)).is_some(),
            Action::Aux(_) | Action::Spindle(_) if self.modes.aux_lock => true,
            Action::Spindle(command) => {
                self.spindle.obey(*command);
                true
            }
            Action::Switch(Switch::Spindle, on) => {
                self.spindle.use_override(*on);
                true
            }
            Action::Output(output) => {
                self.io.set(output);
                true
            }
            Action::Write(variable, value) => self.write(variable, *value),
            Action::Read(reads) => self.ask(reads),
            Action::WaitInput(input) => self.wait_input(input),
            Action::Aux(codes) if !codes.wait || !self.listened => {
                self.aux.note(*codes);
                true
            }
            Action::Aux(codes) => self.wait_for(*codes, Wait::Codes),
            Action::ProgramStop { optional: true } if !self.config.optional_stop && !self.modes.optional_stop => true,
            Action::ProgramStop { optional } => {
                self.stop_code = Some(u16::from(*optional));
                self.event(CncEvent::ProgramStop);
                false
            }
            Action::End { m } if *m != 0 && self.config.handshake && self.listened => {
                let codes = AuxCodes { m: [*m, 0, 0, 0], m_count: 1, wait: true, ..AuxCodes::default() };
                self.wait_for(codes, Wait::End)
            }
            Action::End { .. } => {
                self.end_program();
                false
            }
            Action::Fault(note) => {
                self.fail(*note);
                false
            }
            Action::Move(_) | Action::Special(..) | Action::Dwell(_) | Action::Switch(..) => true,
        }
    }
}
