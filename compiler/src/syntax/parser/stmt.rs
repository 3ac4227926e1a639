//! Lists of statements, assignments, calls, IF and the one-word statements.
//! From: IEC 61131-3 §7.3.3 (language reference §5.1).

use super::cursor::Parser;
use crate::syntax::ast::{AssignOp, Expr, ExprKind, Stmt, StmtKind};
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::Tok;
use takt_base::Span;
use takt_base::diag::{Code, Diag};

impl Parser<'_> {
    /// Statements up to a keyword that ends them. Directly in a CASE, a label ends them too.
    pub(super) fn statements(&mut self, in_case: bool) -> Vec<Stmt> {
        let mut list = Vec::new();
        loop {
            if self.at_end() || in_case && self.is_label() || self.starts_unit_part() {
                return list;
            }
            let kw = self.kw().meant().filter(|_| !self.is_name_here()).unwrap_or(self.kw());
            if kw.ends_statements() && !self.is_name_here() {
                if self.is_stray(kw) {
                    self.stray(kw);
                    continue;
                }
                return list;
            }
            let before = self.pos;
            list.push(self.statement());
            if self.pos == before {
                self.bump();
            }
        }
    }

    /// True at a part of a unit that is no statement.
    pub(super) fn starts_unit_part(&self) -> bool {
        let kw = self.kw();
        let part = matches!(kw, Kw::Step | Kw::InitialStep | Kw::Transition | Kw::VarStat | Kw::VarInst);
        part && self.nth(1).kind == Tok::Word || self.starts_member() || self.starts_action()
    }

    /// True if the current word, keyword or not, is used as a name: `exit := TRUE`.
    fn is_name_here(&self) -> bool {
        matches!(self.nth(1).kind, Tok::Assign | Tok::Dot | Tok::LBracket)
    }

    /// True for a keyword that belongs to no statement that is open.
    fn is_stray(&self, kw: Kw) -> bool {
        let fits = |open: &Kw| match kw {
            Kw::Else => matches!(open, Kw::EndIf | Kw::EndCase),
            Kw::Elsif => *open == Kw::EndIf,
            Kw::Until => *open == Kw::EndRepeat,
            _ => true,
        };
        let is_part = matches!(kw, Kw::Else | Kw::Elsif | Kw::Until) || kw.ends_statement();
        is_part && !self.open.iter().any(fits)
    }

    fn stray(&mut self, kw: Kw) {
        let opener = match kw {
            Kw::Else => "IF or CASE",
            Kw::Elsif => "IF",
            Kw::Until => "REPEAT",
            _ => kw.text().trim_start_matches("END_"),
        };
        let diag = Diag::new(Code::Expected, self.here(), format!("no {opener} is open here"));
        self.soft(diag.message(format!("{} without {opener}", kw.text())));
        self.bump();
        self.eat(Tok::Semi);
        self.found_place();
    }

    /// A statement with its `;`.
    fn statement(&mut self) -> Stmt {
        let start = self.here();
        if !self.enter() {
            self.leave();
            self.skip_nested();
            return Stmt { kind: StmtKind::Error, span: start };
        }
        let kind = self.statement_kind();
        let simple = matches!(kind, StmtKind::Assign { .. } | StmtKind::Call(_));
        self.leave();
        let span = self.since(start);
        if !matches!(kind, StmtKind::Empty) {
            let whole = self.terminator();
            // What a mistake has cut off is not judged by its rest.
            if simple && !whole {
                return Stmt { kind: StmtKind::Error, span };
            }
        }
        Stmt { kind, span }
    }

    fn statement_kind(&mut self) -> StmtKind {
        if self.eat(Tok::Semi) {
            return StmtKind::Empty;
        }
        if self.is_name_here() {
            self.use_keyword_as_name();
            return self.assign_or_call();
        }
        match self.kw() {
            Kw::If => self.if_statement(),
            Kw::Case => self.case_statement(),
            Kw::For => self.for_statement(),
            Kw::While => self.while_statement(),
            Kw::Repeat => self.repeat_statement(),
            Kw::Exit => self.one_word(StmtKind::Exit),
            Kw::Continue => self.one_word(StmtKind::Continue),
            Kw::Return => self.return_statement(),
            Kw::Jmp if self.nth(1).kind == Tok::Word => self.jump_statement(),
            Kw::None if self.is_word("__TRY") => self.try_statement(),
            _ if self.at(Tok::Word) && self.nth(1).kind == Tok::Colon && self.nth(2).kind != Tok::Eq => self.label_statement(),
            _ => match self.misspelt_opener() {
                Some(kind) => kind,
                None => self.assign_or_call(),
            },
        }
    }

    fn one_word(&mut self, kind: StmtKind) -> StmtKind {
        self.bump();
        kind
    }

    fn return_statement(&mut self) -> StmtKind {
        self.bump();
        let alone = matches!(self.kind(), Tok::Semi | Tok::Eof) || self.is_first_on_line() || self.kw().ends_statements();
        StmtKind::Return((!alone).then(|| self.expr()))
    }

    /// `JMP label;` (vendor).
    fn jump_statement(&mut self) -> StmtKind {
        self.codesys_form("JMP");
        self.bump();
        StmtKind::Jump(self.name())
    }

    /// `label:` (vendor).
    fn label_statement(&mut self) -> StmtKind {
        self.codesys_form("a label");
        let name = self.name();
        self.bump();
        StmtKind::Label(name)
    }

    /// What ends a statement; false if it does not end where it should. After END_xxx it may be left out (vendor).
    fn terminator(&mut self) -> bool {
        if self.lost {
            self.skip_statement();
            return false;
        }
        if self.eat(Tok::Semi) || self.prev().kw.ends_statement() || self.prev().kind == Tok::Colon {
            return true; // behind a colon: a label
        }
        if self.is_first_on_line() || self.kw().ends_statements() || self.kw().opens_statement() || self.at_end() {
            let diag = self.missing_diag("`;`").message("expected `;` at the end of the statement");
            self.soft(diag);
            return true;
        }
        let diag = self.expected_diag("`;` or an operator");
        self.error(diag);
        self.skip_statement();
        false
    }

    fn assign_or_call(&mut self) -> StmtKind {
        let global = self.at(Tok::Dot) && self.nth(1).kind == Tok::Word;
        if !self.at(Tok::Word) && !self.at(Tok::Direct) && !global {
            self.no_statement();
            return StmtKind::Error;
        }
        if self.kw().is_reserved() && !self.is_name_here() && !self.is_callable_word() {
            self.no_statement();
            return StmtKind::Error;
        }
        let start = self.pos;
        let target = self.variable();
        if self.lost {
            return StmtKind::Error;
        }
        let is_call = matches!(target.kind, ExprKind::Call { .. } | ExprKind::Error);
        if self.profile.is_codesys() && !is_call && (self.at(Tok::Semi) || self.is_operator()) {
            self.pos = start;
            return StmtKind::Expression(self.expr());
        }
        match self.kind() {
            Tok::Assign => self.assign(target),
            Tok::Eq | Tok::CEq => self.equals_as_assign(target),
            Tok::CUpdate => self.update(target),
            Tok::RefAssign => {
                self.bump();
                StmtKind::Attempt { target, value: self.expr() }
            }
            Tok::Word if self.set_or_reset().is_some() => self.chain(Vec::new(), target),
            Tok::Word if self.is_word_and_equals("REF") => self.bind(target),
            _ => self.call_statement(target),
        }
    }

    /// A keyword that can stand before a parenthesis, or one that the file uses as a name.
    fn is_callable_word(&self) -> bool {
        let kw = self.kw();
        self.is_used_as_name(kw) || kw == Kw::Super || kw == Kw::This || kw.is_type() && self.nth(1).kind == Tok::LParen
    }

    fn no_statement(&mut self) {
        let diag = self.expected_diag("a statement");
        let diag = match self.kw() {
            Kw::Then | Kw::Do | Kw::Of => diag.help("the keyword that opens the statement is missing, or a `;` stands before it"),
            _ if self.at(Tok::RParen) || self.at(Tok::RBracket) => diag.help("this bracket was never opened"),
            _ => diag,
        };
        self.error(diag);
        self.bump();
    }

    /// `target REF= v`.
    fn bind(&mut self, target: Expr) -> StmtKind {
        self.codesys_form("REF=");
        self.bump();
        self.bump();
        StmtKind::Bind { target, value: self.expr() }
    }

    /// `S=` or `R=` behind a variable.
    fn set_or_reset(&self) -> Option<AssignOp> {
        match () {
            () if self.is_word_and_equals("S") => Some(AssignOp::Set),
            () if self.is_word_and_equals("R") => Some(AssignOp::Reset),
            () => None,
        }
    }

    pub(super) fn is_word_and_equals(&self, word: &str) -> bool {
        let (here, next) = (self.peek(), self.nth(1));
        word.eq_ignore_ascii_case(self.text_of(here)) && next.kind == Tok::Eq && next.start == here.end
    }

    /// `a S= b := value`: the targets so far, and what stands before the operator that makes it a chain.
    fn chain(&mut self, mut targets: Vec<(Expr, AssignOp)>, mut last: Expr) -> StmtKind {
        self.codesys_form(if self.at(Tok::Assign) { "a chain of assignments" } else { "S= and R=" });
        while let Some(op) = self.chain_operator() {
            self.bump();
            if op != AssignOp::Assign {
                self.bump();
            }
            targets.push((last, op));
            last = self.expr();
        }
        StmtKind::Chain { targets, value: last }
    }

    fn chain_operator(&self) -> Option<AssignOp> {
        if self.lost {
            return None;
        }
        if self.at(Tok::Assign) { Some(AssignOp::Assign) } else { self.set_or_reset() }
    }

    fn assign(&mut self, target: Expr) -> StmtKind {
        self.bump();
        let value = self.expr();
        if self.chain_operator().is_none() {
            return StmtKind::Assign { target, value };
        }
        self.chain(vec![(target, AssignOp::Assign)], value)
    }

    fn equals_as_assign(&mut self, target: Expr) -> StmtKind {
        let diag = self.expected_diag("`:=` in an assignment");
        self.soft(diag.help("write := to assign; = compares"));
        self.assign(target)
    }

    /// `x += 1`.
    fn update(&mut self, target: Expr) -> StmtKind {
        let operator = self.text_of(self.peek()).trim_end_matches('=');
        let name = self.text.get(target.span.start as usize..target.span.end as usize).unwrap_or("x");
        let diag = self.expected_diag("`:=` in an assignment");
        self.soft(diag.help(format!("write {name} := {name} {operator} ...")));
        self.bump();
        self.expr();
        StmtKind::Error
    }

    fn call_statement(&mut self, target: Expr) -> StmtKind {
        if matches!(target.kind, ExprKind::Call { .. }) {
            return StmtKind::Call(target);
        }
        if matches!(target.kind, ExprKind::Error) && !self.at(Tok::Colon) {
            return StmtKind::Error;
        }
        let name = self.text.get(target.span.start as usize..target.span.end as usize).unwrap_or("x");
        let diag = if self.is_first_on_line() {
            self.missing_diag("`:=` or `(`").message("expected `:=` or `(` behind the name")
        } else {
            self.expected_diag("`:=` or `(` behind the name")
        };
        let diag = match (self.kind(), self.nth(1).kind) {
            (Tok::Plus, Tok::Plus) => diag.help(format!("write {name} := {name} + 1")),
            (Tok::Minus, Tok::Minus) => diag.help(format!("write {name} := {name} - 1")),
            (Tok::Colon, Tok::Eq) => diag.help("write := without a blank"),
            (Tok::Semi, _) => diag.help(format!("write {name}() to call it, or {name} := ... to assign")),
            _ => diag,
        };
        self.error(diag);
        StmtKind::Error
    }

    /// A condition; `:=` in it is understood as `=`.
    pub(super) fn condition(&mut self) -> Expr {
        let condition = self.expr();
        if self.at(Tok::Assign) && !self.lost {
            let diag = self.expected_diag("`=` in a condition");
            self.soft(diag.help("write = to compare; := assigns"));
            self.bump();
            let right = self.expr();
            return super::expr::error(condition.span.to(right.span));
        }
        condition
    }

    pub(super) fn if_statement(&mut self) -> StmtKind {
        let opener = self.here();
        self.bump();
        self.open.push(Kw::EndIf);
        let mut branches = vec![self.branch(opener, "IF")];
        while let Some(elsif) = self.elsif() {
            branches.push(self.branch(elsif, "ELSIF"));
        }
        let is_else_if = self.kw() == Kw::Else && self.nth(1).kw == Kw::If;
        let otherwise = self.else_branch();
        let help = is_else_if.then_some("ELSE IF opens a second IF with an END_IF of its own; ELSIF does not");
        self.close(Kw::EndIf, opener, "IF", help);
        StmtKind::If { branches, otherwise }
    }

    /// ELSE and its statements. A second ELSE, or an ELSIF behind it, is reported unless an outer statement can have it.
    fn else_branch(&mut self) -> Vec<Stmt> {
        let start = self.here();
        if !self.eat_kw(Kw::Else) {
            return Vec::new();
        }
        let mut list = self.statements(false);
        while matches!(self.kw(), Kw::Else | Kw::Elsif) && !self.is_wanted_outside() {
            let diag = self.expected_diag("END_IF").also(start, "the ELSE of this IF is here");
            self.soft(diag.help("ELSE comes once, behind all ELSIF"));
            let part = self.here();
            if self.bump().kw == Kw::Elsif {
                self.branch(part, "ELSIF");
            } else {
                list.append(&mut self.statements(false));
            }
        }
        list
    }

    /// True if a statement around the innermost open one can have the current ELSE or ELSIF.
    fn is_wanted_outside(&self) -> bool {
        let outer = self.open.len().saturating_sub(1);
        let has_else = |kw: &Kw| *kw == Kw::EndIf || *kw == Kw::EndCase && self.kw() == Kw::Else;
        self.open.iter().take(outer).any(has_else)
    }

    /// Takes ELSIF, also misspelt.
    fn elsif(&mut self) -> Option<Span> {
        let here = self.here();
        if self.kw().meant() == Some(Kw::Elsif) {
            self.misspelt_keyword(Kw::Elsif);
        } else if self.kw() != Kw::Elsif {
            return None;
        }
        self.bump();
        Some(here)
    }

    fn branch(&mut self, opener: Span, name: &str) -> (Expr, Vec<Stmt>) {
        let condition = self.condition();
        self.expect_part(Kw::Then, opener, name);
        (condition, self.statements(false))
    }
}
