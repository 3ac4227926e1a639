//! Tests of the checker: a case is a text and the messages that it gives, `P2007 3:6`, or none.
//! Texts are parsed behind the standard library, as in a build.

mod asserts;
mod calls;
mod codes;
mod configuration;
mod constants;
mod conversions;
mod declarations;
mod expressions;
mod image;
mod mutations;
mod names;
mod operators;
mod places;
mod program;
mod statements;

use super::model::*;
use crate::syntax::{self, ast};
use takt_base::{Diag, Sink, SourceId, Sources};

/// Everything that came out of a text.
struct Built {
    hir: Hir,
    diags: Vec<Diag>,
    sources: Sources,
}

/// Builds a text named `a.st` behind the standard library.
fn build(text: &str) -> Built {
    build_with(&[], text)
}

/// Like [`build`], with more library files.
fn build_with(library: &[&str], text: &str) -> Built {
    let mut sources = Sources::new();
    for (name, text) in takt_stdlib::SOURCES {
        sources.add_library(*name, *text);
    }
    for text in library {
        sources.add_library("lib.st", *text);
    }
    sources.add("a.st", text);
    let mut sink = Sink::new();
    let ids: Vec<SourceId> = sources.iter().map(|(id, _)| id).collect();
    let files: Vec<(SourceId, ast::File)> = ids.into_iter().map(|id| (id, syntax::parse(&sources, id, &mut sink))).collect();
    let hir = super::build(&files, &sources, &mut sink);
    // Most texts declare more than they use; advice has tests of its own.
    sink.diags.retain(|d| !d.code.is_advice());
    Built { hir, diags: sink.into_sorted(), sources }
}

impl Built {
    /// `P2007 3:6, P1003 4:1`; empty if all is well.
    fn codes(&self) -> String {
        let place = |d: &Diag| self.sources.line_col(d.span.source, d.span.start);
        let one = |d: &Diag| format!("{} {}:{}", d.code.text(), place(d).line, place(d).column);
        self.diags.iter().map(one).collect::<Vec<_>>().join(", ")
    }

    /// The messages as the user reads them.
    fn text(&self) -> String {
        self.diags.iter().map(|d| takt_base::diag::render(d, &self.sources)).collect()
    }

    /// The unit of this name.
    fn pou(&self, name: &str) -> &Pou {
        self.hir.pous.iter().find(|p| p.name.eq_ignore_ascii_case(name)).expect("there is such a unit")
    }
}

/// Messages of a whole file.
fn check(text: &str) -> String {
    build(text).codes()
}

/// Messages of a program with these variables (line 2) and statements (line 4), behind declarations (line 1).
fn check_in(declarations: &str, vars: &str, body: &str) -> String {
    build(&program(declarations, vars, body)).codes()
}

fn program(declarations: &str, vars: &str, body: &str) -> String {
    assert!(!declarations.contains('\n') && !vars.contains('\n'));
    format!("{declarations} PROGRAM p VAR\n{vars}\nEND_VAR\n{body}\nEND_PROGRAM")
}

/// Messages of statements with variables of many types in scope; places are those of line 4.
fn stmt(body: &str) -> String {
    check_in(TYPES, VARS, body)
}

/// Declarations that [`stmt`] and [`expr`] find.
const TYPES: &str = "TYPE Light : (Red, Amber, Green); Mode : (Off, Auto, Hand) := Auto; Pct : INT (0..100) := 50; \
    Col : DWORD (Black := 0, White := 16#FFFFFF); Point : STRUCT x : REAL; y : REAL := 1.0; tag : STRING[8]; END_STRUCT; \
    Row : ARRAY [1..3] OF INT; END_TYPE \
    FUNCTION F : INT VAR_INPUT a : INT; b : INT := 7; END_VAR F := a + b; END_FUNCTION \
    FUNCTION G : BOOL VAR_INPUT a : REAL; END_VAR VAR_OUTPUT o : INT; q : BOOL; END_VAR VAR_IN_OUT io : DINT; END_VAR \
    G := a > 0.0; io := io + 1; o := 3; q := TRUE; END_FUNCTION \
    FUNCTION Pr VAR_INPUT a : INT; END_VAR END_FUNCTION \
    FUNCTION_BLOCK B VAR_INPUT i : INT; e : BOOL R_EDGE; END_VAR VAR_OUTPUT o : INT; q : BOOL; END_VAR \
    VAR_IN_OUT io : DINT; END_VAR VAR n : INT; END_VAR o := i; END_FUNCTION_BLOCK \
    FUNCTION_BLOCK S VAR_INPUT i : INT; END_VAR VAR_OUTPUT o : INT; END_VAR o := i; END_FUNCTION_BLOCK";

/// Variables of [`stmt`] and [`expr`]; their names are `v` and the type for elementary ones.
const VARS: &str = "vBOOL, b1, b2 : BOOL; vBYTE : BYTE; vWORD, w1 : WORD; vDWORD : DWORD; vLWORD : LWORD; \
    vSINT : SINT; vINT, i, j : INT; vDINT, d : DINT; vLINT : LINT; vUSINT : USINT; vUINT : UINT; vUDINT : UDINT; vULINT : ULINT; \
    vREAL, r : REAL; vLREAL : LREAL; vTIME, t : TIME; vLTIME : LTIME; vDATE : DATE; vLDATE : LDATE; vTOD : TOD; vLTOD : LTOD; \
    vDT : DT; vLDT : LDT; vCHAR : CHAR; vWCHAR : WCHAR; s : STRING; s8 : STRING[8]; ws : WSTRING; light : Light; mode : Mode; \
    pct : Pct; col : Col; p1, p2 : Point; row : Row; a : ARRAY [0..9] OF INT; m : ARRAY [1..2, 0..3] OF REAL; \
    ps : ARRAY [1..2] OF Point; ton1 : TON; fb : B; fs : S; fbs : ARRAY [0..3] OF S; rows : ARRAY [0..1] OF Row;";

/// The type of an expression, or its messages without places. `want` is the type of what it is assigned to, if any.
fn expr(text: &str) -> String {
    let built = build(&program(TYPES, VARS, &format!("IF b1 THEN MOVE({text}); END_IF;")));
    if !built.diags.is_empty() {
        return built.diags.iter().map(|d| d.code.text()).collect::<Vec<_>>().join(" ");
    }
    let pou = built.pou("p");
    let Some(StmtKind::If { branches, .. }) = pou.body.first().map(|s| &s.kind) else { return "no statement".to_owned() };
    match branches[0].1.first().map(|s| &s.kind) {
        Some(StmtKind::Call(Expr { kind: ExprKind::Intrinsic(_, args), ty, .. })) => match &args[0].kind {
            ExprKind::Const(c) => format!("{} {}", built.hir.types.display(*ty), show(c)),
            _ => built.hir.types.display(*ty),
        },
        Some(StmtKind::Call(Expr { kind: ExprKind::Const(c), ty, .. })) => {
            format!("{} {}", built.hir.types.display(*ty), show(c))
        }
        other => format!("{other:?}"),
    }
}

/// A constant as text.
fn show(c: &Const) -> String {
    match c {
        Const::Int(v) => v.to_string(),
        Const::Real(v) => format!("{v:?}"),
        Const::String(s) => format!("'{}'", String::from_utf8_lossy(s)),
        Const::WString(s) => format!("\"{}\"", String::from_utf16_lossy(s)),
        Const::Aggregate(parts) => format!("[{}]", parts.iter().map(show).collect::<Vec<_>>().join(", ")),
        Const::Zero => "0".to_owned(),
        Const::Address(g, bytes) => format!("REF({g:?}+{bytes})"),
    }
}

/// Initial value of a variable, completed or `0` for all zero, or its messages.
fn init(declarations: &str, decl: &str) -> String {
    let built = build(&program(declarations, &format!("x : {decl};"), ""));
    match built.diags.is_empty() {
        true => show(&built.pou("p").vars.iter().next().expect("x is there").init),
        false => built.codes(),
    }
}

/// Each text must be accepted.
fn accept(what: fn(&str) -> String, texts: &[&str]) {
    let cases: Vec<_> = texts.iter().map(|t| (*t, "")).collect();
    expect(what, &cases);
}

/// Each text must give these messages. Shows all that don't.
fn expect(what: fn(&str) -> String, cases: &[(&str, &str)]) {
    let line = |(text, want): &(&str, &str)| {
        let got = what(text);
        (got != *want).then(|| format!("{text}\n     want {want}\n      got {got}\n"))
    };
    let wrong: Vec<String> = cases.iter().filter_map(line).collect();
    assert!(wrong.is_empty(), "\n{}", wrong.concat());
}
