//! Spindle, coolant, overrides, inputs and outputs, saved modes, user M codes.

use super::{Done, Run};
use crate::canon::{Canon, Direction, Input};
use crate::ngc::modal::{FeedMode, Modal};
use crate::ngc::outside::Awaits;
use crate::ngc::request::{bad_value, missing, not_now};
use crate::ngc::state::SavedModes;
use crate::ngc::word::{Action, Coolant, Group, Modes, Override};
use takt_base::Diag;

impl Run<'_, '_> {
    pub(super) fn switches(&mut self) -> Done {
        match self.request.code(Group::Spindle) {
            Some(Action::Spindle(direction)) => {
                self.check_spindle()?;
                self.spindle(direction);
            }
            Some(Action::Orient) => self.orient()?,
            _ => {}
        }
        if let Some(Action::Coolant(coolant)) = self.request.code(Group::Coolant) {
            self.coolant(coolant);
        }
        match self.request.code(Group::Overrides) {
            Some(Action::Overrides(enabled)) => self.overrides(enabled, enabled),
            Some(Action::Override(which)) => self.override_switch(which),
            _ => {}
        }
        if let Some(Action::Modes(modes)) = self.request.code(Group::Modes) {
            self.saved_modes(modes)?;
        }
        if let Some(Action::User(code)) = self.request.code(Group::User) {
            self.emit(Canon::UserMCode { code, p: self.request.value('P'), q: self.request.value('Q') });
        }
        Ok(())
    }

    /// There is one spindle: `$0`; `$-1` means all of them.
    pub(super) fn check_spindle(&self) -> Done {
        match self.request.word('$') {
            Some(word) if word.value != 0.0 && word.value != -1.0 => {
                Err(Box::new(bad_value(word, "no such spindle", "there is one spindle, $0")))
            }
            _ => Ok(()),
        }
    }

    pub(super) fn spindle(&mut self, direction: Option<Direction>) {
        self.modal().spindle = direction;
        self.emit(match direction {
            Some(Direction::Clockwise) => Canon::StartSpindleClockwise,
            Some(Direction::Counterclockwise) => Canon::StartSpindleCounterclockwise,
            None => Canon::StopSpindleTurning,
        });
    }

    fn orient(&mut self) -> Done {
        let Some(word) = self.request.word('R') else {
            if self.state.options.drop_in {
                return Ok(());
            }
            self.emit(Canon::OrientSpindle(0.0, Direction::Clockwise));
            return Ok(());
        };
        if !(0.0..=360.0).contains(&word.value) {
            return Err(Box::new(bad_value(word, "no angle", "write 0 to 360 degrees")));
        }
        let way = self.request.value('P').unwrap_or(0.0);
        let direction = if way == 2.0 { Direction::Counterclockwise } else { Direction::Clockwise };
        let drop_in = self.state.options.drop_in;
        self.emit(match drop_in {
            true => Canon::OrientSpindleMode(word.value, way as u32),
            false => Canon::OrientSpindle(word.value, direction),
        });
        if let Some(wait) = self.request.word('Q') {
            if wait.value <= 0.0 {
                return Err(Box::new(bad_value(wait, "no time", "write the longest wait in seconds")));
            }
            self.emit(Canon::WaitOrientComplete(wait.value));
        }
        Ok(())
    }

    pub(super) fn coolant(&mut self, coolant: Coolant) {
        match coolant {
            Coolant::Mist => self.emit(Canon::MistOn),
            Coolant::Flood => self.emit(Canon::FloodOn),
            Coolant::Off => {
                self.emit(Canon::MistOff);
                self.emit(Canon::FloodOff);
            }
        }
        let modal = self.modal();
        modal.mist = coolant == Coolant::Mist || (modal.mist && coolant == Coolant::Flood);
        modal.flood = coolant == Coolant::Flood || (modal.flood && coolant == Coolant::Mist);
    }

    pub(super) fn overrides(&mut self, feed: bool, speed: bool) {
        self.feed_override(feed);
        self.speed_override(speed);
    }

    fn feed_override(&mut self, on: bool) {
        self.modal().overrides = on;
        self.emit(if on { Canon::EnableFeedOverride } else { Canon::DisableFeedOverride });
    }

    fn speed_override(&mut self, on: bool) {
        self.modal().speed_override = on;
        self.emit(if on { Canon::EnableSpeedOverride } else { Canon::DisableSpeedOverride });
    }

    /// M50 .. M53: P0 is off, everything else on.
    fn override_switch(&mut self, which: Override) {
        let on = self.request.value('P') != Some(0.0);
        match which {
            Override::Feed => self.feed_override(on),
            Override::Speed => self.speed_override(on),
            Override::Adaptive => {
                self.modal().adaptive_feed = on;
                self.emit(if on { Canon::EnableAdaptiveFeed } else { Canon::DisableAdaptiveFeed });
            }
            Override::Hold => {
                self.modal().feed_hold = on;
                self.emit(if on { Canon::EnableFeedHold } else { Canon::DisableFeedHold });
            }
        }
    }

    pub(super) fn outputs(&mut self) -> Done {
        let Some(Action::Io(code)) = self.request.code(Group::Io) else { return Ok(()) };
        match code {
            62..=65 => {
                let index = self.index('P')?;
                self.emit(match code {
                    62 => Canon::SetMotionOutputBit(index),
                    63 => Canon::ClearMotionOutputBit(index),
                    64 => Canon::SetAuxOutputBit(index),
                    _ => Canon::ClearAuxOutputBit(index),
                });
            }
            66 => return self.wait_input(),
            _ => {
                let index = self.index('E')?;
                let missing = if self.state.options.drop_in { -1.0 } else { 0.0 };
                let value = self.request.value('Q').unwrap_or(missing);
                self.emit(if code == 67 {
                    Canon::SetMotionOutputValue(index, value)
                } else {
                    Canon::SetAuxOutputValue(index, value)
                });
            }
        }
        Ok(())
    }

    /// Number of an input or output.
    fn index(&self, letter: char) -> Result<u32, Box<Diag>> {
        let at = self.request.code_span(Group::Io);
        let Some(word) = self.request.word(letter) else {
            let help = format!("write the number of the output, such as {letter}0");
            return Err(Box::new(missing(at, &letter.to_string()).help(help)));
        };
        let near = word.value.round();
        if (0.0..=f64::from(u16::MAX)).contains(&near) {
            return Ok(near as u32);
        }
        Err(Box::new(bad_value(word, "no such output", "write a whole number from 0")))
    }

    /// M66. `#5399` is the answer of the machine; while a program is only looked at, the value of the host, or 0.
    fn wait_input(&mut self) -> Done {
        let (digital, analog) = (self.request.word('P'), self.request.word('E'));
        if let (Some(_), Some(word)) = (digital, analog) {
            return Err(Box::new(bad_value(word, "a second input", "write either P or E")));
        }
        let letter = if analog.is_some() { 'E' } else { 'P' };
        let number = self.index(letter)?;
        let wait = match self.request.word('L') {
            None => 0,
            Some(word) => match word.whole().filter(|&l| l <= 4) {
                Some(l) if l == 0 || analog.is_none() => l,
                _ => return Err(Box::new(bad_value(word, "no such wait", "write L0 to L4; an analog input has L0 alone"))),
            },
        };
        let timeout = self.request.value('Q').unwrap_or(0.0);
        if wait != 0 && timeout <= 0.0 {
            let at = self.request.code_span(Group::Io);
            return Err(Box::new(missing(at, "Q").help("write the longest wait in seconds, such as M66 P0 L3 Q5")));
        }
        let name = if analog.is_some() { format!("_input_e{number}") } else { format!("_input_p{number}") };
        let value = self.state.options.host.value(&name).unwrap_or(0.0);
        if self.state.comp.waits() && !self.state.options.drop_in {
            let at = self.request.code_span(Group::Io);
            return Err(Box::new(not_now(at, "M66 while G41 or G42 is in force", "write G40 before it")));
        }
        self.state.params.set(5399, value);
        self.state.outside.awaits = Some(Awaits::Input);
        self.emit(Canon::WaitInput(Input { number, analog: analog.is_some(), wait, timeout }));
        Ok(())
    }

    /// M70 .. M73.
    fn saved_modes(&mut self, modes: Modes) -> Done {
        let modal = self.state.modal;
        let Some(place) = self.state.saved.last_mut() else { return Ok(()) };
        match modes {
            Modes::Save | Modes::SaveForCall => {
                *place = Some(Box::new(SavedModes { modal, automatic: modes == Modes::SaveForCall }));
            }
            Modes::Invalidate => *place = None,
            Modes::Restore => match place.clone() {
                Some(saved) => self.restore_modes(&saved.modal),
                None => {
                    let at = self.request.code_span(Group::Modes);
                    let help = "write M70 before it, on the same level of subroutines";
                    return Err(Box::new(Diag::new(takt_base::Code::BadFlow, at, "no modes are saved here").help(help)));
                }
            },
        }
        Ok(())
    }

    /// Brings back saved modes, in LinuxCNC's order; what moved stays where it is.
    pub fn restore_modes(&mut self, saved: &Modal) {
        self.use_units(saved.units);
        let drop_in = self.state.options.drop_in;
        if self.state.modal.feed_mode != saved.feed_mode {
            self.modal().feed_mode = saved.feed_mode;
            self.modal().feed = None;
            self.emit(Canon::SetFeedMode(saved.feed_mode == FeedMode::PerRevolution));
            if drop_in && saved.feed_mode != FeedMode::InverseTime {
                self.emit(Canon::SetFeedRate(0.0));
            }
        }
        if self.state.modal.feed.unwrap_or(0.0) != saved.feed.unwrap_or(0.0) && saved.feed_mode != FeedMode::InverseTime {
            self.modal().feed = saved.feed;
            if saved.feed.is_some() || drop_in {
                self.emit(Canon::SetFeedRate(saved.feed.unwrap_or(0.0)));
            }
        }
        if self.state.modal.speed != saved.speed {
            self.modal().speed = saved.speed;
            self.emit(Canon::SetSpindleSpeed(saved.speed));
        }
        self.use_plane(saved.plane);
        self.work_offset(saved.work_offset);
        if self.state.modal.control != saved.control {
            self.modal().control = saved.control;
            self.modal().naive_tolerance = saved.naive_tolerance;
            self.emit(Canon::SetMotionControlMode(saved.control));
            if drop_in {
                self.emit(Canon::SetNaivecamTolerance(saved.naive_tolerance));
            }
        }
        let modal = self.modal();
        modal.distance = saved.distance;
        modal.arc_distance = saved.arc_distance;
        modal.diameter = saved.diameter;
        modal.retract = saved.retract;
    }
}
