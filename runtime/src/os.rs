//! System calls that the standard library does not have: clocks, real-time scheduling, locked memory.
#![allow(unsafe_code)] // Plain calls into the C library on values of our own; none keeps a pointer.

use std::io::Error;
use takt_base::Nanos;

/// The monotonic clock of the system.
pub fn monotonic_now() -> Nanos {
    let mut t = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: `t` lives through the call. The clock exists on every Linux.
    unsafe { libc::clock_gettime(libc::CLOCK_MONOTONIC, &mut t) };
    Nanos(t.tv_sec * 1_000_000_000 + t.tv_nsec)
}

/// Sleeps until the monotonic clock shows `t`, or until a signal comes.
pub fn sleep_until(t: Nanos) {
    let t = libc::timespec { tv_sec: t.0.max(0) / 1_000_000_000, tv_nsec: t.0.max(0) % 1_000_000_000 };
    // SAFETY: `t` lives through the call; no remainder is asked for.
    unsafe { libc::clock_nanosleep(libc::CLOCK_MONOTONIC, libc::TIMER_ABSTIME, &t, std::ptr::null_mut()) };
}

fn status(ok: bool) -> Result<(), i32> {
    if ok { Ok(()) } else { Err(Error::last_os_error().raw_os_error().unwrap_or(0)) }
}

/// Gives this thread a SCHED_FIFO priority, 1 to 99.
pub fn set_fifo(priority: i32) -> Result<(), i32> {
    let p = libc::sched_param { sched_priority: priority };
    // SAFETY: `p` lives through the call; 0 is this thread.
    status(unsafe { libc::sched_setscheduler(0, libc::SCHED_FIFO, &p) } == 0)
}

/// Keeps all pages of the process in memory, those to come too.
pub fn lock_memory() -> Result<(), i32> {
    // SAFETY: takes flags alone.
    status(unsafe { libc::mlockall(libc::MCL_CURRENT | libc::MCL_FUTURE) } == 0)
}

/// Asks for wake-ups of this thread without the kernel's usual slack of 50 us.
pub fn set_timer_slack(ns: u64) -> Result<(), i32> {
    // SAFETY: takes numbers alone.
    status(unsafe { libc::prctl(libc::PR_SET_TIMERSLACK, ns, 0, 0, 0) } == 0)
}

/// Binds this thread to one processor.
pub fn set_cpu(cpu: usize) -> Result<(), i32> {
    if cpu >= libc::CPU_SETSIZE as usize {
        return Err(libc::EINVAL);
    }
    // SAFETY: the set is a plain bit field, and `cpu` lies inside it.
    status(
        unsafe {
            let mut set: libc::cpu_set_t = std::mem::zeroed();
            libc::CPU_SET(cpu, &mut set);
            libc::sched_setaffinity(0, size_of::<libc::cpu_set_t>(), &set)
        } == 0,
    )
}
