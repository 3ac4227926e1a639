//! G10: work systems (L2, L20), tool offsets (L1, L10 to L13; of turning without L).

use super::Machine;
use super::block::{Block, Word};
use super::calls::bad;
use super::kernel::Io;
use crate::canon::{Canon, Position, ToolEntry};
use crate::ngc::execute::Done;
use crate::ngc::request::{AXES, missing};
use crate::ngc::state::WORK_FIRST;
use takt_base::{Code, Diag, Span};

impl Machine {
    pub(super) fn data(&mut self, b: &Block, at: Span, io: &mut Io) -> Done {
        self.free(at, "G10", io)?;
        let help = "write G10 L2, L20, L10, L11, L12 or L13";
        match (Self::whole_word(b, b'L', help)?, self.modes.turn()) {
            (Some(2), _) => self.work_data(b, at, false, io),
            (Some(20), _) => self.work_data(b, at, true, io),
            (None, true) => self.turning_offset(b, at, io),
            (Some(l @ (1 | 10 | 11 | 12 | 13)), false) => self.milling_offset(b, l, at, io),
            (None, false) => Err(Box::new(missing(at, "L").help(help))),
            (Some(_), _) => {
                let diag = Diag::new(Code::NotOfThisControl, at, "data of this control that are not here");
                Err(Box::new(
                    diag.help("tool life and parameters are kept outside of the program; G10 knows L2, L10 to L13, L20"),
                ))
            }
        }
    }

    fn number(b: &Block, at: Span) -> Result<(Word, u32), Box<Diag>> {
        let Some(p) = b.take(b'P') else {
            return Err(Box::new(missing(at, "P").help("write the number of the system or offset")));
        };
        let number = p.whole().ok_or_else(|| bad(p, "not a number of a table", "write a whole number"))?;
        Ok((p, number))
    }

    /// P0 is the shift of all systems, P1 is G54; of L20 P1 is G54.1 P1.
    fn work_data(&mut self, b: &Block, at: Span, more: bool, io: &mut Io) -> Done {
        let (word, p) = Self::number(b, at)?;
        let refuse = || bad(word, "no such work system", "write P0 to P6 with L2, P1 to P300 with L20");
        let old = match (more, p as usize) {
            (true, 1..=super::modes::MORE_SYSTEMS) => *self.more_system(p as usize - 1),
            (false, 0) => self.modes.external,
            (false, 1..=6) => io.state.stored(WORK_FIRST + 20 * (p as u16 - 1)),
            _ => return Err(refuse()),
        };
        let new = self.changed(b, old, io);
        match (more, p) {
            (true, _) => *self.more_system(p as usize - 1) = new,
            (false, 0) => self.modes.external = new,
            _ => io.state.store(WORK_FIRST + 20 * (p as u16 - 1), new),
        }
        self.apply_origin(io);
        Ok(())
    }

    /// `old` (mm) with the words of the block: places, or increments in G91 and by U, V, W.
    fn changed(&self, b: &Block, old: Position, io: &Io) -> Position {
        let mut all: [f64; 6] = old.into();
        for (i, letter) in AXES.into_iter().enumerate() {
            let increment = self.increment(b, i);
            let word = b.take(letter as u8);
            let value = |w: Word| self.stored(i as u32, self.length_of(w), io);
            match (word, increment) {
                (Some(w), _) if self.modes.incremental => all[i] += value(w),
                (Some(w), _) => all[i] = value(w),
                (None, Some(w)) => all[i] += value(w),
                (None, None) => {}
            }
        }
        all.into()
    }

    /// L10 length, L11 and L1 its wear, L12 radius, L13 its wear.
    fn milling_offset(&mut self, b: &Block, l: u32, at: Span, io: &mut Io) -> Done {
        let (_, number) = Self::number(b, at)?;
        let Some(r) = b.take(b'R') else { return Err(Box::new(missing(at, "R").help("write the value of the offset"))) };
        let (mut entry, mut wear) = (io.run().tool(number, at)?, self.modes.wear_of(number));
        let mm = self.length_of(r) * io.state.unit();
        let place = match l {
            10 => &mut entry.offset[2],
            12 => &mut entry.diameter,
            13 => &mut wear.radius,
            _ => &mut wear.z,
        };
        let mm = if l == 12 { 2.0 * mm } else { mm };
        *place = if self.modes.incremental { *place + mm } else { mm };
        self.modes.wear.insert(number, wear);
        self.store_entry(entry, io);
        Ok(())
    }

    /// `G10 P X Z R Q`: P1 is wear, P10001 geometry; U, W and C are increments.
    fn turning_offset(&mut self, b: &Block, at: Span, io: &mut Io) -> Done {
        let (_, p) = Self::number(b, at)?;
        let (number, geometry) = (p % 10_000, p >= 10_000);
        let (mut entry, mut wear) = (io.run().tool(number, at)?, self.modes.wear_of(number));
        let old = if geometry { (entry.offset[0], entry.offset[2]) } else { (wear.x, wear.z) };
        let new = self.changed(b, Position { x: old.0, z: old.1, ..Position::default() }, io);
        let radius = if geometry { entry.diameter / 2.0 } else { wear.radius };
        let radius = b.take(b'R').map_or(radius, |w| self.length_of(w) * io.state.unit());
        if let Some(q) = b.take(b'Q') {
            let tip = q.whole().filter(|&q| q <= 9);
            entry.orientation = tip.ok_or_else(|| bad(q, "no tip of a tool", "write a whole number from 0 to 9"))?;
        }
        if geometry {
            (entry.offset[0], entry.offset[2], entry.diameter) = (new.x, new.z, 2.0 * radius);
        } else {
            (wear.x, wear.z, wear.radius) = (new.x, new.z, radius);
        }
        self.modes.wear.insert(number, wear);
        self.store_entry(entry, io);
        Ok(())
    }

    fn store_entry(&mut self, entry: ToolEntry, io: &mut Io) {
        if entry.tool == 0 {
            return;
        }
        io.state.tools.set(entry);
        io.emit(Canon::SetToolTableEntry(Box::new(entry)));
        if entry.tool == io.state.modal.tool_in_spindle {
            io.state.tools.load(entry);
        }
    }
}
