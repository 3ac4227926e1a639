//! Function blocks of a CNC channel, a file each. All of them are ours; PLCopen has none.
//! Runs: cyclic. From: CNC function blocks §4.3..§4.5.

pub mod cnc_abort;
pub mod cnc_aux_handshake;
pub mod cnc_call_sub;
pub mod cnc_check_program;
pub mod cnc_hold;
pub mod cnc_io;
pub mod cnc_load_program;
pub mod cnc_mdi;
pub mod cnc_panel;
pub mod cnc_read_error;
pub mod cnc_read_probe;
pub mod cnc_read_status;
pub mod cnc_reset;
pub mod cnc_resume;
pub mod cnc_run;
pub mod cnc_set_override;
pub mod cnc_step_block;
