//! The compiled form of rows: one arena for words, expressions, comments and O words of all rows that are kept.
//! Runs: background. Invariant: [`Code::truncate`] to a [`Mark`] forgets exactly the rows read since, so a straight program needs the room
//! of one row.

use super::expr::{Op, Slice, Value};
use super::oword::OWord;
use super::param::{Name, Names};
use super::word::Action;

/// A letter and its value. `@`, `^` and `$` count as letters.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Word {
    /// Upper case.
    pub letter: char,
    /// Number or code.
    pub value: Value,
    /// What a G or M word with a plain number asks for.
    pub action: Option<Action>,
    /// Bytes of the text.
    pub place: (u32, u32),
}

/// `#target = value`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Setting {
    /// Which parameter.
    pub target: Target,
    /// Its new value.
    pub value: Value,
    /// Bytes of the target.
    pub place: (u32, u32),
}

/// Left side of a setting.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Target {
    /// `#5`, `##5`, `#[...]`.
    Numbered(Value),
    /// `#<name>`.
    Named(Name),
}

/// What a comment asks for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum CommentKind {
    Plain,
    Message,
    Debug,
    Print,
    Log,
    LogOpen,
    LogAppend,
    LogClose,
    ProbeOpen,
    ProbeClose,
    Abort,
}

/// A comment.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Comment {
    /// Its meaning.
    pub kind: CommentKind,
    /// Its text without the keyword, into [`Code::texts`].
    pub text: Slice,
    /// Bytes of the file for that.
    pub place: (u32, u32),
}

/// One row as read.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Row {
    /// Bytes of the text.
    pub place: (u32, u32),
    /// Source line, from 1.
    pub line: u32,
    /// Starts with `/` (R1-39).
    pub deleted: bool,
    /// N word.
    pub n: Option<u32>,
    /// Into [`Code::words`].
    pub words: Slice,
    /// Into [`Code::settings`].
    pub settings: Slice,
    /// Into [`Code::comments`].
    pub comments: Slice,
    /// An O word, which stands alone.
    pub oword: Option<OWord>,
}

impl Row {
    /// A row without words, comments and place.
    pub const fn bare() -> Self {
        let none = Slice { start: 0, end: 0 };
        Row { place: (0, 0), line: 0, deleted: false, n: None, words: none, settings: none, comments: none, oword: None }
    }
}

/// The arena.
#[derive(Clone, Debug, Default)]
pub struct Code {
    /// Words of all rows.
    pub words: Vec<Word>,
    /// Settings of all rows.
    pub settings: Vec<Setting>,
    /// Comments of all rows.
    pub comments: Vec<Comment>,
    /// Texts of the comments.
    pub texts: String,
    /// Postfix code.
    pub ops: Vec<Op>,
    /// Bytes of the text of each op.
    pub places: Vec<(u32, u32)>,
    /// Arguments of O words.
    pub args: Vec<Value>,
    /// All named parameters and names of subroutines.
    pub names: Names,
    /// Rows up to here are kept.
    kept: Option<Mark>,
}

/// A length of the arena.
#[derive(Clone, Copy, Debug)]
pub struct Mark([usize; 6]);

impl Code {
    /// Adds an op.
    pub fn push_op(&mut self, op: Op, place: (u32, u32)) {
        self.ops.push(op);
        self.places.push(place);
    }

    /// The present length.
    pub fn mark(&self) -> Mark {
        Mark([self.words.len(), self.settings.len(), self.comments.len(), self.ops.len(), self.args.len(), self.texts.len()])
    }

    /// Forgets what came behind `mark`.
    pub fn truncate(&mut self, mark: Mark) {
        let [words, settings, comments, ops, args, texts] = mark.0;
        self.words.truncate(words);
        self.settings.truncate(settings);
        self.comments.truncate(comments);
        self.ops.truncate(ops);
        self.places.truncate(ops);
        self.args.truncate(args);
        self.texts.truncate(texts);
    }

    /// Adds the texts of the comments from `first` on; they stand in the row `bytes`, which is at byte `start` of its file.
    pub fn add_texts(&mut self, first: usize, bytes: &[u8], start: usize) {
        for comment in self.comments.get_mut(first..).unwrap_or_default() {
            let from = self.texts.len() as u32;
            let (a, b) = (comment.place.0 as usize - start, comment.place.1 as usize - start);
            self.texts.push_str(&super::text::line(bytes.get(a..b).unwrap_or_default()));
            comment.text = Slice { start: from, end: self.texts.len() as u32 };
        }
    }

    /// The text of a comment.
    pub fn text(&self, slice: Slice) -> &str {
        self.texts.get(slice.range()).unwrap_or("")
    }

    /// The length of the rows that are kept.
    pub fn kept_mark(&self) -> Mark {
        self.kept.unwrap_or(Mark([0; 6]))
    }

    /// Keeps all rows read so far.
    pub fn keep(&mut self) {
        self.kept = Some(self.mark());
    }

    /// Bytes that the arena holds, near enough.
    pub fn size(&self) -> usize {
        self.words.len() * size_of::<Word>()
            + self.settings.len() * size_of::<Setting>()
            + self.ops.len() * (size_of::<Op>() + 8)
            + self.args.len() * size_of::<Value>()
            + self.comments.len() * size_of::<Comment>()
            + self.texts.len()
    }
}
