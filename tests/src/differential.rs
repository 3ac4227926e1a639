//! Many generated programs on both engines: who was refused, who faulted, where the engines differ.

use crate::generate::fuzzed;
use crate::plc::Plc;
use std::any::Any;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use takt_image::Trap;

/// How a program ended.
#[derive(Clone, Debug)]
pub enum Outcome {
    /// All scans without a fault.
    Ended,
    /// Both engines with this fault.
    Fault(Trap),
    /// The compiler refused the text, with these messages: a bug of the generator or of the checker.
    Refused(String),
    /// The engines differ, or something panicked.
    Broken(String),
}

/// What many programs did.
#[derive(Debug, Default)]
pub struct Tally {
    /// Programs run.
    pub programs: u64,
    /// Programs whose scans all ended without a fault.
    pub ended: u64,
    /// Programs that faulted, by name of the trap.
    pub faults: BTreeMap<String, u64>,
    /// Seed and message of what must not be.
    pub failures: Vec<(u64, String)>,
}

/// Compiles the program of a seed and runs `scans` scans, 10 ms apart.
pub fn run(seed: u64, scans: i64) -> Outcome {
    let result = catch_unwind(AssertUnwindSafe(|| run_text(&fuzzed(seed), scans)));
    result.unwrap_or_else(|why| Outcome::Broken(message(&*why)))
}

fn run_text(text: &str, scans: i64) -> Outcome {
    let mut plc = match Plc::load(text) {
        Ok(plc) => plc,
        Err(messages) => return Outcome::Refused(messages),
    };
    match (0..scans).find_map(|i| plc.scan(10 * i).err()) {
        Some(fault) => Outcome::Fault(fault.trap),
        None => Outcome::Ended,
    }
}

fn message(why: &(dyn Any + Send)) -> String {
    let text = why.downcast_ref::<String>().cloned();
    text.or_else(|| why.downcast_ref::<&str>().map(|s| (*s).to_owned())).unwrap_or_else(|| "panic".to_owned())
}

/// Runs the seeds from `first` on, on all processors.
pub fn run_many(first: u64, count: u64, scans: i64) -> Tally {
    let next = AtomicU64::new(first);
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    let tallies: Vec<Tally> = std::thread::scope(|scope| {
        let spawn = |_| scope.spawn(|| work(&next, first + count, scans));
        let threads: Vec<_> = (0..workers).map(spawn).collect();
        threads.into_iter().map(|t| t.join().expect("failures are caught")).collect()
    });
    tallies.into_iter().fold(Tally::default(), Tally::add)
}

fn work(next: &AtomicU64, end: u64, scans: i64) -> Tally {
    let mut tally = Tally::default();
    loop {
        let seed = next.fetch_add(1, Ordering::Relaxed);
        if seed >= end {
            return tally;
        }
        tally.count(seed, run(seed, scans));
    }
}

impl Tally {
    fn count(&mut self, seed: u64, outcome: Outcome) {
        self.programs += 1;
        match outcome {
            Outcome::Ended => self.ended += 1,
            Outcome::Fault(trap) => *self.faults.entry(format!("{trap:?}")).or_default() += 1,
            Outcome::Refused(why) | Outcome::Broken(why) => self.failures.push((seed, why)),
        }
    }

    fn add(mut self, other: Self) -> Self {
        self.programs += other.programs;
        self.ended += other.ended;
        for (trap, count) in other.faults {
            *self.faults.entry(trap).or_default() += count;
        }
        self.failures.extend(other.failures);
        self.failures.sort();
        self
    }
}
