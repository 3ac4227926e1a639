//! Expressions of any type; BOOL and bit strings here.

use super::{Generator, SCALARS, Ty, is_constant};
use takt_image::Elementary as E;

impl Generator {
    /// An expression of this type. Its constant parts do not overflow.
    pub(super) fn expr(&mut self, ty: Ty, depth: usize) -> String {
        if depth == 0 || self.one_in(4) {
            return self.leaf(ty, depth);
        }
        if self.calls
            && self.one_in(9)
            && let Some(call) = self.function_call(ty, depth)
        {
            return call;
        }
        if self.one_in(7) {
            return self.selection(ty, depth);
        }
        match ty {
            Ty::E(E::Bool) => self.bool_expr(depth),
            Ty::E(e) if e.is_bit() => self.bit_expr(e, depth),
            Ty::E(e) if e.is_int() => self.int_expr(e, depth),
            Ty::E(e) if e.is_real() => self.real_expr(e, depth),
            Ty::E(e) => self.other_expr(e, depth),
            Ty::Text | Ty::Wide => self.text_expr(ty, depth),
            _ => self.leaf(ty, depth),
        }
    }

    fn leaf(&mut self, ty: Ty, depth: usize) -> String {
        if !self.one_in(4) {
            return self.variable_expr(ty, depth.saturating_sub(1));
        }
        match ty {
            Ty::E(E::Int) if self.one_in(5) => "KI".into(),
            Ty::E(E::Real) if self.one_in(5) => "KR".into(),
            Ty::E(e) => self.literal(e),
            Ty::Text | Ty::Wide => self.text_literal(ty == Ty::Wide),
            Ty::Mode => self.random.pick(&["Mode#idle", "slow", "Mode#fast"]).into(),
            _ => self.variable_expr(ty, depth.saturating_sub(1)),
        }
    }

    /// A variable, or what no constant folding sees through.
    pub(super) fn variable_expr(&mut self, ty: Ty, depth: usize) -> String {
        match (self.readable(ty, depth), ty) {
            (Some(text), _) => text,
            (None, Ty::E(e)) => format!("SEL(yes, {}, {})", self.literal(e), self.literal(e)),
            (None, _) => unreachable!("every unit has variables of the other types"),
        }
    }

    /// An expression that is not constant.
    pub(super) fn varying(&mut self, ty: Ty, depth: usize) -> String {
        let text = self.expr(ty, depth);
        if is_constant(&text) { self.variable_expr(ty, depth) } else { text }
    }

    /// Now and then an expression of a type that widens to this one without a conversion (§2.3).
    pub(super) fn narrower(&mut self, ty: Ty, depth: usize) -> String {
        let widens = |from: E| match ty {
            Ty::E(e) => from != e && from.widens_to(e),
            Ty::Text => from == E::Char,
            Ty::Wide => from == E::Wchar,
            _ => false,
        };
        let found: Vec<E> = SCALARS.iter().copied().filter(|e| widens(*e)).collect();
        if found.is_empty() || !self.one_in(8) {
            return self.expr(ty, depth);
        }
        let from = self.random.pick(&found);
        self.expr(Ty::E(from), depth)
    }

    /// Two operands, not both constant.
    pub(super) fn operands(&mut self, ty: Ty, depth: usize) -> (String, String) {
        let (mut a, b) = (self.expr(ty, depth), self.narrower(ty, depth));
        if is_constant(&a) && is_constant(&b) {
            a = self.variable_expr(ty, depth);
        }
        (a, b)
    }

    /// SEL, MUX, MIN, MAX, LIMIT, MOVE.
    fn selection(&mut self, ty: Ty, depth: usize) -> String {
        let (a, b) = (self.expr(ty, depth - 1), self.expr(ty, depth - 1));
        let ordered = matches!(ty, Ty::E(_) | Ty::Text | Ty::Wide);
        match self.random.below(if ordered { 7 } else { 3 }) {
            0 | 1 => format!("SEL({}, {a}, {b})", self.expr(Ty::E(E::Bool), depth - 1)),
            2 => {
                let k = self.random.pick(&[E::Usint, E::Int, E::Dint, E::Ulint]);
                format!("MUX({}, {a}, {b}, {a})", self.varying(Ty::E(k), depth - 1))
            }
            3 => format!("MAX({a}, {b})"),
            4 => format!("MIN({a}, {b})"),
            5 => format!("LIMIT({a}, {}, {b})", self.expr(ty, depth - 1)),
            _ => format!("MOVE({a})"),
        }
    }

    /// A call of a function with this result, all inputs given; `None` if there is none.
    fn function_call(&mut self, ty: Ty, depth: usize) -> Option<String> {
        let found: Vec<usize> = (0..self.functions.len()).filter(|i| self.functions[*i].result == ty).collect();
        if found.is_empty() {
            return None;
        }
        let callee = self.functions[self.random.pick(&found)].clone();
        if self.vars.iter().any(|v| v.text == callee.name) {
            return None;
        }
        let args = self.arguments(&callee, depth - 1, true)?;
        Some(format!("{}({args})", callee.name))
    }

    fn bool_expr(&mut self, depth: usize) -> String {
        let d = depth - 1;
        if self.one_in(2) {
            return self.comparison(d);
        }
        let (a, b) = (self.expr(Ty::E(E::Bool), d), self.expr(Ty::E(E::Bool), d));
        match self.random.below(8) {
            0 => format!("({a} AND {b})"),
            1 => format!("({a} OR {b})"),
            2 => format!("({a} XOR {b})"),
            3 => format!("({a} AND_THEN {b})"),
            4 => format!("({a} OR_ELSE {b})"),
            5 => {
                let real = self.random.pick(&[E::Real, E::Lreal]);
                format!("IS_VALID({})", self.varying(Ty::E(real), d))
            }
            6 => self.conversion(E::Bool, depth),
            _ => format!("(NOT {a})"),
        }
    }

    fn comparison(&mut self, d: usize) -> String {
        let ty = match self.random.below(12) {
            0 => Ty::Text,
            1 => Ty::Wide,
            2 => Ty::Mode,
            _ => Ty::E(self.random.pick(SCALARS)),
        };
        let (a, b) = self.operands(ty, d);
        if ty != Ty::Mode && self.one_in(8) {
            let name = self.random.pick(&["GT", "GE", "EQ", "LE", "LT"]);
            return format!("{name}({a}, {b}, {})", self.expr(ty, d));
        }
        let operators: &[&str] = if ty == Ty::Mode { &["=", "<>"] } else { &["=", "<>", "<", ">", "<=", ">="] };
        format!("(({a}) {} ({b}))", self.random.pick(operators))
    }

    fn bit_expr(&mut self, e: E, depth: usize) -> String {
        let ty = Ty::E(e);
        let (a, b) = (self.expr(ty, depth - 1), self.expr(ty, depth - 1));
        match self.random.below(9) {
            0 => format!("({a} AND {b})"),
            1 => format!("({a} OR {b})"),
            2 => format!("({a} XOR {b})"),
            3 => format!("(NOT {a})"),
            4..=6 => self.shift(ty, depth),
            _ => self.conversion(e, depth),
        }
    }

    fn shift(&mut self, ty: Ty, depth: usize) -> String {
        let name = self.random.pick(&["SHL", "SHR", "ROL", "ROR"]);
        let count = self.random.pick(&[E::Usint, E::Int, E::Dint, E::Ulint]);
        let value = self.expr(ty, depth - 1);
        let count = if self.one_in(3) { format!("{}", self.random.below(70)) } else { self.varying(Ty::E(count), depth - 1) };
        format!("{name}({value}, {count})")
    }
}
