//! Text form of a message, as in the example of the README.

use super::{Diag, Severity};
use crate::source::{Sources, Span};
use std::fmt::Write;

/// Renders one message over several lines, ending with a line end.
pub fn render(diag: &Diag, sources: &Sources) -> String {
    let mut out = String::new();
    let kind = match diag.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    };
    let _ = writeln!(out, "{kind}[{}]: {}", diag.code.text(), diag.message);
    let source = sources.get(diag.span.source);
    let at = source.line_col(diag.span.start);
    let margin = at.line.to_string().len();
    let _ = writeln!(out, "{:margin$}--> {}", "", place(sources, diag.span));
    let (line, before) = excerpt(source.line(at.line), at.column as usize - 1);
    let _ = writeln!(out, "{} | {line}", at.line);
    let width = underlined(sources, diag.span, line.chars().count().saturating_sub(before));
    let carets = format!("{:margin$} | {:before$}{} {}", "", "", "^".repeat(width), diag.label);
    let _ = writeln!(out, "{}", carets.trim_end());
    for (span, note) in &diag.related {
        let _ = writeln!(out, "{:margin$} = note: {note}, at {}", "", place(sources, *span));
    }
    if let Some(help) = &diag.help {
        let _ = writeln!(out, "{:margin$} = help: {help}", "");
    }
    out
}

fn place(sources: &Sources, span: Span) -> String {
    let source = sources.get(span.source);
    let at = source.line_col(span.start);
    format!("{}:{}:{}", source.name, at.line, at.column)
}

/// The line, or of a long one the part around the place; and the number of characters before the place.
fn excerpt(line: &str, before: usize) -> (String, usize) {
    let shown = |c: char| if c.is_control() { ' ' } else { c };
    let first = before.saturating_sub(BEFORE);
    let cut = line.chars().nth(LINE_MAX).is_some();
    if !cut {
        return (line.chars().map(shown).collect(), before);
    }
    let part = line.chars().skip(first).take(LINE_MAX).map(shown);
    let (head, tail) = (if first > 0 { "…" } else { "" }, if line.chars().nth(first + LINE_MAX).is_some() { "…" } else { "" });
    (format!("{head}{}{tail}", part.collect::<String>()), before - first + head.chars().count())
}

/// Longest part of a line that is shown, in characters.
const LINE_MAX: usize = 160;
/// Characters of it before the place.
const BEFORE: usize = 60;

/// Number of carets: the span, but not past the end of its first line, and at least one.
fn underlined(sources: &Sources, span: Span, room: usize) -> usize {
    sources.text(span).lines().next().unwrap_or("").chars().count().min(room).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diag::Code;

    #[test]
    fn of_a_long_line_the_part_around_the_place_is_shown() {
        let mut sources = Sources::new();
        let text = format!("{}x{}", "a".repeat(500), "b".repeat(500));
        let id = sources.add("long.st", text);
        let shown = render(&Diag::new(Code::UnknownName, Span::new(id, 500, 501), "here"), &sources);
        let lines: Vec<_> = shown.lines().collect();
        assert_eq!(lines[2], format!("1 | …{}x{}…", "a".repeat(60), "b".repeat(99)));
        assert_eq!(lines[3], format!("  | {}^ here", " ".repeat(61)));
    }

    #[test]
    fn shows_place_label_note_and_help() {
        let mut sources = Sources::new();
        let id = sources.add("pump.st", "x\n  level := raw;\n");
        let diag = Diag::new(Code::Narrowing, Span::new(id, 13, 16), "DINT, 32 bits")
            .also(Span::new(id, 4, 9), "`level` is INT, 16 bits")
            .help("write DINT_TO_INT(raw) to accept the truncation");
        let want = "error[P2007]: a narrower type needs an explicit conversion\n --> pump.st:2:12\n2 |   level := raw;\n  |            ^^^ DINT, 32 bits\n  = note: `level` is INT, 16 bits, at pump.st:2:3\n  = help: write DINT_TO_INT(raw) to accept the truncation\n";
        assert_eq!(render(&diag, &sources), want);
    }
}
