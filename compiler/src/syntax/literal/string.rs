//! Strings and their `$` escapes. A STRING holds the bytes of the text as written (UTF-8 or Latin-1), a WSTRING UTF-16 units.
//! From: IEC 61131-3 §6.3.3 (language reference §1.6).

use super::{Problem, Read};
use crate::syntax::ast::Literal;
use takt_base::diag::Code;

/// Where characters go: bytes or 16-bit units.
trait Units: Default {
    const HEX_DIGITS: usize;
    fn put(&mut self, c: char);
    fn put_code(&mut self, code: u16);
}

impl Units for Vec<u8> {
    const HEX_DIGITS: usize = 2;
    fn put(&mut self, c: char) {
        self.extend_from_slice(c.encode_utf8(&mut [0; 4]).as_bytes());
    }
    fn put_code(&mut self, code: u16) {
        self.push(code.to_le_bytes()[0]);
    }
}

impl Units for Vec<u16> {
    const HEX_DIGITS: usize = 4;
    fn put(&mut self, c: char) {
        self.extend_from_slice(c.encode_utf16(&mut [0; 2]));
    }
    fn put_code(&mut self, code: u16) {
        self.push(code);
    }
}

/// Bytes of a text that was Latin-1.
#[derive(Default)]
struct Latin1(Vec<u8>);

impl Units for Latin1 {
    const HEX_DIGITS: usize = 2;
    fn put(&mut self, c: char) {
        self.0.push(u8::try_from(c).unwrap_or(b'?'));
    }
    fn put_code(&mut self, code: u16) {
        self.0.push(code.to_le_bytes()[0]);
    }
}

/// A token with its quotes of a file that was Latin-1, as STRING.
pub(crate) fn latin1(token: &str) -> Read {
    Ok(Literal::String(decode::<Latin1>(token)?.0).into())
}

/// A token with its quotes, as STRING.
pub(crate) fn narrow(token: &str) -> Read {
    Ok(Literal::String(decode(token)?).into())
}

/// A token with its quotes, as WSTRING.
pub(crate) fn wide(token: &str) -> Read {
    Ok(Literal::WString(decode(token)?).into())
}

fn decode<U: Units>(token: &str) -> Result<U, Problem> {
    let body = token.get(1..token.len().saturating_sub(1)).unwrap_or("");
    let mut out = U::default();
    let mut chars = body.char_indices();
    while let Some((i, c)) = chars.next() {
        match c {
            '$' => {
                let (code, digits) = escape(&body[i + 1..], U::HEX_DIGITS)
                    .ok_or_else(|| bad_escape(&body[i + 1..], U::HEX_DIGITS).at(i + 1, i + 2 + next_len(&body[i + 1..])))?;
                match code {
                    Some(c) => out.put(c),
                    None => out.put_code(u16::from_str_radix(&body[i + 1..i + 1 + digits], 16).unwrap_or(0)),
                }
                for _ in 0..digits {
                    chars.next();
                }
            }
            c if c.is_ascii_control() => {
                let problem = Problem::new(Code::BadEscape, format!("the control character U+{:04X} in a string", c as u32));
                return Err(problem.at(i + 1, i + 1 + c.len_utf8()).help("write it as an escape: $T for TAB"));
            }
            c => out.put(c),
        }
    }
    Ok(out)
}

/// The character behind a `$` and how many characters the escape takes; `None` inside for a hexadecimal code.
fn escape(rest: &str, hex_digits: usize) -> Option<(Option<char>, usize)> {
    let c = rest.chars().next()?;
    let plain = match c.to_ascii_uppercase() {
        '$' | '\'' | '"' => c,
        'L' | 'N' => '\n',
        'P' => '\x0c',
        'R' => '\r',
        'T' => '\t',
        _ => {
            let hex = rest.get(..hex_digits)?;
            return hex.bytes().all(|b| b.is_ascii_hexdigit()).then_some((None, hex_digits));
        }
    };
    Some((Some(plain), 1))
}

fn bad_escape(rest: &str, hex_digits: usize) -> Problem {
    let problem = match rest.chars().next() {
        Some(c) if c.is_ascii_hexdigit() => {
            Problem::new(Code::BadEscape, format!("a character code has {hex_digits} hexadecimal digits here"))
        }
        _ => Problem::new(Code::BadEscape, "no such escape"),
    };
    problem.help("the escapes are $$ $' $\" $L $N $P $R $T and character codes; write $$ for the dollar sign itself")
}

fn next_len(rest: &str) -> usize {
    rest.chars().next().map_or(0, char::len_utf8)
}
