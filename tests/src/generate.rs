//! Random well-typed ST programs, for comparing native code with the interpreter and for stressing the compiler.
//!
//! Programs end: every loop has a bound. Some fault (division by zero, index, range): then both engines must fault alike. Names of
//! variables are lower case and literals upper case, so that a text without a lower-case letter is a constant expression: those must
//! not overflow, and the generator keeps them away from operators that can.

mod expr;
mod literal;
mod numbers;
mod object;
mod place;
mod statement;
mod text;
mod unit;

use crate::rng::Rng;
use std::fmt::Write;
use takt_image::Elementary as E;

/// Types of generated scalars.
const SCALARS: &[E] = &[
    E::Bool,
    E::Sint,
    E::Int,
    E::Dint,
    E::Lint,
    E::Usint,
    E::Uint,
    E::Udint,
    E::Ulint,
    E::Real,
    E::Lreal,
    E::Time,
    E::Byte,
    E::Word,
    E::Dword,
    E::Lword,
    E::Date,
    E::Tod,
    E::Dt,
    E::Ltime,
    E::Ltod,
    E::Ldate,
    E::Ldt,
    E::Char,
    E::Wchar,
];

/// Size of a generated program.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// Statements of the main program, before nesting.
    pub statements: usize,
    /// Scalar variables.
    pub scalars: usize,
    /// Functions and function blocks, each.
    pub units: usize,
}

impl Default for Shape {
    fn default() -> Self {
        Shape { statements: 12, scalars: 24, units: 2 }
    }
}

impl Shape {
    /// Of the program of a seed in a fuzz run: most are small, since many small programs find more in the same time than few large ones.
    fn of(seed: u64) -> Self {
        match seed % 8 {
            0 => Shape::default(),
            1 => Shape { statements: 24, scalars: 8, units: 0 },
            _ => Shape { statements: 3, scalars: 8, units: 1 },
        }
    }
}

/// The program of a seed in a fuzz run.
pub fn fuzzed(seed: u64) -> String {
    program(seed, Shape::of(seed))
}

/// The text of a program of this seed; the instance is called `main`.
pub fn program(seed: u64, shape: Shape) -> String {
    let mut g = Generator {
        random: Rng::new(seed),
        out: String::new(),
        vars: Vec::new(),
        functions: Vec::new(),
        blocks: Vec::new(),
        instances: Vec::new(),
        indent: 0,
        loops: 0,
        calls: true,
    };
    g.types();
    g.object_types();
    g.globals();
    for i in 0..shape.units {
        g.function(i);
    }
    for i in 0..shape.units {
        g.block(i);
        g.derived_block(i);
    }
    g.main(shape);
    g.out
}

/// Type of an expression.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Ty {
    E(E),
    /// STRING of any capacity.
    Text,
    /// WSTRING of any capacity.
    Wide,
    /// The enumeration.
    Mode,
    /// A structure of scalars.
    Point,
    /// A structure of everything.
    Cell,
    /// An array of three INT.
    Row,
}

/// Something that can be read, and written if `writable`.
#[derive(Clone, Debug)]
struct Var {
    /// Text with places for subscripts, `a[@1..3@]`.
    text: String,
    ty: Ty,
    /// Type as declared: a variable that is lent must have the very type.
    declared: String,
    writable: bool,
    /// No bit or part of something: can be lent.
    whole: bool,
}

/// A function or function block.
#[derive(Clone, Debug)]
struct Callable {
    name: String,
    inputs: Vec<Var>,
    outputs: Vec<Var>,
    lent: Vec<Var>,
    result: Ty,
}

/// True if nothing in the text is a variable.
fn is_constant(text: &str) -> bool {
    !text.bytes().any(|b| b.is_ascii_lowercase())
}

struct Generator {
    random: Rng,
    out: String,
    vars: Vec<Var>,
    functions: Vec<Callable>,
    blocks: Vec<Callable>,
    /// Instances of this unit: text with places for subscripts, index of the block.
    instances: Vec<(String, usize)>,
    indent: usize,
    loops: usize,
    /// Functions may be called: not in their own bodies, which would not end.
    calls: bool,
}

impl Generator {
    fn line(&mut self, text: impl AsRef<str>) {
        let _ = writeln!(self.out, "{:1$}{2}", "", self.indent * 2, text.as_ref());
    }

    fn types(&mut self) {
        self.line("TYPE");
        self.line("  Point : STRUCT x : DINT := 3; y : REAL; flag : BOOL := TRUE; END_STRUCT;");
        self.line("  Mode : (idle, slow, fast) := slow;");
        self.line("  Pct : INT (0..100) := 50;");
        self.line("  Row : ARRAY[1..3] OF INT := [1, 2(7)];");
        self.line(
            "  Cell : STRUCT pt : Point := (y := 1.5); row : Row; name : STRING[6] := 'CELL'; m : Mode; w : WORD; n : Pct := 7;",
        );
        self.line("    d : ARRAY[0..1, -1..1] OF LREAL; END_STRUCT;");
        self.line("END_TYPE");
        self.line("FUNCTION OpenSum : DINT VAR_INPUT a : ARRAY [*] OF INT; END_VAR VAR i : DINT; END_VAR");
        self.line("  FOR i := LOWER_BOUND(a, 1) TO UPPER_BOUND(a, 1) DO OpenSum := OpenSum * DINT#3 + a[i]; END_FOR;");
        self.line("END_FUNCTION");
    }

    fn globals(&mut self) {
        self.line("VAR_GLOBAL CONSTANT KI : INT := 7; KR : REAL := 2.5; KW : WORD := 16#8001; END_VAR");
        self.line("VAR_GLOBAL gi : INT := 5; gr : LREAL := 0.25; gp : Point; gdur : TIME := T#5MS; END_VAR");
        self.line("VAR_GLOBAL gw AT %MW20 : WORD; gb AT %MX3.2 : BOOL; END_VAR");
    }

    fn one_in(&mut self, n: usize) -> bool {
        self.random.one_in(n)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_gives_one_program() {
        assert_eq!(program(7, Shape::default()), program(7, Shape::default()));
        assert_ne!(program(7, Shape::default()), program(8, Shape::default()));
    }
}
