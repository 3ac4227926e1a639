//! What a block asks for: its codes by modal group and its other words by letter, with the rules that need no geometry:
//! one code a group (R1-37), one word a letter, every word used, every code complete, values in range.

use super::block::{Block, Word};
use super::modal::{Modal, Motion};
use super::word::{self, Action, Control, GROUPS, Group};
use takt_base::{Code, Diag, Span};

/// The words of a block, sorted.
pub struct Request {
    /// The whole block.
    pub span: Span,
    codes: [Option<(Action, Span)>; GROUPS],
    letters: [Option<Word>; 26],
    /// The motion that this block makes: its own code, or the one in force.
    pub motion: Option<Motion>,
}

/// Axis letters in the order of a position.
pub const AXES: [char; 6] = ['X', 'Y', 'Z', 'A', 'B', 'C'];
/// Letters that tell where the centre of an arc is.
pub const CENTRE: [char; 4] = ['I', 'J', 'K', 'R'];

impl Request {
    /// Sorts the words of `block`; what is wrong goes to `out`, and the rest is kept. With an unknown code there is no motion, and
    /// no word counts as unused: nobody knows what it would have been for.
    pub fn new(block: &Block, modal: &Modal, out: &mut Vec<Diag>) -> Self {
        let mut request = Request { span: block.span, codes: [None; GROUPS], letters: [None; 26], motion: None };
        for word in &block.words {
            match word.letter {
                'G' | 'M' => request.add_code(word, out),
                _ => request.add_letter(word, out),
            }
        }
        let known = block.words.iter().all(|w| !matches!(w.letter, 'G' | 'M') || w.action().is_some());
        request.motion = request.find_motion(modal).filter(|_| known);
        let before = out.len();
        request.check_values(out);
        if known && out.len() == before {
            request.check_used(block, out);
        }
        request
    }

    /// The code of a group, if the block has one.
    pub fn code(&self, group: Group) -> Option<Action> {
        self.codes[group as usize].map(|(action, _)| action)
    }

    /// The word with this letter, if the block has one.
    pub fn word(&self, letter: char) -> Option<Word> {
        self.letters[slot(letter)?]
    }

    /// Its value.
    pub fn value(&self, letter: char) -> Option<f64> {
        self.word(letter).map(|w| w.value)
    }

    /// Where the motion stands: its code, or else the first word that it uses.
    pub fn motion_span(&self) -> Span {
        let code = self.codes[Group::Motion as usize].map(|(_, span)| span);
        let word = || AXES.iter().chain(&CENTRE).find_map(|&l| self.word(l)).map(|w| w.span);
        code.or_else(word).unwrap_or(self.span)
    }

    /// From the first to the last of these words.
    pub fn span_of(&self, letters: &[char]) -> Span {
        let spans = letters.iter().filter_map(|&l| self.word(l)).map(|w| w.span);
        spans.reduce(|a, b| a.to(b)).unwrap_or_else(|| self.motion_span())
    }

    fn add_code(&mut self, word: &Word, out: &mut Vec<Diag>) {
        let Some(action) = word.action() else { return out.push(unknown(word)) };
        let place = &mut self.codes[action.group() as usize];
        match *place {
            Some((_, first)) => out.push(conflict(action.group(), word.span, first)),
            None => *place = Some((action, word.span)),
        }
    }

    fn add_letter(&mut self, word: &Word, out: &mut Vec<Diag>) {
        let Some(place) = slot(word.letter).map(|i| &mut self.letters[i]) else { return };
        match *place {
            Some(first) => out.push(
                Diag::new(Code::DuplicateWord, word.span, format!("a second {} word", word.letter))
                    .also(first.span, "the first one stands here")
                    .help("keep one of them, or write two blocks"),
            ),
            None => *place = Some(*word),
        }
    }

    fn find_motion(&self, modal: &Modal) -> Option<Motion> {
        if let Some(Action::Motion(motion)) = self.code(Group::Motion) {
            return motion;
        }
        let axes = AXES.iter().any(|&l| self.word(l).is_some());
        let centre = CENTRE.iter().any(|&l| self.word(l).is_some());
        modal.motion.filter(|m| axes || (centre && m.is_arc()))
    }

    fn check_values(&self, out: &mut Vec<Diag>) {
        for letter in ['F', 'S'] {
            if let Some(word) = self.word(letter).filter(|w| w.value < 0.0) {
                out.push(bad_value(word, "less than zero", "write zero or more"));
            }
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
            let at = self.codes[Group::NonModal as usize].map_or(self.span, |(_, span)| span);
            out.push(missing(at, "P").help("write the time in seconds, such as G4 P0.5"));
        }
    }

    fn check_used(&self, block: &Block, out: &mut Vec<Diag>) {
        let codes: Vec<Action> = self.codes.iter().flatten().map(|&(action, _)| action).collect();
        let modal = (self.code(Group::Motion).is_none()).then_some(Action::Motion(self.motion));
        let readers = |letter| codes.iter().chain(&modal).filter(move |a| a.operands().contains(letter)).count();
        for word in block.words.iter().filter(|w| !matches!(w.letter, 'G' | 'M' | 'F' | 'S' | 'T')) {
            match readers(word.letter) {
                0 => out.push(unused(word)),
                1 => {}
                _ => out.push(claimed_twice(word)),
            }
        }
    }

    /// Tolerance of G64 in length units; 0 if none is given.
    pub fn tolerance(&self, control: Control) -> f64 {
        if control == Control::Continuous { self.value('P').unwrap_or(0.0) } else { 0.0 }
    }
}

fn slot(letter: char) -> Option<usize> {
    (letter as usize).checked_sub('A' as usize).filter(|&i| i < 26)
}

fn unknown(word: &Word) -> Diag {
    let label = format!("{}{} means nothing here", word.letter, word.value);
    let help = match word.letter {
        'G' => word.tenths().map_or("G codes have at most one decimal", word::instead_of_g),
        _ if matches!(word.whole(), Some(98 | 99)) => "subprograms are not part of this version: repeat the blocks",
        _ => "M codes are whole numbers from 0 to 199",
    };
    Diag::new(Code::UnknownCode, word.span, label).help(help)
}

fn conflict(group: Group, at: Span, first: Span) -> Diag {
    Diag::new(Code::ModalConflict, at, format!("a second code of the group: {}", group.name()))
        .also(first, "the first one stands here")
        .help("keep one of them, or write two blocks")
}

fn claimed_twice(word: &Word) -> Diag {
    Diag::new(Code::ModalConflict, word.span, format!("{} would belong to several codes", word.letter))
        .message("two codes of the block read the same word")
        .help("write two blocks")
}

fn unused(word: &Word) -> Diag {
    let help = match word.letter {
        'X' | 'Y' | 'Z' | 'A' | 'B' | 'C' => "write the motion: G0, G1, G2 or G3",
        'I' | 'J' | 'K' | 'R' => "only G2 and G3 have a centre or a radius",
        'U' | 'V' | 'W' => "the axes are X Y Z A B C",
        'P' | 'Q' => "P belongs to G2, G3, G4, G64 and user M codes, Q to user M codes",
        _ => "remove the word",
    };
    Diag::new(Code::UnusedWord, word.span, format!("nothing reads {}", word.letter)).help(help)
}

/// A value that its word can't have.
pub fn bad_value(word: Word, label: &str, help: &str) -> Diag {
    Diag::new(Code::BadValue, word.span, label).help(help)
}

/// A word that a code needs.
pub fn missing(at: Span, letter: &str) -> Diag {
    Diag::new(Code::MissingWord, at, format!("needs {letter}"))
}
