//! Reference pulses: a path as single steps of one basic length unit (BLU), one iteration of a software DDA a time step.
//! Runs: `moves` in the background, [`dda`] and [`executor`] cyclic. From: PC-10..PC-13, PC-20..PC-25.

pub mod dda;
pub mod executor;

pub use executor::PulseExecutor;

use crate::geometry::{Path, Shape};
use takt_base::Code;

/// A move in BLU.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PulseMove {
    /// What to interpolate.
    pub kind: PulseKind,
    /// Iterations a second: F / (60 * BLU) (PC-10).
    pub frequency: f64,
    /// Length of the path that counts as feed; 0 for positioning.
    pub feed_mm: f64,
}

/// Which routine makes the pulses.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum PulseKind {
    /// Straight to the increments (PC-20).
    Line([i64; 3]),
    /// Part of a circle in the plane of two axes (PC-21).
    Arc(PulseArc),
    /// Each axis on its own to the increments (PC-24).
    Position([i64; 3]),
}

/// An arc relative to its centre.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct PulseArc {
    /// First and second axis of the plane.
    pub axes: [usize; 2],
    /// Start point.
    pub start: [i64; 2],
    /// End point.
    pub end: [i64; 2],
    /// From first to second axis.
    pub ccw: bool,
    /// Whole turns before the end point counts.
    pub turns: u32,
}

/// Turns a path into pulses.
pub fn pulse_move(path: &Path, rapid: bool, speed_mm_s: f64, blu_mm: f64) -> Result<PulseMove, Code> {
    let grid = |mm: f64| blu(mm, blu_mm);
    let step = |i: usize| Ok(grid(path.end[i])?.saturating_sub(grid(path.start[i])?));
    let d = [step(0)?, step(1)?, step(2)?];
    if (3..path.end.len()).any(|i| path.end[i] != path.start[i]) {
        return Err(Code::UnknownReference);
    }
    let kind = match &path.shape {
        _ if rapid => PulseKind::Position(d),
        Shape::Line => PulseKind::Line(d),
        Shape::Arc(arc) => {
            let (i, j) = (arc.first, arc.second);
            if d[3 - i - j] != 0 {
                return Err(Code::UnknownCode);
            }
            let centre = [grid(arc.centre[0])?, grid(arc.centre[1])?];
            let relative = |p: &[f64; 6]| Ok([grid(p[i])?.saturating_sub(centre[0]), grid(p[j])?.saturating_sub(centre[1])]);
            let turns = (arc.sweep.abs() / std::f64::consts::TAU - 1e-9).floor().max(0.0) as u32;
            let (start, end) = (relative(&path.start)?, relative(&path.end)?);
            PulseKind::Arc(PulseArc { axes: [i, j], start, end, ccw: arc.sweep > 0.0, turns })
        }
    };
    Ok(PulseMove { kind, frequency: speed_mm_s / blu_mm, feed_mm: if rapid { 0.0 } else { path.length } })
}

/// Millimetres as a whole number of BLU; nothing is rounded away silently.
pub fn blu(mm: f64, blu_mm: f64) -> Result<i64, Code> {
    let n = (mm / blu_mm).round();
    if n.is_nan() || n.abs() >= 1e15 || (n * blu_mm - mm).abs() > 1e-6 * blu_mm.max(1.0) {
        Err(Code::NotOnGrid)
    } else {
        Ok(n as i64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// PC-10: the table of feed, BLU and frequency.
    #[test]
    fn pc_10_frequencies() {
        let path = Path::line([0.0; 6], [2000., 0., 0., 0., 0., 0.]);
        for (f, blu, hz) in [
            (60000., 2., 500.),
            (60000., 1., 1e3),
            (60000., 0.1, 1e4),
            (60000., 0.01, 1e5),
            (60000., 0.001, 1e6),
            (600., 0.01, 1e3),
        ] {
            let m = pulse_move(&path, false, f / 60.0, blu).unwrap();
            assert!((m.frequency / hz - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn off_grid_is_an_error() {
        let path = Path::line([0.0; 6], [0.5, 0., 0., 0., 0., 0.]);
        assert_eq!(pulse_move(&path, false, 1.0, 1.0), Err(Code::NotOnGrid));
    }
}
