//! Finds the literals of an expression and moves them into variables, so that nothing can be computed before run time.

use takt_stdlib::{Found, lookup};

/// A piece of an expression.
#[derive(Clone, PartialEq, Eq, Debug)]
enum Piece {
    /// Operators, names, parentheses.
    Other(String),
    /// A literal and the function whose argument it is.
    Literal(String, String),
}

/// Declarations of variables `k0`, `k1`, ... and the expression that reads them. Whole numbers without a type become `whole` unless
/// the function names its type, fractions become `real`.
pub fn into_variables(text: &str, whole: &str, real: &str) -> (String, String) {
    let (mut vars, mut out) = (String::new(), String::new());
    for piece in pieces(text) {
        match piece {
            Piece::Other(text) => out += &text,
            Piece::Literal(text, function) => {
                let name = format!("k{}", vars.matches(";").count());
                let ty = type_of(&text, &function).unwrap_or_else(|| if text.contains('.') { real } else { whole }.to_owned());
                vars += &format!("{name} : {ty} := {};", text);
                out += &name;
            }
        }
    }
    (vars, out)
}

/// Type of a literal from itself or from the name of the function around it.
pub fn type_of(literal: &str, function: &str) -> Option<String> {
    let typed = literal.split_once('#').map(|(ty, _)| ty).filter(|ty| ty.starts_with(|c: char| c.is_ascii_alphabetic()));
    match (literal.chars().next()?, typed) {
        ('\'', _) => Some("STRING[40]".to_owned()),
        ('"', _) => Some("WSTRING[40]".to_owned()),
        ('T' | 'F', None) => Some("BOOL".to_owned()),
        (_, Some(ty)) => Some(match ty {
            "T" => "TIME".to_owned(),
            "LT" => "LTIME".to_owned(),
            "D" => "DATE".to_owned(),
            other => other.to_owned(),
        }),
        _ => argument_type(function),
    }
}

/// `REAL_TO_INT` and `WORD_BCD_TO_UINT` name the type of their argument, `ADD_INT` too.
fn argument_type(function: &str) -> Option<String> {
    let source = ["_BCD_TO_", "_TO_BCD_", "_TO_", "_TRUNC_"].iter().find_map(|word| Some(function.split_once(word)?.0));
    if let Some(source) = source {
        return Some(source.to_owned());
    }
    match lookup(function)? {
        Found::Function { fixed: Some(ty), function } if !function.name.contains('_') => Some(ty.name().to_owned()),
        _ => None,
    }
}

fn pieces(text: &str) -> Vec<Piece> {
    let mut found = Vec::new();
    let mut calls = vec![String::new()];
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = token(rest, first);
        let (word, tail) = rest.split_at(length);
        if is_literal(word) {
            found.push(Piece::Literal(word.to_owned(), calls.last().cloned().unwrap_or_default()));
        } else {
            match first {
                '(' => calls.push(match found.last() {
                    Some(Piece::Other(name)) => name.clone(),
                    _ => String::new(),
                }),
                ')' => drop(calls.pop()),
                _ => {}
            }
            found.push(Piece::Other(word.to_owned()));
        }
        rest = tail;
    }
    found
}

fn is_literal(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_digit() || c == '\'' || c == '"')
        || word.contains('#')
        || matches!(word, "TRUE" | "FALSE")
}

/// Length of the word, string or sign at the start.
fn token(text: &str, first: char) -> usize {
    if matches!(first, '\'' | '"') {
        return quoted(text, first);
    }
    if !(first.is_ascii_alphanumeric() || first == '_' || first == '%') {
        return first.len_utf8();
    }
    let name = text.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(text.len());
    match text[name..].chars().next() {
        Some('#') if first.is_ascii_digit() => name + 1 + end_of_value(&text[name + 1..]),
        Some('#') if text[name + 1..].starts_with(['\'', '"']) => name + 1 + quoted(&text[name + 1..], '\''),
        Some('#') => name + 1 + end_of_value(&text[name + 1..]),
        Some('.') if first.is_ascii_digit() => end_of_value(text),
        _ => name,
    }
}

/// A number, date or duration: letters, digits, points, colons and inner signs.
fn end_of_value(text: &str) -> usize {
    text.find(|c: char| !(c.is_ascii_alphanumeric() || "_.:+-#".contains(c))).unwrap_or(text.len())
}

fn quoted(text: &str, quote: char) -> usize {
    let mut escaped = false;
    for (i, c) in text.char_indices().skip(1) {
        match c {
            _ if escaped => escaped = false,
            '$' => escaped = true,
            _ if c == quote || (c == '"' && quote == '\'' && text.starts_with('"')) => return i + 1,
            _ => {}
        }
    }
    text.len()
}

#[test]
fn literals_become_variables() {
    let (vars, text) = into_variables("MID(IN := 'A(S', L := 2) + REAL_TO_INT(-0.5)", "INT", "LREAL");
    assert_eq!(text, "MID(IN := k0, L := k1) + REAL_TO_INT(-k2)");
    assert_eq!(vars, "k0 : STRING[40] := 'A(S';k1 : INT := 2;k2 : REAL := 0.5;");
    let (vars, text) = into_variables("SEL(TRUE, T#-1.5s, DT#2024-01-02-00:00:00 - T#5ms)", "INT", "LREAL");
    assert_eq!(text, "SEL(k0, k1, k2 - k3)");
    assert_eq!(vars, "k0 : BOOL := TRUE;k1 : TIME := T#-1.5s;k2 : DT := DT#2024-01-02-00:00:00;k3 : TIME := T#5ms;");
}
