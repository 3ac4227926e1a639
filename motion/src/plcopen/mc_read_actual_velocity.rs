//! MC_ReadActualVelocity: actual velocity of an axis (PLCopen part 1, §3.24).
//! Runs: cyclic.

use crate::natives::{Core, Frame, rules};
use crate::{block, enable_pins};

block! {
    /// Velocity is the actual velocity while Enable is TRUE.
    "MC_ReadActualVelocity", call;
    InOut Axis: "AXIS_REF";
    Input Enable: "BOOL";
    Output Valid: "BOOL";
    Output Busy: "BOOL";
    Output Error: "BOOL";
    Output ErrorID: "WORD";
    Output Velocity: "LREAL";
}

fn call(core: &mut Core, f: &mut Frame) {
    let target = rules::axis(core, f.reference(P::Axis));
    let axis = rules::read(f, &enable_pins!(P, Valid), target);
    f.set_lreal(P::Velocity, axis.map_or(0.0, |i| core.axes[i].actual_velocity()));
}
