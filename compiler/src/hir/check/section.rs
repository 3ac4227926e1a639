//! Which variable sections, qualifiers and addresses a unit may have (§3.1 to §3.4).

use crate::hir::builder::Builder;
use crate::hir::constant;
use crate::hir::model::Const;
use crate::syntax::ast::{self, PouKind, SectionKind};
use takt_base::{Code, Diag, Severity, Span};
use takt_image::types::Type;
use takt_image::{Elementary, TypeId};

impl Builder<'_> {
    /// A section of a unit.
    pub fn check_section(&mut self, pou: &ast::Pou, section: &ast::VarSection) {
        let function = matches!(pou.kind, PouKind::Function | PouKind::Method);
        self.check_object_section(pou, section);
        if section.kind == SectionKind::Global {
            let help = "write VAR_GLOBAL outside of the unit, and VAR_EXTERNAL inside";
            self.report(Diag::new(Code::SectionNotAllowed, section.span, "VAR_GLOBAL in a unit").help(help));
        }
        let kept = matches!(section.kind, SectionKind::Var | SectionKind::Input | SectionKind::Output);
        if (section.retain.is_some() || section.persistent) && (function || !kept) {
            let help = "RETAIN belongs to VAR, VAR_INPUT and VAR_OUTPUT of function blocks and programs, and to VAR_GLOBAL";
            self.report(Diag::new(Code::SectionNotAllowed, section.span, "nothing here is kept between calls").help(help));
        }
        if section.constant && (section.retain.is_some() || section.persistent) && !self.profile(section.span).is_vendor() {
            self.error(Code::SectionNotAllowed, section.span, "what is CONSTANT never changes, so nothing is retained");
        }
        let output = section.kind == SectionKind::Output && !self.profile(section.span).is_codesys();
        if section.constant && (section.kind == SectionKind::InOut || output) {
            self.error(Code::SectionNotAllowed, section.span, "outputs and in-outs can't be CONSTANT");
        }
    }

    /// A declaration in a section of a unit.
    pub fn check_decl(&mut self, pou: &ast::Pou, section: &ast::VarSection, d: &ast::VarDecl, ty: TypeId) {
        self.check_edge(pou, section, d, ty);
        self.check_relative(d);
        self.check_address(pou, section, d);
        self.check_instance(pou, section, ty, d.ty.span);
        if let Some(init) = d.init.as_ref().filter(|_| section.kind == SectionKind::InOut) {
            self.error(Code::BadInitializer, init.span(), "a VAR_IN_OUT has no value of its own");
        }
    }

    /// `%B2` is a place in a structure, not of a variable.
    pub fn check_relative(&mut self, d: &ast::VarDecl) {
        if let Some(at) = &d.relative {
            let help = "write the area: %IB2, %QB2 or %MB2";
            self.report(Diag::new(Code::BadAddress, at.span, "a relative address outside of a structure").help(help));
        }
    }

    fn check_edge(&mut self, pou: &ast::Pou, section: &ast::VarSection, d: &ast::VarDecl, ty: TypeId) {
        if d.edge.is_none() {
            return;
        }
        if section.kind != SectionKind::Input || matches!(pou.kind, PouKind::Function | PouKind::Method) {
            self.error(Code::SectionNotAllowed, d.span, "an edge is detected at inputs of function blocks and programs");
        } else if ty != self.error && self.elementary(ty) != Some(Elementary::Bool) {
            let label = format!("{}, BOOL wanted", self.show(ty));
            self.error(Code::TypeMismatch, d.ty.span, label);
        }
    }

    fn check_address(&mut self, pou: &ast::Pou, section: &ast::VarSection, d: &ast::VarDecl) {
        let Some(at) = &d.at else { return };
        let open = at.path.is_empty() && matches!(pou.kind, PouKind::FunctionBlock | PouKind::Class);
        if !open && pou.kind != PouKind::Program || section.kind != SectionKind::Var {
            let help = "locate variables in VAR of a program or in VAR_GLOBAL; a block leaves the address open: AT %Q*";
            self.report(Diag::new(Code::SectionNotAllowed, at.span, "an address").help(help));
        }
    }

    /// Function blocks need memory that lasts.
    fn check_instance(&mut self, pou: &ast::Pou, section: &ast::VarSection, ty: TypeId, span: Span) {
        let lost = match section.kind {
            SectionKind::Temp => true,
            SectionKind::Var | SectionKind::Output => matches!(pou.kind, PouKind::Function | PouKind::Method),
            _ => false,
        };
        if lost && self.holds_instance(ty) {
            let label = format!("{} would forget its state after each call", self.show(ty));
            let help = "declare the instance in a function block or program, or pass it as VAR_IN_OUT";
            self.report(Diag::new(Code::SectionNotAllowed, span, label).help(help));
        }
        self.check_constant_instance(section.constant, ty, span);
    }

    /// A constant that is declared without a value, of a type that has none either.
    pub fn check_constant_value(&mut self, d: &ast::VarDecl, ty: TypeId, default: &Const) {
        let own = matches!(self.ty(ty), Type::Struct(_)); // its members may say their values
        if ty == self.error || own || self.holds_instance(ty) || d.init.is_some() || d.at.is_some() || !constant::is_zero(default)
        {
            return;
        }
        let severity = if self.profile(d.span).is_vendor() { Severity::Warning } else { Severity::Error };
        let diag = Diag::new(Code::ConstantWithoutValue, d.span, "would be zero for ever").severity(severity);
        self.report(diag.help("write `:= value` behind the type"));
    }

    /// A function block is never constant.
    pub fn check_constant_instance(&mut self, constant: bool, ty: TypeId, span: Span) {
        if constant && self.holds_instance(ty) {
            let label = format!("{} changes when it is called", self.show(ty));
            self.report(Diag::new(Code::SectionNotAllowed, span, label).message("a function block can't be CONSTANT"));
        }
    }

    fn holds_instance(&self, ty: TypeId) -> bool {
        self.hir.types.holds(ty, |t| matches!(t, Type::Instance(_)))
    }
}
