//! Blocks that are typed in (CNC_MDI), subroutines that the PLC program calls (CNC_CallSub), and looking through a program
//! (CNC_CheckProgram).
//! Runs: cyclic. A block or a subroutine runs like a program, with the modes that the one before has left.

use super::{Channel, CncState};
use crate::axis::{Axis, CommandId, Outcome};
use crate::feeder::check::Found;
use crate::feeder::{ARGS, Command, Event, NAME_BYTES};
use crate::segment::ErrorNote;
use takt_base::Code;

/// A request to look through the program, and its end.
#[derive(Clone, Copy, PartialEq, Debug)]
#[allow(clippy::large_enum_variant)] // one a channel
pub enum Check {
    /// None.
    Idle,
    /// Number of the request.
    Pending(u32),
    /// Number, error, measures.
    Done(u32, Option<ErrorNote>, Found),
}

impl Channel {
    /// CNC_MDI: runs one block.
    pub fn typed_block(&mut self, block: &[u8], axes: &mut [Axis]) -> Result<CommandId, Code> {
        let (text, how) = (name_of(block), self.how(0, false));
        self.run_typed(axes, |run, start| Command::Block { run, start, text, how })
    }

    /// CNC_CallSub: runs the subroutine of this name.
    pub fn call_sub(&mut self, name: &[u8], args: [f64; ARGS], count: u8, axes: &mut [Axis]) -> Result<CommandId, Code> {
        let word = |b: &u8| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'-' | b'.');
        if name.is_empty() || !name.iter().all(word) || usize::from(count) > ARGS || args.iter().any(|a| !a.is_finite()) {
            return Err(Code::ParameterOutOfRange);
        }
        let (name, how) = (name_of(name), self.how(0, false));
        self.run_typed(axes, |run, start| Command::Call { run, start, name, args, count, how })
    }

    fn run_typed(
        &mut self,
        axes: &mut [Axis],
        command: impl FnOnce(u32, crate::geometry::Point) -> Command,
    ) -> Result<CommandId, Code> {
        self.refresh(axes);
        if !matches!(self.state, CncState::Idle | CncState::Ready) || self.joined {
            return Err(Code::ChannelState);
        }
        self.launch(axes, command)?;
        self.typed = true;
        self.returned = 0.0;
        Ok(self.command)
    }

    /// Value that the last subroutine has returned.
    pub fn returned(&self) -> f64 {
        self.returned
    }

    /// CNC_CheckProgram: looks through the loaded program. Returns the number of the request.
    pub fn check_program(&mut self, program: u32, limits: bool, axes: &[Axis]) -> Result<u32, Code> {
        if self.program_id == 0 || (program != 0 && program != self.program_id) {
            return Err(Code::ProgramNotLoaded);
        }
        if self.state.is_active() || matches!(self.check, Check::Pending(_)) {
            return Err(Code::ChannelState);
        }
        let request = self.requests.wrapping_add(1).max(1);
        let command = Command::Check { request, start: self.start_point(axes), limits };
        self.link.commands.push(command).map_err(|_| Code::QueueFull)?;
        self.requests = request;
        self.check = Check::Pending(request);
        Ok(request)
    }

    /// What became of it. A program with an error is an outcome like any other: see [`Channel::checked`].
    pub fn check_outcome(&self, request: u32) -> Outcome {
        match self.check {
            Check::Pending(r) if r == request => Outcome::Running,
            Check::Done(r, None, _) if r == request => Outcome::Done,
            Check::Done(r, Some(_), _) if r == request => Outcome::Error(Code::ProgramError),
            _ => Outcome::Aborted,
        }
    }

    /// Error and measures of the last check.
    pub fn checked(&self) -> Option<(&Option<ErrorNote>, &Found)> {
        match &self.check {
            Check::Done(_, note, found) => Some((note, found)),
            _ => None,
        }
    }

    pub(super) fn take_typed(&mut self, event: &Event) {
        match event {
            Event::Checked { request, note, found } if self.check == Check::Pending(*request) => {
                self.check = Check::Done(*request, *note, *found);
            }
            Event::Returned { run, value } if *run == self.run => self.returned = *value,
            _ => {}
        }
    }
}

/// A text for a command: cut before its last byte, ended by zero.
fn name_of(text: &[u8]) -> [u8; NAME_BYTES] {
    let mut bytes = [0; NAME_BYTES];
    let n = text.iter().position(|&b| b == 0).unwrap_or(text.len()).min(NAME_BYTES - 1);
    bytes[..n].copy_from_slice(&text[..n]);
    bytes
}
