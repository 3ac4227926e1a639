//! Text to pieces, each with one block: line ends, the two block styles, `%`.
//!
//! RS274/NGC ends a block at the end of the line and starts a comment at `;`. In the style of older sources `;` ends the block and
//! several may share a line (PC-05, R1-33). A `;` with only blanks behind it means the same in both: an empty comment, or an end.

use std::ops::Range;

/// What `;` means.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Style {
    /// [`Style::Semicolon`] if every line that is not blank, a `%` or a lone parenthesised comment ends with `;` and none
    /// starts with it, else [`Style::Ngc`]. Decided once for the whole text.
    #[default]
    Auto,
    /// `;` starts a comment that ends with the line.
    Ngc,
    /// `;` ends a block; text behind it is the next block.
    Semicolon,
}

/// One piece of the text.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Piece {
    /// Bytes of the text, without the line end and without a `;` that ends the block.
    pub range: Range<usize>,
    /// Line, from 1.
    pub line: u32,
}

/// A place in a text, so that one can come back to it.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Place {
    /// Rest of the present line.
    rest: (usize, usize),
    /// Where the next line starts.
    next: usize,
    line: u32,
}

impl Place {
    /// A number that no other place of the text has.
    pub fn key(self) -> u64 {
        if self.rest.0 < self.rest.1 { self.rest.0 as u64 } else { self.next as u64 }
    }
}

/// Cuts a text; the place, so that the text can be owned elsewhere.
#[derive(Clone, Copy, Debug)]
pub struct Lines {
    semicolon: bool,
    /// Where the next piece starts.
    pub place: Place,
}

impl Lines {
    /// At the start of `text`.
    pub fn new(text: &str, style: Style) -> Self {
        let semicolon = match style {
            Style::Ngc => false,
            Style::Semicolon => true,
            Style::Auto => ends_with_semicolons(text),
        };
        Lines { semicolon, place: Place::default() }
    }

    /// The next piece that is not blank. `text` is always the one given to [`Lines::new`].
    pub fn next(&mut self, text: &str) -> Option<Piece> {
        loop {
            while self.place.rest.0 < self.place.rest.1 {
                let piece = self.cut(text);
                if !is_blank(&text[piece.clone()]) {
                    return Some(Piece { range: piece, line: self.place.line });
                }
            }
            self.advance(text)?;
        }
    }

    /// The line that was read last, from 1.
    pub fn line(&self) -> u32 {
        self.place.line
    }

    fn advance(&mut self, text: &str) -> Option<()> {
        let place = &mut self.place;
        if place.next >= text.len() {
            return None;
        }
        let (line, next) = line_at(text, place.next);
        place.rest = (line.start, line.end);
        place.next = next;
        place.line = place.line.saturating_add(1);
        Some(())
    }

    fn cut(&mut self, text: &str) -> Range<usize> {
        let (start, end) = self.place.rest;
        match self.semicolon.then(|| terminator(&text[start..end])).flatten() {
            Some(at) => {
                self.place.rest = (start + at + 1, end);
                start..start + at
            }
            None => {
                self.place.rest = (end, end);
                start..end
            }
        }
    }
}

/// The line that starts at `start`, without its end (LF, CRLF or a lone CR), and where the next one starts.
fn line_at(text: &str, start: usize) -> (Range<usize>, usize) {
    let bytes = text.as_bytes();
    match bytes[start..].iter().position(|&b| b <= b'\r' && (b == b'\n' || b == b'\r')) {
        None => (start..text.len(), text.len()),
        Some(n) => {
            let end = start + n;
            let crlf = bytes[end] == b'\r' && bytes.get(end + 1) == Some(&b'\n');
            (start..end, end + 1 + usize::from(crlf))
        }
    }
}

/// The first `;` outside of parentheses.
fn terminator(line: &str) -> Option<usize> {
    let mut comment = false;
    line.bytes().position(|b| {
        match b {
            b'(' => comment = true,
            b')' => comment = false,
            _ => {}
        }
        b == b';' && !comment
    })
}

fn ends_with_semicolons(text: &str) -> bool {
    let (mut at, mut found) = (0, false);
    while at < text.len() {
        let (line, next) = line_at(text, at);
        at = next;
        let line = text[line].trim_matches([' ', '\t']);
        if line.is_empty() || line.starts_with('%') || is_comment(line) {
            continue;
        }
        if line.starts_with(';') || !line.ends_with(';') {
            return false;
        }
        found = true;
    }
    found
}

/// One comment in parentheses and nothing else.
fn is_comment(line: &str) -> bool {
    line.starts_with('(') && line.find(')') == Some(line.len() - 1)
}

fn is_blank(text: &str) -> bool {
    text.bytes().all(|b| matches!(b, b' ' | b'\t'))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pieces(text: &str, style: Style) -> Vec<(u32, &str)> {
        let mut lines = Lines::new(text, style);
        std::iter::from_fn(|| lines.next(text)).map(|p| (p.line, &text[p.range])).collect()
    }

    #[test]
    fn line_ends_count_as_in_the_sources() {
        assert_eq!(pieces("a\r\n\rb\n\nc", Style::Ngc), [(1, "a"), (3, "b"), (5, "c")]);
        assert_eq!(pieces("", Style::Auto), []);
    }

    #[test]
    fn semicolon_ends_a_block_or_starts_a_comment() {
        assert_eq!(pieces("a;b ;\n(;)c;", Style::Auto), [(1, "a"), (1, "b "), (2, "(;)c")]);
        assert_eq!(pieces("a;b ;\nc", Style::Auto), [(1, "a;b ;"), (2, "c")]);
        assert_eq!(pieces("a;b", Style::Semicolon), [(1, "a"), (1, "b")]);
        assert_eq!(pieces("(x)\na;b;", Style::Auto), [(1, "(x)"), (2, "a"), (2, "b")]);
        assert_eq!(pieces("(x) y (z)\na;b;", Style::Auto), [(1, "(x) y (z)"), (2, "a;b;")]);
        assert_eq!(pieces("a;\n;b;", Style::Auto), [(1, "a;"), (2, ";b;")]);
        assert_eq!(pieces("%\na ;\n%", Style::Auto), [(1, "%"), (2, "a "), (3, "%")]);
    }
}
