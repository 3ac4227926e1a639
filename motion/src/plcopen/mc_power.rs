//! MC_Power: power stage of an axis (PLCopen part 1, §3.1; S07).
//! Runs: cyclic. One instance per axis.

use crate::block;
use crate::natives::{Core, Frame, rules};
use takt_base::Code;

block! {
    /// Switches the power stage. Status is the real state of the stage.
    "MC_Power", call;
    InOut Axis: "AXIS_REF";
    Input Enable: "BOOL";
    Input EnablePositive: "BOOL" = "TRUE";
    Input EnableNegative: "BOOL" = "TRUE";
    Output Status: "BOOL";
    Output Valid: "BOOL";
    Output Error: "BOOL";
    Output ErrorID: "WORD";
}

fn call(core: &mut Core, f: &mut Frame) {
    let result = rules::axis(core, f.reference(P::Axis)).and_then(|i| {
        let axis = &mut core.axes[i];
        let (enable, positive, negative) = (f.bool(P::Enable), f.bool(P::EnablePositive), f.bool(P::EnableNegative));
        let owned = axis.set_power(f.instance(), enable, positive, negative);
        f.set_bool(P::Status, axis.has_power());
        f.set_bool(P::Valid, owned && enable);
        if owned { Ok(()) } else { Err(Code::WrongState) }
    });
    f.set_bool(P::Error, result.is_err());
    f.set_u16(P::ErrorID, result.err().map_or(0, Code::error_id));
}
