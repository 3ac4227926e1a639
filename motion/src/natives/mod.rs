//! Function blocks as natives: pins declared once, from which the ST declaration and the offsets both come.
//! Runs: binding before the start, calls cyclic. A call looks nothing up by name and allocates nothing.

pub mod bind;
pub mod frame;
pub mod pins;
pub mod rules;

pub use bind::Bound;
pub use frame::Frame;
pub use pins::{Block, Pin, Section};

use crate::axis::Axis;
use crate::channel::Channel;

/// What the blocks act on: the cyclic half of a machine.
pub struct Core {
    /// `AXIS_REF.AxisNo` counts from 1.
    pub axes: Vec<Axis>,
    /// `CNC_REF.ChannelNo` counts from 1.
    pub channels: Vec<Channel>,
}

/// All blocks of the motion library.
pub const BLOCKS: &[Block] = &[
    crate::plcopen::mc_power::BLOCK,
    crate::plcopen::mc_home::BLOCK,
    crate::plcopen::mc_stop::BLOCK,
    crate::plcopen::mc_halt::BLOCK,
    crate::plcopen::mc_move_absolute::BLOCK,
    crate::plcopen::mc_move_relative::BLOCK,
    crate::plcopen::mc_move_velocity::BLOCK,
    crate::plcopen::mc_reset::BLOCK,
    crate::plcopen::mc_read_status::BLOCK,
    crate::plcopen::mc_read_actual_position::BLOCK,
    crate::plcopen::mc_read_actual_velocity::BLOCK,
    crate::plcopen::mc_read_axis_error::BLOCK,
    crate::cnc::cnc_load_program::BLOCK,
    crate::cnc::cnc_run::BLOCK,
    crate::cnc::cnc_hold::BLOCK,
    crate::cnc::cnc_resume::BLOCK,
    crate::cnc::cnc_abort::BLOCK,
    crate::cnc::cnc_reset::BLOCK,
    crate::cnc::cnc_set_override::BLOCK,
    crate::cnc::cnc_read_status::BLOCK,
    crate::cnc::cnc_read_error::BLOCK,
    crate::cnc::cnc_aux_handshake::BLOCK,
    crate::cnc::cnc_io::BLOCK,
    crate::cnc::cnc_panel::BLOCK,
    crate::cnc::cnc_step_block::BLOCK,
    crate::cnc::cnc_mdi::BLOCK,
    crate::cnc::cnc_call_sub::BLOCK,
    crate::cnc::cnc_check_program::BLOCK,
    crate::cnc::cnc_read_probe::BLOCK,
];
