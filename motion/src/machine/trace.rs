//! Set and actual positions, a row a tick, from the first motion on.
//! Runs: cyclic. The memory is taken at the start; when it is full the trace ends and says so.

use crate::axis::Axis;
use takt_base::Nanos;

/// Recorded positions.
#[derive(Clone, Debug)]
pub struct Trace {
    axes: usize,
    rows_max: usize,
    times: Vec<Nanos>,
    values: Vec<f64>,
    full: bool,
}

/// One row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<'a> {
    /// When.
    pub time: Nanos,
    /// Set and actual position in mm of each axis: set 0, actual 0, set 1, ...
    pub values: &'a [f64],
}

impl Trace {
    /// Room for `rows_max` ticks of `axes` axes.
    pub fn new(axes: usize, rows_max: usize) -> Self {
        let values = Vec::with_capacity(rows_max.saturating_mul(2 * axes));
        Self { axes, rows_max, times: Vec::with_capacity(rows_max), values, full: false }
    }

    /// Takes a row, if it has begun to move.
    pub fn record(&mut self, now: Nanos, axes: &[Axis]) {
        if self.times.is_empty() && !axes.iter().any(Axis::is_moving) {
            return;
        }
        if self.times.len() == self.rows_max {
            self.full = true;
            return;
        }
        self.times.push(now);
        for axis in axes.iter().take(self.axes) {
            self.values.push(axis.set_position());
            self.values.push(axis.actual_position());
        }
    }

    /// True if ticks are missing at the end.
    pub fn is_full(&self) -> bool {
        self.full
    }

    /// Ticks recorded.
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// True if nothing has moved.
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// The rows in order.
    pub fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        let values = self.values.chunks(2 * self.axes.max(1));
        self.times.iter().zip(values).map(|(&time, values)| Row { time, values })
    }
}
