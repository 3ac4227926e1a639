//! Integers, reals and conversions.

use super::{Generator, SCALARS, Ty, is_constant};
use takt_image::Elementary as E;
use takt_stdlib::lookup::{ConversionType, converts, transfers_bits};

impl Generator {
    pub(super) fn int_expr(&mut self, e: E, depth: usize) -> String {
        let (ty, d) = (Ty::E(e), depth - 1);
        let (a, b) = self.operands(ty, d);
        match self.random.below(16) {
            0 | 1 => format!("({a} + {b})"),
            14 | 15 => self.untyped(ty, d),
            2 | 3 => format!("({a} - {b})"),
            4 => format!("({a} * {b})"),
            5 | 6 => self.division("/", e, d),
            7 => self.division("MOD", e, d),
            8 if e.is_signed_int() => format!("ABS({})", self.varying(ty, d)),
            9 if e.is_signed_int() => format!("(-({}))", self.varying(ty, d)),
            10 if e == E::Int => self.length(d),
            11 if self.one_in(3) => {
                let from = self.random.pick(&[Ty::Text, Ty::Wide]);
                let name = if from == Ty::Text { "STRING" } else { "WSTRING" };
                format!("{name}_TO_{}({})", e.name(), self.varying(from, d))
            }
            12 if self.one_in(3) => format!("TO_{}({})", e.name(), self.varying(Ty::E(E::Real), d)),
            _ => self.conversion(e, depth),
        }
    }

    /// Beside literals without a type, which take that of the other operand.
    fn untyped(&mut self, ty: Ty, d: usize) -> String {
        let (a, n) = (self.varying(ty, d), self.random.below(100));
        match self.random.below(7) {
            0 => format!("({a} + {n})"),
            1 => format!("({n} - {a})"),
            2 => format!("MAX({a}, {n})"),
            3 => format!("LIMIT(0, {a}, {n})"),
            4 => format!("({a} / {})", n + 1),
            5 => format!("({a} * {n} MOD 7)"),
            _ => format!("SEL(yes, {n}, {a})"),
        }
    }

    /// Divisors are seldom zero.
    fn division(&mut self, operator: &str, e: E, d: usize) -> String {
        let (ty, name) = (Ty::E(e), e.name());
        let a = self.varying(ty, d);
        let b = self.expr(ty, d);
        match self.random.below(25) {
            0 if !is_constant(&b) => format!("({a} {operator} {b})"),
            1..=8 if e.is_signed_int() => format!("({a} {operator} MIN({b}, {name}#-1))"),
            9..=16 => format!("({a} {operator} {name}#{})", 1 + self.random.below(100)),
            _ => format!("({a} {operator} MAX({b}, {name}#3))"),
        }
    }

    /// Functions of strings with an INT result.
    fn length(&mut self, d: usize) -> String {
        let ty = self.random.pick(&[Ty::Text, Ty::Wide]);
        let a = self.varying(ty, d);
        if self.one_in(2) { format!("LEN({a})") } else { format!("FIND({a}, {})", self.expr(ty, d)) }
    }

    pub(super) fn real_expr(&mut self, e: E, depth: usize) -> String {
        let (ty, d) = (Ty::E(e), depth - 1);
        let (a, b) = self.operands(ty, d);
        match self.random.below(16) {
            0 | 1 => format!("({a} + {b})"),
            2 => format!("({a} - {b})"),
            3 => format!("({a} * {b})"),
            4 => format!("({} / {})", self.varying(ty, d), self.varying(ty, d)),
            5 => format!("ABS({a})"),
            6 => format!("SQRT({})", self.varying(ty, d)),
            7 => {
                let name = self.random.pick(&["SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN", "EXP", "LN", "LOG"]);
                format!("{name}({})", self.varying(ty, d))
            }
            8 => format!("ATAN2({a}, {})", self.expr(ty, d)),
            12 => format!("({} * 0.5 - 3)", self.varying(ty, d)),
            9 => format!("({} ** {})", self.varying(ty, d), self.varying(ty, d)),
            10 => format!("EXPT({}, {})", self.varying(ty, d), self.varying(Ty::E(E::Int), d)),
            11 => format!("(-({}))", self.varying(ty, d)),
            _ => self.conversion(e, depth),
        }
    }

    /// A conversion that the library has.
    pub(super) fn conversion(&mut self, to: E, depth: usize) -> String {
        let other_width = |from: E| transfers_bits(from, to) && from.bytes() != to.bytes();
        let known = |from: E| converts(ConversionType::Elementary(from), ConversionType::Elementary(to));
        let allowed = |from: E| from != to && known(from) && !other_width(from);
        let sources: Vec<E> = SCALARS.iter().copied().filter(|f| allowed(*f)).collect();
        if sources.is_empty() {
            return self.variable_expr(Ty::E(to), depth - 1);
        }
        let from = self.random.pick(&sources);
        let word = if from.is_real() && to.is_int() && self.one_in(3) { "TRUNC" } else { "TO" };
        let value = self.varying(Ty::E(from), depth - 1);
        if self.one_in(5) {
            format!("{word}_{}({value})", to.name())
        } else {
            format!("{}_{word}_{}({value})", from.name(), to.name())
        }
    }
}
