//! Every program of `corpus/` on the `gcode` module of LinuxCNC's Python package and on ours: the same geometry at 1e-9 inch.
//! The module gives inches and cuts a NURBS into lines: their ends must lie on our curve.
//! Tools are left out: the module reads them from the memory of a running LinuxCNC and crashes without; `rs274` compares those.
//! Skips itself, with a note, where the module (Debian: linuxcnc-uspace) is not installed.

mod common;

use common::oracle::{Folder, corpus, interpret};
use std::process::Command;
use takt_motion::canon::{Arc, Canon, Nurbs, Position, Units};

/// A call: its name and its numbers in inches and degrees.
#[derive(Clone, Debug, PartialEq)]
struct Call {
    name: String,
    values: Vec<f64>,
}

/// One of ours.
enum Ours {
    Call(Call),
    /// Control points in inches.
    Curve(Nurbs),
}

/// Python with the module; says so if there is none.
fn python() -> Option<&'static str> {
    let has = |p: &&str| Command::new(p).args(["-c", "import gcode"]).output().is_ok_and(|o| o.status.success());
    let found = ["python3", "/usr/bin/python3"].into_iter().find(has);
    if found.is_none() {
        println!("skipped: the gcode module of LinuxCNC is not installed");
    }
    found
}

/// Calls of the module for each program; `None` where it ended with an error.
fn theirs(python: &str, programs: &[String], folder: &Folder) -> Vec<Option<Vec<Call>>> {
    let name = |i: usize, ending: &str| folder.0.join(format!("{i:05}.{ending}"));
    for (i, program) in programs.iter().enumerate() {
        std::fs::write(name(i, "ngc"), program).unwrap();
    }
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/gcode_module.py");
    let output = Command::new(python).arg(script).arg(&folder.0).current_dir(&folder.0).env("HOME", &folder.0).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let calls = |i| {
        let text = std::fs::read_to_string(name(i, "calls")).ok()?;
        let rows = text.strip_suffix("end")?;
        Some(rows.lines().map(call).collect())
    };
    (0..programs.len()).map(calls).collect()
}

fn call(row: &str) -> Call {
    let (name, values) = row.split_once(' ').unwrap_or((row, ""));
    Call { name: name.to_owned(), values: values.split(' ').map(|v| v.parse().unwrap()).collect() }
}

/// Our commands in the module's form; `None` after an error.
fn ours(program: &str) -> Option<Vec<Ours>> {
    let (mut inch, mut calls) = (1.0, Vec::new());
    for step in interpret(program) {
        let command = step.ok()?.command;
        if let Canon::UseLengthUnits(units) = command {
            inch = match units {
                Units::Inches => 1.0,
                Units::Mm => 1.0 / 25.4,
                Units::Cm => 1.0 / 2.54,
            };
        }
        calls.extend(translated(command, inch));
    }
    Some(calls)
}

fn translated(command: Canon, inch: f64) -> Option<Ours> {
    let position = |p: Position| vec![p.x * inch, p.y * inch, p.z * inch, p.a, p.b, p.c];
    let (name, values) = match command {
        Canon::StraightTraverse(p) => ("straight_traverse", position(p)),
        Canon::StraightFeed(p) => ("straight_feed", position(p)),
        Canon::StraightProbe(p, _) => ("straight_probe", position(p)),
        Canon::RigidTap(p) => ("rigid_tap", position(p)[..3].to_vec()),
        Canon::ArcFeed(arc) => ("arc_feed", arc_values(&arc, inch)),
        Canon::SetFeedRate(f) => ("set_feed_rate", vec![f * inch]),
        Canon::Dwell(seconds) => ("dwell", vec![seconds]),
        Canon::SetG5xOffset(n, p) => ("set_g5x_offset", [vec![f64::from(n)], position(p)].concat()),
        Canon::SetG92Offset(p) => ("set_g92_offset", position(p)),
        Canon::SetXyRotation(degrees) => ("set_xy_rotation", vec![degrees]),
        Canon::NurbsFeed(mut nurbs) => {
            nurbs.points.iter_mut().for_each(|p| [p[0], p[1]] = [p[0] * inch, p[1] * inch]);
            return Some(Ours::Curve(nurbs));
        }
        _ => return None,
    };
    Some(Ours::Call(Call { name: name.to_owned(), values }))
}

fn arc_values(arc: &Arc, inch: f64) -> Vec<f64> {
    let ends = [arc.first_end, arc.second_end, arc.first_axis, arc.second_axis].map(|v| v * inch);
    [&ends[..], &[f64::from(arc.rotation), arc.axis_end_point * inch, arc.a, arc.b, arc.c]].concat()
}

fn same(theirs: &Call, ours: &Call) -> bool {
    // Behind ours the module has U V W, which no program of the corpus moves.
    let near = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-9 * a.abs().max(1.0);
    theirs.name == ours.name && theirs.values.len() >= ours.values.len() && theirs.values.iter().zip(&ours.values).all(near)
}

/// Lines that the module cuts a curve into, for each control point.
const LINES: usize = 15;

/// Basis function `i` of an order over uniform knots that are clamped at both ends (Cox, de Boor).
fn basis(i: usize, order: usize, u: f64, count: usize, degree: usize) -> f64 {
    let knot = |i: usize| i.saturating_sub(degree).min(count - degree) as f64;
    let last = (count - degree) as f64;
    if order == 1 {
        let inside = knot(i) <= u && u < knot(i + 1);
        return if inside || u == last && knot(i + 1) == last && knot(i) < last { 1.0 } else { 0.0 };
    }
    let part = |over: f64, under: f64, rest: f64| if under == 0.0 { 0.0 } else { over / under * rest };
    let (k, down) = (order - 1, basis(i, order - 1, u, count, degree));
    let up = basis(i + 1, order - 1, u, count, degree);
    part(u - knot(i), knot(i + k) - knot(i), down) + part(knot(i + order) - u, knot(i + order) - knot(i + 1), up)
}

/// Points of a curve at the parameters at which the module ends its lines.
fn points(nurbs: &Nurbs) -> Vec<[f64; 2]> {
    let (count, order) = (nurbs.points.len(), nurbs.order as usize);
    let lines = LINES * count;
    let point = |line: usize| {
        let u = (count - order + 1) as f64 * line as f64 / lines as f64;
        let mut sum = [0.0; 3];
        for (i, [x, y, weight]) in nurbs.points.iter().enumerate() {
            let share = basis(i, order, u, count, order - 1) * weight;
            sum = [sum[0] + share * x, sum[1] + share * y, sum[2] + share];
        }
        [sum[0] / sum[2], sum[1] / sum[2]]
    };
    (1..=lines).map(point).collect()
}

/// Programs on which the module does something else than LinuxCNC's machine and `rs274`.
const DIFFERS: [&str; 5] = [
    // The feed rate before the first F word is 1 there.
    "M70\nG55 G61 S100 F10\nM72\n",
    "o1 sub\nM73\nG20 G91 F5\no1 endsub\nG21 G90\no1 call\nG0 X1\n",
    // A probe ends at its target there, without the small way back that a preview with contact has.
    "F100 G38.2 X10\nG91 G0 X1\n",
    "F100 G38.2 X10 Y10 Z10\nG91 G0 X0\n",
    "F100 G20 G38.2 X10\nG91 G0 X0\nG21 G0 X0\n",
];

#[test]
fn corpus_gives_the_same_geometry() {
    let Some(python) = python() else { return };
    let programs: Vec<String> = corpus().into_iter().filter(|p| !DIFFERS.iter().any(|d| p.starts_with(d))).collect();
    let folder = Folder::new("module");
    let theirs = theirs(python, &programs, &folder);
    let (mut equal, mut curves, mut wrong) = (0, 0, Vec::new());
    for (program, theirs) in programs.iter().zip(theirs) {
        let (Some(theirs), Some(ours)) = (theirs, ours(program)) else { continue };
        curves += ours.iter().filter(|o| matches!(o, Ours::Curve(_))).count();
        match difference(&theirs, &ours) {
            None => equal += 1,
            Some(text) => wrong.push(format!("{program:?}\n   {text}")),
        }
    }
    println!("{equal} of {} programs, {curves} curves in them, give the geometry of the module", programs.len());
    assert!(wrong.is_empty(), "{} programs differ:\n{}", wrong.len(), wrong.join("\n"));
    assert!(equal > programs.len() / 2, "most programs end without an error: {equal}");
}

fn difference(theirs: &[Call], ours: &[Ours]) -> Option<String> {
    let mut rest = theirs;
    for call in ours {
        let expected = match call {
            Ours::Call(call) => vec![call.clone()],
            Ours::Curve(nurbs) => {
                let line = |[x, y]: [f64; 2]| Call { name: "straight_feed".to_owned(), values: vec![x, y] };
                points(nurbs).into_iter().map(line).collect()
            }
        };
        for ours in expected {
            match rest.split_first() {
                Some((theirs, more)) if same(theirs, &ours) => rest = more,
                found => return Some(format!("LinuxCNC {:?}\n   ours {ours:?}", found.map(|f| f.0))),
            }
        }
    }
    rest.first().map(|more| format!("LinuxCNC goes on with {more:?}"))
}
