//! Time: the only place that reads a clock. Everybody else is handed the time (R2: time is an argument).
//! Runs: cyclic.

use crate::os;
use std::cell::Cell;
use std::rc::Rc;
use std::sync::atomic::{AtomicBool, Ordering};
use takt_base::Nanos;

/// What the scheduler waits on. Times count from the start of the run.
pub trait Clock {
    /// The time.
    fn now(&self) -> Nanos;
    /// Waits until `t`; false if `stop` was set first.
    fn wait_until(&mut self, t: Nanos, stop: &AtomicBool) -> bool;
}

/// Virtual time: jumps to what is waited for. Clones share the time, so that a test can say how long a program took.
#[derive(Clone, Default, Debug)]
pub struct Virtual(Rc<Cell<Nanos>>);

impl Virtual {
    /// At zero.
    pub fn new() -> Self {
        Self::default()
    }
    /// Lets time pass.
    pub fn advance(&self, by: Nanos) {
        self.0.set(self.0.get() + by);
    }
}

impl Clock for Virtual {
    fn now(&self) -> Nanos {
        self.0.get()
    }
    fn wait_until(&mut self, t: Nanos, stop: &AtomicBool) -> bool {
        self.0.set(t.max(self.0.get()));
        !stop.load(Ordering::Relaxed)
    }
}

/// Longest sleep between two looks at the stop flag.
const SLICE: Nanos = Nanos::from_millis(50);

/// Real time: the monotonic clock of the system.
#[derive(Clone, Copy, Debug)]
pub struct Monotonic {
    start: Nanos,
    spin: Nanos,
}

impl Monotonic {
    /// Starts now.
    pub fn start() -> Self {
        Self { start: os::monotonic_now(), spin: Nanos::ZERO }
    }
    /// Wakes up this much early and waits for the rest without sleeping: less jitter for more processor time.
    pub fn spin(self, spin: Nanos) -> Self {
        Self { spin, ..self }
    }
}

impl Clock for Monotonic {
    fn now(&self) -> Nanos {
        os::monotonic_now() - self.start
    }
    fn wait_until(&mut self, t: Nanos, stop: &AtomicBool) -> bool {
        loop {
            let now = self.now();
            if stop.load(Ordering::Relaxed) {
                return false;
            }
            if now >= t {
                return true;
            }
            let wake = (t - self.spin).min(now + SLICE);
            if wake > now {
                os::sleep_until(self.start + wake);
            } else {
                std::hint::spin_loop();
            }
        }
    }
}

/// A point of real time for measurements: never an input of a program.
pub fn stopwatch() -> Nanos {
    os::monotonic_now()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn virtual_time_jumps_and_never_goes_back() {
        let (mut clock, stop) = (Virtual::new(), AtomicBool::new(false));
        assert!(clock.wait_until(Nanos(50), &stop) && clock.wait_until(Nanos(20), &stop));
        assert_eq!(clock.now(), Nanos(50));
        stop.store(true, Ordering::Relaxed);
        assert!(!clock.wait_until(Nanos(60), &stop));
    }

    #[test]
    fn real_time_waits_and_can_be_stopped() {
        let (mut clock, stop) = (Monotonic::start().spin(Nanos::from_micros(100)), AtomicBool::new(false));
        assert!(clock.wait_until(Nanos::from_millis(2), &stop));
        assert!(clock.now() >= Nanos::from_millis(2));
        stop.store(true, Ordering::Relaxed);
        assert!(!clock.wait_until(Nanos::from_secs(3600), &stop));
    }
}
