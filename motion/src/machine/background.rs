//! Who runs the feeders: the caller of `tick`, a thread, or somebody who calls `pump`.
//! Runs: background.

use crate::feeder::{Environment, Feeder, Reader};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

/// Where part programs are read.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Background {
    /// At the start of each tick: virtual time, deterministic.
    Inline,
    /// In a thread of its own: real time.
    Thread,
    /// By calls of [`super::Machine::pump`].
    Manual,
}

/// All feeders with what they read from.
pub struct Pump {
    /// One a channel.
    pub feeders: Vec<Feeder>,
    /// Files and PLC variables.
    pub environment: Environment,
    /// Part programs to commands.
    pub reader: Reader,
}

impl Pump {
    /// Does what can be done now; false if there was nothing.
    pub fn pump(&mut self) -> bool {
        let (environment, reader) = (&self.environment, &self.reader);
        self.feeders.iter_mut().map(|f| f.pump(environment, reader)).fold(false, |any, busy| any | busy)
    }

    /// The end: what came last is obeyed, and what has changed is stored.
    fn close(&mut self) {
        self.pump();
        self.feeders.iter_mut().for_each(|f| f.close(&self.environment));
    }
}

/// The running background half.
pub enum Half {
    /// Pumped by its owner; the flag says that `tick` does it.
    Own(Box<Pump>, bool),
    /// A thread, joined on drop.
    Thread(Arc<AtomicBool>, Option<JoinHandle<()>>),
}

/// Sleep of an idle thread: short against the 256 segments that it works ahead.
const IDLE: Duration = Duration::from_micros(500);

impl Half {
    /// Starts it.
    pub fn start(pump: Pump, background: Background) -> Self {
        match background {
            Background::Inline => Half::Own(Box::new(pump), true),
            Background::Manual => Half::Own(Box::new(pump), false),
            Background::Thread => {
                let stop = Arc::new(AtomicBool::new(false));
                let seen = stop.clone();
                let handle = std::thread::Builder::new().name("takt-feeder".to_owned()).spawn(move || run(pump, &seen));
                Half::Thread(stop, handle.ok())
            }
        }
    }
}

fn run(mut pump: Pump, stop: &AtomicBool) {
    while !stop.load(Ordering::Acquire) {
        if !pump.pump() {
            std::thread::sleep(IDLE);
        }
    }
    pump.close();
}

impl Drop for Half {
    fn drop(&mut self) {
        match self {
            Half::Own(pump, _) => pump.close(),
            Half::Thread(stop, handle) => {
                stop.store(true, Ordering::Release);
                if let Some(handle) = handle.take() {
                    let _ = handle.join();
                }
            }
        }
    }
}
