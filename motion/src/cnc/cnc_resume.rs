//! CNC_Resume: goes on after a hold or a program stop (N3).
//! Runs: cyclic.

use crate::natives::rules::{self, Action};
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
    rules::execute_channel(core, f, &execute_pins!(P), P::Cnc, &Action { start, poll: rules::at_once });
}

fn start(core: &mut Core, _: &mut Frame, channel: usize) -> Result<u32, Code> {
    core.channels[channel].resume().map(|()| 0)
}
