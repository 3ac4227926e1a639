//! Moves along a contour: each is set aside by the tool radius, joined to the one before, and waits for the next.

use super::corner::{self, Curve};
use super::{Held, sign};
use crate::canon::{Canon, Position, Step};
use crate::ngc::arc::{Point, distance};
use crate::ngc::execute::{Done, Out, Run};
use crate::ngc::modal::{FeedMode, from_plane, in_plane};
use crate::ngc::state::State;
use crate::ngc::{limits, motion};
use takt_base::{Code, Diag, Span};

/// Corners below this are no corners: sines of 0.01 radians, which is ours, and of 0.05, which is LinuxCNC's.
const SMOOTH: f64 = 0.009_999_833_334_166_664;
const SMOOTH_DROP_IN: f64 = 0.049_979_169_270_678_33;

/// A move that waits. Lengths in length units, in the plane.
#[derive(Clone, Debug)]
pub struct Pending {
    /// Shape beside the contour, from where the tool is to where it would go if nothing followed.
    curve: Curve,
    rapid: bool,
    /// Direction at the programmed end.
    direction: Point,
    /// End on all axes.
    end: Position,
    /// Turns of an arc.
    turns: i32,
    at: Span,
    block: u32,
    line: u32,
    n: Option<u32>,
}

impl Pending {
    /// A line in its programmed direction: the first one comes from elsewhere.
    fn straightened(&self) -> Curve {
        match self.curve {
            Curve::Line { end, .. } => Curve::Line { start: corner::minus(end, self.direction), end },
            arc => arc,
        }
    }

    /// True if the move can end at `p` without going back.
    fn reaches(&self, p: Point) -> bool {
        match self.curve {
            Curve::Line { start, .. } => corner::dot(corner::minus(p, start), self.direction) >= -1e-9,
            arc => arc.reaches(p),
        }
    }
}

/// A move of the contour: from the present position to `end`.
///
/// # Errors
/// The tool can't follow.
pub fn follow(run: &mut Run, command: Canon, end: Position) -> Done {
    let plane = run.state.modal.plane;
    let flat = |p: Position| {
        let [first, second, _] = in_plane(p, plane);
        [first, second]
    };
    let (from, to) = (flat(run.state.modal.position), flat(end));
    let (curve, turns) = match &command {
        Canon::ArcFeed(arc) => {
            let centre = [arc.first_axis, arc.second_axis];
            (Curve::Arc { start: from, end: to, centre, counterclockwise: arc.rotation > 0 }, arc.rotation)
        }
        _ if distance(from, to) == 0.0 => return third_axis(run, command),
        _ => (Curve::Line { start: from, end: to }, 0),
    };
    let rapid = matches!(command, Canon::StraightTraverse(_));
    if run.state.modal.feed_mode == FeedMode::InverseTime {
        motion::inverse_time(run, &command)?;
    }
    let at = run.request.motion_span();
    let Out { block, line, n, .. } = *run.out;
    let next = |curve: Curve, direction| Pending { curve, rapid, direction, end, turns, at, block, line, n };
    let side = run.state.modal.side.map_or(1.0, sign);
    let radius = run.state.comp.radius(run.state.unit()) * side;
    let starts = curve.direction_at_start();
    let direction = if matches!(curve, Curve::Line { .. }) { starts } else { curve.direction_at_end() };
    if std::mem::take(&mut run.state.comp.first) {
        let set_aside = corner::entry(&curve, radius).ok_or_else(|| short_entry(at))?;
        run.state.comp.pending = Some(next(set_aside, direction));
        return Ok(());
    }
    let set_aside = corner::offset(&curve, radius, [starts, direction]).ok_or_else(|| small_arc(at, radius))?;
    join(run, next(set_aside, direction), starts, radius)
}

/// Joins `next` to the move that waits, which goes out; then `next` waits.
fn join(run: &mut Run, mut next: Pending, starts: Point, radius: f64) -> Done {
    let Some(mut before) = run.state.comp.pending.take() else {
        run.state.comp.pending = Some(next);
        return Ok(());
    };
    // Sine and cosine of the turn, which need no angle.
    let (sine, cosine) = (corner::cross(before.direction, starts), corner::dot(before.direction, starts));
    let smooth = if run.state.options.drop_in { SMOOTH_DROP_IN } else { SMOOTH };
    let inside = sine * radius.signum();
    // Where the contour turns back, arcs may still meet inside; lines never do.
    let reversal = cosine < 0.0 && sine.abs() < SMOOTH;
    let meets = reversal
        && corner::intersection(&before.straightened(), &next.curve).is_some_and(|p| before.reaches(p) && next.curve.reaches(p));
    if radius == 0.0 || (cosine > 0.0 && sine.abs() <= smooth) {
        next.curve.start_at(before.curve.end());
    } else if if reversal { meets } else { inside > 0.0 } {
        let at = next.at;
        let point = corner::intersection(&before.straightened(), &next.curve).ok_or_else(|| gouge(at))?;
        if !before.reaches(point) {
            return Err(gouge(at));
        }
        before.curve.end_at(point);
        next.curve.start_at(point);
    } else {
        run.state.comp.pending = Some(before);
        release(run.state, run.out);
        around(run, &next, radius);
        run.state.comp.pending = Some(next);
        return Ok(());
    }
    run.state.comp.pending = Some(before);
    release(run.state, run.out);
    run.state.comp.pending = Some(next);
    Ok(())
}

/// Round an outside corner: an arc about it, or straight if the tool is traversing.
fn around(run: &mut Run, next: &Pending, radius: f64) {
    let plane = run.state.modal.plane;
    let here = run.state.modal.position;
    let [first, second, third] = in_plane(here, plane);
    let corner = [first, second];
    let unit = run.state.unit();
    let place = |p: Point| run.state.comp.control_point(p, unit, plane);
    let end = place(next.curve.start());
    if next.rapid {
        let to = from_plane([end[0], end[1], third], plane, here);
        run.out.emit(Canon::StraightTraverse(to));
        return;
    }
    let centre = place(corner);
    let turns = if radius > 0.0 { -1 } else { 1 };
    let rotary = if run.state.options.drop_in { next.end } else { here };
    let to = from_plane([end[0], end[1], third], plane, rotary);
    run.out.emit(Canon::ArcFeed(motion::arc_in_plane(centre, turns, to, plane)));
}

/// A move without motion in the plane.
fn third_axis(run: &mut Run, command: Canon) -> Done {
    let at = run.request.motion_span();
    motion::inverse_time(run, &command)?;
    if run.state.comp.pending.is_none() {
        motion::checked(run, command, at);
        return Ok(());
    }
    if run.state.comp.is_full() {
        return Err(Box::new(super::too_many_wait(at)));
    }
    let Out { block, line, n, .. } = *run.out;
    run.state.comp.held.push(Held { step: Step { block, line, n, command }, follows: true });
    Ok(())
}

/// Emits the move that waits, and what waits behind it.
pub fn release(state: &mut State, out: &mut Out) {
    let Some(pending) = state.comp.pending.take() else { return };
    let (plane, unit) = (state.modal.plane, state.unit());
    let place = |p: Point| state.comp.control_point(p, unit, plane);
    let end = place(pending.curve.end());
    let [_, _, third] = in_plane(pending.end, plane);
    let to = from_plane([end[0], end[1], third], plane, pending.end);
    let command = match pending.curve {
        Curve::Line { .. } if pending.rapid => Canon::StraightTraverse(to),
        Curve::Line { .. } => Canon::StraightFeed(to),
        Curve::Arc { centre, .. } => Canon::ArcFeed(motion::arc_in_plane(place(centre), pending.turns, to, plane)),
    };
    if state.options.travel.is_some() {
        let start = place(pending.curve.start());
        let mut modal = state.modal;
        modal.position = from_plane([start[0], start[1], third], plane, pending.end);
        out.diags.extend(limits::check_travel(&command, pending.at, &modal, &state.options));
    }
    out.queue.push_back(Step { block: pending.block, line: pending.line, n: pending.n, command });
    for mut held in state.comp.held.drain(..) {
        if held.follows
            && let Canon::StraightFeed(p) | Canon::StraightTraverse(p) = &mut held.step.command
        {
            let [_, _, third] = in_plane(*p, plane);
            *p = from_plane([end[0], end[1], third], plane, *p);
        }
        out.queue.push_back(held.step);
    }
}

fn short_entry(at: Span) -> Box<Diag> {
    let help = "start farther away: the first move behind G41 or G42 is straight and longer than the tool radius";
    Box::new(Diag::new(Code::CompensationFault, at, "the way to the contour is not longer than the tool radius").help(help))
}

fn small_arc(at: Span, radius: f64) -> Box<Diag> {
    let label = format!("the arc is not larger than the tool radius {:.4}", radius.abs());
    Box::new(Diag::new(Code::CompensationFault, at, label).help("take a smaller tool, or a larger arc"))
}

fn gouge(at: Span) -> Box<Diag> {
    let help = "take a smaller tool, or leave more room in the inside corner";
    Box::new(Diag::new(Code::CompensationFault, at, "the tool would cut into the contour at the start of this move").help(help))
}
