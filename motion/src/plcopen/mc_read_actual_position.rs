//! MC_ReadActualPosition: actual position of an axis (PLCopen part 1, §3.23).
//! Runs: cyclic.

use crate::natives::{Core, Frame, rules};
use crate::{block, enable_pins};

block! {
    /// Position is the actual position while Enable is TRUE.
    "MC_ReadActualPosition", call;
    InOut Axis: "AXIS_REF";
    Input Enable: "BOOL";
    Output Valid: "BOOL";
    Output Busy: "BOOL";
    Output Error: "BOOL";
    Output ErrorID: "WORD";
    Output Position: "LREAL";
}

fn call(core: &mut Core, f: &mut Frame) {
    let target = rules::axis(core, f.reference(P::Axis));
    let axis = rules::read(f, &enable_pins!(P, Valid), target);
    f.set_lreal(P::Position, axis.map_or(0.0, |i| core.axes[i].actual_position()));
}
