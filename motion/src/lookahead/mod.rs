//! Look-ahead: gives every path element its speed profile.
//! Runs: background. Invariant: the speed at the end of a released element can be brought to zero within the elements still held back.
//! A plan depends on the program alone: an element is released when [`WINDOW`] others stand behind it or a stop bounds them,
//! never because of timing. From: R1-160..R1-164, CM-50, CM-51.

pub mod joint;
pub mod limits;

pub use limits::{AxisLimits, PathLimits, path_limits};

use crate::geometry::Path;
use crate::profile::trapezoid;
use crate::segment::{Action, Mark, Planned, Segment};
use crate::sync::Special;
use joint::{JOINT_BUDGET, joint};
use std::collections::VecDeque;

/// Elements that the backward pass sees behind the one that it releases.
pub const WINDOW: usize = 256;

/// A path element before planning.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Move {
    /// Geometry; not of zero length.
    pub path: Path,
    /// Programmed speed in mm/s.
    pub feed: f64,
    /// Positioning move.
    pub rapid: bool,
    /// Stop at its end in any case (G61.1).
    pub exact_stop: bool,
    /// mm a revolution of the spindle (G95); 0: none.
    pub per_rev: f64,
}

/// Something in the window.
enum Held {
    Move(Pending),
    Note(Mark, Action),
}

struct Pending {
    mark: Mark,
    m: Move,
    limits: PathLimits,
    /// Highest speed at its start.
    joint_v: f64,
    /// Leaves a share of the acceleration to a joint near by.
    reserve: bool,
    /// Planned speed at its start.
    v_in: f64,
    /// Planned speed at its end.
    v_out: f64,
    /// Both are from a backward pass.
    planned: bool,
}

/// The look-ahead of one channel.
pub struct Planner {
    axes: AxisLimits,
    period: f64,
    window: VecDeque<Held>,
    moves: usize,
    /// Speed at the end of what has been released.
    v_released: f64,
    /// Path length from here on that still leaves a share to the last joint.
    reserve_length: f64,
    out: VecDeque<Planned>,
    run: u32,
    /// Elements before the last one have changed since the last backward pass.
    dirty: bool,
}

impl Planner {
    /// A planner for axes with these limits that are sampled every `period` seconds. `run` marks its output.
    pub fn new(axes: AxisLimits, period: f64, run: u32) -> Self {
        let (window, out) = (VecDeque::with_capacity(WINDOW + 2), VecDeque::new());
        Self { axes, period, window, moves: 0, v_released: 0.0, reserve_length: 0.0, out, run, dirty: true }
    }

    /// Takes a move.
    pub fn push_move(&mut self, mark: Mark, m: Move) {
        if m.path.length <= 0.0 {
            return;
        }
        let limits = path_limits(&m.path, &self.axes, m.feed, 1.0);
        let mut new = Pending { mark, m, limits, joint_v: 0.0, reserve: false, v_in: 0.0, v_out: 0.0, planned: false };
        self.join(&mut new);
        if self.reserve_length > 0.0 {
            self.reserve_length -= m.path.length;
            new.keep_reserve(&self.axes);
        }
        self.window.push_back(Held::Move(new));
        self.moves += 1;
        if self.moves > WINDOW {
            self.plan();
            self.release_one();
        }
    }

    /// Takes anything else. What stops the path is the end of the window; the rest goes along with the moves.
    pub fn push(&mut self, mark: Mark, action: Action) {
        if action.is_stop() || self.moves == 0 {
            self.flush();
            self.emit(mark, action);
        } else {
            self.window.push_back(Held::Note(mark, action));
        }
    }

    /// Takes a move from rest to rest that does more than moving.
    pub fn push_special(&mut self, mark: Mark, m: Move, special: Special) {
        self.flush();
        let PathLimits { v, a } = path_limits(&m.path, &self.axes, m.feed, 1.0);
        let profile = trapezoid(m.path.length, 0.0, 0.0, v, a, a);
        let segment = Segment { path: m.path, profile, accel: a, feed: m.feed, rapid: false, per_rev: 0.0 };
        self.emit(mark, Action::Special(segment, special));
    }

    /// The path stops here: releases everything.
    pub fn flush(&mut self) {
        self.plan();
        while !self.window.is_empty() {
            self.release_one();
        }
        self.v_released = 0.0;
        self.reserve_length = 0.0;
        self.dirty = true;
    }

    /// The next released step.
    pub fn pop(&mut self) -> Option<Planned> {
        self.out.pop_front()
    }

    /// True if a released step waits.
    pub fn has_output(&self) -> bool {
        !self.out.is_empty()
    }

    /// Puts a step back that did not fit the ring.
    pub fn unpop(&mut self, step: Planned) {
        self.out.push_front(step);
    }

    fn emit(&mut self, mark: Mark, action: Action) {
        self.out.push_back(Planned { run: self.run, mark, action });
    }

    /// Speed at the start of `new`, and the reserve round a joint with a jump.
    fn join(&mut self, new: &mut Pending) {
        let Some(last) = self.window.iter().rev().find_map(Held::as_move) else { return };
        if last.m.exact_stop {
            return;
        }
        let v = last.limits.v.min(new.limits.v);
        let joint = joint(&last.m.path, &new.m.path, &self.axes, self.period, v);
        new.joint_v = joint.v;
        if joint.jump && joint.v > 0.0 {
            // Within one period of the joint its jump and the acceleration fall into one sample.
            self.reserve_length = self.period * new.limits.v + new.m.path.length;
            self.reserve_back(joint.v);
        }
    }

    fn reserve_back(&mut self, v: f64) {
        self.dirty = true;
        let mut length = 0.0;
        for held in self.window.iter_mut().rev() {
            let Held::Move(p) = held else { continue };
            p.keep_reserve(&self.axes);
            length += p.m.path.length;
            if length > self.period * p.limits.v.max(v) {
                return;
            }
        }
    }

    /// Backward pass (R1-160): from rest at the end of the window. A joint is no faster than either of its elements.
    // A new element rarely changes more than the last few: where a start speed stays what it was, so does everything before it.
    fn plan(&mut self) {
        let mut next = 0.0f64;
        for held in self.window.iter_mut().rev() {
            let Held::Move(p) = held else { continue };
            let v_out = next.min(p.limits.v);
            let v_in = (v_out * v_out + 2.0 * p.limits.a * p.m.path.length).sqrt().min(p.joint_v).min(p.limits.v);
            if !self.dirty && (v_in, v_out) == (p.v_in, p.v_out) && p.planned {
                break;
            }
            (p.v_in, p.v_out, p.planned) = (v_in, v_out, true);
            next = v_in;
        }
        self.dirty = false;
    }

    /// Forward pass (R1-161), one element: its start speed is given, its end speed what it can reach.
    fn release_one(&mut self) {
        match self.window.pop_front() {
            Some(Held::Note(mark, action)) => self.emit(mark, action),
            Some(Held::Move(p)) => {
                self.moves -= 1;
                let (v_in, length, a) = (self.v_released, p.m.path.length, p.limits.a);
                let v_out = p.v_out.min((v_in * v_in + 2.0 * a * length).sqrt());
                // A reserve that came late may have made the end speed unreachable; never ask for more than the limit.
                let least_v2 = v_in * v_in - 2.0 * a * length;
                let v_out = if least_v2 > v_out * v_out + 1e-9 * v_in * v_in { least_v2.sqrt() } else { v_out };
                let profile = trapezoid(length, v_in, v_out, p.limits.v, a, a);
                let feed = if p.m.rapid { p.limits.v } else { p.m.feed };
                self.v_released = v_out;
                self.emit(
                    p.mark,
                    Action::Move(Segment { path: p.m.path, profile, accel: a, feed, rapid: p.m.rapid, per_rev: p.m.per_rev }),
                );
                self.release_notes();
            }
            None => {}
        }
    }

    /// Notes behind a released move go with it.
    fn release_notes(&mut self) {
        while let Some(Held::Note(..)) = self.window.front() {
            if let Some(Held::Note(mark, action)) = self.window.pop_front() {
                self.emit(mark, action);
            }
        }
    }
}

impl Held {
    fn as_move(&self) -> Option<&Pending> {
        match self {
            Held::Move(p) => Some(p),
            Held::Note(..) => None,
        }
    }
}

impl Pending {
    fn keep_reserve(&mut self, axes: &AxisLimits) {
        if !self.reserve {
            self.reserve = true;
            self.limits = path_limits(&self.m.path, axes, self.m.feed, 1.0 - JOINT_BUDGET);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps(moves: &[(f64, f64, f64)], axes: AxisLimits) -> Vec<Segment> {
        let mut planner = Planner::new(axes, 0.001, 1);
        let mut at = [0.0; 6];
        for &(x, y, feed) in moves {
            let end = [x, y, 0., 0., 0., 0.];
            planner.push_move(
                Mark::default(),
                Move { path: Path::line(at, end), feed, rapid: false, exact_stop: false, per_rev: 0.0 },
            );
            at = end;
        }
        planner.flush();
        std::iter::from_fn(|| planner.pop()).filter_map(|p| if let Action::Move(s) = p.action { Some(s) } else { None }).collect()
    }

    /// O-32 b, c: speed over a straight joint is the lower feed.
    #[test]
    fn pairs_of_blocks() {
        let axes = AxisLimits::uniform(1000.0, 1000.0);
        let s = steps(&[(20., 0., 100.), (30., 0., 50.)], axes);
        let times: Vec<_> = s.iter().flat_map(|s| [s.profile.t_acc, s.profile.t_const, s.profile.t_dec]).collect();
        for (got, want) in times.iter().zip([0.1, 0.1125, 0.05, 0.0, 0.175, 0.05]) {
            assert!((got - want).abs() < 1e-9, "{times:?}");
        }
        let s = steps(&[(10., 0., 50.), (30., 0., 100.)], axes);
        let times: Vec<_> = s.iter().flat_map(|s| [s.profile.t_acc, s.profile.t_const, s.profile.t_dec]).collect();
        for (got, want) in times.iter().zip([0.05, 0.175, 0.0, 0.05, 0.1125, 0.1]) {
            assert!((got - want).abs() < 1e-9, "{times:?}");
        }
    }

    /// R1-160..R1-163: a thousand short blocks in a row are one long one to the axes.
    #[test]
    fn long_chain_keeps_speed_and_can_always_stop() {
        let moves: Vec<_> = (1..=1000).map(|k| (f64::from(k) * 0.05, 0., 100.)).collect();
        let s = steps(&moves, AxisLimits::uniform(200.0, 1000.0));
        assert_eq!(s.len(), 1000);
        assert!((s[500].profile.v_peak - 100.0).abs() < 1e-9);
        assert_eq!(s.last().map(|s| s.profile.v_out), Some(0.0));
        for pair in s.windows(2) {
            assert_eq!(pair[0].profile.v_out, pair[1].profile.v_in);
        }
    }
}
