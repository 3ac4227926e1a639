//! Cycles of turning that cut a contour: G70 finishing, G71 and G72 roughing, G73 by its pattern (R1-80, R2-180).
//! In two blocks (`G71 U R`, `G71 P Q U W`) or in one (`G71 P Q U W D`).

use super::Machine;
use super::block::{Block, GCode};
use super::kernel::Io;
use super::moves::{Seg, Shape};
use super::profile::curves;
use super::table::Meaning;
use crate::canon::{Plane, Position};
use crate::ngc::arc::Point;
use crate::ngc::comp::corner::Curve;
use crate::ngc::execute::Done;
use crate::ngc::request::not_now;
use crate::ngc::turning::{self, Pass, levels, passes};
use takt_base::{Code, Diag, Span};

impl Machine {
    pub(super) fn multi(&mut self, b: &Block, code: GCode, io: &mut Io) -> Done {
        let Meaning::Multi(number) = code.meaning else { return Ok(()) };
        let at = code.span;
        if number != 70 {
            self.free(at, "a turning cycle", io)?;
        }
        self.end_corner(io);
        if Self::plane(io) != Plane::Xz {
            return Err(Box::new(not_now(at, format!("G{number} outside of the plane ZX"), "write G18 before it")));
        }
        let motion = self.modes.codes[1];
        let done = match number {
            70 => self.finish_contour(b, at, io),
            71 | 72 => self.rough(b, number == 72, at, io),
            73 => self.pattern(b, at, io),
            74 | 75 => self.groove(b, number == 75, at, io),
            _ => self.multi_thread(b, at, io),
        };
        self.modes.codes[1] = motion;
        done
    }

    fn finish_contour(&mut self, b: &Block, at: Span, io: &mut Io) -> Done {
        let bounds = self.bounds(b, at)?;
        let start = self.modes.at;
        self.run_profile(bounds, at, io)?;
        self.end_corner(io);
        self.step(start, Shape::Rapid, at, io)
    }

    /// Finishing allowance on Z and X (as a radius), in length units.
    fn allowance(&self, b: &Block) -> Point {
        let value = |letter, axis| b.take(letter).map_or(0.0, |w| self.along(axis, w));
        [value(b'W', 2), value(b'U', 0)]
    }

    fn rough(&mut self, b: &Block, facing: bool, at: Span, io: &mut Io) -> Done {
        let unit = io.state.unit();
        if !b.any("PQ") {
            // The first block of two: depth of cut and retract.
            if let Some(word) = b.take(if facing { b'W' } else { b'U' }) {
                self.modes.rough[0] = self.length_of(word).abs() * unit;
            }
            if let Some(word) = b.take(b'R') {
                self.modes.rough[1] = self.length_of(word).abs() * unit;
            }
            return Ok(());
        }
        if let Some(word) = b.take(b'D') {
            self.modes.rough[0] = self.increments_of(word).abs() * unit;
        }
        b.use_all("IKR");
        let bounds = self.bounds(b, at)?;
        let [depth, retract] = self.modes.rough.map(|mm| mm / unit);
        if depth <= 1e-6 {
            return Err(Box::new(Diag::new(Code::BadValue, at, "no depth of cut").help("write it above 0: G71 U2. R0.5")));
        }
        let allowance = self.allowance(b);
        let start = self.modes.at;
        let segs = self.contour(bounds, at, io)?;
        if io.failed() {
            return Ok(());
        }
        let mut contour: Vec<Curve> = curves(&segs).iter().map(|c| turning::shifted(c, allowance)).collect();
        let mut origin = [start.z, start.x];
        if facing {
            contour = contour.iter().map(turning::swapped).collect();
            origin.swap(0, 1);
        }
        let pockets = segs[0].from.x != segs[0].to.x && segs[0].from.z != segs[0].to.z;
        let across = if facing { allowance[0] } else { allowance[1] };
        let cuts = self.roughing(&contour, origin, (depth, across.abs()), pockets, at)?;
        let mut tool = Rough { machine: self, io, facing, origin, start, retract, at };
        for cut in &cuts {
            tool.cut(cut)?;
        }
        tool.follow(&contour)?;
        self.step(start, Shape::Rapid, at, io)
    }

    /// All passes of a contour in (along, across).
    fn roughing(
        &self,
        contour: &[Curve],
        start: Point,
        (depth, allowance): (f64, f64),
        pockets: bool,
        at: Span,
    ) -> Result<Vec<(Pass, f64)>, Box<Diag>> {
        let wrong = |label: &str, help: &str| Box::new(Diag::new(Code::BadContour, at, label).help(help));
        let points =
            turning::flattened(contour, 0.002).ok_or_else(|| wrong("the contour is too long", "write fewer or smaller arcs"))?;
        let (Some(first), Some(last)) = (points.first(), points.last()) else {
            return Err(wrong("the contour has no length", "write blocks that move along it"));
        };
        let way = (last[0] - first[0]).signum();
        if points.windows(2).any(|w| (w[1][0] - w[0][0]) * way < -1e-6) {
            return Err(wrong("the contour turns back along the cut", "let it go one way in Z (G71) or X (G72)"));
        }
        let deepest =
            points.iter().map(|p| p[1]).fold(first[1], |a, b| if (b - start[1]).abs() > (a - start[1]).abs() { b } else { a });
        let inward = (deepest - start[1]).signum();
        if points.iter().any(|p| (p[1] - start[1]) * inward < -1e-6 - allowance) {
            return Err(wrong("the contour goes beyond the start point", "start the cycle outside of the stock"));
        }
        if !pockets && points.windows(2).any(|w| (w[1][1] - w[0][1]) * inward > 1e-6) {
            return Err(wrong("the contour has a pocket", "name both X and Z in its first block: then pockets are cut"));
        }
        let levels =
            levels(start[1], deepest, depth).ok_or_else(|| wrong("more than 100000 passes", "make the depth of cut larger"))?;
        if levels.len() * points.len() > 50_000_000 {
            return Err(wrong("the contour is too long for so many passes", "make the depth of cut larger"));
        }
        let (mut cuts, mut before) = (Vec::new(), start[1]);
        for level in levels {
            cuts.extend(passes(&points, start, level, before).into_iter().filter(|p| p.from != p.to).map(|p| (p, before)));
            before = level;
            if cuts.len() > 100_000 {
                return Err(wrong("more than 100000 passes", "make the depth of cut larger"));
            }
        }
        Ok(cuts)
    }

    /// G73: the contour several times, each nearer to the work.
    fn pattern(&mut self, b: &Block, at: Span, io: &mut Io) -> Done {
        let unit = io.state.unit();
        if !b.any("PQ") {
            // U and W are the relief, X as a radius; R is how often.
            let [x, z] = [b'U', b'W'].map(|l| b.take(l).map(|w| self.length_of(w) * unit));
            let ([old_x, old_z], _) = self.modes.pattern;
            let times = Self::whole_word(b, b'R', "write the number of cuts: R3")?.unwrap_or(self.modes.pattern.1);
            self.modes.pattern = ([x.unwrap_or(old_x), z.unwrap_or(old_z)], times);
            return Ok(());
        }
        let mut pattern = self.modes.pattern;
        for (i, letter) in [b'I', b'K'].into_iter().enumerate() {
            if let Some(word) = b.take(letter) {
                pattern.0[i] = self.length_of(word) * unit;
            }
        }
        if let Some(d) = Self::whole_word(b, b'D', "write the number of cuts: D3")? {
            pattern.1 = d;
        }
        b.use_all("R");
        if !(1..=10_000).contains(&pattern.1) {
            return Err(Box::new(Diag::new(Code::BadValue, at, "no number of cuts").help("write 1 to 10000: G73 U5. W5. R3")));
        }
        self.modes.pattern = pattern;
        let bounds = self.bounds(b, at)?;
        let [w, u] = self.allowance(b);
        let start = self.modes.at;
        let segs = self.contour(bounds, at, io)?;
        if io.failed() {
            return Ok(());
        }
        if segs.len() * pattern.1 as usize > 200_000 {
            let diag = Diag::new(Code::BadContour, at, "more than 200000 moves");
            return Err(Box::new(diag.help("write fewer cuts, or a shorter contour")));
        }
        for k in 0..pattern.1 {
            let share = if pattern.1 > 1 { f64::from(pattern.1 - 1 - k) / f64::from(pattern.1 - 1) } else { 0.0 };
            let offset =
                Position { x: u + pattern.0[0] / unit * share, z: w + pattern.0[1] / unit * share, ..Position::default() };
            for seg in &segs {
                self.shifted_step(seg, offset, at, io)?;
            }
            let back = crate::ngc::modal::plus(start, offset);
            self.step(Position { x: back.x, ..self.modes.at }, Shape::Rapid, at, io)?;
            self.step(Position { z: back.z, ..self.modes.at }, Shape::Rapid, at, io)?;
        }
        self.step(start, Shape::Rapid, at, io)
    }

    fn shifted_step(&mut self, seg: &Seg, offset: Position, at: Span, io: &mut Io) -> Done {
        let to = crate::ngc::modal::plus(seg.to, offset);
        let shape = match seg.shape {
            Shape::Arc { centre, turns } => Shape::Arc { centre: [centre[0] + offset.z, centre[1] + offset.x], turns },
            shape => shape,
        };
        if matches!(shape, Shape::Arc { .. }) {
            return self.go(Seg { from: self.modes.at, to, shape, at }, None, io);
        }
        self.step(to, shape, at, io)
    }
}

/// A roughing cycle at work.
struct Rough<'m, 'i, 'a, 'b> {
    machine: &'m mut Machine,
    io: &'i mut Io<'a, 'b>,
    facing: bool,
    /// Start in (along, across).
    origin: Point,
    start: Position,
    retract: f64,
    at: Span,
}

impl Rough<'_, '_, '_, '_> {
    fn to(&mut self, [along, across]: Point, shape: Shape) -> Done {
        let (x, z) = if self.facing { (along, across) } else { (across, along) };
        self.machine.step(Position { x, z, ..self.start }, shape, self.at, self.io)
    }

    fn here(&self) -> Point {
        let p = self.machine.modes.at;
        if self.facing { [p.x, p.z] } else { [p.z, p.x] }
    }

    /// To the level, along, off by the retract, back to the start of the cut.
    fn cut(&mut self, (pass, before): &(Pass, f64)) -> Done {
        let outward = (self.origin[1] - pass.level).signum();
        let back = (self.origin[0] - pass.to).signum();
        if pass.entry.is_empty() {
            self.to([pass.from, self.here()[1]], Shape::Rapid)?;
            self.to([pass.from, pass.level], Shape::Rapid)?;
        } else {
            // Over the peak before the pocket, then down its flank.
            let entry = pass.entry[0];
            self.to([self.here()[0], self.origin[1]], Shape::Rapid)?;
            self.to([entry[0], self.origin[1]], Shape::Rapid)?;
            let above = before + outward * self.retract;
            let above = if (self.origin[1] - above) * outward > 0.0 { above } else { self.origin[1] };
            self.to([entry[0], above], Shape::Rapid)?;
            for &p in &pass.entry {
                self.to(p, Shape::Line)?;
            }
        }
        self.to([pass.to, pass.level], Shape::Line)?;
        let off = [pass.to + back * self.retract, pass.level + outward * self.retract];
        self.to(off, Shape::Rapid)?;
        self.to([self.origin[0], off[1]], Shape::Rapid)
    }

    /// Along the contour with its allowance.
    fn follow(&mut self, contour: &[Curve]) -> Done {
        let Some(first) = contour.first() else { return Ok(()) };
        let p = first.start();
        self.to([p[0], self.here()[1]], Shape::Rapid)?;
        self.to(p, Shape::Line)?;
        for curve in contour {
            match *curve {
                Curve::Line { end, .. } => self.to(end, Shape::Line)?,
                Curve::Arc { end, centre, counterclockwise, .. } => {
                    let (centre, turn) =
                        if self.facing { ([centre[1], centre[0]], !counterclockwise) } else { (centre, counterclockwise) };
                    let (x, z) = if self.facing { (end[0], end[1]) } else { (end[1], end[0]) };
                    let to = Position { x, z, ..self.start };
                    let shape = Shape::Arc { centre, turns: if turn { 1 } else { -1 } };
                    self.machine.go(Seg { from: self.machine.modes.at, to, shape, at: self.at }, None, self.io)?;
                }
            }
        }
        self.to([self.here()[0], self.origin[1]], Shape::Rapid)
    }
}
