//! Levels, and where a pass at a level starts and ends.

use crate::ngc::arc::Point;

/// Levels that one cycle may have.
const LEVELS_MAX: f64 = 100_000.0;

/// A cut at one level.
#[derive(Clone, PartialEq, Debug)]
pub struct Pass {
    /// Coordinate across.
    pub level: f64,
    /// Along the contour down from the level before into a pocket; empty for a pass from the start.
    pub entry: Vec<Point>,
    /// Coordinate along at its start and end.
    pub from: f64,
    /// See [`Pass::from`].
    pub to: f64,
}

/// Levels from `start` towards `last`, `depth` apart; neither is among them. `None` if there are too many.
pub fn levels(start: f64, last: f64, depth: f64) -> Option<Vec<f64>> {
    let n = (last - start).abs() / depth;
    if n.is_nan() || n > LEVELS_MAX {
        return None;
    }
    let way = (last - start).signum();
    let count = (n - 1e-9).floor().max(0.0) as u32;
    let all = (1..=count).map(|k| start + way * depth * f64::from(k));
    Some(all.filter(|level| (last - level) * way > 1e-9).collect())
}

/// Passes at `level`: where the contour lies beyond it, seen from `start`. `before` is the level cut before this one.
/// The contour goes one way along; at its end the last pass ends too.
pub fn passes(contour: &[Point], start: Point, level: f64, before: f64) -> Vec<Pass> {
    let inward = (level - start[1]).signum();
    // Above zero where there is something to cut at this level.
    let room = |p: Point| (p[1] - level) * inward;
    let (Some(&first), Some(&last)) = (contour.first(), contour.last()) else { return Vec::new() };
    let (mut all, mut open) = (Vec::new(), None);
    if room(first) >= 0.0 {
        open = Some((start[0], Vec::new()));
    }
    for pair in contour.windows(2) {
        let (a, b) = (room(pair[0]), room(pair[1]));
        let crossing = |from: f64, to: f64| pair[0][0] + (pair[1][0] - pair[0][0]) * from / (from - to);
        if a >= 0.0 && b < 0.0 {
            if let Some((from, entry)) = open.take() {
                all.push(Pass { level, entry, from, to: crossing(a, b) });
            }
        } else if a < 0.0 && b >= 0.0 && open.is_none() {
            let from = crossing(a, b);
            open = Some((from, descent(contour, [from, level], before, inward)));
        }
    }
    if let Some((from, entry)) = open {
        all.push(Pass { level, entry, from, to: last[0] });
    }
    all
}

/// Points of the contour from the level before down to `end`.
fn descent(contour: &[Point], end: Point, before: f64, inward: f64) -> Vec<Point> {
    let mut points = Vec::new();
    for pair in contour.windows(2) {
        let ([p, q], reached) = ([pair[0], pair[1]], |p: Point| (p[1] - before) * inward);
        let (a, b) = (reached(p), reached(q));
        if a < 0.0 && b >= 0.0 {
            let t = a / (a - b);
            points = vec![[p[0] + (q[0] - p[0]) * t, before]];
        } else if a >= 0.0 && points.last() != Some(&p) {
            points.push(p);
        }
        let holds = (end[0] - p[0]) * (end[0] - q[0]) <= 0.0 && (end[1] - p[1]) * (end[1] - q[1]) <= 0.0;
        if holds {
            break;
        }
    }
    points.push(end);
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_lie_between_start_and_end() {
        assert_eq!(levels(20.0, 10.0, 3.0), Some(vec![17.0, 14.0, 11.0]));
        assert_eq!(levels(20.0, 10.0, 5.0), Some(vec![15.0]));
        assert_eq!(levels(0.0, 4.0, 3.0), Some(vec![3.0]));
        assert_eq!(levels(1.0, 1.0, 1.0), Some(vec![]));
        assert_eq!(levels(0.0, 1e9, 1e-6), None);
    }

    /// A step, then a pocket: at the lower level there are two passes, the second enters along the flank.
    #[test]
    fn steps_and_pockets() {
        let contour = [[0.0, 5.0], [-10.0, 5.0], [-10.0, 12.0], [-20.0, 12.0], [-22.0, 8.0], [-30.0, 8.0], [-30.0, 20.0]];
        let start = [2.0, 20.0];
        let spans = |level, before| passes(&contour, start, level, before).iter().map(|p| (p.from, p.to)).collect::<Vec<_>>();
        assert_eq!(spans(15.0, 20.0), [(2.0, -30.0)]);
        assert_eq!(spans(10.0, 15.0), [(2.0, -10.0), (-21.0, -30.0)]);
        assert_eq!(passes(&contour, start, 10.0, 15.0)[1].entry.last(), Some(&[-21.0, 10.0]));
        assert_eq!(spans(6.0, 10.0), [(2.0, -10.0)]);
    }
}
