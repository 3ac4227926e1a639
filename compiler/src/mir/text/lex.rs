//! Words, numbers and signs of the text form.

use super::ParseError;

/// A piece of text.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token {
    /// Identifier, keyword, mnemonic.
    Word(String),
    /// Name in quotes.
    Quoted(String),
    /// Number as written, with its sign.
    Number(String),
    /// `( ) { } [ ] , : = + @` or `->`, as `>`.
    Sign(char),
    End,
}

/// All tokens with their lines (from 1). The last is `End`.
pub(super) fn tokens(text: &str) -> Result<Vec<(Token, u32)>, ParseError> {
    let mut tokens = Vec::new();
    let mut line = 1;
    for content in text.lines() {
        let mut rest = content.trim_start();
        while !rest.is_empty() && !rest.starts_with(';') {
            let (token, len) = token(rest).map_err(|text| ParseError { line, text })?;
            tokens.push((token, line));
            rest = rest.get(len..).unwrap_or("").trim_start();
        }
        line += 1;
    }
    tokens.push((Token::End, line));
    Ok(tokens)
}

/// The token at the start of `rest` and its length in bytes.
fn token(rest: &str) -> Result<(Token, usize), String> {
    let first = rest.chars().next().unwrap_or(' ');
    match first {
        '"' => quoted(rest),
        '-' if rest.starts_with("->") => Ok((Token::Sign('>'), 2)),
        '(' | ')' | '{' | '}' | '[' | ']' | ',' | ':' | '=' | '+' | '@' => Ok((Token::Sign(first), 1)),
        '-' | '0'..='9' => Ok(number(rest)),
        c if c.is_ascii_alphabetic() || c == '_' => {
            let len = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_' || c == '.')).unwrap_or(rest.len());
            Ok((Token::Word(rest[..len].into()), len))
        }
        c => Err(format!("`{c}` can't stand here")),
    }
}

/// A number ends before the first character that is no digit, letter, dot, or sign of an exponent.
fn number(rest: &str) -> (Token, usize) {
    let mut before = ' ';
    let mut len = 0;
    for c in rest.chars() {
        let sign = matches!(c, '-' | '+') && (len == 0 || before == 'e' && !rest.starts_with("0x"));
        if !(sign || c.is_ascii_alphanumeric() || c == '.') {
            break;
        }
        before = c;
        len += 1;
    }
    (Token::Number(rest[..len].into()), len)
}

fn quoted(rest: &str) -> Result<(Token, usize), String> {
    let mut text = String::new();
    let mut chars = rest.char_indices().skip(1);
    while let Some((i, c)) = chars.next() {
        match c {
            '"' => return Ok((Token::Quoted(text), i + 1)),
            '\\' => match chars.next() {
                Some((_, 'n')) => text.push('\n'),
                Some((_, 'r')) => text.push('\r'),
                Some((_, c)) => text.push(c),
                None => break,
            },
            c => text.push(c),
        }
    }
    Err("the quote has no end".into())
}
