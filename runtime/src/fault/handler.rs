//! The signal handler. Runs: in a signal, on the thread's own alternate stack; calls nothing that is not async-signal-safe.
#![allow(unsafe_code)] // A signal handler works on raw pointers from the kernel.

use super::{Activation, CURRENT, arch};
use crate::load::LoadError;
use libc::{c_int, c_void, siginfo_t, ucontext_t};
use std::mem::zeroed;
use std::ptr::null_mut;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicPtr, Ordering};

/// Signals that generated code may raise; the watchdog's comes last.
const FAULTS: [c_int; 4] = [libc::SIGILL, libc::SIGFPE, libc::SIGSEGV, libc::SIGBUS];

/// Who handled the signals of `FAULTS` and the watchdog's before. Written once, before our handler is installed.
static BEFORE: [AtomicPtr<libc::sigaction>; 5] = [const { AtomicPtr::new(null_mut()) }; 5];

/// What the watchdog's timer sends along, so that it can be told from other users of the signal.
static WATCHDOG_TAG: u8 = 0;

/// The watchdog's signal.
pub(super) fn watchdog_signal() -> c_int {
    libc::SIGRTMIN()
}

/// The value that the watchdog's timer sends along.
pub(super) fn watchdog_value() -> libc::sigval {
    libc::sigval { sival_ptr: (&raw const WATCHDOG_TAG).cast_mut().cast() }
}

/// Installs the handler in this process, once.
pub(super) fn install() -> Result<(), LoadError> {
    static DONE: OnceLock<Result<(), LoadError>> = OnceLock::new();
    DONE.get_or_init(|| FAULTS.into_iter().chain([watchdog_signal()]).enumerate().try_for_each(|(i, s)| install_one(i, s)))
        .clone()
}

fn install_one(slot: usize, signal: c_int) -> Result<(), LoadError> {
    let error = || LoadError::last("installing a signal handler");
    // SAFETY: plain calls on structures of our own. The handler is written to be called at any instruction.
    unsafe {
        let mut before = Box::new(zeroed::<libc::sigaction>());
        if libc::sigaction(signal, std::ptr::null(), &mut *before) != 0 {
            return Err(error());
        }
        BEFORE[slot].store(Box::into_raw(before), Ordering::Release); // kept for the life of the process
        let mut ours: libc::sigaction = zeroed();
        ours.sa_sigaction = handle as extern "C" fn(c_int, *mut siginfo_t, *mut c_void) as usize;
        ours.sa_flags = libc::SA_SIGINFO | libc::SA_ONSTACK | libc::SA_RESTART;
        libc::sigemptyset(&mut ours.sa_mask);
        libc::sigaddset(&mut ours.sa_mask, watchdog_signal());
        if libc::sigaction(signal, &ours, null_mut()) == 0 { Ok(()) } else { Err(error()) }
    }
}

extern "C" fn handle(signal: c_int, info: *mut siginfo_t, context: *mut c_void) {
    let context: *mut ucontext_t = context.cast();
    // SAFETY: the kernel's pointers are valid here, and `CURRENT` is null or an activation further down on this very thread. Its
    // fields are reached one by one: the interrupted native entry may hold a reference to `call`.
    unsafe {
        let ours = signal == watchdog_signal() && (*info).si_code == libc::SI_TIMER && is_watchdog(info);
        let current = CURRENT.get();
        let pc = arch::pc(context);
        if !current.is_null() {
            (*current).ticks = (*current).ticks.saturating_add(u32::from(ours));
            let (start, end) = (*current).code;
            let due = signal != watchdog_signal() || (ours && (*current).ticks >= (*current).max_ticks);
            if start <= pc && pc < end && due {
                return leave(current, signal, pc, info, context);
            }
        }
        // A watchdog that fires inside a native, or outside of an activation, is retried at its next tick.
        if !ours {
            pass_on(signal, info, context);
        }
    }
}

/// Ends the activation.
unsafe fn leave(act: *mut Activation, signal: c_int, pc: u64, info: *mut siginfo_t, context: *mut ucontext_t) {
    let touched = matches!(signal, libc::SIGSEGV | libc::SIGBUS);
    // SAFETY: for these signals the kernel fills the address in; the context is that of the thread inside `act`, whose code was
    // interrupted, so that nobody holds a reference to it.
    unsafe {
        (*act).signal = signal;
        (*act).pc = pc;
        (*act).address = if touched { (*info).si_addr() as u64 } else { 0 };
        arch::leave(context, &*act);
    }
}

unsafe fn is_watchdog(info: *mut siginfo_t) -> bool {
    // SAFETY: a signal of a timer carries the timer's value.
    unsafe { (*info).si_value().sival_ptr.cast_const().cast() == &raw const WATCHDOG_TAG }
}

/// Gives the signal to the handler that was there before ours.
unsafe fn pass_on(signal: c_int, info: *mut siginfo_t, context: *mut ucontext_t) {
    let slot = FAULTS.iter().position(|&s| s == signal).unwrap_or(FAULTS.len());
    // SAFETY: the slot was filled before our handler could be called, and is never freed.
    unsafe {
        let Some(before) = BEFORE[slot].load(Ordering::Acquire).as_ref() else { return };
        match before.sa_sigaction {
            libc::SIG_IGN if slot == FAULTS.len() => {}
            libc::SIG_DFL | libc::SIG_IGN => {
                // Back to the default, so that the instruction faults again and the process ends as it should.
                libc::sigaction(signal, before, null_mut());
                if (*info).si_code <= 0 {
                    libc::raise(signal);
                }
            }
            f if before.sa_flags & libc::SA_SIGINFO != 0 => {
                let f: extern "C" fn(c_int, *mut siginfo_t, *mut c_void) = std::mem::transmute(f);
                f(signal, info, context.cast());
            }
            f => {
                let f: extern "C" fn(c_int) = std::mem::transmute(f);
                f(signal);
            }
        }
    }
}
