//! Reads canonical commands for the machine: program coordinates and units become machine millimetres, codes become auxiliary
//! functions.
//! Runs: background. From: CM-25..CM-28, CM-40..CM-43, CM-60..CM-63, sync classes of M codes as in LinuxCNC and scenario S39.

use crate::canon::{Arc, Canon, MotionMode, Plane, Position, ProgramEnd, Step};
use crate::geometry::{AXES, Path, Point};
use crate::lookahead::Move;
use crate::ngc::modal::mm_per_unit;
use crate::plc::Symbols;
use crate::segment::{Action, AuxCodes, Mark, Switch};
use crate::sync::Special;
use outputs::Output;
use spindle::SpindleState;
use takt_base::Code;

mod codes;
mod curve;
pub mod outputs;
mod search;
mod spindle;

/// What the machine can do, as far as a part program can ask for too much.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Work {
    /// Axis letters that exist.
    pub exists: [bool; AXES],
    /// Smallest machine position.
    pub min: Point,
    /// Largest machine position.
    pub max: Point,
    /// M, S and T codes wait for the PLC program.
    pub handshake: bool,
}

impl Default for Work {
    fn default() -> Self {
        Self { exists: [true; AXES], min: [f64::NEG_INFINITY; AXES], max: [f64::INFINITY; AXES], handshake: false }
    }
}

/// One item for the planner.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Item {
    /// Something that moves.
    Move(Move),
    /// Something that moves from rest to rest and does more than that.
    Special(Move, Special),
    /// Anything else.
    Action(Action),
}

/// A command that this machine can't execute.
#[derive(Clone, PartialEq, Debug)]
pub struct RunError {
    /// Which rule.
    pub code: Code,
    /// The sentence.
    pub text: String,
}

impl std::fmt::Display for RunError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.text)
    }
}

impl std::error::Error for RunError {}

/// The state that canonical commands build on.
#[derive(Clone)]
pub struct RunReader {
    work: Work,
    /// Machine position of the controlled point: mm, degrees.
    position: Point,
    origin: Point,
    /// Rotation of the program about Z: degrees, and its sine and cosine.
    rotation: (f64, f64, f64),
    /// Tool offsets of X, Y, Z in mm.
    tool: [f64; 3],
    unit_mm: f64,
    plane: Plane,
    mode: MotionMode,
    feed_mm_s: f64,
    traverse_mm_s: f64,
    /// Codes of the block at hand.
    aux: Option<(Mark, AuxCodes)>,
    /// Place of the command at hand.
    mark: Mark,
    /// S, M3, G96, G95, G33.
    spindle: SpindleState,
    /// M62, M63, M67: they go with the next move.
    pending: Vec<Output>,
    /// Feed of the dry run in mm/s.
    dry_run: Option<f64>,
    symbols: Option<std::sync::Arc<dyn Symbols>>,
    /// Codes that a block search has passed.
    passed: search::Passed,
}

/// Where the items go.
type Emit<'a> = &'a mut dyn FnMut(Mark, Item);

impl RunReader {
    /// A reader for a program that starts at machine position `start`.
    pub fn new(work: Work, start: Point) -> Self {
        Self {
            work,
            position: start,
            origin: [0.0; AXES],
            rotation: (0.0, 0.0, 1.0),
            tool: [0.0; 3],
            unit_mm: 1.0,
            plane: Plane::Xy,
            mode: MotionMode::ExactPath,
            feed_mm_s: 0.0,
            traverse_mm_s: f64::INFINITY,
            aux: None,
            mark: Mark::default(),
            spindle: SpindleState::default(),
            pending: Vec::new(),
            dry_run: None,
            symbols: None,
            passed: search::Passed::default(),
        }
    }

    /// With the variables of a PLC program.
    pub fn with_symbols(self, symbols: Option<std::sync::Arc<dyn Symbols>>) -> Self {
        Self { symbols, ..self }
    }

    /// Feed moves at `mm_s`, whatever F says (R1-85).
    pub fn with_dry_run(self, mm_s: f64) -> Self {
        Self { dry_run: Some(mm_s), ..self }
    }

    /// The machine stands here: behind a probe.
    pub fn stand_at(&mut self, position: Point) {
        self.position = position;
    }

    /// Machine position after everything read so far.
    pub fn position(&self) -> Point {
        self.position
    }

    /// Reads one command; what it amounts to goes to `emit`.
    pub fn read(&mut self, step: &Step, emit: Emit) -> Result<(), RunError> {
        let mark = Mark::from(step);
        if self.mark.block != mark.block {
            self.flush_aux(emit);
        }
        self.mark = mark;
        match &step.command {
            Canon::StraightTraverse(p) => self.straight(mark, p, true, emit),
            Canon::StraightFeed(p) => self.straight(mark, p, false, emit),
            Canon::ArcFeed(arc) => self.arc(mark, arc, emit),
            Canon::Dwell(s) => self.dwell(mark, *s, emit),
            Canon::Stop => self.action(mark, Action::Dwell(0.0), emit),
            Canon::ProgramStop => self.action(mark, Action::ProgramStop { optional: false }, emit),
            Canon::OptionalProgramStop => self.action(mark, Action::ProgramStop { optional: true }, emit),
            Canon::ProgramEnd(end) => self.end(mark, *end, emit),
            Canon::EnableFeedOverride => self.action(mark, Action::Switch(Switch::Feed, true), emit),
            Canon::DisableFeedOverride => self.action(mark, Action::Switch(Switch::Feed, false), emit),
            Canon::StraightProbe(to, probe) => self.probe(mark, to, *probe, emit),
            Canon::RigidTap(to) => self.tap(mark, to, emit),
            Canon::NurbsFeed(nurbs) => self.nurbs(mark, nurbs, emit),
            Canon::WaitInput(input) => self.action(mark, Action::WaitInput(outputs::checked(*input)?), emit),
            Canon::ReadPlc(names) => self.read_plc(mark, names, emit),
            Canon::SetPlc(name, value) => self.set_plc(mark, name, *value, emit),
            Canon::EnableAdaptiveFeed => self.action(mark, Action::Switch(Switch::Adaptive, true), emit),
            Canon::DisableAdaptiveFeed => self.action(mark, Action::Switch(Switch::Adaptive, false), emit),
            Canon::EnableFeedHold => self.action(mark, Action::Switch(Switch::FeedHold, true), emit),
            Canon::DisableFeedHold => self.action(mark, Action::Switch(Switch::FeedHold, false), emit),
            Canon::EnableSpeedOverride => self.action(mark, Action::Switch(Switch::Spindle, true), emit),
            Canon::DisableSpeedOverride => self.action(mark, Action::Switch(Switch::Spindle, false), emit),
            Canon::StartSpeedFeedSynch => Err(unsupported("motion in step with the spindle without a pitch")),
            command if self.set_state(command)? => Ok(()),
            command => self.auxiliary(mark, command, emit),
        }
    }

    /// The end of the commands: codes that still wait for company go out.
    pub fn finish(&mut self, emit: Emit) {
        self.flush_aux(emit);
    }

    fn set_state(&mut self, command: &Canon) -> Result<bool, RunError> {
        match command {
            Canon::SelectPlane(plane) => self.plane = *plane,
            Canon::UseLengthUnits(units) => self.unit_mm = mm_per_unit(*units),
            Canon::SetOriginOffsets(p) => self.origin = self.scaled(p),
            Canon::UseToolLengthOffset(length) => self.tool = [0.0, 0.0, length * self.unit_mm],
            Canon::UseToolLengthOffsets(p) => self.tool = [p.x, p.y, p.z].map(|v| v * self.unit_mm),
            Canon::SetXyRotation(degrees) => {
                let (sin, cos) = libm::sincos(degrees.to_radians());
                self.rotation = (*degrees, sin, cos);
            }
            Canon::SetFeedMode(per_rev) => self.spindle.per_rev = *per_rev,
            Canon::SetSpindleMode(max) => self.spindle.set_mode(*max),
            Canon::StartSpeedFeedSync(pitch) => self.spindle.start_sync(pitch * self.unit_mm),
            Canon::StopSpeedFeedSynch => self.spindle.stop_sync(),
            Canon::SetFeedRate(rate) => self.feed_mm_s = rate * self.unit_mm / 60.0,
            Canon::SetTraverseRate(rate) if *rate > 0.0 => self.traverse_mm_s = rate * self.unit_mm / 60.0,
            Canon::SetMotionControlMode(mode) => self.mode = *mode,
            Canon::SetFeedReference(crate::canon::FeedReference::Workpiece) => {
                return Err(unsupported("feed relative to the work piece"));
            }
            Canon::InitCanon
            | Canon::EndCanon
            | Canon::SetTraverseRate(_)
            | Canon::SetNaivecamTolerance(_)
            | Canon::SetG5xOffset(..)
            | Canon::SetG92Offset(_)
            | Canon::SetToolTableEntry(_)
            | Canon::StartChange
            | Canon::TurnProbeOn
            | Canon::TurnProbeOff
            | Canon::Print(_)
            | Canon::Log(_)
            | Canon::LogOpen(_)
            | Canon::LogAppend(_)
            | Canon::LogClose
            | Canon::WaitOrientComplete(_)
            | Canon::SetFeedReference(_)
            | Canon::Comment(_)
            | Canon::Remark(_)
            | Canon::Message(_) => {}
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn scaled(&self, p: &Position) -> Point {
        let u = self.unit_mm;
        [p.x * u, p.y * u, p.z * u, p.a, p.b, p.c]
    }

    /// Program to machine coordinates (CM-19, CM-26).
    fn machine(&self, p: &Position) -> Point {
        let mut point = self.scaled(p);
        self.turn(&mut point, 0, 1);
        for (c, o) in point.iter_mut().zip(self.origin) {
            *c += o;
        }
        for (c, o) in point.iter_mut().zip(self.tool) {
            *c += o;
        }
        point
    }

    /// Turns coordinates `i` and `j`, which are X and Y, by the rotation of the program.
    fn turn(&self, point: &mut [f64], i: usize, j: usize) {
        let (degrees, sin, cos) = self.rotation;
        if degrees != 0.0 {
            let (x, y) = (point[i], point[j]);
            point[i] = x * cos - y * sin;
            point[j] = x * sin + y * cos;
        }
    }

    fn straight(&mut self, mark: Mark, to: &Position, rapid: bool, emit: Emit) -> Result<(), RunError> {
        let path = Path::line(self.position, self.machine(to));
        self.go(mark, path, rapid, emit)
    }

    fn arc(&mut self, mark: Mark, arc: &Arc, emit: Emit) -> Result<(), RunError> {
        let (first, second, third) = match self.plane {
            Plane::Xy => (0, 1, 2),
            Plane::Yz => (1, 2, 0),
            Plane::Xz => (2, 0, 1),
        };
        if self.rotation.0 != 0.0 && self.plane != Plane::Xy {
            return Err(unsupported("an arc outside of XY in a rotated program"));
        }
        let place = |a: f64, b: f64, c: f64| {
            let mut p = [0.0; 3];
            (p[first], p[second], p[third]) = (a * self.unit_mm, b * self.unit_mm, c * self.unit_mm);
            self.turn(&mut p, 0, 1);
            std::array::from_fn::<f64, 3, _>(|i| p[i] + self.origin[i] + self.tool[i])
        };
        let mut end = self.position;
        end[..3].copy_from_slice(&place(arc.first_end, arc.second_end, arc.axis_end_point));
        for (i, v) in [(3, arc.a), (4, arc.b), (5, arc.c)] {
            end[i] = v + self.origin[i];
        }
        let middle = place(arc.first_axis, arc.second_axis, 0.0);
        let centre = [middle[first], middle[second]];
        check_radius(&self.position, &end, first, second, centre, arc.rotation)?;
        self.go(mark, Path::arc(self.position, end, first, second, centre, arc.rotation), false, emit)
    }

    fn go(&mut self, mark: Mark, path: Path, rapid: bool, emit: Emit) -> Result<(), RunError> {
        self.check(&path)?;
        let special = if rapid || self.dry_run.is_some() { None } else { self.spindle.thread() };
        let (feed, per_rev) = match special {
            Some(_) => (self.nominal(&path)?, 0.0),
            None => self.feed(&path, rapid)?,
        };
        self.flush_aux(emit);
        self.position = path.end;
        if path.length > 0.0 {
            self.flush_outputs(mark, emit);
            let exact_stop = self.mode == MotionMode::ExactStop;
            let m = Move { path, feed, rapid, exact_stop, per_rev };
            self.spindle.moved(special.is_some());
            emit(mark, special.map_or(Item::Move(m), |s| Item::Special(m, s)));
        }
        Ok(())
    }

    /// Feed in mm/s, and mm a revolution if it depends on the spindle.
    fn feed(&self, path: &Path, rapid: bool) -> Result<(f64, f64), RunError> {
        let (feed, per_rev) = match (rapid, self.dry_run) {
            (true, _) => (self.traverse_mm_s, 0.0),
            (false, Some(dry_run)) => (dry_run, 0.0),
            // F of G95 was divided by 60 like any other.
            (false, None) if self.spindle.per_rev => {
                let per_rev = self.feed_mm_s * 60.0;
                (per_rev * self.fastest(path)?, per_rev)
            }
            (false, None) => (self.feed_mm_s, 0.0),
        };
        if (feed.is_nan() || feed <= 0.0) && path.length > 0.0 {
            return Err(RunError { code: Code::NoFeed, text: Code::NoFeed.title().to_owned() });
        }
        Ok((feed, per_rev))
    }

    fn check(&self, path: &Path) -> Result<(), RunError> {
        if !path.length.is_finite() || !path.end.iter().all(|c| c.abs() <= 1e9) {
            return Err(RunError { code: Code::OutsideLimits, text: "the move is longer than any machine".to_owned() });
        }
        for i in 0..AXES {
            let (low, high) = path.bounds(i);
            let letter = ["X", "Y", "Z", "A", "B", "C"][i];
            if low == high {
                continue;
            }
            if !self.work.exists[i] {
                let text = format!("the program moves {letter}, but the channel has no such axis");
                return Err(RunError { code: Code::UnknownReference, text });
            }
            if low < self.work.min[i] - 1e-9 || high > self.work.max[i] + 1e-9 {
                let text = format!("the move takes {letter} to {}", if high > self.work.max[i] { high } else { low });
                return Err(RunError { code: Code::OutsideLimits, text });
            }
        }
        Ok(())
    }

    fn action(&mut self, mark: Mark, action: Action, emit: Emit) -> Result<(), RunError> {
        self.flush_aux(emit);
        emit(mark, Item::Action(action));
        Ok(())
    }

    fn dwell(&mut self, mark: Mark, seconds: f64, emit: Emit) -> Result<(), RunError> {
        if !(0.0..=1e6).contains(&seconds) {
            return Err(RunError { code: Code::BadValue, text: format!("a dwell of {seconds} s is not possible") });
        }
        self.action(mark, Action::Dwell(seconds), emit)
    }

    /// The spindle and coolant stops that an end of program implies are shown, but nobody has to confirm them.
    fn end(&mut self, mark: Mark, end: ProgramEnd, emit: Emit) -> Result<(), RunError> {
        if let Some((_, codes)) = &mut self.aux {
            codes.wait &= !codes.m[..usize::from(codes.m_count)].iter().all(|m| matches!(m, 5 | 9));
        }
        let m = match end {
            ProgramEnd::M2 => 2,
            ProgramEnd::M30 => 30,
            ProgramEnd::EndOfFile => 0,
        };
        self.action(mark, Action::End { m }, emit)
    }
}

/// CM-62, CM-63. The interpreter knows the tolerance of its dialect; this keeps wild arcs out whoever made the commands.
fn check_radius(start: &Point, end: &Point, i: usize, j: usize, centre: [f64; 2], rotation: i32) -> Result<(), RunError> {
    let radius = |p: &Point| libm::hypot(p[i] - centre[0], p[j] - centre[1]);
    let (r0, r1) = (radius(start), radius(end));
    let moved = (end[i] - start[i]).abs() + (end[j] - start[j]).abs() > 1e-9;
    if (r0 - r1).abs() > 0.05 + 0.005 * r0 || (rotation == 0 && moved) || r0.is_nan() || r0 <= 0.0 {
        let text = format!("the arc starts at radius {r0:.4} and ends at radius {r1:.4} mm");
        return Err(RunError { code: Code::RadiusMismatch, text });
    }
    Ok(())
}

fn unsupported(what: &str) -> RunError {
    RunError { code: Code::UnknownCode, text: format!("{what} is not supported") }
}

#[cfg(test)]
mod tests;
