//! Expressions: precedence climbing over unary forms.
//! From: IEC 61131-3 §7.3.2 (language reference §5.1, §5.2).

use super::cursor::Parser;
use super::literal::fold_sign;
use crate::syntax::ast::{BinaryOp, Expr, ExprKind, UnaryOp};
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::Tok;
use takt_base::Span;
use takt_base::diag::{Code, Diag};

/// Greatest height of an expression tree: `a + b + c` is two high. Later stages may recurse over the tree.
pub(super) const MAX_HEIGHT: u32 = 256;

/// An expression and the height of its tree.
pub(super) struct Tree {
    pub(super) expr: Expr,
    pub(super) height: u32,
}

impl Tree {
    pub(super) fn leaf(expr: Expr) -> Self {
        Self { expr, height: 1 }
    }
    pub(super) fn error(span: Span) -> Self {
        Self::leaf(error(span))
    }
}

/// An error node.
pub(super) fn error(span: Span) -> Expr {
    Expr { kind: ExprKind::Error, span }
}

/// Binding power: larger binds tighter; all operators are left associative.
const fn power(op: BinaryOp) -> u8 {
    match op {
        BinaryOp::Or | BinaryOp::OrElse => 1,
        BinaryOp::Xor => 2,
        BinaryOp::And | BinaryOp::AndThen => 3,
        BinaryOp::Eq | BinaryOp::Ne => 4,
        BinaryOp::Lt | BinaryOp::Gt | BinaryOp::Le | BinaryOp::Ge => 5,
        BinaryOp::Add | BinaryOp::Sub => 6,
        BinaryOp::Mul | BinaryOp::Div | BinaryOp::Mod => 7,
        BinaryOp::Power => 8,
    }
}

impl Parser<'_> {
    pub(super) fn expr(&mut self) -> Expr {
        self.binary(1).expr
    }

    /// What a statement starts with: a name and what follows it, no operators.
    pub(super) fn variable(&mut self) -> Expr {
        let start = self.here();
        if !self.enter() {
            self.leave();
            return error(start);
        }
        let tree = self.postfix();
        self.leave();
        tree.expr
    }

    pub(super) fn binary(&mut self, min: u8) -> Tree {
        let start = self.here();
        if !self.enter() {
            self.leave();
            return Tree::error(start);
        }
        let mut left = self.unary();
        while let Some(op) = self.operator() {
            if power(op) < min || self.lost {
                break;
            }
            self.foreign_operator(op);
            self.bump();
            let right = self.binary(power(op) + 1);
            left = self.join(op, left, right);
        }
        self.leave();
        left
    }

    fn join(&mut self, op: BinaryOp, left: Tree, right: Tree) -> Tree {
        let span = left.expr.span.to(right.expr.span);
        let kind = ExprKind::Binary(op, Box::new(left.expr), Box::new(right.expr));
        self.grown(Expr { kind, span }, left.height.max(right.height))
    }

    /// A node over others of `height`; an error node if the tree gets too high.
    pub(super) fn grown(&mut self, expr: Expr, height: u32) -> Tree {
        if height < MAX_HEIGHT {
            return Tree { expr, height: height + 1 };
        }
        self.too_deep(format!("more than {MAX_HEIGHT} operators in a row"));
        Tree::error(expr.span)
    }

    fn operator(&self) -> Option<BinaryOp> {
        let token = self.peek();
        Some(match token.kind {
            Tok::Plus => BinaryOp::Add,
            Tok::Minus => BinaryOp::Sub,
            Tok::Star => BinaryOp::Mul,
            Tok::Slash => BinaryOp::Div,
            Tok::Power => BinaryOp::Power,
            Tok::Amp | Tok::CAnd => BinaryOp::And,
            Tok::Lt => BinaryOp::Lt,
            Tok::Gt => BinaryOp::Gt,
            Tok::Le => BinaryOp::Le,
            Tok::Ge => BinaryOp::Ge,
            Tok::Eq | Tok::CEq => BinaryOp::Eq,
            Tok::Ne | Tok::CNe => BinaryOp::Ne,
            Tok::COr => BinaryOp::Or,
            Tok::CMod => BinaryOp::Mod,
            Tok::Word => match token.kw {
                Kw::And => BinaryOp::And,
                Kw::Or => BinaryOp::Or,
                Kw::Xor => BinaryOp::Xor,
                Kw::Mod => BinaryOp::Mod,
                Kw::AndThen => BinaryOp::AndThen,
                Kw::OrElse => BinaryOp::OrElse,
                _ => return None,
            },
            _ => return None,
        })
    }

    /// Reports an operator of another language; the caller goes on with what is meant.
    fn foreign_operator(&mut self, op: BinaryOp) {
        if matches!(self.kind(), Tok::CEq | Tok::CNe | Tok::CAnd | Tok::COr | Tok::CMod) {
            let text = self.text_of(self.peek());
            let diag = Diag::new(Code::Expected, self.here(), "not an operator of this language");
            self.soft(diag.message(format!("expected {} instead of {text}", op.text())).help(format!("write {}", op.text())));
        }
    }

    fn unary(&mut self) -> Tree {
        let op = match self.kind() {
            Tok::Minus => UnaryOp::Neg,
            Tok::Plus => UnaryOp::Plus,
            Tok::CNot => UnaryOp::Not,
            Tok::Word if self.kw() == Kw::Not && !self.is_formal_call() => UnaryOp::Not,
            _ => return self.postfix(),
        };
        let start = self.here();
        if !self.enter() {
            self.leave();
            return Tree::error(start);
        }
        if self.at(Tok::CNot) {
            let diag = Diag::new(Code::Expected, start, "not an operator of this language");
            self.soft(diag.message("expected NOT instead of !").help("write NOT"));
        }
        self.bump();
        let operand = self.unary();
        self.leave();
        let span = start.to(operand.expr.span);
        if let (UnaryOp::Neg, Some(literal)) = (op, fold_sign(&operand.expr)) {
            return Tree::leaf(Expr { kind: ExprKind::Literal(literal), span });
        }
        self.grown(Expr { kind: ExprKind::Unary(op, Box::new(operand.expr)), span }, operand.height)
    }

    /// `NOT(IN := x)`: the function, not the operator.
    fn is_formal_call(&self) -> bool {
        self.nth(1).kind == Tok::LParen && self.nth(2).kind == Tok::Word && self.nth(3).kind == Tok::Assign
    }
}
