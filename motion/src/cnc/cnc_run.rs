//! CNC_Run: runs the loaded part program (N3, N9).
//! Runs: cyclic.

use crate::natives::rules::{self, Action};
use crate::natives::{Core, Frame};
use crate::{block, execute_pins};
use takt_base::Code;

block! {
    /// Cycle start from cncReady. StartLine: motion starts at this line of the main program; what stands before it is read
    /// without moving (cncLineModal) or not read at all (cncLineRaw). ProgramID 0: whatever is loaded. Done at M2, M30 or the end of the file.
    "CNC_Run", call;
    InOut Cnc: "CNC_REF";
    Input Execute: "BOOL";
    Input ProgramID: "UDINT";
    Input StartLine: "UDINT";
    Input StartMode: "CNC_START_MODE" = "cncLineModal";
    Output Done: "BOOL";
    Output Busy: "BOOL";
    Output Active: "BOOL";
    Output CommandAborted: "BOOL";
    Output Error: "BOOL";
    Output ErrorID: "WORD";
    Output Line: "UDINT";
    Private Previous: "BOOL";
    Private Command: "UDINT";
    Private Reference: "UINT";
}

/// cncTop and cncLineRaw.
const START_TOP: i16 = 0;
const START_RAW: i16 = 2;

fn call(core: &mut Core, f: &mut Frame) {
    let channel =
        rules::execute_channel(core, f, &execute_pins!(P motion), P::Cnc, &Action { start, poll: rules::run_of_channel });
    if f.bool(P::Busy)
        && let Some(channel) = channel
    {
        f.set_u32(P::Line, core.channels[channel].mark().line);
    }
}

fn start(core: &mut Core, f: &mut Frame, channel: usize) -> Result<u32, Code> {
    let Core { axes, channels } = core;
    let mode = f.i16(P::StartMode);
    let line = if mode == START_TOP { 0 } else { f.u32(P::StartLine) };
    channels[channel].run(f.u32(P::ProgramID), line, mode == START_RAW, axes).map(|id| id.0)
}
