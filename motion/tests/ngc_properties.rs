//! What holds for all programs: the same path in inches and in millimetres, turned and shifted, as a loop and written out; the tool keeps
//! its distance from a compensated contour; endless and wild programs end with a message.

mod common;

use common::programs::{Random, program};
use std::fmt::Write;
use takt_base::{Code, SourceId};
use takt_motion::canon::{Canon, Position, Step};
use takt_motion::ngc::{Interpreter, Options, check};
use takt_motion::toolpath::{Move, Tracker};

fn steps(text: &str) -> Vec<Step> {
    let all: Result<Vec<Step>, _> = Interpreter::new(SourceId(0), text, Options::default()).collect();
    all.unwrap_or_else(|d| panic!("{d:?}\n{text}"))
}

fn moves(text: &str) -> Vec<Move> {
    let mut tracker = Tracker::new(Position::default());
    steps(text).iter().filter_map(|s| tracker.follow(&s.command)).collect()
}

fn apart(p: Position, q: Position) -> f64 {
    let (dx, dy, dz) = (p.x - q.x, p.y - q.y, p.z - q.z);
    (dx * dx + dy * dy + dz * dz).sqrt()
}

/// Moves of random lines and arcs; lengths are multiplied by `scale`.
fn contour(random: &mut Random, scale: f64) -> String {
    let mut text = String::from("F100\n");
    for _ in 0..30 {
        let [x, y, z] = [(); 3].map(|()| random.eighths(-40, 40) * scale);
        let radius = (60.0 + random.eighths(0, 20)) * scale;
        let _ = match random.below(4) {
            0 => writeln!(text, "G0 X{x:.9} Z{z:.9}"),
            1 => writeln!(text, "G2 X{x:.9} Y{y:.9} R{radius:.9}"),
            2 => writeln!(text, "G3 X{x:.9} Y{y:.9} Z{z:.9} R{radius:.9}"),
            _ => writeln!(text, "G1 X{x:.9} Y{y:.9} Z{z:.9}"),
        };
    }
    text
}

#[test]
fn inches_and_millimetres_give_the_same_path() {
    for seed in 0..200 {
        let mm = moves(&format!("G21 {}", contour(&mut Random(seed), 1.0)));
        let inches = moves(&format!("G20 {}", contour(&mut Random(seed), 1.0 / 25.4)));
        assert_eq!(mm.len(), inches.len());
        for (a, b) in mm.iter().zip(&inches) {
            assert!(apart(a.to, b.to) < 1e-6 && (a.length() - b.length()).abs() < 1e-4, "{seed}: {a:?} {b:?}");
        }
    }
}

/// G10 L2 moves and turns the whole path: lengths stay, ends are where geometry says.
#[test]
fn work_offsets_shift_and_turn_the_path() {
    for seed in 0..200 {
        let text = contour(&mut Random(seed), 1.0);
        let (plain, turned) = (moves(&text), moves(&format!("G10 L2 P1 X10 Y-20 Z5 R30\n{text}")));
        let (sin, cos) = (0.5, 3f64.sqrt() / 2.0);
        for (a, b) in plain.iter().zip(&turned).skip(3) {
            let to =
                |p: Position| Position { x: p.x * cos - p.y * sin + 10.0, y: p.x * sin + p.y * cos - 20.0, z: p.z + 5.0, ..p };
            // Axes that no word has named yet stand where they stood.
            if apart(to(a.from), b.from) < 1e-6 {
                assert!(apart(to(a.to), b.to) < 1e-6 && (a.length() - b.length()).abs() < 1e-6, "{seed}: {a:?} {b:?}");
            }
        }
    }
}

#[test]
fn a_loop_is_the_same_as_its_blocks() {
    let commands = |text: &str| steps(text).into_iter().map(|s| s.command).collect::<Vec<_>>();
    for seed in 0..50 {
        let text = program(&mut Random(seed), 20);
        let body = text.trim_end_matches("M2\n");
        let written = format!("{body}{body}{body}M2\n");
        for looped in [
            format!("o1 repeat [3]\n{body}o1 endrepeat\nM2\n"),
            format!("o1 sub\n{body}o1 endsub\no1 call\no1 call\no1 call\nM2\n"),
            format!("#9=0\no1 while [#9 LT 3]\n{body}#9=[#9+1]\no1 endwhile\nM2\n"),
            format!("M98 P7 L3\nM2\nO7\n{body}M99\n"),
        ] {
            assert_eq!(commands(&looped), commands(&written), "{looped}");
        }
    }
}

/// Distance of a point from a polygon.
fn from_polygon(p: [f64; 2], polygon: &[[f64; 2]]) -> f64 {
    let from = |a: [f64; 2], b: [f64; 2]| {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let t = (((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
        let (ex, ey) = (p[0] - a[0] - t * dx, p[1] - a[1] - t * dy);
        (ex * ex + ey * ey).sqrt()
    };
    polygon.windows(2).map(|w| from(w[0], w[1])).fold(f64::INFINITY, f64::min)
}

/// The contour goes from left to right, so that it never comes back to itself; steep and sharp corners on both sides.
#[test]
fn the_tool_keeps_its_distance_from_the_contour() {
    let radius = 2.0;
    let (mut random, mut followed) = (Random(41), 0);
    for _ in 0..400 {
        let side = if random.below(2) == 0 { "G41.1" } else { "G42.1" };
        let mut polygon = vec![[0.0, 0.0], [20.0, 0.0]];
        for i in 0..10 {
            polygon.push([20.0 + 15.0 * f64::from(i + 1), random.eighths(-20, 20)]);
        }
        let mut text = format!("F100 {side} D{}\n", 2.0 * radius);
        for [x, y] in &polygon[1..] {
            let _ = writeln!(text, "G1 X{x} Y{y}");
        }
        text += "G40\nM2\n";
        let found: Result<Vec<Step>, _> = Interpreter::new(SourceId(0), text.as_str(), Options::default()).collect();
        let Ok(found) = found else { continue };
        followed += 1;
        let mut tracker = Tracker::new(Position::default());
        for m in found.iter().filter_map(|s| tracker.follow(&s.command)).skip(1) {
            let points = m.points(1e-4);
            let inner = (0..=20).map(|i| f64::from(i) / 20.0);
            let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
            let along =
                points.windows(2).flat_map(|w| inner.clone().map(move |t| [mix(w[0].x, w[1].x, t), mix(w[0].y, w[1].y, t)]));
            for p in along {
                let distance = from_polygon(p, &polygon);
                assert!(distance > radius - 2e-3, "{distance} at {p:?}\n{text}");
            }
        }
    }
    assert!(followed > 100, "{followed}");
}

/// Programs that never end, or ask for very much.
#[test]
fn wild_programs_end_with_a_message() {
    let cases = [
        ("o1 while [1]\n#1 = [#1 + 1]\no1 endwhile", Code::EndlessProgram),
        ("o1 sub\no1 call\no1 endsub\no1 call", Code::NestedTooDeeply),
        ("M98 P1\nM2\nO1\nM98 P1\nM99", Code::NestedTooDeeply),
        ("o1 repeat [1e12]\no1 endrepeat", Code::BadExpression),
        ("o1 repeat [999999999999]\no1 endrepeat", Code::EndlessProgram),
        ("F1 G0 Z9\nG83 X1 Z-5 R1 Q0.0000001", Code::BadValue),
        ("F1 G0 Z9\nG83 X1 Z-5 R1 Q0.001 L100000", Code::BadValue),
        ("F1 G81 X1 Z-5 R1 L9999999", Code::BadValue),
        ("M3 S1 G76 P1 Z-5 I-1 J0.0000001 K9", Code::BadValue),
        ("o1 if [1]\no2 if [1]\no1 endif", Code::BadFlow),
        // A peck that is less than the distance of two numbers at this place.
        ("F1 G83 X0 Y0 R1000000000000 Z999999999999.999 Q0.00001", Code::BadValue),
        // The loop of the caller is none of the subroutine's.
        ("o2 sub\no1 endrepeat\no2 endsub\no1 repeat [3]\no2 call\no1 endrepeat", Code::BadFlow),
    ];
    for (text, want) in cases {
        let error = Interpreter::new(SourceId(0), text, Options::default()).find_map(Result::err);
        assert_eq!(error.map(|d| d.code), Some(want), "{text}");
        assert!(check(SourceId(0), text, Options::default()).iter().any(|d| d.code == want), "{text}");
    }
}

/// Modes that the main program saved are there when M98 has called a subroutine twice.
#[test]
fn repeated_calls_leave_saved_modes_alone() {
    let text = "o100 sub\nG0 Y1\no100 endsub\nG90 M70\nM98 P100 L2\nG91\nM72\nG0 X1\nX1\nM2";
    let last = steps(text)
        .into_iter()
        .filter_map(|s| if let Canon::StraightTraverse(p) = s.command { Some(p) } else { None })
        .next_back();
    assert_eq!(last.map(|p| (p.x, p.y)), Some((1.0, 1.0)));
}

/// M99 in the main program starts it anew, for ever; a check reads it once.
#[test]
fn m99_repeats_the_program() {
    let text = "G91 G0 X1\nM99";
    let moves = Interpreter::new(SourceId(0), text, Options::default()).take(500);
    assert_eq!(moves.filter(|s| matches!(s.as_ref().map(|s| &s.command), Ok(Canon::StraightTraverse(_)))).count(), 495);
    assert!(check(SourceId(0), text, Options::default()).is_empty());
}

/// Rows of loops are compiled once, and straight programs keep nothing: both give the same after very many rows.
#[test]
fn many_rows() {
    let text = "#1=0\no1 while [#1 LT 200000]\nG1 X[#1 / 1000] F100\n#1=[#1+1]\no1 endwhile\nM2";
    let last = Interpreter::new(SourceId(0), text, Options::default()).map(Result::unwrap).filter_map(|s| match s.command {
        Canon::StraightFeed(p) => Some(p.x),
        _ => None,
    });
    assert_eq!(last.last(), Some(199.999));
}
