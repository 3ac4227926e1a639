//! The texts of a program: its own, and those of subroutines in files of their own.

use crate::ngc::lines::{Lines, Piece, Place, Style};
use std::sync::Arc;
use takt_base::SourceId;

/// A place in one of the texts.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Spot {
    /// Which text.
    pub file: u32,
    /// Where in it.
    pub place: Place,
}

/// Texts that one program may use.
const FILES_MAX: usize = 10_000;

#[derive(Clone, Debug)]
struct File {
    source: SourceId,
    text: Arc<str>,
    lines: Lines,
    indexed: bool,
}

/// All texts, and the one at hand.
#[derive(Clone, Debug)]
pub struct Files {
    all: Vec<File>,
    /// The text at hand.
    pub at: u32,
    style: Style,
}

impl Files {
    /// With the text of the main program.
    pub fn new(source: SourceId, text: Arc<str>, style: Style) -> Self {
        let mut files = Files { all: Vec::new(), at: 0, style };
        files.add(source, text);
        files
    }

    /// Adds a text; `None` if there are too many.
    pub fn add(&mut self, source: SourceId, text: Arc<str>) -> Option<u32> {
        if self.all.len() >= FILES_MAX {
            return None;
        }
        let lines = Lines::new(&text, self.style);
        self.all.push(File { source, text, lines, indexed: false });
        Some(self.all.len() as u32 - 1)
    }

    fn file(&mut self) -> &mut File {
        &mut self.all[self.at as usize]
    }

    /// The place in the text at hand.
    pub fn lines(&mut self) -> &mut Lines {
        &mut self.all[self.at as usize].lines
    }

    /// The next piece of the text at hand.
    pub fn next_piece(&mut self) -> Option<Piece> {
        let file = self.file();
        file.lines.next(&file.text)
    }

    /// The text at hand, borrowed.
    pub fn text_ref(&self) -> &str {
        &self.all[self.at as usize].text
    }

    /// Its file in diagnostics.
    pub fn source(&self) -> SourceId {
        self.all[self.at as usize].source
    }

    /// The place at hand.
    pub fn spot(&mut self) -> Spot {
        Spot { file: self.at, place: self.lines().place }
    }

    /// Goes to a place.
    pub fn go(&mut self, spot: Spot) {
        self.at = spot.file;
        self.lines().place = spot.place;
    }

    /// True once for each text: its subroutines have to be looked for.
    pub fn index_now(&mut self, file: u32) -> bool {
        self.all.get_mut(file as usize).is_some_and(|f| !std::mem::replace(&mut f.indexed, true))
    }
}
