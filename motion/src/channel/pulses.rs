//! Reference-pulse side of a channel: executor, step driver, position by counting.
//! Runs: cyclic. From: PC-07, PC-13, PC-37. There is no acceleration here: a hold stops between two pulses.

use crate::drive::parport::{SimulatedPort, StepDriver};
use crate::geometry::{AXES, Point};
use crate::machine::config::ChannelMode;
use crate::pulse::{PulseExecutor, PulseMove};

/// Step output of a channel.
#[derive(Clone, Debug)]
pub struct PulseOutput {
    /// The driver with the simulated device.
    pub driver: StepDriver<SimulatedPort>,
    executor: PulseExecutor,
    blu_mm: f64,
    counts: [i64; 3],
    start: Point,
    held: bool,
    current_mm: f64,
    /// Feed path length so far in mm.
    pub feed_mm: f64,
}

impl PulseOutput {
    /// For a channel in reference-pulse mode.
    pub fn new(mode: &ChannelMode) -> Option<Self> {
        let ChannelMode::ReferencePulse { blu_mm, preload, record_max, .. } = *mode else { return None };
        Some(Self {
            driver: StepDriver::new(SimulatedPort::default(), record_max),
            executor: PulseExecutor::new(preload),
            blu_mm,
            counts: [0; 3],
            start: [0.0; AXES],
            held: false,
            current_mm: 0.0,
            feed_mm: 0.0,
        })
    }

    /// A run begins at this position.
    pub fn reset(&mut self, position: Point) {
        self.executor.abort();
        self.start = position;
        self.counts = std::array::from_fn(|i| (position[i] / self.blu_mm).round() as i64);
        self.feed_mm = 0.0;
    }

    /// Begins a move.
    pub fn start(&mut self, m: &PulseMove) {
        self.executor.start(m);
        self.current_mm = m.feed_mm;
    }

    /// A tick begins.
    pub fn begin_tick(&mut self, dt: f64) {
        self.executor.begin_tick(dt);
    }

    /// Makes the pulses that are due. True if the move has ended and there is time left.
    pub fn advance(&mut self, hold: bool) -> bool {
        self.held = hold;
        if !self.executor.is_busy() {
            return true;
        }
        if hold {
            self.executor.rest();
            return false;
        }
        while let Some(pulse) = self.executor.next_pulse() {
            self.driver.pulse(&pulse);
            pulse.count(&mut self.counts);
        }
        let ended = !self.executor.is_busy();
        if ended {
            self.feed_mm += self.current_mm;
        }
        ended
    }

    /// Nothing to do: time does not count.
    pub fn rest(&mut self) {
        self.executor.rest();
    }

    /// Drops the move.
    pub fn abort(&mut self) {
        self.executor.abort();
    }

    /// A move is in progress.
    pub fn is_busy(&self) -> bool {
        self.executor.is_busy()
    }
    /// It waits for the end of a hold.
    pub fn is_held(&self) -> bool {
        self.held
    }
    /// Most iterations in one tick so far (PC-13), and iterations in all.
    pub fn batch(&self) -> (u32, u64) {
        (self.executor.batch_max, self.executor.iterations)
    }
    /// Position as counted pulses (PC-37).
    pub fn position(&self) -> Point {
        std::array::from_fn(|i| if i < 3 { self.counts[i] as f64 * self.blu_mm } else { self.start[i] })
    }
}
