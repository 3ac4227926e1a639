//! Source lines of instructions, each stored once.

use crate::mir::model::{Line, LineId};
use std::collections::HashMap;
use std::ops::Range;
use takt_base::index::IndexVec;
use takt_base::{SourceId, Sources, Span};

/// Lines and files in the order of their first use.
pub struct Lines<'a> {
    sources: &'a Sources,
    /// Lines so far.
    pub lines: IndexVec<LineId, Line>,
    /// Names of files so far.
    pub files: Vec<String>,
    known_lines: HashMap<Line, LineId>,
    known_files: HashMap<SourceId, u32>,
    /// The line asked for last, whole: the next span is mostly on it.
    last: Option<(SourceId, Range<usize>, LineId)>,
}

impl<'a> Lines<'a> {
    /// None yet.
    pub fn new(sources: &'a Sources) -> Self {
        let (lines, files) = (IndexVec::new(), Vec::new());
        Self { sources, lines, files, known_lines: HashMap::new(), known_files: HashMap::new(), last: None }
    }

    /// The line on which a span begins.
    pub fn of(&mut self, span: Span) -> LineId {
        if let Some((source, whole, id)) = &self.last
            && *source == span.source
            && whole.contains(&(span.start as usize))
        {
            return *id;
        }
        let source = self.sources.get(span.source);
        let line = Line { file: self.file(span.source), line: source.line_number(span.start) };
        let id = *self.known_lines.entry(line).or_insert_with(|| self.lines.push(line));
        let whole = source.line_start(line.line)..source.line_start(line.line + 1);
        self.last = Some((span.source, whole, id));
        id
    }

    fn file(&mut self, source: SourceId) -> u32 {
        *self.known_files.entry(source).or_insert_with(|| {
            self.files.push(self.sources.get(source).name.clone());
            self.files.len() as u32 - 1
        })
    }
}
