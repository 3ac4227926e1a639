//! CNC_ReadStatus: state of a channel.
//! Runs: cyclic.

use crate::channel::Channel;
use crate::natives::{Core, Frame, rules};
use crate::{block, enable_pins};

block! {
    /// Status is one consistent picture of the channel.
    "CNC_ReadStatus", call;
    InOut Cnc: "CNC_REF";
    Input Enable: "BOOL";
    Output Valid: "BOOL";
    Output Busy: "BOOL";
    Output Error: "BOOL";
    Output ErrorID: "WORD";
    Output Status: "CNC_STATUS";
}

fn call(core: &mut Core, f: &mut Frame) {
    let target = rules::channel(core, f.reference(P::Cnc));
    if let Some(i) = rules::read(f, &enable_pins!(P, Valid), target) {
        show(&core.channels[i], f);
    }
}

/// In the order of [`crate::machine::declarations::CNC_STATUS`].
fn show(channel: &Channel, f: &mut Frame) {
    let mark = channel.mark();
    f.set_member(P::Status, 0, (channel.state() as i16).to_le_bytes());
    f.set_member(P::Status, 1, channel.program_id().to_le_bytes());
    f.set_member(P::Status, 2, mark.line.to_le_bytes());
    f.set_member(P::Status, 3, mark.n.to_le_bytes());
    f.set_member(P::Status, 4, channel.executor().blocks.to_le_bytes());
    f.set_member(P::Status, 5, channel.speed().to_le_bytes());
    f.set_member(P::Status, 6, channel.feed_override().to_le_bytes());
    f.set_member(P::Status, 7, channel.executor().distance_to_go().to_le_bytes());
    f.set_member(P::Status, 8, channel.feed_mm().to_le_bytes());
    f.set_member(P::Status, 9, channel.part_count().to_le_bytes());
    let position = channel.position();
    f.set_member(P::Status, 10, (60.0 * channel.spindle.commanded(&position)).to_le_bytes());
    f.set_member(P::Status, 11, (60.0 * channel.spindle.speed()).to_le_bytes());
    for (i, on) in (12..).zip(channel.modes_in_force()) {
        f.set_member(P::Status, i, [u8::from(on)]);
    }
    for (i, value) in (0..).zip(&position) {
        f.set_member_at(P::Status, 18, 8 * i, value.to_le_bytes());
    }
}
