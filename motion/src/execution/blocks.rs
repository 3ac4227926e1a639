//! Single blocks: the path stops at the end of the block in execution although the plan runs through it.
//! Runs: cyclic. Invariant: the path brakes with no more than the smallest acceleration of the elements on the way; a block that is too
//! short to stop in is followed by the next. From: N6, R1-86, R2-117, scenario S40 b.

use super::{Demand, END_MM, Next, Pace, PathExecutor};
use crate::segment::{Action, Planned};

impl PathExecutor {
    /// Goes on behind a stop at the end of a block: one block, or all.
    pub fn go_on(&mut self) {
        self.begun = false;
    }

    /// True at rest in front of another block than the one begun last.
    pub(super) fn at_block_end(&self) -> bool {
        let other = |step: &Planned| step.mark.block != self.last.block;
        self.begun && self.queue.front().is_some_and(other) && self.rests()
    }

    fn rests(&self) -> bool {
        match self.pace {
            Pace::Free(w) => w == 0.0,
            Pace::Plan => self.history_v_out() == 0.0,
        }
    }

    /// Length of path to the end of the block where the path can stop from speed `v`, and the acceleration that is there on the way.
    /// `None`: the plan stops there anyway, or the end is not known yet.
    fn stop_length(&self, v: f64) -> Option<(f64, f64)> {
        let c = self.current.as_ref()?;
        let (mut length, mut accel) = (c.segment.path.length - c.s, c.segment.accel);
        let (mut block, mut v_out) = (self.last.block, c.segment.profile.v_out);
        for step in &self.queue {
            let ends = step.mark.block != block;
            if ends && v_out == 0.0 {
                return None;
            }
            if ends && v * v <= 2.0 * accel * length * (1.0 + 1e-9) {
                return Some((length, accel));
            }
            block = step.mark.block;
            match &step.action {
                Action::Move(s) => {
                    (length, accel, v_out) = (length + s.path.length, accel.min(s.accel), s.profile.v_out);
                }
                action if action.is_stop() => return None,
                _ => {}
            }
        }
        None
    }

    /// Brakes towards the end of the block if it is time; the seconds that are left then.
    pub(super) fn brake_to_block_end(&mut self, left: f64, cap: f64, demand: &Demand) -> Option<f64> {
        if !demand.single || cap == 0.0 {
            return None;
        }
        let v = self.speed();
        let (length, accel) = self.stop_length(v)?;
        // One more period at this speed, even faster by what it could gain, would be too late.
        let ahead = v + accel * left;
        if v == 0.0 || ahead * ahead < 2.0 * accel * (length - ahead * left) {
            return None;
        }
        let brake = v * v / (2.0 * length.max(END_MM));
        let time = left.min(v / brake);
        let way = if time < left { length } else { (v * time - 0.5 * brake * time * time).min(length) };
        self.skip(way, (v - brake * time).max(0.0));
        Some(left - time)
    }

    /// Moves on by a length of path, over elements that end on the way; `v` is the speed behind it.
    fn skip(&mut self, mut way: f64, v: f64) {
        let at_rest = v <= 1e-9;
        self.pace = Pace::Free(if at_rest { 0.0 } else { v });
        while let Some(c) = &mut self.current {
            let rest = c.segment.path.length - c.s;
            if way < rest - END_MM {
                c.s += way;
                return;
            }
            way = (way - rest).max(0.0);
            let pace = self.pace;
            self.finish();
            if way <= END_MM || !self.next_move() {
                self.pace = pace;
                return;
            }
            self.pace = pace;
        }
    }

    /// The next element of the same stretch; notes between them wait for their turn.
    fn next_move(&mut self) -> bool {
        let is_move = matches!(self.queue.front(), Some(Planned { action: Action::Move(_), .. }));
        is_move && matches!(self.next(&Demand::default()), Next::Started)
    }
}
