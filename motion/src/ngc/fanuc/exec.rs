//! One block, in this order: macro calls, feed and speed, tool, M codes, plane and units, compensation, coordinates, distance,
//! transformations, one-shot codes, motion, stops and ends.

use super::block::{Block, GCode};
use super::calls::bad;
use super::kernel::Io;
use super::table::{Meaning, NAMES};
use super::{Machine, Went};
use crate::canon::{Canon, Plane, ProgramEnd};
use crate::ngc::execute::Done;
use crate::ngc::request::not_now;
use takt_base::{Code, Diag};

impl Machine {
    /// Executes a block whose words have values.
    pub(super) fn block(&mut self, b: &Block, io: &mut Io) -> Went {
        if self.recording.is_some() {
            let done = self.record(b, io);
            self.done(done, io);
            return Went::On;
        }
        if self.corner.is_some() && !self.goes_on_in_plane(b) {
            self.end_corner(io);
        }
        b.check_codes(io.out.diags);
        self.refuse(b, io);
        if io.failed() {
            return Went::On;
        }
        if let Some(went) = self.calls(b, io) {
            return went;
        }
        b.check_words(io.out.diags);
        if io.failed() {
            return Went::On;
        }
        self.remember(b);
        self.modal_parts(b, io);
        for part in [Self::one_shot, Self::motion] {
            let done = part(self, b, io);
            self.done(done, io);
        }
        self.end_exact(b, io);
        let went = self.stops(b, io);
        self.unused(b, io);
        went
    }

    /// A macro call: the codes beside it count before it.
    fn calls(&mut self, b: &Block, io: &mut Io) -> Option<Went> {
        if b.calls.is_empty() && b.code(|m| matches!(m, Meaning::Macro | Meaning::ModalMacro)).is_none() {
            if b.code(|m| m == Meaning::MacroOff).is_some() {
                self.modal_macro_off();
            }
            return None;
        }
        let beside = b.beside_call();
        self.remember(&beside);
        self.modal_parts(&beside, io);
        if io.failed() {
            return Some(Went::On);
        }
        match self.macro_codes(b, io)? {
            Ok(went) => Some(went),
            Err(diag) => {
                io.wrong(*diag);
                Some(Went::On)
            }
        }
    }

    /// Everything of a block but motion, one-shot codes and ends.
    fn modal_parts(&mut self, b: &Block, io: &mut Io) {
        let parts: [fn(&mut Self, &Block, &mut Io) -> Done; 8] = [
            Self::feed_and_speed,
            Self::tool,
            Self::auxiliary,
            Self::plane_and_units,
            Self::compensation,
            Self::systems,
            Self::shapes,
            Self::path_mode,
        ];
        for part in parts {
            let done = part(self, b, io);
            self.done(done, io);
        }
    }

    /// A block that may follow a corner: a move at feed and nothing beside it.
    fn goes_on_in_plane(&self, b: &Block) -> bool {
        let moves = |c: &GCode| matches!(c.meaning, Meaning::Line | Meaning::Arc(_) | Meaning::Incremental(_));
        b.m.is_empty() && b.calls.is_empty() && !b.any("ST") && b.codes.iter().all(moves) && (self.names_axis(b) || b.any("IJKR"))
    }

    /// Reports a mistake.
    pub(super) fn done(&mut self, done: Done, io: &mut Io) {
        if let Err(diag) = done {
            if diag.code == Code::NoFeed {
                io.state.modal.feed = Some(1.0);
            }
            io.wrong(*diag);
        }
    }

    /// Codes that are known and not done here.
    fn refuse(&self, b: &Block, io: &mut Io) {
        for code in &b.codes {
            if let Meaning::Refused(help) = code.meaning {
                let label = format!("G{} is not done here", f64::from(code.tenths) / 10.0);
                io.wrong(Diag::new(Code::NotOfThisControl, code.span, label).help(help));
            }
        }
        for &(m, span) in &b.m {
            if m == 198 {
                let help = "put the program into the folder of the main one, and call it with M98";
                io.wrong(Diag::new(Code::NotOfThisControl, span, "calls from another memory").help(help));
            }
        }
        if let Some(word) = b.words.iter().find(|w| w.letter == b'a') {
            let help = "write the end point of the line: X and Z";
            io.wrong(Diag::new(Code::NotOfThisControl, word.span, "lines by their angle").help(help));
        }
    }

    /// Modal codes and the last words, for system variables.
    fn remember(&mut self, b: &Block) {
        for code in &b.codes {
            if code.group > 0 && !matches!(code.meaning, Meaning::Nothing(_)) {
                self.modes.codes[code.group] = code.tenths;
            }
        }
        if let Some(&(m, _)) = b.m.last() {
            self.modes.last[usize::from(b'M' - b'A')] = f64::from(m);
        }
        for word in b.words.iter().filter(|w| matches!(w.letter, b'B' | b'E' | b'T')) {
            self.modes.last[usize::from(word.letter - b'A')] = word.value;
        }
    }

    fn plane_and_units(&mut self, b: &Block, io: &mut Io) -> Done {
        use crate::canon::Units;
        use crate::ngc::word::Action;
        for code in &b.codes {
            match code.meaning {
                Meaning::Plane(plane) if plane != io.state.modal.plane => {
                    self.check_settled(code, io)?;
                    self.modes.pole = None;
                    io.obey(&[Action::Plane(plane)], &[], code.span);
                }
                Meaning::Inches(on) => {
                    self.check_settled(code, io)?;
                    let units = if on { Units::Inches } else { Units::Mm };
                    let before = io.state.unit();
                    io.obey(&[Action::Units(units)], &[], code.span);
                    let ratio = before / io.state.unit();
                    self.modes.transform.change_units(ratio);
                    if ratio != 1.0 {
                        (self.modes.drill, self.modes.pole) = (None, None);
                        self.modes.pass.forget();
                    }
                    self.sync(io);
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// A code that can't come between a corner and the move behind it, or under polar and cylindrical interpolation.
    pub(super) fn check_settled(&mut self, code: &GCode, io: &mut Io) -> Done {
        self.end_corner(io);
        if self.modes.virtual_axis.is_some() {
            let label = format!("another code of the group: {}", NAMES[code.group]);
            return Err(Box::new(not_now(code.span, label, "end polar interpolation with G13.1, cylindrical with G7.1 C0")));
        }
        Ok(())
    }

    fn path_mode(&mut self, b: &Block, io: &mut Io) -> Done {
        use super::table::PathMode;
        use crate::ngc::word::{Action, Control};
        for code in &b.codes {
            let Meaning::Path(mode) = code.meaning else { continue };
            let control = if mode == PathMode::ExactStop { Control::ExactStop } else { Control::Continuous };
            io.obey(&[Action::Control(control)], &[], code.span);
            let tapping = mode == PathMode::Tapping;
            if tapping == io.state.modal.overrides {
                io.state.modal.overrides = !tapping;
                io.emit(if tapping { Canon::DisableFeedOverride } else { Canon::EnableFeedOverride });
            }
        }
        if b.code(|m| m == Meaning::ExactBlock).is_some() {
            io.emit(Canon::SetMotionControlMode(crate::canon::MotionMode::ExactStop));
        }
        Ok(())
    }

    fn end_exact(&mut self, b: &Block, io: &mut Io) {
        if b.code(|m| m == Meaning::ExactBlock).is_some() {
            let mode = io.state.modal.control;
            io.emit(Canon::SetMotionControlMode(mode));
        }
    }

    /// M0, M1, M2, M30, M98, M99.
    fn stops(&mut self, b: &Block, io: &mut Io) -> Went {
        let mut went = Went::On;
        for &(m, span) in &b.m {
            match m {
                0 => io.emit(Canon::ProgramStop),
                1 => io.emit(Canon::OptionalProgramStop),
                2 => went = self.finish(ProgramEnd::M2, io, span),
                30 => went = self.finish(ProgramEnd::M30, io, span),
                98 => {
                    let done = self.subprogram(b, span, io);
                    self.done(done, io);
                }
                99 => match self.back(b, span) {
                    Ok(w) => went = w,
                    Err(diag) => io.wrong(*diag),
                },
                _ => {}
            }
        }
        went
    }

    fn unused(&mut self, b: &Block, io: &mut Io) {
        if io.failed() {
            return;
        }
        let lenient = io.state.options.language.lenient;
        for word in b.unused() {
            let name = super::block::name(word.letter);
            let diag =
                Diag::new(if lenient { Code::LeftOut } else { Code::UnusedWord }, word.span, format!("nothing reads {name}"));
            let help = match word.letter {
                b'U' | b'V' | b'W' => "increments by U, V and W belong to turning; milling writes G91",
                b'c' | b'r' => "a chamfer or corner stands in a block of G1, G2 or G3",
                b'L' | b'K' => "repeats belong to M98, G65 and drilling cycles",
                _ => "remove the word, or write the code that it belongs to",
            };
            io.wrong(diag.help(help));
        }
    }

    /// The plane in force, for moves that need one.
    pub(super) fn plane(io: &Io) -> Plane {
        io.state.modal.plane
    }

    /// The whole number of a word.
    pub(super) fn whole_word(b: &Block, letter: u8, help: &str) -> Result<Option<u32>, Box<Diag>> {
        match b.take(letter) {
            None => Ok(None),
            Some(word) => word.whole().map(Some).ok_or_else(|| bad(word, "no whole number", help)),
        }
    }
}
