//! When tasks are released (IEC 61131-3 §6.8.2; reference §10.2): by interval, by a rising edge (SINGLE), or in the background.
//!
//! Runs: cyclic. Arithmetic alone: no clock, no I/O. Phases are kept: a release that finds its task still running, or that was
//! overtaken by the next one, is skipped and counted, never made up for.

use crate::stats::TaskStats;
use takt_base::Nanos;
use takt_image::image::{Place, Task};

/// Schedule of one task.
pub struct TaskState {
    priority: u32,
    interval: Option<Nanos>,
    trigger: Option<Place>,
    /// Next release by time.
    next: Nanos,
    /// Rising edge that waits for its activation, and when it was seen.
    edge: Option<Nanos>,
    /// The trigger at the last look.
    level: bool,
    /// Stopped by a fault.
    pub stopped: bool,
    /// Limit of the watchdog for each program of the task.
    pub watchdog: Nanos,
    /// Counters and times.
    pub stats: TaskStats,
}

impl TaskState {
    /// Released for the first time at zero.
    pub fn new(task: &Task, watchdog: Nanos) -> Self {
        Self {
            priority: task.priority,
            interval: task.interval,
            trigger: task.trigger,
            next: Nanos::ZERO,
            edge: None,
            level: false,
            stopped: false,
            watchdog,
            stats: TaskStats::default(),
        }
    }

    /// True for a task without interval and trigger.
    pub fn is_background(&self) -> bool {
        self.interval.is_none() && self.trigger.is_none()
    }

    /// True for a task with a trigger, whose inputs must be looked at between scans.
    pub fn is_triggered(&self) -> bool {
        self.trigger.is_some()
    }

    /// Looks at the trigger. An edge that finds the one before it still waiting is an overrun. While the trigger is TRUE, the
    /// interval does not count.
    pub fn sample(&mut self, now: Nanos, memory: &[u8]) {
        let Some(place) = self.trigger.filter(|_| !self.stopped) else { return };
        let level = place.bool(memory).unwrap_or(false);
        if level && !self.level {
            self.stats.overruns += u64::from(self.edge.is_some());
            self.edge = self.edge.or(Some(now));
        }
        self.level = level;
        if level && self.interval.is_some() && self.next <= now {
            self.catch_up(now);
        }
    }

    /// Rank among the tasks that are ready at `now`, smallest first; `None` if this one is not ready.
    pub fn rank(&self, now: Nanos) -> Option<(bool, u32, Nanos)> {
        let timed = self.next_release().filter(|&t| t <= now);
        let ready = self.edge.into_iter().chain(timed).min()?;
        (!self.stopped).then_some((self.is_background(), self.priority, ready))
    }

    /// The next release by time, if there is one.
    pub fn next_release(&self) -> Option<Nanos> {
        (!self.stopped && (self.interval.is_some() || self.is_background())).then_some(self.next)
    }

    /// Takes the release of an activation that starts at `now`: the newest one that is due. Those before it were overtaken.
    pub fn take(&mut self, now: Nanos) -> Nanos {
        if let Some(edge) = self.edge.take() {
            return edge;
        }
        let Some(interval) = self.interval else { return self.next };
        let missed = (now - self.next).0.max(0) / interval.0;
        self.stats.overruns += missed as u64;
        let release = self.next + Nanos(missed.saturating_mul(interval.0));
        self.next = release + interval;
        release
    }

    /// The activation ended: releases that fell into it are skipped. A background task is released again after `pause`.
    pub fn finish(&mut self, end: Nanos, pause: Nanos) {
        if self.is_background() {
            self.next = end + pause;
        } else if self.interval.is_some() && self.next <= end {
            self.stats.overruns += self.catch_up(end);
        }
    }

    /// Moves the next release behind `t`, in phase. Returns how many were passed.
    fn catch_up(&mut self, t: Nanos) -> u64 {
        let Some(interval) = self.interval else { return 0 };
        let passed = (t - self.next).0.max(0) / interval.0 + 1;
        self.next += Nanos(passed.saturating_mul(interval.0));
        passed as u64
    }
}

/// A release at a fixed period, for the host and for looking at triggers. Periods that were missed are skipped, in phase.
pub struct Period {
    /// Length.
    pub length: Nanos,
    /// Next time.
    pub next: Nanos,
    /// Times that were skipped.
    pub skipped: u64,
}

impl Period {
    /// Begins at zero. `None` if the length is not positive.
    pub fn new(length: Nanos) -> Option<Self> {
        (length.0 > 0).then_some(Self { length, next: Nanos::ZERO, skipped: 0 })
    }
    /// The newest time that is due at `now`.
    pub fn take(&mut self, now: Nanos) -> Option<Nanos> {
        let behind = (now - self.next).0;
        if behind < 0 {
            return None;
        }
        let missed = behind / self.length.0;
        self.skipped += missed as u64;
        let due = self.next + Nanos(missed.saturating_mul(self.length.0));
        self.next = due + self.length;
        Some(due)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn interval(ns: i64) -> TaskState {
        let task = Task { name: "t".into(), priority: 0, interval: Some(Nanos(ns)), trigger: None, programs: vec![] };
        TaskState::new(&task, Nanos(0))
    }

    #[test]
    fn overruns_keep_the_phase() {
        let mut t = interval(10);
        assert_eq!(t.take(Nanos(0)), Nanos(0));
        t.finish(Nanos(9), Nanos(1));
        assert_eq!((t.next, t.stats.overruns), (Nanos(10), 0));
        assert_eq!(t.take(Nanos(11)), Nanos(10));
        t.finish(Nanos(20), Nanos(1)); // the release at 20 falls into the activation
        assert_eq!((t.next, t.stats.overruns), (Nanos(30), 1));
        assert_eq!(t.take(Nanos(65)), Nanos(60)); // 30, 40, 50 were overtaken
        assert_eq!((t.next, t.stats.overruns), (Nanos(70), 4));
        t.finish(Nanos(200), Nanos(1));
        assert_eq!((t.next, t.stats.overruns), (Nanos(210), 18));
    }

    #[test]
    fn an_edge_runs_once() {
        let task = Task { name: "t".into(), priority: 0, interval: None, trigger: Some(Place::Bit(1, 2)), programs: vec![] };
        let mut t = TaskState::new(&task, Nanos(0));
        let look = |t: &mut TaskState, now, byte| t.sample(Nanos(now), &[0, byte]);
        look(&mut t, 1, 0xFB);
        assert_eq!(t.rank(Nanos(1)), None);
        look(&mut t, 2, 0x04);
        assert_eq!(t.rank(Nanos(3)), Some((false, 0, Nanos(2))));
        assert_eq!(t.take(Nanos(3)), Nanos(2));
        look(&mut t, 4, 0x04);
        assert_eq!(t.rank(Nanos(4)), None);
        [(5, 0), (6, 4), (7, 0), (8, 4)].into_iter().for_each(|(now, byte)| look(&mut t, now, byte));
        assert_eq!((t.take(Nanos(9)), t.stats.overruns), (Nanos(6), 1));
        t.stopped = true;
        [(10, 0), (11, 4), (12, 0), (13, 4)].into_iter().for_each(|(now, byte)| look(&mut t, now, byte));
        assert_eq!((t.rank(Nanos(13)), t.stats.overruns), (None, 1), "nobody waits for a stopped task");
    }

    #[test]
    fn periods_skip() {
        let mut p = Period::new(Nanos(5)).unwrap();
        assert_eq!(
            [p.take(Nanos(0)), p.take(Nanos(4)), p.take(Nanos(5)), p.take(Nanos(22))],
            [Some(0), None, Some(5), Some(20)].map(|o| o.map(Nanos))
        );
        assert_eq!((p.next, p.skipped), (Nanos(25), 2));
        assert!(Period::new(Nanos(0)).is_none());
    }
}
