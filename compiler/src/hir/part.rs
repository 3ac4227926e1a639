//! Parts of variables: members, elements, characters, bits (§2.7, §2.8, §2.11).

use super::builder::Builder;
use super::constant;
use super::model::*;
use super::place::{Access, Target};
use crate::syntax::ast;
use takt_base::{Code, Diag, Span};
use takt_image::types::{Dim, Section, Type};
use takt_image::{Elementary, TypeId};

impl Builder<'_> {
    pub(super) fn member(&mut self, base: Target, name: &ast::Name, span: Span) -> Option<Target> {
        if base.place.ty == self.error {
            return None;
        }
        let (record, instance) = match self.ty(base.place.ty) {
            Type::Struct(r) => (r, false),
            Type::Instance(r) => (r, true),
            _ => {
                if let Some(bit) = self.named_bit(&base.place, name) {
                    return self.part(base, ast::AddressSize::Bit, bit, span);
                }
                let label = format!("{} has no members", self.show(base.place.ty));
                let diag = Diag::new(Code::UnknownMember, name.span, label);
                let pointer = self.pointee(base.place.ty).is_some();
                self.report(if pointer { diag.help(format!("write ^.{}", name.text)) } else { diag });
                return None;
            }
        };
        let index = record.fields.iter().rposition(|f| name.is(&f.name) && f.section != Section::Hidden);
        let index = index.or_else(|| {
            let pin = self.vendor_pin(base.place.ty, name)?;
            record.fields.iter().rposition(|f| f.name == pin)
        });
        let Some(index) = index else {
            let known = record.fields.iter().filter(|f| f.section != Section::Hidden).map(|f| f.name.clone()).collect();
            if self.method_without_call(base.place.ty, name) {
                return None;
            }
            self.unknown(Code::UnknownMember, name, known);
            return None;
        };
        let (ty, section) = (record.fields[index].ty, record.fields[index].section);
        if instance {
            self.note_member_use(base.place.ty, index);
        }
        if section == Section::InOut {
            let help = "use the variable that is bound to it in the call";
            self.report(Diag::new(Code::UnknownMember, name.span, "a VAR_IN_OUT is not visible from outside").help(help));
            return None;
        }
        let writable = section == Section::Input || self.is_own_place(&base.place) || self.is_public_var(base.place.ty, index);
        if instance && !self.check_var_access(base.place.ty, index, name) {
            return None;
        }
        let access = match (base.access, instance && !writable) {
            (Access::Write, true) => Access::Inside,
            (access, _) => access,
        };
        let bit = self.bit_members.get(&(base.place.ty, index as u32)).copied();
        let mut place = base.place;
        place.path.push(Step::Field(index as u32));
        if let Some(bit) = bit {
            place.path.push(Step::Part { bit, width: 1 });
            return Some(Target { place: Place { ty: self.bool(), span, ..place }, access });
        }
        Some(Target { place: Place { ty, span, ..place }, access })
    }

    /// `a[i, j]`, `a[i][j]`: all indices in a row are spread over the dimensions of the types.
    pub(super) fn indexed(&mut self, e: &ast::Expr) -> Option<Target> {
        let mut lists = Vec::new();
        let mut root = e;
        while let ast::ExprKind::Index(base, list) = &root.kind {
            lists.push(list);
            root = base;
        }
        let mut target = self.place(root)?;
        let indices: Vec<&ast::Expr> = lists.into_iter().rev().flatten().collect();
        let mut rest = indices.as_slice();
        while !rest.is_empty() {
            if target.place.ty == self.error {
                return None;
            }
            target = self.through_references(target);
            let (step, ty, used) = match self.ty(target.place.ty) {
                &Type::Open { element, dims } => {
                    let any = Dim { low: i32::MIN, high: i32::MAX };
                    (self.element(&vec![any; dims as usize], rest, e.span)?, element, dims as usize)
                }
                Type::Pointer { .. } => {
                    self.codesys_form(e.span, "an index behind a pointer");
                    let index = self.index(rest[0], i32::MIN.into(), i32::MAX.into())?;
                    target = self.pointer_element(target, index, e.span)?;
                    rest = &rest[1..];
                    continue;
                }
                Type::Array { element, dims } => {
                    let (element, dims) = (*element, dims.clone());
                    (self.element(&dims, rest, e.span)?, element, dims.len())
                }
                // The vendors count from 0 and have bytes, the zero behind the last included (§2.9).
                &(Type::String { capacity } | Type::WString { capacity }) if self.profile(e.span).string_index_base() == 0 => {
                    let wide = matches!(self.ty(target.place.ty), Type::WString { .. });
                    let unit = if wide { Elementary::Word } else { Elementary::Byte };
                    (Step::Index(vec![self.index(rest[0], 0, capacity.into())?]), self.elem(unit), 1)
                }
                Type::String { capacity } => (self.character(*capacity, rest[0])?, self.elem(Elementary::Char), 1),
                Type::WString { capacity } => (self.character(*capacity, rest[0])?, self.elem(Elementary::Wchar), 1),
                _ => {
                    let label = self.show(target.place.ty);
                    self.error(Code::NotAnArray, root.span, label);
                    return None;
                }
            };
            target.place.path.push(step);
            target.place.ty = ty;
            rest = &rest[used..];
        }
        target.place.span = e.span;
        Some(target)
    }

    fn element(&mut self, dims: &[Dim], indices: &[&ast::Expr], span: Span) -> Option<Step> {
        if indices.len() < dims.len() {
            let label = format!("{} of {} indices", indices.len(), dims.len());
            self.report(Diag::new(Code::WrongArgumentCount, span, label).message("the array has more dimensions"));
            return None;
        }
        let list: Vec<Option<Expr>> = indices.iter().zip(dims).map(|(e, d)| self.index(e, d.low.into(), d.high.into())).collect();
        list.into_iter().collect::<Option<Vec<_>>>().map(Step::Index)
    }

    fn character(&mut self, capacity: u32, e: &ast::Expr) -> Option<Step> {
        Some(Step::Character(Box::new(self.index(e, 1, capacity.into())?)))
    }

    /// A subscript as DINT or LINT.
    fn index(&mut self, e: &ast::Expr, low: i128, high: i128) -> Option<Expr> {
        let place_only = std::mem::take(&mut self.place_only);
        let o = self.operand(e, None);
        self.place_only = place_only;
        let o = self.decay(o);
        if self.is_bad(&o) {
            return None;
        }
        let o = self.settle(o);
        let o = match *self.ty(o.ty) {
            Type::Enum { base, .. } if self.profile(e.span).is_codesys() => {
                let to = self.elem(base);
                self.wrap(Conversion::Integer, o, to)
            }
            _ => o,
        };
        let Some(kind) = self.elementary(o.ty).filter(|k| self.counts(*k, o.span)) else {
            let label = format!("{}, an integer wanted", self.show(o.ty));
            self.report(Diag::new(Code::TypeMismatch, e.span, label).help("an index is an integer"));
            return None;
        };
        let wide = kind.bits() < 32 || kind.widens_to(Elementary::Dint);
        let to = self.elem(if wide { Elementary::Dint } else { Elementary::Lint });
        if let ExprKind::Const(c) = &o.kind
            && let Some(value) = constant::int(c)
            && !(low..=high).contains(&value)
        {
            self.report(
                Diag::new(Code::IndexOutOfRange, e.span, value.to_string()).help(format!("the bounds are {low}..{high}")),
            );
            return None;
        }
        Some(if o.ty == to { o } else { self.wrap(Conversion::Integer, o, to) })
    }

    /// `w.cBit` (vendor): the number of a bit as a constant.
    fn named_bit(&mut self, base: &Place, name: &ast::Name) -> Option<u32> {
        let bits = self.elementary_or_base(base.ty).is_some_and(|e| e.is_int() || e.is_bit());
        let known = self.local(&name.key()).is_some() || self.global_id(name).is_some();
        if !bits || !known || !self.profile(name.span).is_codesys() {
            return None;
        }
        let e = ast::Expr { kind: ast::ExprKind::Name(name.clone()), span: name.span };
        self.const_int(&e).and_then(|v| u32::try_from(v).ok())
    }

    fn elementary_or_base(&self, ty: TypeId) -> Option<Elementary> {
        self.hir.types.storage(ty).filter(|_| self.pointee(ty).is_none())
    }

    /// `w.3`, `d.%B1`.
    pub(super) fn part(&mut self, base: Target, size: ast::AddressSize, index: u32, span: Span) -> Option<Target> {
        if base.place.ty == self.error {
            return None;
        }
        let vendor = self.profile(span).is_vendor();
        let bits = |e: &Elementary| e.is_bit() && *e != Elementary::Bool || e.is_int() && vendor;
        let whole = self.elementary_or_base(base.place.ty).filter(bits);
        let Some(whole) = whole.filter(|_| !ends_in_part(&base.place)) else {
            let help = "convert an integer to a bit string first, for example with INT_TO_WORD";
            let label = format!("{} has no bits to name", self.show(base.place.ty));
            self.report(Diag::new(Code::BadOperand, span, label).help(help));
            return None;
        };
        let part = super::image::size_type(size);
        let (width, bits) = (part.bits(), whole.bits());
        let bit = u64::from(index) * u64::from(width);
        if bit + u64::from(width) > u64::from(bits) {
            let help = format!("{} has the parts 0..{}", whole.name(), bits / width - u32::from(bits >= width));
            self.report(Diag::new(Code::IndexOutOfRange, span, index.to_string()).help(help));
            return None;
        }
        let ty = self.elem(part);
        let mut place = base.place;
        place.path.push(Step::Part { bit: bit as u32, width });
        Some(Target { place: Place { ty, span, ..place }, access: base.access })
    }
}

/// True if the place is some bits of a variable.
pub(super) fn ends_in_part(place: &Place) -> bool {
    matches!(place.path.last(), Some(Step::Part { .. }))
}
