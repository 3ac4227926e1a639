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
use crate::axis::orders::{Order, Wanted};
use crate::natives::rules::Progress;
use crate::natives::{Core, Frame};
use takt_base::Code;

/// MC_BUFFER_MODE: mcAborting, mcBuffered.
const ABORTING: i16 = 0;
const BUFFERED: i16 = 1;

/// Progress of a command of an axis.
fn poll(core: &mut Core, axis: usize, command: u32) -> Progress {
    let (axis, id) = (&core.axes[axis], CommandId(command));
    Progress { outcome: axis.outcome(id), active: axis.is_active(id) }
}

/// Gives an order to an axis, in the buffer mode that the block asks for.
fn order(core: &mut Core, axis: usize, order: Order, buffer_mode: i16) -> Result<u32, Code> {
    core.axes[axis].order(order, buffer_mode == BUFFERED).map(|id| id.0)
}

/// Dynamics from the pins of a block.
fn wanted(f: &Frame, v: impl Into<usize>, a: impl Into<usize>, d: impl Into<usize>) -> Wanted {
    Wanted { v: f.lreal(v), a: f.lreal(a), d: f.lreal(d) }
}

/// Options that this version does not have are refused, not ignored.
fn supported(buffer_mode: i16, jerk: f64, continuous_update: bool) -> Result<(), Code> {
    if !jerk.is_finite() || jerk < 0.0 {
        return Err(Code::ParameterOutOfRange);
    }
    if !matches!(buffer_mode, ABORTING | BUFFERED) || jerk != 0.0 || continuous_update {
        Err(Code::UnsupportedOption)
    } else {
        Ok(())
    }
}
