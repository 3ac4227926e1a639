//! CNC_Reset: leaves cncFault (N10).
//! Runs: cyclic.

use crate::axis::Outcome;
use crate::natives::rules::{self, Action, Progress};
use crate::natives::{Core, Frame};
use crate::{block, execute_pins};
use takt_base::Code;

block! {
    /// Clears the error of the channel.
    "CNC_Reset", call;
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
    let number = f.reference(P::Cnc);
    let target = rules::channel(core, number);
    rules::execute(core, f, &execute_pins!(P), number, target, &Action { start, poll: |_, _, _| Progress::of(Outcome::Done) });
}

fn start(core: &mut Core, f: &mut Frame, channel: usize) -> Result<u32, Code> {
    let _ = f;
    core.channels[channel].reset().map(|()| 0)
}
