//! Motion in step with the spindle: threads (G33, G76) and rigid tapping (G33.1).
//! Runs: cyclic. The path waits for the mark of the encoder, catches up with the spindle as fast as the axes can, and is then where the
//! encoder says. At the end of a thread it brakes; between two threads of a chain it does not. Holds and overrides wait (N4); an abort
//! brakes. From: LinuxCNC "G33", "G33.1".

use super::{Current, Demand, Pace, PathExecutor};
use crate::geometry::{Path, Point};
use crate::segment::{Action, Planned, Segment};
use crate::sync::Special;

/// Where a tapping is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Stage {
    Thread,
    /// Down; the spindle turns as programmed.
    Down,
    /// The spindle has been reversed: the tool follows it out.
    Up,
    /// Out; the spindle is reversed once more, and the tool goes to its start.
    Out,
}

/// The state of a move in step.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Follow {
    stage: Stage,
    pitch: f64,
    /// Sense in which the spindle drives.
    sense: f64,
    /// Revolution, in that sense, at which the path starts.
    origin: f64,
    v: f64,
    stopped: bool,
}

impl Follow {
    fn new(stage: Stage, pitch: f64, demand: &Demand) -> Self {
        let sense = if demand.spindle_sense < 0.0 { -1.0 } else { 1.0 };
        Self { stage, pitch, sense, origin: (sense * demand.spindle_rev).ceil(), v: 0.0, stopped: false }
    }

    /// Path speed, negative on the way back.
    pub fn speed(&self) -> f64 {
        self.v
    }

    /// Not a thread.
    pub fn is_tap(&self) -> bool {
        self.stage != Stage::Thread
    }

    /// An abort has braked it to rest.
    pub fn is_stopped(&self) -> bool {
        self.stopped
    }

    /// Speed for the next `dt` seconds that leads to `target`, which itself moves at `v_target`, without passing it.
    fn towards(&self, error: f64, v_target: f64, accel: f64, dt: f64) -> f64 {
        let lag = error - v_target * dt;
        let limit = v_target + stoppable(lag.abs(), accel, dt).copysign(lag);
        let exact = error / dt;
        let wanted = if (exact - v_target).abs() < (limit - v_target).abs() { exact } else { limit };
        wanted.clamp(self.v - accel * dt, self.v + accel * dt)
    }
}

/// Highest speed at which a rest of `length` mm is left to stop in behind a period of `dt` seconds.
fn stoppable(length: f64, accel: f64, dt: f64) -> f64 {
    let step = accel * dt;
    (step * step + 2.0 * accel * length.max(0.0)).sqrt() - step
}

impl PathExecutor {
    /// Begins a move that does more than moving.
    pub(super) fn start_special(&mut self, segment: Segment, special: Special, demand: &Demand) {
        match special {
            Special::Probe(probe) => return self.start_probe(segment, probe, demand),
            Special::Tap(pitch) => self.follow = Some(Follow::new(Stage::Down, pitch, demand)),
            Special::Thread { pitch, .. } => self.follow = Some(Follow::new(Stage::Thread, pitch, demand)),
        }
        self.start(segment);
        self.pace = Pace::Free(0.0);
    }

    /// A thread starts when the item behind it is there too: it says whether it goes on.
    pub(super) fn thread_is_incomplete(&self) -> bool {
        let thread = |step: &Planned| matches!(step.action, Action::Special(_, Special::Thread { .. }));
        self.queue.front().is_some_and(thread) && self.queue.len() < 2
    }

    /// The spindle has to be turned the other way round; true once.
    pub fn take_reversal(&mut self) -> bool {
        std::mem::take(&mut self.reversal)
    }

    /// One period; what is left of it.
    pub(super) fn follow_step(&mut self, dt: f64, demand: &Demand) -> f64 {
        let (Some(mut f), Some(c)) = (self.follow, self.current) else {
            self.follow = None;
            return dt;
        };
        let accel = c.segment.accel;
        let turned = f.sense * demand.spindle_rev - f.origin;
        // Before the mark it waits; on the way out it follows the spindle beyond the start.
        let moves = turned > 0.0 || f.stage == Stage::Up;
        let (target, v_target) = if moves { (f.pitch * turned, f.pitch * f.sense * demand.spindle_rps) } else { (0.0, 0.0) };
        // What is left is so short that one more period at this speed ends it, at rest within the next.
        let last = |rest: f64| rest.abs() <= accel * dt * dt && (rest / dt - f.v).abs() <= accel * dt;
        let length = c.segment.path.length;
        f.v = match f.stage {
            _ if demand.abort => {
                f.stopped = f.v.abs() <= accel * dt;
                if f.stopped { 0.0 } else { f.v - (accel * dt).copysign(f.v) }
            }
            Stage::Out if last(-c.s) => {
                self.tap_done(&c.segment);
                return 0.0;
            }
            Stage::Out => f.towards(-c.s, 0.0, accel, dt),
            Stage::Thread if !self.goes_on() && last(length - c.s) => {
                self.thread_done();
                return 0.0;
            }
            Stage::Thread if !self.goes_on() => {
                let rest = length - c.s;
                f.towards(target - c.s, v_target, accel, dt).min(stoppable(rest, accel, dt))
            }
            Stage::Thread | Stage::Down | Stage::Up => f.towards(target - c.s, v_target, accel, dt),
        };
        self.advance_following(f, c, dt);
        0.0
    }

    fn advance_following(&mut self, mut f: Follow, mut c: Current, dt: f64) {
        c.s += f.v * dt;
        let length = c.segment.path.length;
        match f.stage {
            Stage::Thread if c.s >= length && self.goes_on() => {
                return self.next_thread(Follow { origin: f.origin + length / f.pitch, ..f }, c.s - length);
            }
            Stage::Down if c.s >= length => {
                f.stage = Stage::Up;
                self.reversal = true;
            }
            Stage::Up if c.s <= 0.0 => {
                f.stage = Stage::Out;
                self.reversal = true;
            }
            _ => {}
        }
        self.position = beyond(&c.segment.path, c.s);
        (self.follow, self.current) = (Some(f), Some(c));
    }

    fn thread_done(&mut self) {
        self.follow = None;
        self.pace = Pace::Plan;
        self.finish();
    }

    /// The thread goes on with the next one, in phase, `s` mm behind its start.
    fn next_thread(&mut self, f: Follow, s: f64) {
        self.finish();
        let Some(Planned { action: Action::Special(segment, Special::Thread { pitch, .. }), mark, .. }) = self.queue.pop_front()
        else {
            return;
        };
        self.count(mark);
        // The revolutions behind the joint count with the new pitch.
        let s = s * pitch / f.pitch;
        self.current = Some(Current { segment, tau: 0.0, s });
        self.position = beyond(&segment.path, s);
        self.follow = Some(Follow { pitch, ..f });
    }

    fn tap_done(&mut self, segment: &Segment) {
        self.follow = None;
        self.current = None;
        self.pace = Pace::Plan;
        self.position = segment.path.start;
        self.feed_mm += 2.0 * segment.path.length;
        self.forget_history();
    }

    /// The next item goes on with this thread.
    fn goes_on(&self) -> bool {
        matches!(self.queue.front(), Some(Planned { action: Action::Special(_, Special::Thread { starts: false, .. }), .. }))
    }
}

/// The point at length `s` of a straight path, also before its start and behind its end.
fn beyond(path: &Path, s: f64) -> Point {
    let u = s / path.length;
    if (0.0..=1.0).contains(&u) {
        return path.at(s);
    }
    std::array::from_fn(|i| path.start[i] + (path.end[i] - path.start[i]) * u)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From rest to a target that moves at 10 mm/s: there with the right speed, never faster than the acceleration allows, no overshoot
    /// beyond what one period needs.
    #[test]
    fn catches_up_and_stays() {
        let mut f = Follow { stage: Stage::Thread, pitch: 1.0, sense: 1.0, origin: 0.0, v: 0.0, stopped: false };
        let (dt, accel, mut s) = (0.001, 1000.0, 0.0);
        let mut worst: f64 = 0.0;
        for k in 1..=200 {
            let target = 10.0 * dt * f64::from(k);
            let before = f.v;
            f.v = f.towards(target - s, 10.0, accel, dt);
            assert!((f.v - before).abs() <= accel * dt * (1.0 + 1e-9));
            s += f.v * dt;
            worst = worst.max(s - target);
            if k > 60 {
                assert!((s - target).abs() < 1e-12, "{k}: {s} {target}");
            }
        }
        assert!(worst < accel * dt * dt, "{worst}");
    }

    #[test]
    fn stops_in_what_is_left() {
        let (mut s, accel, dt) = (0.0, 1000.0, 0.001);
        for _ in 0..1000 {
            let v = stoppable(5.0 - s, accel, dt);
            s += v * dt;
        }
        assert!(s <= 5.0 && s > 5.0 - 1e-6, "{s}");
    }
}
