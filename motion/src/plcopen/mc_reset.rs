//! MC_Reset: leaves ErrorStop (PLCopen part 1, §3.20).
//! Runs: cyclic.

use crate::axis::Outcome;
use crate::natives::rules::{self, Action, Progress};
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
    let number = f.reference(P::Axis);
    let target = rules::axis(core, number);
    rules::execute(core, f, &execute_pins!(P), number, target, &Action { start, poll: |_, _, _| Progress::of(Outcome::Done) });
}

fn start(core: &mut Core, f: &mut Frame, axis: usize) -> Result<u32, Code> {
    let _ = f;
    core.axes[axis].reset().map(|()| 0)
}
