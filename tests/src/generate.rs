//! Random well-typed ST programs, for comparing native code with the interpreter and for stressing the compiler.
//!
//! Programs end: every loop has a bound. They may fault (division by zero, index): then both engines must fault alike.

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

/// The text of a program of this seed; the instance is called `main`.
pub fn program(seed: u64, shape: Shape) -> String {
    let mut g = Generator {
        random: Rng::new(seed),
        out: String::new(),
        vars: Vec::new(),
        functions: Vec::new(),
        blocks: Vec::new(),
        indent: 0,
        loops: 0,
        counters: 0,
    };
    g.types();
    for i in 0..shape.units {
        g.function(i);
    }
    for i in 0..shape.units {
        g.block(i);
    }
    g.main(shape);
    g.out
}

/// Something that can be read, and written if `writable`.
#[derive(Clone)]
struct Var {
    text: String,
    ty: E,
    writable: bool,
}

struct Callable {
    name: String,
    inputs: Vec<(String, E)>,
    outputs: Vec<(String, E)>,
    result: E,
}

struct Generator {
    random: Rng,
    out: String,
    vars: Vec<Var>,
    functions: Vec<Callable>,
    blocks: Vec<Callable>,
    indent: usize,
    loops: usize,
    counters: usize,
}

impl Generator {
    fn line(&mut self, text: impl AsRef<str>) {
        let _ = writeln!(self.out, "{:1$}{2}", "", self.indent * 2, text.as_ref());
    }

    fn scalar(&mut self) -> E {
        self.random.pick(SCALARS)
    }

    fn types(&mut self) {
        self.line("TYPE");
        self.line("  Point : STRUCT x : DINT := 3; y : REAL; lit : BOOL := TRUE; END_STRUCT;");
        self.line("  Mode : (idle, slow, fast);");
        self.line("END_TYPE");
    }

    fn declare(&mut self, prefix: &str, count: usize, section: &str, writable: bool) -> Vec<(String, E)> {
        self.line(section);
        let mut made = Vec::new();
        for i in 0..count {
            let ty = self.scalar();
            let name = format!("{prefix}{i}");
            let init = if self.random.one_in(2) { format!(" := {}", self.literal(ty)) } else { String::new() };
            self.line(format!("  {name} : {}{init};", ty.name()));
            self.vars.push(Var { text: name.clone(), ty, writable });
            made.push((name, ty));
        }
        self.line("END_VAR");
        made
    }

    fn function(&mut self, i: usize) {
        let name = format!("Fun{i}");
        let result = self.scalar();
        self.vars.clear();
        self.line(format!("FUNCTION {name} : {}", result.name()));
        let inputs = self.declare("a", 3, "VAR_INPUT", false);
        let outputs = self.declare("o", 1, "VAR_OUTPUT", true);
        self.declare("l", 4, "VAR", true);
        self.counters();
        self.vars.push(Var { text: name.clone(), ty: result, writable: true });
        self.body(4);
        let value = self.expr(result, 2);
        self.line(format!("  {name} := {value};"));
        self.line("END_FUNCTION");
        self.functions.push(Callable { name, inputs, outputs, result });
    }

    fn block(&mut self, i: usize) {
        let name = format!("Blk{i}");
        self.vars.clear();
        self.line(format!("FUNCTION_BLOCK {name}"));
        let inputs = self.declare("a", 3, "VAR_INPUT", false);
        let outputs = self.declare("o", 2, "VAR_OUTPUT", true);
        self.declare("l", 3, "VAR", true);
        self.counters();
        self.body(4);
        self.line("END_FUNCTION_BLOCK");
        self.blocks.push(Callable { name, inputs, outputs, result: E::Bool });
    }

    fn main(&mut self, shape: Shape) {
        self.vars.clear();
        self.line("PROGRAM main");
        self.declare("v", shape.scalars, "VAR", true);
        self.counters();
        self.line("VAR");
        self.line("  arr : ARRAY[-2..5] OF INT := [1, 2, 3, 2(4), 5];");
        self.line("  grid : ARRAY[0..2, 1..3] OF REAL;");
        self.line("  p : Point := (x := 7);");
        self.line("  ps : ARRAY[0..2] OF Point;");
        self.line("  mode : Mode := slow;");
        self.line("  s : STRING[12] := 'abc';");
        self.line("  t : STRING[5];");
        self.line("  pct : INT;");
        for i in 0..self.blocks.len() {
            self.line(format!("  b{i} : Blk{i};"));
        }
        self.line("END_VAR");
        self.compound_places();
        self.body(shape.statements);
        self.line("END_PROGRAM");
    }

    /// Loop counters, never assigned by other statements, and a variable of every type, so that no expression needs a literal: the
    /// checker refuses constant expressions that overflow.
    fn counters(&mut self) {
        self.line("VAR");
        for &ty in SCALARS {
            let name = format!("k_{}", ty.name().to_lowercase());
            let init = self.literal(ty);
            self.line(format!("  {name} : {} := {init};", ty.name()));
            self.vars.push(Var { text: name, ty, writable: true });
        }
        self.line("  c0 : DINT; c1 : INT; c2 : USINT; w0 : INT; w1 : INT; w2 : INT;");
        self.line("END_VAR");
        self.counters = 0;
    }

    fn compound_places(&mut self) {
        let mut add = |text: &str, ty| self.vars.push(Var { text: text.into(), ty, writable: true });
        add("arr[-2]", E::Int);
        add("arr[5]", E::Int);
        add("grid[1, 2]", E::Real);
        add("p.x", E::Dint);
        add("p.y", E::Real);
        add("p.lit", E::Bool);
        add("ps[1].x", E::Dint);
        add("ps[2].lit", E::Bool);
        add("pct", E::Int);
        for (i, block) in self.blocks.iter().enumerate() {
            for (name, ty) in &block.outputs {
                self.vars.push(Var { text: format!("b{i}.{name}"), ty: *ty, writable: false });
            }
        }
    }

    fn body(&mut self, statements: usize) {
        self.indent += 1;
        for _ in 0..statements {
            self.statement(2);
        }
        self.indent -= 1;
    }

    fn in_main(&self) -> bool {
        self.vars.iter().any(|v| v.text == "p.x")
    }

    fn statement(&mut self, depth: usize) {
        match self.random.below(if depth == 0 { 3 } else { 14 }) {
            0..=3 => self.assign(),
            4 => self.if_statement(depth),
            5 => self.case_statement(depth),
            6 => self.for_statement(depth),
            7 => self.while_statement(depth),
            8 => self.repeat_statement(depth),
            9 if self.loops > 0 => {
                let condition = self.expr(E::Bool, 1);
                let word = if self.random.one_in(2) { "EXIT" } else { "CONTINUE" };
                self.line(format!("IF {condition} THEN {word}; END_IF;"));
            }
            10 if self.in_main() && !self.blocks.is_empty() => self.call_block(),
            11 if self.in_main() => self.main_only(),
            12 if self.in_main() => self.call_with_output(),
            _ => self.assign(),
        }
    }

    fn assign(&mut self) {
        let places: Vec<Var> = self.vars.iter().filter(|v| v.writable).cloned().collect();
        let place = places[self.random.below(places.len())].clone();
        let value = if self.random.one_in(8) { self.literal(place.ty) } else { self.expr(place.ty, 3) };
        self.line(format!("{} := {value};", place.text));
    }

    fn nested(&mut self, depth: usize) {
        self.indent += 1;
        for _ in 0..1 + self.random.below(3) {
            self.statement(depth - 1);
        }
        self.indent -= 1;
    }

    fn if_statement(&mut self, depth: usize) {
        let condition = self.expr(E::Bool, 3);
        self.line(format!("IF {condition} THEN"));
        self.nested(depth);
        if self.random.one_in(2) {
            let condition = self.expr(E::Bool, 2);
            self.line(format!("ELSIF {condition} THEN"));
            self.nested(depth);
        }
        if self.random.one_in(2) {
            self.line("ELSE");
            self.nested(depth);
        }
        self.line("END_IF;");
    }

    fn case_statement(&mut self, depth: usize) {
        let selector = self.expr(E::Int, 2);
        self.line(format!("CASE {selector} OF"));
        for label in ["-5..0:", "1, 3:", "2:", "10..100, 200:"] {
            self.line(label);
            self.nested(depth);
        }
        if self.random.one_in(2) {
            self.line("ELSE");
            self.nested(depth);
        }
        self.line("END_CASE;");
    }

    /// Loops nest at most three deep, each level with a counter of its own.
    fn for_statement(&mut self, depth: usize) {
        if self.loops == 3 {
            return self.assign();
        }
        let counter = format!("c{}", self.loops);
        let range = self.random.pick(&["1 TO 4", "4 TO 1 BY -2", "250 TO 255", "0 TO 6 BY 3", "5 TO 1"]);
        let range = if self.loops == 2 { "250 TO 255" } else { range };
        self.line(format!("FOR {counter} := {range} DO"));
        self.loops += 1;
        self.nested(depth);
        self.loops -= 1;
        self.line("END_FOR;");
    }

    fn while_statement(&mut self, depth: usize) {
        if self.loops == 3 {
            return self.assign();
        }
        let counter = format!("w{}", self.loops);
        let condition = self.expr(E::Bool, 2);
        self.line(format!("{counter} := 0;"));
        self.line(format!("WHILE {counter} < 4 AND ({condition}) DO"));
        self.line(format!("  {counter} := {counter} + 1;"));
        self.loops += 1;
        self.nested(depth);
        self.loops -= 1;
        self.line("END_WHILE;");
    }

    fn repeat_statement(&mut self, depth: usize) {
        if self.loops == 3 {
            return self.assign();
        }
        let counter = format!("w{}", self.loops);
        self.line(format!("{counter} := 0;"));
        self.line("REPEAT");
        self.line(format!("  {counter} := {counter} + 1;"));
        self.loops += 1;
        self.nested(depth);
        self.loops -= 1;
        let condition = self.expr(E::Bool, 2);
        self.line(format!("UNTIL {counter} >= 3 OR {condition} END_REPEAT;"));
    }

    fn call_block(&mut self) {
        let i = self.random.below(self.blocks.len());
        let inputs = self.blocks[i].inputs.clone();
        let mut args = Vec::new();
        for (name, ty) in inputs {
            if !self.random.one_in(3) {
                args.push(format!("{name} := {}", self.expr(ty, 2)));
            }
        }
        let (output, ty) = self.blocks[i].outputs[0].clone();
        let targets: Vec<Var> = self.vars.iter().filter(|v| v.ty == ty && v.writable).cloned().collect();
        if !targets.is_empty() && self.random.one_in(2) {
            args.push(format!("{output} => {}", targets[self.random.below(targets.len())].text));
        }
        self.line(format!("b{i}({});", args.join(", ")));
    }

    fn call_with_output(&mut self) {
        if self.functions.is_empty() {
            return self.assign();
        }
        let i = self.random.below(self.functions.len());
        let (inputs, (output, ty)) = (self.functions[i].inputs.clone(), self.functions[i].outputs[0].clone());
        let (name, result) = (self.functions[i].name.clone(), self.functions[i].result);
        let find = |vars: &[Var], ty| vars.iter().find(|v| v.ty == ty && v.writable).map(|v| v.text.clone());
        let (Some(target), Some(to)) = (find(&self.vars, ty), find(&self.vars, result)) else { return self.assign() };
        let mut args: Vec<String> = Vec::new();
        for (name, ty) in inputs {
            args.push(format!("{name} := {}", self.expr(ty, 2)));
        }
        self.line(format!("{to} := {name}({}, {output} => {target});", args.join(", ")));
    }

    /// Statements on arrays, structures, enumerations and strings of the main program.
    fn main_only(&mut self) {
        let int = self.expr(E::Int, 2);
        let index = match self.random.below(16) {
            0..8 => format!("ABS(({int}) MOD 6) - 1"),
            8..15 => format!("LIMIT(-2, {int}, 5)"),
            _ => format!("({int}) MOD 9"),
        };
        let real = self.expr(E::Real, 2);
        match self.random.below(12) {
            0 | 1 => self.line(format!("arr[{index}] := {int};")),
            2 => self.line(format!("grid[ABS(({int}) MOD 3), 1 + ABS({int}) MOD 3] := {real};")),
            3 => self.line("p := ps[1];"),
            4 => self.line(format!("ps[ABS(({int}) MOD 3)] := p;")),
            5 => self.line("IF mode = slow THEN mode := fast; ELSE mode := idle; END_IF;"),
            6 => self.line("s := CONCAT(s, 'x', t);"),
            7 => self.line(format!("t := MID(s, 3, ABS({int}) MOD 4 + 1);")),
            8 => self.line("IF s < t OR s = 'abcx' THEN s := 'abc'; END_IF;"),
            9 => self.line(format!("pct := LEN(s) + arr[ABS(({int}) MOD 6)];")),
            10 => self.line("CASE mode OF idle: pct := pct + 1; slow, fast: p.lit := NOT p.lit; END_CASE;"),
            _ => self.line(format!("s := INT_TO_STRING({int});")),
        }
    }

    fn literal(&mut self, ty: E) -> String {
        let small = self.random.below(20) as i64;
        match ty {
            E::Bool => if self.random.one_in(2) { "TRUE" } else { "FALSE" }.into(),
            E::Real | E::Lreal => {
                let value = self.random.pick(&["0.0", "1.5", "-2.25", "1.0E10", "-3.5E-3", "1000000.5", "0.1"]);
                if let Some(rest) = value.strip_prefix('-') {
                    format!("{}#-{rest}", ty.name())
                } else {
                    format!("{}#{value}", ty.name())
                }
            }
            E::Time => format!("T#{small}ms"),
            _ if ty.is_bit() => format!("{}#16#{:X}", ty.name(), self.random.bits() >> (64 - ty.bits())),
            _ => self.int_literal(ty, small),
        }
    }

    fn int_literal(&mut self, ty: E, small: i64) -> String {
        let (low, high) = ty.int_range().unwrap_or((0, 1));
        let value = match self.random.below(6) {
            0 => low,
            1 => high,
            2 => (self.random.bits() as i128).rem_euclid(high - low + 1) + low,
            3 if low < 0 => -(small as i128),
            _ => small as i128,
        };
        format!("{}#{value}", ty.name())
    }

    fn expr(&mut self, ty: E, depth: usize) -> String {
        let readable: Vec<String> = self.vars.iter().filter(|v| v.ty == ty).map(|v| v.text.clone()).collect();
        if depth == 0 || self.random.one_in(4) {
            return readable[self.random.below(readable.len())].clone();
        }
        if self.random.one_in(8)
            && self.in_main()
            && let Some(call) = self.call_function(ty, depth)
        {
            return call;
        }
        if self.random.one_in(7) {
            let (a, b, g) = (self.expr(ty, depth - 1), self.expr(ty, depth - 1), self.expr(E::Bool, depth - 1));
            return match self.random.below(3) {
                0 => format!("SEL({g}, {a}, {b})"),
                1 => format!("MAX({a}, {b})"),
                _ => format!("MIN({a}, {b})"),
            };
        }
        match ty {
            E::Bool => self.bool_expr(depth),
            _ if ty.is_bit() => self.bit_expr(ty, depth),
            E::Real | E::Lreal => self.real_expr(ty, depth),
            E::Time => self.time_expr(depth),
            _ => self.int_expr(ty, depth),
        }
    }

    fn call_function(&mut self, ty: E, depth: usize) -> Option<String> {
        let i = self.functions.iter().position(|f| f.result == ty)?;
        let (name, inputs) = (self.functions[i].name.clone(), self.functions[i].inputs.clone());
        let args: Vec<String> = inputs.into_iter().map(|(n, t)| format!("{n} := {}", self.expr(t, depth - 1))).collect();
        Some(format!("{name}({})", args.join(", ")))
    }

    fn bool_expr(&mut self, depth: usize) -> String {
        if self.random.one_in(2) {
            let ty = self.scalar();
            let (a, b) = (self.expr(ty, depth - 1), self.expr(ty, depth - 1));
            let op = self.random.pick(&["=", "<>", "<", ">", "<=", ">="]);
            return format!("(({a}) {op} ({b}))");
        }
        let (a, b) = (self.expr(E::Bool, depth - 1), self.expr(E::Bool, depth - 1));
        match self.random.below(4) {
            0 => format!("({a} AND {b})"),
            1 => format!("({a} OR {b})"),
            2 => format!("({a} XOR {b})"),
            _ => format!("(NOT {a})"),
        }
    }

    fn bit_expr(&mut self, ty: E, depth: usize) -> String {
        let (a, b) = (self.expr(ty, depth - 1), self.expr(ty, depth - 1));
        let amount = self.expr(E::Usint, depth - 1);
        match self.random.below(8) {
            0 => format!("({a} AND {b})"),
            1 => format!("({a} OR {b})"),
            2 => format!("({a} XOR {b})"),
            3 => format!("(NOT {a})"),
            4 => format!("SHL({a}, {amount})"),
            5 => format!("ROR({a}, {amount})"),
            6 => format!("SHR({a}, {amount})"),
            _ => self.conversion(ty, depth),
        }
    }

    fn int_expr(&mut self, ty: E, depth: usize) -> String {
        let (a, b) = (self.expr(ty, depth - 1), self.expr(ty, depth - 1));
        match self.random.below(11) {
            0 => format!("({a} + {b})"),
            1 => format!("({a} + {})", self.literal(ty)),
            2 => format!("({a} - {b})"),
            3 => format!("({a} * {})", self.literal(ty)),
            4 => format!("({a} * {b})"),
            5 if self.random.one_in(20) => format!("({a} / {b})"),
            5 => format!("({a} / {}#{})", ty.name(), 1 + self.random.below(99)),
            6 => format!("({a} MOD {b})"),
            7 if ty.is_signed_int() => format!("ABS({a})"),
            8 if ty.is_signed_int() => format!("(-({a}))"),
            9 => {
                let k = self.expr(E::Usint, depth - 1);
                format!("MUX({k}, {a}, {b}, {a})")
            }
            _ => self.conversion(ty, depth),
        }
    }

    fn real_expr(&mut self, ty: E, depth: usize) -> String {
        let (a, b) = (self.expr(ty, depth - 1), self.expr(ty, depth - 1));
        match self.random.below(10) {
            0 => format!("({a} + {b})"),
            1 => format!("({a} - {b})"),
            2 => format!("({a} * {b})"),
            3 => format!("({a} / {b})"),
            4 => format!("ABS({a})"),
            5 => format!("SQRT({a})"),
            6 => format!("SIN({a})"),
            7 => format!("(-({a}))"),
            _ => self.conversion(ty, depth),
        }
    }

    fn time_expr(&mut self, depth: usize) -> String {
        let a = self.expr(E::Time, depth - 1);
        match self.random.below(5) {
            0 => format!("({a} + {})", self.expr(E::Time, depth - 1)),
            1 => format!("({a} - {})", self.expr(E::Time, depth - 1)),
            2 => format!("({a} * {})", self.expr(E::Int, depth - 1)),
            3 => format!("({a} / {})", self.expr(E::Dint, depth - 1)),
            _ => format!("({a} * {})", self.literal(E::Lreal)),
        }
    }

    /// A conversion between numbers and bit strings that the standard names.
    fn conversion(&mut self, to: E, depth: usize) -> String {
        let allowed = |from: E| {
            let numbers = (from.is_int() || from.is_real()) && (to.is_int() || to.is_real());
            let bits = from.is_bit() && to.is_bit();
            let mixed = (from.is_bit() && to.is_int()) || (from.is_int() && to.is_bit());
            from != to && (numbers || bits || mixed)
        };
        let sources: Vec<E> = SCALARS.iter().copied().filter(|f| allowed(*f)).collect();
        let from = self.random.pick(&sources);
        format!("{}_TO_{}({})", from.name(), to.name(), self.expr(from, depth - 1))
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
