//! CNC_CallSub: one subroutine of g-code from the PLC program.
//! Runs: cyclic.

use crate::feeder::ARGS;
use crate::natives::rules::{self, Action};
use crate::natives::{Core, Frame};
use crate::{block, execute_pins};
use takt_base::Code;

block! {
    /// `o<Name> call [Args[1]] [Args[2]] ..`, ArgCount of them. The subroutine stands in the file Name.ngc in a folder of `subs`.
    /// Result is the value of its `return` or `endsub`, 0 without one.
    "CNC_CallSub", call;
    InOut Cnc: "CNC_REF";
    Input Execute: "BOOL";
    Input Name: "STRING[80]";
    Input Args: "ARRAY[1..30] OF LREAL";
    Input ArgCount: "UINT";
    Output Done: "BOOL";
    Output Busy: "BOOL";
    Output Active: "BOOL";
    Output CommandAborted: "BOOL";
    Output Error: "BOOL";
    Output ErrorID: "WORD";
    Output Result: "LREAL";
    Private Previous: "BOOL";
    Private Command: "UDINT";
    Private Reference: "UINT";
}

fn call(core: &mut Core, f: &mut Frame) {
    let channel =
        rules::execute_channel(core, f, &execute_pins!(P motion), P::Cnc, &Action { start, poll: rules::run_of_channel });
    if f.bool(P::Done)
        && let Some(channel) = channel
    {
        f.set_lreal(P::Result, core.channels[channel].returned());
    }
}

fn start(core: &mut Core, f: &mut Frame, channel: usize) -> Result<u32, Code> {
    f.set_lreal(P::Result, 0.0);
    let Core { axes, channels } = core;
    let count = u8::try_from(f.u16(P::ArgCount)).map_err(|_| Code::ParameterOutOfRange)?;
    let mut args = [0.0; ARGS];
    for (i, arg) in (0..u32::from(count)).zip(&mut args) {
        *arg = f.lreal_at(P::Args, i);
    }
    channels[channel].call_sub(f.string(P::Name, 80), args, count, axes).map(|id| id.0)
}
