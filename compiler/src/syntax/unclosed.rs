//! Where to go on behind a comment or pragma that is never closed: most often its end is missing on its own line, and what follows is code.

/// Bytes from the opener to the first line behind it that looks like code; `None` if there is none.
pub(crate) fn resume(rest: &str) -> Option<usize> {
    let mut at = 0;
    for (i, line) in rest.split_inclusive('\n').enumerate() {
        if i > 0 && is_code(line) {
            return Some(at);
        }
        at += line.len();
    }
    None
}

/// A line that prose seldom looks like.
fn is_code(line: &str) -> bool {
    let end = ["(*", "//", "/*"].iter().filter_map(|c| line.find(c)).min().unwrap_or(line.len());
    let line = line[..end].trim();
    let first = line.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or("").to_ascii_uppercase();
    let last = line.rsplit(char::is_whitespace).next().unwrap_or("").to_ascii_uppercase();
    let opens = matches!(
        first.as_str(),
        "FUNCTION_BLOCK" | "FUNCTION" | "PROGRAM" | "TYPE" | "CLASS" | "INTERFACE" | "CONFIGURATION" | "NAMESPACE"
    );
    let opens = opens && line.split_whitespace().count() <= 4;
    line.ends_with(';')
        || first.starts_with("END_")
        || first == "VAR"
        || first.starts_with("VAR_")
        || opens
        || matches!(last.as_str(), "THEN" | "DO" | "OF")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prose_is_skipped_and_code_found() {
        let at = |rest: &str| resume(rest).map(|n| rest[n..].lines().next().unwrap_or("").to_owned());
        assert_eq!(at(" note x := 1;\n  y := 2;\n"), Some("  y := 2;".to_owned()));
        assert_eq!(
            at(" a comment\n of several lines, one about\n the program and functions\nIF a THEN (* *)\n"),
            Some("IF a THEN (* *)".to_owned())
        );
        assert_eq!(at("\n\nEND_PROGRAM"), Some("END_PROGRAM".to_owned()));
        assert_eq!(at("\nFUNCTION f : INT\n"), Some("FUNCTION f : INT".to_owned()));
        assert_eq!(at(" x := 1;"), None);
        assert_eq!(at("\nprose, and more\n"), None);
    }
}
