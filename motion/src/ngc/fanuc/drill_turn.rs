//! Drilling cycles of turning: G83, G84, G85 along Z, G87, G88, G89 along X (R1-80). R counts from the level before the cycle.

use super::Machine;
use super::block::Block;
use super::drill::{Drill, Hole};
use super::kernel::Io;
use crate::canon::{Canon, Direction};
use crate::ngc::execute::Done;
use crate::ngc::request::{AXES, missing};
use takt_base::{Code, Diag, Span};

impl Machine {
    pub(super) fn turn_drill(&mut self, b: &Block, number: u16, at: Span, io: &mut Io) -> Done {
        let axis = if number < 870 { 2 } else { 0 };
        let repeats = self.repeats(b)?;
        let old = self.modes.drill.filter(|d| d.axis == axis);
        let here: [f64; 6] = self.modes.at.into();
        let initial = here[axis];
        let depth = b.take(AXES[axis] as u8).map(|w| self.along(axis, w));
        let step = self.increment(b, axis).map(|w| self.along(axis, w));
        // R is an increment, and of X a radius.
        let r = initial + b.take(b'R').map_or(old.map_or(0.0, |d| d.r - d.initial), |w| self.length_of(w));
        let bottom = match (depth, step, old) {
            (Some(z), ..) => z,
            (None, Some(w), _) => r + w,
            (None, None, Some(d)) => d.bottom,
            _ => return Err(Box::new(missing(at, &AXES[axis].to_string()).help("write the bottom of the hole: G83 Z-20 Q5"))),
        };
        let dwell = b.take(b'P').map(|p| p.value / 1000.0).or(old.map(|d| d.dwell)).unwrap_or(0.0);
        let q = b.take(b'Q').map(|w| self.increments_of(w).abs()).or(old.map(|d| d.q)).unwrap_or(0.0);
        if q > 0.0 && (r - bottom).abs() / q * f64::from(repeats) > 100_000.0 {
            return Err(Box::new(Diag::new(Code::BadValue, at, "more than 100000 pecks").help("make Q larger: Q5000 is 5 mm")));
        }
        b.use_all("M");
        let drill = Drill::of_turning(number, [r, bottom, initial], dwell, q, axis);
        self.check_drill(&drill, at)?;
        self.modes.drill = Some(drill);
        let place = self.places_beside(b, axis, io)?;
        for _ in 0..repeats {
            let mut hole = Hole { machine: self, io, drill, clear: initial, at };
            let mut to = place;
            to[axis] = initial;
            hole.to(to.into(), false)?;
            hole.level(r, false)?;
            hole.make_turning()?;
            hole.level(initial, false)?;
        }
        Ok(())
    }

    /// Where the hole is on the other axes.
    fn places_beside(&mut self, b: &Block, axis: usize, io: &Io) -> Result<[f64; 6], Box<Diag>> {
        let here: [f64; 6] = self.modes.at.into();
        let mut to: [f64; 6] = self.target(b, io)?.into();
        to[axis] = here[axis];
        Ok(to)
    }
}

impl Drill {
    fn of_turning(code: u16, [r, bottom, initial]: [f64; 3], dwell: f64, q: f64, axis: usize) -> Self {
        Drill { r, bottom, initial, dwell, q, axis, ..Drill::bare(code) }
    }
}

impl Hole<'_, '_, '_, '_> {
    fn make_turning(&mut self) -> Done {
        let Drill { code, r, bottom, dwell, .. } = self.drill;
        match code {
            830 | 870 => self.peck(true),
            840 | 880 => self.tap(Direction::Clockwise),
            _ => {
                self.level(bottom, true)?;
                if dwell > 0.0 {
                    self.io.emit(Canon::Dwell(dwell));
                }
                self.level(r, true)
            }
        }
    }
}
