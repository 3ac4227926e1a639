//! Making a thread fit for real time, as far as the system permits. What it refuses is reported, and the run goes on without.
//! Runs: background, before the first scan.

use crate::os;
use std::fmt;

/// What to try.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Request {
    /// SCHED_FIFO priority, 1 to 99.
    pub priority: Option<i32>,
    /// Keep all memory of the process resident.
    pub lock_memory: bool,
    /// Processor to stay on.
    pub cpu: Option<usize>,
}

impl Default for Request {
    fn default() -> Self {
        Self { priority: Some(80), lock_memory: true, cpu: None }
    }
}

/// What came of it: `None` if it was not asked for, else the error number if it was refused.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Report {
    /// SCHED_FIFO.
    pub fifo: Option<Result<(), i32>>,
    /// Locked memory.
    pub locked: Option<Result<(), i32>>,
    /// Bound to a processor.
    pub cpu: Option<Result<(), i32>>,
    /// Exact wake-ups.
    pub timer_slack: Result<(), i32>,
}

/// Applies a request to the calling thread (memory: to the process).
pub fn enter(request: &Request) -> Report {
    Report {
        locked: request.lock_memory.then(os::lock_memory),
        cpu: request.cpu.map(os::set_cpu),
        fifo: request.priority.map(os::set_fifo),
        timer_slack: os::set_timer_slack(1),
    }
}

impl fmt::Display for Report {
    /// One line: `real time: SCHED_FIFO yes, memory locked no (Operation not permitted), exact wake-ups yes`.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let parts = [
            ("SCHED_FIFO", self.fifo),
            ("memory locked", self.locked),
            ("processor bound", self.cpu),
            ("exact wake-ups", Some(self.timer_slack)),
        ];
        f.write_str("real time:")?;
        for (i, (what, result)) in parts.into_iter().filter_map(|(w, r)| Some((w, r?))).enumerate() {
            let comma = if i == 0 { "" } else { "," };
            match result {
                Ok(()) => write!(f, "{comma} {what} yes")?,
                Err(n) => write!(f, "{comma} {what} no ({})", std::io::Error::from_raw_os_error(n))?,
            }
        }
        Ok(())
    }
}

/// Stack of a thread that runs programs, in bytes.
pub const STACK: usize = 8 << 20;

/// Runs `f` on a thread of its own with a stack for programs, and waits for it. Build the resource inside `f`.
pub fn on_program_thread<R: Send>(f: impl FnOnce() -> R + Send) -> std::io::Result<R> {
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().name("programs".into()).stack_size(STACK).spawn_scoped(scope, f)?;
        thread.join().map_err(|_| std::io::Error::other("the thread of the programs ended in a panic"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refusals_are_reported() {
        let report =
            on_program_thread(|| enter(&Request { priority: Some(1000), lock_memory: false, cpu: Some(1 << 20) })).unwrap();
        assert_eq!((report.fifo, report.cpu, report.locked), (Some(Err(libc::EINVAL)), Some(Err(libc::EINVAL)), None));
        assert!(report.to_string().starts_with("real time: SCHED_FIFO no (Invalid argument"), "{report}");
    }
}
