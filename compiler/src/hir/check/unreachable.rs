//! P6001: statements behind RETURN, EXIT, CONTINUE or JMP, behind an IF or CASE whose every branch leaves, and behind a loop that never ends.
//! `IF FALSE THEN` is left alone: that is how people switch code off.

use crate::hir::builder::Builder;
use crate::hir::constant;
use crate::hir::model::*;
use takt_base::{Code, Diag, Span};

/// Looks through a body.
pub(super) fn check(_: &Builder, pou: &Pou, out: &mut Vec<Diag>) {
    Search { exits: Vec::new(), out }.list(&pou.body);
}

struct Search<'a> {
    /// For each loop around: an EXIT of it was seen.
    exits: Vec<bool>,
    out: &'a mut Vec<Diag>,
}

impl Search<'_> {
    /// True if what stands behind the list can be reached from its end.
    fn list(&mut self, list: &[Stmt]) -> bool {
        let mut left: Option<Span> = None;
        let mut reported = false;
        for s in list {
            match left {
                _ if matches!(s.kind, StmtKind::Label(_)) => left = None,
                Some(at) if !reported && s.span != at => {
                    let diag = Diag::new(Code::Unreachable, s.span, "nothing leads here")
                        .also(at, "what comes before it never ends here");
                    self.out.push(diag.help("remove it, or put what leaves before it behind a condition"));
                    reported = true;
                }
                _ => {}
            }
            let goes_on = self.statement(s);
            left = left.or((!goes_on).then_some(s.span));
        }
        left.is_none()
    }

    fn statement(&mut self, s: &Stmt) -> bool {
        match &s.kind {
            StmtKind::Return | StmtKind::Continue | StmtKind::Jump(_) => false,
            StmtKind::Exit => {
                self.exits.iter_mut().last().into_iter().for_each(|e| *e = true);
                false
            }
            StmtKind::If { branches, otherwise } => {
                let any = branches.iter().fold(false, |any, (_, body)| self.list(body) || any);
                self.list(otherwise) || any
            }
            StmtKind::Case { arms, otherwise, .. } => {
                let any = arms.iter().fold(false, |any, (_, body)| self.list(body) || any);
                self.list(otherwise) || any
            }
            StmtKind::For { body, .. } => {
                self.looped(body);
                true
            }
            StmtKind::While { condition, body } => self.looped(body) || truth(condition) != Some(true),
            StmtKind::Repeat { body, until } => self.looped(body) || truth(until) != Some(false),
            _ => true,
        }
    }

    /// True if an EXIT leaves the loop.
    fn looped(&mut self, body: &[Stmt]) -> bool {
        self.exits.push(false);
        self.list(body);
        self.exits.pop().unwrap_or(true)
    }
}

/// The value of a constant condition.
fn truth(e: &Expr) -> Option<bool> {
    if let ExprKind::Const(c) = &e.kind { Some(!constant::is_zero(c)) } else { None }
}
