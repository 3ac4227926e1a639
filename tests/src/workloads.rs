//! Programs of a given size for the benches: a ladder of boolean rungs, floating-point loops, and plain text to compile.

use crate::rng::Rng;
use std::fmt::Write;

/// Inputs of the ladder.
const CONTACTS: usize = 32;

/// A rung: indices of its contacts among inputs and earlier coils, and which are negated.
#[derive(Clone, Copy)]
pub struct Rung {
    /// What is read: below 32 an input, else a coil.
    pub contacts: [usize; 4],
    /// Which of them are negated.
    pub negated: [bool; 4],
}

/// The same ladder every time.
pub fn rungs(count: usize) -> Vec<Rung> {
    let mut rng = Rng::new(1);
    let rung = |i: usize| Rung {
        contacts: std::array::from_fn(|_| rng.below(CONTACTS + i)),
        negated: std::array::from_fn(|_| rng.one_in(3)),
    };
    (0..count).map(rung).collect()
}

/// ST text of the ladder: each coil is (a AND b) OR (c AND d), the inputs change with every scan.
pub fn ladder(count: usize) -> String {
    let mut text = String::from("PROGRAM main\nVAR seed : DINT := 12345; count : DINT; END_VAR\nVAR\n");
    for i in 0..CONTACTS {
        let _ = writeln!(text, "i{i} : BOOL;");
    }
    for i in 0..count {
        let _ = writeln!(text, "c{i} : BOOL;");
    }
    text += "END_VAR\nseed := (seed * 75 + 74) MOD 65537;\n";
    for i in 0..CONTACTS {
        let _ = writeln!(text, "i{i} := (seed / {}) MOD 2 = 1;", i + 1);
    }
    for (i, rung) in rungs(count).iter().enumerate() {
        let contact = |k: usize| {
            let name = rung.contacts[k];
            let name = if name < CONTACTS { format!("i{name}") } else { format!("c{}", name - CONTACTS) };
            if rung.negated[k] { format!("NOT {name}") } else { name }
        };
        let _ = writeln!(text, "c{i} := ({} AND {}) OR ({} AND {});", contact(0), contact(1), contact(2), contact(3));
    }
    let _ = writeln!(text, "IF c{} THEN count := count + 1; END_IF;\nEND_PROGRAM", count - 1);
    text
}

/// The ladder as a table that a loop of Rust walks: what an interpreter of rungs costs at best.
pub struct RustLadder {
    seed: i32,
    bits: Vec<bool>,
    rungs: Vec<Rung>,
    /// Scans in which the last coil was on.
    pub count: i32,
}

impl RustLadder {
    /// With this many rungs.
    pub fn new(count: usize) -> Self {
        Self { seed: 12345, bits: vec![false; CONTACTS + count], rungs: rungs(count), count: 0 }
    }

    /// One scan.
    pub fn scan(&mut self) {
        self.seed = self.seed.wrapping_mul(75).wrapping_add(74).wrapping_rem(65537);
        for i in 0..CONTACTS {
            self.bits[i] = self.seed / (i as i32 + 1) % 2 == 1;
        }
        for (i, rung) in self.rungs.iter().enumerate() {
            let on = |k: usize| self.bits[rung.contacts[k]] != rung.negated[k];
            self.bits[CONTACTS + i] = (on(0) && on(1)) || (on(2) && on(3));
        }
        self.count += i32::from(self.bits[self.bits.len() - 1]);
    }
}

/// Points of a coarse Mandelbrot set: nested loops on LREAL.
pub const MANDELBROT: &str = "PROGRAM main
VAR px : DINT; py : DINT; it : DINT; count : DINT; cx : LREAL; cy : LREAL; x : LREAL; y : LREAL; x2 : LREAL; y2 : LREAL; t : LREAL; END_VAR
  count := 0;
  FOR py := 0 TO 23 DO
    cy := -1.2 + DINT_TO_LREAL(py) * 0.1;
    FOR px := 0 TO 31 DO
      cx := -2.1 + DINT_TO_LREAL(px) * 0.1;
      x := 0.0; y := 0.0; x2 := 0.0; y2 := 0.0; it := 0;
      WHILE (it < 60) AND (x2 + y2 <= 4.0) DO
        t := x2 - y2 + cx;
        y := 2.0 * x * y + cy;
        x := t;
        x2 := x * x;
        y2 := y * y;
        it := it + 1;
      END_WHILE;
      count := count + it;
    END_FOR;
  END_FOR;
END_PROGRAM
";

/// [`MANDELBROT`] written by hand in Rust.
pub fn rust_mandelbrot() -> i32 {
    let mut count = 0;
    for py in 0..24 {
        let cy = -1.2 + f64::from(py) * 0.1;
        for px in 0..32 {
            let cx = -2.1 + f64::from(px) * 0.1;
            let (mut x, mut y, mut x2, mut y2, mut it) = (0.0, 0.0, 0.0, 0.0, 0);
            while it < 60 && x2 + y2 <= 4.0 {
                let t = x2 - y2 + cx;
                y = 2.0 * x * y + cy;
                x = t;
                (x2, y2) = (x * x, y * y);
                it += 1;
            }
            count += it;
        }
    }
    count
}

/// About `lines` lines of ordinary ST in units of 100 lines, and a program that calls them.
pub fn lines(lines: usize) -> String {
    let units = lines.div_ceil(100);
    let mut text = String::new();
    for u in 0..units {
        let _ =
            writeln!(text, "FUNCTION_BLOCK Unit{u}\nVAR_INPUT run : BOOL; set : REAL; END_VAR\nVAR_OUTPUT out : REAL; END_VAR");
        text += "VAR sum : REAL; n : INT; a : ARRAY[0..9] OF INT; t : TON; END_VAR\n";
        for k in 0..23 {
            let _ = writeln!(text, "t(IN := run AND n > {k}, PT := T#{k}ms);\nIF t.Q THEN\n  sum := sum + (set - sum) * 0.{k};");
            let _ = writeln!(text, "  a[n MOD 10] := a[n MOD 10] + {k}; n := n + 1; END_IF;");
        }
        text += "out := sum;\nEND_FUNCTION_BLOCK\n";
    }
    text += "PROGRAM main\nVAR\n";
    for u in 0..units {
        let _ = writeln!(text, "u{u} : Unit{u};");
    }
    text += "END_VAR\n";
    for u in 0..units {
        let _ = writeln!(text, "u{u}(run := TRUE, set := 1.5);");
    }
    text + "END_PROGRAM\n"
}
