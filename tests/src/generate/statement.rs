//! Statements: assignments, branches, loops, calls.

use super::unit::STANDARD;
use super::{Callable, Generator, Ty, Var, is_constant};
use takt_image::Elementary as E;

const BOOL: Ty = Ty::E(E::Bool);
const INT: Ty = Ty::E(E::Int);

impl Generator {
    pub(super) fn body(&mut self, statements: usize) {
        self.indent += 1;
        for _ in 0..statements {
            self.statement(2);
        }
        self.indent -= 1;
    }

    fn statement(&mut self, depth: usize) {
        match self.random.below(if depth == 0 { 4 } else { 21 }) {
            0..=3 => self.assign(),
            4 => self.if_statement(depth),
            5 => self.case_statement(depth),
            6 => self.for_statement(depth),
            7 => self.while_statement(depth),
            8 => self.repeat_statement(depth),
            9 if self.loops > 0 => {
                let (condition, word) = (self.varying(BOOL, 1), self.random.pick(&["EXIT", "CONTINUE"]));
                self.line(format!("IF {condition} THEN {word}; END_IF;"));
            }
            10 | 11 => self.call_instance(),
            12 if self.calls => self.call_function(),
            13 => self.character(),
            14 if self.one_in(4) => {
                let (a, b) = (self.varying(BOOL, 2), self.variable_expr(BOOL, 0));
                self.line(format!("IF {a} AND {b} THEN RETURN; END_IF;"));
            }
            15 => self.split(),
            16 => self.mode_case(depth),
            17 => self.object_statement(),
            18 => self.guarded_standard(),
            _ => self.assign(),
        }
    }

    pub(super) fn assign(&mut self) {
        let place = self.writable();
        let target = self.subscripts(&place.text, 1);
        let value = self.value_for(&place, 3);
        self.line(format!("{target} := {value};"));
    }

    /// A value for a variable: within its subrange, seldom not.
    fn value_for(&mut self, var: &Var, depth: usize) -> String {
        let value = self.assignable(var.ty, depth);
        match var.declared == "Pct" {
            true if !is_constant(&value) && self.one_in(40) => value,
            true => format!("LIMIT(INT#0, {value}, INT#100)"),
            false => value,
        }
    }

    /// A constant string may be too long for the target, so that it is refused.
    pub(super) fn assignable(&mut self, ty: Ty, depth: usize) -> String {
        match self.narrower(ty, depth) {
            text if matches!(ty, Ty::Text | Ty::Wide) && is_constant(&text) => self.variable_expr(ty, depth),
            text => text,
        }
    }

    fn nested(&mut self, depth: usize) {
        self.indent += 1;
        for _ in 0..1 + self.random.below(3) {
            self.statement(depth - 1);
        }
        self.indent -= 1;
    }

    fn if_statement(&mut self, depth: usize) {
        let condition = self.expr(BOOL, 3);
        self.line(format!("IF {condition} THEN"));
        self.nested(depth);
        if self.one_in(2) {
            let condition = self.expr(BOOL, 2);
            self.line(format!("ELSIF {condition} THEN"));
            self.nested(depth);
        }
        if self.one_in(2) {
            self.line("ELSE");
            self.nested(depth);
        }
        self.line("END_IF;");
    }

    fn case_statement(&mut self, depth: usize) {
        let (selector, labels): (_, &[&str]) = match self.random.below(5) {
            4 => (self.expr(Ty::E(E::Char), 2), &["CHAR#'A'..CHAR#'F':", "CHAR#'Z', CHAR#'0':"]),
            0 => (self.expr(Ty::E(E::Usint), 2), &["0..3, 5:", "4:", "200..255:", "100:"]),
            1 => (self.expr(Ty::E(E::Lint), 2), &["-9223372036854775808..-1:", "0:", "1..9223372036854775807:"]),
            2 => (format!("({} MOD 12)", self.varying(INT, 2)), &["0:", "1:", "2:", "3, 4:", "5:", "6:", "7..9:"]),
            _ => (self.expr(INT, 2), &["-5..0:", "1, 3:", "2:", "10..100, 200:"]),
        };
        self.line(format!("CASE {selector} OF"));
        for label in labels {
            self.line(label);
            self.nested(depth);
        }
        if self.one_in(2) {
            self.line("ELSE");
            self.nested(depth);
        }
        self.line("END_CASE;");
    }

    fn mode_case(&mut self, depth: usize) {
        let selector = self.expr(Ty::Mode, 2);
        self.line(format!("CASE {selector} OF idle:"));
        self.nested(depth);
        self.line("Mode#slow, fast:");
        self.nested(depth);
        self.line("END_CASE;");
    }

    /// Loops nest at most three deep, each level with a counter of its own.
    fn for_statement(&mut self, depth: usize) {
        if self.loops == 3 {
            return self.assign();
        }
        let counter = format!("c{}", self.loops);
        let range = match (self.loops, self.random.below(3)) {
            (2, _) => self.random.pick(&["250 TO 255", "3 TO 0 BY 1", "0 TO 9 BY 4"]).to_owned(),
            (_, 0) => {
                let (from, to) = (self.varying(INT, 1), self.varying(INT, 1));
                format!("LIMIT(INT#-3, {from}, INT#3) TO LIMIT(INT#-3, {to}, INT#3)")
            }
            _ => {
                self.random.pick(&["1 TO 4", "4 TO 1 BY -2", "250 TO 255", "0 TO 6 BY 3", "5 TO 1", "32766 TO 32767"]).to_owned()
            }
        };
        if self.loops < 2 && self.one_in(5) {
            let (start, end) = (self.random.below(3), self.varying(INT, 1));
            self.line(format!("FOR r{} := {start} TO LIMIT(0, {end}, 9) BY 2 DO", self.loops));
        } else {
            self.line(format!("FOR {counter} := {range} DO"));
        }
        self.in_loop(depth);
        self.line("END_FOR;");
    }

    fn in_loop(&mut self, depth: usize) {
        self.loops += 1;
        self.nested(depth);
        self.loops -= 1;
    }

    fn while_statement(&mut self, depth: usize) {
        if self.loops == 3 {
            return self.assign();
        }
        let counter = format!("w{}", self.loops);
        let condition = self.expr(BOOL, 2);
        self.line(format!("{counter} := 0;"));
        self.line(format!("WHILE {counter} < 4 AND ({condition}) DO"));
        self.line(format!("  {counter} := {counter} + 1;"));
        self.in_loop(depth);
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
        self.in_loop(depth);
        let condition = self.expr(BOOL, 2);
        self.line(format!("UNTIL {counter} >= 3 OR {condition} END_REPEAT;"));
    }

    /// Arguments of a call, in any order of kinds; `None` if there is nothing to lend.
    pub(super) fn arguments(&mut self, callee: &Callable, depth: usize, all: bool) -> Option<String> {
        let mut args = Vec::new();
        for input in &callee.inputs {
            if all || !self.one_in(3) {
                args.push(format!("{} := {}", input.text, self.value_for(input, depth)));
            }
        }
        for lent in &callee.lent {
            args.push(format!("{} := {}", lent.text, self.lendable(&lent.declared)?));
        }
        for output in &callee.outputs {
            if self.one_in(2) {
                args.extend(self.lendable(&output.declared).map(|target| format!("{} => {target}", output.text)));
            }
        }
        Some(args.join(", "))
    }

    fn call_function(&mut self) {
        if self.functions.is_empty() {
            return self.assign();
        }
        let callee = self.functions[self.random.below(self.functions.len())].clone();
        if self.vars.iter().any(|v| v.text == callee.name) {
            return self.assign();
        }
        let targets: Vec<Var> =
            self.vars.iter().filter(|v| v.writable && v.ty == callee.result && v.declared != "Pct").cloned().collect();
        match self.arguments(&callee, 2, true) {
            Some(args) if !targets.is_empty() => {
                let target = targets[self.random.below(targets.len())].text.clone();
                let target = self.subscripts(&target, 1);
                let enable = self.enable();
                self.line(format!("{target} := {}({enable}{args});", callee.name));
            }
            _ => self.assign(),
        }
    }

    fn call_instance(&mut self) {
        if self.instances.is_empty() {
            return self.assign();
        }
        let (instance, kind) = self.instances[self.random.below(self.instances.len())].clone();
        let instance = self.subscripts(&instance, 1);
        let Some(callee) = self.blocks.get(kind).cloned() else { return self.call_standard(&instance, usize::MAX - kind) };
        let Some(mut args) = self.arguments(&callee, 2, false) else { return self.assign() };
        for edge in ["up", "down"] {
            if self.one_in(2) {
                let comma = if args.is_empty() { "" } else { ", " };
                args += &format!("{comma}{edge} := {}", self.expr(BOOL, 2));
            }
        }
        let enable = if args.is_empty() { String::new() } else { self.enable() };
        self.line(format!("{instance}({enable}{args});"));
    }

    fn call_standard(&mut self, instance: &str, kind: usize) {
        let (a, b) = (self.expr(BOOL, 2), self.expr(BOOL, 1));
        let args = match STANDARD[kind].0 {
            "TON" | "TOF" | "TP" => format!("IN := {a}, PT := {}", self.random.pick(&["T#15MS", "T#0S", "gdur"])),
            "CTU" => format!("CU := {a}, R := {b}, PV := {}", self.expr(INT, 1)),
            "CTD" => format!("CD := {a}, LD := {b}, PV := {}", self.expr(INT, 1)),
            "SR" => format!("S1 := {a}, R := {b}"),
            "RS" => format!("S := {a}, R1 := {b}"),
            _ => format!("CLK := {a}"),
        };
        self.line(format!("{instance}({args});"));
    }

    /// A character of a string, within its length.
    fn character(&mut self) {
        let ty = self.random.pick(&[(Ty::Text, E::Char), (Ty::Wide, E::Wchar)]);
        let found: Vec<Var> = self.vars.iter().filter(|v| v.writable && v.ty == ty.0).cloned().collect();
        let place = found[self.random.below(found.len())].text.clone();
        let text = self.subscripts(&place, 0);
        let index = format!("1 + ABS({} MOD LEN({text}))", self.varying(INT, 1));
        let value = if self.one_in(2) { self.expr(Ty::E(ty.1), 1) } else { format!("{text}[LEN({text})]") };
        self.line(format!("IF LEN({text}) > 0 THEN {text}[{index}] := {value}; END_IF;"));
    }

    /// Date and time of day into numbers.
    fn split(&mut self) {
        let (a, b) = (self.lendable("INT"), self.lendable("INT"));
        let (Some(a), Some(b)) = (a, b) else { return self.assign() };
        match self.random.below(3) {
            0 => {
                let value = self.varying(Ty::E(E::Tod), 2);
                self.line(format!("SPLIT_TOD(IN := {value}, MINUTE => {a}, SECOND => {b});"));
            }
            1 => {
                let value = self.varying(Ty::E(E::Dt), 2);
                self.line(format!("SPLIT_DT(IN := {value}, HOUR => {a}, MONTH => {b});"));
            }
            _ => {
                let value = self.varying(Ty::E(E::Date), 2);
                self.line(format!("{a} := DAY_OF_WEEK({value});"));
            }
        }
    }
}
