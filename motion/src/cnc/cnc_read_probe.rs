//! CNC_ReadProbe: the last probing of a channel.
//! Runs: cyclic.

use crate::natives::{Core, Frame, rules};
use crate::{block, enable_pins};

block! {
    /// Result is the machine position X Y Z A B C at the edge of the probe, or at the end of the move. Seq counts probings.
    "CNC_ReadProbe", call;
    InOut Cnc: "CNC_REF";
    Input Enable: "BOOL";
    Output Valid: "BOOL";
    Output Busy: "BOOL";
    Output Error: "BOOL";
    Output ErrorID: "WORD";
    Output Tripped: "BOOL";
    Output Result: "ARRAY[0..8] OF LREAL";
    Output InputState: "BOOL";
    Output Seq: "UDINT";
}

fn call(core: &mut Core, f: &mut Frame) {
    let target = rules::channel(core, f.reference(P::Cnc));
    let Some(i) = rules::read(f, &enable_pins!(P, Valid), target) else { return };
    let channel = &core.channels[i];
    let probe = channel.probe_result();
    f.set_bool(P::Tripped, probe.tripped);
    for (n, value) in (0..).zip(&probe.position) {
        f.set_lreal_at(P::Result, n, *value);
    }
    f.set_bool(P::InputState, channel.io.probe);
    f.set_u32(P::Seq, probe.seq);
}
