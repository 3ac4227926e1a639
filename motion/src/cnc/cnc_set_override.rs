//! CNC_SetOverride: shares of the programmed speed (S40 c).
//! Runs: cyclic. On FALSE the last values stay.

use crate::natives::{Core, Frame, rules};
use crate::{block, enable_pins};

block! {
    /// Feed and Rapid from 0.0 to 1.0, Spindle from 0.0 to 2.0. 0.0 stops on the path; the state stays cncRunning.
    "CNC_SetOverride", call;
    InOut Cnc: "CNC_REF";
    Input Enable: "BOOL";
    Input Feed: "LREAL" = "1.0";
    Input Rapid: "LREAL" = "1.0";
    Input Spindle: "LREAL" = "1.0";
    Output Enabled: "BOOL";
    Output Busy: "BOOL";
    Output Error: "BOOL";
    Output ErrorID: "WORD";
}

fn call(core: &mut Core, f: &mut Frame) {
    let result = rules::channel(core, f.reference(P::Cnc)).and_then(|i| {
        if f.bool(P::Enable) {
            core.channels[i].set_override(f.lreal(P::Feed), f.lreal(P::Rapid), f.lreal(P::Spindle))
        } else {
            Ok(())
        }
    });
    rules::enable(f, &enable_pins!(P, Enabled), result);
}
