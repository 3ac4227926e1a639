//! Source files and places in them.
//! Text is UTF-8; a file that is not is read as Latin-1 (IEC 61131-3 reference §1.1). Spans count bytes of the decoded text.

use crate::Profile;

crate::index_type! {
    /// A file in [`Sources`].
    SourceId
}

/// Half-open byte range in one source file.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, PartialOrd, Ord)]
pub struct Span {
    /// The file.
    pub source: SourceId,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// The range `start..end` of `source`.
    pub fn new(source: SourceId, start: usize, end: usize) -> Self {
        Self { source, start: start as u32, end: end as u32 }
    }
    /// From the start of `self` to the end of `other`, which must be of the same file.
    pub fn to(self, other: Span) -> Self {
        Self { source: self.source, start: self.start.min(other.start), end: self.end.max(other.end) }
    }
    /// A point: the start of this span.
    pub fn start_point(self) -> Self {
        Self { end: self.start, ..self }
    }
    /// A point just behind this span.
    pub fn end_point(self) -> Self {
        Self { start: self.end, ..self }
    }
}

/// Line and column, both counted from 1; the column counts characters.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, PartialOrd, Ord)]
pub struct LineCol {
    /// Line, from 1.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
}

/// One file of a project.
#[derive(Clone, Debug)]
pub struct Source {
    /// Path or name as the user gave it; shown in messages.
    pub name: String,
    /// Decoded text.
    pub text: String,
    /// True for the standard library and generated declarations: no warnings, not in fault traces.
    pub library: bool,
    /// True if the bytes were not UTF-8 and have been read as Latin-1: a character of a string is one byte.
    pub latin1: bool,
    /// Dialect that it is written in.
    pub profile: Profile,
    line_starts: Vec<u32>,
}

/// All files of one compilation.
#[derive(Clone, Debug, Default)]
pub struct Sources {
    files: crate::index::IndexVec<SourceId, Source>,
}

impl Sources {
    /// No files.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a user's file from text.
    pub fn add(&mut self, name: impl Into<String>, text: impl Into<String>) -> SourceId {
        self.push(name.into(), (text.into(), false), false)
    }

    /// Adds a user's file from bytes of any encoding.
    pub fn add_bytes(&mut self, name: impl Into<String>, bytes: Vec<u8>) -> SourceId {
        self.push(name.into(), decode(bytes), false)
    }

    /// Adds a library file.
    pub fn add_library(&mut self, name: impl Into<String>, text: impl Into<String>) -> SourceId {
        self.push(name.into(), (text.into(), false), true)
    }

    /// Adds a library file from bytes of any encoding.
    pub fn add_library_bytes(&mut self, name: impl Into<String>, bytes: Vec<u8>) -> SourceId {
        self.push(name.into(), decode(bytes), true)
    }

    fn push(&mut self, name: String, (text, latin1): (String, bool), library: bool) -> SourceId {
        let line_starts = std::iter::once(0).chain(line_ends(&text)).collect();
        self.files.push(Source { name, text, library, latin1, profile: Profile::Std, line_starts })
    }

    /// Says which dialect a file is written in; [`Profile::Std`] until then.
    pub fn set_profile(&mut self, id: SourceId, profile: Profile) {
        self.files[id].profile = profile;
    }

    /// The file.
    pub fn get(&self, id: SourceId) -> &Source {
        &self.files[id]
    }

    /// All files, in the order added.
    pub fn iter(&self) -> impl Iterator<Item = (SourceId, &Source)> {
        self.files.enumerate()
    }

    /// The text that a span covers; empty if the span is not of this text.
    pub fn text(&self, span: Span) -> &str {
        self.get(span.source).text.get(span.start as usize..span.end as usize).unwrap_or("")
    }

    /// Line and column of a byte offset.
    pub fn line_col(&self, source: SourceId, offset: u32) -> LineCol {
        self.get(source).line_col(offset)
    }
}

impl Source {
    /// Line and column of a byte offset; an offset past the end counts as the end.
    pub fn line_col(&self, offset: u32) -> LineCol {
        let offset = (offset as usize).min(self.text.len());
        let line = self.line_number(offset as u32);
        let start = self.line_start(line);
        let mut cut = offset;
        while !self.text.is_char_boundary(cut) {
            cut -= 1;
        }
        LineCol { line, column: self.text[start..cut].chars().count() as u32 + 1 }
    }

    /// Line (from 1) of a byte offset; an offset past the end counts as the end.
    pub fn line_number(&self, offset: u32) -> u32 {
        self.line_starts.partition_point(|&s| s <= offset) as u32
    }

    /// Byte offset at which a line (from 1) begins; the end of the text if there is no such line.
    pub fn line_start(&self, line: u32) -> usize {
        self.line_starts.get((line as usize).wrapping_sub(1)).map_or(self.text.len(), |&s| s as usize)
    }

    /// Text of a line (from 1) without its line end; empty if there is no such line.
    pub fn line(&self, line: u32) -> &str {
        let Some(&start) = self.line_starts.get((line as usize).wrapping_sub(1)) else { return "" };
        let end = self.line_starts.get(line as usize).map_or(self.text.len(), |&e| e as usize);
        self.text[start as usize..end].trim_end_matches(['\n', '\r', '\x0c'])
    }
}

/// Offsets just behind each LF, CRLF or lone CR.
fn line_ends(text: &str) -> impl Iterator<Item = u32> + '_ {
    let bytes = text.as_bytes();
    (0..bytes.len()).filter_map(move |i| match bytes[i] {
        b'\n' => Some(i as u32 + 1),
        b'\r' if bytes.get(i + 1) != Some(&b'\n') => Some(i as u32 + 1),
        _ => None,
    })
}

/// The text, and whether it had to be read as Latin-1.
fn decode(bytes: Vec<u8>) -> (String, bool) {
    match String::from_utf8(bytes) {
        Ok(text) => (text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text), false),
        Err(e) => (e.as_bytes().iter().map(|&b| b as char).collect(), true),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn line_and_column_count_from_one_and_in_characters() {
        let mut s = Sources::new();
        let id = s.add("a.st", "ab\r\nä€x\rz\n");
        let at = |o| {
            let p = s.line_col(id, o);
            (p.line, p.column)
        };
        assert_eq!([at(0), at(1), at(4), at(6), at(9), at(11)], [(1, 1), (1, 2), (2, 1), (2, 2), (2, 3), (3, 1)]);
        assert_eq!([s.get(id).line(1), s.get(id).line(2), s.get(id).line(3)], ["ab", "ä€x", "z"]);
        assert_eq!([0, 1, 2, 3, 4, 9].map(|l| s.get(id).line_start(l)), [13, 0, 4, 11, 13, 13]);
    }

    #[test]
    fn bytes_that_are_not_utf8_are_latin1() {
        let mut s = Sources::new();
        let id = s.add_bytes("a.st", vec![b'a', 0xE4]);
        assert_eq!((s.get(id).text.as_str(), s.get(id).latin1), ("aä", true));
        let utf8 = s.add_bytes("b.st", "\u{feff}aä".into());
        assert_eq!((s.get(utf8).text.as_str(), s.get(utf8).latin1), ("aä", false));
    }
}
