//! A resource: a loaded program with its memory, its tasks and its host, and the loop that runs it.
//!
//! Runs: `new` and the questions in the background, everything from `advance` on cyclic. Tasks are cooperative: one activation runs to
//! its end (IEC 61131-3 reference §10.2). What is due first runs first: a tick of the host, then the ready task with the highest
//! priority, among equals the one that waits longest.

use crate::clock::Clock;
use crate::io::{Driver, NoIo};
use crate::load::{LoadError, Memory};
use crate::progress::{Progress, Snapshot};
use crate::record::{FaultRecord, FaultReport};
use crate::safe::SafeOutputs;
use crate::stats::TaskStats;
use crate::task::{Period, TaskState};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use takt_base::Nanos;
use takt_image::{Engine, Host, Image};

/// What a fault stops.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum OnFault {
    /// Everything: all outputs go to their safe state, the host stops what moves.
    #[default]
    StopResource,
    /// The task: the outputs that it changed last go to their safe state, the other tasks run on. The last task takes the resource
    /// with it.
    StopTask,
}

/// How to run.
#[derive(Clone, PartialEq, Debug)]
pub struct Options {
    /// What a fault stops.
    pub on_fault: OnFault,
    /// Safe state of %Q from its first byte on; what is not given is zero.
    pub safe_outputs: Vec<u8>,
    /// CPU time that each program of a task may take per activation.
    pub watchdog: Nanos,
    /// The same for single tasks, by name.
    pub watchdogs: Vec<(String, Nanos)>,
    /// How often inputs are looked at for triggers; and how long a background task rests between two activations.
    pub base_tick: Nanos,
    /// How long the host ticks on after a stop, to bring what moves to rest.
    pub run_down: Nanos,
    /// Measure scan times with the real clock, in virtual time too.
    pub measure: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            on_fault: OnFault::default(),
            safe_outputs: Vec::new(),
            watchdog: Nanos::from_millis(100),
            watchdogs: Vec::new(),
            base_tick: Nanos::from_millis(1),
            run_down: Nanos::ZERO,
            measure: true,
        }
    }
}

/// Where a resource is in its life. There is no way back: a new run is a new resource.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum State {
    /// Tasks are scheduled.
    Running,
    /// Ended by [`Resource::stop`]; outputs are safe.
    Stopped,
    /// Ended by a fault; outputs are safe.
    Faulted,
}

/// What [`Resource::advance`] did.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Step {
    /// The host's cyclic part ran.
    Tick(Nanos),
    /// Inputs were looked at for triggers.
    Poll(Nanos),
    /// A task ran.
    Scan(ScanInfo),
    /// Nothing is due before this time; `None` if nothing ever is.
    Idle(Option<Nanos>),
    /// The resource does not run any more.
    Ended,
}

/// One activation of a task.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ScanInfo {
    /// Index into `Image::tasks`.
    pub task: usize,
    /// Number of the scan, from 1, over all tasks.
    pub scan: u64,
    /// Time sample of the activation.
    pub now: Nanos,
    /// How it failed, if it did.
    pub fault: Option<FaultRecord>,
}

/// Why [`Resource::run_until`] returned.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum End {
    /// The deadline came.
    Deadline,
    /// The stop flag was set, or the observer had enough.
    Stopped,
    /// A fault stopped the resource.
    Faulted,
    /// No task is left that could ever run.
    NothingToRun,
}

/// Faults that are kept on record; later ones are only counted.
const MAX_RECORDS: usize = 64;

/// A program that can run, or runs.
pub struct Resource {
    pub(crate) image: Image,
    pub(crate) memory: Memory,
    pub(crate) engine: Box<dyn Engine>,
    pub(crate) host: Box<dyn Host>,
    pub(crate) driver: Box<dyn Driver>,
    pub(crate) options: Options,
    pub(crate) tasks: Vec<TaskState>,
    ticks: Option<Period>,
    polls: Option<Period>,
    pub(crate) safe: SafeOutputs,
    pub(crate) state: State,
    pub(crate) faults: Vec<FaultRecord>,
    pub(crate) counts: Snapshot,
    progress: Arc<Progress>,
    /// What programs see as the time of the start: timers that were restored go on from there.
    pub(crate) epoch: Nanos,
    shut: bool,
}

impl Resource {
    /// Allocates the memory and prepares the tasks. `engine` was made for this image and bound to this host.
    pub fn new(image: Image, engine: Box<dyn Engine>, host: Box<dyn Host>, options: Options) -> Result<Self, LoadError> {
        takt_image::validate::validate(&image)?;
        let memory = Memory::new(&image)?;
        let tasks: Vec<_> = image.tasks.iter().map(|t| TaskState::new(t, watchdog(&options, &t.name))).collect();
        if let Some((name, _)) =
            options.watchdogs.iter().find(|(n, _)| !image.tasks.iter().any(|t| t.name.eq_ignore_ascii_case(n)))
        {
            return Err(LoadError::Option(format!("a watchdog for `{name}`, but there is no such task")));
        }
        let base = Period::new(options.base_tick).ok_or_else(|| LoadError::Option("the base tick must be positive".into()))?;
        Ok(Self {
            safe: SafeOutputs::new(&memory[image.memory.outputs.range()], &options.safe_outputs)?,
            ticks: host.period().and_then(Period::new),
            polls: tasks.iter().any(TaskState::is_triggered).then_some(base),
            driver: Box::new(NoIo),
            state: State::Running,
            faults: Vec::with_capacity(MAX_RECORDS),
            counts: Snapshot::default(),
            progress: Arc::default(),
            epoch: Nanos::ZERO,
            shut: false,
            image,
            memory,
            engine,
            host,
            options,
            tasks,
        })
    }

    /// Connects the process image to the world.
    pub fn with_driver(mut self, driver: Box<dyn Driver>) -> Self {
        self.driver = driver;
        self
    }

    /// Changes the memory before the first scan, for retained values; `restore` gives the time at which programs go on.
    pub fn restored(mut self, restore: impl FnOnce(&mut [u8]) -> Nanos) -> Self {
        self.epoch = restore(&mut self.memory);
        self
    }

    /// The time that programs see now: that of the last scan, behind the time restored.
    pub fn program_time(&self) -> Nanos {
        self.epoch + self.counts.now
    }

    /// The image.
    pub fn image(&self) -> &Image {
        &self.image
    }
    /// The memory, as it is between two scans.
    pub fn memory(&self) -> &[u8] {
        &self.memory
    }
    /// Whether it runs.
    pub fn state(&self) -> State {
        self.state
    }
    /// Counters of a task, in the order of `Image::tasks`.
    pub fn stats(&self) -> impl ExactSizeIterator<Item = &TaskStats> {
        self.tasks.iter().map(|t| &t.stats)
    }
    /// Counters of all tasks together.
    pub fn counts(&self) -> Snapshot {
        self.counts
    }
    /// Counters for another thread, renewed after each scan and each tick of the host.
    pub fn progress(&self) -> Arc<Progress> {
        self.progress.clone()
    }
    /// Faults in order, as records.
    pub fn faults(&self) -> &[FaultRecord] {
        &self.faults
    }
    /// Faults in order, in words.
    pub fn fault_reports(&self) -> Vec<FaultReport> {
        self.faults.iter().map(|f| f.report(&self.image)).collect()
    }

    /// Does the one thing that is due now, if there is one. Runs: cyclic.
    pub fn advance(&mut self, clock: &dyn Clock) -> Step {
        if self.state != State::Running {
            return Step::Ended;
        }
        let now = clock.now();
        if let Some(t) = self.tick(now) {
            return Step::Tick(t);
        }
        if let Some(t) = self.polls.as_mut().and_then(|p| p.take(now)) {
            self.read_inputs(t, self.counts.scans + 1);
            return Step::Poll(t);
        }
        self.tasks.iter_mut().for_each(|t| t.sample(now, &self.memory));
        let ready = self.tasks.iter().enumerate().filter_map(|(i, t)| Some((t.rank(now)?, i)));
        match ready.min() {
            Some((_, task)) => {
                let info = self.scan(task, clock);
                self.progress.publish(&self.counts);
                Step::Scan(info)
            }
            None => Step::Idle(self.next_event()),
        }
    }

    /// One period of the host's cyclic part, if it is due.
    fn tick(&mut self, now: Nanos) -> Option<Nanos> {
        let t = self.ticks.as_mut()?.take(now)?;
        self.host.tick(t);
        self.host.exchange(t, &mut self.memory);
        self.counts.ticks += 1;
        self.progress.publish(&self.counts);
        Some(t)
    }

    /// When something is due next.
    fn next_event(&self) -> Option<Nanos> {
        let timed = self.tasks.iter().filter_map(TaskState::next_release);
        timed.chain([&self.ticks, &self.polls].into_iter().flatten().map(|p| p.next)).min()
    }

    /// Periods of the host that were skipped since the processor was busy.
    pub fn ticks_skipped(&self) -> u64 {
        self.ticks.as_ref().map_or(0, |t| t.skipped)
    }

    /// Runs everything that is due before `deadline` (`None`: for ever), until `stop` is set or `observe`, which is called after each
    /// scan with the memory, returns false. Can be called again to go on, unless the resource has stopped. Runs: cyclic.
    pub fn run_until(
        &mut self,
        clock: &mut dyn Clock,
        deadline: Option<Nanos>,
        stop: &AtomicBool,
        observe: &mut dyn FnMut(&ScanInfo, &[u8]) -> bool,
    ) -> End {
        loop {
            if deadline.is_some_and(|d| clock.now() >= d) {
                return End::Deadline;
            }
            if stop.load(Ordering::Relaxed) {
                return End::Stopped;
            }
            match self.advance(clock) {
                Step::Tick(_) | Step::Poll(_) => {}
                Step::Scan(info) => {
                    let go_on = observe(&info, &self.memory);
                    if self.state == State::Running && !go_on {
                        return End::Stopped;
                    }
                }
                Step::Ended => return self.end(clock),
                Step::Idle(None) => return End::NothingToRun,
                Step::Idle(Some(next)) => {
                    clock.wait_until(deadline.map_or(next, |d| d.min(next)), stop);
                }
            }
        }
    }

    fn end(&mut self, clock: &mut dyn Clock) -> End {
        self.stop(clock);
        if self.state == State::Faulted { End::Faulted } else { End::Stopped }
    }

    /// Ends the run: all outputs go to their safe state, the host stops what moves and ticks on for the time of the options. Does
    /// nothing the second time.
    pub fn stop(&mut self, clock: &mut dyn Clock) {
        self.shut_down(clock.now());
        if self.state == State::Running {
            self.state = State::Stopped;
        }
        let until = clock.now() + std::mem::take(&mut self.options.run_down);
        let never = AtomicBool::new(false);
        while let Some(next) = self.ticks.as_ref().map(|t| t.next).filter(|&t| t < until) {
            clock.wait_until(next, &never);
            self.tick(clock.now());
        }
        self.progress.publish(&self.counts);
    }

    /// Outputs and host to their safe state, once.
    pub(crate) fn shut_down(&mut self, now: Nanos) {
        if std::mem::replace(&mut self.shut, true) {
            return;
        }
        let outputs = &mut self.memory[self.image.memory.outputs.range()];
        self.safe.release_all(outputs);
        self.driver.write_outputs(now, outputs);
        self.host.safe_stop();
    }
}

fn watchdog(options: &Options, task: &str) -> Nanos {
    let own = options.watchdogs.iter().find(|(name, _)| name.eq_ignore_ascii_case(task));
    own.map_or(options.watchdog, |(_, t)| *t)
}
