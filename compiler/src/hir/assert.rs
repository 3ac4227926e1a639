//! Assertions (docs/guide/testing.md): `ASSERT_EQ(expected, actual, message)` and its kin. The arguments are unified as those of the
//! operator are, and a native of the library compares them. A function of the project that has the same name wins.

use super::builder::Builder;
use super::convert::{Flex, Operand, constant_expr};
use super::model::*;
use crate::syntax::ast::{self, BinaryOp};
use takt_base::{Code, Diag, Span};
use takt_image::types::Type;
use takt_image::{Elementary, TypeId};

/// An assertion: name, inputs before the message, operator that decides; NEAR is told by its third input.
type Form = (&'static str, &'static [&'static str], BinaryOp);

const PAIR: &[&str] = &["EXPECTED", "ACTUAL"];
const FORMS: &[Form] = &[
    ("ASSERT", &["IN"], BinaryOp::Eq),
    ("ASSERT_TRUE", &["IN"], BinaryOp::Eq),
    ("ASSERT_FALSE", &["IN"], BinaryOp::Eq),
    ("ASSERT_EQ", PAIR, BinaryOp::Eq),
    ("ASSERT_NE", PAIR, BinaryOp::Ne),
    ("ASSERT_LT", PAIR, BinaryOp::Lt),
    ("ASSERT_LE", PAIR, BinaryOp::Le),
    ("ASSERT_GT", PAIR, BinaryOp::Gt),
    ("ASSERT_GE", PAIR, BinaryOp::Ge),
    ("ASSERT_NEAR", &["EXPECTED", "ACTUAL", "TOLERANCE"], BinaryOp::Le),
];
const MESSAGE: &str = "MSG";
/// Every native of an assertion begins so.
pub(super) const PREFIX: &str = "ASSERT_";

/// Names of all assertions.
pub(super) fn names() -> impl Iterator<Item = String> {
    FORMS.iter().map(|f| f.0.to_owned())
}

impl Builder<'_> {
    /// The call of an assertion; `None` if the name is none.
    pub(super) fn assert_call(&mut self, name: &ast::Name, args: &[ast::Arg], span: Span) -> Option<Operand> {
        let form = FORMS.iter().find(|f| name.is(f.0))?;
        if self.local(&name.key()).is_some() || self.symbols.units.contains_key(&name.key()) {
            return None;
        }
        let Some(given) = self.assert_arguments(form, args, span) else {
            args.iter().filter_map(super::body::arg_expr).for_each(|e| drop(self.operand(e, None)));
            return Some(self.bad(span));
        };
        Some(self.assertion(form, &given, span).unwrap_or_else(|| self.bad(span)))
    }

    /// The inputs in order, the message (or nothing) last; a report if they don't fit.
    fn assert_arguments<'t>(&mut self, form: &Form, args: &'t [ast::Arg], span: Span) -> Option<Vec<Option<&'t ast::Expr>>> {
        let names: Vec<_> = form.1.iter().copied().chain([MESSAGE]).collect();
        let mut given = vec![None; names.len()];
        for (position, arg) in args.iter().enumerate() {
            let (slot, value) = match arg {
                ast::Arg::Positional(e) => (position, e),
                ast::Arg::Input { name, value: Some(e) } => match names.iter().position(|n| name.is(n)) {
                    Some(slot) => (slot, e),
                    None => {
                        self.unknown(Code::UnknownParameter, name, names.iter().map(|n| (*n).to_owned()).collect());
                        return None;
                    }
                },
                ast::Arg::Input { name, .. } | ast::Arg::Output { name, .. } => {
                    self.error(Code::UnknownParameter, name.span, "write `name := value`");
                    return None;
                }
            };
            if slot >= given.len() || given[slot].replace(value).is_some() {
                self.assert_count(form, value.span);
                return None;
            }
        }
        if given[..form.1.len()].iter().any(Option::is_none) {
            self.assert_count(form, span);
            return None;
        }
        Some(given)
    }

    fn assert_count(&mut self, form: &Form, at: Span) {
        let label = format!("`{}` takes {}", form.0, form.1.len());
        let help = format!("write {}({}); a message may follow", form.0, form.1.join(", "));
        self.report(Diag::new(Code::WrongArgumentCount, at, label).help(help));
    }

    fn assertion(&mut self, form: &Form, given: &[Option<&ast::Expr>], span: Span) -> Option<Operand> {
        let (message, values) = given.split_last()?;
        let message = self.assert_message(*message, span);
        let mut args = match *values {
            [Some(condition)] => self.assert_condition(form, condition),
            [Some(a), Some(b)] => self.assert_pair(form.2, a, b, span)?,
            [Some(a), Some(b), Some(tolerance)] => self.assert_near(a, b, tolerance, span)?,
            _ => return None,
        };
        let ty = args.first()?.ty;
        if args.iter().any(|a| a.ty == self.error) {
            return None;
        }
        let check = if args.len() == 3 { "NEAR" } else { check_name(form.2) };
        let name = format!("{PREFIX}{check}_{}", self.storage_name(ty)?);
        let line = self.sources.line_col(span.source, span.start).line;
        let file = self.sources.get(span.source).name.clone().into_bytes();
        args.extend([message?, self.text_constant(file, span)]);
        let dint = self.elem(Elementary::Dint);
        args.extend([line, ty.0].map(|n| constant_expr(Const::Int(n.into()), dint, span)));
        let ty = self.bool();
        Some(Operand::fixed(Expr { kind: ExprKind::Native { name, args }, ty, span }))
    }

    /// TRUE or FALSE is expected, and this is what there is.
    fn assert_condition(&mut self, form: &Form, condition: &ast::Expr) -> Vec<Expr> {
        let bool = self.bool();
        let wanted = Const::Int(i128::from(form.0 != "ASSERT_FALSE"));
        vec![constant_expr(wanted, bool, condition.span), self.value(condition, bool)]
    }

    /// Both values in the type in which the operator compares them.
    fn assert_pair(&mut self, op: BinaryOp, a: &ast::Expr, b: &ast::Expr, span: Span) -> Option<Vec<Expr>> {
        let (a, b) = self.beside(a, b, None);
        let (a, b) = if a.flex == Flex::Fixed || b.flex == Flex::Fixed { (a, b) } else { self.unify(a, b, None)? };
        let (a, b) = match a.flex == Flex::Fixed || b.flex == Flex::Fixed {
            true => (a, b),
            false => (Operand::fixed(self.settle(a)), Operand::fixed(self.settle(b))),
        };
        let ty = a.expr.ty;
        let outer = std::mem::replace(&mut self.unfolded, true);
        let compared = self.combine(op, a, b, span, None);
        self.unfolded = outer;
        match compared.expr.kind {
            ExprKind::Binary(_, a, b) if self.storage_name(a.ty).is_some() => Some(vec![*a, *b]),
            _ => {
                if compared.expr.ty != self.error {
                    let label = format!("{} can't be shown", self.show(ty));
                    self.error(Code::BadOperand, span, label);
                }
                None
            }
        }
    }

    /// Numbers or durations, with the tolerance in the same type.
    fn assert_near(&mut self, a: &ast::Expr, b: &ast::Expr, tolerance: &ast::Expr, span: Span) -> Option<Vec<Expr>> {
        let mut args = self.assert_pair(BinaryOp::Le, a, b, span)?;
        let ty = args.first()?.ty;
        if !self.elementary(ty).is_some_and(|e| e.is_int() || e.is_real() || e.is_duration()) {
            let label = format!("ASSERT_NEAR of {}", self.show(ty));
            self.report(Diag::new(Code::BadOperand, span, label).help("it compares numbers and durations"));
            return None;
        }
        args.push(self.value(tolerance, ty));
        Some(args)
    }

    fn assert_message(&mut self, message: Option<&ast::Expr>, span: Span) -> Option<Expr> {
        let Some(message) = message else { return Some(self.text_constant(Vec::new(), span)) };
        let o = self.operand(message, None);
        let o = self.as_string(o);
        match self.ty(o.expr.ty) {
            Type::String { .. } => Some(o.expr),
            _ if self.is_bad(&o) => None,
            _ => {
                let label = format!("{}, a STRING wanted", self.show(o.expr.ty));
                self.report(Diag::new(Code::TypeMismatch, message.span, label).help("the last argument is a message"));
                None
            }
        }
    }

    fn text_constant(&mut self, text: Vec<u8>, span: Span) -> Expr {
        let capacity = (text.len() as u32).max(1);
        let ty = self.hir.types.intern(Type::String { capacity });
        constant_expr(Const::String(text), ty, span)
    }

    /// Suffix of the native; `None` for what is neither a scalar nor a string.
    fn storage_name(&self, ty: TypeId) -> Option<&'static str> {
        match self.ty(ty) {
            Type::String { .. } => Some("STRING"),
            Type::WString { .. } => Some("WSTRING"),
            Type::Pointer { .. } | Type::Reference { .. } => None,
            _ => self.hir.types.storage(ty).map(Elementary::name),
        }
    }
}

fn check_name(op: BinaryOp) -> &'static str {
    match op {
        BinaryOp::Ne => "NE",
        BinaryOp::Lt => "LT",
        BinaryOp::Le => "LE",
        BinaryOp::Gt => "GT",
        BinaryOp::Ge => "GE",
        _ => "EQ",
    }
}
