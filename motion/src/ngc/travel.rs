//! Travel limits of a block, checked before it leaves the interpreter (R1-103).

use super::arc::Sweep;
use super::modal::{Modal, minus, mm_per_unit, plus, scaled};
use super::options::Options;
use crate::canon::{Canon, Position};
use takt_base::{Code, Diag, Span};

/// The move leaves the travel: the first axis that does. `modal` is the state at the start of the move.
pub fn check(command: &Canon, at: Span, modal: &Modal, options: &Options) -> Option<Diag> {
    let travel = options.travel?;
    let origin = options.work_offsets[modal.work_offset];
    places(command, modal).into_iter().find_map(|p| {
        let machine = plus(scaled(p, mm_per_unit(modal.units)), origin);
        outside(machine, travel.min, travel.max).map(|axis| diag(axis, at, machine, minus(machine, origin)))
    })
}

/// The places of a move that can be farthest out.
fn places(command: &Canon, modal: &Modal) -> Vec<Position> {
    match command {
        Canon::StraightTraverse(end) | Canon::StraightFeed(end) => vec![*end],
        Canon::ArcFeed(arc) => Sweep::new(modal.plane, modal.position, arc).map_or_else(Vec::new, |s| s.extremes()[1..].to_vec()),
        _ => Vec::new(),
    }
}

struct Outside {
    axis: char,
    pick: fn(Position) -> f64,
    min: f64,
    max: f64,
}

fn outside(p: Position, min: Position, max: Position) -> Option<Outside> {
    let axes: [(char, fn(Position) -> f64); 6] =
        [('X', |p| p.x), ('Y', |p| p.y), ('Z', |p| p.z), ('A', |p| p.a), ('B', |p| p.b), ('C', |p| p.c)];
    let slack = 1e-9;
    let (axis, pick) = axes.into_iter().find(|(_, pick)| pick(p) < pick(min) - slack || pick(p) > pick(max) + slack)?;
    Some(Outside { axis, pick, min: pick(min), max: pick(max) })
}

fn diag(o: Outside, at: Span, machine: Position, work: Position) -> Diag {
    let (axis, place) = (o.axis, (o.pick)(machine));
    Diag::new(Code::OutsideLimits, at, format!("{axis} comes to {place:.4}"))
        .message(format!("the move leaves the travel of axis {axis}: {place:.4} is not between {:.4} and {:.4}", o.min, o.max))
        .help(format!("these are machine coordinates; in the program {axis} would be at {:.4}", (o.pick)(work)))
}
