//! Text to tokens: logos finds the shapes, this file closes comments, pragmas, strings, durations and dates.
//! White space and comments are dropped. Linear in the length of the text; no recursion.
//! From: IEC 61131-3 §6.1 to §6.3 (language reference §1).

use super::conditional::{Conditional, Mistake};
use super::keyword::Kw;
use super::report::Report;
use super::silence::{Silence, Silences};
use logos::{Lexer, Logos};
use takt_base::diag::{Code, Diag};
use takt_base::{Profile, SourceId, Span};

/// Shape of a token.
#[derive(Logos, Clone, Copy, PartialEq, Eq, Debug)]
#[logos(skip r"[ \t\r\n\x0b\x0c]+")]
#[logos(skip(r"//[^\r\n]*", allow_greedy = true))]
pub(crate) enum Tok {
    #[regex(r"[_\p{L}][_\p{L}\p{Nd}]*")]
    Word,
    /// `INT#`, `Color#`: what follows belongs to it.
    #[regex(r"[_\p{L}][_\p{L}\p{Nd}]*#")]
    TypePrefix,
    #[regex(r"[0-9][0-9_]*")]
    Int,
    #[regex(r"[0-9]+#[0-9A-Za-z_]*")]
    Based,
    #[regex(r"[0-9][0-9_]*\.[0-9][0-9_]*([eE][+-]?[0-9][0-9_]*)?")]
    #[regex(r"[0-9][0-9_]*[eE][+-]?[0-9][0-9_]*", priority = 20)]
    Real,
    /// `12abc`.
    #[regex(r"[0-9][0-9_]*[A-Za-z][0-9A-Za-z_]*")]
    BadNumber,
    /// `T#1h30m`, prefix included.
    Duration,
    /// `D#..`, `TOD#..`, `DT#..`, prefix included.
    Date,
    /// With both quotes.
    #[token("'")]
    String,
    #[token("\"")]
    WString,
    /// `%IX1.2`, `%X3`.
    #[regex(r"%[A-Za-z0-9*][A-Za-z0-9_*]*(\.[0-9][0-9_]*)*")]
    Direct,
    #[token("(*")]
    Comment,
    #[token("/*")]
    CComment,
    #[token("{")]
    Pragma,
    #[token(":=")]
    Assign,
    #[token("?=")]
    RefAssign,
    #[token("=>")]
    Arrow,
    #[token("..")]
    Range,
    #[token("(")]
    LParen,
    #[token(")")]
    RParen,
    #[token("[")]
    LBracket,
    #[token("]")]
    RBracket,
    #[token("}")]
    RBrace,
    #[token(",")]
    Comma,
    #[token(";")]
    Semi,
    #[token(":")]
    Colon,
    #[token(".")]
    Dot,
    #[token("#")]
    Hash,
    #[token("^")]
    Caret,
    #[token("+")]
    Plus,
    #[token("-")]
    Minus,
    #[token("*")]
    Star,
    #[token("**")]
    Power,
    #[token("/")]
    Slash,
    #[token("&")]
    Amp,
    #[token("<")]
    Lt,
    #[token(">")]
    Gt,
    #[token("<=")]
    Le,
    #[token(">=")]
    Ge,
    #[token("=")]
    Eq,
    #[token("<>")]
    Ne,
    // Operators of other languages, understood in order to say what to write instead.
    #[token("==")]
    CEq,
    #[token("!=")]
    CNe,
    #[token("&&")]
    CAnd,
    #[token("|")]
    #[token("||")]
    COr,
    #[token("!")]
    CNot,
    #[token("%")]
    CMod,
    #[token("+=")]
    #[token("-=")]
    #[token("*=")]
    #[token("/=")]
    CUpdate,
    /// The `?` of `ST?` (Instruction List).
    Question,
    /// Something that has been reported.
    Error,
    Eof,
}

/// A token and its place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Token {
    pub(crate) kind: Tok,
    /// Mark of a word; [`Kw::None`] for other shapes.
    pub(crate) kw: Kw,
    pub(crate) start: u32,
    pub(crate) end: u32,
}

/// Tokens of a file.
pub(crate) struct Tokens {
    /// Ends with [`Tok::Eof`].
    pub(crate) list: Vec<Token>,
    /// Positions in `list` before which `{external}` stands, ascending.
    pub(crate) external: Vec<usize>,
    /// The same for `{attribute 'qualified_only'}`.
    pub(crate) qualified_only: Vec<usize>,
    /// Inline C of MATIEC: the position in `list` behind it, and its place; ascending.
    pub(crate) inline_c: Vec<(usize, Span)>,
    /// `{test ...}` pragmas: position in `list` of the token that follows, and text with its place, ascending.
    pub(crate) tests: Vec<(usize, String, Span)>,
    /// Regions of `{warning disable ..}`.
    pub(crate) silenced: Vec<Silence>,
    /// A comment or pragma that is not closed (and has been reported) hides the end of the text.
    pub(crate) cut: bool,
}

/// In a CODESYS 2 export: comments nest in this file (language reference §17).
const NESTED_MARK: &str = "@NESTEDCOMMENTS := 'Yes'";
/// Some editors write it at the start of a file; it means nothing there.
const BYTE_ORDER_MARK: char = '\u{feff}';

/// Splits the text; reports what is not closed and what is no token.
pub(crate) fn lex(text: &str, source: SourceId, profile: Profile, report: &mut Report) -> Tokens {
    let nested = profile.nests_comments() || text.contains(NESTED_MARK);
    let mut scan = Scan {
        logos: Tok::lexer(text),
        source,
        report,
        nested,
        external: Vec::new(),
        qualified_only: Vec::new(),
        inline_c: Vec::new(),
        tests: Vec::new(),
        silences: Silences::default(),
        resumed: false,
        conditional: Conditional::default(),
        profile,
        cut: false,
    };
    if text.starts_with(BYTE_ORDER_MARK) {
        scan.logos.bump(BYTE_ORDER_MARK.len_utf8());
    }
    let mut list: Vec<Token> = Vec::with_capacity(text.len() / 5 + 1);
    while let Some(next) = scan.logos.next() {
        let start = scan.logos.span().start;
        let kind = match next {
            Ok(Tok::Comment) => scan.comment(b'(', b')'),
            Ok(Tok::CComment) => scan.comment(b'/', b'/'),
            Ok(Tok::Pragma) => scan.pragma(list.len()),
            Ok(kind) => Some(scan.finish(kind)),
            Err(()) if scan.is_attempt(list.last()) => Some(Tok::Question),
            Err(()) => scan.unexpected(),
        };
        let Some(kind) = kind.filter(|_| scan.conditional.is_active()) else { continue };
        let kw = if kind == Tok::Word { Kw::of(scan.logos.slice()) } else { Kw::None };
        let kw = if !profile.reserves_new_words() && kw.is_new() { Kw::None } else { kw };
        list.push(Token { kind, kw, start: start as u32, end: scan.logos.span().end as u32 });
        if profile == Profile::Codesys2 && kind == Tok::Word && is_graphic_body(scan.logos.slice()) {
            scan.skip_graphic_body();
        }
    }
    scan.close_conditional();
    let end = text.len() as u32;
    list.push(Token { kind: Tok::Eof, kw: Kw::None, start: end, end });
    Tokens {
        list,
        external: scan.external,
        qualified_only: scan.qualified_only,
        inline_c: scan.inline_c,
        tests: scan.tests,
        silenced: scan.silences.finish(),
        cut: scan.cut,
    }
}

/// The word that opens a graphical body in a CODESYS 2 export (language reference §17).
pub(crate) fn is_graphic_body(word: &str) -> bool {
    ["_FBD_BODY", "_LD_BODY", "_SFC_BODY", "_CFC_BODY"].iter().any(|w| w.eq_ignore_ascii_case(word))
}

struct Scan<'t, 'r, 's> {
    logos: Lexer<'t, Tok>,
    source: SourceId,
    /// Comments nest.
    nested: bool,
    report: &'r mut Report<'s>,
    external: Vec<usize>,
    qualified_only: Vec<usize>,
    inline_c: Vec<(usize, Span)>,
    tests: Vec<(usize, String, Span)>,
    silences: Silences,
    /// Something that is never closed was left open.
    resumed: bool,
    /// `{IF ..}` of CODESYS; not followed in other profiles.
    conditional: Conditional,
    profile: Profile,
    cut: bool,
}

impl Scan<'_, '_, '_> {
    fn span(&self) -> Span {
        let range = self.logos.span();
        Span::new(self.source, range.start, range.end)
    }

    /// Takes bytes of the rest as long as they please; they must be ASCII.
    fn take_while(&mut self, mut wanted: impl FnMut(u8, Option<u8>) -> bool) {
        let rest = self.logos.remainder().as_bytes();
        let n = (0..rest.len()).find(|&i| !rest[i].is_ascii() || !wanted(rest[i], rest.get(i + 1).copied()));
        self.logos.bump(n.unwrap_or(rest.len()));
    }

    /// To the line that ends the unit: what lies between is not in any textual language.
    fn skip_graphic_body(&mut self) {
        let rest = self.logos.remainder();
        let ends = |line: &str| ["END_PROGRAM", "END_FUNCTION", "END_ACTION"].iter().any(|e| line.trim_start().starts_with(e));
        let mut skipped = 0;
        for line in rest.split_inclusive('\n') {
            if ends(line) {
                break;
            }
            skipped += line.len();
        }
        self.logos.bump(skipped);
    }

    fn finish(&mut self, kind: Tok) -> Tok {
        match kind {
            Tok::Int => self.after_int(),
            Tok::TypePrefix => self.after_prefix(),
            Tok::String => self.string(b'\'', kind),
            Tok::WString => self.string(b'"', kind),
            kind => kind,
        }
    }

    /// `1.` is a real (vendor), `1..5` a range, `1.E3` a mistake.
    fn after_int(&mut self) -> Tok {
        let rest = self.logos.remainder().as_bytes();
        if rest.first() != Some(&b'.') {
            return Tok::Int;
        }
        match (rest.get(1), rest.get(2)) {
            (Some(b'e' | b'E'), Some(b'0'..=b'9' | b'+' | b'-')) => {
                self.logos.bump(3);
                self.take_while(|b, _| b.is_ascii_alphanumeric() || b == b'_');
                Tok::BadNumber
            }
            (Some(&b), _) if b == b'.' || b == b'_' || b == b'%' || b.is_ascii_alphanumeric() || !b.is_ascii() => Tok::Int,
            _ => {
                self.logos.bump(1);
                Tok::Real
            }
        }
    }

    /// Durations and dates are one token; other prefixes stand alone.
    fn after_prefix(&mut self) -> Tok {
        let slice = self.logos.slice();
        let prefix = slice.strip_suffix('#').unwrap_or(slice);
        let is_one_of = |names: &[&str]| names.iter().any(|n| n.eq_ignore_ascii_case(prefix));
        if is_one_of(&["T", "TIME", "LT", "LTIME"]) {
            self.take_while(|b, _| matches!(b, b'+' | b'-'));
            self.take_while(|b, next| b.is_ascii_alphanumeric() || b == b'_' || b == b'.' && next != Some(b'.'));
            return Tok::Duration;
        }
        if is_one_of(&["D", "DATE", "LD", "LDATE"]) {
            self.take_while(|b, next| {
                b.is_ascii_alphanumeric() || b == b'_' || b == b'-' && next.is_some_and(|n| n.is_ascii_digit())
            });
            return Tok::Date;
        }
        if is_one_of(&["TOD", "TIME_OF_DAY", "LTOD", "LTIME_OF_DAY"]) {
            self.take_while(|b, next| {
                b.is_ascii_alphanumeric() || b == b'_' || b == b':' && next != Some(b'=') || is_inner_dot(b, next)
            });
            return Tok::Date;
        }
        if is_one_of(&["DT", "DATE_AND_TIME", "LDT", "LDATE_AND_TIME"]) {
            self.take_while(|b, next| {
                let inner = matches!(b, b'-' | b':') && next.is_some_and(|n| n.is_ascii_digit());
                b.is_ascii_alphanumeric() || b == b'_' || inner || is_inner_dot(b, next)
            });
            return Tok::Date;
        }
        Tok::TypePrefix
    }

    /// From behind the opening quote to the closing one; never past the end of the line.
    fn string(&mut self, quote: u8, kind: Tok) -> Tok {
        let rest = self.logos.remainder().as_bytes();
        let mut i = 0;
        while let Some(&b) = rest.get(i) {
            match b {
                b'\n' | b'\r' => break,
                b'$' if rest.get(i + 1).is_some_and(|b| b.is_ascii() && !matches!(b, b'\n' | b'\r')) => i += 2,
                b if b == quote => {
                    self.logos.bump(i + 1);
                    return kind;
                }
                _ => i += 1,
            }
        }
        self.logos.bump(i);
        let quote = quote as char;
        let diag = Diag::new(Code::UnterminatedString, self.span(), "the line ends inside this string");
        let help = match self.logos.slice().contains(&format!("${quote}")) {
            true => format!("${quote} is a quote inside of the string; write $${quote} for a dollar sign before its end"),
            false => format!("close it with {quote}; write $N for a line end and ${quote} for the quote itself"),
        };
        self.report.push(diag.help(help));
        Tok::Error
    }

    /// A comment, its opener already taken; nests with its own kind.
    fn comment(&mut self, open: u8, close: u8) -> Option<Tok> {
        let opener = self.span();
        let rest = self.logos.remainder().as_bytes();
        let (mut depth, mut i) = (1usize, 0);
        let mut inner = None;
        while depth > 0 {
            match (rest.get(i), rest.get(i + 1)) {
                (None, _) => break,
                (Some(b'*'), Some(&b)) if b == close => {
                    depth -= 1;
                    i += 2;
                }
                (Some(&b), Some(b'*')) if b == open && self.nested => {
                    depth += 1;
                    inner = Some(opener.end as usize + i);
                    i += 2;
                }
                _ => i += 1,
            }
        }
        let end = i.min(rest.len());
        if depth == 0 {
            self.logos.bump(end);
        } else {
            self.leave_open();
            let diag = Diag::new(Code::UnterminatedComment, opener, "opened here and still open at the end of the file");
            let diag = match inner {
                Some(at) => diag.also(Span::new(self.source, at, at + 2), "a comment inside it opens (comments nest)"),
                None => diag,
            };
            self.report.push(diag.help(if close == b')' { "close it with *)" } else { "close it with */" }));
        }
        None
    }

    /// A pragma, its brace already taken; `before` is the position of the token that follows.
    fn pragma(&mut self, before: usize) -> Option<Tok> {
        let opener = self.span();
        let rest = self.logos.remainder();
        let close = if rest.starts_with('{') { "}}" } else { "}" };
        let Some(n) = rest.find(close) else {
            self.leave_open();
            let diag = Diag::new(Code::UnterminatedComment, opener, "opened here and still open at the end of the file");
            self.report.push(diag.message("a pragma is not closed").help(format!("close it with {close}")));
            return None;
        };
        let text = rest[..n].trim_start_matches('{').trim();
        self.logos.bump(n + close.len());
        if text.eq_ignore_ascii_case("external") {
            self.external.push(before);
        } else if self.conditional.is_active() && self.silences.follow(text, opener.start) {
            // Followed.
        } else if super::test_pragma::is_test(text) {
            self.tests.push((before, text.to_owned(), Span { start: opener.start, ..self.span() }));
        } else if text.split_once(char::is_whitespace).is_some_and(|(a, b)| a == "attribute" && b.trim() == "'qualified_only'") {
            self.qualified_only.push(before);
        } else if self.profile.is_codesys()
            && let Some(followed) = self.conditional.follow(text)
        {
            self.check_conditional(followed);
        } else if self.profile == Profile::OpenPlc && is_inline_c(text) {
            let span = self.span();
            self.inline_c.push((before, span));
        } else if let Some(what) = unsupported_pragma(text) {
            let diag = Diag::new(Code::NotSupportedYet, self.span(), "would change the program");
            self.report.push(diag.message(format!("{what} is not supported by this version")));
        }
        None
    }

    /// Goes on where code follows what is never closed; once, so that the time stays linear.
    fn leave_open(&mut self) {
        let rest = self.logos.remainder();
        let end = super::unclosed::resume(rest).filter(|_| !self.resumed);
        self.cut |= end.is_none();
        self.resumed = true;
        self.logos.bump(end.unwrap_or(rest.len()));
    }

    fn check_conditional(&mut self, followed: Result<(), Mistake>) {
        let (label, help) = match followed {
            Ok(()) => return,
            Err(Mistake::Unopened) => ("no {IF} is open here", "open it with {IF defined(name)}"),
            Err(Mistake::Condition) => {
                ("this condition is not understood", "conditions are made of defined(name), NOT, AND, OR and parentheses")
            }
        };
        let diag = Diag::new(Code::Expected, self.span(), label);
        self.report.push(diag.message("conditional compilation goes wrong here").help(help));
    }

    /// Reports an `{IF}` without its end.
    fn close_conditional(&mut self) {
        if self.conditional.is_open() {
            let end = self.logos.source().len();
            let diag = Diag::new(Code::Expected, Span::new(self.source, end, end), "the file ends inside of an {IF}");
            self.report.push(diag.message("expected {END_IF}").help("close it with {END_IF}"));
        }
    }

    /// True at the `?` of `ST?`.
    fn is_attempt(&self, before: Option<&Token>) -> bool {
        let start = self.logos.span().start;
        let word = before.filter(|t| t.kind == Tok::Word && t.end as usize == start).map(|t| t.start as usize..start);
        let word = word.and_then(|range| self.logos.source().get(range));
        self.logos.slice() == "?" && word.is_some_and(|w| w.eq_ignore_ascii_case("ST"))
    }

    /// One message for a run of characters that start nothing.
    fn unexpected(&mut self) -> Option<Tok> {
        let rest = self.logos.remainder();
        let known =
            |c: char| c.is_ascii() && !matches!(c, '\0'..='\x08' | '\x0e'..='\x1f' | '$' | '?' | '@' | '\\' | '`' | '~' | '\x7f');
        let n = rest.find(|c: char| known(c) || c.is_alphabetic()).unwrap_or(rest.len());
        self.logos.bump(n);
        let first = self.logos.slice().chars().next().unwrap_or('\0');
        let label = if first.is_control() || first.is_whitespace() || first.is_ascii_control() {
            format!("the character U+{:04X}", first as u32)
        } else {
            format!("`{first}`, U+{:04X}", first as u32)
        };
        let diag = Diag::new(Code::UnexpectedCharacter, self.span(), label);
        self.report.push(match substitute(first) {
            Some(help) => diag.help(help),
            None => diag,
        });
        if first.is_whitespace() || first == '\u{feff}' { None } else { Some(Tok::Error) }
    }
}

/// A decimal point that is not the first of two.
fn is_inner_dot(b: u8, next: Option<u8>) -> bool {
    b == b'.' && next != Some(b'.')
}

/// Pragmas that can't be ignored without changing what the program does.
fn unsupported_pragma(text: &str) -> Option<&'static str> {
    let word = text.split(|c: char| c.is_whitespace() || c == '(').next().unwrap_or("");
    let is = |name: &str| word.eq_ignore_ascii_case(name);
    if is("IF") || is("ELSIF") || is("ELSE") || is("END_IF") {
        return Some("conditional compilation");
    }
    if is("#include") {
        return Some("the include pragma");
    }
    is_inline_c(text).then_some("inline C")
}

/// `{extern int x; ..}`
fn is_inline_c(text: &str) -> bool {
    text.trim_start_matches('{').split(char::is_whitespace).next().is_some_and(|w| w.eq_ignore_ascii_case("extern"))
}

/// What to type instead of a character that a word processor has put there.
fn substitute(c: char) -> Option<&'static str> {
    Some(match c {
        '\u{2018}' | '\u{2019}' | '`' | '\u{b4}' => "write a plain ' for strings",
        '\u{201c}' | '\u{201d}' | '\u{201e}' => "write a plain \" for wide strings",
        '\u{a0}' | '\u{200b}' | '\u{feff}' => "replace it by a blank",
        '\u{2013}' | '\u{2212}' => "write a plain -",
        '\u{2264}' => "write <=",
        '\u{2265}' => "write >=",
        '\u{2260}' => "write <>",
        _ => return None,
    })
}
