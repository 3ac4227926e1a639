//! G65, G66, G67, M98, M99 and codes with a macro behind them; arguments to variables.

use super::block::{Block, Word};
use super::flow::{Call, Left};
use super::kernel::Io;
use super::settings::{MacroCall, UserCode};
use super::vars::{LOCALS, Locals};
use super::{Machine, Went};
use crate::ngc::request::missing;
use takt_base::{Code, Diag, Span};

/// Runs that one call may ask for.
const TIMES_MAX: u32 = 99_999_999;

/// G66 in force.
#[derive(Clone, Debug)]
pub struct ModalMacro {
    program: u32,
    times: u32,
    arguments: Box<Locals>,
}

type Result<T> = std::result::Result<T, Box<Diag>>;

/// Variables by argument letters. I, J and K count on: a letter that comes again, or before one of its set, starts the next set
/// (argument specification II); else each letter has its variable (specification I). The later of two words for one variable counts.
pub fn arguments(words: &[Word]) -> Locals {
    let mut locals = [None; LOCALS];
    let (mut set, mut last) = (0, 0);
    for word in words {
        let n = match word.letter {
            letter @ b'I'..=b'K' => {
                let place = letter - b'I' + 1;
                if last >= place {
                    set += 1;
                }
                last = place;
                3 + 3 * set + usize::from(place)
            }
            b'A'..=b'C' => usize::from(word.letter - b'A' + 1),
            b'D'..=b'F' => usize::from(word.letter - b'D' + 7),
            b'H' => 11,
            b'M' => 13,
            b'Q'..=b'Z' => usize::from(word.letter - b'Q' + 17),
            _ => continue,
        };
        if n <= LOCALS {
            locals[n - 1] = Some(word.value);
        }
    }
    locals
}

impl Machine {
    /// G65, G66, G67 and codes with a macro behind them. `None` if the block calls nothing and goes on.
    pub(super) fn macro_codes(&mut self, b: &Block, io: &mut Io) -> Option<Result<Went>> {
        use super::table::Meaning;
        if let Some(code) = b.code(|m| m == Meaning::Macro) {
            return Some(self.call_macro(b, code.span, io));
        }
        if let Some(code) = b.code(|m| m == Meaning::ModalMacro) {
            return Some(self.start_modal(b, code.span));
        }
        let &(user, span) = b.calls.first()?;
        Some(self.user_code(b, user, span, io))
    }

    /// G67.
    pub(super) fn modal_macro_off(&mut self) {
        self.modal_macro = None;
        self.modes.codes[12] = 670;
    }

    /// P and L of a call, and its arguments: the words behind them.
    fn macro_words(&self, b: &Block, at: Span) -> Result<(u32, u32, Box<Locals>)> {
        let Some(p) = b.words.iter().find(|w| w.letter == b'P') else {
            return Err(Box::new(missing(at, "P").help("write the number of the macro, such as G65 P9010")));
        };
        let program = p.whole().ok_or_else(|| bad(*p, "not the number of a program", "write a whole number"))?;
        let times = match b.words.iter().find(|w| w.letter == b'L') {
            None => 1,
            Some(l) => {
                l.whole().filter(|&n| n <= TIMES_MAX).ok_or_else(|| bad(*l, "not a number of times", "write a whole number"))?
            }
        };
        let mut words: Vec<Word> = b.words.iter().copied().filter(|w| !matches!(w.letter, b'L' | b'P' | b'O' | b'N')).collect();
        // M words are arguments here.
        words.extend(b.m.iter().map(|&(m, span)| Word { letter: b'M', value: f64::from(m), exact: true, span }));
        if let Some(word) = words.iter().find(|w| w.letter.is_ascii_lowercase()) {
            return Err(bad(*word, "no argument of a macro", "arguments are letters without a comma"));
        }
        Ok((program, times, Box::new(arguments(&words))))
    }

    fn call_macro(&mut self, b: &Block, at: Span, io: &mut Io) -> Result<Went> {
        let (program, times, arguments) = self.macro_words(b, at)?;
        self.enter(program, times, Some(arguments), false, at, io)?;
        Ok(Went::On)
    }

    fn start_modal(&mut self, b: &Block, at: Span) -> Result<Went> {
        let (program, times, arguments) = self.macro_words(b, at)?;
        self.modal_macro = Some(ModalMacro { program, times, arguments });
        self.modes.codes[12] = 660;
        Ok(Went::On)
    }

    fn user_code(&mut self, b: &Block, user: UserCode, at: Span, io: &mut Io) -> Result<Went> {
        if let Some(&(_, beside)) = b.m.first().filter(|_| user.letter == 'T' || user.call == MacroCall::Subprogram) {
            let diag = Diag::new(Code::BadMacro, beside, "an M code beside a code with a macro");
            return Err(Box::new(diag.also(at, "this code calls it").help("write two blocks")));
        }
        let mut words: Vec<Word> = b.words.iter().copied().filter(|w| w.letter != b'L').collect();
        words.extend(b.m.iter().map(|&(m, span)| Word { letter: b'M', value: f64::from(m), exact: true, span }));
        let times = b.words.iter().find(|w| w.letter == b'L').and_then(Word::whole).unwrap_or(1).min(TIMES_MAX);
        let arguments = Box::new(arguments(&words));
        match (user.call, user.letter) {
            // T calls its macro as M98 does; the number stands in #149.
            (_, 'T') => {
                let tool = b.words.iter().find(|w| w.letter == b'T').map(|w| w.value);
                self.vars.set(149, tool);
                self.enter(user.program, 1, None, false, at, io)?;
            }
            (MacroCall::Subprogram, _) => self.enter(user.program, times, None, false, at, io)?,
            (MacroCall::Arguments, _) => self.enter(user.program, times, Some(arguments), false, at, io)?,
            (MacroCall::Modal, _) => self.modal_macro = Some(ModalMacro { program: user.program, times, arguments }),
        }
        Ok(Went::On)
    }

    /// The macro of G66, behind a block that moved; not inside of itself.
    pub(super) fn modal_call(&mut self, at: Span, io: &Io) -> Result<()> {
        if self.flow.frame().is_some_and(|f| f.modal) || self.recording.is_some() {
            return Ok(());
        }
        let Some(ModalMacro { program, times, arguments }) = self.modal_macro.clone() else { return Ok(()) };
        self.enter(program, times, Some(arguments), true, at, io)
    }

    fn enter(&mut self, number: u32, times: u32, arguments: Option<Box<Locals>>, modal: bool, at: Span, io: &Io) -> Result<()> {
        if times == 0 {
            return Ok(());
        }
        let locals = arguments.clone();
        let call = Call { number, times, arguments, modal, place: (at.start, at.end) };
        let source = self.flow.source();
        let options = &io.state.options;
        self.flow.call(call, &options.host, options.calls_max).map_err(|fault| Box::new(fault.diag(source)))?;
        if let Some(locals) = locals {
            self.vars.locals.push(*locals);
        }
        self.fresh = true;
        Ok(())
    }

    /// `M98 P1234 L3`, `M98 P31234`.
    pub(super) fn subprogram(&mut self, b: &Block, at: Span, io: &Io) -> Result<()> {
        let Some(p) = b.take(b'P') else {
            return Err(Box::new(missing(at, "P").help("write the number of the subprogram, such as M98 P1234")));
        };
        let whole = p.whole().ok_or_else(|| bad(p, "not the number of a program", "write a whole number"))?;
        let (number, times) = match b.take(b'L') {
            Some(l) => (
                whole,
                l.whole().filter(|&n| n <= TIMES_MAX).ok_or_else(|| bad(l, "not a number of times", "write a whole number"))?,
            ),
            None if whole > 9999 => (whole % 10_000, whole / 10_000),
            None => (whole, 1),
        };
        self.enter(number, times, None, false, at, io)
    }

    /// M99, and M99 P in the caller or the main program.
    pub(super) fn back(&mut self, b: &Block, at: Span) -> Result<Went> {
        let n = match b.take(b'P') {
            None => None,
            Some(p) => Some(p.whole().ok_or_else(|| bad(p, "not the number of a block", "write an N number of the caller"))?),
        };
        let source = self.flow.source();
        let place = (at.start, at.end);
        let left = self.flow.leave(n, place).map_err(|fault| Box::new(fault.diag(source)));
        // A macro that is left takes its variables with it, also if the block that it names is missing.
        match left {
            Ok(None) => match n {
                None => return Ok(Went::Again),
                Some(n) => self.flow.goto(n, place).map_err(|fault| Box::new(fault.diag(source)))?,
            },
            Ok(Some(Left::Again(arguments))) => {
                self.fresh = true;
                if let (Some(arguments), Some(locals)) = (arguments, self.vars.locals.last_mut()) {
                    *locals = *arguments;
                }
            }
            Ok(Some(Left::Back(owned))) => self.drop_locals(owned),
            Err(diag) => {
                let depth = self.flow.macros();
                self.vars.locals.truncate(depth + 1);
                return Err(diag);
            }
        }
        Ok(Went::On)
    }

    fn drop_locals(&mut self, owned: bool) {
        if owned && self.vars.locals.len() > 1 {
            self.vars.locals.pop();
        }
    }
}

/// A value that its word can't have.
pub(super) fn bad(word: Word, label: &str, help: &str) -> Box<Diag> {
    Box::new(Diag::new(Code::BadValue, word.span, label).help(help))
}
