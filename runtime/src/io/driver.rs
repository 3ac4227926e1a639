//! The driver of a resource: what stands between the process image and the world.

use takt_base::Nanos;

/// Copies inputs in and outputs out. Runs: cyclic, so a bus does its waiting elsewhere and hands over what came last.
pub trait Driver {
    /// Fills the input area (%I) before scan `scan` (from 1), and between scans where a task waits for an input.
    fn read_inputs(&mut self, now: Nanos, scan: u64, inputs: &mut [u8]);
    /// Takes the output area (%Q) after a scan, and at the end in its safe state.
    fn write_outputs(&mut self, now: Nanos, outputs: &[u8]);
    /// Changes any variable after the inputs were read and before the programs run: for simulation.
    fn force(&mut self, _now: Nanos, _scan: u64, _memory: &mut [u8]) {}
}

/// No world: inputs stay as they are.
pub struct NoIo;

impl Driver for NoIo {
    fn read_inputs(&mut self, _: Nanos, _: u64, _: &mut [u8]) {}
    fn write_outputs(&mut self, _: Nanos, _: &[u8]) {}
}
