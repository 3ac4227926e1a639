//! What each O word does (LinuxCNC "O Codes"), and the calls of M98 and M99.

use super::files::Spot;
use super::{Flow, Frame, Key, Open, misfit};
use crate::ngc::expr::Slice;
use crate::ngc::expr::run::{self, Stack};
use crate::ngc::fault::Fault;
use crate::ngc::lines::Place;
use crate::ngc::oword::{Keyword, Label, OWord};
use crate::ngc::state::{SavedModes, State};
use crate::ngc::word::whole;
use takt_base::Code;

/// What the interpreter has to do behind an O word.
#[derive(Debug)]
pub enum After {
    /// Nothing.
    Next,
    /// A subroutine has ended; the modes that it saved.
    Returned(Option<Box<SavedModes>>),
}

impl Flow {
    /// Obeys an O word.
    ///
    /// # Errors
    /// It does not fit where it stands, or its expression has no value.
    pub fn obey(&mut self, word: &OWord, state: &mut State, stack: &mut Stack) -> Result<After, Fault> {
        let key = self.key_of(word, state, stack)?;
        match word.keyword {
            Keyword::Sub => self.sub(key, word)?,
            Keyword::Call => self.call(key, word, state, stack)?,
            Keyword::Return | Keyword::EndSub => return self.end_sub(key, word, state, stack),
            Keyword::If => self.branch(key, word, state, stack)?,
            Keyword::ElseIf | Keyword::Else => self.after_branch(key, word)?,
            Keyword::EndIf => self.close_branch(key, word)?,
            Keyword::While => self.while_(key, word, state, stack)?,
            Keyword::EndWhile => self.end_while(key, word)?,
            Keyword::Do => {
                let behind = self.files.lines().place;
                self.open(key, Open::Do(behind), word.place)?;
            }
            Keyword::Repeat => self.repeat(key, word, state, stack)?,
            Keyword::EndRepeat => self.end_repeat(key, word)?,
            Keyword::Break => self.leave_loop(key, word)?,
            Keyword::Continue => self.next_turn(key, word, state, stack)?,
            Keyword::Program => {}
        }
        Ok(After::Next)
    }

    fn key_of(&self, word: &OWord, state: &State, stack: &mut Stack) -> Result<Key, Fault> {
        let Label::Computed(value) = word.label else {
            return self.key(word.label).ok_or_else(|| misfit(word.place, "no label", "write a number or a name"));
        };
        let number = run::value(value, &self.code, state, stack)?;
        whole(number)
            .map(Key::Number)
            .ok_or_else(|| misfit(word.place, "the label is not a whole number", "compute a whole number from 0"))
    }

    /// Value of the argument, if there is one.
    fn argument(&self, args: Slice, state: &State, stack: &mut Stack) -> Result<Option<f64>, Fault> {
        match self.code.args[args.range()].first() {
            Some(&value) => run::value(value, &self.code, state, stack).map(Some),
            None => Ok(None),
        }
    }

    fn holds(&self, word: &OWord, state: &State, stack: &mut Stack) -> Result<bool, Fault> {
        Ok(self.argument(word.args, state, stack)?.unwrap_or(0.0) != 0.0)
    }

    /// A definition is not executed.
    fn sub(&mut self, key: Key, word: &OWord) -> Result<(), Fault> {
        if !self.frames.is_empty() {
            return Err(misfit(word.place, "a subroutine inside of another", "end the first one with endsub"));
        }
        let spot = self.files.spot();
        self.add_sub(key, spot, word.place)?;
        self.skip_to(key, &[Keyword::EndSub], word.place).map(|_| ())
    }

    pub(super) fn add_sub(&mut self, key: Key, spot: Spot, place: (u32, u32)) -> Result<(), Fault> {
        if self.subs.len() >= super::SUBS_MAX && !self.subs.contains_key(&key) {
            let label = "a program has at most 50000 subroutines";
            return Err(Fault::at(
                Code::ProgramTooLarge,
                place.0,
                place.1,
                label,
                "call one of them with arguments in place of many",
            ));
        }
        self.subs.entry(key).or_insert(spot);
        Ok(())
    }

    fn call(&mut self, key: Key, word: &OWord, state: &mut State, stack: &mut Stack) -> Result<(), Fault> {
        let mut args = std::mem::take(&mut self.args);
        args.clear();
        for &value in &self.code.args[word.args.range()] {
            args.push(run::value(value, &self.code, state, stack)?);
        }
        let entered = self.enter(key, None, word.place, state);
        if entered.is_ok() {
            state.params.enter(&args);
        }
        self.args = args;
        entered
    }

    /// M98: the program with this number, so many times.
    ///
    /// # Errors
    /// There is none, or too many calls are in progress.
    pub fn call_program(&mut self, number: u32, times: u32, place: (u32, u32), state: &mut State) -> Result<(), Fault> {
        match times {
            0 => Ok(()),
            _ => self.enter(Key::Number(number), Some(times), place, state),
        }
    }

    fn enter(&mut self, key: Key, program: Option<u32>, place: (u32, u32), state: &mut State) -> Result<(), Fault> {
        if self.frames.len() >= state.options.calls_max {
            let label = format!("{} calls are in progress", self.frames.len());
            let help = "a subroutine that calls itself needs an end: a condition before the call";
            return Err(Fault::at(Code::NestedTooDeeply, place.0, place.1, label, help));
        }
        let start = self.find_sub(key, place, state)?;
        let back = self.files.spot();
        self.frames.push(Frame { key, back, blocks: self.blocks.len(), program, start });
        state.saved.push(None);
        self.files.go(start);
        Ok(())
    }

    /// In the texts read so far, then in the text at hand and the main one, then in a file of its name.
    fn find_sub(&mut self, key: Key, place: (u32, u32), state: &State) -> Result<Spot, Fault> {
        if let Some(&spot) = self.subs.get(&key) {
            return Ok(spot);
        }
        for file in [self.files.at, 0] {
            self.index(file)?;
        }
        if let Some(&spot) = self.subs.get(&key) {
            return Ok(spot);
        }
        let name = match key {
            Key::Number(number) => number.to_string(),
            Key::Name(id) => self.code.names.text_of(id).to_owned(),
        };
        if let Some((source, text)) = state.options.host.open_text(&name)
            && let Some(file) = self.files.add(source, text)
        {
            self.index(file)?;
        }
        self.subs.get(&key).copied().ok_or_else(|| {
            let help = format!("define it with `o<{name}> sub`, or put it into the file {name}.ngc in the folder of subroutines");
            Fault::at(Code::MissingSub, place.0, place.1, format!("no subroutine {name}"), help)
        })
    }

    /// Looks for the subroutines of a text, once.
    fn index(&mut self, file: u32) -> Result<(), Fault> {
        if !self.files.index_now(file) {
            return Ok(());
        }
        let (back, thorough) = (self.files.spot(), std::mem::replace(&mut self.thorough, false));
        self.files.go(Spot { file, place: Place::default() });
        let indexed = self.index_subs();
        self.thorough = thorough;
        self.files.go(back);
        indexed
    }

    fn end_sub(&mut self, key: Key, word: &OWord, state: &mut State, stack: &mut Stack) -> Result<After, Fault> {
        let Some(frame) = self.frames.last().copied() else {
            let text = if word.keyword == Keyword::Return { "a return" } else { "an endsub" };
            return Err(misfit(word.place, &format!("{text} outside of a subroutine"), "it stands between sub and endsub"));
        };
        // A return may carry any label: there is but one subroutine that it can leave.
        if frame.key != key && word.keyword == Keyword::EndSub {
            return Err(misfit(
                word.place,
                "another subroutine is being executed",
                "write the number or name of this subroutine",
            ));
        }
        state.params.returned = self.argument(word.args, state, stack)?;
        Ok(self.leave(state).unwrap_or(After::Next))
    }

    /// M99, or the end of a subroutine: back to the caller, or the next turn of M98. `None` in the main program.
    pub fn leave(&mut self, state: &mut State) -> Option<After> {
        let frame = self.frames.last_mut()?;
        self.blocks.truncate(frame.blocks);
        if let Some(left) = &mut frame.program
            && *left > 1
        {
            *left -= 1;
            let start = frame.start;
            self.files.go(start);
            return Some(After::Next);
        }
        let frame = *frame;
        self.frames.pop();
        if frame.program.is_none() {
            state.params.leave();
        }
        self.files.go(frame.back);
        Some(After::Returned(state.saved.pop().flatten()))
    }

    /// Leaves all calls at once, behind the outermost one.
    pub fn unwind(&mut self, state: &mut State) {
        let Some(outermost) = self.frames.first().copied() else { return };
        while let Some(frame) = self.frames.pop() {
            if frame.program.is_none() {
                state.params.leave();
            }
            state.saved.pop();
        }
        self.blocks.truncate(outermost.blocks);
        self.files.go(outermost.back);
    }

    fn branch(&mut self, key: Key, word: &OWord, state: &mut State, stack: &mut Stack) -> Result<(), Fault> {
        if self.holds(word, state, stack)? {
            return self.open(key, Open::If, word.place);
        }
        let branches = [Keyword::ElseIf, Keyword::Else, Keyword::EndIf];
        loop {
            let next = self.skip_to(key, &branches, word.place)?;
            match next.keyword {
                Keyword::EndIf => return Ok(()),
                Keyword::Else => return self.open(key, Open::If, word.place),
                _ if self.holds(&next, state, stack)? => return self.open(key, Open::If, word.place),
                _ => {}
            }
        }
    }

    /// The branch before this one was executed.
    fn after_branch(&mut self, key: Key, word: &OWord) -> Result<(), Fault> {
        self.close_branch(key, word)?;
        self.skip_to(key, &[Keyword::EndIf], word.place).map(|_| ())
    }

    fn close_branch(&mut self, key: Key, word: &OWord) -> Result<(), Fault> {
        match self.top() {
            Some((top, Open::If)) if top == key => {
                self.blocks.pop();
                Ok(())
            }
            _ => Err(no_start(word)),
        }
    }

    fn while_(&mut self, key: Key, word: &OWord, state: &State, stack: &mut Stack) -> Result<(), Fault> {
        let holds = self.holds(word, state, stack)?;
        match self.top() {
            Some((top, Open::Do(behind))) if top == key => {
                if holds {
                    self.files.lines().place = behind;
                } else {
                    self.blocks.pop();
                }
                return Ok(());
            }
            Some((top, Open::While(_))) if top == key => {}
            _ => {
                let here = self.here;
                self.open(key, Open::While(here), word.place)?;
            }
        }
        if !holds {
            self.skip_to(key, &[Keyword::EndWhile], word.place)?;
            self.blocks.pop();
        }
        Ok(())
    }

    fn end_while(&mut self, key: Key, word: &OWord) -> Result<(), Fault> {
        match self.top() {
            Some((top, Open::While(start))) if top == key => {
                self.files.lines().place = start;
                Ok(())
            }
            _ => Err(no_start(word)),
        }
    }

    fn repeat(&mut self, key: Key, word: &OWord, state: &State, stack: &mut Stack) -> Result<(), Fault> {
        let times = self.argument(word.args, state, stack)?.unwrap_or(0.0).round();
        if times < 1.0 {
            return self.skip_to(key, &[Keyword::EndRepeat], word.place).map(|_| ());
        }
        let behind = self.files.lines().place;
        self.open(key, Open::Repeat(behind, times as u64), word.place)
    }

    fn end_repeat(&mut self, key: Key, word: &OWord) -> Result<(), Fault> {
        let base = self.base();
        match self.blocks[base..].last_mut() {
            Some((top, Open::Repeat(start, left))) if *top == key => {
                if *left > 1 {
                    *left -= 1;
                    let start = *start;
                    self.files.lines().place = start;
                } else {
                    self.blocks.pop();
                }
                Ok(())
            }
            _ => Err(no_start(word)),
        }
    }

    /// The loop with this label, after the blocks inside of it are closed.
    fn find_loop(&mut self, key: Key, word: &OWord) -> Result<Open, Fault> {
        let base = self.base();
        let found = self.blocks[base..].iter().rposition(|(k, open)| *k == key && *open != Open::If);
        let Some(i) = found else {
            return Err(misfit(word.place, "no loop with this label is being executed", "write the label of a loop around it"));
        };
        self.blocks.truncate(base + i + 1);
        Ok(self.blocks[base + i].1)
    }

    fn leave_loop(&mut self, key: Key, word: &OWord) -> Result<(), Fault> {
        let open = self.find_loop(key, word)?;
        self.skip_to(key, &[end_of(open)], word.place)?;
        self.blocks.pop();
        Ok(())
    }

    fn next_turn(&mut self, key: Key, word: &OWord, state: &State, stack: &mut Stack) -> Result<(), Fault> {
        match self.find_loop(key, word)? {
            Open::While(start) => self.files.lines().place = start,
            open => {
                let end = self.skip_to(key, &[end_of(open)], word.place)?;
                match open {
                    Open::Do(_) => self.while_(key, &end, state, stack)?,
                    _ => self.end_repeat(key, &end)?,
                }
            }
        }
        Ok(())
    }

    /// Where the present row stands.
    pub fn here(&self) -> Place {
        self.here
    }

    /// Back to where an O word was about to be obeyed: `spot` behind it, `here` where it stands.
    pub fn back_to(&mut self, spot: Spot, here: Place) {
        self.files.go(spot);
        self.here = here;
    }
}

fn end_of(open: Open) -> Keyword {
    match open {
        Open::If => Keyword::EndIf,
        Open::While(_) => Keyword::EndWhile,
        Open::Do(_) => Keyword::While,
        Open::Repeat(..) => Keyword::EndRepeat,
    }
}

fn no_start(word: &OWord) -> Fault {
    let label = format!("{} ends nothing that is open", word.keyword.text());
    misfit(word.place, &label, "blocks end in the order in which they nest, with the label of their start")
}
