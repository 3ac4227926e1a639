//! ST text that a program sees of the motion library: types, blocks, and the axes and channels of this machine as globals.

use super::config::MachineConfig;
use crate::channel::CncState;
use crate::natives::BLOCKS;
use std::fmt::Write;

/// Members of CNC_STATUS with their types.
pub const CNC_STATUS: &[(&str, &str)] = &[
    ("State", "CNC_STATE"),
    ("ProgramID", "UDINT"),
    ("Line", "UDINT"),
    ("NNumber", "UDINT"),
    ("BlockCount", "UDINT"),
    ("FeedActual", "LREAL"),
    ("FeedOverride", "LREAL"),
    ("DistanceToGo", "LREAL"),
    ("PathLength", "LREAL"),
    ("PartCount", "UDINT"),
    ("SpindleCommanded", "LREAL"),
    ("SpindleActual", "LREAL"),
    ("SingleBlock", "BOOL"),
    ("OptionalStop", "BOOL"),
    ("DryRun", "BOOL"),
    ("MachineLock", "BOOL"),
    ("AuxLock", "BOOL"),
    ("BlockSkip", "BOOL"),
    ("Position", "ARRAY[0..8] OF LREAL"),
];

const TYPES: &str = "\
// What a block moves: the number of the axis, from 1.
TYPE AXIS_REF : STRUCT
    AxisNo : UINT;
END_STRUCT;
END_TYPE

// What a CNC block acts on: the number of the channel, from 1.
TYPE CNC_REF : STRUCT
    ChannelNo : UINT;
END_STRUCT;
END_TYPE

// Where CNC_Run starts: at the top; at StartLine, with the modes of what stands before it; at StartLine as if nothing stood before it.
TYPE CNC_START_MODE : (cncTop := 0, cncLineModal := 1, cncLineRaw := 2) := cncLineModal;
END_TYPE

TYPE MC_DIRECTION : (mcPositiveDirection := 1, mcShortestWay := 2, mcNegativeDirection := 3, mcCurrentDirection := 4) := mcShortestWay;
END_TYPE

TYPE MC_BUFFER_MODE : (mcAborting := 0, mcBuffered := 1, mcBlendingLow := 2, mcBlendingPrevious := 3, mcBlendingNext := 4,
    mcBlendingHigh := 5) := mcAborting;
END_TYPE

";

/// The whole text.
pub fn declarations(config: &MachineConfig) -> String {
    let mut out = TYPES.to_owned();
    let states: Vec<_> = CncState::ALL.iter().map(|s| format!("{} := {}", s.name(), *s as i16)).collect();
    let _ = writeln!(out, "TYPE CNC_STATE : ({});\nEND_TYPE\n", states.join(", "));
    let _ = writeln!(out, "TYPE CNC_STATUS : STRUCT");
    for (name, ty) in CNC_STATUS {
        let _ = writeln!(out, "    {name} : {ty};");
    }
    let _ = writeln!(out, "END_STRUCT;\nEND_TYPE\n");
    BLOCKS.iter().for_each(|b| out += &b.declaration());
    out + &globals(config)
}

fn globals(config: &MachineConfig) -> String {
    if config.axes.is_empty() && config.channels.is_empty() {
        return String::new();
    }
    let mut out = "VAR_GLOBAL\n".to_owned();
    for (n, axis) in (1..).zip(&config.axes) {
        let _ = writeln!(out, "    {} : AXIS_REF := (AxisNo := {n});", axis.name);
    }
    for (n, channel) in (1..).zip(&config.channels) {
        let _ = writeln!(out, "    {} : CNC_REF := (ChannelNo := {n});", channel.name);
    }
    out + "END_VAR\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::config::{AxisConfig, ChannelConfig};

    #[test]
    fn text() {
        let config = MachineConfig {
            axes: vec![AxisConfig::named("AxisX"), AxisConfig::named("AxisY")],
            channels: vec![ChannelConfig { axes: vec!["AxisX".into(), "AxisY".into()], ..ChannelConfig::default() }],
            ..MachineConfig::default()
        };
        crate::snapshot("declarations", &declarations(&config));
    }
}
