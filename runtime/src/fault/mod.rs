//! Recovery from faults of generated code: a fault inside the code ends the activation and nothing else.
//!
//! Runs: cyclic. [`activate`] notes where it can be left, in `Activation`, and calls the code. A signal handler that finds the
//! faulting instruction inside the code changes the saved registers so that the call returns at once. A fault anywhere else is not
//! ours and goes to the handler that was there before. The watchdog is a timer on the CPU time of the thread, since wall time passes
//! without us: it ticks while the thread computes, and an activation that sees too many ticks ends.
#![allow(unsafe_code)] // Signals, registers and calls into generated code: what this module is for.

mod arch;
mod entry;
mod handler;
mod thread;

pub use entry::address as native_entry;
pub use thread::{Stack, prepare};

use crate::load::{Bound, CodeMap};
use std::cell::Cell;
use std::ptr::null_mut;
use takt_base::Nanos;
use takt_image::Natives;

/// Period of the watchdog timer in CPU time of the thread. The kernel's tick may make it longer.
pub const WATCHDOG_TICK: Nanos = Nanos::from_millis(10);

/// One call into generated code that is under way. The first two fields are written by [`arch::enter`].
#[repr(C)]
pub(crate) struct Activation {
    /// Stack pointer to leave with.
    rsp: u64,
    /// Where to leave to.
    resume: u64,
    /// Signal that ended it; 0 if none.
    signal: i32,
    /// Address of the instruction that faulted.
    pc: u64,
    /// Address that it touched, if it was a memory fault.
    address: u64,
    /// Range of the code.
    code: (u64, u64),
    /// Ticks of the watchdog so far, and how many are allowed.
    ticks: u32,
    max_ticks: u32,
    /// What the native entry works on.
    call: entry::Context,
}

thread_local! {
    /// The activation of this thread. Initialised in place: reading it in a signal handler is safe.
    static CURRENT: Cell<*mut Activation> = const { Cell::new(null_mut()) };
}

/// What ended an activation early.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Stop {
    /// The signal.
    pub signal: i32,
    /// Offset of the instruction in the code.
    pub offset: u32,
    /// Address that was touched, for a memory fault.
    pub address: u64,
    /// Trap number of the last native that failed; 0 if none did.
    pub native_trap: u32,
}

/// What a call into the code needs.
pub struct Call<'a> {
    /// The code.
    pub code: &'a CodeMap,
    /// Offset of the function in the code.
    pub start: u32,
    /// Its arguments behind the memory: frame and instance.
    pub frame: u32,
    /// Offset of the program instance.
    pub instance: u32,
    /// Imports of the image.
    pub imports: &'a [Bound],
    /// Time sample.
    pub now: Nanos,
    /// CPU time that it may take.
    pub budget: Nanos,
}

/// Calls generated code on a memory. `Err` if it was stopped; the memory is then half-written.
pub fn activate(call: &Call, memory: &mut [u8], natives: &mut dyn Natives) -> Result<(), Stop> {
    let (base, size) = (memory.as_mut_ptr(), memory.len());
    let ticks = call.budget.0.max(0) as u64 / WATCHDOG_TICK.0 as u64 + 2;
    let mut act = Activation {
        rsp: 0,
        resume: 0,
        signal: 0,
        pc: 0,
        address: 0,
        code: call.code.bounds(),
        ticks: 0,
        max_ticks: u32::try_from(ticks).unwrap_or(u32::MAX),
        call: entry::Context::new(base, size, natives, call.imports, call.now),
    };
    let entered = &raw mut act;
    let outer = CURRENT.replace(entered);
    // SAFETY: the address is the start of a function of the image with this signature; memory, natives and `act` outlive the call;
    // the native entry alone touches memory and natives meanwhile, through pointers made from these exclusive borrows.
    let stopped = unsafe { arch::enter(call.code.address(call.start), base, call.frame, call.instance, entered) };
    CURRENT.set(outer);
    // SAFETY: `act` lives; it was changed behind the compiler's back, so it is read through the pointer.
    let act = unsafe { &*entered };
    if stopped == 0 {
        return Ok(());
    }
    let offset = act.pc.saturating_sub(act.code.0) as u32;
    Err(Stop { signal: act.signal, offset, address: act.address, native_trap: act.call.trap() })
}
