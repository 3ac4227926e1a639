//! Polar interpolation (G12.1) and cylindrical interpolation (G7.1): a rotary axis that the program sees as a straight one (R1-59).
//! Moves become chords of the real axes within a tolerance; each chord gets the feed with which the tool keeps F on the surface.

use super::Machine;
use super::block::{Block, GCode};
use super::kernel::Io;
use super::moves::{Seg, Shape};
use super::table::Meaning;
use crate::canon::{Canon, Plane, Position};
use crate::ngc::arc::{self, Point, Sweep};
use crate::ngc::execute::Done;
use crate::ngc::modal::FeedMode;
use crate::ngc::motion::arc_in_plane;
use crate::ngc::request::{Request, missing, not_now};
use takt_base::{Code, Diag, Span};

/// Chords that one move may have.
const CHORDS_MAX: usize = 200_000;
/// How often a chord may be halved.
const DEPTH_MAX: u32 = 14;

/// What is in force.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Virtual {
    /// X and a virtual axis C in length units; the real C at its start, degrees.
    Polar {
        /// Degrees.
        zero: f64,
    },
    /// A cylinder of this radius in length units.
    Cylinder {
        /// Length units.
        radius: f64,
    },
}

fn refuse(at: Span, label: impl Into<String>, help: &str) -> Box<Diag> {
    Box::new(Diag::new(Code::BadVirtualMove, at, label).help(help))
}

impl Machine {
    /// G12.1, G13.1, G7.1 C.
    pub(super) fn virtual_axes(&mut self, b: &Block, code: &GCode, io: &mut Io) -> Done {
        self.end_corner(io);
        io.run().uncompensated(code.span, "interpolation of a rotary axis")?;
        let wanted = match code.meaning {
            Meaning::PolarPlane(on) => on.then_some(Virtual::Polar { zero: io.state.modal.position.c }),
            _ => {
                let Some(c) = b.take(b'C') else {
                    return Err(Box::new(missing(code.span, "C").help("write the radius of the cylinder: G7.1 C30; C0 ends it")));
                };
                let radius = self.length_of(super::block::Word { letter: b'X', ..c });
                (radius.abs() > 1e-9).then_some(Virtual::Cylinder { radius: radius.abs() })
            }
        };
        if wanted.is_some() && !self.modes.transform.is_identity() {
            return Err(Box::new(not_now(
                code.span,
                "interpolation of a rotary axis under scaling, mirror or rotation",
                "end those first",
            )));
        }
        if wanted.is_some() && io.state.modal.feed_mode != FeedMode::PerMinute {
            let help = "write feed a minute before it: G94, of turning G98";
            return Err(Box::new(not_now(code.span, "interpolation of a rotary axis with this feed mode", help)));
        }
        self.modes.virtual_axis = wanted;
        let here = io.state.modal.position;
        self.modes.at = match wanted {
            Some(Virtual::Polar { .. }) => Position { c: 0.0, ..here },
            _ => here,
        };
        Ok(())
    }

    /// An arc in the plane of the virtual axis: (X, C) of polar, (Z, C) of cylindrical interpolation.
    pub(super) fn virtual_arc(
        &mut self,
        request: &Request,
        to: Position,
        counterclockwise: bool,
        at: Span,
        io: &mut Io,
    ) -> Result<Seg, Box<Diag>> {
        let (start, end) = (self.flat(self.modes.at, io), self.flat(to, io));
        let centre = match (request.value('R'), self.modes.virtual_axis) {
            (Some(r), _) => arc::centre_by_radius(start, end, r, counterclockwise, 1e-3).ok_or_else(|| {
                let diag = Diag::new(Code::RadiusMismatch, at, "no arc of this radius joins the points");
                Box::new(diag.help("check the end point and R"))
            })?,
            (None, Some(Virtual::Polar { .. })) if request.any("IJ") => {
                [start[0] + request.value('I').unwrap_or(0.0), start[1] + request.value('J').unwrap_or(0.0)]
            }
            _ => return Err(Box::new(missing(at, "R").help("write the radius of the arc"))),
        };
        let (r, s) = (arc::distance(start, centre), arc::distance(end, centre));
        if r == 0.0 || (r - s).abs() > 0.01 * r.max(1.0) {
            let diag = Diag::new(Code::RadiusMismatch, at, format!("radius {r:.4} and then {s:.4}"));
            return Err(Box::new(diag.help("check end point and centre")));
        }
        let shape = Shape::Arc { centre, turns: if counterclockwise { 1 } else { -1 } };
        Ok(Seg { from: self.modes.at, to, shape, at })
    }

    /// First and second coordinate of the surface.
    fn flat(&self, p: Position, io: &Io) -> Point {
        let Some(Virtual::Cylinder { radius }) = self.modes.virtual_axis else { return [p.x, p.c] };
        let s = p.c.to_radians() * radius;
        match Self::plane(io) {
            Plane::Xy => [p.x, s],
            Plane::Yz => [s, p.z],
            Plane::Xz => [p.z, s],
        }
    }

    /// Back from the surface; other axes from `like`.
    fn folded(&self, [first, second]: Point, like: Position, io: &Io) -> Position {
        let Some(Virtual::Cylinder { radius }) = self.modes.virtual_axis else {
            return Position { x: first, c: second, ..like };
        };
        let degrees = |s: f64| (s / radius).to_degrees();
        match Self::plane(io) {
            Plane::Xy => Position { x: first, c: degrees(second), ..like },
            Plane::Yz => Position { c: degrees(first), z: second, ..like },
            Plane::Xz => Position { z: first, c: degrees(second), ..like },
        }
    }

    /// A move under a virtual axis.
    pub(super) fn virtual_move(&mut self, seg: Seg, io: &mut Io) -> Done {
        let tolerance = self.modes.settings.chord_tolerance_mm / io.state.unit();
        let mut corners = vec![seg.to];
        if let Shape::Arc { centre, turns } = seg.shape {
            corners = self.chords(&seg, centre, turns, tolerance / 2.0, io)?;
        }
        let mut from = seg.from;
        for to in corners {
            self.virtual_line(from, to, &seg, tolerance / 2.0, io)?;
            from = to;
        }
        if seg.shape != Shape::Rapid
            && let Some(feed) = io.state.modal.feed
        {
            io.emit(Canon::SetFeedRate(feed));
        }
        Ok(())
    }

    /// Points behind the start of an arc.
    fn chords(&self, seg: &Seg, centre: Point, turns: i32, tolerance: f64, io: &Io) -> Result<Vec<Position>, Box<Diag>> {
        let (start, end) = (self.flat(seg.from, io), self.flat(seg.to, io));
        let at = |p: Point| Position { x: p[0], y: p[1], ..Position::default() };
        let sweep = Sweep::new(Plane::Xy, at(start), &arc_in_plane(centre, turns, at(end), Plane::Xy));
        let Some(sweep) = sweep else { return Ok(vec![seg.to]) };
        let step = 2.0 * libm::acos((1.0 - tolerance / sweep.radius.max(tolerance)).clamp(-1.0, 1.0));
        let n = (sweep.sweep.abs() / step.max(1e-9)).ceil();
        if n > CHORDS_MAX as f64 {
            return Err(refuse(seg.at, "the arc needs too many chords", "set a larger chord_tolerance"));
        }
        let n = (n as u32).max(1);
        let share = |i: u32| f64::from(i) / f64::from(n);
        let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
        let mut all: Vec<Position> = (1..=n)
            .map(|i| {
                let p = sweep.at(share(i));
                let (f, t) = (seg.from, seg.to);
                let like = Position { x: mix(f.x, t.x, share(i)), y: mix(f.y, t.y, share(i)), z: mix(f.z, t.z, share(i)), ..t };
                self.folded([p.x, p.y], like, io)
            })
            .collect();
        if let Some(last) = all.last_mut() {
            *last = seg.to;
        }
        Ok(all)
    }

    fn virtual_line(&mut self, from: Position, to: Position, seg: &Seg, tolerance: f64, io: &mut Io) -> Done {
        match self.modes.virtual_axis {
            Some(Virtual::Polar { zero }) => self.polar_line(from, to, zero, seg, tolerance, io),
            _ => self.cylinder_line(from, to, seg, io),
        }
    }

    /// A straight line of the surface is one of the axes too.
    fn cylinder_line(&mut self, from: Position, to: Position, seg: &Seg, io: &mut Io) -> Done {
        let (p, q) = (self.flat(from, io), self.flat(to, io));
        let moved = |a: f64, b: f64| (b - a) * (b - a);
        let third = match Self::plane(io) {
            Plane::Xy => moved(from.z, to.z) + moved(from.y, to.y),
            _ => moved(from.x, to.x) + moved(from.y, to.y),
        };
        let surface = (moved(p[0], q[0]) + moved(p[1], q[1]) + third).sqrt();
        self.chord(to, surface, seg, io)
    }

    /// One move of the real axes, with the feed for a way of `surface` length units.
    fn chord(&mut self, real: Position, surface: f64, seg: &Seg, io: &mut Io) -> Done {
        if seg.shape == Shape::Rapid {
            return io.straight(real, true, seg.at);
        }
        let length = crate::ngc::motion::length_of(&io.state.modal, &Canon::StraightFeed(real));
        let feed = io.state.modal.feed.unwrap_or(0.0);
        let mut run = io.run();
        crate::ngc::motion::check_feed(&mut run, crate::ngc::modal::Motion::Linear)?;
        if surface <= 0.0 || length <= 0.0 {
            io.state.modal.position = real;
            return Ok(());
        }
        io.emit(Canon::SetFeedRate(feed * length / surface));
        io.place(Canon::StraightFeed(real), real, seg.at);
        Ok(())
    }

    /// A line in the plane of X and the virtual axis, as chords in radius and angle.
    fn polar_line(&mut self, from: Position, to: Position, zero: f64, seg: &Seg, tolerance: f64, io: &mut Io) -> Done {
        let (p, q) = ([from.x, from.c], [to.x, to.c]);
        let closest = nearest_to_centre(p, q);
        let turns = p != q;
        if turns && closest < 10.0 * tolerance && seg.shape != Shape::Rapid {
            let help = "lead the path past the centre of the rotary axis";
            return Err(refuse(seg.at, "the path comes to the centre of the rotary axis", help));
        }
        let mut shares = Vec::new();
        halve(p, q, [0.0, 1.0], tolerance, DEPTH_MAX, &mut shares);
        let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
        let mut before = from;
        for t in shares {
            let here = [mix(p[0], q[0], t), mix(p[1], q[1], t)];
            let last = io.state.modal.position.c;
            let angle = if here == [0.0; 2] { last } else { libm::atan2(here[1], here[0]).to_degrees() + zero };
            let c = last + (angle - last) - 360.0 * ((angle - last) / 360.0).round();
            let flat = Position { x: here[0], c: here[1], y: mix(from.y, to.y, t), z: mix(from.z, to.z, t), ..to };
            let real = Position { x: libm::hypot(here[0], here[1]), c, ..flat };
            let d = crate::ngc::modal::minus(flat, before);
            let surface = (d.x * d.x + d.y * d.y + d.z * d.z + d.c * d.c).sqrt();
            self.chord(real, surface, seg, io)?;
            before = flat;
        }
        Ok(())
    }
}

/// Distance of the line from the centre.
fn nearest_to_centre(p: Point, q: Point) -> f64 {
    let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
    let square = dx * dx + dy * dy;
    let t = if square > 0.0 { (-(p[0] * dx + p[1] * dy) / square).clamp(0.0, 1.0) } else { 0.0 };
    libm::hypot(p[0] + t * dx, p[1] + t * dy)
}

/// Shares of the line up to which radius and angle may go evenly.
fn halve(p: Point, q: Point, [a, b]: [f64; 2], tolerance: f64, depth: u32, out: &mut Vec<f64>) {
    let at = |t: f64| [p[0] + (q[0] - p[0]) * t, p[1] + (q[1] - p[1]) * t];
    let (start, end, middle) = (at(a), at(b), at((a + b) / 2.0));
    let polar = |v: Point| (libm::hypot(v[0], v[1]), libm::atan2(v[1], v[0]));
    let ((r, f), (s, g)) = (polar(start), polar(end));
    let turn = g - f - std::f64::consts::TAU * ((g - f) / std::f64::consts::TAU).round();
    let (sin, cos) = libm::sincos(f + turn / 2.0);
    let even = [(r + s) / 2.0 * cos, (r + s) / 2.0 * sin];
    if depth > 0 && (arc::distance(even, middle) > tolerance || turn.abs() > 0.5) {
        let m = (a + b) / 2.0;
        halve(p, q, [a, m], tolerance, depth - 1, out);
        halve(p, q, [m, b], tolerance, depth - 1, out);
    } else {
        out.push(b);
    }
}
