//! How long scans take and how late they start.
//! Runs: `record` cyclic, without allocation; the rest background. Values of a bucket differ by 3 % at most.

use takt_base::Nanos;

/// Buckets of one power of two.
const SUB: usize = 32;
const BUCKETS: usize = (64 - 5) * SUB + SUB;

/// Counts of durations in buckets that grow with the duration (log-linear).
#[derive(Clone)]
pub struct Histogram {
    counts: Box<[u64; BUCKETS]>,
    count: u64,
    sum: u128,
    min: u64,
    max: u64,
}

impl Default for Histogram {
    fn default() -> Self {
        Self { counts: Box::new([0; BUCKETS]), count: 0, sum: 0, min: u64::MAX, max: 0 }
    }
}

impl Histogram {
    /// Counts a duration; a negative one counts as zero.
    pub fn record(&mut self, d: Nanos) {
        let v = d.0.max(0) as u64;
        self.counts[bucket(v)] += 1;
        self.count += 1;
        self.sum += u128::from(v);
        self.min = self.min.min(v);
        self.max = self.max.max(v);
    }
    /// Durations counted.
    pub fn count(&self) -> u64 {
        self.count
    }
    /// Shortest; zero if there are none.
    pub fn min(&self) -> Nanos {
        Nanos(if self.count == 0 { 0 } else { self.min as i64 })
    }
    /// Longest; zero if there are none.
    pub fn max(&self) -> Nanos {
        Nanos(self.max as i64)
    }
    /// Arithmetic mean; zero if there are none.
    pub fn mean(&self) -> Nanos {
        Nanos(self.sum.checked_div(u128::from(self.count)).unwrap_or(0) as i64)
    }
    /// The duration that a part `q` (0 to 1) of all does not exceed: `quantile(0.99)` is p99. Zero if there are none.
    pub fn quantile(&self, q: f64) -> Nanos {
        let rank = ((q.clamp(0.0, 1.0) * self.count as f64).ceil() as u64).max(1);
        let mut seen = 0;
        for (i, n) in self.counts.iter().enumerate() {
            seen += n;
            if seen >= rank {
                return Nanos(upper(i).clamp(self.min, self.max) as i64);
            }
        }
        self.max()
    }
}

fn bucket(v: u64) -> usize {
    let shift = (63 - (v | 1).leading_zeros() as usize).saturating_sub(5);
    shift * SUB + (v >> shift) as usize
}

/// Largest value of a bucket.
fn upper(i: usize) -> u64 {
    let shift = (i / SUB).saturating_sub(1);
    let mantissa = (i - shift * SUB) as u64;
    ((mantissa + 1) << shift).wrapping_sub(1)
}

/// What a task did so far.
#[derive(Clone, Default)]
pub struct TaskStats {
    /// Activations.
    pub scans: u64,
    /// Releases that were skipped since the task, or the processor, was still busy.
    pub overruns: u64,
    /// Activations that ended in a fault.
    pub faults: u64,
    /// From the start of the first program to the end of the last.
    pub scan_time: Histogram,
    /// From the release to the start: the jitter of the task.
    pub lateness: Histogram,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn buckets_are_seamless() {
        assert_eq!((bucket(0), upper(0), bucket(63), upper(63), bucket(64)), (0, 0, 63, 63, 64));
        for i in 1..BUCKETS - SUB {
            assert_eq!(bucket(upper(i)), i);
            assert_eq!(bucket(upper(i) + 1), i + 1);
        }
        assert!(bucket(i64::MAX as u64) < BUCKETS);
    }

    #[test]
    fn quantiles_are_close() {
        let mut h = Histogram::default();
        assert_eq!((h.quantile(0.5), h.min(), h.mean()), (Nanos(0), Nanos(0), Nanos(0)));
        (1..=100_000).for_each(|i| h.record(Nanos(i)));
        for (q, want) in [(0.5, 50_000.0), (0.9, 90_000.0), (0.99, 99_000.0), (0.999, 99_900.0)] {
            let got = h.quantile(q).0 as f64;
            assert!((got / want - 1.0).abs() < 0.032, "{q}: {got}");
        }
        assert_eq!((h.min(), h.max(), h.mean(), h.quantile(1.0)), (Nanos(1), Nanos(100_000), Nanos(50_000), Nanos(100_000)));
        h.record(Nanos(-5));
        assert_eq!(h.min(), Nanos(0));
    }
}
