//! What a block asks for: its codes by modal group and its other words by letter, with the rules that need no geometry:
//! one code a group (R1-37), one word a letter, every word used, every code complete, values in range.

use super::code::{Code as Arena, Row, Target};
use super::expr::run::{self, Stack};
use super::fault::Fault;
use super::modal::{Motion, Retract};
use super::param::{self, Kind, Name};
use super::state::State;
use super::word::{self, Action, Control, GROUPS, Group};
use takt_base::{Code, Diag, SourceId, Span};

mod put;

/// A letter and its number.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Word {
    /// Upper case.
    pub letter: char,
    /// Computed.
    pub value: f64,
    /// Letter and number.
    pub span: Span,
}

impl Word {
    /// The value, if it is a whole number that is not negative.
    pub fn whole(&self) -> Option<u32> {
        word::whole(self.value)
    }
}

/// Letters, then `@`, `^`, `$`.
const LETTERS: usize = 29;
const NOWHERE: Span = Span { source: SourceId(0), start: 0, end: 0 };

/// The words of a block, sorted. Kept from block to block.
#[derive(Clone, Debug)]
pub struct Request {
    /// The whole block.
    pub span: Span,
    /// N word.
    pub n: Option<u32>,
    /// The motion that this block makes: its own code, or the one in force.
    pub motion: Option<Motion>,
    codes: [(Action, Span); GROUPS],
    has_code: u32,
    letters: [Word; LETTERS],
    has_letter: u32,
    settings: Vec<(Place, f64)>,
}

/// A parameter that is set.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Place {
    Numbered(u16),
    Named(Name),
}

/// Axis letters in the order of a position.
pub const AXES: [char; 6] = ['X', 'Y', 'Z', 'A', 'B', 'C'];
/// Letters that tell where the centre of an arc is.
pub const CENTRE: [char; 4] = ['I', 'J', 'K', 'R'];

impl Default for Request {
    fn default() -> Self {
        Request {
            span: NOWHERE,
            n: None,
            motion: None,
            codes: [(Action::Dwell, NOWHERE); GROUPS],
            has_code: 0,
            letters: [Word { letter: ' ', value: 0.0, span: NOWHERE }; LETTERS],
            has_letter: 0,
            settings: Vec::new(),
        }
    }
}

impl Request {
    /// Computes and sorts the words of `row`; what is wrong goes to `out`, and the rest is kept. With an unknown code there is no
    /// motion, and no word counts as unused: nobody knows what it would have been for.
    pub fn fill(
        &mut self,
        row: &Row,
        source: SourceId,
        arena: &Arena,
        state: &mut State,
        stack: &mut Stack,
        out: &mut Vec<Diag>,
    ) {
        self.span = Span { source, start: row.place.0, end: row.place.1 };
        self.n = row.n;
        self.motion = None;
        (self.has_code, self.has_letter) = (0, 0);
        let done = self.words(row, arena, state, stack, out);
        let known = match done.and_then(|known| self.settings(row, arena, state, stack).map(|()| known)) {
            Ok(known) => known,
            Err(fault) => return out.push(fault.diag(source)),
        };
        self.motion = self.find_motion(state).filter(|_| known);
        let before = out.len();
        self.check_values(state, out);
        if known && out.len() == before && !self.is_plain_move() {
            self.check_used(row, arena, out);
        }
    }

    /// All words, each computed; whether all codes are known.
    fn words(&mut self, row: &Row, arena: &Arena, state: &State, stack: &mut Stack, out: &mut Vec<Diag>) -> Result<bool, Fault> {
        let mut known = true;
        for word in &arena.words[row.words.range()] {
            let (start, end) = word.place;
            let span = Span { start, end, ..self.span };
            let value = run::value(word.value, arena, state, stack)?;
            if value.is_nan() || value.abs() > super::number::MAX {
                return Err(Fault::at(Code::BadValue, start, end, "above 1000000000000", "check the expression"));
            }
            match word.letter {
                'G' | 'M' => known &= self.add_code(word.letter, value, word.action, span, state, out),
                letter => self.add_letter(Word { letter, value, span }, out),
            }
        }
        Ok(known)
    }

    /// Computes what the settings set, then sets it: all values of a row count before (LinuxCNC "Parameters").
    fn settings(&mut self, row: &Row, arena: &Arena, state: &mut State, stack: &mut Stack) -> Result<(), Fault> {
        self.settings.clear();
        for setting in &arena.settings[row.settings.range()] {
            let place = match setting.target {
                Target::Named(name) => writable_name(name, setting.place)?,
                Target::Numbered(index) => writable(run::value(index, arena, state, stack)?, setting.place)?,
            };
            self.settings.push((place, run::value(setting.value, arena, state, stack)?));
        }
        for &(place, value) in &self.settings {
            match place {
                Place::Numbered(index) => state.params.set(index, value),
                Place::Named(name) if name.kind == Kind::Outside => {
                    let set = state.set_outside(arena.names.text(name), value);
                    set.map_err(|e| Fault::at(e.code, self.span.start, self.span.end, e.label, e.help))?;
                }
                Place::Named(name) => state.params.set_named(name, value),
            }
        }
        Ok(())
    }

    /// The code of a group, if the block has one.
    pub fn code(&self, group: Group) -> Option<Action> {
        self.has_group(group).then(|| self.codes[group as usize].0)
    }

    /// Where the code of a group stands; else the block.
    pub fn code_span(&self, group: Group) -> Span {
        if self.has_group(group) { self.codes[group as usize].1 } else { self.span }
    }

    fn has_group(&self, group: Group) -> bool {
        self.has_code & (1 << group as u32) != 0
    }

    /// True if the block has neither codes nor letters.
    pub fn is_empty(&self) -> bool {
        self.has_code == 0 && self.has_letter == 0
    }

    /// True if there is nothing but a motion code and letters other than T.
    pub fn only_moves(&self) -> bool {
        self.has_code & !(1 << Group::Motion as u32) == 0 && self.has_letter & bit('T') == 0
    }

    /// A motion with nothing but letters that it reads: nobody else can claim one.
    fn is_plain_move(&self) -> bool {
        const PLAIN: u32 = bit('X') | bit('Y') | bit('Z') | bit('A') | bit('B') | bit('C') | bit('F') | bit('S') | bit('T');
        match self.motion {
            Some(Motion::Rapid | Motion::Linear) => self.only_moves() && self.has_letter & !PLAIN == 0,
            Some(motion) => self.only_moves() && self.has_letter & !(PLAIN & !AXIS_BITS | letters_of(motion.operands())) == 0,
            None => false,
        }
    }

    /// The word with this letter, if the block has one.
    pub fn word(&self, letter: char) -> Option<Word> {
        let i = slot(letter)?;
        (self.has_letter & (1 << i) != 0).then(|| self.letters[i])
    }

    /// Its value.
    pub fn value(&self, letter: char) -> Option<f64> {
        self.word(letter).map(|w| w.value)
    }

    /// True if one of these letters is there.
    pub fn any(&self, letters: &str) -> bool {
        letters.chars().any(|l| self.word(l).is_some())
    }

    /// Where the motion stands: its code, or else the first word that it uses.
    pub fn motion_span(&self) -> Span {
        if self.has_group(Group::Motion) {
            return self.codes[Group::Motion as usize].1;
        }
        AXES.iter().chain(&CENTRE).find_map(|&l| self.word(l)).map_or(self.span, |w| w.span)
    }

    /// From the first to the last of these words.
    pub fn span_of(&self, letters: &[char]) -> Span {
        let spans = letters.iter().filter_map(|&l| self.word(l)).map(|w| w.span);
        spans.reduce(|a, b| a.to(b)).unwrap_or_else(|| self.motion_span())
    }

    /// Words that move an axis.
    fn axis_words(&self) -> bool {
        const ALL: u32 = bit('X') | bit('Y') | bit('Z') | bit('A') | bit('B') | bit('C');
        self.has_letter & (ALL | 1 << 26 | 1 << 27) != 0
    }

    fn add_code(
        &mut self,
        letter: char,
        value: f64,
        action: Option<Action>,
        span: Span,
        state: &State,
        out: &mut Vec<Diag>,
    ) -> bool {
        let action = action.or_else(|| if letter == 'G' { word::g_of(value) } else { word::m_of(value) });
        let foreign = |a: &Action| state.options.drop_in && matches!(a, Action::User(_));
        let Some(action) = action.filter(|a| !foreign(a)) else {
            out.push(unknown(letter, value, span));
            return false;
        };
        let group = action.group();
        if self.has_group(group) {
            out.push(conflict(group, span, self.codes[group as usize].1));
        } else {
            self.has_code |= 1 << group as u32;
            self.codes[group as usize] = (action, span);
        }
        true
    }

    fn add_letter(&mut self, word: Word, out: &mut Vec<Diag>) {
        let Some(i) = slot(word.letter) else { return };
        if self.has_letter & (1 << i) != 0 {
            out.push(
                Diag::new(Code::DuplicateWord, word.span, format!("a second {} word", word.letter))
                    .also(self.letters[i].span, "the first one stands here")
                    .help("keep one of them, or write two blocks"),
            );
        } else {
            self.has_letter |= 1 << i;
            self.letters[i] = word;
        }
    }

    /// A code that takes the axis words leaves none for the motion in force.
    fn find_motion(&self, state: &State) -> Option<Motion> {
        if let Some(Action::Motion(motion)) = self.code(Group::Motion) {
            return motion;
        }
        if self.taker().is_some() || self.has_letter == 0 {
            return None;
        }
        let modal = state.modal.motion?;
        let centre = || CENTRE.iter().any(|&l| self.word(l).is_some());
        (self.axis_words() || (modal.is_arc() && centre())).then_some(modal)
    }

    /// The code that takes the axis words for itself.
    fn taker(&self) -> Option<(Action, Span)> {
        let place = |group: Group| self.has_group(group).then(|| self.codes[group as usize]);
        [Group::NonModal, Group::Length].into_iter().filter_map(place).find(|(action, _)| action.takes_axes())
    }

    /// Words without which a motion code makes no sense, whatever the modes.
    fn check_motion(&self, out: &mut Vec<Diag>) {
        let Some(Action::Motion(Some(motion))) = self.code(Group::Motion) else { return };
        let help = match motion {
            Motion::Probe(_) | Motion::Synchronized | Motion::RigidTap | Motion::Canned(_) if !self.axis_words() => {
                "write where the motion ends"
            }
            Motion::Thread => match ['P', 'I', 'J', 'K', 'Z'].iter().find(|&&l| self.word(l).is_none()) {
                Some(letter) => {
                    let help = "a thread has its pitch P, its end Z, and I, J, K for its depth";
                    return out.push(missing(self.motion_span(), &letter.to_string()).help(help));
                }
                None if self.value('P').is_some_and(|p| p <= 0.0) => "the pitch P is above 0",
                None => return,
            },
            Motion::Synchronized | Motion::RigidTap if self.word('K').is_none() => {
                return out.push(missing(self.motion_span(), "K").help("K is the distance a revolution of the spindle"));
            }
            Motion::Canned(_) if self.value('L').is_some_and(|l| word::whole(l).is_none()) => "L is a whole number of holes",
            _ => return,
        };
        out.push(missing(self.motion_span(), "an axis word").help(help));
    }

    fn check_values(&self, state: &State, out: &mut Vec<Diag>) {
        const CHECKED: u32 = bit('F') | bit('S') | bit('T') | bit('P') | bit('L');
        self.check_motion(out);
        if state.options.drop_in
            && self.code(Group::NonModal) == Some(Action::Machine)
            && !matches!(self.motion, Some(Motion::Rapid | Motion::Linear))
        {
            out.push(not_now(self.code_span(Group::NonModal), "G53 without a motion", "write G0 or G1 in the block"));
        }
        if self.has_letter & CHECKED == 0 && self.only_moves() {
            return;
        }
        for letter in ['F', 'S', 'L'] {
            if let Some(word) = self.word(letter).filter(|w| w.value < 0.0) {
                out.push(bad_value(word, "less than zero", "write zero or more"));
            }
        }
        if let Some(word) = self.word('P').filter(|w| self.motion.is_some_and(Motion::is_arc) && w.whole().is_none_or(|p| p == 0))
        {
            out.push(bad_value(word, "not a number of turns", "write a whole number from 1"));
        }
        if let Some(word) = self.word('T').filter(|w| w.whole().is_none()) {
            out.push(bad_value(word, "not the number of a tool", "write a whole number from 0"));
        }
        let positive = [Some(Action::Dwell), Some(Action::Control(Control::Continuous))];
        let length = [Group::NonModal, Group::Control].iter().any(|&g| positive.contains(&self.code(g)));
        if let Some(word) = self.word('P').filter(|w| length && w.value < 0.0) {
            out.push(bad_value(word, "less than zero", "write zero or more"));
        }
        if self.code(Group::NonModal) == Some(Action::Dwell) && self.word('P').is_none() {
            let at = self.code_span(Group::NonModal);
            out.push(missing(at, "P").help("write the time in seconds, such as G4 P0.5"));
        }
        if let (Some((_, taker)), Some(Action::Motion(Some(motion)))) = (self.taker(), self.code(Group::Motion))
            && self.axis_words()
        {
            out.push(two_takers(taker, motion, self.code_span(Group::Motion)));
        }
    }

    fn check_used(&self, row: &Row, arena: &Arena, out: &mut Vec<Diag>) {
        let own = (0..GROUPS).filter(|i| self.has_code & (1 << i) != 0).map(|i| self.codes[i].0);
        let modal = (!self.has_group(Group::Motion)).then_some(Action::Motion(self.motion));
        for word in &arena.words[row.words.range()] {
            if matches!(word.letter, 'G' | 'M' | 'F' | 'S' | 'T') {
                continue;
            }
            if word.letter == '$' && self.has_spindle_code() {
                continue;
            }
            let readers = own.clone().chain(modal).filter(|a| a.operands().contains(word.letter)).count();
            let span = Span { start: word.place.0, end: word.place.1, ..self.span };
            match readers {
                0 => out.push(unused(word.letter, span)),
                1 => {}
                _ if self.shared(word.letter) => {}
                _ => out.push(claimed_twice(word.letter, span)),
            }
        }
    }

    /// A code that names a spindle.
    fn has_spindle_code(&self) -> bool {
        let groups = [Group::Spindle, Group::SpindleMode, Group::Overrides];
        let motion = matches!(
            self.motion,
            Some(Motion::Synchronized | Motion::RigidTap | Motion::Thread | Motion::Canned(74 | 84 | 86 | 87 | 88))
        );
        motion || self.word('S').is_some() || groups.into_iter().any(|g| self.has_group(g))
    }

    /// Letters that two codes of one block may read: both mean the same.
    fn shared(&self, letter: char) -> bool {
        letter == 'R' && matches!(self.code(Group::Retract), Some(Action::Retract(Retract::R)))
            || self.code(Group::Io) == Some(Action::Io(66)) && letter == 'P'
            || "XYZABCUVW@^".contains(letter)
    }

    /// P of G64 in length units; 0 if none is given.
    pub fn tolerance(&self, control: Control) -> f64 {
        if control == Control::Continuous { self.value('P').unwrap_or(0.0) } else { 0.0 }
    }
}

const AXIS_BITS: u32 = bit('X') | bit('Y') | bit('Z') | bit('A') | bit('B') | bit('C');

/// Bits of these letters.
fn letters_of(operands: &str) -> u32 {
    operands.bytes().filter_map(|b| slot(char::from(b))).fold(0, |bits, i| bits | 1 << i)
}

const fn bit(letter: char) -> u32 {
    1 << (letter as u32 - 'A' as u32)
}

fn slot(letter: char) -> Option<usize> {
    match letter {
        'A'..='Z' => Some(letter as usize - 'A' as usize),
        '@' => Some(26),
        '^' => Some(27),
        '$' => Some(28),
        _ => None,
    }
}

fn writable(index: f64, place: (u32, u32)) -> Result<Place, Fault> {
    let fault = |label, help| Err(Fault::at(Code::BadParameter, place.0, place.1, label, help));
    match param::index(index) {
        Some(index) if State::read_only(index) => fault("read only", "it shows the state of the tool or the position"),
        Some(index) => Ok(Place::Numbered(index)),
        None => fault("no parameter has this number", "numbers are whole, from 1 to 5601"),
    }
}

fn writable_name(name: Name, place: (u32, u32)) -> Result<Place, Fault> {
    match name.kind {
        Kind::Fixed(_) => {
            let help = "it shows the state of the interpreter; choose another name";
            Err(Fault::at(Code::BadParameter, place.0, place.1, "read only", help))
        }
        _ => Ok(Place::Named(name)),
    }
}

fn unknown(letter: char, value: f64, span: Span) -> Diag {
    let label = format!("{letter}{value} means nothing here");
    let help = match letter {
        'G' => word::whole(value * 10.0).map_or("G codes have at most one decimal", word::instead_of_g),
        _ => "M codes are whole numbers from 0 to 199",
    };
    let cycle = letter == 'G' && matches!(word::whole(value * 10.0), Some(700..=729));
    Diag::new(if cycle { Code::NotInThisVersion } else { Code::UnknownCode }, span, label).help(help)
}

fn conflict(group: Group, at: Span, first: Span) -> Diag {
    Diag::new(Code::ModalConflict, at, format!("a second code of the group: {}", group.name()))
        .also(first, "the first one stands here")
        .help("keep one of them, or write two blocks")
}

fn two_takers(taker: Span, motion: Motion, at: Span) -> Diag {
    Diag::new(Code::ModalConflict, at, format!("{} would use the axis words too", motion.text()))
        .message("two codes of the block use the axis words")
        .also(taker, "this code uses them")
        .help("write two blocks")
}

fn claimed_twice(letter: char, span: Span) -> Diag {
    Diag::new(Code::ModalConflict, span, format!("{letter} would belong to several codes"))
        .message("two codes of the block read the same word")
        .help("write two blocks")
}

fn unused(letter: char, span: Span) -> Diag {
    let help = match letter {
        'X' | 'Y' | 'Z' | 'A' | 'B' | 'C' => "write the motion: G0, G1, G2 or G3",
        'I' | 'J' | 'K' | 'R' => "only arcs, splines and cycles have such a word",
        'U' | 'V' | 'W' => "the axes are X Y Z A B C",
        'P' | 'Q' => "P and Q belong to G4, G10, G64, arcs, splines, cycles and user M codes",
        'D' => "D belongs to G41, G42 and G96",
        'H' => "H belongs to G43",
        'L' => "L belongs to G10, M66, M98 and cycles",
        _ => "remove the word",
    };
    Diag::new(Code::UnusedWord, span, format!("nothing reads {letter}")).help(help)
}

/// A value that its word can't have.
pub fn bad_value(word: Word, label: &str, help: &str) -> Diag {
    Diag::new(Code::BadValue, word.span, label).help(help)
}

/// A word that a code needs.
pub fn missing(at: Span, letter: &str) -> Diag {
    Diag::new(Code::MissingWord, at, format!("needs {letter}"))
}

/// A code that the mode in force does not allow.
pub fn not_now(at: Span, label: impl Into<String>, help: &str) -> Diag {
    Diag::new(Code::NotInThisMode, at, label).help(help)
}
