//! MC_MoveRelative: moves an axis by a distance (PLCopen part 1, §3.6).
//! Runs: cyclic.

use crate::axis::orders::Order;
use crate::natives::rules::{self, Action};
use crate::natives::{Core, Frame};
use crate::{block, execute_pins};
use takt_base::Code;

block! {
    /// Moves the axis by Distance from its set position.
    "MC_MoveRelative", call;
    InOut Axis: "AXIS_REF";
    Input Execute: "BOOL";
    Input ContinuousUpdate: "BOOL";
    Input Distance: "LREAL";
    Input Velocity: "LREAL";
    Input Acceleration: "LREAL";
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
    super::supported(f.i16(P::BufferMode), f.lreal(P::Jerk), f.bool(P::ContinuousUpdate))?;
    let order = Order::Relative(f.lreal(P::Distance), super::wanted(f, P::Velocity, P::Acceleration, P::Deceleration));
    super::order(core, axis, order, f.i16(P::BufferMode))
}
