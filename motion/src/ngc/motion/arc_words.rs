//! The forms of an arc: centre as a step or as a place, or a radius (R1-48, R1-57, R1-58).

use crate::canon::{Arc, Plane, Position, Units};
use crate::ngc::arc::{self, Point};
use crate::ngc::modal::{Distance, Modal, in_plane, mm_per_unit};
use crate::ngc::request::{Request, bad_value, missing};
use takt_base::{Code, Diag};

/// An arc block.
pub struct ArcWords<'a> {
    /// Its words.
    pub request: &'a Request,
    /// The modes at its start.
    pub modal: &'a Modal,
    /// Where it ends.
    pub end: Position,
    /// G3.
    pub counterclockwise: bool,
}

impl ArcWords<'_> {
    /// The command.
    ///
    /// # Errors
    /// The words give no arc.
    pub fn arc(&self, warnings: &mut Vec<Diag>) -> Result<Arc, Diag> {
        let turns = self.turns()?;
        let centre = match self.request.word('R') {
            Some(_) => self.centre_by_radius(warnings)?,
            None => self.centre()?,
        };
        let rotation = if self.counterclockwise { turns } else { -turns };
        Ok(super::arc_in_plane(centre, rotation, self.end, self.modal.plane))
    }

    fn ends(&self) -> (Point, Point) {
        let [sx, sy, _] = in_plane(self.modal.position, self.modal.plane);
        let [ex, ey, _] = in_plane(self.end, self.modal.plane);
        ([sx, sy], [ex, ey])
    }

    fn turns(&self) -> Result<i32, Diag> {
        let Some(word) = self.request.word('P') else { return Ok(1) };
        let turns = word.whole().and_then(|n| i32::try_from(n).ok()).filter(|&n| n > 0);
        turns.ok_or_else(|| bad_value(word, "not a number of turns", "write a whole number from 1"))
    }

    /// The centre from the offset words of the plane, checked against the end.
    fn centre(&self) -> Result<Point, Diag> {
        let [first, second, other] = offset_letters(self.modal.plane);
        if let Some(word) = self.request.word(other) {
            return Err(not_in_plane(word.span, self.modal.plane));
        }
        let words = [self.request.value(first), self.request.value(second)];
        let (start, end) = self.ends();
        let centre = match (self.modal.arc_distance, words) {
            (_, [None, None]) => return Err(self.no_centre(first, second)),
            (Distance::Incremental, [i, j]) => [start[0] + i.unwrap_or(0.0), start[1] + j.unwrap_or(0.0)],
            (Distance::Absolute, [Some(i), Some(j)]) => [i, j],
            (Distance::Absolute, _) => return Err(self.half_a_centre(first, second)),
        };
        self.check_radii(start, end, centre)?;
        Ok(centre)
    }

    fn check_radii(&self, start: Point, end: Point, centre: Point) -> Result<(), Diag> {
        let (r1, r2) = (arc::distance(start, centre), arc::distance(end, centre));
        let [first, second, _] = offset_letters(self.modal.plane);
        let at = self.request.span_of(&[first, second]);
        if r1 == 0.0 || r2 == 0.0 {
            return Err(Diag::new(Code::RadiusMismatch, at, "the centre is the start or the end itself")
                .message(format!(
                    "start and end of the arc are not on one circle: radius {r1:.4} at the start, {r2:.4} at the end"
                ))
                .help("an arc needs a radius above zero"));
        }
        let tolerance = radius_tolerance(self.modal.units);
        let apart = (r1 - r2).abs();
        if apart > 100.0 * tolerance || (apart > tolerance && apart > 0.001 * r1.max(r2)) {
            return Err(self.radii_differ(r1, r2).also(at, "the centre is given here"));
        }
        Ok(())
    }

    fn radii_differ(&self, r1: f64, r2: f64) -> Diag {
        let mode = match self.modal.arc_distance {
            Distance::Incremental => "I, J, K count from the start of the arc (G91.1)",
            Distance::Absolute => "I, J, K are the place of the centre (G90.1)",
        };
        let ends = match self.modal.distance {
            Distance::Absolute => "the end point is absolute (G90)",
            Distance::Incremental => "the end point is incremental (G91)",
        };
        Diag::new(Code::RadiusMismatch, self.request.span, format!("radius {r1:.4} and then {r2:.4}"))
            .message(format!("start and end of the arc are not on one circle: radius {r1:.4} at the start, {r2:.4} at the end"))
            .help(format!("check end point and centre: {ends}, {mode}"))
    }

    fn centre_by_radius(&self, warnings: &mut Vec<Diag>) -> Result<Point, Diag> {
        let Some(word) = self.request.word('R') else { return Err(missing(self.request.motion_span(), "R")) };
        if let Some(extra) = ['I', 'J', 'K'].iter().find_map(|&l| self.request.word(l)) {
            return Err(Diag::new(Code::UnusedWord, extra.span, format!("nothing reads {}: R gives the centre", extra.letter))
                .also(word.span, "the radius stands here")
                .help("keep either R or the centre"));
        }
        let (start, end) = self.ends();
        let slack = radius_slack(self.modal.units);
        let half = arc::distance(start, end) / 2.0;
        if half == 0.0 {
            return Err(bad_value(word, "start and end are the same point", "write a full circle with I, J, K"));
        }
        let sine = half / word.value.abs();
        if (1.0 - sine).abs() < UNSTABLE || (sine < UNSTABLE_FULL && word.value < 0.0) {
            warnings.push(unstable(word));
        }
        arc::centre_by_radius(start, end, word.value, self.counterclockwise, slack).ok_or_else(|| {
            let chord = 2.0 * half;
            Diag::new(Code::RadiusMismatch, word.span, format!("at least {half:.4} is needed"))
                .message(format!("no arc of radius {:.4} joins two points {chord:.4} apart", word.value))
                .help("check the end point, or give the centre with I, J, K")
        })
    }

    fn no_centre(&self, first: char, second: char) -> Diag {
        missing(self.request.motion_span(), &format!("{first}, {second} or R"))
            .help(format!("give the centre with {first} and {second}, or the radius with R"))
    }

    fn half_a_centre(&self, first: char, second: char) -> Diag {
        missing(self.request.motion_span(), &format!("both {first} and {second}"))
            .help("the place of the centre has two coordinates in G90.1")
    }
}

/// 1 - sine of the half sweep below which an arc by radius is near half a turn: about 1 degree.
const UNSTABLE: f64 = 4e-5;
/// Sine of the half sweep below which an arc by radius is near a full turn: about 1 degree.
const UNSTABLE_FULL: f64 = 0.0087;

fn unstable(word: crate::ngc::request::Word) -> Diag {
    Diag::new(Code::UnstableArc, word.span, "near half a turn or a full turn").help("give the centre with I, J, K")
}

/// Offset letters of the first and second axis of the plane, and the one that is not used in it.
fn offset_letters(plane: Plane) -> [char; 3] {
    match plane {
        Plane::Xy => ['I', 'J', 'K'],
        Plane::Yz => ['J', 'K', 'I'],
        Plane::Xz => ['K', 'I', 'J'],
    }
}

fn not_in_plane(at: takt_base::Span, plane: Plane) -> Diag {
    let (name, [first, second, other]) = (plane_name(plane), offset_letters(plane));
    Diag::new(Code::UnusedWord, at, format!("nothing reads {other} in the plane {name}"))
        .help(format!("the centre is given by {first} and {second}; the plane is selected by G17, G18, G19"))
}

fn plane_name(plane: Plane) -> &'static str {
    match plane {
        Plane::Xy => "XY",
        Plane::Yz => "YZ",
        Plane::Xz => "XZ",
    }
}

/// How far the radii at start and end may differ, in length units: beyond it a thousandth of the radius counts, and a hundredfold is
/// never allowed. The rule and the numbers are LinuxCNC's.
fn radius_tolerance(units: Units) -> f64 {
    let two_root_two = 2.0 * std::f64::consts::SQRT_2;
    match units {
        Units::Inches => 0.001 * two_root_two,
        Units::Mm => 0.01 * two_root_two,
        Units::Cm => 0.001 * two_root_two,
    }
}

/// How much too small an R may be, in length units: 0.00127 mm, or 0.00005 inch, as in LinuxCNC.
fn radius_slack(units: Units) -> f64 {
    0.00127 / mm_per_unit(units)
}
