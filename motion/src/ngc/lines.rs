//! Text to pieces, each with one block: line ends, the two block styles, `%`.
//!
//! RS274/NGC ends a block at the end of the line and starts a comment at `;`. In the style of older sources `;` ends the block and
//! several may share a line (PC-05, R1-33). A `;` with only blanks behind it means the same in both: an empty comment, or an end.

use super::text::{Trouble, View};
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
    /// The start of line `line`, which is byte `start`.
    pub fn at_line(line: u32, start: usize) -> Self {
        Place { rest: (start, start), next: start, line: line.saturating_sub(1) }
    }

    /// Byte at which the next line starts.
    pub fn next(self) -> usize {
        self.next
    }

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
    /// At the start of the text.
    pub fn new(view: &mut View, style: Style) -> Self {
        let semicolon = match style {
            Style::Ngc => false,
            Style::Semicolon => true,
            // A file that can't be read says so when its rows are read.
            Style::Auto => ends_with_semicolons(view).unwrap_or(false),
        };
        Lines { semicolon, place: Place::default() }
    }

    /// The next piece that is not blank; its bytes are held. The text is always the one given to [`Lines::new`].
    ///
    /// # Errors
    /// The file can't be read on.
    pub fn next(&mut self, view: &mut View) -> Result<Option<Piece>, Trouble> {
        loop {
            while self.place.rest.0 < self.place.rest.1 {
                let piece = self.cut(view)?;
                if !is_blank(view.bytes(piece.clone())) {
                    return Ok(Some(Piece { range: piece, line: self.place.line }));
                }
            }
            if !self.advance(view)? {
                return Ok(None);
            }
        }
    }

    /// The line that was read last, from 1.
    pub fn line(&self) -> u32 {
        self.place.line
    }

    fn advance(&mut self, view: &mut View) -> Result<bool, Trouble> {
        let place = &mut self.place;
        let Some((line, next)) = view.line(place.next)? else { return Ok(false) };
        place.rest = (line.start, line.end);
        place.next = next;
        place.line = place.line.saturating_add(1);
        view.text.mark(place.line, next);
        Ok(true)
    }

    fn cut(&mut self, view: &mut View) -> Result<Range<usize>, Trouble> {
        let (start, end) = self.place.rest;
        view.hold(start..end)?;
        match self.semicolon.then(|| terminator(view.bytes(start..end))).flatten() {
            Some(at) => {
                self.place.rest = (start + at + 1, end);
                Ok(start..start + at)
            }
            None => {
                self.place.rest = (end, end);
                Ok(start..end)
            }
        }
    }
}

/// The first `;` outside of parentheses.
fn terminator(line: &[u8]) -> Option<usize> {
    let mut comment = false;
    line.iter().position(|b| {
        match b {
            b'(' => comment = true,
            b')' => comment = false,
            _ => {}
        }
        *b == b';' && !comment
    })
}

fn ends_with_semicolons(view: &mut View) -> Result<bool, Trouble> {
    let (mut at, mut found) = (0, false);
    while let Some((line, next)) = view.line(at)? {
        at = next;
        let line = trimmed(view.bytes(line));
        if line.is_empty() || line.starts_with(b"%") || is_comment(line) {
            continue;
        }
        if line.starts_with(b";") || !line.ends_with(b";") {
            return Ok(false);
        }
        found = true;
    }
    Ok(found)
}

/// One comment in parentheses and nothing else.
fn is_comment(line: &[u8]) -> bool {
    line.starts_with(b"(") && line.iter().position(|b| *b == b')') == Some(line.len() - 1)
}

fn blank(byte: &u8) -> bool {
    matches!(byte, b' ' | b'\t')
}

fn is_blank(text: &[u8]) -> bool {
    text.iter().all(blank)
}

/// Without blanks at both ends.
pub fn trimmed(line: &[u8]) -> &[u8] {
    let start = line.iter().position(|b| !blank(b)).unwrap_or(line.len());
    let end = line.iter().rposition(|b| !blank(b)).map_or(start, |i| i + 1);
    &line[start..end]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ngc::text::{Text, Window};

    fn pieces(text: &str, style: Style) -> Vec<(u32, &str)> {
        let (whole, mut window) = (Text::from(text), Window::default());
        let mut view = View { text: &whole, file: 0, window: &mut window };
        let mut lines = Lines::new(&mut view, style);
        std::iter::from_fn(|| lines.next(&mut view).unwrap()).map(|p| (p.line, &text[p.range])).collect()
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
