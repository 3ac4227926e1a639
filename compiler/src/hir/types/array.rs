//! ARRAY types: up to eight dimensions with constant bounds (§2.7).

use super::TypeUse;
use crate::hir::builder::Builder;
use crate::hir::constant;
use crate::hir::model::*;
use crate::hir::symbols::Unit;
use crate::syntax::ast;
use takt_base::{Code, Diag, Span};
use takt_image::TypeId;
use takt_image::types::{Dim, Type};

/// Most dimensions of an array.
pub(super) const DIMENSIONS_MAX: usize = 8;

impl Builder<'_> {
    /// `ARRAY [low..high, ..] OF element`.
    pub(super) fn array_type(&mut self, dims: &[(ast::Expr, ast::Expr)], element: &ast::TypeRef, at: Span) -> TypeUse {
        let bounds: Vec<Option<Dim>> = dims.iter().map(|(low, high)| self.dim(low, high)).collect();
        let element = self.type_ref(element);
        let bounds: Option<Vec<Dim>> = bounds.into_iter().collect();
        let Some(dims) = bounds else { return self.bad_type() };
        if element.ty == self.error || !self.check_dimensions(&dims, at) {
            return self.bad_type();
        }
        let count = dims.iter().fold(1u64, |n, d| n.saturating_mul(u64::from(d.len())));
        let bytes = count.saturating_mul(u64::from(self.hir.types.layout(element.ty).size));
        if !self.check_size(bytes.max(count), at) {
            return self.bad_type();
        }
        let ty = self.hir.types.intern(Type::Array { element: element.ty, dims });
        TypeUse { ty, default: self.repeated(&element.default, count, at) }
    }

    fn check_dimensions(&mut self, dims: &[Dim], at: Span) -> bool {
        let fits = !dims.is_empty() && dims.len() <= DIMENSIONS_MAX;
        if !fits {
            let label = format!("{} dimensions", dims.len());
            self.report(Diag::new(Code::TypeTooLarge, at, label).help(format!("an array has 1 to {DIMENSIONS_MAX} dimensions")));
        }
        fits
    }

    fn dim(&mut self, low: &ast::Expr, high: &ast::Expr) -> Option<Dim> {
        if let Some(all) = self.enum_range(low, high) {
            return Some(all);
        }
        let lo = self.bound(low);
        let hi = self.bound(high);
        let (lo, hi) = (lo?, hi?);
        if lo > hi {
            let help = "write the smaller bound first";
            self.report(Diag::new(Code::OutOfRange, low.span.to(high.span), format!("{lo} is above {hi}")).help(help));
            return None;
        }
        let elements = i64::from(hi) - i64::from(lo) + 1;
        if u32::try_from(elements).is_err() {
            self.check_size(elements as u64, low.span.to(high.span));
            return None;
        }
        Some(Dim { low: lo, high: hi })
    }

    /// All values of an enumeration whose name stands for the bounds (vendor).
    fn enum_range(&mut self, low: &ast::Expr, high: &ast::Expr) -> Option<Dim> {
        let ast::ExprKind::Name(n) = &low.kind else { return None };
        let known = matches!(self.unit(n), Some((Unit::Type(_), _)));
        if low.span != high.span || !known {
            return None;
        }
        let ty = self.named_type(n).ty;
        let Type::Enum { values, .. } = self.ty(ty) else { return None };
        let numbers = || values.iter().map(|v| v.1);
        let (low, high) = (i32::try_from(numbers().min()?).ok()?, i32::try_from(numbers().max()?).ok()?);
        Some(Dim { low, high })
    }

    fn bound(&mut self, e: &ast::Expr) -> Option<i32> {
        let value = self.const_int(e)?;
        let bound = i32::try_from(value).ok();
        if bound.is_none() {
            self.report(Diag::new(Code::OutOfRange, e.span, value.to_string()).help("a bound is a DINT"));
        }
        bound
    }

    /// An array whose elements all start as `default`.
    fn repeated(&mut self, default: &Const, count: u64, at: Span) -> Const {
        if constant::is_zero(default) {
            return Const::Zero;
        }
        let leaves = count.saturating_mul(constant::leaves(default) as u64);
        if !self.charge(usize::try_from(leaves).unwrap_or(usize::MAX), at) {
            return Const::Zero;
        }
        Const::Aggregate(vec![default.clone(); count as usize])
    }

    /// Element type and number of elements of an array type.
    pub fn array_parts(&self, ty: TypeId) -> Option<(TypeId, Vec<Dim>)> {
        if let Type::Array { element, dims } = self.ty(ty) { Some((*element, dims.clone())) } else { None }
    }
}
