//! MC_Halt: controlled stop in normal operation (PLCopen part 1, §3.4).
//! Runs: cyclic.

use crate::axis::orders::{Order, Wanted};
use crate::natives::rules::{self, Action};
use crate::natives::{Core, Frame};
use crate::{block, execute_pins};
use takt_base::Code;

block! {
    /// Brakes the axis; another motion command may take over.
    "MC_Halt", call;
    InOut Axis: "AXIS_REF";
    Input Execute: "BOOL";
    Input Deceleration: "LREAL";
    Input Jerk: "LREAL";
    Input BufferMode: "MC_BUFFER_MODE";
    Output Done: "BOOL";
    Output Busy: "BOOL";
    Output Active: "BOOL";
    Output CommandAborted: "BOOL";
    Output Error: "BOOL";
    Output ErrorID: "WORD";
    Private Previous: "BOOL";
    Private Command: "UDINT";
    Private Reference: "UINT";
}

fn call(core: &mut Core, f: &mut Frame) {
    rules::execute_axis(core, f, &execute_pins!(P motion), P::Axis, &Action { start, poll: super::poll });
}

fn start(core: &mut Core, f: &mut Frame, axis: usize) -> Result<u32, Code> {
    super::supported(f.i16(P::BufferMode), f.lreal(P::Jerk), false)?;
    let order = Order::Halt(Wanted { d: f.lreal(P::Deceleration), ..Wanted::default() });
    super::order(core, axis, order, f.i16(P::BufferMode))
}
