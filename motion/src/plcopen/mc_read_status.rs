//! MC_ReadStatus: state of an axis (PLCopen part 1, §3.21).
//! Runs: cyclic.

use crate::axis::AxisState;
use crate::natives::{Core, Frame, rules};
use crate::{block, enable_pins};

block! {
    /// Exactly one state output is TRUE while Valid.
    "MC_ReadStatus", call;
    InOut Axis: "AXIS_REF";
    Input Enable: "BOOL";
    Output Valid: "BOOL";
    Output Busy: "BOOL";
    Output Error: "BOOL";
    Output ErrorID: "WORD";
    Output ErrorStop: "BOOL";
    Output Disabled: "BOOL";
    Output Stopping: "BOOL";
    Output Homing: "BOOL";
    Output Standstill: "BOOL";
    Output DiscreteMotion: "BOOL";
    Output ContinuousMotion: "BOOL";
    Output SynchronizedMotion: "BOOL";
}

fn call(core: &mut Core, f: &mut Frame) {
    let target = rules::axis(core, f.reference(P::Axis));
    let axis = rules::read(f, &enable_pins!(P, Valid), target);
    let state = axis.map(|i| core.axes[i].state());
    for (pin, of) in [
        (P::ErrorStop, AxisState::ErrorStop),
        (P::Disabled, AxisState::Disabled),
        (P::Stopping, AxisState::Stopping),
        (P::Homing, AxisState::Homing),
        (P::Standstill, AxisState::Standstill),
        (P::DiscreteMotion, AxisState::DiscreteMotion),
        (P::ContinuousMotion, AxisState::ContinuousMotion),
        (P::SynchronizedMotion, AxisState::SynchronizedMotion),
    ] {
        f.set_bool(pin, state == Some(of));
    }
}
