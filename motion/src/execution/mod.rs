//! Interpolation: planned elements become positions at the servo period, in closed form.
//! Runs: cyclic. No allocation; a tick passes at most [`QUEUE`] elements.
//! Invariant: the path speed is never above the planned one. Without hold and override it is the planned one; they cap it, and the
//! path is kept with at most the path acceleration of each element. From: R1-116, R1-165, CM-23, scenario S40.

mod blocks;
mod follow;
mod pace;
mod probe;
mod ramp;

pub use probe::Probed;

use crate::geometry::Point;
use crate::segment::{Action, Mark, Planned, Segment, Switch};
use follow::Follow;
use probe::ProbeMove;
use std::collections::VecDeque;
use takt_base::ring::Rx;

/// Elements that wait behind the ring.
pub const QUEUE: usize = 1024;
/// Elements taken from the ring in one tick.
const FILL: usize = 256;
/// Elements that must wait before a program starts, unless it is shorter.
const PRIMED: usize = 512;
/// Elements kept for the path deviation.
pub const HISTORY: usize = 64;
/// Length of path behind the current position in which the actual position is looked for, and the least number of elements.
const BEHIND: (f64, usize) = (5.0, 4);

/// What the operator and the PLC program want, as shares of the programmed speed.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Demand {
    /// Override of feed moves, 0..=1.
    pub feed: f64,
    /// Override of positioning moves, 0..=1.
    pub rapid: f64,
    /// Stop on the path.
    pub hold: bool,
    /// Stop on the path whatever is going on: threads and probing do not obey a hold.
    pub abort: bool,
    /// Share that M52 lets through.
    pub adaptive: f64,
    /// Hold that M53 lets through.
    pub feed_hold: bool,
    /// The probe is in contact.
    pub contact: bool,
    /// Stop at the end of each block.
    pub single: bool,
    /// Encoder of the spindle in revolutions.
    pub spindle_rev: f64,
    /// Its speed in rev/s, signed.
    pub spindle_rps: f64,
    /// 1 for M3, -1 for M4: it may stand still as yet.
    pub spindle_sense: f64,
}

impl Default for Demand {
    fn default() -> Self {
        Self {
            feed: 1.0,
            rapid: 1.0,
            hold: false,
            abort: false,
            adaptive: 1.0,
            feed_hold: false,
            contact: false,
            single: false,
            spindle_rev: 0.0,
            spindle_rps: 0.0,
            spindle_sense: 1.0,
        }
    }
}

/// How far a call of [`PathExecutor::advance`] got.
#[derive(Clone, Copy, PartialEq, Debug)]
#[allow(clippy::large_enum_variant)] // it lives for one call, on the stack
pub enum Reached {
    /// The time is used up.
    Time,
    /// There is nothing to do.
    Nothing,
    /// A block has ended, and the next one is not to begin.
    Block,
    /// This comes next and is not for the path; so many seconds of the tick are left.
    Action(Planned, f64),
}

/// A planned element being executed.
#[derive(Clone, Copy, Debug)]
struct Current {
    segment: Segment,
    /// Path time in seconds; valid while following.
    tau: f64,
    /// Path length from its start.
    s: f64,
}

/// How the path speed relates to the planned one.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Pace {
    /// It is the planned one: path time runs with real time.
    Plan,
    /// It is this, in mm/s, and below the plan: on the way to a cap, at a cap, or on the way back.
    Free(f64),
}

/// The cyclic end of a channel's path.
pub struct PathExecutor {
    queue: VecDeque<Planned>,
    queued_mm: f64,
    accel_min: f64,
    current: Option<Current>,
    dwell_s: f64,
    pace: Pace,
    feed_override: bool,
    adaptive: bool,
    feed_hold: bool,
    follow: Option<Follow>,
    probe: Option<ProbeMove>,
    /// The spindle has to turn the other way round.
    reversal: bool,
    /// A block was begun since the last stop at the end of one.
    begun: bool,
    primed: bool,
    position: Point,
    history: [Option<Segment>; HISTORY],
    history_next: usize,
    /// Length executed, feed moves alone.
    pub feed_mm: f64,
    /// Blocks of the part program that were begun.
    pub blocks: u32,
    /// Ticks in which the path braked or stood because the background had fallen behind.
    pub late_ticks: u32,
    last: Mark,
}

impl PathExecutor {
    /// At rest at `position`.
    pub fn new(position: Point) -> Self {
        Self::standing(position, VecDeque::with_capacity(QUEUE))
    }

    fn standing(position: Point, queue: VecDeque<Planned>) -> Self {
        Self {
            queue,
            queued_mm: 0.0,
            accel_min: f64::INFINITY,
            current: None,
            dwell_s: 0.0,
            pace: Pace::Plan,
            feed_override: true,
            adaptive: false,
            feed_hold: true,
            follow: None,
            probe: None,
            reversal: false,
            begun: false,
            primed: false,
            position,
            history: [None; HISTORY],
            history_next: 0,
            feed_mm: 0.0,
            blocks: 0,
            late_ticks: 0,
            last: Mark::default(),
        }
    }

    /// Forgets everything and stands at `position`.
    pub fn reset(&mut self, position: Point) {
        self.queue.clear();
        *self = Self::standing(position, std::mem::take(&mut self.queue)); // the queue keeps its memory
    }

    /// Drops what is left of a program; the place and the figures stay.
    pub fn halt(&mut self) {
        self.queue.clear();
        self.queued_mm = 0.0;
        self.current = None;
        self.follow = None;
        self.probe = None;
        self.dwell_s = 0.0;
    }

    /// Takes what the look-ahead has released for `run`.
    pub fn fill(&mut self, ring: &mut Rx<Planned>, run: u32) {
        for _ in 0..FILL.min(QUEUE - self.queue.len()) {
            let Some(step) = ring.pop() else { return };
            if step.run == run {
                self.accept(step);
            }
        }
    }

    fn accept(&mut self, step: Planned) {
        if let Action::Move(segment) = &step.action {
            self.queued_mm += segment.path.length;
            self.accel_min = self.accel_min.min(segment.accel);
        }
        self.queue.push_back(step);
    }

    /// Position now.
    pub fn position(&self) -> Point {
        self.position
    }

    /// Path speed now, mm/s.
    pub fn speed(&self) -> f64 {
        if let Some(follow) = &self.follow {
            return follow.speed().abs();
        }
        match (self.pace, &self.current) {
            (_, None) => 0.0,
            (Pace::Plan, Some(c)) => c.segment.profile.v(c.tau),
            (Pace::Free(w), Some(_)) => w,
        }
    }

    /// True if the path stands still and would not move on this demand.
    pub fn is_held(&self) -> bool {
        self.current.is_none() || self.follow.as_ref().map_or(self.pace == Pace::Free(0.0), Follow::is_stopped)
    }

    /// Place in the part program: what was begun last.
    pub fn mark(&self) -> Mark {
        self.last
    }

    /// Rest of the current element in mm.
    pub fn distance_to_go(&self) -> f64 {
        self.current.as_ref().map_or(0.0, |c| (c.segment.path.length - c.s).max(0.0))
    }

    /// Distance of a point from the path at and behind the current position, in mm; infinite without a path, and
    /// in rigid tapping, which goes as far as the spindle takes it.
    pub fn deviation(&self, p: &Point) -> f64 {
        if self.follow.as_ref().is_some_and(Follow::is_tap) {
            return f64::INFINITY;
        }
        let current = self.current.as_ref().map(|c| &c.segment);
        let newest_first = (1..=HISTORY).map_while(|k| self.history[(self.history_next + HISTORY - k) % HISTORY].as_ref());
        let (mut nearest, mut behind) = (f64::INFINITY, 0.0);
        for (n, segment) in current.into_iter().chain(newest_first).enumerate() {
            nearest = nearest.min(segment.path.distance_to(p));
            behind += segment.path.length;
            if n >= BEHIND.1 && behind > BEHIND.0 {
                break;
            }
        }
        nearest
    }

    /// Moves on by `dt` seconds, or up to the next action that is not for the path.
    pub fn advance(&mut self, dt: f64, demand: &Demand) -> Reached {
        let starved = self.is_starved(dt);
        let reached = self.walk(dt, demand, starved);
        if let Some(c) = self.current.as_ref().filter(|_| self.follow.is_none()) {
            self.position = c.segment.path.at(c.s);
        }
        let waits = self.primed && self.queue.is_empty() && !demand.hold && matches!(reached, Reached::Nothing);
        self.late_ticks = self.late_ticks.saturating_add(u32::from(starved || waits));
        reached
    }

    /// The path has to stand: a hold, or the feed hold where M53 lets it count.
    fn holds(&self, demand: &Demand) -> bool {
        demand.hold || (demand.feed_hold && self.feed_hold)
    }

    fn walk(&mut self, dt: f64, demand: &Demand, starved: bool) -> Reached {
        let mut left = dt;
        for _ in 0..4 * QUEUE {
            if left <= 0.0 {
                return Reached::Time;
            }
            if self.dwell_s > 0.0 {
                left = self.dwell(left, self.holds(demand));
            } else if self.follow.is_some() {
                left = self.follow_step(left, demand);
            } else if self.current.is_some() {
                let cap = self.cap(demand, starved);
                left = match self.brake_to_block_end(left, cap, demand) {
                    Some(rest) => rest,
                    None => self.step(left, cap),
                };
                self.end_probe();
            } else {
                match self.next(demand) {
                    Next::Started => {}
                    Next::Nothing => return Reached::Nothing,
                    Next::Block => return Reached::Block,
                    Next::Other(step) => return Reached::Action(step, left),
                }
            }
        }
        Reached::Time
    }

    /// True if what is queued could be too short to stop in: the background has fallen behind.
    fn is_starved(&self, dt: f64) -> bool {
        let bounded = match self.queue.back() {
            Some(Planned { action: Action::Move(s), .. }) => s.profile.v_out == 0.0,
            Some(step) => step.action.is_stop(),
            None => self.current.as_ref().is_none_or(|c| c.segment.profile.v_out == 0.0),
        };
        let v = self.speed() + self.accel_min.min(1e12) * dt;
        !bounded
            && self.queue.len() < QUEUE / 2
            && self.distance_to_go() + self.queued_mm < v * v / (2.0 * self.accel_min) + v * dt
    }

    /// Highest path speed that is wanted now: the override is a share of the programmed speed.
    fn cap(&self, demand: &Demand, starved: bool) -> f64 {
        let Some(c) = &self.current else { return f64::INFINITY };
        let (rapid, feed) = (c.segment.rapid, c.segment.feed);
        if self.probe.is_some() {
            return if demand.abort || starved || self.has_tripped() { 0.0 } else { f64::INFINITY };
        }
        let share = if rapid {
            demand.rapid
        } else if self.feed_override {
            demand.feed
        } else {
            1.0
        };
        let share = if self.adaptive { share * demand.adaptive } else { share };
        let hold = self.holds(demand);
        let cap = match share.clamp(0.0, 1.0) {
            _ if hold || starved => 0.0,
            // Without an override nothing is capped, not even by rounding.
            1.0 => f64::INFINITY,
            share => share * feed,
        };
        // G95: no more than the spindle gives.
        if c.segment.per_rev > 0.0 { cap.min(c.segment.per_rev * demand.spindle_rps.abs() * share.clamp(0.0, 1.0)) } else { cap }
    }

    fn dwell(&mut self, left: f64, hold: bool) -> f64 {
        if hold {
            return 0.0;
        }
        let used = left.min(self.dwell_s);
        self.dwell_s -= used;
        left - used
    }

    fn next(&mut self, demand: &Demand) -> Next {
        if !self.primed && self.queue.len() < PRIMED && !self.queue.iter().any(|s| s.action.is_stop()) {
            return Next::Nothing;
        }
        self.primed = true;
        let hold = self.holds(demand);
        if self.queue.front().is_none_or(|step| hold && self.speed_in(step) == 0.0) {
            return Next::Nothing;
        }
        if demand.single && self.at_block_end() {
            return Next::Block;
        }
        if self.thread_is_incomplete() {
            return Next::Nothing;
        }
        let Some(step) = self.queue.pop_front() else { return Next::Nothing };
        self.count(step.mark);
        match step.action {
            Action::Move(segment) => {
                self.queued_mm -= segment.path.length;
                self.start(segment);
            }
            Action::Special(segment, special) => self.start_special(segment, special, demand),
            Action::Dwell(seconds) => self.dwell_s = seconds,
            Action::Switch(Switch::Feed, on) => self.feed_override = on,
            Action::Switch(Switch::Adaptive, on) => self.adaptive = on,
            Action::Switch(Switch::FeedHold, on) => self.feed_hold = on,
            _ => {
                // What comes behind an answer has not been read yet: it is waited for as at the start.
                self.primed &= !step.action.is_question();
                return Next::Other(step);
            }
        }
        Next::Started
    }

    /// Speed at which the path enters a step. What is not a move goes along with the moves round it.
    fn speed_in(&self, step: &Planned) -> f64 {
        match (&step.action, self.pace) {
            (Action::Move(segment), _) => segment.profile.v_in,
            (action, _) if action.is_stop() => 0.0,
            (_, Pace::Free(w)) => w,
            (_, Pace::Plan) => self.history_v_out(),
        }
    }

    /// Planned speed at the end of the element before.
    fn history_v_out(&self) -> f64 {
        let last = (self.history_next + HISTORY - 1) % HISTORY;
        self.history[last].as_ref().map_or(0.0, |s| s.profile.v_out)
    }

    /// What was executed is no measure any more for where the actual position may be.
    fn forget_history(&mut self) {
        self.history = [None; HISTORY];
    }

    fn count(&mut self, mark: Mark) {
        if mark.block != self.last.block && mark.block != 0 {
            self.blocks += 1;
        }
        self.begun |= mark.block != 0;
        self.last = mark;
    }

    fn start(&mut self, segment: Segment) {
        self.current = Some(Current { segment, tau: 0.0, s: 0.0 });
        if let Pace::Free(w) = &mut self.pace {
            *w = w.min(segment.profile.v_in);
        }
        if segment.profile.v_in == 0.0 {
            self.pace = Pace::Plan;
        }
    }

    fn finish(&mut self) {
        if let Some(c) = self.current.take() {
            self.position = c.segment.path.end;
            if !c.segment.rapid {
                self.feed_mm += c.segment.path.length;
            }
            self.remember(c.segment);
        }
    }

    fn remember(&mut self, segment: Segment) {
        self.history[self.history_next] = Some(segment);
        self.history_next = (self.history_next + 1) % HISTORY;
    }
}

/// Length below which the end of an element is reached: rounding of the ramp.
const END_MM: f64 = 1e-12;

#[allow(clippy::large_enum_variant)] // as above
enum Next {
    Started,
    Nothing,
    Block,
    Other(Planned),
}
