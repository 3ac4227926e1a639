//! Interpolation: planned elements become positions at the servo period, in closed form.
//! Runs: cyclic. No allocation; a tick passes at most [`QUEUE`] elements.
//! Invariant: at full override the path time runs with the real time; hold, resume and override bend it so that the path is kept
//! and the path acceleration of each element is never exceeded. From: R1-116, R1-165, CM-23, scenario S40.

use crate::geometry::Point;
use crate::segment::{Action, Mark, Planned, Segment};
use std::collections::VecDeque;
use takt_base::ring::Rx;

/// Elements that wait behind the ring.
pub const QUEUE: usize = 1024;
/// Elements that must wait before a program starts, unless it is shorter.
const PRIMED: usize = 512;
/// Elements kept for the path deviation.
pub const HISTORY: usize = 16;

/// What the operator and the PLC program want, as shares of the programmed speed.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Demand {
    /// Override of feed moves, 0..=1.
    pub feed: f64,
    /// Override of positioning moves, 0..=1.
    pub rapid: f64,
    /// Stop on the path.
    pub hold: bool,
}

impl Default for Demand {
    fn default() -> Self {
        Self { feed: 1.0, rapid: 1.0, hold: false }
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

/// How path time relates to real time.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Pace {
    /// Path time runs at this rate.
    Follow(f64),
    /// On the way to another rate, at this path speed in mm/s.
    Ramp(f64),
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
    primed: bool,
    position: Point,
    history: [Option<Segment>; HISTORY],
    history_next: usize,
    /// Length executed, feed moves alone.
    pub feed_mm: f64,
    /// Blocks of the part program that were begun.
    pub blocks: u32,
    last: Mark,
}

impl PathExecutor {
    /// At rest at `position`.
    pub fn new(position: Point) -> Self {
        Self {
            queue: VecDeque::with_capacity(QUEUE),
            queued_mm: 0.0,
            accel_min: f64::INFINITY,
            current: None,
            dwell_s: 0.0,
            pace: Pace::Follow(1.0),
            feed_override: true,
            primed: false,
            position,
            history: [None; HISTORY],
            history_next: 0,
            feed_mm: 0.0,
            blocks: 0,
            last: Mark::default(),
        }
    }

    /// Forgets everything and stands at `position`.
    pub fn reset(&mut self, position: Point) {
        self.queue.clear();
        self.queued_mm = 0.0;
        self.accel_min = f64::INFINITY;
        self.current = None;
        self.dwell_s = 0.0;
        self.pace = Pace::Follow(1.0);
        self.feed_override = true;
        self.primed = false;
        self.position = position;
        self.history = [None; HISTORY];
        self.feed_mm = 0.0;
        self.blocks = 0;
        self.last = Mark::default();
    }

    /// Drops what is left of a program; the place and the figures stay.
    pub fn halt(&mut self) {
        self.queue.clear();
        self.queued_mm = 0.0;
        self.current = None;
        self.dwell_s = 0.0;
    }

    /// Takes what the look-ahead has released for `run`.
    pub fn fill(&mut self, ring: &mut Rx<Planned>, run: u32) {
        while self.queue.len() < QUEUE {
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
        match (self.pace, &self.current) {
            (_, None) => 0.0,
            (Pace::Follow(r), Some(c)) => r * c.segment.profile.v(c.tau),
            (Pace::Ramp(w), Some(_)) => w,
        }
    }

    /// True if the path stands still and would not move on this demand.
    pub fn is_held(&self) -> bool {
        self.current.is_none() || self.pace == Pace::Follow(0.0)
    }

    /// Place in the part program: what was begun last.
    pub fn mark(&self) -> Mark {
        self.last
    }

    /// Rest of the current element in mm.
    pub fn distance_to_go(&self) -> f64 {
        self.current.as_ref().map_or(0.0, |c| (c.segment.path.length - c.s).max(0.0))
    }

    /// True while a dwell runs.
    pub fn is_dwelling(&self) -> bool {
        self.dwell_s > 0.0
    }

    /// Distance of a point from the path round the current position, in mm.
    pub fn deviation(&self, p: &Point) -> f64 {
        let current = self.current.as_ref().map(|c| &c.segment);
        let near = self.history.iter().flatten().chain(current);
        near.map(|s| s.path.distance_to(p)).fold(f64::INFINITY, f64::min)
    }

    /// Moves on by `dt` seconds, or up to the next action that is not for the path.
    pub fn advance(&mut self, dt: f64, demand: &Demand) -> Reached {
        let starved = self.is_starved(dt);
        let mut left = dt;
        for _ in 0..4 * QUEUE {
            if left <= 0.0 {
                return self.stand(Reached::Time);
            }
            if self.dwell_s > 0.0 {
                left = self.dwell(left, demand.hold);
            } else if self.current.is_some() {
                let goal = self.goal(demand, starved);
                left = self.step(left, goal);
            } else {
                match self.next(demand) {
                    Next::Started => {}
                    Next::Nothing => return self.stand(Reached::Nothing),
                    Next::Other(step) => return self.stand(Reached::Action(step, left)),
                }
            }
        }
        self.stand(Reached::Time)
    }

    fn stand(&mut self, reached: Reached) -> Reached {
        if let Some(c) = &self.current {
            self.position = c.segment.path.at(c.s);
        }
        reached
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

    fn goal(&self, demand: &Demand, starved: bool) -> f64 {
        let rapid = self.current.as_ref().is_some_and(|c| c.segment.rapid);
        let share = if rapid {
            demand.rapid
        } else if self.feed_override {
            demand.feed
        } else {
            1.0
        };
        if demand.hold || starved { 0.0 } else { share.clamp(0.0, 1.0) }
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
        let Some(step) = self.queue.front().copied() else { return Next::Nothing };
        if demand.hold && self.speed_in(&step) == 0.0 {
            return Next::Nothing;
        }
        self.count(step.mark);
        match step.action {
            Action::Move(segment) => {
                self.queued_mm -= segment.path.length;
                self.start(segment);
            }
            Action::Dwell(seconds) => self.dwell_s = seconds,
            Action::FeedOverride(on) => self.feed_override = on,
            _ => {
                self.queue.pop_front();
                return Next::Other(step);
            }
        }
        self.queue.pop_front();
        Next::Started
    }

    /// Speed at which the path enters a step. What is not a move goes along with the moves round it.
    fn speed_in(&self, step: &Planned) -> f64 {
        match (&step.action, self.pace) {
            (Action::Move(segment), _) => segment.profile.v_in,
            (action, Pace::Ramp(w)) if !action.is_stop() => w,
            (action, Pace::Follow(r)) if !action.is_stop() => r,
            _ => 0.0,
        }
    }

    fn count(&mut self, mark: Mark) {
        if mark.block != self.last.block && mark.block != 0 {
            self.blocks += 1;
        }
        self.last = mark;
    }

    fn start(&mut self, segment: Segment) {
        self.current = Some(Current { segment, tau: 0.0, s: 0.0 });
        if segment.profile.v_in == 0.0 {
            // At rest the path time may jump to any rate.
            self.pace = Pace::Ramp(0.0);
        } else if let Pace::Ramp(w) = &mut self.pace {
            *w = w.min(segment.profile.v_in);
        }
    }

    fn finish(&mut self) {
        if let Some(c) = self.current.take() {
            self.position = c.segment.path.end;
            if !c.segment.rapid {
                self.feed_mm += c.segment.path.length;
            }
            self.history[self.history_next] = Some(c.segment);
            self.history_next = (self.history_next + 1) % HISTORY;
        }
    }

    /// Uses up to `left` seconds on the current element; returns what is left.
    fn step(&mut self, left: f64, goal: f64) -> f64 {
        let Some(c) = &mut self.current else { return left };
        if let Pace::Follow(r) = self.pace
            && r != goal
        {
            self.pace = Pace::Ramp(r * c.segment.profile.v(c.tau));
        }
        if let Pace::Ramp(w) = self.pace
            && let Some(r) = settled(c, w, goal)
        {
            c.tau = c.segment.profile.time_at(c.s);
            self.pace = Pace::Follow(r);
        }
        match self.pace {
            Pace::Follow(r) => self.follow(left, r),
            Pace::Ramp(w) => self.ramp(left, w, goal),
        }
    }

    fn follow(&mut self, left: f64, r: f64) -> f64 {
        let Some(c) = &mut self.current else { return left };
        if r == 0.0 {
            return 0.0;
        }
        let tau = c.tau + r * left;
        let over = tau - c.segment.profile.duration();
        if over < 0.0 {
            c.tau = tau;
            c.s = c.segment.profile.s(tau);
            return 0.0;
        }
        self.finish();
        over / r
    }

    /// Constant path acceleration until the rate is reached, the phase of the plan ends, the path stands, or time is up.
    fn ramp(&mut self, left: f64, w: f64, goal: f64) -> f64 {
        let Some(c) = &mut self.current else { return left };
        let phase = c.segment.profile.phase(c.s);
        let goal_v2 = goal * goal * phase.v2(c.s);
        let up = w * w < goal_v2 || (w == 0.0 && goal > 0.0);
        let a = if up { c.segment.accel } else { -c.segment.accel };
        let to_end = phase.end - c.s;
        let mut ds = to_end;
        let closing = 2.0 * (a - goal * goal * phase.a);
        if closing != 0.0 {
            let meet = (goal_v2 - w * w) / closing;
            if meet > 0.0 && meet < ds {
                ds = meet;
            }
        }
        if !up {
            ds = ds.min(-w * w / (2.0 * a));
        }
        let w_end = (w * w + 2.0 * a * ds).max(0.0).sqrt();
        let time = if w + w_end > 0.0 { 2.0 * ds / (w + w_end) } else { 0.0 };
        if time > left {
            c.s += left * (w + 0.5 * a * left);
            self.pace = Pace::Ramp((w + a * left).max(0.0));
            return 0.0;
        }
        let met = ds < to_end || goal == 0.0 && w_end == 0.0;
        c.s = if ds < to_end { c.s + ds } else { phase.end };
        let reached_end = c.s >= c.segment.path.length - END_MM;
        self.pace = Pace::Ramp(w_end);
        if reached_end {
            self.finish();
        } else if met {
            self.settle(goal);
        }
        left - time
    }

    fn settle(&mut self, goal: f64) {
        if let Some(c) = &mut self.current {
            c.tau = c.segment.profile.time_at(c.s);
            self.pace = Pace::Follow(goal);
        }
    }
}

/// Length below which the end of an element is reached: rounding of the ramp.
const END_MM: f64 = 1e-12;

/// The rate, if the ramp has nothing to do: the path stands where the plan stands, or the speed fits already.
fn settled(c: &Current, w: f64, goal: f64) -> Option<f64> {
    let plan = c.segment.profile.v_at(c.s);
    let at_rest = plan == 0.0 && c.s <= 0.0 || (w == 0.0 && goal == 0.0);
    (at_rest || (goal * plan - w).abs() <= 1e-12 * plan).then_some(goal)
}

#[allow(clippy::large_enum_variant)] // as above
enum Next {
    Started,
    Nothing,
    Other(Planned),
}
