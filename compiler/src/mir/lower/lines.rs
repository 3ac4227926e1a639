//! Source lines of instructions, each stored once.

use crate::mir::model::{Line, LineId};
use std::collections::HashMap;
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
}

impl<'a> Lines<'a> {
    /// None yet.
    pub fn new(sources: &'a Sources) -> Self {
        let (lines, files) = (IndexVec::new(), Vec::new());
        Self { sources, lines, files, known_lines: HashMap::new(), known_files: HashMap::new() }
    }

    /// The line on which a span begins.
    pub fn of(&mut self, span: Span) -> LineId {
        let file = self.file(span.source);
        let line = Line { file, line: self.sources.line_col(span.source, span.start).line };
        *self.known_lines.entry(line).or_insert_with(|| self.lines.push(line))
    }

    fn file(&mut self, source: SourceId) -> u32 {
        *self.known_files.entry(source).or_insert_with(|| {
            self.files.push(self.sources.get(source).name.clone());
            self.files.len() as u32 - 1
        })
    }
}
