//! Programs of the Fanuc-style dialects: macro B, calls, transformations, interpolation of rotary axes, NURBS, corners, cycles.

mod common;

use common::programs::Random;
use std::fmt::Write;
use takt_base::{Code, Severity, SourceId};
use takt_motion::canon::{Canon, Position, Step};
use takt_motion::feeder::{PartProgram, ngc_reader};
use takt_motion::ngc::{Dialect, Interpreter, Language, Options, check};
use takt_motion::toolpath::{Move, Tracker};

fn options(dialect: &str, settings: &[&str]) -> Options {
    let settings: Vec<String> = settings.iter().map(|s| (*s).to_owned()).collect();
    Options { language: Language::new(dialect, false, &settings).unwrap(), ..Options::default() }
}

fn steps_with(options: Options, text: &str) -> Vec<Step> {
    let all: Result<Vec<Step>, _> = Interpreter::new(SourceId(0), text, options).collect();
    all.unwrap_or_else(|d| panic!("{d:?}\n{text}"))
}

fn steps(dialect: &str, text: &str) -> Vec<Step> {
    steps_with(options(dialect, &[]), text)
}

/// Ends of all straight and round moves.
fn ends(steps: &[Step]) -> Vec<[f64; 3]> {
    let near = |v: f64| (v * 1e6).round() / 1e6 + 0.0;
    let mut tracker = Tracker::new(Position::default());
    steps.iter().filter_map(|s| tracker.follow(&s.command)).map(|m| [near(m.to.x), near(m.to.y), near(m.to.z)]).collect()
}

fn mill(text: &str) -> Vec<[f64; 3]> {
    ends(&steps("fanuc-mill", text))
}

fn turn(text: &str) -> Vec<[f64; 3]> {
    ends(&steps("fanuc-turn", text))
}

fn xs(text: &str) -> Vec<f64> {
    mill(text).iter().map(|p| p[0]).collect()
}

/// The value of an expression, by moving there.
fn value(expression: &str) -> f64 {
    let found = mill(&format!("#100={expression}\nG0 X#100"));
    found.last().map_or(0.0, |p| p[0])
}

#[test]
fn functions_and_operators() {
    for (expression, want) in [
        ("1+2*3", 7.0),
        ("[1+2]*3", 9.0),
        ("10-4-3", 3.0),
        ("SIN[30]", 0.5),
        ("COS[60]+TAN[45]", 1.5),
        ("ASIN[.5]", 30.0),
        ("ACOS[.5]", 60.0),
        ("ATAN[1]/[-1]", 135.0),
        ("ATAN[1,-1]", 135.0),
        ("ATAN[1]", 45.0),
        ("SQRT[16]+ABS[-2]", 6.0),
        ("ROUND[2.5]", 3.0),
        ("FIX[-2.7]", -2.0),
        ("FUP[-2.2]", -3.0),
        ("FUP[2.2]", 3.0),
        ("LN[EXP[2]]", 2.0),
        ("POW[2,10]", 1024.0),
        ("BIN[18]", 12.0),
        ("BCD[12]", 18.0),
        ("7 MOD 4", 3.0),
        ("12 AND 10", 8.0),
        ("12 OR 3", 15.0),
        ("12 XOR 10", 6.0),
        ("-#0+5", 5.0),
        ("[2 GT 1]+[2 LE 1]", 1.0),
        ("[1 EQ 1] AND [2 NE 1]", 1.0),
        ("-[-3]", 3.0),
    ] {
        assert!((value(expression) - want).abs() < 1e-6, "{expression}: {}", value(expression));
    }
}

/// A vacant variable takes its address with it, is 0 in sums, and EQ tells it from 0.
#[test]
fn vacant_variables() {
    assert_eq!(mill("G0 X5 Y5\nG0 X#1 Y1"), [[5.0, 5.0, 0.0], [5.0, 1.0, 0.0]]);
    assert_eq!(xs("IF[#1 EQ #0]THEN #2=3\nIF[#1 EQ 0]THEN #2=4\nIF[#1 GE 0]THEN #3=5\nG0 X[#2+#3]"), [8.0]);
    assert_eq!(xs("#1=#2\nIF[#1 NE #0]GOTO 5\nG0 X1\nN5 X2"), [1.0, 2.0]);
}

/// ROUND in an address rounds to the least input increment.
#[test]
fn round_in_an_address() {
    assert_eq!(xs("#1=1.23456\nG0 X[ROUND[#1]]\n#1=ROUND[#1]\nX#1"), [1.235, 1.0]);
}

#[test]
fn loops_and_jumps() {
    assert_eq!(
        xs("#1=0\nWHILE[#1 LT 3]DO1\n#2=0\nWHILE[#2 LT 2]DO2\nG0 X[#1*10+#2]\n#2=#2+1\nEND2\n#1=#1+1\nEND1"),
        [0.0, 1.0, 10.0, 11.0, 20.0, 21.0]
    );
    assert_eq!(xs("#1=1\nN10 G0 X#1\n#1=#1+1\nIF[#1 LE 3]GOTO 10\nGOTO[10*2]\nX99\nN20 X50"), [1.0, 2.0, 3.0, 50.0]);
    // A jump out of a loop leaves it; the loop can start again.
    assert_eq!(
        xs("#2=0\nN1 #1=0\nWHILE[#1 LT 9]DO1\nG0 X#1\nIF[#1 EQ 1]GOTO 5\n#1=#1+1\nEND1\nN5 #2=#2+1\nIF[#2 LT 2]GOTO 1"),
        [0.0, 1.0, 0.0, 1.0]
    );
    // The nearest block of the number behind the jump counts.
    assert_eq!(xs("N5 #1=#1+1\nIF[#1 GT 1]GOTO 9\nGOTO 5\nG0 X1\nN5 G0 X2\nN9 X3"), [2.0, 3.0]);
}

#[test]
fn arguments_of_both_kinds() {
    let all = "A1 B2 C3 I4 J5 K6 D7 E8 F9 H11 M13 Q17 R18 S19 T20 U21 V22 W23 X24 Y25 Z26";
    let mut text = format!("G65 P1 {all}\nM30\nO1\n");
    for n in (1..=9).chain([11, 13]).chain(17..=26) {
        let _ = writeln!(text, "IF[#{n} NE {n}]THEN #3000=1");
    }
    text += "IF[#10 NE #0]THEN #3000=2\nG0 X1\nM99\n";
    assert_eq!(xs(&text), [1.0]);
    let sets: String = (0..10).map(|i| format!("I{} J{} K{} ", 4 + 3 * i, 5 + 3 * i, 6 + 3 * i)).collect();
    let mut text = format!("G65 P1 A1 B2 C3 {sets}\nM30\nO1\n");
    for n in 1..=33 {
        let _ = writeln!(text, "IF[#{n} NE {n}]THEN #3000=1");
    }
    assert_eq!(xs(&(text + "G0 X1\nM99\n")), [1.0]);
    // The later of two words for one variable counts.
    assert_eq!(xs("G65 P1 A1 B2 I-3 I4 D5\nM30\nO1\nG0 X#7\nM99"), [5.0]);
}

/// Codes beside a call count before it.
#[test]
fn codes_beside_a_call() {
    assert_eq!(xs("G0 X5\nG91 G65 P1 X3\nM30\nO1\nG0 X#24\nM99"), [5.0, 8.0]);
}

/// Locals belong to a call of G65, not of M98; commons to all.
#[test]
fn locals_and_commons() {
    let text = "#1=1 #100=5\nG65 P2 A7\nG0 X#1\nM98 P3\nX#1\nX#100\nM30\nO2\nG0 X#1\n#1=8 #100=6\nM99\nO3\n#1=9\nM99";
    assert_eq!(xs(text), [7.0, 1.0, 9.0, 6.0]);
}

#[test]
fn calls_by_p_and_l() {
    let sub = "\nM30\nO1234\nG91 G0 X1\nG90\nM99\nO31234\nG0 X99\nM99";
    assert_eq!(xs(&format!("M98 P1234 L3{sub}")), [1.0, 2.0, 3.0]);
    assert_eq!(xs(&format!("M98 P31234{sub}")), [1.0, 2.0, 3.0]);
    assert_eq!(xs(&format!("M98 P00031234{sub}")), [1.0, 2.0, 3.0]);
    assert_eq!(xs(&format!("G65 P1234 L2{sub}")), [1.0, 2.0]);
    // M99 P goes on at a block of the caller.
    assert_eq!(xs("M98 P2\nG0 X1\nN50 X2\nM30\nO2\nM99 P50"), [2.0]);
    assert_eq!(xs("G0 X1\n#1=#1+1\nIF[#1 GT 1]GOTO 9\nM99 P4\nX99\nN4 X3\nN9 M30"), [1.0, 3.0]);
}

/// Programs between `%` marks, comments, skipped blocks, either case.
#[test]
fn files_with_several_programs() {
    let text = "%\n:0001 (MAIN)\nn10 g0 x1;\n/2 x9;\nm98p2;\nm30;\n%\n%\nO0002(SUB)\nG0 X2;\nM99;\n%\n";
    let options = Options { skip_deleted: true, ..options("fanuc-mill", &[]) };
    assert_eq!(ends(&steps_with(options, text)).iter().map(|p| p[0]).collect::<Vec<_>>(), [1.0, 2.0]);
    // Without M30 the program ends where the next one starts.
    assert_eq!(xs("O1\nG0 X1\nO2\nX2\nM99"), [1.0]);
}

#[test]
fn user_codes_call_macros() {
    let options = options("fanuc-mill", &["G100=9010", "M50=sub 9001", "G101=modal 9011", "T=9000"]);
    let text = "G100 X3 Y4\nM50\nG101 Z2\nG0 X1\nG67\nT12\nM30\nO9010\nG0 X#24 Y#25\nM99\nO9001\nG0 X9\nM99\nO9011\nG0 Z#26\nM99\nO9000\nG0 X#149\nM99";
    let found = ends(&steps_with(options, text));
    assert_eq!(found, [[3.0, 4.0, 0.0], [9.0, 4.0, 0.0], [1.0, 4.0, 0.0], [1.0, 4.0, 2.0], [12.0, 4.0, 2.0]]);
}

#[test]
fn settings_that_are_none() {
    for text in [
        "",
        "G",
        "G100",
        "G100=x",
        "G100=odd 5",
        "Q1=5",
        "rough_depth=-1",
        "rough_depth=0",
        "chord_tolerance=nan",
        "T1=5",
        "äö=1",
    ] {
        assert!(Language::new("fanuc-mill", false, &[text.to_owned()]).is_err(), "{text}");
    }
    assert!(Language::new("fanuc", false, &[]).is_err());
}

/// A number without a point is the whole unit (calculator type), or a thousandth.
#[test]
fn least_input_increments() {
    let xs = |settings: &[&str], text: &str| ends(&steps_with(options("fanuc-mill", settings), text)).last().map(|p| p[0]);
    assert_eq!(xs(&[], "G0 X1000"), Some(1000.0));
    assert_eq!(xs(&["increments"], "G0 X1000"), Some(1.0));
    assert_eq!(xs(&["increments"], "G0 X1000."), Some(1000.0));
    assert_eq!(xs(&["increments"], "#1=1000 G0 X#1"), Some(1000.0));
    assert_eq!(xs(&["increments"], "G20 G0 X10000"), Some(25.4));
}

#[test]
fn system_variables() {
    let text = "G55 G91 G18 F123 S500\n#1=#4003 #2=#4014 #3=#4002 #4=#4109 #5=#4119 #6=#4016\nG17 G90\nG0 X#1 Y#2 Z#4\nX#5 Y#6";
    assert_eq!(mill(text), [[91.0, 55.0, 123.0], [500.0, 18.0, 123.0]]);
    assert_eq!(mill("G0 X5\n#5221=2 #5201=1\nG54 G0 X#5041 Y#5021 Z#5001"), [[5.0, 0.0, 0.0], [5.0, 5.0, 2.0]]);
    let message =
        steps("fanuc-mill", "#3006=1(TURN THE PART)").iter().any(|s| s.command == Canon::Message("TURN THE PART".into()));
    assert!(message);
}

/// Book O-04: polar coordinates; the setting has the book's reading of G15 and G16.
#[test]
fn book_o04_polar() {
    let want = [[86.602540, 50.0, 0.0], [-86.602540, 50.0, 0.0], [0.0, -100.0, 0.0]];
    assert_eq!(mill("G17 G90 G16\nG0 X100 Y30\nX100 Y150\nX100 Y270\nG15"), want);
    let exchanged = options("fanuc-mill", &["polar_exchanged"]);
    assert_eq!(ends(&steps_with(exchanged, "G17 G90 G15\nG0 X100 Y30\nX100 Y150\nX100 Y270\nG16")), want);
    assert_eq!(mill("G16 G0 X10 Y30\nG91 Y60"), [[8.660254, 5.0, 0.0], [0.0, 10.0, 0.0]]);
}

/// Book O-05: mirror images of a triangle.
#[test]
fn book_o05_mirror() {
    let sub = "\nM30\nO9000\nG0 X60 Y60\nG1 X100 F100\nY100\nX60 Y60\nM99";
    let text = format!("M98 P9000\nG51.1 X50\nM98 P9000\nG51.1 Y50\nM98 P9000\nG50.1 X0\nM98 P9000\nG50.1 Y0{sub}");
    let flat: Vec<[f64; 2]> = mill(&text).iter().map(|p| [p[0], p[1]]).collect();
    let shape = |f: fn([f64; 2]) -> [f64; 2]| [[60.0, 60.0], [100.0, 60.0], [100.0, 100.0], [60.0, 60.0]].map(f);
    let want =
        [shape(|p| p), shape(|[x, y]| [100.0 - x, y]), shape(|[x, y]| [100.0 - x, 100.0 - y]), shape(|[x, y]| [x, 100.0 - y])]
            .concat();
    assert_eq!(flat, want);
}

/// Book O-06: four ways to write the same two arcs.
#[test]
fn book_o06_arcs() {
    let head = "G92 X200 Y40 Z0\nG90\n";
    for text in [
        "G3 X140 Y100 I-60 F300\nG2 X120 Y60 I-50",
        "G3 X140 Y100 R60 F300\nG2 X120 Y60 R50",
        "G91 G3 X-60 Y60 I-60 F300\nG2 X-20 Y-40 I-50",
        "G91 G3 X-60 Y60 R60 F300\nG2 X-20 Y-40 R50",
    ] {
        let steps = steps("fanuc-mill", &format!("{head}{text}"));
        let mut tracker = Tracker::new(Position::default());
        let moves: Vec<Move> = steps.iter().filter_map(|s| tracker.follow(&s.command)).collect();
        let lengths: Vec<f64> = moves.iter().map(Move::length).collect();
        assert!((lengths[0] - 94.24778).abs() < 1e-4 && (lengths[1] - 46.36476).abs() < 1e-4, "{text}: {lengths:?}");
    }
}

/// Scaling and rotation about their centres; G68 in G91 turns on.
#[test]
fn scaling_and_rotation() {
    assert_eq!(mill("G51 X10 Y10 P2000\nG0 X20 Y5"), [[30.0, 0.0, 0.0]]);
    assert_eq!(mill("G51 X0 Y0 Z0 I2.0 J-1.0 K1.0\nG0 X3 Y4 Z5"), [[6.0, -4.0, 5.0]]);
    assert_eq!(mill("G68 X0 Y0 R30\nG91 G68 X0 Y0 R60\nG90 G0 X10 Y0"), [[0.0, 10.0, 0.0]]);
    assert_eq!(mill("G0 X5 Y5\nG68 R90\nG91 G0 X1"), [[5.0, 5.0, 0.0], [5.0, 6.0, 0.0]]);
    // Mirror, then scaling, then rotation.
    assert_eq!(mill("G51.1 X0\nG51 X0 Y0 P2.0\nG68 X0 Y0 R90\nG0 X1 Y0"), [[0.0, -2.0, 0.0]]);
}

/// Random contours of lines and arcs under a transformation: each end is where the geometry says, and lengths scale.
#[test]
fn transformations_commute() {
    let mut random = Random(11);
    for _ in 0..200 {
        let mut text = String::from("F100\n");
        for _ in 0..12 {
            let [x, y] = [(); 2].map(|()| random.eighths(-40, 40));
            let r = 60.0 + random.eighths(0, 20);
            let _ = match random.below(3) {
                0 => writeln!(text, "G2 X{x} Y{y} R{r}"),
                1 => writeln!(text, "G3 X{x} Y{y} R{r}"),
                _ => writeln!(text, "G1 X{x} Y{y}"),
            };
        }
        let moves = |head: &str| {
            let mut tracker = Tracker::new(Position::default());
            steps("fanuc-mill", &format!("{head}\n{text}"))
                .iter()
                .filter_map(|s| tracker.follow(&s.command))
                .collect::<Vec<Move>>()
        };
        let plain = moves("");
        let turned = moves("G51.1 X3\nG51 X1 Y2 P1.5\nG68 X4 Y5 R40");
        let (sin, cos) = libm::sincos(40f64.to_radians());
        for (a, b) in plain.iter().zip(&turned).skip(1) {
            let (x, y) = (6.0 - a.to.x, a.to.y);
            let (x, y) = (1.0 + 1.5 * (x - 1.0), 2.0 + 1.5 * (y - 2.0));
            let (x, y) = (4.0 + (x - 4.0) * cos - (y - 5.0) * sin, 5.0 + (x - 4.0) * sin + (y - 5.0) * cos);
            assert!((b.to.x - x).abs() < 1e-6 && (b.to.y - y).abs() < 1e-6, "{text}");
            assert!((b.length() - 1.5 * a.length()).abs() < 1e-6, "{text}");
        }
    }
}

/// Points of G12.1: radius and angle follow the line and the circle, and the time is that of F on the surface.
#[test]
fn polar_interpolation() {
    let text = "G98 F100 G0 X40 C0\nG12.1\nG1 X40 C10\nX-40\nG3 X-40 C-10 R10\nG1 X40 C-10\nG13.1";
    let steps = steps("fanuc-turn", text);
    let (mut x, mut c, mut feed, mut minutes) = (20.0_f64, 0.0_f64, 100.0, 0.0);
    let mut last = [20.0, 0.0];
    for step in &steps {
        match &step.command {
            Canon::SetFeedRate(f) => feed = *f,
            Canon::StraightFeed(p) => {
                let linear = (p.x - x).abs();
                minutes += if linear > 0.0 { linear } else { (p.c - c).abs() } / feed;
                (x, c) = (p.x, p.c);
                let (sin, cos) = libm::sincos(c.to_radians());
                let here = [x * cos, x * sin];
                let on_line = (here[1] - 10.0).abs().min((here[1] + 10.0).abs()).min((here[0] - 20.0).abs());
                let on_arc = (((here[0] + 20.0).powi(2) + here[1].powi(2)).sqrt() - 10.0).abs();
                assert!(on_line.min(on_arc) < 0.003, "{here:?}");
                last = here;
            }
            _ => {}
        }
    }
    assert!((last[0] - 20.0).abs() < 1e-6 && (last[1] + 10.0).abs() < 1e-6, "{last:?}");
    let length = 10.0 + 40.0 + std::f64::consts::PI * 10.0 + 40.0;
    assert!((minutes * 100.0 - length).abs() < 0.02, "{minutes}");
}

/// Cylinder of radius 57.29578: a degree is a millimetre of its surface, so arcs are circles in (Z, C).
#[test]
fn cylindrical_interpolation() {
    let radius = 180.0 / std::f64::consts::PI;
    let text = format!("F100 G18 G0 Z0 C0\nG7.1 C{radius:.9}\nG1 Z10\nG3 Z0 C10 R10\nG7.1 C0\nG0 C0");
    let arc: Vec<Position> = steps("fanuc-mill", &text)
        .iter()
        .filter(|s| s.line == 4)
        .filter_map(|s| if let Canon::StraightFeed(p) = s.command { Some(p) } else { None })
        .collect();
    assert!(arc.len() > 10);
    assert!(arc.iter().all(|p| ((p.z * p.z + p.c * p.c).sqrt() - 10.0).abs() < 1e-6));
    assert!(arc.last().is_some_and(|p| p.z.abs() < 1e-9 && (p.c - 10.0).abs() < 1e-9));
}

/// A quarter circle as a rational curve of order 3: every point lies on the circle.
#[test]
fn nurbs() {
    let w = 0.5f64.sqrt();
    let text = format!("F100 G0 X10 Y0\nG6.2 P3 K0 X10 Y0 R1\nK0 X10 Y10 R{w:.12}\nK0 X0 Y10 R1\nK1\nK1\nK1\nG1 X-5");
    let found = mill(&text);
    let curve = &found[1..found.len() - 1];
    assert!(curve.len() > 5 && curve.iter().all(|p| ((p[0] * p[0] + p[1] * p[1]).sqrt() - 10.0).abs() < 1e-5), "{curve:?}");
    assert_eq!(curve.last(), Some(&[0.0, 10.0, 0.0]));
}

/// Holes on a circle: increments of the angle, K times.
#[test]
fn holes_in_polar_coordinates() {
    let found = mill("F9 G16 G81 X10 Y0 Z-1 R0\nG91 Y90 K3\nG15 G80");
    let bottoms: Vec<[f64; 2]> = found.iter().filter(|p| p[2] == -1.0).map(|p| [p[0], p[1]]).collect();
    assert_eq!(bottoms, [[10.0, 0.0], [0.0, 10.0], [-10.0, 0.0], [0.0, -10.0]]);
}

/// Chamfers and roundings: ends by geometry.
#[test]
fn corners() {
    assert_eq!(mill("F9 G1 X10 ,C2\nY10"), [[8.0, 0.0, 0.0], [10.0, 2.0, 0.0], [10.0, 10.0, 0.0]]);
    assert_eq!(mill("F9 G1 X10 ,R2\nX0 Y10"), [[5.171573, 0.0, 0.0], [6.585786, 3.414214, 0.0], [0.0, 10.0, 0.0]]);
    // Into an arc: the rounding touches both.
    let found = mill("F9 G1 X10 ,R1\nG2 X20 Y10 R10");
    assert_eq!(found.len(), 3);
    // Of turning without a comma; X is a diameter.
    assert_eq!(
        turn("G98 F9 G0 X20 Z0\nG1 Z-10 R2\nX40"),
        [[10.0, 0.0, 0.0], [10.0, 0.0, -8.0], [12.0, 0.0, -10.0], [20.0, 0.0, -10.0]]
    );
    assert_eq!(
        turn("G98 F9 G0 X20 Z0\nG1 Z-10 C1\nX40"),
        [[10.0, 0.0, 0.0], [10.0, 0.0, -9.0], [11.0, 0.0, -10.0], [20.0, 0.0, -10.0]]
    );
    // The feed of a block is that of its own move.
    let feeds: Vec<f64> = steps("fanuc-mill", "F9 G1 X10 ,C2\nY10 F5")
        .iter()
        .filter_map(|s| if let Canon::SetFeedRate(f) = s.command { Some(f) } else { None })
        .collect();
    assert_eq!(feeds, [9.0, 5.0, 9.0, 5.0]);
}

/// No pass of G71 cuts into the contour with its allowance, passes are the depth apart, and all material down to the last level goes.
#[test]
fn roughing_stays_outside_of_the_contour() {
    let mut random = Random(5);
    for _ in 0..100 {
        let (mut z, mut x) = (0.0, 5.0);
        let mut text = String::from("N1 G0 X10\n");
        let mut contour = vec![[0.0, 5.0]];
        for _ in 0..6 {
            z -= 2.0 + random.eighths(0, 5).abs();
            x += random.eighths(0, 4).abs();
            contour.push([z, x]);
            let _ = writeln!(text, "G1 X{} Z{z}", 2.0 * x);
        }
        text = text.replacen("N1 G0 X10\n", "N1 G0 X10\nG1 Z0\n", 1);
        let program = format!("G98 F100 G0 X70 Z2\nG71 U1.5 R0.5\nG71 P1 Q9 U0.4 W0.1\n{text}N9 X70\nM30");
        let found = steps("fanuc-turn", &program);
        let cuts = found
            .iter()
            .filter(|s| s.line == 3)
            .filter_map(|s| if let Canon::StraightFeed(p) = s.command { Some(p) } else { None });
        for p in cuts {
            // The contour below the tool, with its allowance.
            let height = contour.windows(2).filter(|w| w[0][0] >= p.z - 0.1 && p.z - 0.1 >= w[1][0]).map(|w| {
                let t = (p.z - 0.1 - w[0][0]) / (w[1][0] - w[0][0]);
                w[0][1] + (w[1][1] - w[0][1]) * t + 0.2
            });
            let height = height.fold(0.0, f64::max);
            assert!(p.x > height - 1e-6, "{p:?} {height}\n{program}");
        }
    }
}

/// Inches and millimetres give the same path, for cycles too.
#[test]
fn inches_and_millimetres() {
    let text = |u: f64| {
        let n = |v: f64| format!("{:.9}", v * u);
        format!(
            "F{} G0 Z{}\nG81 X{} Y{} Z{} R{}\nX{}\nG80\nG68 X{} Y0 R30\nG1 X{} Y{}\nG2 X{} R{}",
            n(100.0),
            n(5.0),
            n(1.0),
            n(2.0),
            n(-4.0),
            n(1.0),
            n(9.0),
            n(3.0),
            n(4.0),
            n(6.0),
            n(8.0),
            n(50.0)
        )
    };
    let (mm, inch) = (mill(&format!("G21\n{}", text(1.0))), mill(&format!("G20\n{}", text(1.0 / 25.4))));
    assert_eq!(mm.len(), inch.len());
    for (a, b) in mm.iter().zip(&inch) {
        assert!(a.iter().zip(b).all(|(p, q)| (p - q).abs() < 1e-5), "{a:?} {b:?}");
    }
}

/// Alarms, wrong calls, endless programs end with their message.
#[test]
fn wild_programs_end_with_a_message() {
    for (dialect, text, want) in [
        ("fanuc-mill", "WHILE[1 EQ 1]DO1\n#1=1\nEND1", Code::EndlessProgram),
        ("fanuc-mill", "DO1\nEND1", Code::EndlessProgram),
        ("fanuc-mill", "G65 P1\nM30\nO1\nG65 P1\nM99", Code::NestedTooDeeply),
        ("fanuc-mill", "G66 P1\nG0 X1\nM30\nO1\nG66 P1\nG0 X2\nG65 P1\nM99", Code::NestedTooDeeply),
        ("fanuc-mill", "F9 G83 X1 Z-50 R0 Q.0001", Code::MissingWord),
        ("fanuc-mill", "F9 G81 X1 Z-5 R1 K100000", Code::BadValue),
        ("fanuc-turn", "G98 F9 G0 X50 Z2\nG71 U.0001 R1\nG71 P1 Q3\nN1 G0 X10\nG1 Z-9\nN3 X50", Code::BadContour),
        ("fanuc-turn", "G98 F9 G74 Z-200 Q1", Code::BadValue),
        ("fanuc-turn", "G98 F9 G71 P1 Q2\nN1 G71 P1 Q2\nN2 X1", Code::BadContour),
        ("fanuc-mill", "G51 X0 P0", Code::BadValue),
    ] {
        let options = options(dialect, &[]);
        let error = Interpreter::new(SourceId(0), text, options).find_map(Result::err);
        assert_eq!(error.map(|d| d.code), Some(want), "{text}");
    }
}

/// M99 in the main program starts it anew; a check reads it once.
#[test]
fn m99_repeats_the_program() {
    let text = "O1\nG91 G0 X1\nM99";
    let moves = Interpreter::new(SourceId(0), text, options("fanuc-mill", &[]))
        .take(300)
        .filter(|s| matches!(s.as_ref().map(|s| &s.command), Ok(Canon::StraightTraverse(_))));
    assert!(moves.count() > 290);
    assert!(check(SourceId(0), text, options("fanuc-mill", &[])).iter().all(|d| d.severity != Severity::Error));
}

/// Time is linear in the text, whatever it holds.
#[test]
fn long_texts() {
    let n = 100_000;
    for text in [
        "X1".repeat(n),
        "G8".repeat(n),
        "M8".repeat(n),
        "G0X1X".repeat(n),
        "%\n".repeat(n),
        "[".repeat(n),
        format!("#1={}1", "1+".repeat(n)),
        format!("#1=#1+1\n{}IF[#1 LT 300]GOTO 1", "N1\n".repeat(n)),
        format!("{}M98 P7\nM30\nO7\nM99", "O7\nM99\n".repeat(n)),
        format!("G0 X1\n{}G0 X2", "%\n".repeat(n)),
    ] {
        for lenient in [false, true] {
            let language = Language::new("fanuc-mill", lenient, &[]).unwrap();
            let steps = Interpreter::new(SourceId(0), text.as_str(), Options { language, ..Options::default() });
            assert!(steps.count() < n + 20);
        }
    }
}

/// A straight file of any length runs; a wrong block gives out nothing.
#[test]
fn long_and_wrong_programs() {
    let text: String = (1..=50_000).map(|n| format!("N{n}G1X{}F100\n", n % 7)).collect();
    assert_eq!(steps("fanuc-mill", &text).iter().filter(|s| matches!(s.command, Canon::StraightFeed(_))).count(), 50_000);
    let mut interpreter = Interpreter::new(SourceId(0), "G0 X1\nS100 M3 G0 X2 G99.9", options("fanuc-mill", &[]));
    let steps: Vec<Step> = interpreter.by_ref().map_while(Result::ok).collect();
    assert!(steps.iter().all(|s| s.line < 2));
    assert_eq!(Dialect::named("fanuc-turn"), Some(Dialect::FanucTurn));
}

/// The reader of a channel takes the dialect of its part program.
#[test]
fn a_channel_reads_its_dialect() {
    let (source, start, modes) = (SourceId(0), Position::default(), "G91".to_owned());
    let language = Language::new("fanuc-mill", false, &[]).unwrap();
    let program = PartProgram {
        source,
        text: "O1\n#1=5\nG0 X#1\nX#1\nM30".into(),
        start,
        modes,
        language,
        host: Default::default(),
        kept: Default::default(),
        skip_deleted: false,
        modal: None,
    };
    let steps: Vec<Step> = ngc_reader()(&program).map(|s| s.unwrap()).collect();
    assert_eq!(ends(&steps), [[5.0, 0.0, 0.0], [10.0, 0.0, 0.0]]);
}
