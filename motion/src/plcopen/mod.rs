//! Function blocks of PLCopen Motion Control part 1, a file each.
//! Runs: cyclic. REAL of the standard is LREAL here, ErrorID is WORD.

pub mod mc_halt;
pub mod mc_home;
pub mod mc_move_absolute;
pub mod mc_move_relative;
pub mod mc_move_velocity;
pub mod mc_power;
pub mod mc_read_actual_position;
pub mod mc_read_actual_velocity;
pub mod mc_read_axis_error;
pub mod mc_read_status;
pub mod mc_reset;
pub mod mc_stop;

use crate::axis::CommandId;
use crate::natives::Core;
use crate::natives::rules::Progress;
use takt_base::Code;

/// MC_BUFFER_MODE: mcAborting.
const ABORTING: i16 = 0;

/// Progress of a command of an axis.
fn poll(core: &mut Core, axis: usize, command: u32) -> Progress {
    Progress::of(core.axes[axis].outcome(CommandId(command)))
}

/// Options that this version does not have are refused, not ignored.
fn supported(buffer_mode: i16, jerk: f64, continuous_update: bool) -> Result<(), Code> {
    if !jerk.is_finite() || jerk < 0.0 {
        return Err(Code::ParameterOutOfRange);
    }
    if buffer_mode != ABORTING || jerk != 0.0 || continuous_update { Err(Code::UnsupportedOption) } else { Ok(()) }
}
