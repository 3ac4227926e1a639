//! Drive back ends for reference pulses.
//! Runs: cyclic. From: PC-37.

pub mod parport;

/// A port that takes one byte of clock and direction bits (PC-30).
pub trait StepPort {
    /// Puts a byte on the data lines.
    fn write(&mut self, data: u8);
    /// Pulses the reset line (PC-33).
    fn reset(&mut self);
}
