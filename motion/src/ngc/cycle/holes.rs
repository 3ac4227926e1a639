//! What happens in one hole, from R to the bottom and back.

use super::Cycle;
use crate::canon::{Canon, Direction};
use crate::ngc::execute::Done;
use crate::ngc::modal::{Distance, Motion, mm_per_unit};
use crate::ngc::request::{bad_value, missing};
use takt_base::{Code, Diag};

/// How far above the last depth a peck ends its rapid, in mm: a hundredth of an inch.
const PECK_MM: f64 = 0.254;
/// Pecks that the holes of one block may have.
const PECKS_MAX: f64 = 50_000.0;

impl Cycle<'_, '_, '_> {
    pub(super) fn hole(&mut self, motion: Motion) -> Done {
        match motion {
            Motion::Canned(73) => self.peck(false),
            Motion::Canned(74) => self.tap(Direction::Counterclockwise, motion),
            Motion::Canned(81) => {
                self.feed_to(self.bottom);
                self.traverse_to(self.clear);
                Ok(())
            }
            Motion::Canned(82) => {
                let dwell = self.dwell_word(motion)?;
                self.feed_to(self.bottom);
                self.run.emit(Canon::Dwell(dwell));
                self.traverse_to(self.clear);
                Ok(())
            }
            Motion::Canned(83) => self.peck(true),
            Motion::Canned(84) => self.tap(Direction::Clockwise, motion),
            Motion::Canned(85) => {
                self.feed_to(self.bottom);
                self.feed_to(self.r);
                self.traverse_to(self.clear);
                Ok(())
            }
            Motion::Canned(86) => self.bore_and_stop(motion),
            Motion::Canned(87) => self.back_bore(motion),
            Motion::Canned(88) => self.bore_by_hand(motion),
            _ => {
                let dwell = self.dwell_word(motion)?;
                self.feed_to(self.bottom);
                self.run.emit(Canon::Dwell(dwell));
                self.feed_to(self.clear);
                Ok(())
            }
        }
    }

    /// Words that a hole needs, before the first one is made.
    pub(super) fn check_words(&self, motion: Motion) -> Done {
        match motion {
            Motion::Canned(73 | 83) => self.peck_depth().map(|_| ()),
            Motion::Canned(82 | 86 | 88 | 89) => self.dwell_word(motion).map(|_| ()),
            Motion::Canned(87) => self.beside().map(|_| ()),
            _ => Ok(()),
        }
    }

    fn dwell_word(&self, motion: Motion) -> Result<f64, Box<Diag>> {
        let at = self.run.request.motion_span();
        match self.words.p {
            Some(p) if p >= 0.0 => Ok(p),
            Some(_) => Err(Box::new(Diag::new(Code::BadValue, at, "a dwell of less than nothing").help("write P0 or more"))),
            None => Err(Box::new(missing(at, "P").help(format!("write the dwell in seconds, such as {} P0.5", motion.text())))),
        }
    }

    fn peck_depth(&self) -> Result<f64, Box<Diag>> {
        let request = self.run.request;
        let help = "write the depth of a peck, such as Q2";
        let Some(q) = self.words.q else { return Err(Box::new(missing(request.motion_span(), "Q").help(help))) };
        // Far from zero a peck may be less than the distance of two numbers: the tool would never get to the bottom.
        let vanishes = self.r - q >= self.r || self.bottom + q <= self.bottom;
        if q <= 0.0 || vanishes || (self.r - self.bottom) / q * f64::from(self.repeats) > PECKS_MAX {
            let word = request.word('Q');
            let diag = word.map(|w| bad_value(w, "no depth of a peck", help));
            return Err(Box::new(diag.unwrap_or_else(|| missing(request.motion_span(), "Q").help(help))));
        }
        Ok(q)
    }

    /// G83 clears the chips at R, G73 breaks them in the hole.
    fn peck(&mut self, clear: bool) -> Done {
        let q = self.peck_depth()?;
        let above = PECK_MM / mm_per_unit(self.run.state.modal.units);
        let mut depth = self.r - q;
        while depth > self.bottom {
            self.feed_to(depth);
            if clear {
                self.traverse_to(self.r);
            }
            self.traverse_to(depth + above);
            depth -= q;
        }
        self.feed_to(self.bottom);
        self.traverse_to(self.clear);
        Ok(())
    }

    fn turning(&self, motion: Motion, wanted: Option<Direction>) -> Result<Direction, Box<Diag>> {
        let at = self.run.request.motion_span();
        let refuse = |label: String, help| Err(Box::new(Diag::new(Code::SpindleStopped, at, label).help(help)));
        match (self.run.state.modal.spindle, wanted) {
            (None, _) => refuse(format!("{} with the spindle stopped", motion.text()), "write S and M3 or M4 before it"),
            (Some(is), Some(wanted)) if is != wanted => {
                refuse(format!("{} with the spindle turning the other way", motion.text()), "G84 needs M3, G74 needs M4")
            }
            (Some(is), _) => Ok(is),
        }
    }

    fn start(&mut self, direction: Direction) {
        self.run.emit(match direction {
            Direction::Clockwise => Canon::StartSpindleClockwise,
            Direction::Counterclockwise => Canon::StartSpindleCounterclockwise,
        });
    }

    fn tap(&mut self, way: Direction, motion: Motion) -> Done {
        self.turning(motion, Some(way))?;
        let back = if way == Direction::Clockwise { Direction::Counterclockwise } else { Direction::Clockwise };
        let modal = self.run.state.modal;
        self.run.emit(Canon::DisableFeedOverride);
        self.run.emit(Canon::DisableSpeedOverride);
        self.feed_to(self.bottom);
        self.run.emit(Canon::StopSpindleTurning);
        self.start(back);
        let dwell = self.words.p.unwrap_or(0.0).max(0.0);
        if dwell > 0.0 || self.run.state.options.drop_in {
            self.run.emit(Canon::Dwell(dwell));
        }
        self.feed_to(self.clear);
        self.run.emit(Canon::StopSpindleTurning);
        self.start(way);
        if modal.overrides {
            self.run.emit(Canon::EnableFeedOverride);
        }
        if modal.speed_override {
            self.run.emit(Canon::EnableSpeedOverride);
        }
        Ok(())
    }

    /// To the bottom, where the spindle stops. Which way it turned.
    fn bore(&mut self, motion: Motion) -> Result<Direction, Box<Diag>> {
        let dwell = self.dwell_word(motion)?;
        let way = self.turning(motion, None)?;
        self.feed_to(self.bottom);
        self.run.emit(Canon::Dwell(dwell));
        self.run.emit(Canon::StopSpindleTurning);
        Ok(way)
    }

    fn bore_and_stop(&mut self, motion: Motion) -> Done {
        let way = self.bore(motion)?;
        self.traverse_to(self.clear);
        self.start(way);
        Ok(())
    }

    fn bore_by_hand(&mut self, motion: Motion) -> Done {
        let way = self.bore(motion)?;
        self.run.emit(Canon::ProgramStop);
        self.start(way);
        Ok(())
    }

    /// I, J and K of G87.
    fn beside(&self) -> Result<[f64; 3], Box<Diag>> {
        if let [Some(i), Some(j), Some(k)] = self.words.ijk {
            return Ok([i, j, k]);
        }
        let at = self.run.request.motion_span();
        Err(Box::new(missing(at, "I, J and K").help("I and J lead beside the hole, K is the end of the bore")))
    }

    /// G87: in beside the hole, over to it, up to K, and out again.
    fn back_bore(&mut self, motion: Motion) -> Done {
        let [i, j, k] = self.beside()?;
        let way = self.turning(motion, None)?;
        let beside = [self.at[0] + i, self.at[1] + j];
        let k = if self.run.state.modal.distance == Distance::Absolute { k } else { self.bottom + k };
        self.go(beside, self.r, false);
        self.stop_oriented(way);
        self.go(beside, self.bottom, false);
        self.traverse_to(self.bottom);
        self.start(way);
        self.feed_to(k);
        self.feed_to(self.bottom);
        self.stop_oriented(way);
        self.go(beside, self.bottom, false);
        self.go(beside, self.clear, false);
        self.traverse_to(self.clear);
        self.start(way);
        Ok(())
    }

    fn stop_oriented(&mut self, way: Direction) {
        self.run.emit(Canon::StopSpindleTurning);
        self.run.emit(Canon::OrientSpindle(0.0, way));
    }
}
