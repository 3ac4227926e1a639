//! MC_Home: direct homing: the position at hand gets a number (PLCopen part 1, §3.2).
//! Runs: cyclic.

use crate::axis::orders::Order;
use crate::natives::rules::{self, Action};
use crate::natives::{Core, Frame};
use crate::{block, execute_pins};
use takt_base::Code;

block! {
    /// Position becomes the coordinate of the place where the axis stands.
    "MC_Home", call;
    InOut Axis: "AXIS_REF";
    Input Execute: "BOOL";
    Input Position: "LREAL";
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
    super::supported(f.i16(P::BufferMode), 0.0, false)?;
    let order = Order::Home(f.lreal(P::Position));
    super::order(core, axis, order, f.i16(P::BufferMode))
}
