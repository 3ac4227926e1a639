//! Declarations: functions, function blocks, the main program.

use super::{Callable, Generator, SCALARS, Shape, Ty, Var};
use takt_image::Elementary as E;

impl Generator {
    /// A type for a parameter or variable, and how it is written.
    pub(super) fn declared_type(&mut self) -> (Ty, String) {
        match self.random.below(32) {
            30 => (Ty::E(E::Int), "Pct".into()),
            31 => (Ty::E(E::Bool), "BOOL".into()),
            0 => (Ty::Text, format!("STRING[{}]", self.random.pick(&[1, 5, 12, 30]))),
            1 => (Ty::Wide, "WSTRING[8]".into()),
            2 => (Ty::Mode, "Mode".into()),
            3 => (Ty::Point, "Point".into()),
            4 => (Ty::Row, "Row".into()),
            5 => (Ty::Cell, "Cell".into()),
            _ => {
                let e = self.random.pick(SCALARS);
                (Ty::E(e), e.name().into())
            }
        }
    }

    /// One section of `count` variables; most scalars get an initial value.
    fn declare(&mut self, prefix: &str, count: usize, section: &str, writable: bool) -> Vec<Var> {
        self.line(section);
        let mut made = Vec::new();
        for i in 0..count {
            let (ty, declared) = self.declared_type();
            let text = format!("{prefix}{i}");
            let init = match ty {
                Ty::E(e) if section != "VAR_IN_OUT" && declared != "Pct" && self.one_in(2) => format!(" := {}", self.literal(e)),
                _ => String::new(),
            };
            self.line(format!("  {text} : {declared}{init};"));
            made.push(Var { text, ty, declared, writable, whole: true });
        }
        self.line("END_VAR");
        made.iter().for_each(|v| self.add(v.clone()));
        made
    }

    /// Loop counters, a flag that no constant folding sees through, and the globals.
    fn common(&mut self) {
        self.line("VAR c0 : DINT; c1 : INT; c2 : USINT; w0, w1, w2 : INT; yes : BOOL := TRUE; n, r0, r1 : Pct; END_VAR");
        self.line("VAR cell : Cell; txt : STRING[10] := 'ABC'; wtx : WSTRING[5]; END_VAR");
        self.line("VAR sh : Shared; END_VAR");
        self.line("VAR rg : REF_TO INT := REF(gi); rp : REF_TO Point := REF(gp); rr : REF_TO LREAL := REF(gr); END_VAR");
        self.line("VAR_EXTERNAL CONSTANT KI : INT; KR : REAL; KW : WORD; END_VAR");
        self.line("VAR_EXTERNAL gi : INT; gr : LREAL; gp : Point; gdur : TIME; gw : WORD; gb : BOOL; END_VAR");
        for (text, e) in [
            ("c0", E::Dint),
            ("c1", E::Int),
            ("c2", E::Usint),
            ("r0", E::Int),
            ("r1", E::Int),
            ("KI", E::Int),
            ("KR", E::Real),
            ("KW", E::Word),
        ] {
            self.scalar(text, e, false);
        }
        for (text, e) in [("gi", E::Int), ("gr", E::Lreal), ("gdur", E::Time), ("gw", E::Word), ("gb", E::Bool)] {
            self.scalar(text, e, true);
        }
        for (text, ty, declared) in [
            ("gp", Ty::Point, "Point"),
            ("rg^", Ty::E(E::Int), "INT"),
            ("rr^", Ty::E(E::Lreal), "LREAL"),
            ("rp^", Ty::Point, "Point"),
            ("n", Ty::E(E::Int), "Pct"),
            ("cell", Ty::Cell, "Cell"),
            ("txt", Ty::Text, "STRING[10]"),
            ("wtx", Ty::Wide, "WSTRING[5]"),
        ] {
            self.whole(text, ty, declared);
        }
        self.shared_places("sh");
        let sum =
            Var { text: "OpenSum(cell.row)".into(), ty: Ty::E(E::Dint), declared: "DINT".into(), writable: false, whole: false };
        self.vars.push(sum);
    }

    fn whole(&mut self, text: &str, ty: Ty, declared: &str) {
        self.add(Var { text: text.into(), ty, declared: declared.into(), writable: true, whole: true });
    }

    fn scalar(&mut self, text: &str, e: E, writable: bool) {
        self.add(Var { text: text.into(), ty: Ty::E(e), declared: e.name().into(), writable, whole: true });
    }

    fn clear(&mut self, calls: bool) {
        self.vars.clear();
        self.instances.clear();
        self.calls = calls;
    }

    pub(super) fn function(&mut self, i: usize) {
        let name = format!("Fun{i}");
        let (result, declared) = self.declared_type();
        let declared = declared.replace("Pct", "INT");
        self.clear(i > 0);
        self.line(format!("FUNCTION {name} : {declared}"));
        let inputs = self.declare("a", 3, "VAR_INPUT", false);
        let outputs = self.declare("o", 1, "VAR_OUTPUT", true);
        let lent = if self.one_in(2) { self.declare("io", 1, "VAR_IN_OUT", true) } else { Vec::new() };
        self.declare("l", 4, "VAR", true);
        self.common();
        self.add(Var { text: name.clone(), ty: result, declared, writable: true, whole: false });
        self.body(4);
        let value = self.assignable(result, 2);
        self.line(format!("  {name} := {value};"));
        self.line("END_FUNCTION");
        self.functions.push(Callable { name, inputs, outputs, lent, result });
    }

    pub(super) fn block(&mut self, i: usize) {
        let name = format!("Blk{i}");
        self.clear(true);
        self.line(format!("FUNCTION_BLOCK {name} IMPLEMENTS Meter"));
        let inputs = self.declare("a", 3, "VAR_INPUT", false);
        let outputs = self.declare("o", 2, "VAR_OUTPUT", true);
        let lent = if self.one_in(2) { self.declare("io", 1, "VAR_IN_OUT", true) } else { Vec::new() };
        self.declare("l", 3, "VAR", true);
        self.declare("t", 1, "VAR_TEMP", true);
        self.line("VAR_INPUT up : BOOL R_EDGE; down : BOOL F_EDGE; END_VAR");
        self.scalar("up", E::Bool, false);
        self.scalar("down", E::Bool, false);
        self.common();
        self.standard_blocks("", 1);
        self.method();
        self.body(5);
        self.line("END_FUNCTION_BLOCK");
        self.blocks.push(Callable { name, inputs, outputs, lent, result: Ty::Mode });
    }

    /// Instances of the standard library, their outputs as variables.
    fn standard_blocks(&mut self, prefix: &str, count: usize) {
        self.line("VAR");
        for i in 0..count {
            let (block, outputs) = self.random.pick(STANDARD);
            let name = format!("{prefix}s{i}");
            self.line(format!("  {name} : {block};"));
            let ty = |output: &str| match output {
                "ET" => E::Time,
                "CV" => E::Int,
                _ => E::Bool,
            };
            for output in outputs {
                self.scalar(&format!("{name}.{output}"), ty(output), false);
            }
            self.instances.push((name, usize::MAX - STANDARD.iter().position(|s| s.0 == block).unwrap_or(0)));
        }
        self.line("END_VAR");
    }

    pub(super) fn main(&mut self, shape: Shape) {
        self.clear(true);
        self.line("PROGRAM main");
        self.declare("v", shape.scalars, "VAR", true);
        self.common();
        self.standard_blocks("", 3);
        self.line("VAR");
        self.line("  iw AT %IW2 : WORD; ib AT %IX0.3 : BOOL; qb AT %QX1.2 : BOOL; qd AT %QD2 : DINT; mb AT %MB40 : BYTE;");
        self.line("  arr : ARRAY[-2..5] OF INT := [1, 2, 3, 2(4), 5];");
        self.line(
            "  grid : ARRAY[0..2, 1..3] OF REAL; cells : ARRAY[-1..1] OF Cell; deep : ARRAY[0..1] OF ARRAY[1..2] OF Point;",
        );
        self.line("  pcts : ARRAY[1..4] OF Pct; bits : ARRAY[0..9] OF BOOL;");
        for i in 0..self.blocks.len() {
            self.line(format!("  b{i} : Blk{i}; bs{i} : ARRAY[0..1] OF Blk{i}; sub{i} : Sub{i};"));
        }
        self.line("  meter : Meter;");
        self.line("END_VAR");
        self.compound_places();
        self.body(shape.statements);
        self.line("END_PROGRAM");
    }

    fn compound_places(&mut self) {
        for (text, e, writable) in [
            ("iw", E::Word, false),
            ("ib", E::Bool, false),
            ("qb", E::Bool, true),
            ("qd", E::Dint, true),
            ("mb", E::Byte, true),
            ("arr[@-2..5@]", E::Int, true),
            ("grid[@0..2@, @1..3@]", E::Real, true),
            ("bits[@0..9@]", E::Bool, true),
        ] {
            self.scalar(text, e, writable);
        }
        self.whole("pcts[@1..4@]", Ty::E(E::Int), "Pct");
        self.whole("cells[@-1..1@]", Ty::Cell, "Cell");
        self.whole("deep[@0..1@][@1..2@]", Ty::Point, "Point");
        for i in 0..self.blocks.len() {
            for instance in [format!("b{i}"), format!("bs{i}[@0..1@]"), format!("sub{i}")] {
                for output in self.blocks[i].outputs.clone() {
                    let text = format!("{instance}.{}", output.text);
                    self.add(Var { text, writable: false, ..output });
                }
                self.instances.push((instance, i));
            }
        }
    }
}

/// Blocks of the standard library that the generator calls, with their outputs.
pub(super) const STANDARD: &[(&str, &[&str])] = &[
    ("TON", &["Q", "ET"]),
    ("TOF", &["Q", "ET"]),
    ("TP", &["Q", "ET"]),
    ("CTU", &["Q", "CV"]),
    ("CTD", &["Q", "CV"]),
    ("R_TRIG", &["Q"]),
    ("F_TRIG", &["Q"]),
    ("SR", &["Q1"]),
    ("RS", &["Q1"]),
];
