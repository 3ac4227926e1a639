//! MC_ReadAxisError: why an axis is in ErrorStop (PLCopen part 1, §3.22).
//! Runs: cyclic.

use crate::natives::{Core, Frame, rules};
use crate::{block, enable_pins};

block! {
    /// AxisErrorID is the error of the axis; 0: none.
    "MC_ReadAxisError", call;
    InOut Axis: "AXIS_REF";
    Input Enable: "BOOL";
    Output Valid: "BOOL";
    Output Busy: "BOOL";
    Output Error: "BOOL";
    Output ErrorID: "WORD";
    Output AxisErrorID: "WORD";
}

fn call(core: &mut Core, f: &mut Frame) {
    let target = rules::axis(core, f.reference(P::Axis));
    let axis = rules::read(f, &enable_pins!(P, Valid), target);
    let error = axis.and_then(|i| core.axes[i].error());
    f.set_u16(P::AxisErrorID, error.map_or(0, takt_base::Code::error_id));
}
