//! Where a Fanuc-style program goes on: programs O1234 of one or more files, calls, N numbers, DO and END.
//! Runs: background. Invariant: calls and loops are bounded; rows that may run again are read once.

use super::reader::{Reader, Row};
use super::vars::Locals;
use crate::ngc::fault::Fault;
use crate::ngc::flow::Quick;
use crate::ngc::host::HostRef;
use crate::ngc::lenient;
use crate::ngc::lines::{Lines, Piece, Place, Style};
use crate::ngc::text::{self, Text, View, Window};
use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;
use takt_base::{Code, Diag, SourceId};

/// Rows that are kept.
const KEPT_MAX: usize = 100_000;
/// Texts that one program may use.
const FILES_MAX: usize = 1000;
/// Errors of rows that did not run.
const UNREAD_MAX: usize = 10_000;
/// Loops that one macro may have open.
const LOOPS_MAX: usize = 100;

/// A place in one of the texts.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Spot {
    file: u32,
    place: Place,
}

#[derive(Clone, Debug)]
struct File {
    source: SourceId,
    text: Text,
    lines: Lines,
    index: Option<Arc<Index>>,
}

/// Programs of a text and its N numbers, in their order: keys of their rows and places before them.
#[derive(Clone, Debug, Default)]
struct Index {
    programs: Vec<u64>,
    numbers: HashMap<u32, Place, Quick>,
    labels: HashMap<u32, Vec<(u64, Place)>, Quick>,
}

/// A call in progress.
#[derive(Clone, Debug)]
pub struct Frame {
    back: Spot,
    start: Spot,
    /// Runs still to come, this one among them.
    left: u32,
    loops: usize,
    /// Arguments of a macro; `None` for M98.
    pub arguments: Option<Box<Locals>>,
    /// Called by G66.
    pub modal: bool,
}

#[derive(Clone, Copy, Debug)]
struct Loop {
    number: u32,
    /// Before the row of the DO.
    here: Spot,
}

/// What comes next in the text.
#[derive(Debug)]
pub enum Next {
    /// A row.
    Row(Arc<Row>),
    /// A line that starts with `%`: its bytes.
    Percent(usize, usize),
    /// A row that can't be read, and its line.
    Wrong(Fault, u32),
    /// The end of the text.
    End,
}

/// The flow of a program.
#[derive(Clone, Debug)]
pub struct Flow {
    files: Vec<File>,
    at: u32,
    style: Style,
    reader: Reader,
    current: Arc<Row>,
    kept: HashMap<(u32, u64), (Arc<Row>, Place), Quick>,
    ends: HashMap<(u32, u64), Place, Quick>,
    frames: Vec<Frame>,
    loops: Vec<Loop>,
    here: Spot,
    jumped: bool,
    /// Takes files as users stream them.
    pub lenient: bool,
    /// What was passed over.
    pub notes: Vec<Diag>,
    window: Window,
    /// Why a file could not be read on, until that is said.
    trouble: Option<Fault>,
    /// It has been said: the program is at its end.
    pub broken: bool,
}

fn misfit(place: (u32, u32), label: impl Into<String>, help: &str) -> Fault {
    Fault::at(Code::BadMacro, place.0, place.1, label, help)
}

impl Flow {
    /// At the start of a text.
    pub fn new(source: SourceId, text: Text, style: Style) -> Self {
        let mut window = Window::default();
        let lines = Lines::new(&mut View { text: &text, file: 0, window: &mut window }, style);
        Flow {
            files: vec![File { source, text, lines, index: None }],
            at: 0,
            style,
            reader: Reader::default(),
            current: Arc::default(),
            kept: HashMap::default(),
            ends: HashMap::default(),
            frames: Vec::new(),
            loops: Vec::new(),
            here: Spot::default(),
            jumped: false,
            lenient: false,
            notes: Vec::new(),
            window,
            trouble: None,
            broken: false,
        }
    }

    /// The next piece of a file, read with lines of one's own; `None` at its end, and where it can't be read on.
    fn piece(&mut self, file: u32, lines: &mut Lines) -> Option<Piece> {
        let text = &self.files.get(file as usize)?.text;
        match lines.next(&mut View { text, file, window: &mut self.window }) {
            Ok(piece) => piece,
            Err(trouble) => {
                self.trouble.get_or_insert_with(|| trouble.fault(lines.place.next()));
                None
            }
        }
    }

    /// What was looked for in a file that could not be read on may well be there.
    fn read_on(&mut self) -> Result<(), Fault> {
        match self.trouble.take() {
            Some(fault) => {
                self.broken = true;
                Err(fault)
            }
            None => Ok(()),
        }
    }

    /// The text of the piece that was read last.
    fn part(&self, file: u32, range: Range<usize>) -> Cow<'_, str> {
        self.files.get(file as usize).map_or(Cow::Borrowed(""), |f| text::line(self.window.bytes(&f.text, file, range)))
    }

    fn file(&self) -> &File {
        &self.files[self.at as usize]
    }

    /// Its file in diagnostics.
    pub fn source(&self) -> SourceId {
        self.file().source
    }

    /// The piece of the text at hand that was read last.
    pub fn here(&self, range: Range<usize>) -> Cow<'_, str> {
        self.part(self.at, range)
    }

    /// Byte at which the text at hand ends.
    pub fn end_of_text(&self) -> usize {
        self.file().text.len()
    }

    /// Goes to a line (from 1) of the main program. False if there are fewer.
    ///
    /// # Errors
    /// The file can't be read.
    pub fn seek(&mut self, line: u32) -> Result<bool, Fault> {
        self.frames.clear();
        self.loops.clear();
        self.at = 0;
        let Some(file) = self.files.first_mut() else { return Ok(false) };
        let found = file.text.start_of(line).map_err(|trouble| trouble.fault(0))?;
        file.lines.place = Place::at_line(line, found.unwrap_or(0));
        Ok(found.is_some())
    }

    /// The line that was read last.
    pub fn line(&self) -> u32 {
        self.file().lines.line()
    }

    /// The call at hand.
    pub fn frame(&self) -> Option<&Frame> {
        self.frames.last()
    }

    /// Calls in progress.
    pub fn depth(&self) -> usize {
        self.frames.len()
    }

    /// Macros in progress: calls with variables of their own.
    pub fn macros(&self) -> usize {
        self.frames.iter().filter(|f| f.arguments.is_some()).count()
    }

    /// Where the next row is read.
    pub fn spot(&self) -> Spot {
        Spot { file: self.at, place: self.file().lines.place }
    }

    /// Goes to a place.
    pub fn go(&mut self, spot: Spot) {
        self.at = spot.file;
        self.files[spot.file as usize].lines.place = spot.place;
    }

    /// The next row.
    pub fn next_row(&mut self) -> Next {
        self.here = self.spot();
        let key = (self.at, self.here.place.key());
        if let Some((row, next)) = self.kept.get(&key) {
            let (row, next) = (row.clone(), *next);
            self.files[self.at as usize].lines.place = next;
            return Next::Row(row);
        }
        let mut lines = self.file().lines;
        let piece = self.piece(self.at, &mut lines);
        self.files[self.at as usize].lines = lines;
        if let Err(fault) = self.read_on() {
            return Next::Wrong(fault, lines.line());
        }
        let Some(piece) = piece else { return Next::End };
        let source = self.source();
        let inside = self.window.bytes(&self.files[self.at as usize].text, self.at, piece.range.clone());
        let inside = text::line(inside);
        let inside = &*inside;
        if inside.trim_start_matches([' ', '\t']).starts_with('%') {
            return Next::Percent(piece.range.start, piece.range.end);
        }
        if Arc::get_mut(&mut self.current).is_none() {
            self.current = Arc::default();
        }
        let Some(row) = Arc::get_mut(&mut self.current) else { return Next::End };
        let cleaned = if self.lenient { lenient::clean(inside, source, piece.range.start) } else { None };
        let inside = cleaned.as_ref().map_or(inside, |c| c.0.as_str());
        let read = self.reader.read(inside, piece.range.start, piece.line, row);
        if let Some((_, notes)) = cleaned {
            self.notes.extend(notes);
        }
        if let Err(fault) = read {
            return Next::Wrong(fault, piece.line);
        }
        let again = self.jumped || !self.frames.is_empty() || !self.loops.is_empty();
        if again && self.kept.len() < KEPT_MAX {
            let next = lines.place;
            self.kept.insert(key, (self.current.clone(), next));
        }
        Next::Row(self.current.clone())
    }

    fn index(&mut self, file: u32) -> Arc<Index> {
        let File { lines, index, .. } = &self.files[file as usize];
        if let Some(index) = index {
            return index.clone();
        }
        let (mut scan, mut found) = (*lines, Index::default());
        scan.place = Place::default();
        loop {
            let before = scan.place;
            let Some(piece) = self.piece(file, &mut scan) else { break };
            match head(&self.part(file, piece.range)) {
                Head::Program(number) => {
                    found.programs.push(before.key());
                    found.numbers.entry(number).or_insert(before);
                }
                Head::Label(number) => found.labels.entry(number).or_default().push((before.key(), before)),
                Head::None => {}
            }
        }
        self.files[file as usize].index.insert(Arc::new(found)).clone()
    }

    /// Key of the row that starts the program at `key`, and of the one that starts the next.
    fn bounds(index: &Index, key: u64) -> (u64, u64) {
        let behind = index.programs.partition_point(|&p| p <= key);
        let start = if behind == 0 { 0 } else { index.programs[behind - 1] };
        (start, index.programs.get(behind).copied().unwrap_or(u64::MAX))
    }

    /// Goes to the row with this N number of the program at hand: the next one, or else the first.
    ///
    /// # Errors
    /// There is none.
    pub fn goto(&mut self, n: u32, place: (u32, u32)) -> Result<(), Fault> {
        let index = self.index(self.at);
        self.read_on()?;
        let here = self.here.place.key();
        let (start, end) = Self::bounds(&index, here);
        let all = index.labels.get(&n).map_or(&[][..], Vec::as_slice);
        let from = |key: u64| all.get(all.partition_point(|l| l.0 < key)).filter(|l| l.0 < end);
        let Some(&(_, target)) = from(here + 1).or_else(|| from(start)) else {
            let help = "write the number of a block of this program";
            return Err(Fault::at(Code::MissingBlock, place.0, place.1, format!("no block N{n}"), help));
        };
        self.jumped |= target.key() <= here;
        self.files[self.at as usize].lines.place = target;
        self.leave_loops(target.key());
        Ok(())
    }

    fn base(&self) -> usize {
        self.frames.last().map_or(0, |f| f.loops)
    }

    /// Loops that do not hold the row at `key` are left.
    fn leave_loops(&mut self, key: u64) {
        while self.loops.len() > self.base()
            && let Some(&open) = self.loops.last()
        {
            let end = self.find_end(open.number, open.here).map_or(u64::MAX, Place::key);
            if open.here.place.key() < key && key < end {
                return;
            }
            self.loops.pop();
        }
    }

    /// `WHILE[..]DO m`.
    ///
    /// # Errors
    /// It has no END, or too many loops are open.
    pub fn begin(&mut self, holds: bool, number: u32, place: (u32, u32)) -> Result<(), Fault> {
        let Some(end) = self.find_end(number, self.here) else {
            return Err(misfit(place, format!("no END{number} behind it"), "write END and the number of the DO"));
        };
        if !holds {
            self.files[self.at as usize].lines.place = end;
            return Ok(());
        }
        if self.loops.len() - self.base() >= LOOPS_MAX {
            return Err(misfit(place, "too many loops are open", "end them, or call a macro"));
        }
        let here = self.here;
        self.loops.push(Loop { number, here });
        Ok(())
    }

    /// `END m`.
    ///
    /// # Errors
    /// No such loop is open.
    pub fn end(&mut self, number: u32, place: (u32, u32)) -> Result<(), Fault> {
        let base = self.base();
        let Some(i) = self.loops[base..].iter().rposition(|l| l.number == number) else {
            return Err(misfit(place, format!("no DO{number} is open"), "loops end in the order in which they nest"));
        };
        let start = self.loops[base + i].here;
        self.loops.truncate(base + i);
        self.go(start);
        Ok(())
    }

    /// Behind the END of the DO that stands at `from`.
    fn find_end(&mut self, number: u32, from: Spot) -> Option<Place> {
        let key = (from.file, from.place.key());
        if let Some(&place) = self.ends.get(&key) {
            return Some(place);
        }
        let mut scan = self.files[from.file as usize].lines;
        scan.place = from.place;
        self.piece(from.file, &mut scan)?;
        loop {
            let piece = self.piece(from.file, &mut scan)?;
            let inside = self.part(from.file, piece.range);
            if matches!(head(&inside), Head::Program(_)) {
                return None;
            }
            if is_end(&inside, number) {
                break;
            }
        }
        self.ends.insert(key, scan.place);
        Some(scan.place)
    }

    /// Enters program `number`, so many times.
    ///
    /// # Errors
    /// There is none, or too many calls are in progress.
    pub fn call(&mut self, call: Call, host: &HostRef, calls_max: usize) -> Result<(), Fault> {
        let place = call.place;
        if self.frames.len() >= calls_max {
            let help = "a macro that calls itself needs an end: a condition before the call";
            let label = format!("{} calls are in progress", self.frames.len());
            return Err(Fault::at(Code::NestedTooDeeply, place.0, place.1, label, help));
        }
        let found = self.find(call.number, host);
        self.read_on()?;
        let start = found.ok_or_else(|| {
            let help =
                format!("write it behind this one as O{0:04}, or put it into the file O{0:04}.ngc of the folder", call.number);
            Fault::at(Code::MissingSub, place.0, place.1, format!("no program O{:04}", call.number), help)
        })?;
        let (back, loops) = (self.spot(), self.loops.len());
        let Call { times: left, arguments, modal, .. } = call;
        self.frames.push(Frame { back, start, left, loops, arguments, modal });
        self.go(start);
        Ok(())
    }

    fn find(&mut self, number: u32, host: &HostRef) -> Option<Spot> {
        for file in [self.at, 0] {
            if let Some(spot) = self.program_in(file, number) {
                return Some(spot);
            }
        }
        for file in 1..self.files.len() as u32 {
            if let Some(spot) = self.program_in(file, number) {
                return Some(spot);
            }
        }
        let names = [format!("O{number:04}"), format!("o{number:04}"), number.to_string()];
        let (source, text) = names.iter().find_map(|name| host.open_text(name)).filter(|_| self.files.len() < FILES_MAX)?;
        let file = self.files.len() as u32;
        let lines = Lines::new(&mut View { text: &text, file, window: &mut self.window }, self.style);
        self.files.push(File { source, text, lines, index: None });
        // A file of its own may leave the program number out.
        self.program_in(file, number).or(Some(Spot { file, place: Place::default() }))
    }

    fn program_in(&mut self, file: u32, number: u32) -> Option<Spot> {
        let index = self.index(file);
        let &place = index.numbers.get(&number)?;
        Some(Spot { file, place })
    }

    /// M99: the next run of the subprogram, or back. `None` in the main program; else the frame that was left or runs again.
    pub fn leave(&mut self, n: Option<u32>, place: (u32, u32)) -> Result<Option<Left>, Fault> {
        let Some(frame) = self.frames.last_mut() else { return Ok(None) };
        if n.is_none() && frame.left > 1 {
            frame.left -= 1;
            let (start, loops, arguments) = (frame.start, frame.loops, frame.arguments.clone());
            self.loops.truncate(loops);
            self.go(start);
            return Ok(Some(Left::Again(arguments)));
        }
        let Some(frame) = self.frames.pop() else { return Ok(None) };
        self.loops.truncate(frame.loops);
        self.go(frame.back);
        if let Some(n) = n {
            self.here = frame.back;
            self.goto(n, place)?;
        }
        Ok(Some(Left::Back(frame.arguments.is_some())))
    }

    /// The place and the open loops, for a stretch of rows that is run in between.
    pub fn save(&self) -> (Spot, Spot, usize, Vec<(u32, Spot)>) {
        (self.spot(), self.here, self.frames.len(), self.loops.iter().map(|l| (l.number, l.here)).collect())
    }

    /// Back to what [`Flow::save`] gave.
    pub fn restore(&mut self, (spot, here, depth, loops): (Spot, Spot, usize, Vec<(u32, Spot)>)) {
        self.frames.truncate(depth);
        self.loops = loops.into_iter().map(|(number, here)| Loop { number, here }).collect();
        self.here = here;
        self.go(spot);
    }

    /// What can't be read in the rows of the programs of the main text, whether they run or not.
    pub fn unread(&mut self) -> Vec<Diag> {
        let File { source, lines, .. } = &self.files[0];
        let (source, mut scan, mut row, mut found) = (*source, *lines, Row::default(), Vec::new());
        scan.place = Place::default();
        let (mut inside, mut opened) = (true, false);
        while !self.broken
            && found.len() < UNREAD_MAX
            && let Some(piece) = self.piece(0, &mut scan)
        {
            let part = text::line(self.window.bytes(&self.files[0].text, 0, piece.range.clone()));
            let part = &*part;
            if part.trim_start_matches([' ', '\t']).starts_with('%') {
                // The second of two ends a program; what stands behind it is no row.
                (inside, opened) = (!opened, false);
                continue;
            }
            inside |= matches!(head(part), Head::Program(_));
            opened |= inside;
            let cleaned = if self.lenient { lenient::clean(part, source, piece.range.start) } else { None };
            let part = cleaned.as_ref().map_or(part, |c| c.0.as_str());
            if inside && let Err(fault) = self.reader.read(part, piece.range.start, piece.line, &mut row) {
                found.push(fault.diag(source));
            }
        }
        found
    }

    /// Goes back to the start (M99 in the main program).
    pub fn restart(&mut self) {
        self.loops.clear();
        self.at = 0;
        self.jumped = true;
        self.files[0].lines.place = Place::default();
    }
}

/// What [`Flow::leave`] did.
#[derive(Debug)]
pub enum Left {
    /// The program runs once more, with these arguments.
    Again(Option<Box<Locals>>),
    /// It is left; true if it was a macro with variables of its own.
    Back(bool),
}

/// A call to be made.
#[derive(Debug)]
pub struct Call {
    /// Program number.
    pub number: u32,
    /// How often, from 1.
    pub times: u32,
    /// Of a macro.
    pub arguments: Option<Box<Locals>>,
    /// By G66.
    pub modal: bool,
    /// Bytes of the text that asks for it.
    pub place: (u32, u32),
}

/// How a row starts.
enum Head {
    Program(u32),
    Label(u32),
    None,
}

/// `O` or `N` and digits behind blanks and a skip mark.
fn head(text: &str) -> Head {
    let mut bytes = text.bytes().filter(|b| !matches!(b, b' ' | b'\t')).peekable();
    if bytes.peek() == Some(&b'/') {
        bytes.next();
        if bytes.peek().is_some_and(u8::is_ascii_digit) {
            bytes.next();
        }
    }
    let letter = bytes.next().map(|b| b.to_ascii_lowercase());
    let (mut value, mut digits) = (0_u64, 0);
    while let Some(b) = bytes.next_if(u8::is_ascii_digit) {
        value = (value * 10 + u64::from(b - b'0')).min(u64::from(u32::MAX));
        digits += 1;
    }
    match letter {
        Some(b'o' | b':') if digits > 0 => Head::Program(value as u32),
        Some(b'n') if digits > 0 => Head::Label(value as u32),
        _ => Head::None,
    }
}

/// `[N number] END m`.
fn is_end(text: &str, number: u32) -> bool {
    let mut bytes = text.bytes().filter(|b| !matches!(b, b' ' | b'\t')).map(|b| b.to_ascii_lowercase()).peekable();
    if bytes.next_if(|&b| b == b'n').is_some() {
        while bytes.next_if(u8::is_ascii_digit).is_some() {}
    }
    if !b"end".iter().all(|&want| bytes.next_if_eq(&want).is_some()) {
        return false;
    }
    let mut value = 0_u64;
    while let Some(b) = bytes.next_if(u8::is_ascii_digit) {
        value = (value * 10 + u64::from(b - b'0')).min(u64::from(u32::MAX));
    }
    value == u64::from(number)
}
