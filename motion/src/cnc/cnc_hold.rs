//! CNC_Hold: stops on the path (N4).
//! Runs: cyclic.

use crate::axis::Outcome;
use crate::channel::CncState;
use crate::natives::rules::{self, Action, Progress};
use crate::natives::{Core, Frame};
use crate::{block, execute_pins};
use takt_base::Code;

block! {
    /// Done when the path stands. CNC_Resume goes on at the same place.
    "CNC_Hold", call;
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
    core.channels[channel].hold().map(|()| 0)
}

fn progress(core: &mut Core, channel: usize, _: u32) -> Progress {
    let channel = &core.channels[channel];
    let outcome = match channel.state() {
        _ if channel.is_held() => Outcome::Done,
        CncState::Holding => Outcome::Running,
        // The program ended, or somebody else resumed or aborted it.
        _ => Outcome::Error(Code::ChannelState),
    };
    Progress::of(outcome)
}
