//! G93, G94, G95, F, G96, G97, S.

use super::{Done, Run};
use crate::canon::Canon;
use crate::ngc::modal::{FeedMode, mm_per_unit};
use crate::ngc::request::{bad_value, missing};
use crate::ngc::word::{Action, Group};
use takt_base::units::MmPerMin;

impl Run<'_, '_> {
    /// A change of the feed mode forgets F. The drop-in form forgets it at every G94, as LinuxCNC does.
    pub(super) fn feed_mode(&mut self) -> Done {
        let Some(Action::Feed(mode)) = self.request.code(Group::FeedMode) else { return Ok(()) };
        let before = std::mem::replace(&mut self.modal().feed_mode, mode);
        let drop_in = self.state.options.drop_in;
        if before != mode || drop_in {
            self.modal().feed = None;
        }
        self.say(match mode {
            FeedMode::InverseTime => "feed mode set to inverse time",
            FeedMode::PerMinute => "feed mode set to units per minute",
            FeedMode::PerRevolution => "feed mode set to units per revolution",
        });
        let per_rev = mode == FeedMode::PerRevolution;
        if drop_in || per_rev != (before == FeedMode::PerRevolution) {
            self.emit(Canon::SetFeedMode(per_rev));
        }
        if drop_in && mode != FeedMode::InverseTime {
            self.emit(Canon::SetFeedRate(0.0));
        }
        Ok(())
    }

    /// F counts in the units before a G20 or G21 of the same block, as in RS274/NGC.
    pub(super) fn rates(&mut self) -> Done {
        if let Some(feed) = self.request.value('F')
            && self.state.modal.feed_mode != FeedMode::InverseTime
        {
            self.check_feed(feed);
            self.modal().feed = Some(feed);
            self.emit(Canon::SetFeedRate(feed));
        }
        self.spindle_mode()?;
        if self.request.word('$').is_some() {
            self.check_spindle()?;
        }
        if let Some(speed) = self.request.value('S') {
            self.modal().speed = speed;
            self.emit(Canon::SetSpindleSpeed(speed));
        }
        Ok(())
    }

    fn check_feed(&mut self, feed: f64) {
        let (Some(MmPerMin(max)), Some(word)) = (self.state.options.feed_max, self.request.word('F')) else { return };
        let max = max / mm_per_unit(self.state.modal.units);
        if feed > max && self.state.modal.feed_mode == FeedMode::PerMinute {
            self.out.diags.push(bad_value(
                word,
                &format!("the largest feed is {max:.4}"),
                "write a smaller feed, or raise the limit",
            ));
        }
    }

    fn spindle_mode(&mut self) -> Done {
        let Some(Action::SurfaceSpeed(on)) = self.request.code(Group::SpindleMode) else { return Ok(()) };
        let at = self.request.code_span(Group::SpindleMode);
        let max = match (on, self.request.word('D')) {
            (true, Some(word)) if word.value <= 0.0 => {
                return Err(Box::new(bad_value(word, "no speed", "write the largest speed in revolutions a minute")));
            }
            (true, word) => Some(word.map_or(1e30, |w| w.value)),
            (false, _) => None,
        };
        if self.request.word('S').is_none() && on {
            return Err(Box::new(missing(at, "S").help("write the speed, such as G96 S100 D2000 or G97 S1500")));
        }
        self.modal().surface_speed = max;
        self.emit(Canon::SetSpindleMode(max));
        Ok(())
    }
}
