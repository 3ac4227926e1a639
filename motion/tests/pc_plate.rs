//! The 27-block program of the PC-based controller (PC-T1, PC-T3, PC-T4, PC-T5): parsed, measured, drawn.

use takt_base::{Code, Severity, SourceId};
use takt_motion::canon::{Canon, Position, Step};
use takt_motion::ngc::{Interpreter, Options, Style, check};
use takt_motion::stats::{Extent, Stats};
use takt_motion::toolpath::{Kind, Move, Tracker};
use takt_motion::{draw, print};

const PLATE: &str = include_str!("ngc/plate.ngc");

fn options(modes: &str) -> Options {
    Options::default().with_modes(SourceId(1), modes).unwrap()
}

fn steps(text: &str) -> Vec<Step> {
    Interpreter::new(SourceId(0), text, options("G17 G21 G91 G91.1")).map(Result::unwrap).collect()
}

fn moves(steps: &[Step]) -> Vec<(u32, Move)> {
    let mut tracker = Tracker::new(Position::default());
    steps.iter().filter_map(|s| tracker.follow(&s.command).map(|m| (s.block, m))).collect()
}

/// Twice the signed area between a move and the origin of coordinates; the segment of an arc included.
fn double_area(m: &Move) -> f64 {
    let chord = m.from.x * m.to.y - m.to.x * m.from.y;
    match m.kind {
        Kind::Arc { sweep, .. } => chord + sweep.radius * sweep.radius * (sweep.sweep - libm::sin(sweep.sweep)),
        _ => chord,
    }
}

fn near(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance
}

/// PC-T1
#[test]
fn contour_is_closed_and_has_the_figures_of_the_paper() {
    let steps = steps(PLATE);
    let stats = Stats::of(&steps, Position::default());
    assert!(near(stats.line_length_mm, 1032.0, 1e-9) && near(stats.arc_length_mm, 326.726, 5e-4), "{stats:?}");
    assert!(near(stats.feed_length_mm(), 1358.726, 5e-4) && near(stats.rapid_length_mm, 36.056, 5e-4));
    assert!(near(stats.ideal_time_s(), 1.3587, 5e-5));
    let extent = |e: Option<Extent>| e.map(|e| (e.min, e.max)).unwrap();
    let (min, max) = extent(stats.feed_extent);
    assert!(near(min[0], 20.0, 1e-9) && near(min[1], 30.0, 1e-9) && near(max[0], 236.0, 1e-9) && near(max[1], 234.0, 1e-9));
    let (min, max) = extent(stats.extent);
    assert!(min == [0.0; 3] && near(max[0], 236.0, 1e-9) && near(max[1], 234.0, 1e-9) && max[2] == 0.0);
    let contour: Vec<Move> = moves(&steps).into_iter().filter(|(block, _)| *block > 1).map(|(_, m)| m).collect();
    let corner = Position { x: 20.0, y: 30.0, ..Position::default() };
    assert_eq!((contour[0].from, contour[25].to), (corner, corner));
    let area = contour.iter().map(double_area).sum::<f64>() / 2.0;
    assert!(near(area, -34088.78, 5e-3), "clockwise is negative: {area}");
}

/// PC-T3
#[test]
fn twenty_seven_blocks() {
    let steps = steps(PLATE);
    let stats = Stats::of(&steps, Position::default());
    assert_eq!((stats.blocks, stats.rapids, stats.lines, stats.arcs), (27, 1, 16, 10));
    let count = |f: fn(i32) -> bool| steps.iter().filter(|s| matches!(s.command, Canon::ArcFeed(a) if f(a.rotation))).count();
    assert_eq!((count(|r| r < 0), count(|r| r > 0)), (2, 8));
    for step in steps.iter().filter(|s| s.block > 0 && s.n.is_some()) {
        assert_eq!((step.n, step.line), (Some(step.block), step.block));
    }
}

/// PC-T4
#[test]
fn radii_at_start_and_end_are_the_same() {
    for (block, m) in moves(&steps(PLATE)) {
        if let Kind::Arc { sweep, .. } = m.kind {
            let want = if block == 8 || block == 15 { 40.0 } else { 16.0 };
            assert_eq!((sweep.radius, sweep.end_radius), (want, want), "N{block}");
        }
    }
}

/// PC-T5
#[test]
fn absolute_coordinates_are_refused_at_n4() {
    let diags = check(SourceId(0), PLATE, options("G17 G21 G90 G91.1"));
    let first = diags.iter().find(|d| d.severity == Severity::Error).unwrap();
    assert_eq!(first.code, Code::RadiusMismatch);
    assert!(PLATE[first.span.start as usize..].starts_with("N4"), "{first:?}");
    assert!(first.message.contains("16.0000") && first.message.contains("36.0000"), "{}", first.message);
    let mut interpreter = Interpreter::new(SourceId(0), PLATE, options("G90"));
    let given: Vec<_> = interpreter.by_ref().take_while(Result::is_ok).map(Result::unwrap).collect();
    assert_eq!(given.last().map(|s| s.block), Some(3));
    assert!(interpreter.next().is_none());
}

/// PC-05, R1-33: the same program with its blocks in one line, with blanks, and as RS274/NGC.
#[test]
fn block_styles_agree() {
    let commands = |text: &str, style| {
        let options = Options { style, ..options("G91") };
        Interpreter::new(SourceId(0), text, options).map(|s| s.unwrap().command).collect::<Vec<_>>()
    };
    let want = commands(PLATE, Style::Auto);
    assert_eq!(commands(PLATE, Style::Ngc), want);
    assert_eq!(commands(PLATE, Style::Semicolon), want);
    let one_line = PLATE.replace('\n', "");
    assert_eq!(commands(&one_line, Style::Auto), want);
    assert_eq!(commands(&one_line, Style::Ngc).len(), 5 + 2, "the rest of the line is a comment");
    assert_eq!(commands(&PLATE.replace(';', "").replace('X', " x "), Style::Auto), want);
}

/// CM-T16: the listing reads back to the same commands (all numbers of this program have 4 decimals, but for arc ends).
#[test]
fn listing_reads_back() {
    for step in steps(PLATE) {
        let line = print::line(&step, true);
        let back = print::parse(&line).unwrap();
        assert_eq!(back.number, Some(step.line));
        assert_eq!(print::command(&back.command), print::command(&step.command));
    }
}

#[test]
fn picture_shows_one_traverse_and_one_contour() {
    let svg = draw::draw(&steps(PLATE), "Plate, 27 blocks").to_svg();
    assert_eq!(svg.matches("<polyline").count(), 2);
    for text in ["Plate, 27 blocks", ">traverse<", ">feed<", ">X [mm]<", ">Y [mm]<", ">200<"] {
        assert!(svg.contains(text), "{text}");
    }
}
