//! Methods, derived function blocks, an interface; EN and ENO; a structure whose members share their bytes.

use super::{Generator, Ty, Var};
use takt_image::Elementary as E;

const DINT: Ty = Ty::E(E::Dint);
const BOOL: Ty = Ty::E(E::Bool);

impl Generator {
    pub(super) fn object_types(&mut self) {
        self.line("INTERFACE Meter METHOD measure : DINT VAR_INPUT part : INT; END_VAR END_METHOD END_INTERFACE");
        self.line("TYPE Shared : STRUCT OVERLAP w AT %B0 : WORD; b AT %B0 : BYTE; f AT %X0.3 : BOOL; d AT %B2 : DINT; END_STRUCT; END_TYPE");
    }

    /// The members of a variable of the type `Shared`.
    pub(super) fn shared_places(&mut self, name: &str) {
        for (member, e, whole) in [("w", E::Word, true), ("b", E::Byte, true), ("f", E::Bool, false), ("d", E::Dint, true)] {
            let declared = e.name().to_owned();
            self.add(Var { text: format!("{name}.{member}"), ty: Ty::E(e), declared, writable: true, whole });
        }
    }

    /// A method of the block whose variables are known: those of one call and VAR_IN_OUT are not for it.
    pub(super) fn method(&mut self) {
        let known = self.vars.clone();
        let instances = std::mem::take(&mut self.instances);
        self.vars.retain(|v| !v.text.starts_with("t0") && !v.text.starts_with("io0"));
        self.line("METHOD PUBLIC measure : DINT VAR_INPUT part : INT; END_VAR");
        self.line("VAR k : DINT := 2; c0 : DINT; c1 : INT; c2 : USINT; r0, r1 : Pct; END_VAR");
        self.method_places();
        self.body(3);
        let value = self.assignable(DINT, 2);
        self.line(format!("  measure := {value};"));
        self.line("END_METHOD");
        (self.vars, self.instances) = (known, instances);
    }

    fn method_places(&mut self) {
        for (text, e, writable) in [("part", E::Int, false), ("k", E::Dint, true), ("measure", E::Dint, true)] {
            self.add(Var { text: text.into(), ty: Ty::E(e), declared: e.name().into(), writable, whole: text != "measure" });
        }
    }

    /// A block that extends another one: its own method calls the inherited one, its body runs the inherited one.
    pub(super) fn derived_block(&mut self, i: usize) {
        let (factor, add) = (self.random.below(5), self.random.below(9));
        self.line(format!("FUNCTION_BLOCK Sub{i} EXTENDS Blk{i} VAR extra : DINT := {add}; END_VAR"));
        self.line("METHOD PUBLIC OVERRIDE measure : DINT VAR_INPUT part : INT; END_VAR");
        self.line(format!("  extra := extra + DINT#{add}; measure := SUPER.measure(part) * DINT#{factor} + extra;"));
        self.line("END_METHOD");
        self.line("  SUPER(); extra := extra + THIS.measure(INT#1); END_FUNCTION_BLOCK");
    }

    /// `m := instance`, `m.measure(..)`, `instance.measure(..)`.
    pub(super) fn object_statement(&mut self) {
        let blocks: Vec<String> =
            self.instances.iter().filter(|(_, kind)| *kind < self.blocks.len()).map(|(text, _)| text.clone()).collect();
        let Some(target) = self.lendable("DINT") else { return self.assign() };
        if blocks.is_empty() {
            return self.assign();
        }
        let instance = self.random.pick(&blocks.iter().map(String::as_str).collect::<Vec<_>>()).to_owned();
        let instance = self.subscripts(&instance, 1);
        let by = self.narrower(Ty::E(E::Int), 2);
        match self.random.below(3) {
            0 => self.line(format!("meter := {instance};")),
            1 if self.one_in(20) => self.line(format!("{target} := meter.measure({by});")),
            1 => self.line(format!("IF meter <> NULL THEN {target} := meter.measure({by}); END_IF;")),
            _ => self.line(format!("{target} := {instance}.measure(part := {by});")),
        }
    }

    /// `EN := condition, ENO => variable, `, now and then.
    pub(super) fn enable(&mut self) -> String {
        if !self.one_in(4) {
            return String::new();
        }
        let condition = self.expr(BOOL, 1);
        match self.lendable("BOOL") {
            Some(ok) => format!("EN := {condition}, ENO => {ok}, "),
            None => format!("EN := {condition}, "),
        }
    }

    /// A standard function that tells its errors by ENO.
    pub(super) fn guarded_standard(&mut self) {
        let (Some(target), Some(ok)) = (self.lendable("INT"), self.lendable("BOOL")) else { return self.assign() };
        let (condition, a, b) = (self.expr(BOOL, 1), self.varying(Ty::E(E::Int), 2), self.varying(Ty::E(E::Int), 2));
        let call = match self.random.below(4) {
            0 => format!("DIV(EN := {condition}, IN1 := {a}, IN2 := {b}, ENO => {ok})"),
            1 => format!("MOD(EN := {condition}, IN1 := {a}, IN2 := {b}, ENO => {ok})"),
            2 => format!("LREAL_TO_INT(EN := {condition}, IN := {}, ENO => {ok})", self.varying(Ty::E(E::Lreal), 2)),
            _ => format!("ADD(EN := {condition}, IN1 := {a}, IN2 := {b}, ENO => {ok})"),
        };
        self.line(format!("{target} := {call};"));
    }
}
