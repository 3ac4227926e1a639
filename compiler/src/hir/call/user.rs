//! Calls of the project's own functions.

use super::arguments::Given;
use crate::hir::builder::Builder;
use crate::hir::convert::{Operand, constant_expr};
use crate::hir::model::*;
use crate::syntax::ast;
use takt_base::{Code, Diag, Span};

impl Builder<'_> {
    /// A call of a function with all its parameters: what is not given has its default value.
    pub(super) fn call_user(&mut self, id: PouId, args: &[ast::Arg], span: Span) -> Operand {
        self.ensure_pou(id, span);
        self.note_call(id, span);
        let Some(args) = self.user_arguments(id, args, span) else { return self.bad(span) };
        let ty = self.type_of_result(id);
        if ty == self.error {
            return self.bad(span);
        }
        Operand::fixed(Expr { kind: ExprKind::Call { pou: id, args }, ty, span })
    }

    /// Type of the result; BOOL if there is none.
    pub(in crate::hir) fn type_of_result(&mut self, id: PouId) -> takt_image::TypeId {
        match self.hir.pous[id].result {
            Some(result) => self.hir.pous[id].vars[result].ty,
            None => self.bool(),
        }
    }

    /// Arguments for all parameters of a function or method; `None` and a report if something is wrong.
    pub(in crate::hir) fn user_arguments(&mut self, id: PouId, args: &[ast::Arg], span: Span) -> Option<Vec<Arg>> {
        let informal = args.iter().any(|a| matches!(a, ast::Arg::Positional(_)));
        let given = self.match_arguments(id, args, span)?;
        let params = self.hir.pous[id].params.clone();
        if informal && !self.all_inputs_given(id, &given, span) {
            return None;
        }
        params.into_iter().zip(given).map(|(var, given)| self.user_argument(id, var, given, span)).collect()
    }

    /// An informal call gives every input.
    pub(in crate::hir) fn all_inputs_given(&mut self, id: PouId, given: &[Option<Given>], span: Span) -> bool {
        let pou = &self.hir.pous[id];
        let own = self.declared_enable(id).en;
        let missing =
            pou.params.iter().zip(given).find(|(v, g)| pou.vars[**v].role == Role::Input && g.is_none() && own != Some(**v));
        let Some((var, _)) = missing else { return true };
        let label = format!("input `{}` is missing", pou.vars[*var].name);
        let help = "give all inputs in order, or name those that you give: `name := value`";
        self.report(Diag::new(Code::WrongArgumentCount, span, label).help(help));
        false
    }

    fn user_argument(&mut self, id: PouId, var: VarId, given: Option<Given>, span: Span) -> Option<Arg> {
        let v = &self.hir.pous[id].vars[var];
        if self.open_parts(v.ty).is_some() {
            let Some(g) = given else {
                self.missing_in_out(id, var, span);
                return None;
            };
            return Some(Arg::Reference(match self.hir.pous[id].vars[var].role {
                Role::Input => {
                    let v = &self.hir.pous[id].vars[var];
                    let (ty, note) = (v.ty, (v.span, format!("`{}` is {}", v.name, self.show(v.ty))));
                    self.open_input(g.expr(), ty, note)?
                }
                _ => self.in_out(id, var, g.expr())?,
            }));
        }
        Some(match (v.role, given) {
            (Role::Input, Some(Given::Value(e))) => {
                let value = self.input(id, var, e);
                return (value.ty != self.error).then_some(Arg::Value(value));
            }
            (Role::Input, _) => Arg::Value(constant_expr(v.init.clone(), v.ty, span)),
            (Role::InOut, Some(g)) => Arg::Reference(self.in_out(id, var, g.expr())?),
            (Role::InOut, None) => {
                self.missing_in_out(id, var, span);
                return None;
            }
            (_, Some(Given::Value(e))) => Arg::Output { target: self.output(id, var, e, false)?, negated: false },
            (_, Some(Given::Output { target, negated })) => {
                Arg::Output { target: self.output(id, var, target, negated)?, negated }
            }
            (_, None) => Arg::Unused,
        })
    }
}
