//! Initial values (§2.7, §2.8): constants of the declared type, arrays and structures part by part. What is left out keeps its
//! default.

use super::builder::Builder;
use super::constant;
use super::convert::Operand;
use super::late::Part;
use super::model::*;
use super::types::TypeUse;
use super::types::layout::shifted;
use crate::syntax::ast::{self, ArrayInit, Init};
use takt_base::{Code, Diag, Severity, Span};
use takt_image::TypeId;
use takt_image::types::{Section, Type};

impl Builder<'_> {
    /// The value of an initialiser for a type; reports what does not fit and gives the default then.
    pub fn initial(&mut self, init: &Init, used: &TypeUse) -> Const {
        self.deeper(init.span(), |b| b.initial_kind(init, used)).unwrap_or(Const::Zero)
    }

    fn initial_kind(&mut self, init: &Init, used: &TypeUse) -> Const {
        if used.ty == self.error {
            return Const::Zero;
        }
        match init {
            Init::Expr(e) if self.is_late(e) => {
                self.put_off(e, used.ty);
                used.default.clone()
            }
            Init::Expr(e) => self.initial_value(e, used),
            Init::Array(list, span) => match self.array_parts(used.ty) {
                Some((element, dims)) => {
                    let sizes: Vec<usize> = dims.iter().map(|d| d.len() as usize).collect();
                    self.initial_array(list, element, &sizes, &used.default, *span)
                }
                None => self.bad_initial(*span, used.ty, "a list"),
            },
            Init::Struct(list, span) => self.initial_record(list, used, *span),
            Init::Positional(_, span) if !self.profile(*span).is_codesys() => Const::Zero, // reported by the parser
            Init::Positional(_, span) => {
                let help = "without FB_init the values need names: (input := value)";
                let label = format!("values without names, {} wanted", self.show(used.ty));
                self.report(Diag::new(Code::BadInitializer, *span, label).help(help));
                Const::Zero
            }
        }
    }

    fn bad_initial(&mut self, span: Span, ty: TypeId, what: &str) -> Const {
        let label = format!("{what}, {} wanted", self.show(ty));
        self.error(Code::BadInitializer, span, label);
        Const::Zero
    }

    fn initial_value(&mut self, e: &ast::Expr, used: &TypeUse) -> Const {
        if !matches!(self.ty(used.ty), Type::Array { .. } | Type::Struct(_) | Type::Instance(_)) {
            return self.initial_scalar(e, used.ty);
        }
        let o = self.operand(e, Some(used.ty));
        if self.is_bad(&o) {
            return Const::Zero;
        }
        if o.expr.ty != used.ty {
            return self.bad_initial(e.span, used.ty, "another type");
        }
        let found = if let ExprKind::Load(place) = &o.expr.kind { self.constant_at(place) } else { None };
        if found.is_none() && !self.put_off(e, used.ty) {
            self.not_constant(e.span);
        }
        found.unwrap_or(Const::Zero)
    }

    fn initial_scalar(&mut self, e: &ast::Expr, ty: TypeId) -> Const {
        let o: Operand = self.operand(e, Some(ty));
        let value = self.fit(o, ty);
        if let Some(address) = self.constant_address(&value) {
            return address;
        }
        match value.kind {
            _ if value.ty == self.error => Const::Zero,
            ExprKind::Const(c) => constant::normal(c),
            _ if self.put_off(e, ty) => Const::Zero,
            _ => {
                self.not_constant(e.span);
                Const::Zero
            }
        }
    }

    /// Elements in memory order; `sizes` are the lengths of the dimensions.
    fn initial_array(&mut self, list: &[ArrayInit], element: TypeId, sizes: &[usize], default: &Const, span: Span) -> Const {
        let count = sizes.iter().fold(1usize, |n, s| n.saturating_mul(*s));
        let mut fill = Fill {
            parts: Vec::new(),
            room: count,
            inner: sizes.get(1..).unwrap_or(&[]).to_vec(),
            element,
            surplus: None,
            cut: false,
        };
        for item in list {
            self.fill(&mut fill, item, default);
        }
        if let Some(span) = fill.surplus {
            self.warn_count(span, format!("only {count} elements"), "the surplus is ignored");
        } else if fill.parts.len() < count && !fill.cut {
            let label = format!("{} of {count} elements", fill.parts.len());
            self.warn_count(span, label, "the others keep their default; write n() for n of these");
        }
        self.complete(fill.parts, count, default, span)
    }

    fn warn_count(&mut self, span: Span, label: String, help: &str) {
        let diag = Diag::new(Code::BadInitializer, span, label).severity(Severity::Warning);
        self.report(diag.message("the number of initial values is not that of the elements").help(help));
    }

    /// The rest from the default. A tail of zeros is not written out if all is zero.
    fn complete(&mut self, mut parts: Vec<Const>, count: usize, default: &Const, span: Span) -> Const {
        if parts.iter().all(constant::is_zero) && constant::is_zero(default) {
            return Const::Zero;
        }
        if !self.charge(count, span) {
            return Const::Zero;
        }
        while parts.len() < count {
            parts.push(default_element(default, parts.len()));
        }
        constant::aggregate(parts)
    }

    fn fill(&mut self, fill: &mut Fill, item: &ArrayInit, default: &Const) {
        match item {
            ArrayInit::One(init) => match self.named_repeat(init) {
                Some((times, list)) => self.fill_times(fill, times, &list, default),
                None => self.fill_one(fill, init, default),
            },
            ArrayInit::Repeat(times, list) => self.fill_times(fill, times, list, default),
        }
    }

    /// `N(0, 1)` with a constant N, which looks like a call.
    fn named_repeat<'t>(&self, init: &'t Init) -> Option<(&'t ast::Expr, Vec<Init>)> {
        let Init::Expr(ast::Expr { kind: ast::ExprKind::Call { callee, args }, .. }) = init else { return None };
        let ast::ExprKind::Name(name) = &callee.kind else { return None };
        let value = |a: &ast::Arg| if let ast::Arg::Positional(e) = a { Some(Init::Expr(e.clone())) } else { None };
        let list: Option<Vec<Init>> = args.iter().map(value).collect();
        self.names_variable(name).then_some(callee).zip(list).map(|(callee, list)| (&**callee, list))
    }

    fn fill_times(&mut self, fill: &mut Fill, times: &ast::Expr, list: &[Init], default: &Const) {
        match self.const_int(times).map(usize::try_from) {
            Some(Ok(n)) => return self.fill_repeat(fill, n, list, default, times.span),
            Some(Err(_)) => self.error(Code::OutOfRange, times.span, "a negative number of elements"),
            None => {}
        }
        fill.cut = true;
    }

    fn fill_repeat(&mut self, fill: &mut Fill, n: usize, list: &[Init], default: &Const, span: Span) {
        if list.is_empty() {
            let n = n.min(fill.room.saturating_add(1));
            let kept = n.min(fill.room);
            if kept < n {
                fill.surplus.get_or_insert(span);
            }
            if self.charge(kept, span) {
                (0..kept).for_each(|_| fill.push(default_element(default, fill.parts.len()), span));
            } else {
                fill.cut = true;
            }
            return;
        }
        let start = fill.parts.len();
        let late = if n == 1 { None } else { self.late_now.take() }; // a repeated value is computed once: it is constant
        list.iter().for_each(|init| self.fill_one(fill, init, default));
        self.late_now = self.late_now.take().or(late);
        let once: Vec<Const> = fill.parts[start..].to_vec();
        let leaves = once.iter().map(constant::leaves).sum::<usize>();
        let times = n.saturating_sub(1).min(fill.room / once.len().max(1) + 1);
        if n == 0 {
            fill.room += once.len();
            fill.parts.truncate(start);
        } else if !once.is_empty() && self.charge(leaves.saturating_mul(times), span) {
            let repeated = once.iter().cycle().take(once.len().saturating_mul(times));
            repeated.for_each(|c| fill.push(c.clone(), span));
        } else {
            fill.cut = true;
        }
    }

    fn fill_one(&mut self, fill: &mut Fill, init: &Init, default: &Const) {
        // A nested list fills a row of a multi-dimensional array, unless the elements are arrays themselves.
        if let (Init::Array(list, span), false) = (init, fill.inner.is_empty()) {
            return self.fill_row(fill, list, default, *span);
        }
        let used = TypeUse { ty: fill.element, default: default_element(default, fill.parts.len()) };
        if fill.room == 0 {
            fill.surplus.get_or_insert(init.span());
            return;
        }
        let value = self.in_part(Part::Element(fill.parts.len()), |b| b.initial(init, &used));
        fill.push(value, init.span());
    }

    fn fill_row(&mut self, fill: &mut Fill, list: &[ArrayInit], default: &Const, span: Span) {
        let (inner, row) = (fill.inner.clone(), fill.inner.iter().product::<usize>());
        let start = fill.parts.len();
        let default = match default {
            Const::Aggregate(parts) => Const::Aggregate(parts.iter().skip(start).take(row).cloned().collect()),
            _ => Const::Zero,
        };
        match self.in_row(start, |b| b.initial_array(list, fill.element, &inner, &default, span)) {
            Const::Aggregate(parts) => parts.into_iter().for_each(|c| fill.push(c, span)),
            _ if self.charge(row, span) => (0..row.min(fill.room + 1)).for_each(|_| fill.push(Const::Zero, span)),
            _ => fill.cut = true,
        }
    }

    /// `(a := 1, b := (c := 2))` for a structure or an instance.
    fn initial_record(&mut self, list: &[(ast::Name, Init)], used: &TypeUse, span: Span) -> Const {
        let fields = match self.ty(used.ty) {
            Type::Struct(r) | Type::Instance(r) => r.fields.clone(),
            _ => return self.bad_initial(span, used.ty, "a list of members"),
        };
        if self.hir.types.overlaps(used.ty) {
            return self.bad_initial(span, used.ty, "values of members that share their bytes");
        }
        let mut parts = match &used.default {
            Const::Aggregate(parts) => parts.clone(),
            _ => vec![Const::Zero; fields.len()],
        };
        let mut given: Vec<usize> = Vec::new();
        for (name, init) in list {
            let visible = |s: Section| !matches!(s, Section::Hidden | Section::InOut);
            let Some(i) = fields.iter().position(|f| name.is(&f.name) && visible(f.section)) else {
                let known = fields.iter().filter(|f| visible(f.section)).map(|f| f.name.clone()).collect();
                self.unknown(Code::UnknownMember, name, known);
                continue;
            };
            if given.contains(&i) {
                self.error(Code::DuplicateName, name.span, "given twice");
            }
            given.push(i);
            let bit = self.bit_members.get(&(used.ty, i as u32)).copied();
            let ty = if bit.is_some() { self.bool() } else { fields[i].ty };
            let part = TypeUse { ty, default: parts[i].clone() };
            parts[i] = shifted(self.in_part(Part::Field(i as u32), |b| b.initial(init, &part)), bit);
        }
        self.charge(parts.iter().map(constant::leaves).sum(), span);
        constant::aggregate(parts)
    }
}

/// An array being filled.
struct Fill {
    parts: Vec<Const>,
    room: usize,
    inner: Vec<usize>,
    element: TypeId,
    surplus: Option<Span>,
    /// Something is missing that has been reported.
    cut: bool,
}

impl Fill {
    fn push(&mut self, c: Const, span: Span) {
        if self.room == 0 {
            self.surplus.get_or_insert(span);
            return;
        }
        self.room -= 1;
        self.parts.push(c);
    }
}

/// Element `i` of a default array value.
fn default_element(default: &Const, i: usize) -> Const {
    match default {
        Const::Aggregate(parts) => parts.get(i).cloned().unwrap_or(Const::Zero),
        _ => Const::Zero,
    }
}
