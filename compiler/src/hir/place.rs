//! Variables and what is reached from them: members, elements, bits, characters (§2.7, §2.8, §2.11), with the right to write them.

use super::builder::Builder;
use super::constant;
use super::convert::{Operand, constant_expr};
use super::image::Owner;
use super::model::*;
use super::scope::{Local, ReadOnly};
use super::symbols::Unit;
use crate::syntax::ast;
use takt_base::{Code, Span};
use takt_image::TypeId;
use takt_image::types::Type;

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
}
