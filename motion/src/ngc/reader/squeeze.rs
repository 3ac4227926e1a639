//! First pass over a row: blanks out, letters to lower case, comments aside.

use crate::ngc::code::{Comment, CommentKind};
use crate::ngc::expr::Slice;
use crate::ngc::fault::Fault;
use takt_base::Code;

/// A row without blanks and comments.
#[derive(Clone, Debug, Default)]
pub struct Squeezed {
    /// Lower case.
    pub bytes: Vec<u8>,
    /// Byte of the text for each; one more for the end.
    pub at: Vec<u32>,
}

impl Squeezed {
    /// Fills the buffers from `text` at byte `start` of the file; comments go to `comments`, without their texts.
    pub fn fill(&mut self, text: impl AsRef<[u8]>, start: usize, comments: &mut Vec<Comment>) -> Result<(), Fault> {
        let bytes = text.as_ref();
        self.bytes.resize(bytes.len(), 0);
        self.at.resize(bytes.len() + 1, 0);
        let (mut i, mut kept) = (0, 0);
        while let Some(&byte) = bytes.get(i) {
            match byte {
                b'(' => i = comment(bytes, i, start, comments)?,
                // LinuxCNC drops it as well, whatever it says.
                b';' => break,
                _ => {
                    // A blank is written too, and the next byte over it: no branch that the processor would have to guess.
                    self.bytes[kept] = byte.to_ascii_lowercase();
                    self.at[kept] = (start + i) as u32;
                    kept += usize::from(!matches!(byte, b' ' | b'\t'));
                }
            }
            i += 1;
        }
        self.bytes.truncate(kept);
        self.at.truncate(kept + 1);
        self.at[kept] = (start + i.min(bytes.len())) as u32;
        Ok(())
    }
}

/// `( text )` at byte `i`: no nesting, ends on its row. Returns its last byte.
fn comment(bytes: &[u8], i: usize, start: usize, comments: &mut Vec<Comment>) -> Result<usize, Fault> {
    let inside = &bytes[i + 1..];
    let length = inside.iter().position(|&b| b == b')' || b == b'(').unwrap_or(inside.len());
    match inside.get(length) {
        Some(b')') => {}
        other => {
            let help = if other.is_some() { "comments can't be nested" } else { "close the comment with `)` on the same line" };
            let (from, to) = ((start + i) as u32, (start + i + 1 + length) as u32);
            return Err(Fault::at(Code::CommentNotClosed, from, to, "the comment starts here", help));
        }
    }
    let (kind, skip) = kind_of(&inside[..length]);
    let from = start + i + 1;
    comments.push(Comment { kind, text: Slice::default(), place: ((from + skip) as u32, (from + length) as u32) });
    Ok(i + 1 + length)
}

const KEYWORDS: [(&[u8], CommentKind); 8] = [
    (b"msg", CommentKind::Message),
    (b"debug", CommentKind::Debug),
    (b"print", CommentKind::Print),
    (b"log", CommentKind::Log),
    (b"logopen", CommentKind::LogOpen),
    (b"logappend", CommentKind::LogAppend),
    (b"probeopen", CommentKind::ProbeOpen),
    (b"abort", CommentKind::Abort),
];

/// Meaning of a comment, and the bytes of its keyword.
fn kind_of(inside: &[u8]) -> (CommentKind, usize) {
    let word = inside.trim_ascii();
    if word.eq_ignore_ascii_case(b"logclose") {
        return (CommentKind::LogClose, inside.len());
    }
    if word.eq_ignore_ascii_case(b"probeclose") {
        return (CommentKind::ProbeClose, inside.len());
    }
    if let Some(space) = word.iter().position(|b| *b == b' ')
        && word[..space].eq_ignore_ascii_case(b"probeopen")
    {
        return (CommentKind::ProbeOpen, inside.len() - inside.trim_ascii_start().len() + space + 1);
    }
    let Some(comma) = inside.iter().position(|&b| b == b',') else { return (CommentKind::Plain, 0) };
    let head = inside[..comma].trim_ascii();
    let known = KEYWORDS.iter().find(|(word, _)| head.eq_ignore_ascii_case(word));
    known.map_or((CommentKind::Plain, 0), |&(_, kind)| (kind, comma + 1))
}
