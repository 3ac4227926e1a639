//! `ARRAY [*] OF T` (§2.7): parameters that take arrays of any bounds, and LOWER_BOUND and UPPER_BOUND.
//! A value is a descriptor: the place of the first element, then the bounds of each dimension.

use super::TypeUse;
use crate::hir::builder::Builder;
use crate::hir::convert::{Operand, constant_expr};
use crate::hir::model::*;
use crate::syntax::ast::{self, SectionKind};
use takt_base::{Code, Diag, Span};
use takt_image::types::{Dim, Type};
use takt_image::{Elementary, TypeId};

impl Builder<'_> {
    /// The type of a declaration in a section, where an array of variable length may stand.
    pub(in crate::hir) fn declared_var_type(&mut self, pou: &ast::Pou, section: &ast::VarSection, t: &ast::TypeRef) -> TypeUse {
        if let ast::TypeRefKind::String { wide, open: true, .. } = t.kind
            && section.kind == SectionKind::InOut
            && !pou.external
        {
            let capacity = super::STRING_MAX;
            let ty = self.hir.types.intern(if wide { Type::WString { capacity } } else { Type::String { capacity } });
            return TypeUse { ty, default: Const::Zero };
        }
        let ast::TypeRefKind::OpenArray { dims, element } = &t.kind else { return self.type_ref(t) };
        let function = pou.kind == ast::PouKind::Function;
        let fits = match section.kind {
            SectionKind::InOut => true,
            SectionKind::Input | SectionKind::Output => function,
            _ => false,
        };
        if !fits || pou.external {
            return self.misplaced_open(t.span);
        }
        let element = self.type_ref(element);
        if element.ty == self.error {
            return self.bad_type();
        }
        if *dims > super::array::DIMENSIONS_MAX {
            let label = format!("{dims} dimensions");
            self.error(Code::TypeTooLarge, t.span, label);
            return self.bad_type();
        }
        let ty = self.hir.types.intern(Type::Open { element: element.ty, dims: *dims as u32 });
        TypeUse { ty, default: Const::Zero }
    }

    /// `ARRAY [*]` where the bounds must be known.
    pub(super) fn misplaced_open(&mut self, span: Span) -> TypeUse {
        let help = "it may be a VAR_IN_OUT, or a parameter of a function; write the bounds everywhere else";
        self.report(Diag::new(Code::MisplacedOpenArray, span, "its length is not known here").help(help));
        self.bad_type()
    }

    /// `STRING[*]` where the length must be known.
    pub(super) fn misplaced_open_string(&mut self, span: Span) -> TypeUse {
        let help = "it may be a VAR_IN_OUT; write the length everywhere else";
        self.report(Diag::new(Code::MisplacedOpenArray, span, "its length is not known here").help(help));
        self.bad_type()
    }

    /// True for a VAR_IN_OUT that takes strings of other lengths (vendor): STRING[*] all, STRING those that are not longer. They are
    /// copied in, and back into the room that the caller's variable has.
    pub(in crate::hir) fn takes_string(&self, id: PouId, var: VarId, actual: TypeId) -> bool {
        let v = &self.hir.pous[id].vars[var];
        let (most, room) = match (self.ty(v.ty), self.ty(actual)) {
            (Type::String { capacity: a }, Type::String { capacity: b }) => (*a, *b),
            (Type::WString { capacity: a }, Type::WString { capacity: b }) => (*a, *b),
            _ => return false,
        };
        self.profile(v.span).is_codesys() && room <= most && self.line(id).iter().any(|t| self.open_strings.contains(&(*t, var)))
    }

    /// Remembers a VAR_IN_OUT string without a length.
    pub(in crate::hir) fn note_open_string(&mut self, id: PouId, var: VarId, t: &ast::TypeRef) {
        if matches!(t.kind, ast::TypeRefKind::String { capacity: None, .. }) {
            self.open_strings.insert((id, var));
        }
    }

    /// Element type and number of dimensions of an array of variable length.
    pub(in crate::hir) fn open_parts(&self, ty: TypeId) -> Option<(TypeId, u32)> {
        if let Type::Open { element, dims } = *self.ty(ty) { Some((element, dims)) } else { None }
    }

    /// True if an array of type `actual` can be given for the parameter type `open`.
    pub(in crate::hir) fn open_takes(&self, open: TypeId, actual: TypeId) -> bool {
        match (self.open_parts(open), self.ty(actual)) {
            (Some((element, count)), Type::Array { element: e, dims }) => *e == element && dims.len() == count as usize,
            _ => false,
        }
    }

    /// The array for an input of variable length: it is not copied, so it must be a variable.
    pub(in crate::hir) fn open_input(&mut self, e: &ast::Expr, ty: TypeId, note: (Span, String)) -> Option<Place> {
        let target = self.place(e)?;
        let found = target.place.ty;
        if found == self.error {
            return None;
        }
        if found != ty && !self.open_takes(ty, found) {
            let label = format!("{}, {} wanted", self.show(found), self.show(ty));
            self.report(Diag::new(Code::TypeMismatch, e.span, label).also(note.0, note.1));
            return None;
        }
        Some(target.place)
    }

    /// `LOWER_BOUND(a, 1)`, `UPPER_BOUND(a, 1)`.
    pub(in crate::hir) fn bound_of(&mut self, array: &ast::Expr, dim: &ast::Expr, upper: bool, span: Span) -> Operand {
        let number = self.const_int(dim);
        let (Some(target), Some(number)) = (self.place(array), number) else { return self.bad(span) };
        let (ty, dint) = (target.place.ty, self.elem(Elementary::Dint));
        let count = match self.ty(ty) {
            _ if ty == self.error => return self.bad(span),
            Type::Array { dims, .. } => dims.len() as u32,
            Type::Open { dims, .. } => *dims,
            _ => {
                self.error(Code::NotAnArray, array.span, self.show(ty));
                return self.bad(span);
            }
        };
        let Some(index) = u32::try_from(number).ok().filter(|n| (1..=count).contains(n)).map(|n| n - 1) else {
            let help = format!("the dimensions are 1..{count}");
            self.report(Diag::new(Code::IndexOutOfRange, dim.span, number.to_string()).help(help));
            return self.bad(span);
        };
        if let Type::Array { dims, .. } = self.ty(ty) {
            let Dim { low, high } = dims[index as usize];
            return Operand::fixed(constant_expr(Const::Int(if upper { high } else { low }.into()), dint, span));
        }
        let mut place = target.place;
        place.path.push(Step::Field(1 + 2 * index + u32::from(upper)));
        Operand::fixed(Expr { kind: ExprKind::Load(Place { ty: dint, ..place }), ty: dint, span })
    }

    /// Reports an array of variable length that is used as a whole.
    pub(in crate::hir) fn whole_open(&mut self, span: Span) -> Operand {
        let help = "use its elements, or pass it on to a parameter ARRAY [*]";
        self.report(Diag::new(Code::MisplacedOpenArray, span, "its length is not known here").help(help));
        self.bad(span)
    }
}
