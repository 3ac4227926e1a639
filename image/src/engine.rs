//! Who executes a program: the loaded native code or the MIR interpreter. The runtime's scheduler knows only this trait.

use crate::natives::Natives;
use crate::traps::Fault;
use takt_base::Nanos;

/// Runs one program of a task on a memory.
pub trait Engine {
    /// Runs `Image::functions[function]` on the instance at offset `instance`, to its end or to a fault. `now` is the time sample of
    /// the activation, `budget` the time after which the watchdog stops it. Runs: cyclic.
    fn run(
        &mut self,
        function: u32,
        instance: u32,
        now: Nanos,
        budget: Nanos,
        memory: &mut [u8],
        natives: &mut dyn Natives,
    ) -> Result<(), Fault>;
}
