//! CNC_Panel: an operator panel, for programs that want levels and buttons instead of Execute.
//! Runs: cyclic. From: R1-39, R1-85..R1-87, R2-115..R2-117.

use crate::channel::modes::{Modes, Panel};
use crate::channel::{Channel, CncState};
use crate::natives::{Core, Frame, rules};
use crate::{block, enable_pins};

block! {
    /// DryRun, MachineLock, AxisLock (bit 0 is X) and BlockSkip are taken over when a program starts; the other switches count at once. FeedHold beats
    /// CycleStart, which starts the loaded program or goes on with it. Error tells how the last button was refused.
    "CNC_Panel", call;
    InOut Cnc: "CNC_REF";
    Input Enable: "BOOL";
    Input CycleStart: "BOOL";
    Input FeedHold: "BOOL";
    Input SingleBlock: "BOOL";
    Input OptionalStop: "BOOL";
    Input DryRun: "BOOL";
    Input MachineLock: "BOOL";
    Input AxisLock: "WORD";
    Input AuxLock: "BOOL";
    Input BlockSkip: "BOOL";
    Input ReadInDisable: "BOOL";
    Input FeedDisable: "BOOL";
    Input ResetBtn: "BOOL";
    Output Valid: "BOOL";
    Output Busy: "BOOL";
    Output Error: "BOOL";
    Output ErrorID: "WORD";
    Output State: "CNC_STATE";
    Output CanStart: "BOOL";
    Output StartLamp: "BOOL";
    Output HoldLamp: "BOOL";
}

fn call(core: &mut Core, f: &mut Frame) {
    let target = rules::channel(core, f.reference(P::Cnc));
    let on = f.bool(P::Enable);
    let result = target.and_then(|i| {
        let Core { axes, channels } = core;
        if on { channels[i].panel(&buttons(f), axes) } else { Ok(()) }
    });
    rules::enable(f, &enable_pins!(P, Valid), result);
    if let Ok(i) = target {
        show(&core.channels[i], f);
    }
}

fn buttons(f: &Frame) -> Panel {
    Panel {
        modes: Modes {
            single_block: f.bool(P::SingleBlock),
            optional_stop: f.bool(P::OptionalStop),
            dry_run: f.bool(P::DryRun),
            machine_lock: f.bool(P::MachineLock),
            axis_lock: f.u16(P::AxisLock),
            aux_lock: f.bool(P::AuxLock),
            block_skip: f.bool(P::BlockSkip),
            read_in_disable: f.bool(P::ReadInDisable),
            feed_disable: f.bool(P::FeedDisable),
        },
        cycle_start: f.bool(P::CycleStart),
        feed_hold: f.bool(P::FeedHold),
        reset: f.bool(P::ResetBtn),
    }
}

fn show(channel: &Channel, f: &mut Frame) {
    f.set_i16(P::State, channel.state() as i16);
    f.set_bool(P::CanStart, channel.can_start());
    f.set_bool(P::StartLamp, channel.is_working());
    f.set_bool(P::HoldLamp, matches!(channel.state(), CncState::Holding | CncState::Held) || channel.is_held());
}
