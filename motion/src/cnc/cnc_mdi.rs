//! CNC_MDI: one block of g-code from the PLC program.
//! Runs: cyclic.

use crate::natives::rules::{self, Action};
use crate::natives::{Core, Frame};
use crate::{block, execute_pins};
use takt_base::Code;

block! {
    /// From cncReady or cncIdle. Modes that the block sets stay for the next one; CNC_Run starts with those of the configuration.
    "CNC_MDI", call;
    InOut Cnc: "CNC_REF";
    Input Execute: "BOOL";
    Input Block: "STRING[255]";
    Output Done: "BOOL";
    Output Busy: "BOOL";
    Output Active: "BOOL";
    Output CommandAborted: "BOOL";
    Output Error: "BOOL";
    Output ErrorID: "WORD";
    Private Previous: "BOOL";
    Private Command: "UDINT";
    Private Reference: "UINT";
}

fn call(core: &mut Core, f: &mut Frame) {
    rules::execute_channel(core, f, &execute_pins!(P motion), P::Cnc, &Action { start, poll: rules::run_of_channel });
}

fn start(core: &mut Core, f: &mut Frame, channel: usize) -> Result<u32, Code> {
    let Core { axes, channels } = core;
    channels[channel].typed_block(f.string(P::Block, 255), axes).map(|id| id.0)
}
