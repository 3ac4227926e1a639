//! Structures whose members have addresses of their own, OVERLAP, and UNION (§2.8).
//! A bit of a byte is a member of type BYTE in the layout; the bit is taken where it is named.

use super::TypeUse;
use crate::hir::builder::Builder;
use crate::hir::model::*;
use crate::syntax::ast::{self, AddressSize};
use takt_base::{Code, Diag, Span};
use takt_image::types::{Field, Record, Section, Type};
use takt_image::{Elementary, TypeId};

/// A member with its place in bits.
struct Placed {
    name: ast::Name,
    ty: TypeId,
    first: u64,
    bits: u64,
}

impl Builder<'_> {
    /// Members at the addresses that they name, or all at 0. The initial value is zero.
    pub(super) fn placed_structure(&mut self, name: String, layout: &ast::LayoutDecl, at: Span) -> TypeUse {
        let mut placed: Vec<Placed> = Vec::new();
        for decl in &layout.members {
            let ty = self.type_ref(&decl.ty).ty;
            if ty == self.error || !self.may_overlap(ty, decl.ty.span) {
                return self.bad_type();
            }
            if let Some(init) = decl.init.as_ref().filter(|_| layout.overlap) {
                let help = "all bytes of it start as zero; assign the members in the program";
                self.report(Diag::new(Code::BadInitializer, init.span(), "the members share their bytes").help(help));
            }
            for name in &decl.names {
                let Some(member) = self.placed(name, ty, decl, layout) else { return self.bad_type() };
                self.check_placed(&member, &placed, layout.overlap);
                placed.push(member);
            }
        }
        self.finish_placed(name, &layout.members, placed, at)
    }

    fn placed(&mut self, name: &ast::Name, ty: TypeId, decl: &ast::VarDecl, layout: &ast::LayoutDecl) -> Option<Placed> {
        let size = u64::from(self.hir.types.layout(ty).size) * 8;
        let Some(at) = &decl.relative else {
            if !layout.union {
                let help = "give all members an address, or none";
                self.report(Diag::new(Code::BadLayout, name.span, "has no address, and another has").help(help));
                return None;
            }
            return Some(Placed { name: name.clone(), ty, first: 0, bits: size });
        };
        let bool = self.elementary(ty) == Some(Elementary::Bool);
        let (unit, bits) = if at.size == AddressSize::Bit && bool { (1, 1) } else { (8, size) };
        if (at.size == AddressSize::Bit) != bool || at.bit > 7 {
            let help = "a BOOL stands at %Xbyte.bit with bits 0 to 7, everything else at %Bbyte";
            self.report(Diag::new(Code::BadLayout, at.span, self.show(ty)).help(help));
            return None;
        }
        let first = u64::from(at.byte) * 8 + if unit == 1 { u64::from(at.bit) } else { 0 };
        self.check_size((first + bits) / 8, at.span).then_some(Placed { name: name.clone(), ty, first, bits })
    }

    fn check_placed(&mut self, member: &Placed, others: &[Placed], overlap: bool) {
        for other in others {
            if member.name.is(&other.name.text) {
                let diag = Diag::new(Code::DuplicateName, member.name.span, "declared again");
                return self.report(diag.also(other.name.span, "first declared"));
            }
            if !overlap && member.first < other.first + other.bits && other.first < member.first + member.bits {
                let label = format!("overlaps `{}`", other.name.text);
                return self
                    .report(Diag::new(Code::BadLayout, member.name.span, label).help("write STRUCT OVERLAP if that is meant"));
            }
        }
    }

    /// What is called or referred to can't share its bytes with something else.
    fn may_overlap(&mut self, ty: TypeId, span: Span) -> bool {
        let fits = self.is_plain_data(ty);
        if !fits {
            let label = format!("{} in a structure with addresses", self.show(ty));
            self.report(Diag::new(Code::BadLayout, span, label).help("use numbers, strings, arrays and structures of these"));
        }
        fits
    }

    fn is_plain_data(&self, ty: TypeId) -> bool {
        match self.ty(ty) {
            Type::Instance(_) => false,
            Type::Array { element, .. } => self.is_plain_data(*element),
            Type::Struct(r) => r.fields.iter().all(|f| self.is_plain_data(f.ty)),
            _ => true,
        }
    }

    fn finish_placed(&mut self, name: String, decls: &[ast::VarDecl], placed: Vec<Placed>, at: Span) -> TypeUse {
        let size = placed.iter().map(|m| (m.first + m.bits).div_ceil(8)).max().unwrap_or(0);
        if !self.check_size(size, at) {
            return self.bad_type();
        }
        let byte = self.elem(Elementary::Byte);
        let field = |m: &Placed| Field {
            name: m.name.text.clone(),
            ty: if m.bits == 1 { byte } else { m.ty },
            offset: (m.first / 8) as u32,
            section: Section::Var,
            retain: false,
        };
        let record = Record { name, fields: placed.iter().map(field).collect(), size: size as u32, align: 1 };
        let ty = self.hir.types.add(Type::Struct(record));
        for (i, m) in placed.iter().enumerate().filter(|(_, m)| m.bits == 1) {
            self.bit_members.insert((ty, i as u32), (m.first % 8) as u32);
        }
        let default = self.placed_default(ty, decls);
        self.defaults.insert(ty, default);
        self.plain(ty)
    }

    /// Initial values of members that share no bytes.
    fn placed_default(&mut self, ty: TypeId, decls: &[ast::VarDecl]) -> Const {
        let mut parts = Vec::new();
        for decl in decls {
            let used = self.type_ref(&decl.ty);
            let init = decl.init.as_ref().map_or_else(|| used.default.clone(), |i| self.initial_or_late(i, &used, false).0);
            for _ in &decl.names {
                let bit = self.bit_members.get(&(ty, parts.len() as u32)).copied();
                parts.push(shifted(init.clone(), bit));
            }
        }
        crate::hir::constant::aggregate(parts)
    }
}

/// The value of a bit within its byte.
pub(in crate::hir) fn shifted(c: Const, bit: Option<u32>) -> Const {
    match (c, bit) {
        (Const::Int(v), Some(bit)) => Const::Int((v & 1) << bit),
        (c, _) => c,
    }
}
