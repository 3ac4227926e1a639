//! Draws the tool path of canonical commands (CM-04): traverses dashed, feeds and arcs solid, start and end marked.

use crate::canon::{Canon, Plane, Position, Step};
use crate::ngc::modal::in_plane;
use crate::svg::{Picture, Point, Stroke};
use crate::toolpath::{Kind, Move, Tracker};

/// Chord error of drawn arcs as a share of the largest dimension.
const FINENESS: f64 = 1e-4;

/// Gathers moves command by command, then makes a [`Picture`].
pub struct Drawing {
    tracker: Tracker,
    start: Position,
    moves: Vec<Move>,
    /// Length of path while each plane was selected, in mm.
    weight: [f64; 3],
    plane: Plane,
}

impl Drawing {
    /// From `start` in machine coordinates (mm, degrees).
    pub fn new(start: Position) -> Self {
        Drawing { tracker: Tracker::new(start), start, moves: Vec::new(), weight: [0.0; 3], plane: Plane::Xy }
    }

    /// Adds what a step moves.
    pub fn read(&mut self, step: &Step) {
        if let Canon::SelectPlane(plane) = step.command {
            self.plane = plane;
        }
        if let Some(m) = self.tracker.follow(&step.command) {
            self.weight[self.plane as usize] += m.length();
            self.moves.push(m);
        }
    }

    /// The plane that was selected for the longest path, if there is motion along both of its axes; else another that has; else XY.
    pub fn best_plane(&self) -> Plane {
        let mut planes = [Plane::Xy, Plane::Yz, Plane::Xz];
        planes.sort_by(|a, b| self.weight[*b as usize].total_cmp(&self.weight[*a as usize]));
        planes.into_iter().find(|&plane| self.shows(plane)).unwrap_or(Plane::Xy)
    }

    fn shows(&self, plane: Plane) -> bool {
        let moves_along = |i: usize| self.moves.iter().any(|m| in_plane(m.from, plane)[i] != in_plane(m.to, plane)[i]);
        moves_along(0) && moves_along(1)
            || self.moves.iter().any(|m| matches!(m.kind, Kind::Arc { sweep, .. } if sweep.plane == plane))
    }

    /// The picture, seen along the third axis of `plane`.
    pub fn picture(&self, title: &str, plane: Plane) -> Picture {
        let [across, up] = axis_names(plane);
        let mut picture = Picture::new(title).axes(across, up);
        let chord = self.size() * FINENESS;
        for (rapid, points) in self.runs(plane, chord) {
            let (name, stroke) = if rapid { ("traverse", Stroke::rapid()) } else { ("feed", Stroke::feed()) };
            picture = picture.curve(name, points, stroke);
        }
        let end = self.moves.last().map_or(self.start, |m| m.to);
        picture.marker("start", flat(self.start, plane), "#2e7d32").marker("end", flat(end, plane), "#b71c1c")
    }

    /// Moves of one kind that follow each other, as one curve each.
    fn runs(&self, plane: Plane, chord: f64) -> Vec<(bool, Vec<Point>)> {
        let mut runs: Vec<(bool, Vec<Point>)> = Vec::new();
        for m in &self.moves {
            let rapid = m.kind == Kind::Rapid;
            let points = m.points(chord).into_iter().map(|p| flat(p, plane));
            match runs.last_mut() {
                Some((kind, run)) if *kind == rapid => run.extend(points.skip(1)),
                _ => runs.push((rapid, points.collect())),
            }
        }
        runs
    }

    /// Largest dimension in mm.
    fn size(&self) -> f64 {
        let places = || self.moves.iter().flat_map(Move::extremes);
        let span = |pick: fn(&Position) -> f64| {
            let (lo, hi) = places().map(|p| pick(&p)).fold((f64::MAX, f64::MIN), |(lo, hi), v| (lo.min(v), hi.max(v)));
            if hi > lo { hi - lo } else { 0.0 }
        };
        span(|p| p.x).max(span(|p| p.y)).max(span(|p| p.z))
    }
}

/// The picture of `steps` from the machine's origin, in the plane that shows most.
pub fn draw<'a>(steps: impl IntoIterator<Item = &'a Step>, title: &str) -> Picture {
    let mut drawing = Drawing::new(Position::default());
    steps.into_iter().for_each(|step| drawing.read(step));
    drawing.picture(title, drawing.best_plane())
}

/// Horizontal and vertical axis; the XZ plane is drawn with X to the right and Z up.
fn axis_names(plane: Plane) -> [&'static str; 2] {
    match plane {
        Plane::Xy => ["X", "Y"],
        Plane::Yz => ["Y", "Z"],
        Plane::Xz => ["X", "Z"],
    }
}

fn flat(p: Position, plane: Plane) -> Point {
    let [first, second, _] = in_plane(p, plane);
    if plane == Plane::Xz { [second, first] } else { [first, second] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ngc::{Interpreter, Options};
    use takt_base::SourceId;

    fn drawing(text: &str) -> Drawing {
        let mut drawing = Drawing::new(Position::default());
        for step in Interpreter::new(SourceId(0), text, Options::default()) {
            drawing.read(&step.unwrap());
        }
        drawing
    }

    #[test]
    fn traverses_are_dashed_and_runs_are_joined() {
        let svg = drawing("G0 X1\nY2\nG1 X5 F100\nY5\nG0 X0").picture("t", Plane::Xy).to_svg();
        assert_eq!(svg.matches("<polyline").count(), 3);
        assert_eq!(svg.lines().filter(|l| l.starts_with("<polyline") && l.contains("dasharray")).count(), 2);
        assert!(svg.contains(">start</text>") && svg.contains(">end</text>"));
    }

    #[test]
    fn plane_with_motion() {
        let cases = [
            ("G1 X5 Y5 F100", Plane::Xy),
            ("G18 G1 X5 F100\nZ5", Plane::Xz),
            ("G19 G1 Y5 F100\nZ5", Plane::Yz),
            ("G18 G2 I5 F100", Plane::Xz),
            ("G18 G2 I5 Y3 F100", Plane::Xz),
            ("G18 G1 X5 Y5 F100", Plane::Xy),
            ("G1 X5 F100", Plane::Xy),
            ("", Plane::Xy),
        ];
        for (text, want) in cases {
            assert_eq!(drawing(text).best_plane(), want, "{text}");
        }
    }
}
