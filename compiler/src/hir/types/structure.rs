//! Structures, and the layout of records (§2.8, §3.11): declaration order, natural alignment.

use super::TypeUse;
use crate::hir::builder::Builder;
use crate::hir::constant;
use crate::hir::model::*;
use crate::syntax::ast;
use takt_base::{Code, Diag, Span};
use takt_image::TypeId;
use takt_image::types::{Record, Section, Type};

/// A member before it has an offset.
pub(in crate::hir) struct Member {
    pub name: String,
    pub ty: TypeId,
    pub section: Section,
    pub retain: bool,
    pub init: Const,
}

impl Builder<'_> {
    /// `STRUCT ... END_STRUCT`; with the id that was reserved for it, and the structure that it extends, if any.
    pub(super) fn structure(
        &mut self,
        name: String,
        decls: &[ast::VarDecl],
        at: Span,
        (id, base): (Option<TypeId>, Option<&ast::Name>),
    ) -> TypeUse {
        let mut members: Vec<Member> = base.map(|b| self.inherited_members(b)).unwrap_or_default();
        let mut spans: Vec<Span> = base.map(|b| vec![b.span; members.len()]).unwrap_or_default();
        for decl in decls {
            let (ty, init) = self.member_type(decl);
            for name in &decl.names {
                if let Some(i) = members.iter().position(|m| name.is(&m.name)) {
                    let diag = Diag::new(Code::DuplicateName, name.span, "declared again");
                    self.report(diag.also(spans[i], "first declared"));
                    continue;
                }
                let (section, retain) = (Section::Var, false);
                members.push(Member { name: name.text.clone(), ty, section, retain, init: init.clone() });
                spans.push(name.span);
            }
        }
        let Some((record, default)) = self.record(name, members, at) else { return self.bad_type() };
        let body = Type::Struct(record);
        let ty = match id {
            Some(id) => {
                self.hir.types.replace(id, body);
                id
            }
            None => self.hir.types.add(body),
        };
        self.defaults.insert(ty, default);
        self.plain(ty)
    }

    /// The members of the structure that another one extends (vendor).
    fn inherited_members(&mut self, base: &ast::Name) -> Vec<Member> {
        let used = self.named_type(base);
        if used.ty == self.error {
            return Vec::new();
        }
        let Type::Struct(record) = self.ty(used.ty) else {
            let label = format!("{}, not a structure", self.show(used.ty));
            self.report(Diag::new(Code::NotABase, base.span, label).help("a structure extends a structure"));
            return Vec::new();
        };
        let init = |i: usize| match &used.default {
            Const::Aggregate(parts) => parts.get(i).cloned().unwrap_or(Const::Zero),
            _ => Const::Zero,
        };
        let fields = record.fields.iter().enumerate();
        fields
            .map(|(i, f)| Member { name: f.name.clone(), ty: f.ty, section: f.section, retain: f.retain, init: init(i) })
            .collect()
    }

    fn member_type(&mut self, decl: &ast::VarDecl) -> (TypeId, Const) {
        if let Some(at) = &decl.at {
            self.unsupported(at.span, "an address in a structure", "leave the address out: members follow each other");
        }
        if decl.edge.is_some() {
            self.error(Code::SectionNotAllowed, decl.span, "an edge is detected at inputs of function blocks and programs");
        }
        let used = self.type_ref(&decl.ty);
        let init = decl.init.as_ref().map_or_else(|| used.default.clone(), |i| self.initial_or_late(i, &used, false).0);
        (used.ty, init)
    }

    /// Lays out the members; with the default value of the whole. `None` and a report if it is too large.
    pub(in crate::hir) fn record(&mut self, name: String, members: Vec<Member>, at: Span) -> Option<(Record, Const)> {
        let layouts = members.iter().map(|m| self.hir.types.layout(m.ty));
        let bytes: u64 = layouts.map(|l| u64::from(l.size) + u64::from(l.align)).sum();
        if !self.check_size(bytes, at) {
            return None;
        }
        let leaves: usize = members.iter().map(|m| constant::leaves(&m.init)).sum();
        if !self.charge(leaves, at) {
            return None;
        }
        let default = constant::aggregate(members.iter().map(|m| m.init.clone()).collect());
        let fields = members.into_iter().map(|m| (m.name, m.ty, m.section, m.retain));
        Some((self.hir.types.record(name, fields), default))
    }
}
