//! The programs that are measured. All have the same text on every machine.

use std::f64::consts::{FRAC_PI_2, TAU};
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

/// A part program and how many rows of it are executed.
pub struct Program {
    pub text: String,
    pub rows: usize,
}

const HEAD: &str = "G21 G17 G90 G40 G80 G64 F3000\n";

/// All programs of the bench: name, rows or turns, and who writes it.
pub const ALL: [(&str, usize, fn(usize) -> Program); 6] = [
    ("lines", 1_000_000, lines),
    ("arcs", 200_000, arcs),
    ("macro-loops", 100_000, macros),
    ("macro-calls", 200_000, calls),
    ("drilling", 100_000, drilling),
    ("compensation", 200_000, compensated),
];

/// Short lines of a curve, as CAM systems write them.
fn lines(rows: usize) -> Program {
    let mut text = String::from(HEAD);
    for i in 0..rows {
        let a = i as f64 * 0.01;
        let _ = writeln!(text, "G1 X{:.4} Y{:.4}", 50.0 * cosine(a), 50.0 * cosine(a + FRAC_PI_2));
    }
    Program { text: text + "M2\n", rows }
}

/// A program that is written without being held: its lines.
pub fn write_large(path: &Path, rows: usize) -> std::io::Result<usize> {
    let mut file = std::io::BufWriter::new(std::fs::File::create(path)?);
    file.write_all(HEAD.as_bytes())?;
    for i in 0..rows - 2 {
        writeln!(file, "G1 X{}.{:04} Y{}.{:04}", i % 100, i % 9973, i % 77, i % 9967)?;
    }
    file.write_all(b"M2\n")?;
    file.flush()?;
    Ok(rows)
}

/// Arcs with their centres, forth and back with changing radii, some of them helices.
fn arcs(rows: usize) -> Program {
    let mut text = String::from(HEAD);
    for i in 0..rows {
        let (radius, z) = (2.0 + (i / 2 % 100) as f64 * 0.25, (i / 2 % 10) as f64 * 0.1);
        let (code, x, centre) = if i % 2 == 0 { ("G2", 2.0 * radius, radius) } else { ("G3", 0.0, -radius) };
        let _ = writeln!(text, "{code} X{x:.4} Y0.0000 Z{z:.4} I{centre:.4} J0.0000");
    }
    Program { text: text + "M2\n", rows }
}

/// Loops with expressions: 5 rows a turn.
fn macros(turns: usize) -> Program {
    let body = "#<x> = [#<n> * 0.001 + SIN[#<n>]]\nG1 X[#<x>] Y[#<x> * COS[#<n> / 10] + SQRT[#<n>]]\n#<n> = [#<n> + 1]\n";
    let text = format!("{HEAD}#<n> = 0\no1 while [#<n> LT {turns}]\n{body}o1 endwhile\nM2\n");
    Program { text, rows: 5 * turns }
}

/// A loop that calls a subroutine with arguments, in which a branch is taken each other time: 9 and 10 rows a turn.
fn calls(turns: usize) -> Program {
    let sub = "o100 sub\n#3 = [#1 * 2 + 1]\no101 if [#2 MOD 2 EQ 0]\nG1 X[#3 * 0.01] Y#1\no101 else\nG1 X[#1] Y[#3 * 0.02]\no101 endif\no100 endsub\n";
    let body = format!("o1 while [#10 LT {turns}]\no100 call [#10 / 100] [#10]\n#10 = [#10 + 1]\no1 endwhile\nM2\n");
    Program { text: format!("{HEAD}{sub}#10 = 0\n{body}"), rows: turns * 10 }
}

/// Holes in rows, with two cycles.
fn drilling(rows: usize) -> Program {
    let mut text = format!("{HEAD}G0 Z10\n");
    for i in 0..rows {
        let (x, y) = ((i % 100) as f64 * 1.25, (i / 100) as f64 * 1.5);
        let _ = match i % 1000 {
            0 => writeln!(text, "G99 G83 X{x:.4} Y{y:.4} Z-6 R2 Q3 F300"),
            500 => writeln!(text, "G81 X{x:.4} Y{y:.4} Z-1 R2"),
            _ => writeln!(text, "X{x:.4} Y{y:.4}"),
        };
    }
    Program { text: text + "G80\nM2\n", rows }
}

/// A star of lines and arcs with the cutter on its left: inside and outside corners.
fn compensated(rows: usize) -> Program {
    let mut text = format!("{HEAD}T1 M6\nG0 X-100 Y0\nG41 D1\nG1 X-60 Y-5\n");
    for i in 0..rows {
        let a = (i % 64) as f64 / 64.0 * TAU;
        let r = if i % 2 == 0 { 60.0 } else { 45.0 };
        let (x, y) = (-r * cosine(a), r * cosine(a + FRAC_PI_2));
        let _ = match i % 8 {
            3 => writeln!(text, "G2 X{x:.4} Y{y:.4} R20"),
            _ => writeln!(text, "G1 X{x:.4} Y{y:.4}"),
        };
    }
    Program { text: text + "G40\nG1 X-100 Y0\nM2\n", rows }
}

/// Cosine by its series: the same text on every machine.
fn cosine(a: f64) -> f64 {
    let x = a % TAU;
    (0..24).fold((1.0, 0.0), |(term, sum), k| (-term * x * x / f64::from((2 * k + 1) * (2 * k + 2)), sum + term)).1
}
