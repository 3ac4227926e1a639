//! Chamfers and rounded corners: `,C` `,R`, of turning also C, R, I, K in a block along one axis. The move waits for the next one.

use super::Machine;
use super::block::{Block, Word};
use super::calls::bad;
use super::kernel::Io;
use super::moves::{Seg, Shape};
use crate::canon::{Canon, Position};
use crate::ngc::arc::{Point, distance};
use crate::ngc::comp::corner::{Curve, angle, intersection, offset};
use crate::ngc::execute::Done;
use crate::ngc::modal::{from_plane, in_plane};
use takt_base::{Code, Diag, Span};

/// What a block asks for at its end.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Spec {
    radius: bool,
    /// Length units.
    size: f64,
    at: Span,
}

/// A move that waits.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Corner {
    /// The move up to the corner.
    pub seg: Seg,
    /// What comes there.
    pub spec: Spec,
    /// F of its block.
    pub feed: Option<f64>,
}

impl Spec {
    fn new(machine: &Machine, word: Word, radius: bool) -> Option<Self> {
        let size = machine.length_of(word).abs();
        (size > 0.0).then_some(Spec { radius, size, at: word.span })
    }

    /// `,C` and `,R`.
    pub(super) fn of_commas(machine: &Machine, b: &Block) -> Result<Option<Self>, Box<Diag>> {
        match (b.take(b'c'), b.take(b'r')) {
            (Some(_), Some(word)) => Err(bad(word, "a chamfer stands in the block too", "keep one of them")),
            (Some(word), None) => Ok(Spec::new(machine, word, false)),
            (None, Some(word)) => Ok(Spec::new(machine, word, true)),
            (None, None) => Ok(None),
        }
    }
}

impl Machine {
    /// The corner of a line, and whether C belongs to it.
    pub(super) fn corner_words(&self, b: &Block) -> Result<(Option<Spec>, bool), Box<Diag>> {
        let commas = Spec::of_commas(self, b)?;
        let one_axis = b.any("XU") != b.any("ZW") && !b.any("YV");
        if !self.modes.turn() || self.modes.virtual_axis.is_some() || commas.is_some() || !one_axis {
            return Ok((commas, false));
        }
        if let Some(word) = b.take(b'R') {
            return Ok((Spec::new(self, word, true), false));
        }
        if let Some(word) = b.take(b'I').or_else(|| b.take(b'K')) {
            return Ok((Spec::new(self, word, false), false));
        }
        match b.take(b'C') {
            Some(word) => Ok((Spec::new(self, word, false), true)),
            None => Ok((None, false)),
        }
    }

    /// A corner that no move follows.
    pub(super) fn end_corner(&mut self, io: &mut Io) {
        if let Some(corner) = self.corner.take() {
            let help = "the next block moves in the plane, with G1, G2 or G3";
            io.wrong(Diag::new(Code::BadCorner, corner.spec.at, "no move follows this corner").help(help));
            let done = self.deliver(corner.seg, io);
            self.done(done, io);
        }
    }

    /// Gives out the move that waits and the corner; returns `next` as it starts behind it.
    pub(super) fn join(&mut self, corner: Corner, next: Seg, io: &mut Io) -> Result<Seg, Box<Diag>> {
        let plane = Self::plane(io);
        let Corner { seg, spec, feed } = corner;
        let misfit = |label: &str, help: &str| Box::new(Diag::new(Code::BadCorner, spec.at, label).help(help));
        let pair = curve(&seg, io).zip(curve(&next, io));
        let Some((first, second)) = pair.filter(|_| next.shape != Shape::Rapid) else {
            self.send(seg, feed, io)?;
            return Err(misfit(
                "no move in the plane follows this corner",
                "the next block moves in the plane, with G1, G2 or G3",
            ));
        };
        let turn = angle(first.direction_at_end(), second.direction_at_start());
        if turn.abs() < 1e-6 {
            self.send(seg, feed, io)?;
            return Ok(next);
        }
        let ends = if spec.radius { round(&first, &second, spec.size * turn.signum()) } else { cut(&first, &second, spec.size) };
        let Some((leave, enter, centre)) = ends.filter(|e| holds(&first, e.0) && holds(&second, e.1)) else {
            self.send(seg, feed, io)?;
            return Err(misfit("the corner does not fit between the moves", "write a smaller size, or longer moves"));
        };
        let place = |p: Point, like: Position| {
            let [_, _, third] = in_plane(like, plane);
            from_plane([p[0], p[1], third], plane, like)
        };
        let (leave, enter) = (place(leave, seg.to), place(enter, seg.to));
        self.send(Seg { to: leave, ..seg }, feed, io)?;
        let shape = match centre {
            Some(centre) => Shape::Arc { centre, turns: if turn > 0.0 { 1 } else { -1 } },
            None => Shape::Line,
        };
        self.deliver(Seg { from: leave, to: enter, shape, at: seg.at }, io)?;
        Ok(Seg { from: enter, ..next })
    }

    /// The move that waited, with the feed of its own block.
    fn send(&mut self, seg: Seg, feed: Option<f64>, io: &mut Io) -> Done {
        let now = io.state.modal.feed;
        let (Some(old), Some(new)) = (feed, now) else { return self.deliver(seg, io) };
        if old == new || self.recording.is_some() {
            return self.deliver(seg, io);
        }
        io.emit(Canon::SetFeedRate(old));
        let done = self.deliver(seg, io);
        io.emit(Canon::SetFeedRate(new));
        done
    }
}

/// A move in its plane; `None` if it leaves the plane or stands still.
fn curve(seg: &Seg, io: &Io) -> Option<Curve> {
    let plane = Machine::plane(io);
    let ([a, b, c], [d, e, f]) = (in_plane(seg.from, plane), in_plane(seg.to, plane));
    let (start, end) = ([a, b], [d, e]);
    if c != f {
        return None;
    }
    match seg.shape {
        Shape::Arc { centre, turns } if turns.abs() == 1 => Some(Curve::Arc { start, end, centre, counterclockwise: turns > 0 }),
        Shape::Arc { .. } => None,
        _ => (distance(start, end) > 0.0).then_some(Curve::Line { start, end }),
    }
}

/// Where a rounding of `radius` (positive to the left) leaves the first and enters the second curve, and its centre.
fn round(first: &Curve, second: &Curve, radius: f64) -> Option<(Point, Point, Option<Point>)> {
    let beside = |c: &Curve| offset(c, radius, [c.direction_at_start(), c.direction_at_end()]);
    let (a, b) = (beside(first)?, beside(second)?);
    let centre = intersection(&a, &b)?;
    Some((foot(first, centre)?, foot(second, centre)?, Some(centre)))
}

/// The point of a curve that is nearest to `p`.
fn foot(curve: &Curve, p: Point) -> Option<Point> {
    let point = match *curve {
        Curve::Line { start, .. } => {
            let [dx, dy] = curve.direction_at_start();
            let along = (p[0] - start[0]) * dx + (p[1] - start[1]) * dy;
            [start[0] + along * dx, start[1] + along * dy]
        }
        Curve::Arc { start, centre, .. } => {
            let (r, d) = (distance(start, centre), distance(p, centre));
            if d == 0.0 {
                return None;
            }
            [centre[0] + (p[0] - centre[0]) * r / d, centre[1] + (p[1] - centre[1]) * r / d]
        }
    };
    point.iter().all(|v| v.is_finite()).then_some(point)
}

/// Points of both curves that are `size` from the corner.
fn cut(first: &Curve, second: &Curve, size: f64) -> Option<(Point, Point, Option<Point>)> {
    let corner = first.end();
    let [dx, dy] = first.direction_at_end();
    let [ex, ey] = second.direction_at_start();
    let leave = match *first {
        Curve::Line { .. } => [corner[0] - size * dx, corner[1] - size * dy],
        Curve::Arc { centre, counterclockwise, .. } => turned(corner, centre, size, !counterclockwise)?,
    };
    let enter = match *second {
        Curve::Line { .. } => [corner[0] + size * ex, corner[1] + size * ey],
        Curve::Arc { centre, counterclockwise, .. } => turned(corner, centre, size, counterclockwise)?,
    };
    Some((leave, enter, None))
}

/// The point of the circle about `centre` that is a chord of `size` from `p`.
fn turned(p: Point, centre: Point, size: f64, counterclockwise: bool) -> Option<Point> {
    let r = distance(p, centre);
    let half = size / (2.0 * r);
    if half.is_nan() || half > 1.0 {
        return None;
    }
    let angle = 2.0 * libm::asin(half) * if counterclockwise { 1.0 } else { -1.0 };
    let (sin, cos) = libm::sincos(angle);
    let (x, y) = (p[0] - centre[0], p[1] - centre[1]);
    Some([centre[0] + x * cos - y * sin, centre[1] + x * sin + y * cos])
}

/// True if `p`, which lies on the curve or its prolongation, is between its ends.
fn holds(curve: &Curve, p: Point) -> bool {
    let backwards = match *curve {
        Curve::Line { start, end } => Curve::Line { start: end, end: start },
        Curve::Arc { start, end, centre, counterclockwise } => {
            Curve::Arc { start: end, end: start, centre, counterclockwise: !counterclockwise }
        }
    };
    curve.reaches(p) && backwards.reaches(p)
}
