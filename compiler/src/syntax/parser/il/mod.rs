//! Instruction List: a body is told from ST by its first instruction; a line end ends an instruction; a mistake costs its line.
//! From: IEC 61131-3 §7.2 (language reference §6.1).

mod args;
mod operator;

use super::cursor::Parser;
use crate::syntax::ast::{Expr, ExprKind, Name, Stmt, StmtKind};
use crate::syntax::il::{Instr, InstrKind, Line, Op, When};
use crate::syntax::lexer::Tok;
use operator::Word;
use takt_base::Span;
use takt_base::diag::{Code, Diag};

impl Parser<'_> {
    /// The instructions of a body as one statement; `None` if the body is not in Instruction List.
    pub(super) fn instruction_list(&mut self) -> Option<Stmt> {
        if !self.is_list() {
            return None;
        }
        let start = self.here();
        let mut lines = Vec::new();
        while !self.ends_list() {
            let before = self.pos;
            lines.push(self.line());
            if self.pos == before {
                self.bump();
            }
        }
        self.found_place();
        Some(Stmt { kind: StmtKind::Instructions(lines), span: self.since(start) })
    }

    fn ends_list(&self) -> bool {
        let kw = self.kw();
        let closes = kw.opens_declaration() || kw.ends_declaration() || kw.is_section();
        self.at_end() || closes || self.starts_unit_part()
    }

    /// True if the first instruction, behind its labels, can't be a statement.
    fn is_list(&self) -> bool {
        let mut n = 0;
        while self.nth(n).kind == Tok::Word && self.nth(n + 1).kind == Tok::Colon && self.nth(n + 2).kind != Tok::Eq {
            n += 2;
        }
        self.is_instruction(n) || self.is_formal_list(n)
    }

    /// True if `OP operand` stands there.
    fn is_instruction(&self, n: usize) -> bool {
        let Some(word) = self.operator_at(n) else { return false };
        let alone = !self.is_same_line(n + 1);
        let next = self.nth(n + 1).kind;
        match word {
            Word::Return(_) => alone || self.nth(n + 1).kind == Tok::Word,
            Word::Jump(_) => next == Tok::Word && !alone && self.nth(n + 2).kind != Tok::Semi,
            Word::Call(_) => next == Tok::Word && !alone,
            Word::Simple(Op::Not, _) => alone,
            Word::Simple(..) if self.nth(n).kw.is_reserved() => next != Tok::LParen,
            Word::Simple(..) => !alone && starts_operand(next) && !self.is_set_at(n + 1),
        }
    }

    /// True at `S=`, `R=`, `REF=`: what stands before it is a variable of an ST statement.
    fn is_set_at(&self, n: usize) -> bool {
        let (word, next) = (self.nth(n), self.nth(n + 1));
        next.kind == Tok::Eq && next.start == word.end
    }

    /// True if `function( .. )` without a `;` stands there, with an instruction behind it.
    fn is_formal_list(&self, n: usize) -> bool {
        const FAR: usize = 200;
        if self.nth(n).kind != Tok::Word || self.nth(n + 1).kind != Tok::LParen {
            return false;
        }
        let mut depth = 0;
        for i in n + 1..n + FAR {
            match self.nth(i).kind {
                Tok::LParen => depth += 1,
                Tok::RParen => depth -= 1,
                Tok::Semi | Tok::Eof => return false,
                _ => {}
            }
            if depth == 0 {
                return !self.is_same_line(i + 1) && self.is_instruction(i + 1);
            }
        }
        false
    }

    fn operator_at(&self, n: usize) -> Option<Word> {
        let token = self.nth(n);
        if !matches!(token.kind, Tok::Word | Tok::Amp) {
            return None;
        }
        operator::of(&Name { text: self.text_of(token).to_owned(), span: self.span_of(token) })
    }

    /// True if the token `n` ahead stands on the line of the one before it. Line ends in comments count.
    fn is_same_line(&self, n: usize) -> bool {
        let before =
            if self.pos + n == 0 { return false } else { self.tokens.list[(self.pos + n - 1).min(self.tokens.list.len() - 1)] };
        let between = self.text.get(before.end as usize..self.nth(n).start as usize).unwrap_or("");
        self.nth(n).kind != Tok::Eof && !between.contains(['\n', '\r', '\x0c'])
    }

    fn line(&mut self) -> Line {
        self.found_place();
        let mut label = None;
        if self.at(Tok::Word) && self.nth(1).kind == Tok::Colon && self.nth(2).kind != Tok::Eq {
            label = self.declared_name("a label");
            self.eat(Tok::Colon);
            if !self.is_same_line(0) {
                return Line { label, instr: None };
            }
        }
        let mut instr = self.instr(false);
        self.line_end(&mut instr.kind);
        Line { label, instr: Some(instr) }
    }

    /// What stands behind an instruction on its line is wrong, and so is the instruction then.
    fn line_end(&mut self, instr: &mut InstrKind) {
        if !self.lost && self.is_same_line(0) && !self.ends_list() {
            let diag = self.expected_diag("the end of the line");
            self.error(match self.kind() {
                Tok::Semi => diag.help("an instruction ends with its line, without `;`"),
                _ => diag.help("write one instruction a line"),
            });
        }
        if self.lost {
            *instr = InstrKind::Error;
            self.skip_line();
        }
    }

    fn skip_line(&mut self) {
        while self.is_same_line(0) {
            self.bump();
        }
        self.found_place();
    }

    /// An instruction; `inner`: inside of parentheses.
    fn instr(&mut self, inner: bool) -> Instr {
        let start = self.here();
        let kind = if self.enter() { self.instr_kind(inner) } else { InstrKind::Error };
        self.leave();
        Instr { kind, span: self.since(start) }
    }

    fn instr_kind(&mut self, inner: bool) -> InstrKind {
        if !matches!(self.kind(), Tok::Word | Tok::Amp) || self.kw().opens_statement() || self.kw().ends_statements() {
            let diag = self.expected_diag("an instruction");
            self.error(match self.kw().is_reserved() {
                true => diag.help("a body is in Instruction List or in ST, not in both"),
                false => diag,
            });
            return InstrKind::Error;
        }
        let token = self.bump();
        let name = Name { text: self.text_of(token).to_owned(), span: self.span_of(token) };
        let Some(word) = operator::of(&name) else { return self.function(name) };
        let takes_list = word.defers() || matches!(word, Word::Simple(Op::Not, _));
        if takes_list && self.is_same_line(0) && (self.opens_formal() || self.has_more_operands()) {
            return self.function(name);
        }
        let word = self.modifier(word);
        if inner && !matches!(word, Word::Simple(..)) {
            self.not_inside(&name);
            return InstrKind::Error;
        }
        match word {
            Word::Simple(op, negated) => self.simple(op, negated, &name),
            Word::Jump(when) => self.jump(when, &name),
            Word::Call(when) => self.call_instance(when, &name),
            Word::Return(when) => InstrKind::Return(when),
        }
    }

    fn not_inside(&mut self, name: &Name) {
        let diag = Diag::new(Code::NotInParentheses, name.span, "between ( and )");
        self.error(diag.help("close the parenthesis first; it holds LD, operators and functions"));
    }

    /// A modifier that stands apart from its operator: a name that something else follows.
    fn modifier(&mut self, word: Word) -> Word {
        if !self.is_same_line(0) || !self.at(Tok::Word) {
            return word;
        }
        let Some(modified) = word.modified(self.text_of(self.peek())) else { return word };
        let next = self.nth(1).kind;
        let follows = self.is_same_line(1) && (starts_operand(next) || next == Tok::LParen);
        if follows || matches!(word, Word::Return(_)) {
            self.bump();
            return modified;
        }
        word
    }

    fn simple(&mut self, op: Op, negated: bool, name: &Name) -> InstrKind {
        let attempt = op == Op::Store && !negated && self.eat(Tok::Question);
        let op = if attempt { Op::Attempt } else { op };
        let has_operand = self.is_same_line(0) && !self.at(Tok::RParen);
        if matches!(op, Op::Binary(_)) && has_operand && self.at(Tok::LParen) {
            return self.deferred(op, negated);
        }
        if op == Op::Not {
            return InstrKind::Simple { op, negated, operand: None };
        }
        if !has_operand {
            self.no_operand_of(name);
            return InstrKind::Error;
        }
        let operand = self.operand();
        InstrKind::Simple { op, negated, operand: Some(operand) }
    }

    fn no_operand_of(&mut self, name: &Name) {
        let diag = Diag::new(Code::InstructionOperand, name.span, "nothing behind it on this line");
        self.soft_at(diag);
    }

    /// Reports about what was taken already.
    fn soft_at(&mut self, diag: Diag) {
        if !self.lost {
            self.soft(diag);
            self.lost = true;
        }
    }

    /// From `(` to `)`.
    fn deferred(&mut self, op: Op, negated: bool) -> InstrKind {
        let opener = self.here();
        self.bump();
        let mut list = Vec::new();
        if self.is_same_line(0) && !self.at(Tok::RParen) && self.operator_before_operand().is_none() {
            let operand = self.operand();
            let span = operand.span;
            let mut kind = InstrKind::Simple { op: Op::Load, negated: false, operand: Some(operand) };
            if !self.at(Tok::RParen) {
                self.line_end(&mut kind);
            }
            list.push(Instr { kind, span });
        }
        list.append(&mut self.inner_list(opener));
        InstrKind::Deferred { op, negated, list }
    }

    /// `(LD x`: an operator behind the parenthesis, no operand.
    fn operator_before_operand(&self) -> Option<Word> {
        self.operator_at(0).filter(|_| self.is_same_line(1) && starts_operand(self.nth(1).kind))
    }

    /// Instructions up to the closing parenthesis, which is taken.
    fn inner_list(&mut self, opener: Span) -> Vec<Instr> {
        let mut list = Vec::new();
        loop {
            if self.eat(Tok::RParen) {
                self.found_place();
                return list;
            }
            if self.ends_list() {
                let diag = self.expected_diag("`)`").also(opener, "the parenthesis is opened here");
                self.soft(diag);
                return list;
            }
            let before = self.pos;
            if self.at(Tok::Word) && self.nth(1).kind == Tok::Colon && self.nth(2).kind != Tok::Eq {
                let name = Name { text: String::new(), span: self.here() };
                self.not_inside(&name);
                self.skip_line();
                continue;
            }
            let mut instr = self.instr(true);
            if !self.at(Tok::RParen) || self.lost {
                self.line_end(&mut instr.kind);
            }
            list.push(instr);
            if self.pos == before {
                self.bump();
            }
        }
    }

    fn jump(&mut self, when: When, name: &Name) -> InstrKind {
        if !self.is_same_line(0) || !self.at(Tok::Word) {
            self.no_operand_of(name);
            return InstrKind::Error;
        }
        InstrKind::Jump { when, label: self.name() }
    }

    /// A function, or nonsense.
    fn function(&mut self, name: Name) -> InstrKind {
        if self.is_same_line(0) && self.at(Tok::LParen) {
            let formal = self.opens_formal();
            let opener = self.here();
            self.bump();
            let args = self.il_args(opener);
            return InstrKind::Function { name, args, formal };
        }
        let args = if self.is_same_line(0) && starts_operand(self.kind()) { self.positional() } else { Vec::new() };
        if !self.lost && self.is_same_line(0) && self.at(Tok::Assign) {
            let diag = self.expected_diag("an operand");
            self.error(diag.help("Instruction List assigns with ST; a body is in Instruction List or in ST, not in both"));
        }
        InstrKind::Function { name, args, formal: false }
    }
}

/// The nearest operator to a word that is none.
pub(crate) fn nearest_operator(word: &str) -> Option<&'static str> {
    takt_base::nearest(&word.to_ascii_uppercase(), operator::WORDS.iter().copied())
}

/// True for tokens that an operand begins with.
fn starts_operand(kind: Tok) -> bool {
    use Tok::*;
    let literal = matches!(kind, Int | Real | Based | BadNumber | Duration | Date | String | WString | TypePrefix);
    literal || matches!(kind, Word | Direct | Minus | Plus)
}

/// The error node of an operand.
fn error(span: Span) -> Expr {
    Expr { kind: ExprKind::Error, span }
}
