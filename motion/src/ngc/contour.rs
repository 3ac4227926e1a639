//! G70, G71, G71.1, G71.2, G72, G72.1, G72.2: the subroutine Q is the contour of a turned part (LinuxCNC "G70", "G71 G72").
//! Its moves are read, not made; then the passes are. Runs: background. Lengths in length units, X as a radius.

use super::arc::Point;
use super::comp::corner::Curve;
use super::execute::{Out, Run, Then};
use super::flow::Next;
use super::flow::owords::After;
use super::interpreter::Interpreter;
use super::modal::{Distance, Motion, from_plane};
use super::motion::arc_words::ArcWords;
use super::motion::{arc_in_plane, check_feed, checked, target};
use super::request::{AXES, Word, bad_value, missing, not_now};
use super::turning::walk::{self, Kind, Rough, Step};
use super::turning::{flattened, swapped};
use crate::canon::{Canon, Plane, Position};
use takt_base::{Code, Diag, Severity, Span};

/// Rows that a contour may have.
const ROWS_MAX: u32 = 100_000;
/// Passes of G70.
const PASSES_MAX: f64 = 10_000.0;

type Result<T> = std::result::Result<T, Box<Diag>>;

/// The words of a cycle.
struct Job {
    tenths: u16,
    at: Span,
    line: u32,
    n: Option<u32>,
    sub: Word,
    start: Position,
    /// D, E, P.
    finish: [f64; 3],
    increment: Word,
    retract: f64,
}

impl Interpreter {
    /// Makes the cycle whose words the block has.
    pub(super) fn contour_cycle(&mut self, tenths: u16, row: &super::code::Row) {
        let done = self.contour_job(tenths, row).and_then(|job| self.contour_moves(&job));
        if let Err(diag) = done {
            self.diags.push(*diag);
        }
    }

    fn contour_job(&self, tenths: u16, row: &super::code::Row) -> Result<Job> {
        let (request, modal) = (&self.request, &self.state().modal);
        let at = request.motion_span();
        let name = Motion::Contour(tenths).text();
        let refuse = |label: String, help| Err(Box::new(not_now(at, label, help)));
        if modal.plane != Plane::Xz {
            return refuse(format!("{name} outside of the plane XZ"), "write G18 before it");
        }
        if modal.side.is_some() {
            return refuse(format!("{name} while G41 or G42 is in force"), "write G40 first");
        }
        if modal.distance == Distance::Incremental {
            return refuse(format!("{name} in incremental mode"), "write G90 before it");
        }
        let Some(sub) = request.word('Q') else {
            return Err(Box::new(missing(at, "Q").help("Q is the number of the subroutine with the contour, such as G71 Q100")));
        };
        let value = |letter: char, or: f64| request.value(letter).unwrap_or(or);
        let mut start: [f64; 6] = modal.position.into();
        for (i, letter) in AXES.into_iter().enumerate() {
            if let Some(v) = request.value(letter) {
                start[i] = if i == 0 && modal.diameter { v / 2.0 } else { v };
            }
        }
        let increment = request.word('I').unwrap_or(Word { letter: 'I', value: 1.0, span: at });
        let finish = [value('D', 0.0), value('E', 0.0), value('P', 1.0).trunc()];
        let retract = value('R', 0.5);
        let (line, n, start) = (row.line, row.n, start.into());
        Ok(Job { tenths, at, line, n, sub, start, finish, increment, retract })
    }

    fn contour_moves(&mut self, job: &Job) -> Result<()> {
        self.contour_step(job, Canon::StraightTraverse(job.start), job.start)?;
        if job.increment.value <= 0.0 {
            return Err(Box::new(bad_value(job.increment, "no distance of passes", "write I above 0")));
        }
        if job.finish[2] > PASSES_MAX {
            return Err(Box::new(Diag::new(Code::BadValue, job.at, "more than 10000 passes").help("write a smaller P")));
        }
        let number = job.sub.whole().ok_or_else(|| {
            Box::new(bad_value(job.sub, "not the number of a subroutine", "write the number of `o100 sub` as Q100"))
        })?;
        let points = self.read_contour(number, job)?;
        let across = job.tenths >= 720;
        let curves: Vec<Curve> = if across { points.iter().map(swapped).collect() } else { points };
        let Some(first) = curves.first() else { return Ok(()) };
        let begin = first.start();
        let flat = |p: Position| -> Point { if across { [p.x, p.z] } else { [p.z, p.x] } };
        let start = flat(job.start);
        self.check_contour(&curves, job)?;
        // To which side the work is set aside: towards the start.
        let forward = curves.last().is_some_and(|c| c.end()[0] > begin[0]);
        let side = if (start[1] > begin[1]) == forward { 1.0 } else { -1.0 };
        let [d, e, passes] = job.finish;
        // The contour is entered from behind its first point.
        let along = if forward { start[0].min(begin[0]) } else { start[0].max(begin[0]) };
        let start = [along, start[1]];
        if job.tenths == 700 {
            return self.finishing(job, &curves, start, ([side * d, side * e], passes as u32));
        }
        self.contour_steps(job, &[Step::Rapid(start)], across)?;
        let beside = walk::beside(&curves, side * d).ok_or_else(|| too_far(job.at))?;
        let kind = match job.tenths % 10 {
            0 => Kind::All,
            1 => Kind::Outside,
            _ => Kind::Pockets,
        };
        let rough = Rough { kind, increment: job.increment.value, retract: job.retract };
        let steps =
            walk::rough(start, &beside, rough).ok_or_else(|| contour_fault(job.at, "too many passes", "write a larger I"))?;
        self.contour_steps(job, &steps, across)
    }

    /// G70: the contour in passes from D to E beside it, each from where nothing is in the way.
    fn finishing(&mut self, job: &Job, curves: &[Curve], start: Point, ([d, e], passes): ([f64; 2], u32)) -> Result<()> {
        for k in 1..=passes {
            let share = f64::from(k) / f64::from(passes);
            let beside = walk::beside(curves, d + (e - d) * share).ok_or_else(|| too_far(job.at))?;
            let mut steps = vec![Step::Rapid(start)];
            steps.extend(beside.first().map(|c| Step::Rapid(c.start())));
            steps.extend(beside.iter().map(|c| match *c {
                Curve::Line { end, .. } => Step::Line(end),
                Curve::Arc { end, centre, counterclockwise, .. } => Step::Arc(end, centre, counterclockwise),
            }));
            self.contour_steps(job, &steps, false)?;
        }
        Ok(())
    }

    fn check_contour(&self, curves: &[Curve], job: &Job) -> Result<()> {
        let points = flattened(curves, 0.01)
            .ok_or_else(|| contour_fault(job.at, "the contour is too long", "write fewer or smaller arcs"))?;
        let (Some(first), Some(last)) = (points.first(), points.last()) else { return Ok(()) };
        let way = last[0] - first[0];
        let turns = points.windows(2).any(|w| (w[1][0] - w[0][0]) * way.signum() < -1e-6);
        if job.tenths != 700 && (turns || way == 0.0) {
            let help = "let it go one way from the start: along Z for G71, along X for G72";
            return Err(contour_fault(job.at, "the contour turns back", help));
        }
        Ok(())
    }

    fn contour_steps(&mut self, job: &Job, steps: &[Step], across: bool) -> Result<()> {
        let place = |p: Point| {
            let [along, other] = p;
            let (z, x) = if across { (other, along) } else { (along, other) };
            Position { x, z, ..job.start }
        };
        for step in steps {
            let (command, to) = match *step {
                Step::Rapid(p) => (Canon::StraightTraverse(place(p)), place(p)),
                Step::Line(p) => (Canon::StraightFeed(place(p)), place(p)),
                Step::Arc(p, centre, counterclockwise) => {
                    let (centre, ccw) =
                        if across { ([centre[1], centre[0]], !counterclockwise) } else { (centre, counterclockwise) };
                    (Canon::ArcFeed(arc_in_plane(centre, if ccw { 1 } else { -1 }, place(p), Plane::Xz)), place(p))
                }
            };
            self.contour_step(job, command, to)?;
        }
        Ok(())
    }

    /// One move of the cycle.
    fn contour_step(&mut self, job: &Job, command: Canon, to: Position) -> Result<()> {
        self.with_run(job.line, job.n, |run| {
            if !matches!(command, Canon::StraightTraverse(_)) {
                check_feed(run, Motion::Linear)?;
            }
            checked(run, command, job.at);
            run.modal().position = to;
            Ok(())
        })
    }

    /// The moves of a subroutine behind the first one, as curves in (Z, X). The modes and the place stay as they are.
    fn read_contour(&mut self, number: u32, job: &Job) -> Result<Vec<Curve>> {
        let modal = self.state().modal;
        let source = job.at.source;
        let depth = self.flow.depth();
        self.enter_sub(number, (job.at.start, job.at.end)).map_err(|fault| Box::new(fault.diag(source)))?;
        let mut curves: Vec<Option<Curve>> = Vec::new();
        let mut done = Err(contour_fault(job.at, "the contour does not end", "end the subroutine with endsub"));
        for _ in 0..ROWS_MAX {
            let row = match self.flow.next_row() {
                Next::Row(row) => row,
                Next::Wrong(fault, _) => {
                    done = Err(Box::new(fault.diag(source)));
                    break;
                }
                Next::Percent(..) | Next::End => break,
            };
            match self.contour_row(&row, &mut curves) {
                Err(diag) => done = Err(diag),
                Ok(Some(After::Returned(_))) if self.flow.depth() <= depth => done = Ok(()),
                Ok(_) => continue,
            }
            break;
        }
        while self.flow.depth() > depth {
            self.leave_sub();
        }
        let last = self.state().modal.motion;
        self.state.modal = super::modal::Modal { motion: last, ..modal };
        done?;
        Ok(curves.into_iter().flatten().collect())
    }

    /// One row of a contour.
    fn contour_row(&mut self, row: &super::code::Row, curves: &mut Vec<Option<Curve>>) -> Result<Option<After>> {
        if let Some(word) = &row.oword {
            let source = self.flow.files.source();
            return self.contour_word(word).map(Some).map_err(|fault| Box::new(fault.diag(source)));
        }
        let before = self.fill_request(row);
        if let Some(error) = self.take_error(before) {
            return Err(Box::new(error));
        }
        let request = &self.request;
        let Some(motion) = request.motion else { return Ok(None) };
        if !matches!(motion, Motion::Rapid | Motion::Linear | Motion::ArcCw | Motion::ArcCcw) {
            let at = request.motion_span();
            return Err(contour_fault(at, "this code can't stand in a contour", "a contour has G0, G1, G2 and G3 alone"));
        }
        let modal = self.state().modal;
        let end = target(request, self.state())?;
        let flat = |p: Position| -> Point { [p.z, p.x] };
        let (start, to) = (flat(modal.position), flat(end));
        let mut warnings = Vec::new();
        let curve = if motion.is_arc() {
            let words = ArcWords { request, modal: &modal, end, counterclockwise: motion == Motion::ArcCcw };
            let arc = words.arc(&mut warnings).map_err(Box::new)?;
            Some(Curve::Arc { start, end: to, centre: [arc.first_axis, arc.second_axis], counterclockwise: arc.rotation > 0 })
        } else {
            (start != to).then_some(Curve::Line { start, end: to })
        };
        // The first move leads to the contour.
        let leads = curves.is_empty();
        curves.push(curve.filter(|_| !leads));
        let flat_end = from_plane([to[0], to[1], modal.position.y], Plane::Xz, modal.position);
        let modal = &mut self.state.modal;
        (modal.position, modal.motion) = (flat_end, Some(motion));
        Ok(None)
    }
}

fn contour_fault(at: Span, label: &str, help: &str) -> Box<Diag> {
    Box::new(Diag::new(Code::BadContour, at, label).help(help))
}

fn too_far(at: Span) -> Box<Diag> {
    contour_fault(at, "a curve of the contour vanishes at this distance", "write a smaller D, or larger arcs")
}

/// What the cycle asks of the interpreter.
impl Interpreter {
    fn with_run<T>(&mut self, line: u32, n: Option<u32>, f: impl FnOnce(&mut Run) -> T) -> T {
        let (request, state, queue, diags, block) = self.parts();
        let mut out = Out { queue, diags, block, line, n };
        f(&mut Run { request, state, out: &mut out, then: Then::Next })
    }

    /// The first error behind `before`.
    fn take_error(&mut self, before: usize) -> Option<Diag> {
        let diags = &mut self.diags;
        let i = diags[before..].iter().position(|d| d.severity == Severity::Error)?;
        let error = diags.remove(before + i);
        diags.truncate(before);
        Some(error)
    }
}
