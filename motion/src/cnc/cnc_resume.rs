//! CNC_Resume: goes on after a hold or a program stop (N3).
//! Runs: cyclic.

use crate::axis::Outcome;
use crate::natives::rules::{self, Action, Progress};
use crate::natives::{Core, Frame};
use crate::{block, execute_pins};
use takt_base::Code;

block! {
    /// From cncHeld, cncHolding and cncProgStop.
    "CNC_Resume", call;
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
    core.channels[channel].resume().map(|()| 0)
}
