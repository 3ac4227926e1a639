//! An expression of constants as one that the compiler can't fold: its first literal moves into a variable.

/// The text around the first literal, the literal, and the types that a variable for it may have, likely ones first.
pub struct Opened<'t> {
    /// Text before the literal.
    pub before: &'t str,
    /// The literal.
    pub literal: &'t str,
    /// Text behind it.
    pub after: &'t str,
    /// Type names.
    pub types: Vec<String>,
}

/// Types to try for a number without a type.
const NUMBERS: &[&str] =
    &["DINT", "LREAL", "INT", "REAL", "SINT", "USINT", "UINT", "UDINT", "ULINT", "LINT", "BYTE", "WORD", "DWORD", "LWORD"];

/// Finds the first literal; `None` if there is none.
pub fn open(text: &str) -> Option<Opened<'_>> {
    let mut at = 0;
    let mut callee = "";
    while at < text.len() {
        let rest = &text[at..];
        if let Some(length) = literal(rest) {
            let (literal, after) = rest.split_at(length);
            return Some(Opened { before: &text[..at], literal, after, types: types(literal, callee) });
        }
        let word = word(rest);
        callee = if word > 0 && rest[word..].starts_with('(') { &rest[..word] } else { callee };
        at += word.max(rest.chars().next().map_or(1, char::len_utf8));
    }
    None
}

fn word(text: &str) -> usize {
    text.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(text.len())
}

/// Length of the literal that the text starts with.
fn literal(text: &str) -> Option<usize> {
    let sign = usize::from(text.starts_with('-'));
    let word = word(&text[sign..]) + sign;
    let first = text[sign..].chars().next()?;
    if first == '\'' || first == '"' {
        return Some(quoted(&text[sign..], first) + sign);
    }
    if text[word..].starts_with('#') {
        let value = &text[word + 1..];
        return Some(
            word + 1 + value.chars().next().filter(|c| "'\"".contains(*c)).map_or_else(|| plain(value), |q| quoted(value, q)),
        );
    }
    let truth = matches!(&text[..word], "TRUE" | "FALSE");
    (truth || first.is_ascii_digit()).then(|| plain(text))
}

fn plain(text: &str) -> usize {
    text.find([',', ')', ' ']).unwrap_or(text.len())
}

fn quoted(text: &str, quote: char) -> usize {
    let mut escaped = false;
    for (i, c) in text.char_indices().skip(1) {
        if c == quote && !escaped {
            return i + 1;
        }
        escaped = c == '$' && !escaped;
    }
    text.len()
}

fn types(literal: &str, callee: &str) -> Vec<String> {
    let prefix = literal.split_once('#').map_or("", |(p, _)| p);
    let known = match prefix {
        _ if literal.starts_with('\'') => "STRING",
        _ if literal.starts_with('"') => "WSTRING",
        "T" => "TIME",
        "LT" => "LTIME",
        "D" => "DATE",
        "LD" => "LDATE",
        "" if matches!(literal, "TRUE" | "FALSE") => "BOOL",
        p if p.chars().all(|c| c.is_ascii_alphabetic()) => p,
        _ => "",
    };
    if !known.is_empty() {
        return vec![known.to_owned()];
    }
    // REAL_TO_INT and ADD_INT say it in their names.
    let named = callee.split('_').next().into_iter().chain(callee.rsplit('_').next());
    named.chain(NUMBERS.iter().copied()).filter(|t| takt_image::Elementary::from_name(t).is_some()).map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_literal_is_found_with_its_type() {
        for (text, literal, ty) in [
            ("ABS(INT#-32768)", "INT#-32768", "INT"),
            ("REAL_TO_INT(40000.0)", "40000.0", "REAL"),
            ("T#1s * 0.3333", "T#1s", "TIME"),
            ("LEN(LEFT('A$'BC', -1))", "'A$'BC'", "STRING"),
            ("MUX(-1, INT#10)", "-1", "DINT"),
            ("LIMIT(MN := INT#0, IN := INT#15)", "INT#0", "INT"),
            ("DT_TO_TOD(DT#1969-12-31-23:00:00)", "DT#1969-12-31-23:00:00", "DT"),
            ("SEL(TRUE, 1, 2)", "TRUE", "BOOL"),
            ("WSTRING_TO_STRING(WSTRING#\"a\")", "WSTRING#\"a\"", "WSTRING"),
            ("ADD_INT(1, 2)", "1", "INT"),
            ("STRING_TO_TIME('T#1h')", "'T#1h'", "STRING"),
        ] {
            let opened = open(text).unwrap();
            assert_eq!((opened.literal, opened.types[0].as_str()), (literal, ty), "{text}");
            assert_eq!(format!("{}{}{}", opened.before, opened.literal, opened.after), text);
        }
        assert!(open("TIME()").is_none());
    }
}
