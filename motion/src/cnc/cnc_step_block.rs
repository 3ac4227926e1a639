//! CNC_StepBlock: one block of a program that stands between two (N3, N6).
//! Runs: cyclic.

use crate::axis::Outcome;
use crate::channel::CncState;
use crate::natives::rules::{self, Action, Progress};
use crate::natives::{Core, Frame};
use crate::{block, execute_pins};
use takt_base::Code;

block! {
    /// From cncStepStop, cncProgStop and cncHeld. Done when the block has ended: cncStepStop, or the end of the program.
    "CNC_StepBlock", call;
    InOut Cnc: "CNC_REF";
    Input Execute: "BOOL";
    Output Done: "BOOL";
    Output Busy: "BOOL";
    Output Error: "BOOL";
    Output ErrorID: "WORD";
    Private Previous: "BOOL";
    Private Command: "UDINT";
    Private Reference: "UINT";
}

fn call(core: &mut Core, f: &mut Frame) {
    rules::execute_channel(core, f, &execute_pins!(P), P::Cnc, &Action { start, poll: progress });
}

fn start(core: &mut Core, _: &mut Frame, channel: usize) -> Result<u32, Code> {
    core.channels[channel].step_block().map(|()| 0)
}

fn progress(core: &mut Core, channel: usize, _: u32) -> Progress {
    let channel = &core.channels[channel];
    let outcome = match channel.state() {
        _ if channel.is_stepping() => Outcome::Running,
        CncState::StepStop | CncState::ProgStop | CncState::Ready | CncState::Held => Outcome::Done,
        _ => Outcome::Error(Code::ChannelState),
    };
    Progress::of(outcome)
}
