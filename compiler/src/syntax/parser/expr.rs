//! Expressions: precedence climbing over unary, postfix and primary forms.
//! From: IEC 61131-3 §7.3.2 (language reference §5.1, §5.2).

use super::cursor::Parser;
use super::literal::{fold_sign, problem_diag};
use crate::syntax::ast::{AddressSize, BinaryOp, Expr, ExprKind, Literal, Name, UnaryOp};
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::{Tok, Token};
use crate::syntax::literal::address;
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
    fn error(span: Span) -> Self {
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

    /// `a, b, c`.
    pub(super) fn exprs(&mut self) -> Vec<Expr> {
        let mut list = vec![self.expr()];
        while !self.lost && self.eat(Tok::Comma) {
            list.push(self.expr());
        }
        list
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

    /// True at an operator of this language other than `=`, which is a mistyped `:=` behind a variable.
    pub(super) fn is_operator(&self) -> bool {
        !self.at(Tok::Eq) && self.operator().is_some()
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
        if let Some(literal) = fold_sign(op, &operand.expr) {
            return Tree::leaf(Expr { kind: ExprKind::Literal(literal), span });
        }
        self.grown(Expr { kind: ExprKind::Unary(op, Box::new(operand.expr)), span }, operand.height)
    }

    /// `NOT(IN := x)`: the function, not the operator.
    fn is_formal_call(&self) -> bool {
        self.nth(1).kind == Tok::LParen && self.nth(2).kind == Tok::Word && self.nth(3).kind == Tok::Assign
    }

    /// An operand of an instruction: a literal or a variable, no operators and no calls.
    pub(super) fn operand(&mut self) -> Expr {
        let start = self.here();
        let op = if self.at(Tok::Minus) { UnaryOp::Neg } else { UnaryOp::Plus };
        let signed = self.eat(Tok::Minus) || self.eat(Tok::Plus);
        if !self.enter() {
            self.leave();
            return error(start);
        }
        let mut expr = self.postfix_of(false).expr;
        self.leave();
        if signed {
            match fold_sign(op, &expr) {
                Some(literal) => expr = Expr { kind: ExprKind::Literal(literal), span: start.to(expr.span) },
                None if !self.lost => {
                    let diag = Diag::new(Code::Expected, start, "a sign belongs to a number");
                    self.soft(diag.message("expected an operand").help("compute it by instructions of its own"));
                    self.lost = true;
                }
                None => {}
            }
        }
        expr
    }

    fn postfix(&mut self) -> Tree {
        self.postfix_of(true)
    }

    /// `calls`: a parenthesis calls what stands before it.
    fn postfix_of(&mut self, calls: bool) -> Tree {
        let mut tree = self.primary();
        let callable = !matches!(tree.expr.kind, ExprKind::Literal(_));
        while !self.lost && callable {
            tree = match self.kind() {
                Tok::Dot => self.member(tree),
                Tok::LBracket => self.index(tree),
                Tok::LParen if calls => self.call(tree),
                Tok::Caret => {
                    self.bump();
                    let span = self.since(tree.expr.span);
                    self.grown(Expr { kind: ExprKind::Deref(Box::new(tree.expr)), span }, tree.height)
                }
                _ => break,
            };
        }
        tree
    }

    /// `.name`, `.3`, `.%X3`; the dot is the current token.
    fn member(&mut self, base: Tree) -> Tree {
        self.bump();
        let start = base.expr.span;
        let token = self.peek();
        let kind = match token.kind {
            Tok::Word => {
                let name = self.name();
                ExprKind::Member(Box::new(base.expr), name)
            }
            Tok::Int => {
                self.bump();
                match self.text_of(token).parse() {
                    Ok(index) => ExprKind::Part { base: Box::new(base.expr), size: AddressSize::Bit, index },
                    Err(_) => self.bad_part(token),
                }
            }
            Tok::Direct => self.part(base.expr, token),
            Tok::TypePrefix => self.qualified_value(&base.expr),
            _ => {
                self.expected("the name of a member, or the number of a bit, behind the point");
                return Tree::error(start);
            }
        };
        let span = self.since(start);
        self.grown(Expr { kind, span }, base.height)
    }

    /// `%X3`, or `%B1.7`: bit 7 of byte 1.
    fn part(&mut self, base: Expr, token: Token) -> ExprKind {
        let (text, span) = (self.text_of(token), self.span_of(token));
        let dot = text.find('.').unwrap_or(text.len());
        let read =
            address::partial(&text[..dot]).and_then(|first| Ok((first, text.get(dot + 1..).map(address::bit).transpose()?)));
        match read {
            Ok(((size, index), bit)) => {
                self.bump();
                let part = ExprKind::Part { base: Box::new(base), size, index };
                let Some(index) = bit else { return part };
                let base = Expr { kind: part, span: Span { end: span.start + dot as u32, ..span } };
                ExprKind::Part { base: Box::new(base), size: AddressSize::Bit, index }
            }
            Err(problem) => {
                self.soft(problem_diag(problem, span));
                self.bump();
                ExprKind::Error
            }
        }
    }

    fn bad_part(&mut self, token: Token) -> ExprKind {
        self.soft(Diag::new(Code::BadAddress, self.span_of(token), "not the number of a bit"));
        ExprKind::Error
    }

    fn index(&mut self, base: Tree) -> Tree {
        let bracket = self.here();
        self.bump();
        let start = base.expr.span;
        let (mut list, mut height) = (Vec::new(), base.height);
        loop {
            let tree = self.binary(1);
            height = height.max(tree.height);
            list.push(tree.expr);
            if !self.eat(Tok::Comma) {
                break;
            }
        }
        self.closing(Tok::RBracket, "]", bracket);
        let span = self.since(start);
        self.grown(Expr { kind: ExprKind::Index(Box::new(base.expr), list), span }, height)
    }

    fn primary(&mut self) -> Tree {
        if let Some(literal) = self.literal() {
            return Tree::leaf(literal);
        }
        let token = self.peek();
        match token.kind {
            Tok::Word => self.word(),
            Tok::LParen => self.parenthesised(),
            Tok::Direct => Tree::leaf(self.direct()),
            Tok::Dot if self.nth(1).kind == Tok::Word => self.global_name(),
            Tok::Error => {
                self.lost = true; // reported by the lexer
                self.bump();
                Tree::error(self.span_of(token))
            }
            _ => self.no_operand(),
        }
    }

    fn parenthesised(&mut self) -> Tree {
        let start = self.here();
        self.bump();
        let mut inner = self.binary(1);
        if self.at(Tok::Assign) && !self.lost {
            inner = self.assignment(inner);
        }
        self.closing(Tok::RParen, ")", start);
        Tree { expr: Expr { span: self.since(start), ..inner.expr }, height: inner.height }
    }

    /// `:= value` behind a variable in parentheses (vendor).
    fn assignment(&mut self, target: Tree) -> Tree {
        self.codesys_form("an assignment inside of an expression");
        self.bump();
        let value = self.binary(1);
        let (span, height) = (self.since(target.expr.span), target.height.max(value.height));
        let kind = ExprKind::Assign { target: Box::new(target.expr), value: Box::new(value.expr) };
        self.grown(Expr { kind, span }, height)
    }

    /// A direct address such as `%IX1.2`.
    fn direct(&mut self) -> Expr {
        let token = self.bump();
        let span = self.span_of(token);
        match address::direct(self.text_of(token), span) {
            Ok(address) => Expr { kind: ExprKind::Direct(address), span },
            Err(problem) => {
                self.soft(problem_diag(problem, span));
                error(span)
            }
        }
    }

    /// A name, TRUE, FALSE, or a keyword that is a function when a parenthesis follows.
    fn word(&mut self) -> Tree {
        let token = self.peek();
        let span = self.span_of(token);
        let kind = match token.kw {
            Kw::True | Kw::False => {
                self.bump();
                return Tree::leaf(Expr { kind: ExprKind::Literal(Literal::Bool(token.kw == Kw::True)), span });
            }
            Kw::Null if !self.is_used_as_name(token.kw) => {
                self.bump();
                ExprKind::Null
            }
            Kw::This | Kw::Super if !self.is_used_as_name(token.kw) => {
                let name = self.bare_name();
                self.eat(Tok::Caret); // vendor
                ExprKind::Name(name)
            }
            kw if !kw.is_reserved() || self.is_used_as_name(kw) => ExprKind::Name(self.name()),
            kw if (is_function(kw) || kw.is_type()) && self.nth(1).kind == Tok::LParen => ExprKind::Name(self.bare_name()),
            kw if kw.is_type() && self.prev().kind == Tok::LParen && self.nth(1).kind == Tok::RParen => {
                ExprKind::Name(self.bare_name()) // SIZEOF(INT)
            }
            _ => return self.no_operand(),
        };
        Tree::leaf(Expr { kind, span })
    }

    /// The current word as written, without the checks for names.
    fn bare_name(&mut self) -> Name {
        let token = self.bump();
        Name { text: self.text_of(token).to_owned(), span: self.span_of(token) }
    }

    fn no_operand(&mut self) -> Tree {
        let span = self.here();
        if self.at(Tok::Dot) && self.nth(1).kind == Tok::Int && self.nth(1).start == span.end {
            let digits = self.text_of(self.nth(1));
            let diag = Diag::new(Code::BadNumber, span.to(self.span_of(self.nth(1))), "a digit is missing before the point");
            self.soft(diag.help(format!("write 0.{digits}")));
            self.bump();
            self.bump();
            return Tree::error(self.since(span));
        }
        let diag = self.expected_diag("an expression");
        self.error(match (self.prev().kind, self.kind()) {
            (Tok::Eq, Tok::Lt) => diag.help("write <="),
            (Tok::Eq, Tok::Gt) => diag.help("write >="),
            (Tok::Gt, Tok::Lt) => diag.help("write <>"),
            _ => diag,
        });
        Tree::error(span)
    }
}

/// Keywords that are also functions: `AND(a, b)`.
fn is_function(kw: Kw) -> bool {
    matches!(kw, Kw::And | Kw::Or | Kw::Xor | Kw::Mod | Kw::Not | Kw::Ref)
}
