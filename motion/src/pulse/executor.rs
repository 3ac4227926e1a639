//! Runs pulse moves at their frequency: several iterations a tick where the tick is longer than 1/f (PC-11, PC-13).
//! Runs: cyclic. No allocation; a tick makes at most `max_batch` iterations, and what does not fit is refused by the reader.

use super::PulseMove;
use super::dda::{Dda, Preload, Pulse};

/// A move in progress and the time that it has earned.
#[derive(Clone, Debug)]
pub struct PulseExecutor {
    dda: Option<(Dda, f64)>,
    preload: Preload,
    /// Seconds earned but not yet spent on an iteration.
    credit: f64,
    /// Most iterations in one tick so far (PC-13).
    pub batch_max: u32,
    /// Iterations in all.
    pub iterations: u64,
    batch: u32,
}

/// Rounding of the sum of many short times.
const EPSILON_S: f64 = 1e-12;

impl PulseExecutor {
    /// At rest.
    pub fn new(preload: Preload) -> Self {
        Self { dda: None, preload, credit: 0.0, batch_max: 0, iterations: 0, batch: 0 }
    }

    /// Begins a move.
    pub fn start(&mut self, m: &PulseMove) {
        self.dda = Some((Dda::new(m, self.preload), 1.0 / m.frequency));
    }

    /// True while a move is in progress.
    pub fn is_busy(&self) -> bool {
        self.dda.is_some()
    }

    /// A tick of `dt` seconds begins. A path at rest starts without credit from the past.
    pub fn begin_tick(&mut self, dt: f64) {
        self.batch = 0;
        self.credit += dt;
    }

    /// The time of this tick is given up: nothing to do, or held.
    pub fn rest(&mut self) {
        self.credit = 0.0;
    }

    /// The move is dropped.
    pub fn abort(&mut self) {
        self.dda = None;
        self.credit = 0.0;
    }

    /// The next pulse that is due in this tick. `None`: the time is used up, or the move has ended ([`Self::is_busy`]).
    pub fn next_pulse(&mut self) -> Option<Pulse> {
        let (dda, period) = self.dda.as_mut()?;
        if self.credit < *period - EPSILON_S {
            return None;
        }
        let Some(pulse) = dda.step() else {
            self.dda = None;
            return None;
        };
        self.credit -= *period;
        self.iterations += 1;
        self.batch += 1;
        self.batch_max = self.batch_max.max(self.batch);
        Some(pulse)
    }
}
