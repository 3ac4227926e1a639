//! CNC_LoadProgram: loads a part program (N2).
//! Runs: cyclic.

use crate::natives::rules::{self, Action, Progress};
use crate::natives::{Core, Frame};
use crate::{block, execute_pins};
use takt_base::Code;

block! {
    /// Reads and checks the file. Done: ProgramID names it.
    "CNC_LoadProgram", call;
    InOut Cnc: "CNC_REF";
    Input Execute: "BOOL";
    Input FileName: "STRING[255]";
    Output Done: "BOOL";
    Output Busy: "BOOL";
    Output Error: "BOOL";
    Output ErrorID: "WORD";
    Output ProgramID: "UDINT";
    Output LineCount: "UDINT";
    Private Previous: "BOOL";
    Private Command: "UDINT";
    Private Reference: "UINT";
}

fn call(core: &mut Core, f: &mut Frame) {
    let channel = rules::execute_channel(
        core,
        f,
        &execute_pins!(P),
        P::Cnc,
        &Action { start, poll: |core, channel, request| Progress::of(core.channels[channel].load_outcome(request).0) },
    );
    if f.bool(P::Done)
        && let Some(channel) = channel
    {
        let request = f.u32(P::Command);
        if core.channels[channel].program_id() == request {
            f.set_u32(P::ProgramID, request);
            f.set_u32(P::LineCount, core.channels[channel].load_outcome(request).1);
        }
    }
}

fn start(core: &mut Core, f: &mut Frame, channel: usize) -> Result<u32, Code> {
    f.set_u32(P::ProgramID, 0);
    f.set_u32(P::LineCount, 0);
    let Core { axes, channels } = core;
    channels[channel].load(f.string(P::FileName, 255), axes)
}
