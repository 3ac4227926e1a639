//! Canonical commands to moves in machine coordinates: mm and degrees. What [`crate::draw`] and [`crate::stats`] read.

use crate::canon::{Canon, Plane, Position, Units};
use crate::ngc::arc::Sweep;
use crate::ngc::modal::{from_plane, in_plane, mm_per_unit, plus, rotated, scaled};

/// One move.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Move {
    /// Start: mm and degrees, machine coordinates.
    pub from: Position,
    /// End.
    pub to: Position,
    /// How.
    pub kind: Kind,
}

/// Traverse, straight or circular feed.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Kind {
    /// As fast as possible.
    Rapid,
    /// Straight at `feed` in mm/min, or degrees/min if only rotary axes move.
    Feed {
        /// Rate.
        feed: f64,
    },
    /// Arc or helix at `feed` in mm/min.
    Arc {
        /// Rate.
        feed: f64,
        /// Shape.
        sweep: Sweep,
    },
}

/// Follows commands and knows where the controlled point is.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Tracker {
    position: Position,
    origin: Position,
    units: Units,
    plane: Plane,
    feed: f64,
    rotation: f64,
    tool: Position,
}

impl Tracker {
    /// From `start` in machine coordinates: mm and degrees.
    pub fn new(start: Position) -> Self {
        Tracker {
            position: start,
            origin: Position::default(),
            units: Units::Mm,
            plane: Plane::Xy,
            feed: 0.0,
            rotation: 0.0,
            tool: Position::default(),
        }
    }

    /// The move that a command makes, if it moves. `None` as well for an arc of rotation 0 whose end moved (CM-62).
    pub fn follow(&mut self, command: &Canon) -> Option<Move> {
        match command {
            Canon::UseLengthUnits(units) => self.use_units(*units),
            Canon::SelectPlane(plane) => self.plane = *plane,
            Canon::SetOriginOffsets(origin) => self.origin = scaled(*origin, mm_per_unit(self.units)),
            Canon::SetXyRotation(degrees) => self.rotation = *degrees,
            Canon::UseToolLengthOffset(z) => {
                self.tool = scaled(Position { z: *z, ..Position::default() }, mm_per_unit(self.units))
            }
            Canon::UseToolLengthOffsets(p) => self.tool = scaled(*p, mm_per_unit(self.units)),
            Canon::SetFeedRate(feed) => self.feed = *feed,
            Canon::StraightTraverse(end) => return Some(self.go(self.machine(*end), |_| Kind::Rapid)),
            Canon::StraightFeed(end) => {
                let to = self.machine(*end);
                let feed = if linear_length(self.position, to) > 0.0 { self.feed * mm_per_unit(self.units) } else { self.feed };
                return Some(self.go(to, |_| Kind::Feed { feed }));
            }
            Canon::ArcFeed(arc) => return self.arc(arc),
            _ => {}
        }
        None
    }

    fn use_units(&mut self, units: Units) {
        self.feed *= mm_per_unit(self.units) / mm_per_unit(units);
        self.units = units;
    }

    fn machine(&self, p: Position) -> Position {
        plus(plus(rotated(scaled(p, mm_per_unit(self.units)), self.rotation), self.origin), self.tool)
    }

    fn go(&mut self, to: Position, kind: impl Fn(&Self) -> Kind) -> Move {
        let from = std::mem::replace(&mut self.position, to);
        Move { from, to, kind: kind(self) }
    }

    fn arc(&mut self, arc: &crate::canon::Arc) -> Option<Move> {
        let rotary = Position { a: arc.a, b: arc.b, c: arc.c, ..Position::default() };
        let place = |first, second, third| self.machine(from_plane([first, second, third], self.plane, rotary));
        let end = in_plane(place(arc.first_end, arc.second_end, arc.axis_end_point), self.plane);
        let centre = in_plane(place(arc.first_axis, arc.second_axis, 0.0), self.plane);
        let Position { a, b, c, .. } = place(0.0, 0.0, 0.0);
        let in_mm = crate::canon::Arc {
            first_end: end[0],
            second_end: end[1],
            first_axis: centre[0],
            second_axis: centre[1],
            rotation: arc.rotation,
            axis_end_point: end[2],
            a,
            b,
            c,
        };
        let sweep = Sweep::new(self.plane, self.position, &in_mm)?;
        let feed = self.feed * mm_per_unit(self.units);
        Some(self.go(sweep.to, |_| Kind::Arc { feed, sweep }))
    }
}

impl Move {
    /// Length in mm of the path of X, Y, Z; along the helix (CM-41, CM-48).
    pub fn length(&self) -> f64 {
        match self.kind {
            Kind::Arc { sweep, .. } => sweep.length(),
            _ => linear_length(self.from, self.to),
        }
    }

    /// Time at the programmed feed, in seconds; 0 for a traverse, whose rate the program does not say (CM-41..CM-43).
    pub fn feed_time(&self) -> f64 {
        let (Kind::Feed { feed } | Kind::Arc { feed, .. }) = self.kind else { return 0.0 };
        let linear = self.length();
        let path = if linear > 0.0 { linear } else { rotary_length(self.from, self.to) };
        if path > 0.0 && feed > 0.0 { path / feed * 60.0 } else { 0.0 }
    }

    /// Points whose polygon stays within `chord` mm of the path, start and end among them; at most 2000 chords.
    pub fn points(&self, chord: f64) -> Vec<Position> {
        match self.kind {
            Kind::Arc { sweep, .. } => sweep.points(segments(&sweep, chord)).collect(),
            _ => vec![self.from, self.to],
        }
    }

    /// Places between which the path lies.
    pub fn extremes(&self) -> Vec<Position> {
        match self.kind {
            Kind::Arc { sweep, .. } => sweep.extremes(),
            _ => vec![self.from, self.to],
        }
    }
}

/// Number of chords for an arc: chord error r (1 - cos(step / 2)) <= `chord`; at most 720 a turn, 2000 in all.
fn segments(sweep: &Sweep, chord: f64) -> u32 {
    let r = sweep.radius.max(sweep.end_radius);
    let finest = std::f64::consts::TAU / 720.0;
    let step = if chord < r { 2.0 * libm::acos(1.0 - chord / r) } else { 1.0 };
    (sweep.sweep.abs() / step.clamp(finest, 0.5)).ceil().clamp(1.0, 2000.0) as u32
}

fn linear_length(p: Position, q: Position) -> f64 {
    let (dx, dy, dz) = (q.x - p.x, q.y - p.y, q.z - p.z);
    (dx * dx + dy * dy + dz * dz).sqrt()
}

fn rotary_length(p: Position, q: Position) -> f64 {
    let (da, db, dc) = (q.a - p.a, q.b - p.b, q.c - p.c);
    (da * da + db * db + dc * dc).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn follow(commands: &[Canon]) -> Vec<Move> {
        let mut tracker = Tracker::new(Position::default());
        commands.iter().filter_map(|c| tracker.follow(c)).collect()
    }

    fn at(x: f64, y: f64, a: f64, b: f64, c: f64) -> Position {
        Position { x, y, z: 0.0, a, b, c }
    }

    /// CM-T1, CM-T2
    #[test]
    fn feed_time_with_rotary_axes() {
        let time = |p| follow(&[Canon::SetFeedRate(100.0), Canon::StraightFeed(p)])[0].feed_time();
        assert!((time(at(0.0, 0.0, 30.0, 40.0, 0.0)) - 30.0).abs() < 1e-9);
        assert!((time(at(3.0, 4.0, 0.0, 0.0, 90.0)) - 3.0).abs() < 1e-9);
    }

    /// CM-26, CM-40: offsets and units count, the effective feed stays.
    #[test]
    fn offsets_and_units() {
        let moves = follow(&[
            Canon::SetFeedRate(254.0),
            Canon::UseLengthUnits(Units::Inches),
            Canon::SetOriginOffsets(at(1.0, 0.0, 0.0, 0.0, 5.0)),
            Canon::StraightFeed(at(1.0, 0.0, 0.0, 0.0, 5.0)),
        ]);
        assert_eq!(moves[0].to, at(50.8, 0.0, 0.0, 0.0, 10.0));
        assert!((moves[0].feed_time() - 12.0).abs() < 1e-9);
    }

    #[test]
    fn chords_stay_near_the_arc() {
        let arc = crate::canon::Arc {
            first_end: 0.0,
            second_end: 0.0,
            first_axis: 10.0,
            second_axis: 0.0,
            rotation: 1,
            axis_end_point: 0.0,
            a: 0.0,
            b: 0.0,
            c: 0.0,
        };
        let moves = follow(&[Canon::ArcFeed(arc)]);
        let points = moves[0].points(0.01);
        for pair in points.windows(2) {
            let (mx, my) = ((pair[0].x + pair[1].x) / 2.0 - 10.0, (pair[0].y + pair[1].y) / 2.0);
            assert!(10.0 - libm::hypot(mx, my) <= 0.0101);
        }
        assert!(points.len() > 60 && points.len() < 100, "{}", points.len());
    }
}
