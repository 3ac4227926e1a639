//! Drilling cycles of milling: G73, G74, G76, G81 .. G89, G84.2, G84.3, G98, G99 (R1-78, R1-79, R1-83, O-09).
//! Runs: background. Invariant: a cycle is nothing but the moves that the machinist could have written.

use super::Machine;
use super::block::Block;
use super::calls::bad;
use super::kernel::Io;
use super::moves::{Seg, Shape};
use super::table::Meaning;
use super::transform::axes_of;
use crate::canon::{Canon, Direction, Plane, Position};
use crate::ngc::execute::Done;
use crate::ngc::modal::{FeedMode, Motion};
use crate::ngc::motion::check_feed;
use crate::ngc::request::{AXES, missing, not_now};
use takt_base::{Code, Diag, Span};

/// Pecks that the holes of one block may have.
const PECKS_MAX: f64 = 100_000.0;
/// Holes of one block.
const HOLES_MAX: u32 = 9999;

/// Words of the cycle in force: length units, seconds.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Drill {
    /// Number of the code in tenths.
    pub code: u16,
    /// Level of R, and of the bottom, on the drilling axis.
    pub r: f64,
    /// See [`Drill::r`].
    pub bottom: f64,
    /// Level before the first cycle.
    pub initial: f64,
    /// P.
    pub dwell: f64,
    /// Q.
    pub q: f64,
    /// I, J of G76 and G87.
    pub aside: Option<[f64; 2]>,
    /// Drilling axis: index, in the order of a position.
    pub axis: usize,
}

impl Drill {
    /// A cycle without words.
    pub(super) const fn bare(code: u16) -> Self {
        let zero = 0.0;
        Drill { code, r: zero, bottom: zero, initial: zero, dwell: zero, q: zero, aside: None, axis: 2 }
    }
}

/// A hole at work: how the tool moves.
pub(super) struct Hole<'m, 'i, 'a, 'b> {
    pub machine: &'m mut Machine,
    pub io: &'i mut Io<'a, 'b>,
    pub drill: Drill,
    /// Where the tool goes back to.
    pub clear: f64,
    pub at: Span,
}

impl Machine {
    /// True if the block is one of a drilling cycle; the holes are made.
    pub(super) fn drilling(&mut self, b: &Block, io: &mut Io) -> Result<bool, Box<Diag>> {
        let code = b.code(|m| matches!(m, Meaning::Drill(_) | Meaning::TurnDrill(_)));
        if b.code(|m| m == Meaning::DrillOff).is_some() {
            self.modes.drill = None;
            b.use_all("KL");
        }
        let Some(code) = code else {
            if b.of_group(1).is_some() && self.modes.drill.take().is_some() {
                self.modes.codes[10] = 800;
            }
            let go_on = self.modes.drill.is_some() && (self.names_axis(b) || b.any("RQP"));
            if go_on {
                let number = self.modes.drill.map_or(810, |d| d.code);
                self.drill_block(b, number, b.span, io)?;
            }
            return Ok(go_on);
        };
        match code.meaning {
            Meaning::Drill(number) | Meaning::TurnDrill(number) => self.drill_block(b, number, code.span, io)?,
            _ => {}
        }
        Ok(true)
    }

    fn drill_block(&mut self, b: &Block, number: u16, at: Span, io: &mut Io) -> Done {
        self.free(at, "a drilling cycle", io)?;
        if io.state.modal.feed_mode == FeedMode::InverseTime {
            return Err(Box::new(not_now(at, "a drilling cycle with G93", "write G94 or G95 before it")));
        }
        self.say_feed_mode(io);
        check_feed(&mut io.run(), Motion::Linear)?;
        if self.modes.turn() {
            return self.turn_drill(b, number, at, io);
        }
        let repeats = self.repeats(b)?;
        let axis = match Self::plane(io) {
            Plane::Xy => 2,
            Plane::Xz => 1,
            Plane::Yz => 0,
        };
        let drill = self.drill_words(b, number, axis, at)?;
        self.modes.drill = Some(drill);
        if !self.names_axis(b) && !b.any("R") {
            return Ok(());
        }
        self.holes(b, drill, repeats, at, io)
    }

    /// K or L: how often; 0 keeps the words and drills nothing.
    pub(super) fn repeats(&self, b: &Block) -> Result<u32, Box<Diag>> {
        match b.take(b'K').or_else(|| b.take(b'L')) {
            None => Ok(1),
            Some(word) => word
                .whole()
                .filter(|&k| k <= HOLES_MAX)
                .ok_or_else(|| bad(word, "not a number of holes", "write a whole number up to 9999")),
        }
    }

    /// The words of the block, and those of the cycle in force for what it leaves out.
    fn drill_words(&mut self, b: &Block, number: u16, axis: usize, at: Span) -> Result<Drill, Box<Diag>> {
        let old = self.modes.drill.filter(|d| d.axis == axis);
        let here: [f64; 6] = self.modes.at.into();
        let initial = old.map_or(here[axis], |d| d.initial);
        let length = |letter: u8| b.take(letter).map(|w| self.length_of(w));
        let (r, bottom) = (length(b'R'), length(AXES[axis] as u8));
        let need = |value: Option<f64>, old: Option<f64>, letter: char| {
            value.or(old).ok_or_else(|| {
                Box::new(
                    missing(at, &letter.to_string()).help("the first block of a cycle names R and the depth: G81 X1 Y2 Z-5 R2"),
                )
            })
        };
        // In G91 R counts from the initial level and the depth from R; levels that are not named stay where they are.
        let incremental = self.modes.incremental;
        let r = need(r.map(|r| if incremental { initial + r } else { r }), old.map(|d| d.r), 'R')?;
        let bottom = need(bottom.map(|z| if incremental { r + z } else { z }), old.map(|d| d.bottom), AXES[axis])?;
        let aside = match (length(b'I'), length(b'J')) {
            (None, None) => old.and_then(|d| d.aside),
            (i, j) => Some([i.unwrap_or(0.0), j.unwrap_or(0.0)]),
        };
        let dwell = b.take(b'P').map(|p| p.value / 1000.0).or(old.map(|d| d.dwell)).unwrap_or(0.0);
        let q = length(b'Q').map(f64::abs).or(old.map(|d| d.q)).unwrap_or(0.0);
        let drill = Drill { code: number, r, bottom, initial, dwell, q, aside, axis };
        self.check_drill(&drill, at)?;
        Ok(drill)
    }

    /// The words of a cycle fit each other.
    pub(super) fn check_drill(&self, drill: &Drill, at: Span) -> Done {
        let wrong = |label: &str, help: &str| Err(Box::new(Diag::new(Code::BadValue, at, label).help(help)));
        let back_boring = drill.code == 870 && !self.modes.turn();
        if drill.dwell < 0.0 || drill.dwell > 1e6 {
            return wrong("no time of a dwell", "P is in milliseconds");
        }
        if drill.r < drill.bottom && !back_boring && !self.modes.turn() {
            return wrong(
                "R lies below the bottom of the hole",
                "the tool drills from R to the depth, in the negative direction of the axis",
            );
        }
        let pecks = matches!(drill.code, 730 | 830);
        if pecks && (drill.q <= 0.0 || (drill.r - drill.bottom).abs() / drill.q > PECKS_MAX) && !self.modes.turn() {
            return Err(Box::new(missing(at, "Q").help("write the depth of a peck, such as Q2.")));
        }
        Ok(())
    }

    fn holes(&mut self, b: &Block, drill: Drill, repeats: u32, at: Span, io: &mut Io) -> Done {
        let [i, j] = axes_of(Self::plane(io));
        let here: [f64; 6] = self.modes.at.into();
        let end: [f64; 6] = self.target(b, io)?.into();
        let incremental = self.modes.incremental;
        let clear = if self.modes.initial_level { drill.initial.max(drill.r) } else { drill.r };
        let clear = if drill.code == 870 { drill.initial } else { clear };
        let pecks = if drill.q > 0.0 { (drill.r - drill.bottom).abs() / drill.q } else { 1.0 };
        if matches!(drill.code, 730 | 830) && pecks * f64::from(repeats) > PECKS_MAX {
            return Err(Box::new(Diag::new(Code::BadValue, at, "more than 100000 pecks").help("make Q larger, or K smaller")));
        }
        let mut place = here;
        for k in 0..repeats {
            // Increments, those of polar coordinates too, count from the hole before.
            let next: [f64; 6] = if k > 0 && incremental { self.target(b, io)?.into() } else { end };
            (place[i], place[j]) = (next[i], next[j]);
            // Axes beside the plane move with the first hole.
            for (n, value) in end.into_iter().enumerate() {
                if n != drill.axis && n != i && n != j {
                    place[n] = value;
                }
            }
            let now: [f64; 6] = self.modes.at.into();
            place[drill.axis] = now[drill.axis];
            let mut hole = Hole { machine: self, io, drill, clear, at };
            hole.to(place.into(), false)?;
            hole.make()?;
        }
        Ok(())
    }
}

impl Hole<'_, '_, '_, '_> {
    /// A move to a programmed point.
    pub(super) fn to(&mut self, to: Position, feed: bool) -> Done {
        let from = self.machine.modes.at;
        if from == to && !feed {
            return Ok(());
        }
        let shape = if feed { Shape::Line } else { Shape::Rapid };
        self.machine.go(Seg { from, to, shape, at: self.at }, None, self.io)
    }

    /// A move along the drilling axis.
    pub(super) fn level(&mut self, level: f64, feed: bool) -> Done {
        let mut to: [f64; 6] = self.machine.modes.at.into();
        to[self.drill.axis] = level;
        self.to(to.into(), feed)
    }

    fn dwell(&mut self) {
        if self.drill.dwell > 0.0 {
            self.io.emit(Canon::Dwell(self.drill.dwell));
        }
    }

    fn make(&mut self) -> Done {
        let Drill { code, r, bottom, .. } = self.drill;
        if code == 870 {
            return self.back_bore();
        }
        self.level(r, false)?;
        match code {
            730 => self.peck(false)?,
            830 => self.peck(true)?,
            740 => self.tap(Direction::Counterclockwise)?,
            840 => self.tap(Direction::Clockwise)?,
            843 => self.rigid(Direction::Counterclockwise)?,
            842 => self.rigid(Direction::Clockwise)?,
            760 => self.fine_bore()?,
            860 => {
                self.level(bottom, true)?;
                self.dwell();
                let way = self.stop()?;
                self.level(self.clear, false)?;
                self.start(way);
            }
            880 => {
                self.level(bottom, true)?;
                self.dwell();
                let way = self.stop()?;
                // The machinist draws the tool out by hand.
                self.io.emit(Canon::ProgramStop);
                self.level(r, false)?;
                self.level(self.clear, false)?;
                self.start(way);
            }
            850 | 890 => {
                self.level(bottom, true)?;
                if code == 890 {
                    self.dwell();
                }
                self.level(r, true)?;
            }
            _ => {
                self.level(bottom, true)?;
                if code == 820 {
                    self.dwell();
                }
            }
        }
        self.level(self.clear, false)
    }

    /// G83 clears the chips at R, G73 breaks them in the hole. Of turning without Q there is one peck.
    pub(super) fn peck(&mut self, clear: bool) -> Done {
        let Drill { r, bottom, q, .. } = self.drill;
        let unit = self.io.state.unit();
        let settings = &self.machine.modes.settings;
        let back = if clear { settings.peck_clearance_mm } else { settings.chip_break_mm } / unit;
        let way = if bottom < r { -1.0 } else { 1.0 };
        let length = (r - bottom).abs();
        let mut depth = q;
        while q > 0.0 && depth < length - 1e-9 {
            self.level(r + way * depth, true)?;
            if clear {
                self.level(r, false)?;
                self.level(r + way * (depth - back).max(0.0), false)?;
            } else {
                self.level(r + way * (depth - back), false)?;
            }
            depth += q;
        }
        self.level(bottom, true)?;
        self.dwell();
        Ok(())
    }

    fn turning(&self) -> Result<Direction, Box<Diag>> {
        self.io.state.modal.spindle.ok_or_else(|| {
            let label = format!("G{} with the spindle stopped", f64::from(self.drill.code) / 10.0);
            Box::new(Diag::new(Code::SpindleStopped, self.at, label).help("write S and M3 or M4 before it"))
        })
    }

    /// The spindle stops; which way it turned.
    fn stop(&mut self) -> Result<Direction, Box<Diag>> {
        let way = self.turning()?;
        self.io.emit(Canon::StopSpindleTurning);
        Ok(way)
    }

    fn start(&mut self, way: Direction) {
        self.io.emit(match way {
            Direction::Clockwise => Canon::StartSpindleClockwise,
            Direction::Counterclockwise => Canon::StartSpindleCounterclockwise,
        });
    }

    pub(super) fn tap(&mut self, way: Direction) -> Done {
        if self.machine.modes.rigid {
            return self.rigid(way);
        }
        let is = self.turning()?;
        if is != way {
            let diag = Diag::new(Code::SpindleStopped, self.at, "the spindle turns the other way");
            return Err(Box::new(diag.help("G84 needs M3, G74 needs M4; M29 before them makes tapping rigid")));
        }
        let back = if way == Direction::Clockwise { Direction::Counterclockwise } else { Direction::Clockwise };
        let on = self.io.state.modal.overrides;
        self.io.emit(Canon::DisableFeedOverride);
        self.level(self.drill.bottom, true)?;
        self.io.emit(Canon::StopSpindleTurning);
        self.dwell();
        self.start(back);
        self.level(self.drill.r, true)?;
        self.io.emit(Canon::StopSpindleTurning);
        self.dwell();
        self.start(way);
        if on {
            self.io.emit(Canon::EnableFeedOverride);
        }
        Ok(())
    }

    /// In step with the spindle: F is the feed (G94), or the lead (G95).
    fn rigid(&mut self, way: Direction) -> Done {
        let modal = &self.io.state.modal;
        let (feed, speed) = (modal.feed.unwrap_or(0.0), modal.speed);
        if speed <= 0.0 {
            let diag = Diag::new(Code::SpindleStopped, self.at, "rigid tapping without a speed");
            return Err(Box::new(diag.help("write S, such as M29 S500")));
        }
        let lead = if modal.feed_mode == FeedMode::PerRevolution { feed } else { feed / speed };
        if modal.spindle != Some(way) {
            self.io.state.modal.spindle = Some(way);
            self.start(way);
        }
        let mut end: [f64; 6] = self.machine.modes.at.into();
        end[self.drill.axis] = self.drill.bottom;
        let end = self.machine.modes.transform.apply(end.into());
        self.io.emit(Canon::StartSpeedFeedSync(lead));
        let here = self.io.state.modal.position;
        self.io.place(Canon::RigidTap(end), here, self.at);
        self.io.emit(Canon::StopSpeedFeedSynch);
        Ok(())
    }

    /// The step aside of G76 and G87, on the axes of the plane.
    fn aside(&mut self, out: bool) -> Done {
        let [i, j] = axes_of(Machine::plane(self.io));
        let [di, dj] = self.drill.aside.unwrap_or([self.drill.q, 0.0]);
        let mut to: [f64; 6] = self.machine.modes.at.into();
        let sign = if out { 1.0 } else { -1.0 };
        to[i] += sign * di;
        to[j] += sign * dj;
        self.to(to.into(), false)
    }

    fn orient(&mut self, way: Direction) {
        self.io.emit(Canon::StopSpindleTurning);
        self.io.emit(Canon::OrientSpindle(0.0, way));
    }

    /// G76: in, orient, aside, out, back (book 2.3.6).
    fn fine_bore(&mut self) -> Done {
        let way = self.turning()?;
        self.level(self.drill.bottom, true)?;
        self.dwell();
        self.orient(way);
        self.aside(true)?;
        self.level(self.clear, false)?;
        self.aside(false)?;
        self.start(way);
        Ok(())
    }

    /// G87: in beside the hole to R, over, up to the bottom of the bore, and out again.
    fn back_bore(&mut self) -> Done {
        let way = self.turning()?;
        self.orient(way);
        self.aside(true)?;
        self.level(self.drill.r, false)?;
        self.aside(false)?;
        self.start(way);
        self.level(self.drill.bottom, true)?;
        self.dwell();
        self.orient(way);
        self.aside(true)?;
        self.level(self.drill.initial, false)?;
        self.aside(false)?;
        self.start(way);
        Ok(())
    }
}
