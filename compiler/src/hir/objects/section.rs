//! Access to variables of types, and which sections and words a type may have.

use crate::hir::builder::Builder;
use crate::hir::model::*;
use crate::syntax::ast::{self, AccessSpec, Name, SectionKind};
use takt_base::{Code, Diag, Severity};
use takt_image::TypeId;
use takt_image::types::Section;
use takt_image::types::Type;

impl Builder<'_> {
    /// Sections that a class or a method can't have, and access specifiers where they mean nothing.
    pub(in crate::hir) fn check_object_section(&mut self, pou: &ast::Pou, section: &ast::VarSection) {
        let pins = matches!(section.kind, SectionKind::Input | SectionKind::Output | SectionKind::InOut);
        if pou.kind == ast::PouKind::Class && pins {
            let help = "a class has no body to call: give its methods the parameters";
            self.report(Diag::new(Code::SectionNotAllowed, section.span, "parameters of a class").help(help));
        }
        let kept = matches!(pou.kind, ast::PouKind::FunctionBlock | ast::PouKind::Class | ast::PouKind::Program);
        if section.access.is_some() && !(kept && section.kind == SectionKind::Var) {
            let help = "PUBLIC, PROTECTED, PRIVATE and INTERNAL belong to VAR of function blocks and classes";
            self.report(Diag::new(Code::SectionNotAllowed, section.span, "an access specifier").help(help));
        }
    }

    /// The variable behind a field of an instance type.
    fn field_var(&self, ty: TypeId, field: usize) -> Option<(PouId, VarId)> {
        let pou = self.objects.types.get(&ty).copied()?;
        let found = self.hir.pous[pou].vars.enumerate().find(|(_, v)| v.storage == Storage::Field(field as u32));
        found.map(|(v, _)| (pou, v))
    }

    /// True for a VAR PUBLIC, which may be written from outside.
    pub(in crate::hir) fn is_public_var(&self, ty: TypeId, field: usize) -> bool {
        let access = self.field_var(ty, field).and_then(|key| self.objects.var_access.get(&key));
        matches!(access, Some((AccessSpec::Public | AccessSpec::Internal, _)))
    }

    /// True for the running instance itself, whose variables all its methods may write.
    pub(in crate::hir) fn is_own_place(&self, place: &Place) -> bool {
        matches!(place.base, Base::This) && place.path.is_empty()
    }

    /// False and a report if a variable of an instance may not be used from here.
    pub(in crate::hir) fn check_var_access(&mut self, ty: TypeId, field: usize, name: &Name) -> bool {
        let Some((pou, var)) = self.field_var(ty, field) else { return true };
        let at = self.hir.pous[pou].vars[var].span;
        let Some((access, owner)) = self.objects.var_access.get(&(pou, var)).copied() else {
            self.check_default_access(ty, field, name, pou);
            return true;
        };
        if self.may_use(access, owner, name.span) {
            return true;
        }
        let word = super::lookup::access_word(access);
        let label = format!("{word} in `{}`", self.hir.pous[owner].name);
        let help = "add a method or property that reads it, or write VAR PUBLIC";
        self.report(Diag::new(Code::AccessDenied, name.span, label).also(at, "declared").help(help));
        false
    }

    /// Without a specifier VAR is PROTECTED in the standard; the vendors let everybody read it.
    fn check_default_access(&mut self, ty: TypeId, field: usize, name: &Name, pou: PouId) {
        let Type::Instance(record) = self.ty(ty) else { return };
        let is_var = record.fields.get(field).is_some_and(|f| f.section == Section::Var);
        let class = self.hir.pous[pou].kind == PouKind::Class;
        if !is_var || !class || self.profile(name.span).is_vendor() || self.may_use(AccessSpec::Protected, pou, name.span) {
            return;
        }
        let label = "PROTECTED, because nothing is written there";
        let diag = Diag::new(Code::AccessDenied, name.span, label).severity(Severity::Warning);
        self.report(diag.message("a variable without an access specifier is used from outside").help("write VAR PUBLIC"));
    }
}
