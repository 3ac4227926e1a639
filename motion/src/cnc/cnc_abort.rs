//! CNC_Abort: ends a program with a stop on the path (N8).
//! Runs: cyclic.

use crate::axis::Outcome;
use crate::natives::rules::{self, Action, Progress};
use crate::natives::{Core, Frame};
use crate::{block, execute_pins};
use takt_base::Code;

block! {
    /// Strobes fall, the rest of the program is dropped. Without a program it does nothing.
    "CNC_Abort", call;
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
    core.channels[channel].abort();
    Ok(0)
}

fn progress(core: &mut Core, channel: usize, _: u32) -> Progress {
    let busy = core.channels[channel].is_aborting();
    Progress::of(if busy { Outcome::Running } else { Outcome::Done })
}
