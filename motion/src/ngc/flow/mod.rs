//! Where the program goes on: subroutines, branches, loops.
//! Runs: background. Invariant: blocks and calls are bounded; a row that was compiled in a loop or subroutine is not read again.

pub mod files;
mod kept;
pub mod owords;
mod skip;

use super::code::{Code as Arena, Row};
use super::fault::Fault;
use super::lenient;
use super::lines::{Place, trimmed};
use super::param::Name;
use super::reader::Reader;
use super::state::State;
use super::text;
use files::{Files, Spot};
use std::collections::HashMap;
use takt_base::{Code, Diag};

/// A subroutine or block.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Key {
    /// `o100`.
    Number(u32),
    /// `o<name>`, by its index.
    Name(u32),
}

impl Key {
    /// Of a named label.
    pub fn of(name: Name) -> Self {
        Key::Name(name.id)
    }
}

/// A block that is open.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Open {
    /// A branch is being executed.
    If,
    /// Where the `while` stands.
    While(Place),
    /// Behind the `do`.
    Do(Place),
    /// Behind the `repeat`, and how often still.
    Repeat(Place, u64),
}

/// A call in progress.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Frame {
    key: Key,
    /// Where the caller goes on.
    back: Spot,
    /// First open block of the call.
    blocks: usize,
    /// M98: no arguments, and how often still.
    program: Option<u32>,
    /// Start of the subroutine.
    start: Spot,
}

/// Open blocks that a call may have.
const BLOCKS_MAX: usize = 1000;
/// Subroutines that a program may have.
const SUBS_MAX: usize = 50_000;

/// What the flow of a program knows.
#[derive(Clone, Debug)]
pub struct Flow {
    /// Texts, and the place in one of them.
    pub files: Files,
    /// Compiled rows.
    pub code: Arena,
    reader: Reader,
    kept: kept::Rows,
    jumps: HashMap<(u32, u64), Place, Quick>,
    subs: HashMap<Key, Spot>,
    frames: Vec<Frame>,
    blocks: Vec<(Key, Open)>,
    args: Vec<f64>,
    /// Where the row at hand stands.
    here: Place,
    /// The program has begun anew (M99).
    restarted: bool,
    /// Errors of rows that are not executed are looked for too.
    pub thorough: bool,
    /// Errors found in rows that are not executed.
    pub found: Vec<Fault>,
    /// Takes files as users stream them.
    pub lenient: bool,
    /// What was passed over.
    pub notes: Vec<Diag>,
}

/// What comes next in the text.
#[derive(Debug)]
pub enum Next {
    /// A row.
    Row(Row),
    /// A line that starts with `%`: its bytes.
    Percent(usize, usize),
    /// A row that can't be read, and its line.
    Wrong(Fault, u32),
    /// The end of the text.
    End,
}

impl Flow {
    /// At the start of a program.
    pub fn new(files: Files) -> Self {
        Flow {
            files,
            code: Arena::default(),
            reader: Reader::default(),
            kept: kept::Rows::default(),
            jumps: HashMap::default(),
            subs: HashMap::new(),
            frames: Vec::new(),
            blocks: Vec::new(),
            args: Vec::new(),
            here: Place::default(),
            restarted: false,
            thorough: false,
            found: Vec::new(),
            lenient: false,
            notes: Vec::new(),
        }
    }

    /// Calls in progress.
    pub fn depth(&self) -> usize {
        self.frames.len()
    }

    /// True if a block of the present call is open.
    pub fn block_is_open(&self) -> bool {
        !self.blocks.is_empty()
    }

    /// True where the program may be in a circle.
    pub fn may_repeat(&self) -> bool {
        self.restarted || self.keeps()
    }

    /// True where rows may be executed again.
    fn keeps(&self) -> bool {
        !self.frames.is_empty() || !self.blocks.is_empty()
    }

    /// The next row. A row of a straight program is forgotten when the next one is read.
    pub fn next_row(&mut self) -> Next {
        self.here = self.files.lines().place;
        let (keeps, key) = (self.keeps(), (self.files.at, self.here.key()));
        if keeps && let Some((row, next)) = self.kept.get(key) {
            self.files.lines().place = next;
            return Next::Row(*row);
        }
        let mark = self.code.kept_mark();
        self.code.truncate(mark);
        let next = self.read();
        if keeps
            && let Next::Row(row) = &next
            && self.kept.keep(key, row, self.files.lines().place, &self.code)
        {
            self.code.keep();
        }
        next
    }

    fn read(&mut self) -> Next {
        let piece = match self.files.next_piece() {
            Ok(Some(piece)) => piece,
            Ok(None) => return Next::End,
            Err(fault) => return Next::Wrong(fault, self.files.lines().line()),
        };
        let inside = self.files.bytes(piece.range.clone());
        if trimmed(inside).starts_with(b"%") {
            return Next::Percent(piece.range.start, piece.range.end);
        }
        let cleaned =
            if self.lenient { lenient::clean(&text::line(inside), self.files.source(), piece.range.start) } else { None };
        let inside = cleaned.as_ref().map_or(inside, |c| c.0.as_bytes());
        let read = self.reader.read(inside, piece.range.start, piece.line, &mut self.code);
        if let Some((_, notes)) = cleaned {
            self.notes.extend(notes);
        }
        match read {
            Ok(row) => Next::Row(row),
            Err(fault) => Next::Wrong(fault, piece.line),
        }
    }

    /// Goes back to the start (M99 in the main program).
    pub fn restart(&mut self) {
        self.blocks.clear();
        self.restarted = true;
        self.files.lines().place = Place::default();
    }

    /// Ends all calls and blocks.
    pub fn leave_all(&mut self, state: &mut State) {
        self.unwind(state);
        self.blocks.clear();
    }

    /// The first block of the call at hand.
    fn base(&self) -> usize {
        self.frames.last().map_or(0, |f| f.blocks)
    }

    fn top(&self) -> Option<(Key, Open)> {
        (self.blocks.len() > self.base()).then(|| self.blocks[self.blocks.len() - 1])
    }

    fn open(&mut self, key: Key, open: Open, place: (u32, u32)) -> Result<(), Fault> {
        if self.blocks.len() - self.base() >= BLOCKS_MAX {
            return Err(misfit(place, "more than 1000 blocks are open", "close them, or call a subroutine"));
        }
        self.blocks.push((key, open));
        Ok(())
    }
}

/// An O word that does not fit.
pub fn misfit(place: (u32, u32), label: &str, help: &str) -> Fault {
    Fault::at(Code::BadFlow, place.0, place.1, label, help)
}

/// A hash for places: they are few bits and well spread already.
#[derive(Clone, Copy, Debug, Default)]
pub struct Quick;

impl std::hash::BuildHasher for Quick {
    type Hasher = QuickHasher;
    fn build_hasher(&self) -> QuickHasher {
        QuickHasher(0)
    }
}

/// See [`Quick`].
#[derive(Clone, Copy, Debug)]
pub struct QuickHasher(u64);

impl std::hash::Hasher for QuickHasher {
    fn finish(&self) -> u64 {
        self.0
    }
    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|&b| self.write_u64(u64::from(b)));
    }
    fn write_u32(&mut self, value: u32) {
        self.write_u64(u64::from(value));
    }
    fn write_u64(&mut self, value: u64) {
        self.0 = (self.0.rotate_left(5) ^ value).wrapping_mul(0x517c_c1b7_2722_0a95);
    }
}
