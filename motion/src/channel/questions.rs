//! What the program asks while it runs: PLC variables, inputs, the probe. The answer goes to the feeder, which then reads on.
//! Runs: cyclic. PLC variables are read and written in [`Channel::exchange`], right behind the tick that has reached the command.

use super::io::Waiting;
use super::{Channel, CncEvent, Wait};
use crate::axis::Axis;
use crate::canon::Input;
use crate::feeder::Command;
use crate::geometry::Point;
use crate::plc::{READS, Variable};
use crate::segment::ErrorNote;
use crate::sync::{Answer, Reads};
use takt_base::Code;

/// PLC variables that one tick may set.
const WRITES: usize = 256;

/// Reads and writes that wait for the memory of the PLC program.
#[derive(Clone, Debug)]
pub struct Exchange {
    reads: Option<Reads>,
    writes: [Option<(Variable, f64)>; WRITES],
    count: usize,
}

impl Default for Exchange {
    fn default() -> Self {
        Self { reads: None, writes: [None; WRITES], count: 0 }
    }
}

/// The last probing.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct ProbeResult {
    /// The probe tripped.
    pub tripped: bool,
    /// Machine position at the edge, or at the end of the move.
    pub position: Point,
    /// Counts probings.
    pub seq: u32,
}

impl Channel {
    /// The program waits for these variables.
    pub(super) fn ask(&mut self, reads: &Reads) -> bool {
        self.exchange.reads = Some(*reads);
        true
    }

    /// A variable gets a value behind this tick; false if there are too many.
    pub(super) fn write(&mut self, variable: &Variable, value: f64) -> bool {
        let Some(place) = self.exchange.writes.get_mut(self.exchange.count) else {
            self.fail(ErrorNote::new(Code::QueueFull, self.mark.line, 1, "too many PLC variables are set in one tick"));
            return false;
        };
        *place = Some((*variable, value));
        self.exchange.count += 1;
        true
    }

    /// Between two scans: sets and reads what the path has reached, in this order.
    pub fn exchange(&mut self, memory: &mut [u8]) {
        for place in &mut self.exchange.writes[..self.exchange.count] {
            if let Some((variable, value)) = place.take() {
                variable.write(memory, value);
            }
        }
        self.exchange.count = 0;
        if let Some(reads) = self.exchange.reads.take() {
            let mut values = [0.0; READS];
            for (value, variable) in values.iter_mut().zip(&reads.variables).take(usize::from(reads.count)) {
                *value = variable.read(memory);
            }
            self.answer(Answer::Values(values));
        }
    }

    pub(super) fn forget_exchange(&mut self) {
        self.exchange.reads = None;
    }

    fn answer(&mut self, answer: Answer) {
        if self.link.commands.push(Command::Answer { run: self.run, answer }).is_err() {
            self.fail(ErrorNote::new(Code::QueueFull, self.mark.line, 1, Code::QueueFull.title()));
        }
    }

    /// M66 begins.
    pub(super) fn wait_input(&mut self, input: &Input) -> bool {
        let mut waiting = Waiting::new(*input, &self.io);
        if input.wait == 0 {
            let value = waiting.tick(&self.io, 0.0).unwrap_or(0.0);
            self.answer(Answer::Input(value));
            return true;
        }
        self.wait = Wait::Input(waiting);
        self.event(CncEvent::Wait);
        false
    }

    /// M66 while the channel waits.
    pub(super) fn input_tick(&mut self, mut waiting: Waiting) {
        let value = waiting.tick(&self.io, self.dt);
        self.wait = Wait::Input(waiting);
        if let Some(value) = value {
            self.answer(Answer::Input(value));
            self.event(if self.hold { CncEvent::FinishedHeld } else { CncEvent::Finished });
        }
    }

    /// Before the path moves: has the probe changed? The actual position counts.
    pub(super) fn look_at_probe(&mut self, axes: &[Axis]) {
        let Some(probe) = self.executor.probing() else { return };
        if self.io.probe == probe.towards {
            let mut at = self.executor.position();
            for (i, (p, axis)) in at.iter_mut().zip(self.map).enumerate() {
                let axis = axis.and_then(|i| axes.get(i)).filter(|_| !self.has_lock(i));
                *p = axis.map_or(*p, Axis::actual_position);
            }
            self.executor.trip(at);
        }
    }

    /// Behind the path: a probe move that has ended is answered.
    pub(super) fn probed(&mut self) {
        let Some(end) = self.executor.take_probed() else { return };
        if end.refused {
            let text = if end.probe.towards { "the probe is in contact already" } else { "the probe is not in contact" };
            return self.fail(ErrorNote::new(Code::ProbeNotReady, self.mark.line, 1, text));
        }
        self.probe = ProbeResult {
            tripped: end.trip.is_some(),
            position: end.trip.unwrap_or(end.stop),
            seq: self.probe.seq.wrapping_add(1),
        };
        if end.trip.is_none() && end.probe.must_trip {
            return self.fail(ErrorNote::new(Code::ProbeMissed, self.mark.line, 1, Code::ProbeMissed.title()));
        }
        self.answer(Answer::Probe { trip: end.trip, stop: end.stop });
    }

    /// The last probing.
    pub fn probe_result(&self) -> &ProbeResult {
        &self.probe
    }
}
