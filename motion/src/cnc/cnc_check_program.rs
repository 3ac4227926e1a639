//! CNC_CheckProgram: looks through the loaded program; nothing moves.
//! Runs: cyclic.

use crate::natives::rules::{self, Action, Progress};
use crate::natives::{Core, Frame};
use crate::{block, execute_pins};
use takt_base::{Code, Nanos};

block! {
    /// Done: the program has no error; EstimatedTime is its time without waiting, BoundMin and BoundMax are machine coordinates
    /// X Y Z A B C. Error: ErrorLine, ErrorColumn and Message tell. CheckLimits: leaving the travel is an error too.
    "CNC_CheckProgram", call;
    InOut Cnc: "CNC_REF";
    Input Execute: "BOOL";
    Input ProgramID: "UDINT";
    Input CheckLimits: "BOOL" = "TRUE";
    Output Done: "BOOL";
    Output Busy: "BOOL";
    Output Error: "BOOL";
    Output ErrorID: "WORD";
    Output ErrorLine: "UDINT";
    Output ErrorColumn: "UDINT";
    Output Message: "STRING[120]";
    Output EstimatedTime: "TIME";
    Output BoundMin: "ARRAY[0..8] OF LREAL";
    Output BoundMax: "ARRAY[0..8] OF LREAL";
    Private Previous: "BOOL";
    Private Command: "UDINT";
    Private Reference: "UINT";
}

fn call(core: &mut Core, f: &mut Frame) {
    let busy = f.bool(P::Busy);
    let action = Action { start, poll: |core, channel, request| Progress::of(core.channels[channel].check_outcome(request)) };
    let channel = rules::execute_channel(core, f, &execute_pins!(P), P::Cnc, &action);
    if busy
        && !f.bool(P::Busy)
        && let Some(channel) = channel
        && let Some((note, found)) = core.channels[channel].checked()
    {
        f.set_u32(P::ErrorLine, note.map_or(0, |n| n.line));
        f.set_u32(P::ErrorColumn, note.map_or(0, |n| n.column));
        f.set_string(P::Message, 120, note.as_ref().map_or(&[][..], |n| &n.text));
        f.set_i64(P::EstimatedTime, Nanos::from_secs_round(found.time_s).0);
        for (i, (low, high)) in (0..).zip(found.min.iter().zip(&found.max)) {
            f.set_lreal_at(P::BoundMin, i, *low);
            f.set_lreal_at(P::BoundMax, i, *high);
        }
    }
}

fn start(core: &mut Core, f: &mut Frame, channel: usize) -> Result<u32, Code> {
    let Core { axes, channels } = core;
    channels[channel].check_program(f.u32(P::ProgramID), f.bool(P::CheckLimits), axes)
}
