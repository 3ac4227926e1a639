//! Single passes of turning: G90 along, G94 across, G92 a thread. Their words stay until another motion code (R1-80, R2-180).

use super::Machine;
use super::block::Block;
use super::kernel::Io;
use super::moves::{Seg, Shape};
use super::table::Pass;
use crate::canon::{Canon, Position};
use crate::ngc::execute::Done;
use crate::ngc::request::missing;
use takt_base::{Code, Diag, Span};

/// Words of the pass in force, in length units; X as a radius.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct PassWords {
    code: u32,
    x: Option<f64>,
    z: Option<f64>,
    taper: f64,
}

impl PassWords {
    /// Another motion code, another unit.
    pub fn forget(&mut self) {
        *self = PassWords::default();
    }
}

impl Machine {
    pub(super) fn pass(&mut self, b: &Block, pass: Pass, io: &mut Io) -> Done {
        self.free(b.span, "a turning cycle", io)?;
        let code = self.modes.codes[1];
        let old = if self.modes.pass.code == code { self.modes.pass } else { PassWords::default() };
        let start = self.modes.at;
        let to = self.target(b, io)?;
        let x = if b.any("XU") { Some(to.x) } else { old.x };
        let z = if b.any("ZW") { Some(to.z) } else { old.z };
        // R, formerly I or K, is the way from the end of the cut back to its start on the tapered axis.
        let older = if pass == Pass::Face { b'K' } else { b'I' };
        let taper = b.take(b'R').or_else(|| b.take(older)).map_or(old.taper, |w| self.length_of(w));
        self.modes.pass = PassWords { code, x, z, taper };
        let (Some(x), Some(z)) = (x, z) else {
            return Err(Box::new(missing(b.span, "X or Z").help("the first block of a cycle names X and Z: G90 X40 Z-30 F0.2")));
        };
        if !b.any("XZUW") {
            return Ok(());
        }
        match pass {
            Pass::Along => self.loop_of(
                start,
                [Position { x: x + taper, ..start }, Position { x, z, ..start }, Position { z, ..start }],
                b.span,
                io,
            ),
            Pass::Face => self.loop_of(
                start,
                [Position { z: z + taper, ..start }, Position { x, z, ..start }, Position { x, ..start }],
                b.span,
                io,
            ),
            Pass::Thread => self.thread_pass(b, start, [x, z, taper], io),
        }
    }

    /// Traverse to the first point, feed to the second and third, traverse back.
    fn loop_of(&mut self, start: Position, [a, b, c]: [Position; 3], at: Span, io: &mut Io) -> Done {
        self.step(a, Shape::Rapid, at, io)?;
        self.step(b, Shape::Line, at, io)?;
        self.step(c, Shape::Line, at, io)?;
        self.step(start, Shape::Rapid, at, io)
    }

    /// A move of a cycle.
    pub(super) fn step(&mut self, to: Position, shape: Shape, at: Span, io: &mut Io) -> Done {
        let from = self.modes.at;
        if from == to {
            return Ok(());
        }
        self.go(Seg { from, to, shape, at }, None, io)
    }

    fn thread_pass(&mut self, b: &Block, start: Position, [x, z, taper]: [f64; 3], io: &mut Io) -> Done {
        let lead = self.lead(b, io)?;
        self.no_start_angle(b)?;
        let pullout = self.modes.settings.thread_pullout_leads * lead;
        self.step(Position { x: x + taper, ..start }, Shape::Rapid, b.span, io)?;
        self.cut_thread(Position { x, z, ..start }, start.x, lead, pullout, b.span, io)?;
        self.step(Position { x: start.x, ..self.modes.at }, Shape::Rapid, b.span, io)?;
        self.step(start, Shape::Rapid, b.span, io)
    }

    /// Q shifts the start by an angle of the spindle; the same thread starts a part of its lead away.
    pub(super) fn no_start_angle(&self, b: &Block) -> Done {
        match b.take(b'Q') {
            Some(word) if word.value != 0.0 => {
                let help = "start the cut a part of the lead away: W shifts the second start of two by half the lead";
                Err(Box::new(Diag::new(Code::NotOfThisControl, word.span, "a start angle of a thread").help(help)))
            }
            _ => Ok(()),
        }
    }

    /// One cut of a thread to `end`, with a pull-out towards `away` on X over the last part.
    pub(super) fn cut_thread(&mut self, end: Position, away: f64, lead: f64, pullout: f64, at: Span, io: &mut Io) -> Done {
        let from = self.modes.at;
        let (dz, dx) = (end.z - from.z, end.x - from.x);
        let length = libm::hypot(dz, dx);
        if length <= 0.0 {
            return Ok(());
        }
        let rise = (away - end.x).abs().min(pullout).min(length);
        // The lead counts along the axis with the longer way; in step, along the path.
        let along = lead * length / dz.abs().max(dx.abs());
        self.say_feed_mode(io);
        io.emit(Canon::StartSpeedFeedSync(along));
        let share = (length - rise) / length;
        let bend = Position { x: from.x + dx * share, z: from.z + dz * share, ..end };
        self.in_step(bend, at, io);
        if rise > 0.0 {
            let out = Position { x: end.x + (away - end.x).signum() * rise, ..end };
            self.in_step(out, at, io);
        }
        io.emit(Canon::StopSpeedFeedSynch);
        Ok(())
    }

    /// A feed move that the spindle leads.
    fn in_step(&mut self, to: Position, at: Span, io: &mut Io) {
        self.modes.at = to;
        let end = self.modes.transform.apply(to);
        io.place(Canon::StraightFeed(end), end, at);
    }
}
