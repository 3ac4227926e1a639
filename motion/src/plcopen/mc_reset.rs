//! MC_Reset: leaves ErrorStop (PLCopen part 1, §3.20).
//! Runs: cyclic.

use crate::natives::rules::{self, Action};
use crate::natives::{Core, Frame};
use crate::{block, execute_pins};
use takt_base::Code;

block! {
    /// Clears an axis error whose cause is gone. Without an error it does nothing.
    "MC_Reset", call;
    InOut Axis: "AXIS_REF";
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
    rules::execute_axis(core, f, &execute_pins!(P), P::Axis, &Action { start, poll: rules::at_once });
}

fn start(core: &mut Core, _: &mut Frame, axis: usize) -> Result<u32, Code> {
    core.axes[axis].reset().map(|()| 0)
}
