//! Probing: a move that ends where the probe changes, or at its end.
//! Runs: cyclic. Whoever sees the probe calls [`PathExecutor::trip`]; the path brakes, and the rest of the move is dropped.
//! From: G38.2 .. G38.5 of LinuxCNC, R1-84 (the position at the edge is kept), N4.

use super::{Current, Demand, Pace, PathExecutor};
use crate::canon::Probe;
use crate::geometry::{Path, Point};
use crate::segment::Segment;

/// A probe move under way.
#[derive(Clone, Copy, Debug)]
pub struct ProbeMove {
    probe: Probe,
    trip: Option<Point>,
    /// The path stands, with or without a trip.
    done: bool,
    refused: bool,
}

/// A probe move that has ended.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Probed {
    /// What was wanted.
    pub probe: Probe,
    /// Position at the edge.
    pub trip: Option<Point>,
    /// Where the path stands.
    pub stop: Point,
    /// It did not begin: the probe was in contact already, or not at all.
    pub refused: bool,
}

impl PathExecutor {
    /// The probe move under way that looks for an edge.
    pub fn probing(&self) -> Option<Probe> {
        self.probe.filter(|p| p.trip.is_none() && !p.done).map(|p| p.probe)
    }

    /// The probe has changed, at this position.
    pub fn trip(&mut self, at: Point) {
        if let Some(probe) = &mut self.probe {
            probe.trip = probe.trip.or(Some(at));
        }
    }

    /// The end of a probe move, once.
    pub fn take_probed(&mut self) -> Option<Probed> {
        let p = self.probe.filter(|p| p.done)?;
        self.probe = None;
        Some(Probed { probe: p.probe, trip: p.trip, stop: self.position, refused: p.refused })
    }

    pub(super) fn has_tripped(&self) -> bool {
        self.probe.is_some_and(|p| p.trip.is_some())
    }

    /// A probe that has nothing to look for is refused: nothing moves.
    pub(super) fn start_probe(&mut self, segment: Segment, probe: Probe, demand: &Demand) {
        let refused = demand.contact == probe.towards;
        self.probe = Some(ProbeMove { probe, trip: None, done: refused, refused });
        if refused {
            self.primed = false;
        } else {
            self.start(segment);
        }
    }

    /// The path stands behind a trip, or the move is at its end.
    pub(super) fn end_probe(&mut self) {
        let Some(mut probe) = self.probe else { return };
        let stands = probe.trip.is_some() && self.pace == Pace::Free(0.0);
        if stands && let Some(Current { segment, s, .. }) = self.current.take() {
            self.position = segment.path.at(s);
            self.feed_mm += s;
            // What was executed is the part up to here; it ended at rest.
            self.remember(Segment { path: Path::line(segment.path.start, self.position), ..segment });
        }
        if self.current.is_none() {
            probe.done = true;
            self.probe = Some(probe);
            self.primed = false;
        }
    }
}
