//! CNC_ReadError: the last error of a channel, with its place.
//! Runs: cyclic.

use crate::natives::{Core, Frame, rules};
use crate::{block, enable_pins};

block! {
    /// ErrorCode is 0 without an error; an error of the part program is 16#0601 and its text says which.
    "CNC_ReadError", call;
    InOut Cnc: "CNC_REF";
    Input Enable: "BOOL";
    Output Valid: "BOOL";
    Output Busy: "BOOL";
    Output Error: "BOOL";
    Output ErrorID: "WORD";
    Output ErrorCode: "WORD";
    Output Line: "UDINT";
    Output Column: "UDINT";
    Output Text: "STRING[120]";
}

fn call(core: &mut Core, f: &mut Frame) {
    let target = rules::channel(core, f.reference(P::Cnc));
    let channel = rules::read(f, &enable_pins!(P, Valid), target);
    let note = channel.and_then(|i| core.channels[i].error());
    let code = channel.map_or(0, |i| core.channels[i].error_id());
    f.set_u16(P::ErrorCode, code);
    f.set_u32(P::Line, note.map_or(0, |n| n.line));
    f.set_u32(P::Column, note.map_or(0, |n| n.column));
    f.set_string(P::Text, 120, note.map_or(&[][..], |n| &n.text));
}
