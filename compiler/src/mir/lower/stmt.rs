//! Statements. From: language reference §5.5 to §5.8.

use super::unit::{LoopEnds, Unit};
use crate::hir::model::*;
use crate::mir::model::*;

impl Unit<'_, '_> {
    /// Statements in order; what stands behind an EXIT, CONTINUE, RETURN or jump is left out, up to the next label. Labels inside
    /// of what is left out are reached from there alone.
    pub fn statements(&mut self, body: &[Stmt]) {
        for stmt in body {
            if let StmtKind::Label(label) = stmt.kind {
                let block = self.label(label);
                self.f.jump(block);
                self.f.enter(block);
            }
            if !self.f.is_open() {
                continue;
            }
            let temporaries = self.f.mark();
            self.at_line(stmt.span);
            self.statement(stmt);
            self.f.release(temporaries);
        }
    }

    fn statement(&mut self, stmt: &Stmt) {
        match &stmt.kind {
            StmtKind::Assign { target, value } => {
                let to = self.place(target);
                let value = self.operand(value);
                self.assign(to, target.ty, value);
            }
            StmtKind::CallBlock { instance, pou, inputs, outputs } => self.call_block(instance, *pou, inputs, outputs),
            StmtKind::Call(e) => self.call_statement(e),
            StmtKind::If { branches, otherwise } => self.if_statement(branches, otherwise),
            StmtKind::Case { selector, arms, otherwise } => self.case(selector, arms, otherwise),
            StmtKind::For { variable, values, body } => self.for_loop(variable, values, body),
            StmtKind::While { condition, body } => self.while_loop(condition, body),
            StmtKind::Repeat { body, until } => self.repeat_loop(body, until),
            StmtKind::Exit => self.leave_loop(|ends| ends.exit),
            StmtKind::Continue => self.leave_loop(|ends| ends.next),
            StmtKind::Return => self.f.jump(self.exit),
            StmtKind::Label(_) => {}
            StmtKind::Jump(label) => {
                let block = self.label(*label);
                self.f.jump(block);
            }
        }
    }

    /// The block that begins at a label.
    fn label(&mut self, label: LabelId) -> BlockId {
        let f = &mut self.f;
        *self.labels.entry(label).or_insert_with(|| f.block())
    }

    fn call_statement(&mut self, e: &Expr) {
        match &e.kind {
            ExprKind::Call { pou, args } => _ = self.call(*pou, args, e.span),
            ExprKind::Guarded(g) if g.en.is_none() && matches!(g.call.kind, ExprKind::Call { .. } | ExprKind::CallMethod(_)) => {
                self.call_statement(&g.call);
                self.hand_eno(g, None);
            }
            ExprKind::CallMethod(c) => _ = self.call_method(c, e.span),
            _ => _ = self.operand(e),
        }
    }

    fn if_statement(&mut self, branches: &[(Expr, Vec<Stmt>)], otherwise: &[Stmt]) {
        let done = self.f.block();
        for (condition, body) in branches {
            let (then, next) = (self.f.block(), self.f.block());
            self.at_line(condition.span);
            self.branch_on(condition, then, next);
            self.f.enter(then);
            self.statements(body);
            self.f.jump(done);
            self.f.enter(next);
        }
        self.statements(otherwise);
        self.f.jump(done);
        self.f.enter(done);
    }

    fn while_loop(&mut self, condition: &Expr, body: &[Stmt]) {
        let (head, inside, done) = (self.f.block(), self.f.block(), self.f.block());
        self.f.jump(head);
        self.f.enter(head);
        self.branch_on(condition, inside, done);
        self.f.enter(inside);
        self.loop_body(body, LoopEnds { exit: done, next: head });
        self.f.jump(head);
        self.f.enter(done);
    }

    fn repeat_loop(&mut self, body: &[Stmt], until: &Expr) {
        let (head, test, done) = (self.f.block(), self.f.block(), self.f.block());
        self.f.jump(head);
        self.f.enter(head);
        self.loop_body(body, LoopEnds { exit: done, next: test });
        self.f.jump(test);
        self.f.enter(test);
        self.at_line(until.span);
        self.branch_on(until, done, head);
        self.f.enter(done);
    }

    /// The statements of a loop, with its EXIT and CONTINUE.
    pub fn loop_body(&mut self, body: &[Stmt], ends: LoopEnds) {
        self.loops.push(ends);
        self.statements(body);
        self.loops.pop();
    }

    fn leave_loop(&mut self, to: impl Fn(&LoopEnds) -> BlockId) {
        let target = self.loops.last().map(to).expect("EXIT and CONTINUE stand in a loop");
        self.f.jump(target);
    }
}
