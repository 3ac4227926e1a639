//! Operators on durations and dates: each stands for a library function such as ADD_DT_TIME, which says what it means (library
//! reference §8.1). TIME + TIME is plain arithmetic and not decided here.

use crate::hir::builder::Builder;
use crate::hir::convert::{Flex, Operand};
use crate::syntax::ast::BinaryOp;
use takt_base::Span;
use takt_image::Elementary as E;

impl Builder<'_> {
    /// The library function that an operator with a date or a duration stands for; `None` if it is no such case.
    pub(super) fn time_operator(&mut self, op: BinaryOp, a: &Operand, b: &Operand, span: Span) -> Option<Operand> {
        let (x, y) = (self.elementary(a.expr.ty)?, self.elementary(b.expr.ty)?);
        if !(is_time(x) || is_time(y)) || a.flex == Flex::Text || b.flex == Flex::Text {
            return None;
        }
        let (name, args) = match op {
            BinaryOp::Mul if y.is_duration() && !is_time(x) => (scale_name("MUL", y), vec![b.clone(), a.clone()]),
            BinaryOp::Mul if x.is_duration() && !is_time(y) => (scale_name("MUL", x), vec![a.clone(), b.clone()]),
            BinaryOp::Div if x.is_duration() && !is_time(y) => (scale_name("DIV", x), vec![a.clone(), b.clone()]),
            BinaryOp::Add if x.is_date() && y.is_duration() => (pair_name("ADD", x, y), vec![a.clone(), b.clone()]),
            BinaryOp::Sub if x.is_date() && is_time(y) => (pair_name("SUB", x, y), vec![a.clone(), b.clone()]),
            BinaryOp::Add | BinaryOp::Sub if x.is_duration() && y.is_duration() => return None,
            BinaryOp::Add | BinaryOp::Sub | BinaryOp::Mul | BinaryOp::Div | BinaryOp::Mod => (String::new(), vec![]),
            _ => return None,
        };
        let number = |e: E| e.is_int() || e.is_real() || is_time(e);
        let known = takt_stdlib::lookup(&name).filter(|_| number(x) && number(y));
        Some(match known {
            Some(found) => self.apply(found, args, span, None),
            None => {
                let label = format!("{} and {}", self.show(a.expr.ty), self.show(b.expr.ty));
                let help = "a duration adds to TOD and DT, and is multiplied or divided by a number";
                let diag = takt_base::Diag::new(takt_base::Code::BadOperand, span, format!("{} of {label}", op.text()));
                self.report(diag.help(help));
                self.bad(span)
            }
        })
    }
}

fn is_time(e: E) -> bool {
    e.is_duration() || e.is_date()
}

fn is_long(e: E) -> bool {
    matches!(e, E::Ltime | E::Ldate | E::Ltod | E::Ldt)
}

fn scale_name(what: &str, duration: E) -> String {
    format!("{what}_{}", duration.name())
}

/// `ADD_DT_TIME`; the long form if one of the operands is long.
fn pair_name(what: &str, a: E, b: E) -> String {
    let long = is_long(a) || is_long(b);
    let name = |e: E| if long && !is_long(e) { format!("L{}", e.name()) } else { e.name().to_owned() };
    format!("{what}_{}_{}", name(a), name(b))
}
