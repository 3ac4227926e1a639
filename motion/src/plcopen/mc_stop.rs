//! MC_Stop: stop that refuses everything else (PLCopen part 1, §3.3; S11).
//! Runs: cyclic.

use crate::axis::CommandId;
use crate::natives::rules::{self, Action};
use crate::natives::{Core, Frame};
use crate::{block, execute_pins};
use takt_base::Code;

block! {
    /// Brakes the axis and keeps it in Stopping while Execute is TRUE.
    "MC_Stop", call;
    InOut Axis: "AXIS_REF";
    Input Execute: "BOOL";
    Input Deceleration: "LREAL";
    Input Jerk: "LREAL";
    Output Done: "BOOL";
    Output Busy: "BOOL";
    Output CommandAborted: "BOOL";
    Output Error: "BOOL";
    Output ErrorID: "WORD";
    Private Previous: "BOOL";
    Private Command: "UDINT";
    Private Reference: "UINT";
}

fn call(core: &mut Core, f: &mut Frame) {
    let axis = rules::execute_axis(
        core,
        f,
        &execute_pins!(P, rules::ABSENT, P::CommandAborted as usize),
        P::Axis,
        &Action { start, poll: super::poll },
    );
    if let Some(axis) = axis {
        core.axes[axis].hold_stop(CommandId(f.u32(P::Command)), f.bool(P::Execute));
    }
}

fn start(core: &mut Core, f: &mut Frame, axis: usize) -> Result<u32, Code> {
    super::supported(super::ABORTING, f.lreal(P::Jerk), false)?;
    core.axes[axis].stop(f.lreal(P::Deceleration)).map(|id| id.0)
}
