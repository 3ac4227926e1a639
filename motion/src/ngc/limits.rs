//! Travel limits and the grid of basic length units, checked before a block leaves the interpreter (R1-103, PC-20).

use super::arc::Sweep;
use super::modal::{Modal, from_plane};
use super::options::Options;
use crate::canon::{Canon, Position};
use takt_base::units::Mm;
use takt_base::{Code, Diag, Span};

/// What is wrong with the move `command` at `at`. `modal` is the state at the start of the move.
pub fn check(command: &Canon, at: Span, modal: &Modal, options: &Options) -> Vec<Diag> {
    let machine = |p: Position| modal.machine(p);
    let grid = options.grid.and_then(|blu| given(command, modal).into_iter().map(machine).find_map(|p| off_grid(p, blu, at)));
    check_travel(command, at, modal, options).into_iter().chain(grid).collect()
}

/// The same for the travel alone.
pub fn check_travel(command: &Canon, at: Span, modal: &Modal, options: &Options) -> Option<Diag> {
    let travel = options.travel?;
    let outside = |p| outside(p, travel.min, travel.max);
    farthest(command, modal).into_iter().map(|p| modal.machine(p)).find_map(outside).map(|o| o.diag(at))
}

/// The places of a move that can be farthest out.
fn farthest(command: &Canon, modal: &Modal) -> Vec<Position> {
    match command {
        Canon::StraightTraverse(end) | Canon::StraightFeed(end) | Canon::StraightProbe(end, _) | Canon::RigidTap(end) => {
            vec![*end]
        }
        Canon::ArcFeed(arc) => Sweep::new(modal.plane, modal.position, arc).map_or_else(Vec::new, |s| s.extremes()[1..].to_vec()),
        _ => Vec::new(),
    }
}

/// The places that a move names: its end, and the centre of an arc.
fn given(command: &Canon, modal: &Modal) -> Vec<Position> {
    match command {
        Canon::StraightTraverse(end) | Canon::StraightFeed(end) | Canon::StraightProbe(end, _) | Canon::RigidTap(end) => {
            vec![*end]
        }
        Canon::ArcFeed(arc) => {
            let place = |first, second| from_plane([first, second, arc.axis_end_point], modal.plane, modal.position);
            vec![place(arc.first_end, arc.second_end), place(arc.first_axis, arc.second_axis)]
        }
        _ => Vec::new(),
    }
}

struct Outside {
    axis: char,
    place: f64,
    min: f64,
    max: f64,
}

/// Rounding that is not held against a program, in mm and degrees.
const SLACK: f64 = 1e-9;

fn outside(p: Position, min: Position, max: Position) -> Option<Outside> {
    let axes = [('X', p.x, min.x, max.x), ('Y', p.y, min.y, max.y), ('Z', p.z, min.z, max.z)];
    let rotary = [('A', p.a, min.a, max.a), ('B', p.b, min.b, max.b), ('C', p.c, min.c, max.c)];
    let mut all = axes.into_iter().chain(rotary);
    let (axis, place, min, max) = all.find(|&(_, place, min, max)| place < min - SLACK || place > max + SLACK)?;
    Some(Outside { axis, place, min, max })
}

impl Outside {
    fn diag(self, at: Span) -> Diag {
        let Outside { axis, place, min, max } = self;
        Diag::new(Code::OutsideLimits, at, format!("{axis} comes to {place:.4}"))
            .message(format!("the move leaves the travel of axis {axis}: {place:.4} is not between {min:.4} and {max:.4}"))
            .help("these are machine coordinates, with the work offset; check the offset and the end point")
    }
}

fn off_grid(p: Position, Mm(blu): Mm, at: Span) -> Option<Diag> {
    let axes = [('X', p.x), ('Y', p.y), ('Z', p.z)];
    let (axis, place) = axes.into_iter().find(|(_, place)| {
        let counts = place / blu;
        (counts - counts.round()).abs() > 1e-6
    })?;
    Some(
        Diag::new(Code::NotOnGrid, at, format!("{axis} {place:.6} mm is not a whole number of {blu} mm"))
            .help("round the program to the basic length unit, or choose a smaller one"),
    )
}
