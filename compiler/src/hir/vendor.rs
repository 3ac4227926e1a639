//! Library blocks by the profile of the file that names them: variants (F_TRIG of CODESYS), other names of pins (SET1), and inputs
//! and outputs of several types (library reference §8.2, §10). A unit that the user declares is never replaced.

use super::builder::Builder;
use super::convert::Operand;
use super::model::*;
use super::symbols::Unit;
use crate::syntax::ast;
use takt_base::{Code, Diag, Profile};
use takt_image::types::Type;
use takt_image::{Elementary, TypeId};
use takt_stdlib::vendor;

impl Builder<'_> {
    /// The type or unit of a name, where a type stands.
    pub fn named_unit(&self, name: &ast::Name) -> Option<Unit> {
        let key = name.key();
        let found = self.unit(name).map(|(unit, _)| unit);
        if found.is_some_and(|unit| !self.is_of_library(unit)) {
            return found;
        }
        let variant = vendor::block(&key, self.profile(name.span)).and_then(|block| self.symbols.units.get(&block));
        variant.map(|(unit, _)| *unit).or(found)
    }

    fn is_of_library(&self, unit: Unit) -> bool {
        match unit {
            Unit::Type(_) => false,
            Unit::Pou(id) => self.is_standard(id),
        }
    }

    /// Part of the standard library.
    fn is_standard(&self, id: PouId) -> bool {
        self.symbols.pous[id].library
    }

    /// True and a report if only CODESYS has this block.
    pub fn is_vendor_block(&mut self, name: &ast::Name) -> bool {
        let known = vendor::block(&name.key(), Profile::Codesys).is_some();
        if known {
            self.report(Diag::new(Code::VendorForm, name.span, "not in this profile").help(Profile::CODESYS_HELP));
        }
        known
    }

    /// The pin of a library block that vendors call by this name.
    pub fn vendor_pin(&self, block: TypeId, name: &ast::Name) -> Option<&'static str> {
        if !self.profile(name.span).is_vendor() {
            return None;
        }
        let id = self.unit_of(block)?;
        vendor::pin(&self.hir.pous[id].name, &name.key()).filter(|_| self.is_standard(id))
    }

    /// The timers take LTIME for TIME too: both are the same number of nanoseconds.
    pub(super) fn preset_of_timer(&mut self, id: PouId, var: VarId, o: Operand) -> Operand {
        let pou = &self.hir.pous[id];
        let timer = matches!(pou.name.as_str(), "TP" | "TON" | "TOF") && pou.vars[var].name == "PT" && self.is_standard(id);
        if timer && self.elementary(o.expr.ty) == Some(Elementary::Ltime) {
            let time = pou.vars[var].ty;
            return Operand::fixed(self.wrap(Conversion::Integer, o.expr, time));
        }
        o
    }

    /// The parts that SPLIT_DATE and the like give go into integers of any type.
    pub(super) fn splits_into(&self, id: PouId, part: &Expr, target: TypeId) -> bool {
        let integer = |ty| matches!(self.ty(ty), Type::Elementary(e) if e.is_int());
        self.hir.pous[id].name.starts_with("SPLIT_") && self.is_standard(id) && integer(part.ty) && integer(target)
    }
}
