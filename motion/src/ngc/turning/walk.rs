//! Along a contour from its start: at each level of a descent a pass to where the contour comes up again (LinuxCNC "G71 G72").
//! Points are [along, across]; depth counts from the start point towards the contour.

use super::super::arc::{Point, distance};
use super::super::comp::corner::{Curve, angle, intersection, offset};
use std::f64::consts::TAU;

/// Rounding that is no difference, in length units.
const EPS: f64 = 1e-9;
/// Passes that one cycle may have.
const PASSES_MAX: usize = 100_000;

/// A move of the tool.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Step {
    /// At traverse.
    Rapid(Point),
    /// At feed.
    Line(Point),
    /// At feed; end, centre, sense.
    Arc(Point, Point, bool),
}

/// What is cut.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// Everything, pockets too.
    All,
    /// Pockets are bridged.
    Outside,
    /// Pockets alone.
    Pockets,
}

/// A roughing cycle.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Rough {
    /// What is cut.
    pub kind: Kind,
    /// Distance of the passes.
    pub increment: f64,
    /// How far the tool goes off the work between them.
    pub retract: f64,
}

/// The contour at `radius` beside `contour`, positive to the left, with arcs round outside corners. `None` if a curve vanishes.
pub fn beside(contour: &[Curve], radius: f64) -> Option<Vec<Curve>> {
    let mut all: Vec<Curve> = Vec::new();
    for curve in contour {
        let mut next =
            if radius == 0.0 { *curve } else { offset(curve, radius, [curve.direction_at_start(), curve.direction_at_end()])? };
        if let Some(before) = all.last_mut().filter(|_| radius != 0.0) {
            let turn = angle(before.direction_at_end(), next.direction_at_start());
            let inside = turn * radius.signum();
            if turn.abs() < 1e-9 {
                next.start_at(before.end());
            } else if inside > 0.0 {
                let p = intersection(before, &next)?;
                before.end_at(p);
                next.start_at(p);
            } else {
                let (start, end, centre) = (before.end(), next.start(), curve.start());
                all.push(Curve::Arc { start, end, centre, counterclockwise: radius < 0.0 });
            }
        }
        all.push(next);
    }
    Some(all)
}

/// A curve of the path; the way to the contour is a traverse.
#[derive(Clone, Copy, Debug)]
struct Piece {
    curve: Curve,
    rapid: bool,
}

/// A point where a curve comes through a level.
struct Crossing {
    /// Share of the curve, 0 to 1.
    t: f64,
    point: Point,
    down: bool,
}

struct Walk {
    start: Point,
    /// 1 or -1: across grows outward or inward.
    sign: f64,
    rough: Rough,
    pieces: Vec<Piece>,
    steps: Vec<Step>,
}

/// All moves of a roughing cycle from `start`, which is where the tool stands. `None` if there are too many.
pub fn rough(start: Point, contour: &[Curve], rough: Rough) -> Option<Vec<Step>> {
    let first = contour.first()?.start();
    let sign = if start[1] > first[1] { 1.0 } else { -1.0 };
    let mut walk = Walk { start, sign, rough, pieces: Vec::new(), steps: Vec::new() };
    let approach = Curve::Line { start, end: first };
    let mut rest: Vec<Curve> = contour.to_vec();
    if let Some(end) = rest.last().map(Curve::end).filter(|&end| walk.depth(end) > EPS) {
        rest.push(Curve::Line { start: end, end: [end[0], start[1]] });
    }
    if rough.kind == Kind::Outside {
        rest = walk.bridged(&rest);
    }
    walk.pieces.push(Piece { curve: approach, rapid: true });
    walk.pieces.extend(rest.into_iter().map(|curve| Piece { curve, rapid: false }));
    walk.run()?;
    Some(walk.steps)
}

impl Walk {
    fn depth(&self, p: Point) -> f64 {
        (self.start[1] - p[1]) * self.sign
    }

    /// Where `curve` comes through depth `level`, in its order.
    fn crossings(&self, curve: &Curve, level: f64) -> Vec<Crossing> {
        let across = self.start[1] - level * self.sign;
        match *curve {
            Curve::Line { start, end } => {
                let (a, b) = (self.depth(start), self.depth(end));
                let t = (level - a) / (b - a);
                let inside = (a - b).abs() > EPS && (-EPS..=1.0 + EPS).contains(&t);
                let point = [start[0] + (end[0] - start[0]) * t, across];
                if inside { vec![Crossing { t, point, down: b > a }] } else { Vec::new() }
            }
            Curve::Arc { start, end, centre, counterclockwise } => {
                let (r, up) = (distance(start, centre), across - centre[1]);
                let half = (r * r - up * up).max(0.0).sqrt();
                if up.abs() > r + EPS || distance(start, end) <= EPS {
                    return Vec::new();
                }
                let swept = |p: Point| swept(start, p, centre, counterclockwise);
                let whole = swept(end);
                let points = [[centre[0] - half, across], [centre[0] + half, across]];
                let mut all: Vec<Crossing> = points
                    .into_iter()
                    .filter_map(|point| {
                        let angle = if distance(point, start) < 1e-7 { 0.0 } else { swept(point) };
                        // Across grows where the curve runs towards the positive side.
                        let out = point[0] - centre[0];
                        let tangent = if counterclockwise { out } else { -out };
                        let near_end = distance(point, end) < 1e-7;
                        let t = if near_end { 1.0 } else { angle / whole };
                        (t <= 1.0 + EPS).then_some(Crossing { t, point, down: tangent * self.sign < 0.0 })
                    })
                    .collect();
                all.sort_by(|a, b| a.t.total_cmp(&b.t));
                all
            }
        }
    }

    /// Deepest point of a curve.
    fn deepest(&self, curve: &Curve) -> f64 {
        let ends = self.depth(curve.start()).max(self.depth(curve.end()));
        match *curve {
            Curve::Line { .. } => ends,
            Curve::Arc { start, centre, .. } => {
                let bottom = [centre[0], centre[1] - self.sign * distance(start, centre)];
                if curve.reaches(bottom) { ends.max(self.depth(bottom)) } else { ends }
            }
        }
    }

    /// The contour without its pockets: what lies deeper than something before it is left out.
    fn bridged(&self, contour: &[Curve]) -> Vec<Curve> {
        let mut best = contour.first().map_or(0.0, |c| self.depth(c.start()));
        let mut all = Vec::new();
        for curve in contour {
            let mut curve = *curve;
            if self.depth(curve.end()) > best + EPS {
                // An arc at the rim of a pocket leaves its start.
                if matches!(curve, Curve::Arc { .. }) && self.depth(curve.start()) <= best + EPS {
                    curve.end_at(curve.start());
                    all.push(curve);
                }
                continue;
            }
            if self.deepest(&curve) > best + EPS {
                let Some(up) = self.crossings(&curve, best).into_iter().rev().find(|c| !c.down) else { continue };
                curve.start_at(up.point);
            }
            best = best.min(self.depth(curve.end()));
            all.push(curve);
        }
        all
    }

    fn run(&mut self) -> Option<()> {
        let mut rim = 0.0;
        let mut falls = false;
        for i in 0..self.pieces.len() {
            let piece = self.pieces[i];
            let starts = self.depth(piece.curve.start());
            let deepest = self.deepest(&piece.curve);
            let descends = deepest > starts + EPS;
            if descends && !falls {
                rim = starts;
            }
            falls = descends;
            let cuts = match self.rough.kind {
                Kind::All => true,
                Kind::Outside => piece.rapid,
                Kind::Pockets => !piece.rapid,
            };
            if self.rough.kind == Kind::Outside && !piece.rapid {
                self.steps.push(Step::Line(piece.curve.start()));
            }
            let base = if self.rough.kind == Kind::Pockets { rim } else { 0.0 };
            let mut rest = piece;
            if descends && cuts {
                rest = self.levels(i, base, [starts, deepest])?;
            }
            self.follow(&rest);
        }
        Some(())
    }

    /// The passes of a piece that descends; returns what is left of it.
    fn levels(&mut self, i: usize, base: f64, [from, to]: [f64; 2]) -> Option<Piece> {
        let mut rest = self.pieces[i];
        let first = ((from - base) / self.rough.increment - 1e-9).ceil().max(0.0);
        let count = (to - base) / self.rough.increment - first;
        let work = count * self.pieces.len() as f64;
        if work.is_nan() || count > PASSES_MAX as f64 || work > 5e7 || self.steps.len() > 5 * PASSES_MAX {
            return None;
        }
        let mut k = first;
        while base + k * self.rough.increment < to - EPS {
            let level = base + k * self.rough.increment;
            k += 1.0;
            let Some(p) = self.crossings(&rest.curve, level).into_iter().find(|c| c.down) else { continue };
            let Some(end) = self.end_of(i, &rest.curve, level, p.t) else { continue };
            let mut part = rest;
            part.curve.end_at(p.point);
            self.follow(&part);
            self.pass(p.point, end, rest.rapid);
            rest.curve.start_at(p.point);
        }
        Some(rest)
    }

    /// Where the contour comes up through `level` behind share `t` of piece `i`.
    fn end_of(&self, i: usize, curve: &Curve, level: f64, t: f64) -> Option<Point> {
        let same = self.crossings(curve, level).into_iter().find(|c| !c.down && c.t > t + EPS);
        let later = || self.pieces[i + 1..].iter().find_map(|p| self.crossings(&p.curve, level).into_iter().find(|c| !c.down));
        same.or_else(later).map(|c| c.point)
    }

    /// Along the level, off the work, back.
    fn pass(&mut self, from: Point, to: Point, rapid: bool) {
        let half = (to[0] - from[0]).abs() / 2.0;
        let r = if self.rough.retract < 0.0 { half } else { self.rough.retract.min(half) };
        let back = r * (from[0] - to[0]).signum();
        self.steps.push(Step::Line(to));
        self.steps.push(Step::Rapid([to[0] + back, to[1] + r * self.sign]));
        self.steps.push(Step::Rapid([from[0] - back, from[1] + r * self.sign]));
        self.steps.push(if rapid { Step::Rapid(from) } else { Step::Line(from) });
    }

    /// To the end of a piece; an arc of no length is no move.
    fn follow(&mut self, piece: &Piece) {
        match piece.curve {
            Curve::Line { end, .. } => self.steps.push(if piece.rapid { Step::Rapid(end) } else { Step::Line(end) }),
            Curve::Arc { start, end, centre, counterclockwise } => {
                if distance(start, end) > EPS {
                    self.steps.push(Step::Arc(end, centre, counterclockwise));
                }
            }
        }
    }
}

/// Angle from `start` to `p` about `centre` in the sense of an arc, above 0.
fn swept(start: Point, p: Point, centre: Point, counterclockwise: bool) -> f64 {
    let turn = angle([start[0] - centre[0], start[1] - centre[1]], [p[0] - centre[0], p[1] - centre[1]]);
    let turn = if counterclockwise { turn } else { -turn };
    if turn <= 0.0 { turn + TAU } else { turn }
}
