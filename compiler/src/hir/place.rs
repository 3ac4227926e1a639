//! Variables and what is reached from them: members, elements, bits, characters (§2.7, §2.8, §2.11), with the right to write them.

use super::builder::Builder;
use super::constant;
use super::convert::{Operand, constant_expr};
use super::image::Owner;
use super::model::*;
use super::scope::{Local, ReadOnly};
use super::symbols::Unit;
use crate::syntax::ast;
use takt_base::{Code, Diag, Span};
use takt_image::types::{Dim, Section, Type};
use takt_image::{Elementary, TypeId};

/// What may be done to a place.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Access {
    Write,
    /// CONSTANT, declared there.
    Constant(Span),
    /// VAR_INPUT of the unit itself.
    OwnInput(Span),
    /// Output or variable of a function block, seen from outside.
    Inside,
    /// %I.
    InputImage,
}

/// A place with its rights.
#[derive(Clone, Debug)]
pub(super) struct Target {
    pub place: Place,
    pub access: Access,
}

impl Builder<'_> {
    /// The value of a place; constants at once.
    pub fn read(&mut self, e: &ast::Expr) -> Operand {
        let Some(target) = self.place(e) else { return self.bad(e.span) };
        let (ty, span) = (target.place.ty, e.span);
        if ty == self.error {
            return self.bad(span);
        }
        if self.open_parts(ty).is_some() {
            return self.whole_open(span);
        }
        if !matches!(self.ty(ty), Type::Array { .. } | Type::Struct(_) | Type::Instance(_))
            && let Some(c) = self.constant_at(&target.place)
        {
            let c = if self.is_string(ty) { c } else { self.scalar_zero(c, ty) };
            return Operand::fixed(constant_expr(c, ty, span));
        }
        Operand::fixed(Expr { kind: ExprKind::Load(target.place), ty, span })
    }

    /// `Zero` spelt out as the type's own zero.
    fn scalar_zero(&self, c: Const, ty: TypeId) -> Const {
        match (c, self.hir.types.storage(ty)) {
            (Const::Zero, Some(e)) if e.is_real() => Const::Real(0.0),
            (Const::Zero, Some(_)) => Const::Int(0),
            (c, _) => c,
        }
    }

    /// The value of a CONSTANT or a part of it.
    pub fn constant_at(&self, place: &Place) -> Option<Const> {
        let value = match place.base {
            Base::Value(_) => return None,
            Base::Global(id) if self.is_undecided(id) => return None,
            Base::Global(id) => Some(&self.hir.globals[id]).filter(|g| g.constant).map(|g| &g.init)?,
            Base::Var(id) => {
                let constant = self.scope.read_only.get(&id) == Some(&ReadOnly::Constant);
                constant.then(|| self.scope.pou.map(|p| &self.hir.pous[p].vars[id].init)).flatten()?
            }
            Base::This => return self.member_constant(place),
            Base::Image(_) => return None,
        };
        self.constant_part(value, self.base_type(&place.base)?, &place.path)
    }

    /// The part of a constant of type `ty` to which the steps lead.
    pub(super) fn constant_part(&self, mut value: &Const, mut ty: TypeId, path: &[Step]) -> Option<Const> {
        for step in path {
            let (index, next) = self.step_into(ty, step)?;
            ty = next;
            value = match value {
                Const::Aggregate(parts) => parts.get(index)?,
                Const::Zero => &Const::Zero,
                _ => return None,
            };
        }
        Some(value.clone())
    }

    fn base_type(&self, base: &Base) -> Option<TypeId> {
        match *base {
            Base::Global(id) => Some(self.hir.globals[id].ty),
            Base::Var(id) => Some(self.hir.pous[self.scope.pou?].vars[id].ty),
            Base::This => self.hir.pous[self.own_type()?].instance,
            Base::Image(_) | Base::Value(_) => None,
        }
    }

    /// Position of the part in its whole, and its type.
    pub fn step_into(&self, ty: TypeId, step: &Step) -> Option<(usize, TypeId)> {
        match (step, self.ty(ty)) {
            (Step::Field(i), Type::Struct(r) | Type::Instance(r)) => Some((*i as usize, r.fields.get(*i as usize)?.ty)),
            (Step::Index(list), Type::Array { element, dims }) => {
                let mut flat = 0usize;
                for (e, dim) in list.iter().zip(dims) {
                    let ExprKind::Const(c) = &e.kind else { return None };
                    let offset = constant::int(c)?.checked_sub(dim.low.into())?;
                    flat = flat.checked_mul(dim.len() as usize)?.checked_add(usize::try_from(offset).ok()?)?;
                }
                Some((flat, *element))
            }
            _ => None,
        }
    }

    /// The place that stands there; `None` if it is none and that has been reported.
    pub fn place(&mut self, e: &ast::Expr) -> Option<Target> {
        let target = self.raw_place(e)?;
        Some(self.through_references(target))
    }

    /// Like [`Self::place`], but a REFERENCE TO is the variable that holds it.
    pub fn raw_place(&mut self, e: &ast::Expr) -> Option<Target> {
        self.deeper(e.span, |b| b.place_kind(e)).flatten()
    }

    fn place_kind(&mut self, e: &ast::Expr) -> Option<Target> {
        match &e.kind {
            ast::ExprKind::Name(n) => self.variable(n),
            ast::ExprKind::Direct(a) => self.direct(a),
            ast::ExprKind::Member(base, name) => {
                if let Some(full) = self.qualified(e).filter(|n| self.global_id(n).is_some()) {
                    return self.variable(&full);
                }
                if self.gives_reference(e) {
                    return self.computed_place(e.span, |b| b.property_read(e).unwrap_or_else(|| b.bad(e.span)));
                }
                let full = self.qualified(base).filter(|n| self.named_program(n).is_some());
                let base = match full {
                    Some(full) => self.variable(&full)?,
                    None => self.place(base)?,
                };
                self.member(base, name, e.span)
            }
            ast::ExprKind::Deref(base) => self.deref(base, e.span),
            ast::ExprKind::Index(..) => self.indexed(e),
            ast::ExprKind::Part { base, size, index } => {
                let base = self.place(base)?;
                self.part(base, *size, *index, e.span)
            }
            ast::ExprKind::Call { callee, args } => self.computed_place(e.span, |b| b.call(callee, args, e.span, None)),
            ast::ExprKind::Error => None,
            _ => {
                self.no_place(e.span);
                None
            }
        }
    }

    fn variable(&mut self, n: &ast::Name) -> Option<Target> {
        self.note_use(n);
        let id = match self.local(&n.key()) {
            Some(Local::Var(id)) => return Some(self.own_variable(id, n.span)),
            Some(Local::Member(id)) => return self.own_member(id, n),
            Some(Local::External(id)) => id,
            None if self.is_this(n) => return self.this_place(n),
            None => match self.global(n) {
                Some(id) => id,
                None => {
                    if let Some(program) = self.program_place(n) {
                        return program;
                    }
                    self.no_variable(n);
                    return None;
                }
            },
        };
        if !(self.ensure_global(id) || self.place_only && self.hir.globals[id].ty != self.error) {
            let label = format!("the value of `{}` depends on itself", n.text);
            self.error(Code::NotConstant, n.span, label);
            return None;
        }
        self.note_global(id, n.span);
        let global = &self.hir.globals[id];
        let access = match () {
            () if global.constant => Access::Constant(global.span),
            () if self.image.area_of_global(id) == Some(ast::Area::Input) => Access::InputImage,
            () if self.image.open_area(Owner::Global(id)) == Some(ast::Area::Input) => Access::InputImage,
            () => Access::Write,
        };
        Some(Target { place: Place { base: Base::Global(id), path: Vec::new(), ty: global.ty, span: n.span }, access })
    }

    fn own_variable(&mut self, id: VarId, span: Span) -> Target {
        let pou = self.scope.pou.unwrap_or(PouId(0));
        let var = &self.hir.pous[pou].vars[id];
        let access = match self.scope.read_only.get(&id) {
            Some(ReadOnly::Constant) => Access::Constant(var.span),
            Some(ReadOnly::Input) => Access::OwnInput(var.span),
            None if self.image.area_of_var(pou, id) == Some(ast::Area::Input) => Access::InputImage,
            None if self.image.open_area(Owner::Var(pou, id)) == Some(ast::Area::Input) => Access::InputImage,
            None => Access::Write,
        };
        Target { place: Place { base: Base::Var(id), path: Vec::new(), ty: var.ty, span }, access }
    }

    fn no_variable(&mut self, n: &ast::Name) {
        let what = match self.unit(n) {
            Some((Unit::Type(_), _)) => Some("a type"),
            Some((Unit::Pou(id), _)) => Some(match self.hir.pous[id].kind {
                PouKind::Function => "a function: call it with ( )",
                PouKind::FunctionBlock => "a function block: declare an instance of it",
                PouKind::Class => "a class: declare an instance of it",
                PouKind::Interface => "an interface: declare a variable of it",
                PouKind::Program | PouKind::Method => "a program",
            }),
            None if takt_stdlib::lookup(&n.text).is_some() => Some("a standard function: call it with ( )"),
            None => None,
        };
        match what {
            Some(what) => self.error(Code::NotAVariable, n.span, what),
            None if self.needs_list(n) => {}
            None if self.scope.unknown.insert(n.key()) => {
                let known = self.value_names();
                self.unknown(Code::UnknownName, n, known);
            }
            None => {}
        }
    }

    fn member(&mut self, base: Target, name: &ast::Name, span: Span) -> Option<Target> {
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
    fn indexed(&mut self, e: &ast::Expr) -> Option<Target> {
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
    fn part(&mut self, base: Target, size: ast::AddressSize, index: u32, span: Span) -> Option<Target> {
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
