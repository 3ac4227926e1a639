//! How the run goes, for a thread that shows it while it runs: a sequence lock over a few numbers.
//! Runs: `publish` cyclic and never waits; `read` background, and tries again if the numbers changed meanwhile.

use std::sync::atomic::{AtomicU64, Ordering::*, fence};
use takt_base::Nanos;

/// A snapshot.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Snapshot {
    /// Time of the last activation.
    pub now: Nanos,
    /// Activations of all tasks.
    pub scans: u64,
    /// Skipped releases of all tasks.
    pub overruns: u64,
    /// Faults.
    pub faults: u64,
    /// Periods of the cyclic part of the host.
    pub ticks: u64,
    /// How long the last activation took.
    pub last_scan: Nanos,
    /// How long the longest took.
    pub longest_scan: Nanos,
}

const WORDS: usize = 7;

/// One writer, any number of readers.
#[derive(Default, Debug)]
pub struct Progress {
    sequence: AtomicU64,
    words: [AtomicU64; WORDS],
}

impl Progress {
    /// Replaces the snapshot. Only one thread may do so.
    pub fn publish(&self, s: &Snapshot) {
        let words = [s.now.0 as u64, s.scans, s.overruns, s.faults, s.ticks, s.last_scan.0 as u64, s.longest_scan.0 as u64];
        let sequence = self.sequence.load(Relaxed);
        self.sequence.store(sequence + 1, Relaxed);
        fence(Release);
        self.words.iter().zip(words).for_each(|(to, w)| to.store(w, Relaxed));
        self.sequence.store(sequence + 2, Release);
    }

    /// The newest snapshot.
    pub fn read(&self) -> Snapshot {
        loop {
            if let Some([now, scans, overruns, faults, ticks, last, longest]) = self.try_read() {
                let time = |w| Nanos(w as i64);
                return Snapshot {
                    now: time(now),
                    scans,
                    overruns,
                    faults,
                    ticks,
                    last_scan: time(last),
                    longest_scan: time(longest),
                };
            }
            std::hint::spin_loop();
        }
    }

    fn try_read(&self) -> Option<[u64; WORDS]> {
        let sequence = self.sequence.load(Acquire);
        let words = std::array::from_fn(|i| self.words[i].load(Relaxed));
        fence(Acquire);
        (sequence & 1 == 0 && self.sequence.load(Relaxed) == sequence).then_some(words)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    #[test]
    fn a_reader_never_sees_half_a_snapshot() {
        let progress = Arc::new(Progress::default());
        let writer = progress.clone();
        let thread = std::thread::spawn(move || {
            for n in 1..=200_000u64 {
                let t = Nanos(n as i64);
                writer.publish(&Snapshot { now: t, scans: n, overruns: n, faults: n, ticks: n, last_scan: t, longest_scan: t });
            }
        });
        let mut last = 0;
        while last < 200_000 {
            let s = progress.read();
            assert!(s.scans >= last && s.overruns == s.scans && s.longest_scan.0 as u64 == s.scans && s.now == s.last_scan);
            last = s.scans;
        }
        thread.join().unwrap();
    }
}
