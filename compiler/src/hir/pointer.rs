//! Pointers (vendor, §2.10): arithmetic in bytes, comparison, `p[i]`, ADR, SIZEOF, conversion to and from numbers.

use super::builder::Builder;
use super::convert::{Flex, Operand, constant_expr};
use super::lattice::is_number;
use super::model::*;
use super::place::Target;
use crate::syntax::ast::{self, BinaryOp};
use takt_base::{Code, Diag, Span};
use takt_image::types::PointerKind;
use takt_image::{Elementary, TypeId};

impl Builder<'_> {
    /// REF, ADR, SIZEOF and the like, which no catalogue can describe; `None` if the name is another.
    pub(super) fn special_call(&mut self, name: &ast::Name, args: &[ast::Arg], span: Span) -> Option<Operand> {
        let key = name.key();
        if self.local(&key).is_some() || self.unit(name).is_some() {
            return None;
        }
        if matches!(&*key, "LOWER_BOUND" | "UPPER_BOUND") {
            use ast::Arg::{Input, Positional};
            let [Positional(array) | Input { value: Some(array), .. }, Positional(dim) | Input { value: Some(dim), .. }] = args
            else {
                let label = format!("{key} has two arguments: an array and the number of a dimension");
                self.error(Code::WrongArgumentCount, span, label);
                return Some(self.bad(span));
            };
            return Some(self.bound_of(array, dim, key == "UPPER_BOUND", span));
        }
        if let Some(o) = self.query_call(&key, args, name.span, span) {
            return Some(o);
        }
        let one = match args {
            [ast::Arg::Positional(e) | ast::Arg::Input { value: Some(e), .. }] => Some(e),
            _ => None,
        };
        if !matches!(&*key, "REF" | "ADR" | "SIZEOF" | "__ISVALIDREF") {
            return None;
        }
        let Some(e) = one else {
            let label = format!("{key} has one argument");
            self.error(Code::WrongArgumentCount, span, label);
            return Some(self.bad(span));
        };
        if key != "REF" {
            self.codesys_form(name.span, &key);
        }
        Some(match &*key {
            "REF" => self.ref_of(e, span),
            "ADR" => self.adr(e, span),
            "SIZEOF" => self.size_of(e, span),
            _ => self.is_valid_reference(e, span),
        })
    }

    fn adr(&mut self, e: &ast::Expr, span: Span) -> Operand {
        let Some(place) = self.referable(e) else { return self.bad(span) };
        if let Some((element, _)) = self.open_parts(place.ty) {
            return self.start_of(place, element, span);
        }
        let ty = self.pointer_to(PointerKind::Pointer, place.ty);
        Operand::fixed(Expr { kind: ExprKind::Address(place), ty, span })
    }

    /// The place of the first element of an array of variable length.
    fn start_of(&mut self, mut place: Place, element: TypeId, span: Span) -> Operand {
        let (udint, ty) = (self.elem(Elementary::Udint), self.pointer_to(PointerKind::Pointer, element));
        place.path.push(Step::Field(0));
        let load = Expr { kind: ExprKind::Load(Place { ty: udint, ..place }), ty: udint, span };
        Operand::fixed(self.wrap(Conversion::Integer, load, ty))
    }

    /// Bytes of a variable or type.
    fn size_of(&mut self, e: &ast::Expr, span: Span) -> Operand {
        let ty = match &e.kind {
            ast::ExprKind::Name(n) if !self.names_variable(n) && self.names_type(n) => self.named_type(n).ty,
            _ => match self.qualified(e).filter(|n| self.unit(n).is_some()) {
                Some(n) => self.named_type(&n).ty,
                None => self.operand(e, None).expr.ty,
            },
        };
        if ty == self.error {
            return self.bad(span);
        }
        let size = self.hir.types.layout(ty).size;
        self.flex_int(size.into(), true, span)
    }

    fn names_type(&self, n: &ast::Name) -> bool {
        Elementary::from_name(&n.text).is_some() || self.unit(n).is_some()
    }

    fn is_valid_reference(&mut self, e: &ast::Expr, span: Span) -> Operand {
        let Some(target) = self.raw_place(e) else { return self.bad(span) };
        if self.pointee(target.place.ty).is_none() {
            let label = format!("{}, a REFERENCE TO wanted", self.show(target.place.ty));
            self.error(Code::NotAReference, e.span, label);
            return self.bad(span);
        }
        let ty = target.place.ty;
        let load = Expr { kind: ExprKind::Load(target.place), ty, span };
        let null = constant_expr(Const::Int(0), ty, span);
        let bool = self.bool();
        Operand::fixed(Expr { kind: ExprKind::Binary(BinaryOp::Ne, Box::new(load), Box::new(null)), ty: bool, span })
    }

    /// An operator with a pointer on a side; `None` if there is none.
    pub(super) fn pointer_operator(&mut self, op: BinaryOp, a: &Operand, b: &Operand, span: Span) -> Option<Operand> {
        let pointer = |b: &Self, o: &Operand| b.pointee(o.expr.ty).filter(|p| p.1 == PointerKind::Pointer).map(|_| o.expr.ty);
        let (pa, pb) = (pointer(self, a), pointer(self, b));
        let one = pa.or(pb)?;
        let udint = self.elem(Elementary::Udint);
        let (Some(x), Some(y)) = (self.address_number(a), self.address_number(b)) else {
            let label = format!("{} {} {}", self.show(a.expr.ty), op.text(), self.show(b.expr.ty));
            let help = "a pointer goes with pointers and integers";
            self.report(Diag::new(Code::NoCommonType, span, label).help(help));
            return Some(self.bad(span));
        };
        let result = self.combine(op, Operand::fixed(x), Operand::fixed(y), span, None);
        let moved = matches!(op, BinaryOp::Add) || op == BinaryOp::Sub && pb.is_none();
        if self.is_bad(&result) || result.expr.ty != udint || !moved {
            return Some(result);
        }
        Some(Operand::fixed(self.wrap(Conversion::Integer, result.expr, one)))
    }

    /// A pointer or an integer as an offset.
    fn address_number(&mut self, o: &Operand) -> Option<Expr> {
        let udint = self.elem(Elementary::Udint);
        let o = self.decay(o.clone());
        let number = match (o.flex, &o.expr.kind) {
            (Flex::Int { .. }, ExprKind::Const(_)) => true,
            _ => self.pointee(o.expr.ty).is_some() || self.elementary(o.expr.ty).is_some_and(is_number),
        };
        number.then(|| if o.expr.ty == udint { o.expr } else { self.wrap(Conversion::Integer, o.expr, udint) })
    }

    /// `p[i]`: what lies `i` elements behind.
    pub(super) fn pointer_element(&mut self, pointer: Target, index: Expr, span: Span) -> Option<Target> {
        let ty = pointer.place.ty;
        let (element, _) = self.pointee(ty)?;
        let udint = self.elem(Elementary::Udint);
        let size = constant_expr(Const::Int(self.hir.types.layout(element).size.into()), udint, span);
        let load = Expr { kind: ExprKind::Load(pointer.place), ty, span };
        let start = self.wrap(Conversion::Integer, load, udint);
        let index = self.wrap(Conversion::Integer, index, udint);
        let binary = |op, a, b| Expr { kind: ExprKind::Binary(op, Box::new(a), Box::new(b)), ty: udint, span };
        let sum = binary(BinaryOp::Add, start, binary(BinaryOp::Mul, index, size));
        let sum = self.wrap(Conversion::Integer, sum, ty);
        self.follow(sum, span)
    }

    /// The value as one of type `to`, if one of the two is a pointer.
    pub(super) fn convert_pointer(&mut self, e: &Expr, to: TypeId) -> Option<Expr> {
        let (from_pointer, to_pointer) = (self.pointee(e.ty), self.pointee(to));
        let number = |b: &Self, ty| b.elementary(ty).filter(|k| is_number(*k));
        let fits = match (from_pointer, to_pointer) {
            (Some(_), Some(_)) => self.reference_fits(e.ty, to),
            (Some((_, PointerKind::Pointer)), None) => number(self, to).is_some_and(|k| k.bytes() >= 4),
            (None, Some((_, PointerKind::Pointer))) => number(self, e.ty).is_some(),
            _ => false,
        };
        fits.then(|| self.wrap(Conversion::Integer, e.clone(), to))
    }
}
