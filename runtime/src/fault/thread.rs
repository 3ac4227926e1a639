//! What a thread needs before it may run generated code: the handlers, a stack for them, a watchdog timer, and its stack's limits.
//! Runs: [`prepare`] in the background, once a thread; [`prepare`] on a prepared thread is one test of a flag.
#![allow(unsafe_code)] // System calls without a safe interface.

use super::{WATCHDOG_TICK, handler};
use crate::load::LoadError;
use std::cell::{Cell, RefCell};
use std::mem::zeroed;
use std::ptr::null_mut;

/// Bytes below the limit that natives and handlers may use: an overflow inside a native can't be recovered from.
const HELPER_RESERVE: u64 = 256 << 10;
/// Most of a stack that is used, whatever the system says: an unlimited main stack has no useful end.
const LARGEST_STACK: u64 = 8 << 20;
/// Bytes of the stack for signal handlers.
const SIGNAL_STACK: usize = 64 << 10;

/// Limits of a thread's stack.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Stack {
    /// Lowest address that exists.
    pub lowest: u64,
    /// Lowest address that generated code may use.
    pub limit: u64,
}

impl Stack {
    /// True if a fault at this address is an overflow: below the limit, in the rest of the stack or the guard pages behind it.
    pub fn overflowed(self, address: u64) -> bool {
        const GUARD: u64 = 1 << 20;
        address < self.limit && address >= self.lowest.saturating_sub(GUARD)
    }
}

thread_local! {
    static STACK: Cell<Option<Stack>> = const { Cell::new(None) };
    static KIT: RefCell<Option<Kit>> = const { RefCell::new(None) };
}

/// Makes this thread fit to run generated code, and returns its stack's limits.
pub fn prepare() -> Result<Stack, LoadError> {
    if let Some(stack) = STACK.get() {
        return Ok(stack);
    }
    handler::install()?;
    let kit = Kit::new()?;
    let stack = measure_stack()?;
    KIT.with(|k| *k.borrow_mut() = Some(kit));
    STACK.set(Some(stack));
    Ok(stack)
}

/// The thread's own signal stack and timer; both go with the thread.
struct Kit {
    signal_stack: *mut libc::c_void,
    watchdog: libc::timer_t,
}

impl Kit {
    fn new() -> Result<Self, LoadError> {
        let signal_stack = signal_stack()?;
        let watchdog = watchdog().inspect_err(|_| {
            // SAFETY: the stack was mapped just now; the thread must not use it any longer.
            unsafe { drop_signal_stack(signal_stack) }
        })?;
        Ok(Self { signal_stack, watchdog })
    }
}

impl Drop for Kit {
    fn drop(&mut self) {
        STACK.set(None);
        // SAFETY: both are ours, and the thread runs no generated code any more.
        unsafe {
            libc::timer_delete(self.watchdog);
            drop_signal_stack(self.signal_stack);
        }
    }
}

fn signal_stack() -> Result<*mut libc::c_void, LoadError> {
    // SAFETY: a fresh mapping, given to the kernel as this thread's signal stack.
    unsafe {
        let flags = libc::MAP_PRIVATE | libc::MAP_ANONYMOUS | libc::MAP_POPULATE;
        let base = libc::mmap(null_mut(), SIGNAL_STACK, libc::PROT_READ | libc::PROT_WRITE, flags, -1, 0);
        if base == libc::MAP_FAILED {
            return Err(LoadError::last("mapping a signal stack"));
        }
        let stack = libc::stack_t { ss_sp: base, ss_flags: 0, ss_size: SIGNAL_STACK };
        if libc::sigaltstack(&stack, null_mut()) == 0 { Ok(base) } else { Err(LoadError::last("setting a signal stack")) }
    }
}

/// Unsets and frees the signal stack.
///
/// # Safety
/// `base` is from [`signal_stack`] on this thread, and no handler runs.
unsafe fn drop_signal_stack(base: *mut libc::c_void) {
    let none = libc::stack_t { ss_sp: null_mut(), ss_flags: libc::SS_DISABLE, ss_size: 0 };
    // SAFETY: the caller's promise.
    unsafe {
        libc::sigaltstack(&none, null_mut());
        libc::munmap(base, SIGNAL_STACK);
    }
}

/// A timer that ticks with the CPU time of this thread: a thread that sleeps gets no signal.
fn watchdog() -> Result<libc::timer_t, LoadError> {
    // SAFETY: plain calls on structures of our own.
    unsafe {
        let mut event: libc::sigevent = zeroed();
        event.sigev_notify = libc::SIGEV_THREAD_ID;
        event.sigev_signo = handler::watchdog_signal();
        event.sigev_value = handler::watchdog_value();
        event.sigev_notify_thread_id = libc::gettid();
        let mut timer: libc::timer_t = null_mut();
        if libc::timer_create(libc::CLOCK_THREAD_CPUTIME_ID, &mut event, &mut timer) != 0 {
            return Err(LoadError::last("making the watchdog's timer"));
        }
        let tick = libc::timespec { tv_sec: 0, tv_nsec: WATCHDOG_TICK.0 };
        let period = libc::itimerspec { it_interval: tick, it_value: tick };
        if libc::timer_settime(timer, 0, &period, null_mut()) != 0 {
            libc::timer_delete(timer);
            return Err(LoadError::last("starting the watchdog's timer"));
        }
        Ok(timer)
    }
}

fn measure_stack() -> Result<Stack, LoadError> {
    // SAFETY: plain calls on structures of our own.
    let (base, size) = unsafe {
        let mut attr: libc::pthread_attr_t = zeroed();
        let status = libc::pthread_getattr_np(libc::pthread_self(), &mut attr);
        if status != 0 {
            return Err(LoadError::System("asking for the stack's limits", status));
        }
        let (mut base, mut size) = (null_mut(), 0);
        libc::pthread_attr_getstack(&attr, &mut base, &mut size);
        libc::pthread_attr_destroy(&mut attr);
        (base as u64, size as u64)
    };
    let here = &raw const base as u64;
    let lowest = base.max(here.saturating_sub(LARGEST_STACK));
    Ok(Stack { lowest, limit: lowest + HELPER_RESERVE.min(size / 2) })
}
