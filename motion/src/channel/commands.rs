//! Commands of the CNC blocks to a channel.
//! Runs: cyclic. From: CNC function blocks §4.4, transitions N2..N10.

use super::{Channel, CncEvent, CncState, Load};
use crate::axis::{Axis, AxisState, CommandId, Outcome};
use crate::feeder::{Command, NAME_BYTES};
use crate::geometry::{AXES, Point};
use crate::segment::ErrorNote;
use takt_base::Code;

impl Channel {
    pub(super) fn start_point(&self, axes: &[Axis]) -> Point {
        let mut point = [0.0; AXES];
        for (p, axis) in point.iter_mut().zip(self.map) {
            *p = axis.and_then(|i| axes.get(i)).map_or(0.0, Axis::set_position);
        }
        point
    }

    /// CNC_LoadProgram: the file of this name. Returns the number of the request, which becomes the number of the program.
    #[doc(alias = "CNC_LoadProgram")]
    pub fn load(&mut self, name: &[u8], axes: &[Axis]) -> Result<u32, Code> {
        if self.state.is_active() || matches!(self.load, Load::Pending(_)) {
            return Err(Code::ChannelState);
        }
        let mut bytes = [0; NAME_BYTES];
        let n = name.iter().position(|&b| b == 0).unwrap_or(name.len()).min(NAME_BYTES - 1);
        bytes[..n].copy_from_slice(&name[..n]);
        let request = self.requests.wrapping_add(1).max(1);
        let command = Command::Load { request, name: bytes, start: self.start_point(axes) };
        self.link.commands.push(command).map_err(|_| Code::QueueFull)?;
        self.requests = request;
        self.load = Load::Pending(request);
        Ok(request)
    }

    /// What became of a request to load, and the number of lines.
    pub fn load_outcome(&self, request: u32) -> (Outcome, u32) {
        match self.load {
            Load::Pending(r) if r == request => (Outcome::Running, 0),
            Load::Done { request: r, lines } if r == request => (Outcome::Done, lines),
            Load::Failed { request: r, code } if r == request => (Outcome::Error(code), 0),
            _ => (Outcome::Aborted, 0),
        }
    }

    /// CNC_Run: the loaded program, whose number must be `program` unless that is 0.
    pub fn run(&mut self, program: u32, start_line: u32, raw: bool, axes: &mut [Axis]) -> Result<CommandId, Code> {
        if self.program_id == 0 || (program != 0 && program != self.program_id) {
            return Err(Code::ProgramNotLoaded);
        }
        self.refresh(axes);
        if self.state != CncState::Ready || self.joined {
            return Err(Code::ChannelState);
        }
        let how = self.how(start_line, raw);
        self.launch(axes, |run, start| Command::Run { run, start, how })?;
        self.typed = false;
        Ok(self.command)
    }

    /// Takes the axes for a run, if they are ready for it.
    pub(super) fn launch(&mut self, axes: &mut [Axis], command: impl FnOnce(u32, Point) -> Command) -> Result<(), Code> {
        if self.axes(axes).any(|a| a.state() != AxisState::Standstill) {
            return Err(Code::WrongState);
        }
        if self.config.require_homed && self.axes(axes).any(|a| !a.is_homed()) {
            return Err(Code::NotHomed);
        }
        let start = self.start_point(axes);
        let run = self.run.wrapping_add(1);
        self.link.commands.push(command(run, start)).map_err(|_| Code::QueueFull)?;
        self.run = run;
        self.begin(start, axes);
        Ok(())
    }

    fn begin(&mut self, start: Point, axes: &mut [Axis]) {
        self.executor.reset(start);
        if let Some(p) = &mut self.pulses {
            p.reset(start);
        }
        for axis in self.map.iter().flatten() {
            if let Some(axis) = axes.get_mut(*axis) {
                axis.join();
            }
        }
        self.joined = true;
        self.started = self.modes;
        (self.step, self.kept_back) = (false, false);
        self.hold = false;
        self.error = None;
        self.fault_id = 0;
        self.mark = Default::default();
        self.event(CncEvent::Run);
        self.command = self.history.number();
    }

    /// What became of a run.
    pub fn outcome(&self, id: CommandId) -> Outcome {
        match self.history.outcome(id, self.command) {
            // The block ends when the axes are free again.
            Outcome::Done if self.joined && id == self.command => Outcome::Running,
            outcome => outcome,
        }
    }

    /// True if the program is being worked on, not held.
    pub fn is_working(&self) -> bool {
        matches!(self.state, CncState::Running | CncState::Holding | CncState::AuxWait)
    }

    /// CNC_Hold.
    pub fn hold(&mut self) -> Result<(), Code> {
        if !self.event(CncEvent::Hold) {
            return Err(Code::ChannelState);
        }
        self.hold = true;
        Ok(())
    }

    /// A hold has come to rest.
    pub fn is_held(&self) -> bool {
        self.state == CncState::Held || (self.state == CncState::AuxWait && self.hold)
    }

    /// CNC_Resume.
    pub fn resume(&mut self) -> Result<(), Code> {
        let between = matches!(self.state, CncState::StepStop | CncState::ProgStop);
        if !self.event(CncEvent::Resume) {
            return Err(Code::ChannelState);
        }
        self.hold = false;
        self.stop_code = None;
        if between {
            self.executor.go_on();
        }
        Ok(())
    }

    /// CNC_Abort: stops on the path. Nothing to abort is no error.
    pub fn abort(&mut self) {
        self.abort_run();
    }

    /// An abort is still braking.
    pub fn is_aborting(&self) -> bool {
        self.state == CncState::Aborting
    }

    /// CNC_Reset: leaves cncFault once the axes are free.
    pub fn reset(&mut self) -> Result<(), Code> {
        if self.joined || !self.event(CncEvent::Reset) {
            return Err(Code::ChannelState);
        }
        self.error = None;
        self.fault_id = 0;
        Ok(())
    }

    /// CNC_SetOverride: shares of the programmed speed, 0..=1.
    pub fn set_override(&mut self, feed: f64, rapid: f64, spindle: f64) -> Result<(), Code> {
        if !(0.0..=1.0).contains(&feed) || !(0.0..=1.0).contains(&rapid) || !(0.0..=2.0).contains(&spindle) {
            return Err(Code::ParameterOutOfRange);
        }
        (self.demand.feed, self.demand.rapid) = (feed, rapid);
        self.spindle.set_override(spindle);
        Ok(())
    }

    /// The PLC program has a CNC_AuxHandshake: codes can wait for it. Without one they are only noted.
    pub fn listen(&mut self) {
        self.listened = true;
    }

    /// CNC_AuxHandshake.Fault while the channel waits; `id` is shown by CNC_ReadError.
    pub fn aux_fault(&mut self, id: u16) {
        if self.state == CncState::AuxWait {
            self.fault_id = id;
            self.fail(ErrorNote::new(Code::AuxFault, self.mark.line, 1, Code::AuxFault.title()));
        }
    }
}
