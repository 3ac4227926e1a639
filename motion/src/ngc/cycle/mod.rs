//! Canned cycles G73, G74, G81 .. G89 (RS274/NGC §3.5.16, LinuxCNC "Canned Cycles").
//! Runs: background. Invariant: a cycle is nothing but the moves that the machinist could have written.

mod holes;
pub mod thread;

use super::execute::{Done, Run};
use super::modal::{Distance, FeedMode, Motion, Retract, in_plane};
use super::motion;
use super::request::{bad_value, missing, not_now};
use crate::canon::{Canon, MotionMode, Plane, Position};
use takt_base::{Code, Diag};

/// Holes that one block may ask for.
const REPEATS_MAX: u32 = 20_000;

/// Words of the cycle in force, for blocks that leave them out. In length units, seconds.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Sticky {
    /// The code in tenths, 0 for none.
    code: u32,
    r: f64,
    depth: f64,
    p: Option<f64>,
    q: Option<f64>,
    ijk: [Option<f64>; 3],
    /// Third coordinate before the first cycle of the row of cycles.
    initial: f64,
}

/// A cycle at one place.
pub(super) struct Cycle<'r, 'a, 'b> {
    run: &'r mut Run<'a, 'b>,
    plane: Plane,
    /// Where R and the bottom are on the third axis.
    r: f64,
    bottom: f64,
    /// Where the tool goes back to.
    clear: f64,
    words: Sticky,
    /// First and second coordinate.
    at: [f64; 2],
    /// Holes of the block.
    repeats: u32,
}

/// Makes the cycle with this code.
///
/// # Errors
/// A word is missing, or the cycle does not fit the modes.
pub fn run(run: &mut Run, code: u8) -> Done {
    let motion = Motion::Canned(code);
    check_modes(run, motion)?;
    let words = words(run, motion)?;
    run.state.sticky = words;
    let repeats = repeats(run)?;
    let absolute = run.state.modal.distance == Distance::Absolute;
    let r = if absolute { words.r } else { words.initial + words.r };
    let bottom = if absolute { words.depth } else { r + words.depth };
    if r < bottom {
        let at = run.request.motion_span();
        let help = "the tool drills from R to the depth, in the negative direction of the axis";
        return Err(Box::new(Diag::new(Code::BadValue, at, "R lies below the bottom of the hole").help(help)));
    }
    let clear = if run.state.modal.retract == Retract::R { r } else { words.initial.max(r) };
    holes(run, motion, words, [r, bottom, clear], repeats)
}

/// All holes of a block, between the moves and modes around them.
fn holes(run: &mut Run, motion: Motion, words: Sticky, [r, bottom, clear]: [f64; 3], repeats: u32) -> Done {
    let plane = run.state.modal.plane;
    let here = in_plane(run.state.modal.position, plane);
    let end = in_plane(motion::target(run.request, run.state)?, plane);
    let step = [end[0] - here[0], end[1] - here[1]];
    let absolute = run.state.modal.distance == Distance::Absolute;
    let mut level = here[2];
    let mut cycle = Cycle { run, plane, r, bottom, clear, words, at: [here[0], here[1]], repeats };
    if words.initial < r {
        cycle.traverse_to(r);
        level = r;
    }
    let mode = cycle.run.state.modal.control;
    cycle.exact_path(mode);
    cycle.at = [end[0], end[1]];
    cycle.check_words(motion)?;
    for i in 0..repeats {
        if i > 0 && !absolute {
            cycle.at = [cycle.at[0] + step[0], cycle.at[1] + step[1]];
        }
        cycle.traverse_to(level);
        if level != r {
            cycle.traverse_to(r);
        }
        cycle.hole(motion)?;
        level = clear;
    }
    let (at, run) = (cycle.at, cycle.run);
    restore_path(run, mode);
    let rotary = run.state.modal.position;
    run.modal().position = super::modal::from_plane([at[0], at[1], clear], plane, rotary);
    Ok(())
}

/// The mode that the program asked for, behind the cycle.
fn restore_path(run: &mut Run, mode: MotionMode) {
    if mode != MotionMode::ExactPath {
        run.emit(Canon::SetMotionControlMode(mode));
        if run.state.options.drop_in {
            let tolerance = run.state.modal.naive_tolerance;
            run.emit(Canon::SetNaivecamTolerance(tolerance));
        }
    }
}

fn check_modes(run: &mut Run, motion: Motion) -> Done {
    let at = run.request.motion_span();
    if run.state.modal.feed_mode == FeedMode::InverseTime {
        return Err(Box::new(not_now(at, format!("{} with G93", motion.text()), "write G94 before it")));
    }
    run.uncompensated(at, motion.text())?;
    motion::check_feed(run, motion)
}

/// Letters of the depth and what it is called.
fn depth_letter(plane: Plane) -> char {
    match plane {
        Plane::Xy => 'Z',
        Plane::Yz => 'X',
        Plane::Xz => 'Y',
    }
}

/// The words of the block, and those of the cycle in force for what it leaves out.
fn words(run: &Run, motion: Motion) -> Result<Sticky, Box<Diag>> {
    let (request, state) = (run.request, &run.state);
    let old = state.sticky;
    let same = old.code == motion.code();
    let here = in_plane(state.modal.position, state.modal.plane)[2];
    let need = |value: Option<f64>, old: f64, letter: char| match value {
        Some(value) => Ok(value),
        None if same => Ok(old),
        None => Err(Box::new(
            missing(request.motion_span(), &letter.to_string()).help("the first block of a cycle names R and the depth"),
        )),
    };
    let pick = |letter, old: Option<f64>| request.value(letter).or(if same { old } else { None });
    let depth = depth_letter(state.modal.plane);
    Ok(Sticky {
        code: motion.code(),
        r: need(request.value('R'), old.r, 'R')?,
        depth: need(request.value(depth), old.depth, depth)?,
        p: pick('P', old.p),
        q: pick('Q', old.q),
        ijk: [pick('I', old.ijk[0]), pick('J', old.ijk[1]), pick('K', old.ijk[2])],
        initial: if same { old.initial } else { here },
    })
}

fn repeats(run: &Run) -> Result<u32, Box<Diag>> {
    let Some(word) = run.request.word('L') else { return Ok(1) };
    match word.whole().filter(|&l| (1..=REPEATS_MAX).contains(&l)) {
        Some(times) => Ok(times),
        None => Err(Box::new(bad_value(word, "not a number of holes", "write a whole number from 1"))),
    }
}

/// Forgets the words of a cycle: any other motion code does.
pub fn forget(sticky: &mut Sticky) {
    sticky.code = 0;
}

impl Cycle<'_, '_, '_> {
    fn place(&self, at: [f64; 2], third: f64) -> Position {
        super::modal::from_plane([at[0], at[1], third], self.plane, self.run.state.modal.position)
    }

    fn go(&mut self, at: [f64; 2], third: f64, feed: bool) {
        let (to, span) = (self.place(at, third), self.run.request.span);
        // Each way makes its command where it is put: a copy would cost as much as all the rest.
        if feed {
            motion::checked(self.run, Canon::StraightFeed(to), span);
        } else {
            motion::checked(self.run, Canon::StraightTraverse(to), span);
        }
    }

    fn traverse_to(&mut self, third: f64) {
        self.go(self.at, third, false);
    }

    fn feed_to(&mut self, third: f64) {
        self.go(self.at, third, true);
    }

    fn exact_path(&mut self, mode: MotionMode) {
        if mode != MotionMode::ExactPath {
            self.run.emit(Canon::SetMotionControlMode(MotionMode::ExactPath));
        }
    }
}
