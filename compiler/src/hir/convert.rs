//! Implicit conversions (§2.3): a value becomes a value of the wanted type, written out as [`ExprKind::Convert`], or a report.
//! Untyped literals take the wanted type exactly or not at all (§1.5).

use super::builder::Builder;
use super::constant;
use super::lattice::{self, Fit};
use super::model::*;
use takt_base::{Code, Diag, Severity, Span};
use takt_image::types::{PointerKind, Type};
use takt_image::{Elementary, TypeId};
use takt_stdlib::ConversionType;

/// How much freedom an expression's type has.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Flex {
    /// It has the type that it has.
    Fixed,
    /// A constant made of untyped integers; `based`: it also fits bit strings.
    Int { based: bool },
    /// A constant made of untyped reals.
    Real,
    /// A string literal, which is also a character if it is one long.
    Text,
}

/// An expression whose type is not settled yet.
#[derive(Clone, Debug)]
pub(super) struct Operand {
    pub expr: Expr,
    pub flex: Flex,
}

impl Operand {
    /// A typed expression.
    pub fn fixed(expr: Expr) -> Self {
        Self { expr, flex: Flex::Fixed }
    }
}

/// What is unusual about a conversion that is made all the same.
#[derive(Clone, Copy, Debug)]
pub(super) enum Notice {
    /// A value is cut from the one type to the other (vendor).
    Narrowed(Span, TypeId, TypeId),
    /// A decimal number where bits are wanted.
    DecimalBits(Span, TypeId),
    /// A string literal is cut (vendor).
    Cut(Span, TypeId),
}

/// Why a value does not fit.
enum Misfit {
    /// A constant outside of the range.
    Range,
    /// Other types.
    Type,
}

impl Builder<'_> {
    /// Stands for something wrong that has been reported.
    pub fn bad(&self, span: Span) -> Operand {
        Operand::fixed(Expr { kind: ExprKind::Const(Const::Zero), ty: self.error, span })
    }
    /// True if it stands for something wrong.
    pub fn is_bad(&self, o: &Operand) -> bool {
        o.expr.ty == self.error
    }

    /// The operand as a value of `to`; reports if it is not one.
    pub fn fit(&mut self, o: Operand, to: TypeId) -> Expr {
        self.fit_for(o, to, None)
    }

    /// Like [`Self::fit`]; the note says what wants the type.
    pub fn fit_for(&mut self, o: Operand, to: TypeId, note: Option<(Span, String)>) -> Expr {
        let (span, ty, flex) = (o.expr.span, o.expr.ty, o.flex);
        self.notices.clear();
        match self.convert(o, to) {
            Ok(e) => {
                self.report_notices();
                e
            }
            Err(why) => {
                let diag = self.misfit(why, span, ty, flex, to);
                let diag = note.into_iter().fold(diag, |d, (at, text)| d.also(at, text));
                self.report(diag);
                self.bad(span).expr
            }
        }
    }

    /// Reports what was unusual about the last conversion.
    fn report_notices(&mut self) {
        for notice in std::mem::take(&mut self.notices) {
            let diag = match notice {
                Notice::Narrowed(span, from, to) => {
                    let label = format!("{}, narrowed to {}", self.show(from), self.show(to));
                    let diag = Diag::new(Code::Narrowing, span, label).message("a value is narrowed without a conversion");
                    diag.help("convert it with a function to say that this is meant")
                }
                Notice::DecimalBits(span, to) => {
                    let (target, text) = (self.show(to), self.sources.text(span));
                    let diag = Diag::new(Code::TypeMismatch, span, format!("a decimal number, {target} wanted"));
                    let diag = diag.message("a decimal number stands for a pattern of bits");
                    diag.help(format!("write {target}#{text}, or a based number such as 16#FF"))
                }
                Notice::Cut(span, to) => {
                    let diag = Diag::new(Code::OutOfRange, span, format!("cut to {}", self.show(to)));
                    diag.message("this string is longer than its variable").help("make the variable longer")
                }
            };
            self.report(diag.severity(Severity::Warning));
        }
    }

    /// A duration as its milliseconds, or back (vendor): as the conversion function does it.
    fn duration_or_number(&mut self, e: Expr, to: Elementary) -> Expr {
        let from = self.elementary(e.ty).unwrap_or(to);
        self.convert_to(e, ConversionType::Elementary(from), ConversionType::Elementary(to), false)
    }

    /// True if the operand can become a `to` without a report.
    pub fn fits(&mut self, o: &Operand, to: TypeId) -> bool {
        self.convert(o.clone(), to).is_ok()
    }

    fn misfit(&self, why: Misfit, span: Span, from: TypeId, flex: Flex, to: TypeId) -> Diag {
        let target = self.show(to);
        match why {
            Misfit::Range => {
                let label = format!("outside of {target}");
                Diag::new(Code::OutOfRange, span, label).help(self.range_help(to))
            }
            Misfit::Type if flex != Flex::Fixed => Diag::new(Code::TypeMismatch, span, format!("a literal, {target} wanted")),
            Misfit::Type => self.mismatch(span, from, to),
        }
    }

    fn range_help(&self, to: TypeId) -> String {
        match (self.ty(to), self.hir.types.storage(to).and_then(Elementary::int_range)) {
            (Type::Subrange { low, high, .. }, _) => format!("write a value from {low} to {high}"),
            (_, Some((low, high))) => format!("write a value from {low} to {high}"),
            (Type::String { capacity } | Type::WString { capacity }, _) => format!("there is room for {capacity} characters"),
            _ => "write a smaller number".to_owned(),
        }
    }

    fn mismatch(&self, span: Span, from: TypeId, to: TypeId) -> Diag {
        let (source, target) = (self.show(from), self.show(to));
        let (a, b) = (self.hir.types.storage(from), self.hir.types.storage(to));
        let narrowing = matches!((a, b), (Some(a), Some(b)) if b.widens_to(a) && self.is_plain(from) && self.is_plain(to));
        let code = if narrowing { Code::Narrowing } else { Code::TypeMismatch };
        let diag = Diag::new(code, span, format!("{source}, {target} wanted"));
        let name = |e: Option<Elementary>, ty: TypeId| match self.ty(ty) {
            Type::String { .. } => Some("STRING"),
            Type::WString { .. } => Some("WSTRING"),
            _ => e.filter(|_| self.is_plain(ty)).map(Elementary::name),
        };
        let call = name(a, from).zip(name(b, to)).map(|(a, b)| format!("{a}_TO_{b}"));
        match call.filter(|c| takt_stdlib::lookup(c).is_some()) {
            Some(call) => diag.help(format!("write {call}({})", self.sources.text(span))),
            None => diag.help(format!("there is no conversion from {source} to {target}")),
        }
    }

    /// Elementary or a subrange of it.
    fn is_plain(&self, ty: TypeId) -> bool {
        matches!(self.ty(ty), Type::Elementary(_) | Type::Subrange { .. })
    }

    /// A subrange as its base, a named value as its number: what operators work on.
    pub fn decay(&mut self, o: Operand) -> Operand {
        let (base, how) = match self.ty(o.expr.ty) {
            Type::Subrange { base, .. } => (*base, Conversion::Subrange),
            Type::Enum { base, .. } if self.named_values.contains(&o.expr.ty) => (*base, Conversion::Integer),
            _ => return o,
        };
        let to = self.elem(base);
        Operand { expr: self.wrap(how, o.expr, to), flex: o.flex }
    }

    /// `expr` converted; constants at once.
    pub fn wrap(&mut self, how: Conversion, expr: Expr, to: TypeId) -> Expr {
        let span = expr.span;
        if let ExprKind::Const(c) = &expr.kind
            && !self.unfolded
            && let Some(c) = self.fold_conversion(how, c, expr.ty, to)
        {
            return Expr { kind: ExprKind::Const(c), ty: to, span };
        }
        Expr { kind: ExprKind::Convert(how, Box::new(expr)), ty: to, span }
    }

    fn convert(&mut self, o: Operand, to: TypeId) -> Result<Expr, Misfit> {
        if o.expr.ty == self.error || to == self.error {
            return Ok(self.bad(o.expr.span).expr);
        }
        if let Type::Subrange { base, low, high, .. } = *self.ty(to)
            && o.expr.ty != to
        {
            let base = self.elem(base);
            let inner = self.convert(o, base)?;
            return match &inner.kind {
                ExprKind::Const(c) if constant::int(c).is_some_and(|v| v < low || v > high) => Err(Misfit::Range),
                _ => Ok(self.wrap(Conversion::Subrange, inner, to)),
            };
        }
        match o.flex {
            Flex::Int { based } => self.place_int(o.expr, based, to),
            Flex::Real => self.place_real(o.expr, to),
            Flex::Text => self.place_text(o.expr, to),
            Flex::Fixed => self.widen(o, to),
        }
    }

    fn place_int(&mut self, e: Expr, based: bool, to: TypeId) -> Result<Expr, Misfit> {
        let value = match &e.kind {
            ExprKind::Const(c) => constant::int(c).ok_or(Misfit::Type)?,
            _ => return Err(Misfit::Type),
        };
        if self.is_codesys_null(&e) && matches!(self.ty(to), Type::Reference { .. }) {
            return Ok(constant_expr(Const::Int(0), to, e.span));
        }
        let target = self.number_of(to).ok_or(Misfit::Type)?;
        if target.is_real() {
            let real = constant::round(target, value as f64);
            return Ok(constant_expr(Const::Real(real), to, e.span));
        }
        // A decimal number is not a pattern of bits in the standard; 0 and 1 are BOOL.
        let vendor = self.profile(e.span).is_vendor();
        if target.is_bit() && target != Elementary::Bool && !based && !vendor {
            self.notices.push(Notice::DecimalBits(e.span, to));
        }
        if !(target.is_int() || target.is_bit()) {
            return Err(Misfit::Type);
        }
        // A based number may fill the whole width of a signed type: 16#FFFF is -1 (vendor).
        let fills = vendor && based && value >= 0 && value < 1 << target.bits();
        let value = if fills { constant::low_bits(value, target) } else { value };
        let value = constant::checked(target, value).map_err(|_| Misfit::Range)?;
        Ok(constant_expr(value, to, e.span))
    }

    /// Elementary type of numbers that may stand for a `ty`.
    fn number_of(&self, ty: TypeId) -> Option<Elementary> {
        match self.ty(ty) {
            Type::Elementary(e) => Some(*e),
            Type::Enum { base, .. } if self.named_values.contains(&ty) => Some(*base),
            Type::Pointer { kind: PointerKind::Pointer, .. } => Some(Elementary::Udint),
            _ => None,
        }
    }

    fn place_real(&mut self, e: Expr, to: TypeId) -> Result<Expr, Misfit> {
        let value = match &e.kind {
            ExprKind::Const(c) => constant::real(c).ok_or(Misfit::Type)?,
            _ => return Err(Misfit::Type),
        };
        let target = self.elementary(to).filter(|t| t.is_real()).ok_or(Misfit::Type)?;
        let rounded = constant::round(target, value);
        if rounded.is_infinite() && value.is_finite() {
            return Err(Misfit::Range);
        }
        Ok(constant_expr(Const::Real(rounded), to, e.span))
    }

    fn place_text(&mut self, e: Expr, to: TypeId) -> Result<Expr, Misfit> {
        let ExprKind::Const(c) = &e.kind else { return Err(Misfit::Type) };
        let (length, first, wide) = match c {
            Const::String(s) => (s.len(), s.first().map(|&b| u32::from(b)), false),
            Const::WString(s) => (s.len(), s.first().map(|&u| u32::from(u)), true),
            _ => (0, None, matches!(self.ty(e.ty), Type::WString { .. })),
        };
        let capacity = match (self.ty(to), wide) {
            (Type::Elementary(Elementary::Char), false) | (Type::Elementary(Elementary::Wchar), true) => {
                let code = first.filter(|_| length == 1).ok_or(Misfit::Type)?;
                return Ok(constant_expr(Const::Int(code.into()), to, e.span));
            }
            (Type::String { capacity }, false) | (Type::WString { capacity }, true) => *capacity,
            _ => return Err(Misfit::Type),
        };
        if length <= capacity as usize {
            return Ok(constant_expr(c.clone(), to, e.span));
        }
        if !self.profile(e.span).is_vendor() {
            return Err(Misfit::Range);
        }
        self.notices.push(Notice::Cut(e.span, to));
        Ok(constant_expr(cut(c, capacity as usize), to, e.span))
    }

    fn widen(&mut self, o: Operand, to: TypeId) -> Result<Expr, Misfit> {
        if o.expr.ty == to {
            return Ok(o.expr);
        }
        if let Some(e) = self.interface_value(&o.expr, to) {
            return Ok(e);
        }
        if self.pointee(o.expr.ty).is_some() || self.pointee(to).is_some() {
            return self.convert_pointer(&o.expr, to).ok_or(Misfit::Type);
        }
        if let Some(e) = self.widen_text(&o.expr, to)? {
            return Ok(e);
        }
        let o = self.decay(o);
        let (Some(from), Some(target)) = (self.elementary(o.expr.ty), self.number_of(to)) else { return Err(Misfit::Type) };
        match lattice::fit(self.profile(o.expr.span), from, target) {
            Fit::Whole => {}
            Fit::Narrowed if self.is_made_of(&o.expr, target) => {}
            Fit::Narrowed => self.notices.push(Notice::Narrowed(o.expr.span, o.expr.ty, to)),
            Fit::Duration => return Ok(self.duration_or_number(o.expr, target)),
            Fit::No if self.profile(o.expr.span).is_vendor() && self.is_made_of(&o.expr, target) => {}
            Fit::No => return Err(Misfit::Type),
        }
        let how = match (from.is_real(), target.is_real()) {
            (true, true) => Conversion::Real,
            (false, true) => Conversion::IntToReal,
            _ => Conversion::Integer,
        };
        Ok(if o.expr.ty == to { o.expr } else { self.wrap(how, o.expr, to) })
    }

    /// STRING to STRING of any capacity, which the assignment cuts; CHAR to STRING.
    fn widen_text(&mut self, e: &Expr, to: TypeId) -> Result<Option<Expr>, Misfit> {
        let (wide, capacity) = match *self.ty(to) {
            Type::String { capacity } => (false, capacity),
            Type::WString { capacity } => (true, capacity),
            _ => return Ok(None),
        };
        match (self.ty(e.ty), wide) {
            (Type::String { .. }, false) | (Type::WString { .. }, true) => match &e.kind {
                ExprKind::Const(c) if text_length(c) > capacity as usize => Err(Misfit::Range),
                ExprKind::Const(c) => Ok(Some(constant_expr(c.clone(), to, e.span))),
                _ => Ok(Some(e.clone())),
            },
            (Type::Elementary(Elementary::Char), false) | (Type::Elementary(Elementary::Wchar), true) => {
                Ok(Some(self.wrap(Conversion::String, e.clone(), to)))
            }
            _ => Err(Misfit::Type),
        }
    }
}

/// The first characters of a constant string.
fn cut(c: &Const, length: usize) -> Const {
    match c {
        Const::String(s) => Const::String(s[..length.min(s.len())].to_vec()),
        Const::WString(s) => Const::WString(s[..length.min(s.len())].to_vec()),
        c => c.clone(),
    }
}

/// Characters of a constant string.
fn text_length(c: &Const) -> usize {
    match c {
        Const::String(s) => s.len(),
        Const::WString(s) => s.len(),
        _ => 0,
    }
}

/// A constant as an expression.
pub(super) fn constant_expr(c: Const, ty: TypeId, span: Span) -> Expr {
    Expr { kind: ExprKind::Const(c), ty, span }
}

impl Builder<'_> {
    /// A conversion of a constant scalar; `None` if it stays for the run time.
    fn fold_conversion(&mut self, how: Conversion, c: &Const, from: TypeId, to: TypeId) -> Option<Const> {
        let (source, target) = (self.hir.types.storage(from), self.hir.types.storage(to));
        Some(match how {
            Conversion::Integer | Conversion::ZeroExtend | Conversion::Subrange => {
                let value = constant::int(c)?;
                let bits = match how {
                    Conversion::ZeroExtend => value & ((1 << source?.bits()) - 1),
                    _ => value,
                };
                Const::Int(constant::low_bits(bits, target?))
            }
            Conversion::NonZero => Const::Int(i128::from(!constant::is_zero(c) && *c != Const::Real(-0.0))),
            Conversion::LowBit => Const::Int(constant::int(c)? & 1),
            Conversion::IntToReal => Const::Real(constant::round(target?, constant::int(c)? as f64)),
            Conversion::RealToInt => {
                let (low, high) = target?.int_range()?;
                Const::Int((constant::real(c)?.round_ties_even() as i128).clamp(low, high))
            }
            Conversion::RealToIntAway => {
                let (low, high) = target?.int_range()?;
                Const::Int((constant::real(c)?.round() as i128).clamp(low, high))
            }
            Conversion::Real => Const::Real(constant::round(target?, constant::real(c)?)),
            Conversion::Bits => fold_bits(c, source?, target?)?,
            Conversion::String => return self.fold_text(c, from, to),
        })
    }

    fn fold_text(&self, c: &Const, from: TypeId, to: TypeId) -> Option<Const> {
        let wide = matches!(self.ty(to), Type::WString { .. });
        match (c, self.elementary(from)) {
            (_, Some(e)) if e.is_char() => {
                let code = constant::int(c)?;
                Some(match code {
                    0 => Const::Zero,
                    _ if wide => Const::WString(vec![code as u16]),
                    _ => Const::String(vec![code as u8]),
                })
            }
            _ => Some(c.clone()),
        }
    }
}

fn fold_bits(c: &Const, from: Elementary, to: Elementary) -> Option<Const> {
    Some(match (from, to) {
        (Elementary::Real, _) => Const::Int((constant::real(c)? as f32).to_bits().into()),
        (Elementary::Lreal, _) => Const::Int(constant::real(c)?.to_bits().into()),
        (_, Elementary::Real) => Const::Real(f64::from(f32::from_bits(constant::int(c)? as u32))),
        _ => Const::Real(f64::from_bits(constant::int(c)? as u64)),
    })
}
