//! Feed, speed, tools, M codes, compensation.

use super::Machine;
use super::block::Block;
use super::calls::bad;
use super::kernel::Io;
use super::table::Meaning;
use crate::canon::{Canon, Direction};
use crate::ngc::execute::Done;
use crate::ngc::modal::{FeedMode, Side};
use crate::ngc::request::{missing, not_now};
use crate::ngc::word::{Action, Coolant, Length};
use takt_base::{Diag, Span};

impl Machine {
    pub(super) fn feed_and_speed(&mut self, b: &Block, io: &mut Io) -> Done {
        if let Some(word) = b.words.iter().find(|w| matches!(w.letter, b'F' | b'S') && w.value < 0.0) {
            return Err(bad(*word, "less than zero", "write zero or more"));
        }
        if let Some(code) = b.code(|m| matches!(m, Meaning::Feed(_))) {
            self.feed_mode(code.meaning, code.span, io);
        }
        self.speed(b, io)?;
        if let Some(f) = b.take(b'F') {
            io.obey(&[], &[('F', f.value)], f.span);
        }
        Ok(())
    }

    fn feed_mode(&mut self, meaning: Meaning, at: Span, io: &mut Io) {
        self.said_feed_mode = true;
        let mode = match meaning {
            Meaning::Feed(3) => FeedMode::InverseTime,
            Meaning::Feed(5) => FeedMode::PerRevolution,
            _ => FeedMode::PerMinute,
        };
        if mode != io.state.modal.feed_mode {
            io.obey(&[Action::Feed(mode)], &[], at);
        }
    }

    /// S with G96 and G97. With G50 and G92 it is the largest speed, with M19 an angle.
    fn speed(&mut self, b: &Block, io: &mut Io) -> Done {
        let clamps = b.code(|m| m == Meaning::Coordinates).is_some();
        if clamps {
            self.clamp(b, io)?;
        }
        let speed = if clamps || b.m.iter().any(|m| m.0 == 19) { None } else { b.take(b'S') };
        let Some(code) = b.code(|m| matches!(m, Meaning::Surface(_))) else {
            if let Some(word) = speed {
                io.obey(&[], &[('S', word.value)], word.span);
            }
            return Ok(());
        };
        let on = code.meaning == Meaning::Surface(true);
        let value = speed.map(|w| w.value).or(on.then_some(io.state.modal.speed));
        let largest = self.modes.clamp.filter(|_| on);
        let words: Vec<(char, f64)> = value.map(|s| ('S', s)).into_iter().chain(largest.map(|d| ('D', d))).collect();
        io.obey(&[Action::SurfaceSpeed(on)], &words, code.span);
        Ok(())
    }

    /// G50 S, G92 S: the largest speed.
    fn clamp(&mut self, b: &Block, io: &mut Io) -> Done {
        let Some(word) = b.take(b'S') else { return Ok(()) };
        if word.value <= 0.0 {
            return Err(bad(word, "no speed", "write the largest speed in revolutions a minute"));
        }
        self.modes.clamp = Some(word.value);
        if io.state.modal.surface_speed.is_some() {
            io.state.modal.surface_speed = Some(word.value);
            io.emit(Canon::SetSpindleMode(Some(word.value)));
        }
        Ok(())
    }

    pub(super) fn tool(&mut self, b: &Block, io: &mut Io) -> Done {
        let change = b.m.iter().find(|m| m.0 == 6);
        let Some(word) = b.take(b'T') else {
            if let Some(&(_, span)) = change {
                io.obey(&[Action::ToolChange], &[], span);
                self.sync(io);
            }
            return Ok(());
        };
        let number = word.whole().ok_or_else(|| bad(word, "not the number of a tool", "write a whole number from 0"))?;
        if self.modes.turn() {
            return self.turret(number, word.span, io);
        }
        match change {
            Some(&(_, span)) => io.obey(&[Action::ToolChange], &[('T', f64::from(number))], span),
            None => io.obey(&[], &[('T', f64::from(number))], word.span),
        }
        Ok(())
    }

    /// `T0101`: turret position and offset number.
    fn turret(&mut self, number: u32, at: Span, io: &mut Io) -> Done {
        io.run().uncompensated(at, "another tool")?;
        let (tool, offset) = (number / 100, number % 100);
        if tool != 0 && tool != io.state.modal.tool_in_spindle {
            let entry = io.run().tool(tool, at)?;
            io.state.tools.load(entry);
            io.state.modal.tool = tool;
            io.state.modal.tool_in_spindle = tool;
            io.emit(Canon::SelectTool(tool));
            io.emit(Canon::ChangeTool(tool));
        }
        (self.modes.d, self.modes.h) = (offset, offset);
        let (entry, wear) = (io.run().tool(offset, at)?, self.modes.wear_of(offset));
        let (x, z) = (entry.offset[0] + wear.x, entry.offset[2] + wear.z);
        self.length(&[('X', x), ('Z', z)], at, io);
        Ok(())
    }

    /// Tool offsets in mm become those in force.
    fn length(&mut self, offsets: &[(char, f64)], at: Span, io: &mut Io) {
        let unit = io.state.unit();
        let words: Vec<(char, f64)> = offsets.iter().map(|&(letter, mm)| (letter, mm / unit)).collect();
        io.obey(&[Action::Length(Length::Dynamic)], &words, at);
        self.sync(io);
    }

    pub(super) fn auxiliary(&mut self, b: &Block, io: &mut Io) -> Done {
        for &(m, span) in &b.m {
            match m {
                0 | 1 | 2 | 6 | 30 | 98 | 99 => {}
                3 => io.obey(&[Action::Spindle(Some(Direction::Clockwise))], &[], span),
                4 => io.obey(&[Action::Spindle(Some(Direction::Counterclockwise))], &[], span),
                5 => io.obey(&[Action::Spindle(None)], &[], span),
                7 => io.obey(&[Action::Coolant(Coolant::Mist)], &[], span),
                8 => io.obey(&[Action::Coolant(Coolant::Flood)], &[], span),
                9 => io.obey(&[Action::Coolant(Coolant::Off)], &[], span),
                19 => match b.value(b'S') {
                    Some(angle) => io.obey(&[Action::Orient], &[('R', angle)], span),
                    None => io.obey(&[Action::Orient], &[], span),
                },
                29 => self.modes.rigid = true,
                48 | 49 => io.obey(&[Action::Overrides(m == 48)], &[], span),
                _ => {
                    let alone = b.codes.is_empty() && b.m.len() == 1;
                    let word = |letter| if alone { b.value(letter) } else { None };
                    io.emit(Canon::UserMCode { code: m, p: word(b'P'), q: word(b'Q') });
                }
            }
        }
        Ok(())
    }

    pub(super) fn compensation(&mut self, b: &Block, io: &mut Io) -> Done {
        let d = Self::whole_word_if(b, b'D', !self.modes.turn())?;
        if let Some(d) = d {
            self.modes.d = d;
        }
        if let Some(code) = b.code(|m| matches!(m, Meaning::Side(_))) {
            self.side(code.meaning, code.span, io)?;
        }
        self.tool_length(b, io)
    }

    fn whole_word_if(b: &Block, letter: u8, wanted: bool) -> Result<Option<u32>, Box<Diag>> {
        if wanted { Self::whole_word(b, letter, "write the number of an offset") } else { Ok(None) }
    }

    fn side(&mut self, meaning: Meaning, at: Span, io: &mut Io) -> Done {
        let Meaning::Side(way) = meaning else { return Ok(()) };
        if way == 0 {
            self.end_corner(io);
            io.obey(&[Action::Compensation(None, false)], &[], at);
            return Ok(());
        }
        if self.modes.virtual_axis.is_some() {
            let help = "let the CAM system set the tool aside, or write the path of its centre";
            return Err(Box::new(not_now(at, "compensation under polar or cylindrical interpolation", help)));
        }
        let mirrored = self.modes.transform.turns_arcs(Self::plane(io)) == Some(true);
        let side = if (way > 0) != mirrored { Side::Left } else { Side::Right };
        if io.state.modal.side == Some(side) {
            return Ok(());
        }
        let entry = io.run().tool(self.modes.d, at)?;
        let radius = entry.diameter / 2.0 + self.modes.wear_of(self.modes.d).radius;
        let lathe = Self::plane(io) == crate::canon::Plane::Xz;
        let tip = if lathe { f64::from(tip(entry.orientation)) } else { 0.0 };
        let words = [('D', 2.0 * radius / io.state.unit()), ('L', tip)];
        io.obey(&[Action::Compensation(Some(side), true)], &words, at);
        Ok(())
    }

    /// G43, G44, G49, and H.
    fn tool_length(&mut self, b: &Block, io: &mut Io) -> Done {
        let code = b.code(|m| matches!(m, Meaning::Length(_)));
        let way = match code.map(|c| c.meaning) {
            Some(Meaning::Length(way)) => way,
            _ if self.modes.turn() || b.take(b'H').is_none() => return Ok(()),
            _ => match self.modes.codes[13] {
                430 => 1,
                440 => -1,
                _ => return Err(Box::new(missing(b.span, "G43").help("write G43 H1"))),
            },
        };
        let at = code.map_or(b.span, |c| c.span);
        if way == 0 {
            self.modes.h = 0;
            io.obey(&[Action::Length(Length::Off)], &[], at);
            self.sync(io);
            return Ok(());
        }
        if let Some(h) = Self::whole_word(b, b'H', "write the number of a length offset, such as H1")? {
            self.modes.h = h;
        }
        let (entry, wear) = (io.run().tool(self.modes.h, at)?, self.modes.wear_of(self.modes.h));
        self.length(&[('Z', f64::from(way) * (entry.offset[2] + wear.z))], at, io);
        Ok(())
    }
}

/// Number of the tool tip as the kernel counts: it sees X the other way round.
const fn tip(number: u32) -> u32 {
    match number {
        1 => 4,
        2 => 3,
        3 => 2,
        4 => 1,
        6 => 8,
        8 => 6,
        other => other,
    }
}
