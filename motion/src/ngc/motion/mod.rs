//! Motion blocks: where they end and what they emit (R1-48, R1-57, R1-58).

pub mod arc_words;
mod probe;
mod spindle;
mod spline;

use super::arc;
use super::comp;
use super::cycle;
use super::execute::{Done, Run};
use super::limits;
use super::modal::{Distance, FeedMode, Motion, minus, scaled};
use super::request::{AXES, Request, bad_value, missing, not_now};
use super::state::State;
use super::word::{Action, Group};
use crate::canon::{Arc, Canon, Position};
use arc_words::ArcWords;
use takt_base::{Code, Diag, Span};

/// Makes the motion of the block.
///
/// # Errors
/// The motion can't be made. The position is then that behind the block, as far as it is known.
pub fn run(run: &mut Run, motion: Motion) -> Done {
    if run.request.code(Group::NonModal) == Some(Action::Machine) {
        return in_machine(run, motion);
    }
    if motion != Motion::Nurbs && motion != Motion::NurbsEnd {
        run.state.nurbs = None;
    }
    if !matches!(motion, Motion::Canned(_)) {
        cycle::forget(&mut run.state.sticky);
    }
    match motion {
        Motion::Rapid | Motion::Linear | Motion::ArcCw | Motion::ArcCcw => plain(run, motion),
        Motion::Canned(code) => cycle::run(run, code),
        Motion::Probe(code) => probe::run(run, code),
        Motion::Synchronized => spindle::synchronized(run),
        Motion::RigidTap => spindle::rigid_tap(run),
        Motion::Thread => cycle::thread::run(run),
        Motion::Contour(tenths) => {
            run.then = super::execute::Then::Contour(tenths);
            Ok(())
        }
        Motion::Cubic | Motion::Quadratic | Motion::Nurbs | Motion::NurbsEnd => spline::run(run, motion),
    }
}

/// G0 to G3.
fn plain(run: &mut Run, motion: Motion) -> Done {
    let end = target(run.request, run.state)?;
    let command = command(run, motion, end);
    let done = match command {
        Ok(command) if run.state.comp.active(&run.state.modal) => comp::follow(run, command, end),
        Ok(command) => {
            inverse_time(run, &command)?;
            checked(run, command, run.request.span);
            Ok(())
        }
        Err(diag) => Err(diag),
    };
    if done.is_ok() || !run.state.options.drop_in {
        run.modal().position = end;
    }
    done
}

fn command(run: &mut Run, motion: Motion, end: Position) -> Result<Canon, Box<Diag>> {
    if motion != Motion::Rapid {
        check_feed(run, motion)?;
    }
    match motion {
        Motion::Rapid => Ok(Canon::StraightTraverse(end)),
        Motion::Linear => Ok(Canon::StraightFeed(end)),
        _ => {
            let words =
                ArcWords { request: run.request, modal: &run.state.modal, end, counterclockwise: motion == Motion::ArcCcw };
            words.arc(run.out.diags).map(Canon::ArcFeed).map_err(Box::new)
        }
    }
}

/// Emits a motion command after the checks of travel and grid.
#[inline]
pub fn checked(run: &mut Run, command: Canon, at: Span) {
    if run.state.options.travel.is_some() || run.state.options.grid.is_some() {
        check(run, &command, at);
    }
    run.emit(command);
}

#[cold]
fn check(run: &mut Run, command: &Canon, at: Span) {
    let found = limits::check(command, at, &run.state.modal, &run.state.options);
    run.out.diags.extend(found);
}

/// The feed that a code needs.
pub fn check_feed(run: &mut Run, motion: Motion) -> Done {
    match run.state.modal.feed_mode {
        FeedMode::InverseTime => match run.request.word('F') {
            None => Err(Box::new(
                missing(run.request.motion_span(), "F").help("with G93 each feed block has its own F: moves a minute"),
            )),
            Some(word) if word.value == 0.0 => Err(Box::new(no_feed(motion, run.request))),
            Some(_) => Ok(()),
        },
        mode => {
            if run.state.modal.feed.is_none_or(|f| f == 0.0) {
                return Err(Box::new(no_feed(motion, run.request)));
            }
            if mode == FeedMode::PerRevolution && run.state.modal.speed == 0.0 {
                let at = run.request.motion_span();
                let label = format!("{} with a feed a revolution and no speed", motion.text());
                return Err(Box::new(Diag::new(Code::SpindleStopped, at, label).help("write S and M3 before it, or G94")));
            }
            Ok(())
        }
    }
}

fn no_feed(motion: Motion, request: &Request) -> Diag {
    Diag::new(Code::NoFeed, request.motion_span(), format!("{} with no F before or in the block", motion.text()))
        .help("write a feed in length units a minute, such as F600")
}

/// With G93 the rate comes from the length of the move.
pub fn inverse_time(run: &mut Run, command: &Canon) -> Done {
    if run.state.modal.feed_mode != FeedMode::InverseTime || matches!(command, Canon::StraightTraverse(_)) {
        return Ok(());
    }
    let Some(moves) = run.request.value('F') else { return Ok(()) };
    let length = length_of(&run.state.modal, command);
    run.emit(Canon::SetFeedRate((length * moves).max(0.1)));
    Ok(())
}

/// Length of a move in length units, or in degrees if only rotary axes move.
pub fn length_of(modal: &super::modal::Modal, command: &Canon) -> f64 {
    match command {
        Canon::StraightFeed(end) => {
            let d = minus(*end, modal.position);
            let linear = (d.x * d.x + d.y * d.y + d.z * d.z).sqrt();
            if linear > 0.0 { linear } else { (d.a * d.a + d.b * d.b + d.c * d.c).sqrt() }
        }
        Canon::ArcFeed(arc) => arc::Sweep::new(modal.plane, modal.position, arc).map_or(0.0, |s| s.length()),
        _ => 0.0,
    }
}

/// Where the axis words lead, in program coordinates and length units.
///
/// # Errors
/// Polar words without a place to go from, or beside X and Y.
pub fn target(request: &Request, state: &State) -> Result<Position, Box<Diag>> {
    let modal = &state.modal;
    let from: [f64; 6] = modal.position.into();
    let mut to = from;
    for (i, letter) in AXES.into_iter().enumerate() {
        if let Some(value) = request.value(letter) {
            let value = if i == 0 && modal.diameter { value / 2.0 } else { value };
            to[i] = if modal.distance == Distance::Absolute { value } else { from[i] + value };
        }
    }
    if request.word('@').is_some() || request.word('^').is_some() {
        polar(request, state, &mut to)?;
    }
    Ok(to.into())
}

/// `@` radius and `^` angle in the XY plane (LinuxCNC "Polar Coordinates").
fn polar(request: &Request, state: &State, to: &mut [f64; 6]) -> Done {
    let words = ['@', '^'].into_iter().find_map(|l| request.word(l));
    let Some(first) = words else { return Ok(()) };
    if state.modal.plane != crate::canon::Plane::Xy || request.any("XY") {
        let help = "polar words replace X and Y, in the plane XY";
        return Err(Box::new(Diag::new(Code::UnusedWord, first.span, "polar words do not fit here").help(help)));
    }
    let p = state.modal.position;
    let mut radius = libm::hypot(p.x, p.y);
    let mut angle = libm::atan2(p.y, p.x).to_degrees();
    let incremental = state.modal.distance == Distance::Incremental;
    if radius == 0.0 && (request.word('@').is_none() || (incremental && request.word('^').is_none())) {
        return Err(Box::new(
            Diag::new(Code::MissingWord, first.span, "no radius to turn").help("write @ and ^ from the origin"),
        ));
    }
    if let Some(value) = request.value('@') {
        radius = if incremental { radius + value } else { value };
    }
    if let Some(value) = request.value('^') {
        angle = if incremental { angle + value } else { value };
    }
    let (sin, cos) = libm::sincos(angle.to_radians());
    (to[0], to[1]) = (radius * cos, radius * sin);
    Ok(())
}

/// G53: axis words are machine coordinates.
fn in_machine(run: &mut Run, motion: Motion) -> Done {
    let at = run.request.code_span(Group::NonModal);
    if !matches!(motion, Motion::Rapid | Motion::Linear) {
        return Err(Box::new(not_now(at, format!("G53 with {}", motion.text()), "write G0 or G1 in the block or before it")));
    }
    if run.state.modal.distance == Distance::Incremental {
        return Err(Box::new(not_now(at, "G53 in incremental mode", "write G90 before it")));
    }
    run.uncompensated(at, "G53")?;
    if motion == Motion::Linear {
        check_feed(run, motion)?;
    }
    let unit = run.state.unit();
    let modal = &run.state.modal;
    let mut machine: [f64; 6] = scaled(modal.machine(modal.position), 1.0 / unit).into();
    for (i, letter) in AXES.into_iter().enumerate() {
        if let Some(value) = run.request.value(letter) {
            machine[i] = if i == 0 && modal.diameter { value / 2.0 } else { value };
        }
    }
    let end = scaled(modal.offsets.program(scaled(machine.into(), unit)), 1.0 / unit);
    let command = if motion == Motion::Rapid { Canon::StraightTraverse(end) } else { Canon::StraightFeed(end) };
    inverse_time(run, &command)?;
    checked(run, command, run.request.span);
    run.modal().position = end;
    Ok(())
}

/// The words of an arc as a command, for others that make arcs.
pub fn arc_in_plane(centre: arc::Point, turns: i32, end: Position, plane: crate::canon::Plane) -> Arc {
    let [first_end, second_end, axis_end_point] = super::modal::in_plane(end, plane);
    let Position { a, b, c, .. } = end;
    Arc { first_end, second_end, first_axis: centre[0], second_axis: centre[1], rotation: turns, axis_end_point, a, b, c }
}

/// A word that must be there.
pub fn need(request: &Request, letter: char, help: &str) -> Result<super::request::Word, Box<Diag>> {
    request.word(letter).ok_or_else(|| Box::new(missing(request.motion_span(), &letter.to_string()).help(help)))
}

/// A word that must be there and above zero.
pub fn need_positive(request: &Request, letter: char, help: &str) -> Result<f64, Box<Diag>> {
    let word = need(request, letter, help)?;
    if word.value > 0.0 { Ok(word.value) } else { Err(Box::new(bad_value(word, "zero or less", help))) }
}
