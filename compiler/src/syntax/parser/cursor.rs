//! The parser's place in the tokens, its nesting counter and its messages.

use crate::syntax::ast::{AccessDecl, Name};
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::{Tok, Token, Tokens};
use crate::syntax::report::Report;
use std::collections::HashSet;
use takt_base::diag::{Code, Diag};
use takt_base::source::Source;
use takt_base::{Profile, SourceId, Span};

/// Deepest nesting of statements, types, initial values and expressions, counted together.
pub(super) const MAX_DEPTH: u32 = 200;

/// What the file is read with.
pub(super) struct Parser<'a> {
    pub(super) text: &'a str,
    pub(super) source: SourceId,
    pub(super) tokens: Tokens,
    pub(super) pos: usize,
    report: Report<'a>,
    /// A mistake was reported and the parser has not found its place again.
    pub(super) lost: bool,
    /// Position of the last message: there is only one for each token.
    last_error: usize,
    depth: u32,
    /// Nesting that is too deep was reported; not again before it has ended.
    deep: bool,
    /// Closing keywords of the statements that are open.
    pub(super) open: Vec<Kw>,
    /// An unclosed statement was reported; the ones around it are not, up to the end of the unit.
    pub(super) unwinding: bool,
    /// Keywords that the file uses as names; reported once.
    named: HashSet<u8>,
    /// Names with misplaced underscores; reported once.
    misspelt: HashSet<String>,
    library: bool,
    /// Dialect of the file.
    pub(super) profile: Profile,
    /// A character of a string is one byte.
    pub(super) latin1: bool,
    /// Positions from the first to the second have no section keyword between; see `var`.
    pub(super) section_ahead: (usize, usize),
    /// VAR_ACCESS of the unit or configuration at hand.
    pub(super) access_paths: Vec<AccessDecl>,
}

impl<'a> Parser<'a> {
    pub(super) fn new(file: &'a Source, source: SourceId, tokens: Tokens, report: Report<'a>) -> Self {
        Self {
            text: &file.text,
            source,
            tokens,
            pos: 0,
            report,
            lost: false,
            last_error: usize::MAX,
            depth: 0,
            deep: false,
            open: Vec::new(),
            unwinding: false,
            named: HashSet::new(),
            misspelt: HashSet::new(),
            library: file.library,
            profile: file.profile,
            latin1: file.latin1,
            section_ahead: (0, 0),
            access_paths: Vec::new(),
        }
    }

    // --- looking ---

    /// The token `n` places ahead; the end of the file stands for everything behind it.
    pub(super) fn nth(&self, n: usize) -> Token {
        let last = self.tokens.list.len() - 1;
        self.tokens.list[(self.pos + n).min(last)]
    }
    pub(super) fn peek(&self) -> Token {
        self.tokens.list[self.pos]
    }
    pub(super) fn kind(&self) -> Tok {
        self.peek().kind
    }
    pub(super) fn kw(&self) -> Kw {
        self.peek().kw
    }
    pub(super) fn at(&self, kind: Tok) -> bool {
        self.kind() == kind
    }
    pub(super) fn at_end(&self) -> bool {
        self.at(Tok::Eof)
    }
    /// The token before the current one; the current one at the start of the file.
    pub(super) fn prev(&self) -> Token {
        self.tokens.list[self.pos.saturating_sub(1)]
    }
    pub(super) fn text_of(&self, token: Token) -> &'a str {
        self.text.get(token.start as usize..token.end as usize).unwrap_or("")
    }
    pub(super) fn span_of(&self, token: Token) -> Span {
        Span { source: self.source, start: token.start, end: token.end }
    }
    pub(super) fn here(&self) -> Span {
        self.span_of(self.peek())
    }
    /// From `start` to the end of the last token taken.
    pub(super) fn since(&self, start: Span) -> Span {
        Span { end: self.prev().end.max(start.end), ..start }
    }
    /// True if no blank stands between the last token and the current one.
    pub(super) fn is_adjacent(&self) -> bool {
        self.prev().end == self.peek().start
    }
    /// True if the current token is the first of its line.
    pub(super) fn is_first_on_line(&self) -> bool {
        let between = self.text.get(self.prev().end as usize..self.peek().start as usize).unwrap_or("");
        self.pos == 0 || between.contains(['\n', '\r', '\x0c'])
    }

    // --- taking ---

    pub(super) fn bump(&mut self) -> Token {
        let token = self.peek();
        if token.kind != Tok::Eof {
            self.pos += 1;
        }
        token
    }
    pub(super) fn eat(&mut self, kind: Tok) -> bool {
        let is = self.at(kind);
        if is {
            self.bump();
        }
        is
    }
    pub(super) fn eat_kw(&mut self, kw: Kw) -> bool {
        let is = self.kw() == kw;
        if is {
            self.bump();
        }
        is
    }
    /// Takes a token of this kind or reports that it is missing.
    pub(super) fn expect(&mut self, kind: Tok, what: &str) -> bool {
        self.eat(kind) || {
            self.expected(what);
            false
        }
    }

    // --- nesting ---

    /// Counts a level of nesting; false (and a message) if there are too many. Pairs with [`Parser::leave`] also then.
    pub(super) fn enter(&mut self) -> bool {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            self.too_deep(format!("more than {MAX_DEPTH} levels of nesting"));
            return false;
        }
        true
    }
    pub(super) fn leave(&mut self) {
        self.depth -= 1;
        self.deep &= self.depth > 0;
    }
    pub(super) fn too_deep(&mut self, label: String) {
        self.lost |= self.deep;
        self.deep = true;
        let diag = Diag::new(Code::NestedTooDeep, self.here(), label);
        self.error(diag.help("split it: give a part its own variable, function or type"));
    }

    // --- messages ---

    /// Reports, then is silent until [`Parser::found_place`].
    pub(super) fn error(&mut self, diag: Diag) {
        self.soft(diag);
        self.lost = true;
    }
    /// Reports a mistake that the parser understands: it goes on as if the right thing stood there.
    pub(super) fn soft(&mut self, diag: Diag) {
        let reported_by_lexer = self.at(Tok::Error) || self.at_end() && self.tokens.cut;
        if !self.lost && !reported_by_lexer && self.last_error != self.pos {
            self.last_error = self.pos;
            self.report.push(diag);
        }
    }
    /// `what` is understood in every profile, and an error in one that is not CODESYS.
    pub(super) fn codesys_form(&mut self, what: &str) {
        if !self.profile.is_codesys() && !self.library {
            let diag = Diag::new(Code::VendorForm, self.here(), what.to_owned());
            self.soft(diag.help(Profile::CODESYS_HELP));
        }
    }
    /// Reports whatever was reported before.
    pub(super) fn report_always(&mut self, diag: Diag) {
        self.report.push(diag);
    }
    /// Reports a warning, whatever was reported before.
    pub(super) fn warn(&mut self, diag: Diag) {
        self.report.push(diag.severity(takt_base::diag::Severity::Warning));
    }
    /// The current token is not `what`.
    pub(super) fn expected(&mut self, what: &str) {
        let diag = self.expected_diag(what);
        self.error(diag);
    }
    pub(super) fn expected_diag(&self, what: &str) -> Diag {
        let token = self.peek();
        Diag::new(Code::Expected, self.span_of(token), self.describe(token)).message(format!("expected {what}"))
    }
    /// `what` is missing between the last token and the current one.
    pub(super) fn missing_diag(&self, what: &str) -> Diag {
        let at = self.span_of(self.prev()).end_point();
        Diag::new(Code::Expected, at, format!("{what} is missing here")).message(format!("expected {what}"))
    }
    pub(super) fn found_place(&mut self) {
        self.lost = false;
    }
    /// Names a token in a message.
    pub(super) fn describe(&self, token: Token) -> String {
        let text: String = self.text_of(token).chars().take(40).collect();
        match token.kind {
            Tok::Eof => "the file ends here".to_owned(),
            Tok::Word if token.kw.is_type() => format!("found the type name {text}"),
            Tok::Word if token.kw.is_reserved() => format!("found the keyword {}", token.kw.text()),
            Tok::Word => format!("found the name `{text}`"),
            Tok::Int | Tok::Real | Tok::Based => format!("found the number {text}"),
            Tok::Duration | Tok::Date => format!("found the literal {text}"),
            Tok::String | Tok::WString => "found a string".to_owned(),
            Tok::Direct => format!("found the address {text}"),
            _ => format!("found `{text}`"),
        }
    }

    // --- names ---

    /// A name that is declared here; `what` says of what. A keyword is reported once and then is a name.
    pub(super) fn declared_name(&mut self, what: &str) -> Option<Name> {
        if self.at(Tok::BadNumber) {
            let diag = Diag::new(Code::BadNumber, self.here(), format!("expected {what}"));
            self.error(diag.help("a name starts with a letter or an underscore"));
            return None;
        }
        let is_forgotten = self.kw().is_section() || self.kw().ends_declaration();
        if !self.at(Tok::Word) || is_forgotten {
            self.expected(what);
            return None;
        }
        if self.kw().is_reserved() {
            self.keyword_as_name(what);
        }
        Some(self.name())
    }
    /// The current word as a name, whatever it is.
    pub(super) fn name(&mut self) -> Name {
        let token = self.bump();
        let text = self.text_of(token);
        let span = self.span_of(token);
        if text.contains("__") || text.ends_with('_') {
            self.check_underscores(text, span);
        }
        Name { text: text.to_owned(), span }
    }
    fn keyword_as_name(&mut self, what: &str) {
        let token = self.peek();
        let is_free =
            token.kw.is_name_elsewhere() && self.profile.is_vendor() || token.kw.is_new_type() && self.profile.is_codesys();
        if self.named.insert(token.kw as u8) && !is_free {
            let text = self.text_of(token);
            let kind = if token.kw.is_type() { "a type of the standard" } else { "a keyword" };
            let diag = Diag::new(Code::KeywordAsName, self.span_of(token), format!("{text} is {kind}, not {what}"));
            self.soft(diag.help(format!("choose another name, for example {text}1")));
        }
    }
    /// A keyword that stands where a statement uses a name, such as `exit := TRUE`.
    pub(super) fn use_keyword_as_name(&mut self) {
        if self.kw().is_reserved() && !matches!(self.kw(), Kw::This | Kw::Super) {
            self.keyword_as_name("a variable");
        }
    }
    /// True if the file declares this keyword as a name.
    pub(super) fn is_used_as_name(&self, kw: Kw) -> bool {
        !self.named.is_empty() && self.named.contains(&(kw as u8))
    }
    fn check_underscores(&mut self, text: &str, span: Span) {
        if !self.library && !self.profile.takes_any_underscores() && self.misspelt.insert(text.to_ascii_uppercase()) {
            let mut good = text.trim_end_matches('_').to_owned();
            while good.contains("__") {
                good = good.replace("__", "_");
            }
            let diag = Diag::new(Code::BadIdentifier, span, "an underscore stands where none may");
            self.report.push(if good.is_empty() { diag } else { diag.help(format!("write {good}")) });
        }
    }
}
