//! Strings, characters, durations and dates.

use super::{Generator, SCALARS, Ty};
use takt_image::Elementary as E;

impl Generator {
    pub(super) fn text_expr(&mut self, ty: Ty, depth: usize) -> String {
        let d = depth - 1;
        let (a, b) = (self.varying(ty, d), self.narrower(ty, d));
        let (l, p) = (self.position(d), self.position(d));
        match self.random.below(12) {
            0 => format!("LEFT({a}, {l})"),
            1 => format!("RIGHT({a}, {l})"),
            2 => format!("MID({a}, {l}, {p})"),
            3 | 4 => format!("CONCAT({a}, {b})"),
            5 => format!("CONCAT({a}, {b}, {a})"),
            6 => format!("INSERT({a}, {b}, {p})"),
            7 => format!("DELETE({a}, {l}, {p})"),
            8 => format!("REPLACE({a}, {b}, {l}, {p})"),
            9 if ty == Ty::Text => format!("WSTRING_TO_STRING({})", self.varying(Ty::Wide, d)),
            9 => format!("STRING_TO_WSTRING({})", self.varying(Ty::Text, d)),
            _ => {
                let from = self.random.pick(SCALARS);
                let name = if ty == Ty::Text { "STRING" } else { "WSTRING" };
                format!("{}_TO_{name}({})", from.name(), self.varying(Ty::E(from), d))
            }
        }
    }

    /// A length or position, now and then out of range.
    fn position(&mut self, d: usize) -> String {
        match self.random.below(4) {
            0 => format!("{}", 1 + self.random.below(4)),
            1 => self.varying(Ty::E(E::Int), d),
            2 => self.varying(Ty::E(E::Usint), d),
            _ => format!("ABS({} MOD 6)", self.varying(Ty::E(E::Int), d)),
        }
    }

    /// Durations, dates, characters.
    pub(super) fn other_expr(&mut self, e: E, depth: usize) -> String {
        let d = depth - 1;
        match e {
            E::Time | E::Ltime => self.duration_expr(e, depth),
            E::Tod | E::Dt if self.one_in(2) => self.instant_expr(e, d),
            E::Date if self.one_in(3) => {
                let mut part =
                    |n: usize| format!("{} + ABS({} MOD {n})", 1 + 1969 * usize::from(n == 200), self.varying(Ty::E(E::Int), d));
                format!("CONCAT_DATE({}, {}, {})", part(200), part(12), part(31))
            }
            E::Char if self.one_in(2) => format!("STRING_TO_CHAR({})", self.varying(Ty::Text, d)),
            _ => self.conversion(e, depth),
        }
    }

    fn duration_expr(&mut self, e: E, depth: usize) -> String {
        let (ty, d) = (Ty::E(e), depth - 1);
        let (a, b) = self.operands(ty, d);
        match self.random.below(10) {
            0 | 1 => format!("({a} + {b})"),
            2 => format!("({a} - {b})"),
            3 => format!("({} * {})", self.varying(ty, d), self.varying(Ty::E(E::Int), d)),
            4 => format!("({} / {})", self.varying(ty, d), self.varying(Ty::E(E::Dint), d)),
            5 => format!("({} * {})", self.varying(ty, d), self.varying(Ty::E(E::Lreal), d)),
            6 => format!("({} / {})", self.varying(ty, d), self.varying(Ty::E(E::Real), d)),
            7 if e == E::Time => {
                let instant = self.random.pick(&[E::Date, E::Tod, E::Dt]);
                let (a, b) = self.operands(Ty::E(instant), d);
                format!("({a} - {b})")
            }
            8 if e == E::Time => "TIME()".into(),
            _ => self.conversion(e, depth),
        }
    }

    fn instant_expr(&mut self, e: E, d: usize) -> String {
        let (a, t) = (self.varying(Ty::E(e), d), self.expr(Ty::E(E::Time), d));
        match self.random.below(3) {
            0 => format!("({a} + {t})"),
            1 => format!("({a} - {t})"),
            _ if e == E::Dt => {
                format!("CONCAT_DATE_TOD({}, {})", self.varying(Ty::E(E::Date), d), self.varying(Ty::E(E::Tod), d))
            }
            _ => format!("({a} + {t})"),
        }
    }
}
