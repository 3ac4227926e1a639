//! Variables and their parts; subscripts.

use super::{Generator, Ty, Var, is_constant};
use takt_image::Elementary as E;

impl Generator {
    /// Adds a variable and its parts: members, elements, bits.
    pub(super) fn add(&mut self, var: Var) {
        self.parts(&var);
        self.vars.push(var);
    }

    fn parts(&mut self, var: &Var) {
        match var.ty {
            Ty::Point => {
                for (name, e) in [("x", E::Dint), ("y", E::Real), ("flag", E::Bool)] {
                    self.part(var, &format!(".{name}"), Ty::E(e), e.name());
                }
            }
            Ty::Row => self.part(var, "[@1..3@]", Ty::E(E::Int), "INT"),
            Ty::Cell => {
                self.part(var, ".pt", Ty::Point, "Point");
                self.part(var, ".row", Ty::Row, "Row");
                self.part(var, ".name", Ty::Text, "STRING[6]");
                self.part(var, ".m", Ty::Mode, "Mode");
                self.part(var, ".w", Ty::E(E::Word), "WORD");
                self.part(var, ".n", Ty::E(E::Int), "Pct");
                self.part(var, ".d[@0..1@, @-1..1@]", Ty::E(E::Lreal), "LREAL");
            }
            Ty::E(e) if e.is_bit() && e != E::Bool && var.whole => self.bits(var, e),
            _ => {}
        }
    }

    fn part(&mut self, of: &Var, suffix: &str, ty: Ty, declared: &str) {
        let text = format!("{}{suffix}", of.text);
        self.add(Var { text, ty, declared: declared.into(), writable: of.writable, whole: of.whole });
    }

    /// One bit and one part of a bit string (§2.11).
    fn bits(&mut self, of: &Var, e: E) {
        let bit = self.random.below(e.bits() as usize);
        let sign = if self.one_in(2) { "." } else { ".%X" };
        let mut add = |text: String, e: E| {
            self.vars.push(Var { text, ty: Ty::E(e), declared: String::new(), writable: of.writable, whole: false });
        };
        add(format!("{}{sign}{bit}", of.text), E::Bool);
        if e.bits() > 8 {
            add(format!("{}.%B{}", of.text, bit / 8), E::Byte);
        }
        if e.bits() > 16 {
            add(format!("{}.%W{}", of.text, bit / 16), E::Word);
        }
    }

    /// A variable to read; `None` if there is none of the type.
    pub(super) fn readable(&mut self, ty: Ty, depth: usize) -> Option<String> {
        let fits = |v: &Var| v.ty == ty && !is_constant(&v.text);
        let found: Vec<usize> = (0..self.vars.len()).filter(|i| fits(&self.vars[*i])).collect();
        if found.is_empty() {
            return None;
        }
        let text = self.vars[self.random.pick(&found)].text.clone();
        Some(self.subscripts(&text, depth))
    }

    /// A variable to write.
    pub(super) fn writable(&mut self) -> Var {
        let found: Vec<usize> = (0..self.vars.len()).filter(|i| self.vars[*i].writable).collect();
        self.vars[self.random.pick(&found)].clone()
    }

    /// A variable that can be lent or receive an output of this very type.
    pub(super) fn lendable(&mut self, declared: &str) -> Option<String> {
        let fits = |v: &Var| v.writable && v.whole && v.declared == declared;
        let found: Vec<usize> = (0..self.vars.len()).filter(|i| fits(&self.vars[*i])).collect();
        if found.is_empty() {
            return None;
        }
        let text = self.vars[self.random.pick(&found)].text.clone();
        Some(self.subscripts(&text, 1))
    }

    /// Fills in the subscripts of a text.
    pub(super) fn subscripts(&mut self, text: &str, depth: usize) -> String {
        let mut out = String::new();
        for (i, piece) in text.split('@').enumerate() {
            match piece.split_once("..") {
                Some((low, high)) if i % 2 == 1 => out += &self.subscript(low, high, depth),
                _ => out += piece,
            }
        }
        out
    }

    /// From `low` to `high`, now and then outside.
    fn subscript(&mut self, low: &str, high: &str, depth: usize) -> String {
        let (first, last): (i64, i64) = (low.parse().unwrap_or(0), high.parse().unwrap_or(0));
        let count = last - first + 1;
        if depth == 0 || self.one_in(2) {
            return (first + self.random.below(count as usize) as i64).to_string();
        }
        let e = self.random.pick(&[E::Int, E::Dint, E::Usint, E::Lint]);
        let name = e.name();
        let value = self.expr(Ty::E(e), depth - 1);
        match self.random.below(40) {
            0 => self.variable_expr(Ty::E(E::Int), depth - 1),
            1..=20 if first >= 0 || e.is_signed_int() => format!("LIMIT({name}#{first}, {value}, {name}#{last})"),
            _ if e.is_signed_int() => format!("ABS({value} MOD {name}#{count}) + {name}#{first}"),
            _ => format!("{value} MOD {name}#{count} + INT#{first}"),
        }
    }
}
