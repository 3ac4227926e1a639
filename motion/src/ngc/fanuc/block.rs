//! The words of a block with their values: codes in their order, letters, which of them were used.

use super::reader::Row;
use super::table::{self, Meaning};
use super::vars::View;
use super::{expr, settings};
use crate::ngc::fault::Fault;
use crate::ngc::word;
use std::cell::Cell;
use takt_base::{Code, Diag, SourceId, Span};

/// A word that has a value.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Word {
    /// Upper case; `c`, `r` and `a` stand for `,C`, `,R` and `,A`.
    pub letter: u8,
    /// As written.
    pub value: f64,
    /// Never counts increments.
    pub exact: bool,
    /// Where it stands.
    pub span: Span,
}

impl Word {
    /// The value, if it is whole and not negative.
    pub fn whole(&self) -> Option<u32> {
        word::whole(self.value)
    }
}

/// A G code.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct GCode {
    /// Its number in tenths.
    pub tenths: u32,
    /// What it asks for.
    pub meaning: Meaning,
    /// Its modal group.
    pub group: usize,
    /// Where it stands.
    pub span: Span,
}

/// A block.
#[derive(Clone, Debug)]
pub struct Block {
    /// All of it.
    pub span: Span,
    /// G codes of the tables.
    pub codes: Vec<GCode>,
    /// M codes.
    pub m: Vec<(u32, Span)>,
    /// Other words in their order.
    pub words: Vec<Word>,
    /// G codes with a macro behind them, and M and T codes.
    pub calls: Vec<(settings::UserCode, Span)>,
    has: u64,
    used: Cell<u64>,
}

const fn bit(letter: u8) -> u64 {
    match letter {
        b'A'..=b'Z' => 1 << (letter - b'A'),
        _ => 1 << (letter - b'a' + 26),
    }
}

impl Default for Block {
    fn default() -> Self {
        let span = Span { source: SourceId(0), start: 0, end: 0 };
        let used = Cell::new(0);
        Block { span, codes: Vec::new(), m: Vec::new(), words: Vec::new(), calls: Vec::new(), has: 0, used }
    }
}

impl Block {
    /// Computes the words of `row`; what is wrong goes to `out`.
    pub fn fill(&mut self, row: &Row, source: SourceId, view: &View, stack: &mut expr::Stack, out: &mut Vec<Diag>) {
        self.span = Span { source, start: row.place.0, end: row.place.1 };
        self.codes.clear();
        self.m.clear();
        self.words.clear();
        self.calls.clear();
        (self.has, self.used) = (0, Cell::new(0));
        for word in &row.words {
            let span = Span { source, start: word.place.0, end: word.place.1 };
            match expr::eval(word.value, &row.ops, view, stack) {
                // A vacant variable takes its address with it.
                Ok(None) => {}
                Ok(Some(value)) if value.abs() <= crate::ngc::number::MAX => {
                    self.add(Word { letter: word.letter, value, exact: word.exact, span }, view, out);
                }
                Ok(Some(_)) => out.push(Diag::new(Code::BadValue, span, "above 1000000000000").help("check the expression")),
                Err(fault) => out.push(Fault::diag(fault, source)),
            }
        }
    }

    fn add(&mut self, word: Word, view: &View, out: &mut Vec<Diag>) {
        match word.letter {
            b'G' => self.add_g(word, view, out),
            b'M' => self.add_m(word, view, out),
            _ => {
                let user = if word.letter == b'T' { view.modes.settings.code('T', 0) } else { None };
                if let Some(user) = user {
                    self.calls.push((user, word.span));
                }
                self.has |= bit(word.letter);
                self.words.push(word);
            }
        }
    }

    fn add_g(&mut self, word: Word, view: &View, out: &mut Vec<Diag>) {
        let tenths = word::whole(word.value * 10.0);
        if let Some(user) = tenths.and_then(|t| view.modes.settings.code('G', t)) {
            return self.calls.push((user, word.span));
        }
        let dialect = view.modes.dialect;
        match tenths.and_then(|tenths| Some((tenths, table::find(dialect, tenths)?))) {
            Some((tenths, (meaning, group))) => self.codes.push(GCode { tenths, meaning, group, span: word.span }),
            None => {
                let help = tenths.map_or("G codes have at most one decimal", |t| table::instead(dialect, t));
                out.push(Diag::new(Code::UnknownCode, word.span, format!("no code G{} of this machine", word.value)).help(help));
            }
        }
    }

    fn add_m(&mut self, word: Word, view: &View, out: &mut Vec<Diag>) {
        match word.whole().filter(|&m| m < 100_000) {
            Some(m) => match view.modes.settings.code('M', m) {
                Some(user) => self.calls.push((user, word.span)),
                None => self.m.push((m, word.span)),
            },
            None => out.push(Diag::new(Code::UnknownCode, word.span, "no M code").help("M codes are whole numbers")),
        }
    }

    /// Two codes of one group. Codes of group 0 act in the block alone, and one of them.
    pub fn check_codes(&self, out: &mut Vec<Diag>) {
        let mut groups: [Option<&GCode>; table::GROUPS] = [None; table::GROUPS];
        for code in self.codes.iter().filter(|c| !quiet(c)) {
            let first = *groups[code.group].get_or_insert(code);
            if first.span != code.span {
                out.push(
                    Diag::new(
                        Code::ModalConflict,
                        code.span,
                        format!("a second code of the group: {}", table::NAMES[code.group]),
                    )
                    .also(first.span, "the first one stands here")
                    .help("keep one of them, or write two blocks"),
                );
            }
        }
    }

    /// Two words of one letter.
    pub fn check_words(&self, out: &mut Vec<Diag>) {
        let mut letters: [Option<&Word>; 64] = [None; 64];
        for word in &self.words {
            let first = *letters[bit(word.letter).trailing_zeros() as usize % 64].get_or_insert(word);
            if first.span != word.span {
                out.push(
                    Diag::new(Code::DuplicateWord, word.span, format!("a second {} word", name(word.letter)))
                        .also(first.span, "the first one stands here")
                        .help("keep one of them, or write two blocks"),
                );
            }
        }
    }

    /// The codes beside a macro call, whose words are its arguments.
    pub fn beside_call(&self) -> Self {
        let call = |c: &GCode| matches!(c.meaning, Meaning::Macro | Meaning::ModalMacro | Meaning::MacroOff);
        let codes = self.codes.iter().copied().filter(|c| !call(c)).collect();
        Block { span: self.span, codes, ..Block::default() }
    }

    /// The code with a meaning that `fits`.
    pub fn code(&self, fits: impl Fn(Meaning) -> bool) -> Option<GCode> {
        self.codes.iter().copied().find(|c| fits(c.meaning))
    }

    /// The code of a group.
    pub fn of_group(&self, group: usize) -> Option<GCode> {
        self.codes.iter().copied().find(|c| c.group == group && !quiet(c))
    }

    /// The word with this letter; it then counts as used.
    pub fn take(&self, letter: u8) -> Option<Word> {
        if self.has & bit(letter) == 0 {
            return None;
        }
        self.used.set(self.used.get() | bit(letter));
        self.words.iter().copied().find(|w| w.letter == letter)
    }

    /// Its value.
    pub fn value(&self, letter: u8) -> Option<f64> {
        self.take(letter).map(|w| w.value)
    }

    /// True if one of these letters is there; none counts as used.
    pub fn any(&self, letters: &str) -> bool {
        letters.bytes().any(|l| self.has & bit(l) != 0)
    }

    /// These words count as used.
    pub fn use_all(&self, letters: &str) {
        letters.bytes().for_each(|l| self.used.set(self.used.get() | bit(l)));
    }

    /// Words that nothing has used.
    pub fn unused(&self) -> impl Iterator<Item = Word> {
        let used = self.used.get();
        self.words.iter().copied().filter(move |w| used & bit(w.letter) == 0)
    }

    /// Nothing in it.
    pub fn is_empty(&self) -> bool {
        self.codes.is_empty() && self.m.is_empty() && self.words.is_empty() && self.calls.is_empty()
    }
}

fn quiet(code: &GCode) -> bool {
    matches!(code.meaning, Meaning::Nothing(_))
}

/// A letter as written.
pub fn name(letter: u8) -> String {
    match letter {
        b'a'..=b'z' => format!(",{}", char::from(letter.to_ascii_uppercase())),
        _ => char::from(letter).to_string(),
    }
}
