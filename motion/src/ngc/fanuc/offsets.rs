//! Work systems, shifts, transformations, polar coordinates: where the programmed point is.

use super::Machine;
use super::block::Block;
use super::calls::bad;
use super::kernel::Io;
use super::modes::{MORE_SYSTEMS, Pole};
use super::table::Meaning;
use super::transform::{Transform, axes_of};
use crate::canon::Position;
use crate::ngc::execute::Done;
use crate::ngc::modal::{minus, plus, scaled};
use crate::ngc::request::{AXES, missing, not_now};
use takt_base::{Diag, Span};

impl Machine {
    /// The programmed point from where the kernel stands.
    pub(super) fn sync(&mut self, io: &Io) {
        if self.modes.virtual_axis.is_none() {
            self.modes.at = self.modes.transform.undo(io.state.modal.position);
        }
    }

    /// Puts origins that changed into force.
    pub(super) fn apply_origin(&mut self, io: &mut Io) {
        let work = self.modes.origin(io.state);
        let local = plus(self.modes.shift, self.modes.local);
        io.origin(work, local);
        self.sync(io);
    }

    /// G54 .. G59, G54.1 P, G90, G91, G98, G99.
    pub(super) fn systems(&mut self, b: &Block, io: &mut Io) -> Done {
        for code in &b.codes {
            match code.meaning {
                Meaning::Work(i) => {
                    let more = if i == 0 { Self::whole_word(b, b'P', "write G54.1 P1 to P300")? } else { None };
                    self.work(more.map_or(Ok(usize::from(i)), |p| more_index(p, code.span))?, code.span, io)?;
                }
                Meaning::MoreWork => {
                    let Some(p) = Self::whole_word(b, b'P', "write G54.1 P1 to P300")? else {
                        return Err(Box::new(missing(code.span, "P").help("write the number of the system, such as G54.1 P1")));
                    };
                    self.work(more_index(p, code.span)?, code.span, io)?;
                }
                Meaning::Incremental(on) => self.modes.incremental = on,
                Meaning::InitialLevel(on) => self.modes.initial_level = on,
                _ => {}
            }
        }
        Ok(())
    }

    fn work(&mut self, index: usize, at: Span, io: &mut Io) -> Done {
        if index == self.modes.work {
            return Ok(());
        }
        self.free(at, "another work system", io)?;
        self.modes.work = index;
        io.state.modal.work_offset = index.min(5);
        io.state.params.set(5220, index.min(5) as f64 + 1.0);
        self.apply_origin(io);
        Ok(())
    }

    /// An error while compensation or virtual axes are in force; a corner that waits goes out.
    pub(super) fn free(&mut self, at: Span, what: &str, io: &mut Io) -> Done {
        self.end_corner(io);
        io.run().uncompensated(at, what)?;
        if self.modes.virtual_axis.is_some() {
            let help = "end polar interpolation with G13.1, cylindrical with G7.1 C0";
            return Err(Box::new(not_now(at, format!("{what} under polar or cylindrical interpolation"), help)));
        }
        Ok(())
    }

    /// The same, and no transformation is in force.
    pub(super) fn plain(&mut self, at: Span, what: &str, io: &mut Io) -> Done {
        self.free(at, what, io)?;
        if self.modes.transform.is_identity() {
            return Ok(());
        }
        Err(Box::new(not_now(at, format!("{what} under scaling, mirror or rotation"), "write G50, G50.1 and G69 first")))
    }

    /// Scaling, mirror, rotation, polar coordinates, virtual axes.
    pub(super) fn shapes(&mut self, b: &Block, io: &mut Io) -> Done {
        for code in &b.codes {
            let before = self.modes.transform;
            let changed = match code.meaning {
                Meaning::Scale(on) => self.scale(b, on, code.span)?,
                Meaning::Mirror(on) => self.mirror(b, on),
                Meaning::Rotate(on) => self.rotate(b, on, code.span, io)?,
                Meaning::Turret(on) => Transform { mirror: [on.then_some(0.0), before.mirror[1], before.mirror[2]], ..before },
                Meaning::Polar(on) => {
                    self.polar(on != self.modes.settings.polar_exchanged, io);
                    continue;
                }
                Meaning::Cylinder | Meaning::PolarPlane(_) => {
                    self.virtual_axes(b, code, io)?;
                    continue;
                }
                _ => continue,
            };
            if changed != before {
                self.free(code.span, "another transformation", io)?;
                self.modes.transform = changed;
                self.sync(io);
            }
        }
        Ok(())
    }

    fn polar(&mut self, on: bool, io: &Io) {
        let [i, j] = axes_of(Self::plane(io));
        let all: [f64; 6] = self.modes.at.into();
        let (radius, angle) = (libm::hypot(all[i], all[j]), libm::atan2(all[j], all[i]).to_degrees());
        self.modes.pole = on.then_some(Pole { centre: [0.0; 2], radius, angle });
    }

    /// Words of the centre; `None` where the block has none.
    fn centre(&self, b: &Block) -> [Option<f64>; 3] {
        let at: [f64; 6] = self.modes.at.into();
        std::array::from_fn(|i| {
            let word = b.take(AXES[i] as u8)?;
            let value = self.length_of(word);
            Some(if self.modes.incremental { at[i] + value } else { value })
        })
    }

    fn scale(&self, b: &Block, on: bool, at: Span) -> Result<Transform, Box<Diag>> {
        let before = self.modes.transform;
        if !on {
            return Ok(Transform { scale: None, ..before });
        }
        let here: [f64; 6] = self.modes.at.into();
        let given = self.centre(b);
        let centre = std::array::from_fn(|i| given[i].unwrap_or(here[i]));
        let factor = |letter: u8| match b.take(letter) {
            None => Ok(None),
            Some(word) => {
                let value = if word.exact { word.value } else { word.value / 1000.0 };
                if value.abs() < 1e-6 || value.abs() > 1e6 {
                    return Err(bad(word, "no factor", "write a factor with a point (P0.5), or thousandths (P500)"));
                }
                Ok(Some(value))
            }
        };
        let factors = match factor(b'P')? {
            Some(p) => [p; 3],
            None => {
                let [i, j, k] = [factor(b'I')?, factor(b'J')?, factor(b'K')?];
                if i.is_none() && j.is_none() && k.is_none() {
                    return Err(Box::new(missing(at, "P").help("write the factor: P0.5, or I, J and K for each axis")));
                }
                [i.unwrap_or(1.0), j.unwrap_or(1.0), k.unwrap_or(1.0)]
            }
        };
        Ok(Transform { scale: Some((factors, centre)), ..before })
    }

    fn mirror(&self, b: &Block, on: bool) -> Transform {
        let mut transform = self.modes.transform;
        let words: [Option<f64>; 3] = std::array::from_fn(|i| b.take(AXES[i] as u8).map(|w| self.length_of(w)));
        let none = words.iter().all(Option::is_none);
        for (mirror, word) in transform.mirror.iter_mut().zip(words) {
            match (on, word) {
                (true, Some(axis)) => *mirror = Some(axis),
                (false, _) if none || word.is_some() => *mirror = None,
                _ => {}
            }
        }
        transform
    }

    fn rotate(&self, b: &Block, on: bool, at: Span, io: &Io) -> Result<Transform, Box<Diag>> {
        let before = self.modes.transform;
        if !on {
            return Ok(Transform { rotation: None, ..before });
        }
        let plane = Self::plane(io);
        let [i, j] = axes_of(plane);
        // The centre is taken in absolute coordinates, or where the program stands.
        let here: [f64; 6] = self.modes.at.into();
        let given = self.centre(b);
        let Some(word) = b.take(b'R') else {
            return Err(Box::new(missing(at, "R").help("write the angle in degrees, counterclockwise: G68 X0 Y0 R30")));
        };
        let angle = match before.rotation {
            Some((_, _, old)) if self.modes.incremental => old + word.value,
            _ => word.value,
        };
        let centre = [given[i].unwrap_or(here[i]), given[j].unwrap_or(here[j])];
        Ok(Transform { rotation: Some((plane, centre, angle)), ..before })
    }

    /// G92, G50 of turning: the present point gets these coordinates.
    pub(super) fn coordinates(&mut self, b: &Block, at: Span, io: &mut Io) -> Done {
        if !b.any("XYZABCUVWH") {
            if self.modes.clamp.is_some() && b.any("S") {
                return Ok(());
            }
            if io.state.options.language.lenient {
                self.plain(at, "another origin", io)?;
                let help = "all axes become 0 here, as printers take it; write the axes";
                io.wrong(Diag::new(takt_base::Code::LeftOut, at, "new coordinates without axis words").help(help));
                self.modes.shift = plus(self.modes.shift, scaled(self.modes.at, io.state.unit()));
                self.apply_origin(io);
                return Ok(());
            }
            return Err(Box::new(missing(at, "an axis word").help("write the coordinates that the present point gets")));
        }
        self.plain(at, "another origin", io)?;
        let here = self.modes.at;
        let want = self.target(b, io)?;
        let unit = io.state.unit();
        self.modes.shift = plus(self.modes.shift, scaled(minus(here, want), unit));
        self.apply_origin(io);
        Ok(())
    }

    /// G92.1, G50.3.
    pub(super) fn coordinates_reset(&mut self, at: Span, b: &Block, io: &mut Io) -> Done {
        self.plain(at, "another origin", io)?;
        b.use_all("XYZABC");
        self.modes.shift = Position::default();
        self.apply_origin(io);
        Ok(())
    }

    /// G52: named axes get this shift, from the work system.
    pub(super) fn local(&mut self, b: &Block, at: Span, io: &mut Io) -> Done {
        self.free(at, "another origin", io)?;
        let mut all: [f64; 6] = self.modes.local.into();
        let mut named = false;
        for (i, letter) in AXES.into_iter().enumerate() {
            if let Some(word) = b.take(letter as u8) {
                named = true;
                all[i] = self.stored(i as u32, self.length_of(word), io);
            }
        }
        if !named {
            return Err(Box::new(missing(at, "an axis word").help("write the axes whose offset changes, such as G52 X10")));
        }
        self.modes.local = all.into();
        self.apply_origin(io);
        Ok(())
    }
}

fn more_index(p: u32, at: Span) -> Result<usize, Box<Diag>> {
    match p as usize {
        p @ 1..=MORE_SYSTEMS => Ok(p + 5),
        _ => Err(Box::new(Diag::new(takt_base::Code::BadValue, at, "no such work system").help("write G54.1 P1 to P300"))),
    }
}
