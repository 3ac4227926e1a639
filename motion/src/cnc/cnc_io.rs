//! CNC_Io: inputs, outputs and the probe of a channel (M52, M53, M62 .. M68, G38).
//! Runs: cyclic. Outputs change where the path is; the program sees them with its next call. On FALSE the last inputs stay.

use crate::natives::{Core, Frame, rules};
use crate::{block, enable_pins};

block! {
    /// M62 .. M65 set Out, M67 and M68 AOut; M66 waits for In or reads AIn. Probe ends G38. Feed is the share of M52, FeedHold
    /// stops the path unless M53 P0 is in force. One instance a channel.
    "CNC_Io", call;
    InOut Cnc: "CNC_REF";
    Input Enable: "BOOL";
    Input In: "ARRAY[0..63] OF BOOL";
    Input AIn: "ARRAY[0..15] OF LREAL";
    Input Probe: "BOOL";
    Input Feed: "LREAL" = "1.0";
    Input FeedHold: "BOOL";
    Output Valid: "BOOL";
    Output Busy: "BOOL";
    Output Error: "BOOL";
    Output ErrorID: "WORD";
    Output Out: "ARRAY[0..63] OF BOOL";
    Output AOut: "ARRAY[0..15] OF LREAL";
}

fn call(core: &mut Core, f: &mut Frame) {
    let target = rules::channel(core, f.reference(P::Cnc));
    let Some(i) = rules::read(f, &enable_pins!(P, Valid), target) else { return };
    let io = &mut core.channels[i].io;
    for (n, input) in (0..).zip(&mut io.inputs) {
        *input = f.bool_at(P::In, n);
    }
    for (n, input) in (0..).zip(&mut io.analog_inputs) {
        *input = f.lreal_at(P::AIn, n);
    }
    io.probe = f.bool(P::Probe);
    // Not a number is no share.
    io.adaptive = f.lreal(P::Feed).clamp(0.0, 1.0).max(0.0);
    io.feed_hold = f.bool(P::FeedHold);
    for (n, output) in (0..).zip(&io.outputs) {
        f.set_bool_at(P::Out, n, *output);
    }
    for (n, output) in (0..).zip(&io.analog_outputs) {
        f.set_lreal_at(P::AOut, n, *output);
    }
}
