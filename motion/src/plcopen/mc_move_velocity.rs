//! MC_MoveVelocity: endless motion (PLCopen part 1, §3.11; S03, S13, S19).
//! Runs: cyclic. InVelocity takes the place of Done (R10).

use crate::axis::CommandId;
use crate::axis::orders::Order;
use crate::natives::rules::{self, Action};
use crate::natives::{Core, Frame};
use crate::{block, execute_pins};
use takt_base::Code;

block! {
    /// Moves the axis at Velocity until another command takes over. The sign is that of Velocity times that of Direction.
    "MC_MoveVelocity", call;
    InOut Axis: "AXIS_REF";
    Input Execute: "BOOL";
    Input ContinuousUpdate: "BOOL";
    Input Velocity: "LREAL";
    Input Acceleration: "LREAL";
    Input Deceleration: "LREAL";
    Input Jerk: "LREAL";
    Input Direction: "MC_DIRECTION" = "mcPositiveDirection";
    Input BufferMode: "MC_BUFFER_MODE";
    Output InVelocity: "BOOL";
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
    let pins = execute_pins!(P continuous);
    let axis = rules::execute_axis(core, f, &pins, P::Axis, &Action { start, poll: super::poll });
    let busy = f.bool(P::Busy) && f.bool(P::Active);
    let there = axis.is_some_and(|axis| core.axes[axis].is_in_velocity(CommandId(f.u32(P::Command))));
    f.set_bool(P::InVelocity, busy && there);
}

fn start(core: &mut Core, f: &mut Frame, axis: usize) -> Result<u32, Code> {
    super::supported(f.i16(P::BufferMode), f.lreal(P::Jerk), f.bool(P::ContinuousUpdate))?;
    let sign = match f.i16(P::Direction) {
        POSITIVE => 1.0,
        NEGATIVE => -1.0,
        CURRENT if core.axes[axis].set_velocity() < 0.0 => -1.0,
        CURRENT => 1.0,
        // The shortest way to nowhere.
        _ => return Err(Code::ParameterOutOfRange),
    };
    let wanted = super::wanted(f, P::Velocity, P::Acceleration, P::Deceleration);
    super::order(core, axis, Order::Velocity(sign * wanted.v, wanted), f.i16(P::BufferMode))
}

/// MC_DIRECTION.
const POSITIVE: i16 = 1;
const NEGATIVE: i16 = 3;
const CURRENT: i16 = 4;
