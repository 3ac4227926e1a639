//! What a program learns from the machine while it runs: PLC variables, inputs, where a probe tripped.
//! Runs: background. A row that reads a PLC variable is held back: first goes out a command that asks for its variables, all at once,
//! when the motion before has ended; then the row runs with the answer. Without an answer, when a program is only looked at, variables
//! are 0, inputs 0, and a probe trips at the end of its move.

use super::code::{Code as Arena, CommentKind, Row, Target};
use super::expr::{Op, Slice, Value};
use super::fault::Fault;
use super::flow::files::Spot;
use super::interpreter::Interpreter;
use super::lines::Place;
use super::modal::{Modal, scaled};
use super::oword::Label;
use super::param::{Kind, LAST, Name};
use super::state::State;
use crate::canon::{Canon, Position, Step};
use crate::feeder::Commands;
use crate::feeder::tables::Kept;
use crate::plc::{PlcError, READS};
use crate::sync::Answer;
use std::cell::RefCell;
use takt_base::Code;

/// Start of the names of PLC variables.
pub const PREFIX: &str = "_plc_";

/// What the program waits for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Awaits {
    /// M66.
    Input,
    /// G38.
    Probe,
    /// Values of PLC variables.
    Values,
}

/// The part of the state that belongs to the world outside.
#[derive(Clone, Debug, Default)]
pub struct Outside {
    /// The command given out last waits for this.
    pub awaits: Option<Awaits>,
    /// Variables of the row at hand, without [`PREFIX`], with their values.
    pub values: Vec<(String, f64)>,
    /// Variables that the row at hand sets.
    pub sets: Vec<(String, f64)>,
    /// Variables that an O word looked at and nobody has asked for: those of an `elseif` behind it.
    missing: RefCell<Vec<String>>,
}

/// First parameter of the tripped position, and the one that says whether the probe tripped.
const TRIP_FIRST: u16 = 5061;
const TRIPPED: u16 = 5070;
/// Result of M66.
const INPUT: u16 = 5399;

impl State {
    /// Value of a name that the program does not have itself.
    pub(super) fn outside_value(&self, text: &str) -> Option<f64> {
        let Some(path) = text.strip_prefix(PREFIX) else { return self.options.host.value(text) };
        if let Some((_, value)) = self.outside.values.iter().find(|(name, _)| name == path) {
            return Some(*value);
        }
        match self.options.host.plc(path) {
            Some(Ok(_)) => {
                self.outside.missing.borrow_mut().push(path.to_owned());
                None
            }
            Some(Err(_)) => None,
            None => self.options.host.value(text).or((!self.options.drop_in).then_some(0.0)),
        }
    }

    /// `EXISTS[#<name>]`.
    pub(super) fn exists(&self, name: Name, arena: &Arena) -> bool {
        let path = arena.names.text(name).strip_prefix(PREFIX);
        match path.and_then(|path| self.options.host.plc(path)) {
            Some(found) => found.is_ok(),
            None => self.named(name, arena).is_some(),
        }
    }

    /// Notes a setting of an outside name.
    ///
    /// # Errors
    /// There is no such variable, it can't be set, or the value does not fit.
    pub(super) fn set_outside(&mut self, text: &str, value: f64) -> Result<(), PlcError> {
        let error = |code, label: &str, help: &str| Err(PlcError { code, label: label.to_owned(), help: help.to_owned() });
        let Some(path) = text.strip_prefix(PREFIX).filter(|_| !self.options.drop_in) else {
            let done = self.options.host.set_value(text, value);
            return if done { Ok(()) } else { error(Code::BadParameter, "can't be set", "the host does not offer it") };
        };
        match self.options.host.plc(path).transpose()? {
            Some(v) if !v.writable => {
                return error(Code::PlcValue, "can't be set", "inputs, constants and READ_ONLY paths can be read alone");
            }
            Some(v) if !v.fits(value) => {
                let label = format!("{value} does not fit {}", v.ty.name());
                return error(Code::PlcValue, &label, "write a value of its range; integers take whole numbers, BOOL 0 and 1");
            }
            _ => {}
        }
        self.outside.sets.push((path.to_owned(), value));
        Ok(())
    }
}

impl Interpreter {
    /// What the machine says to the last command: see [`crate::sync::waits_for_answer`].
    pub fn answer(&mut self, answer: &Answer) {
        let awaits = self.state.outside.awaits.take();
        match (awaits, answer) {
            (Some(Awaits::Input), Answer::Input(value)) => self.state.params.set(INPUT, *value),
            (Some(Awaits::Probe), Answer::Probe { trip, stop }) => self.probed(trip.as_ref(), stop),
            (Some(Awaits::Values), Answer::Values(values)) => {
                for ((_, value), new) in self.state.outside.values.iter_mut().zip(values) {
                    *value = *new;
                }
            }
            _ => {}
        }
    }

    /// The same with the modes of `modal`, from the position where the machine stands: for a block that is typed in.
    pub fn going_on(mut self, modal: &Modal) -> Self {
        let machine = self.state.modal.machine(self.state.modal.position);
        let now =
            Modal { side: None, position: Position::default(), tool_in_spindle: self.state.modal.tool_in_spindle, ..*modal };
        self.state.modal = now;
        self.state.modal.position = scaled(now.offsets.program(machine), 1.0 / self.state.unit());
        self.reopen();
        self
    }

    /// What outlives the program: parameters but for those of subroutines and those that show the state, tools.
    pub fn kept(&self) -> Kept {
        let state = &self.state;
        let shown = |i: &u16| (5400..=5430).contains(i) || (5061..=5070).contains(i);
        let numbers = (31..=LAST).filter(|i| !shown(i)).map(|i| (i, state.params.get(i))).filter(|p| p.1 != 0.0);
        Kept { parameters: numbers.collect(), tools: state.tools.rows(), tool: state.modal.tool_in_spindle }
    }

    fn probed(&mut self, trip: Option<&[f64; 6]>, stop: &[f64; 6]) {
        let ratio = 1.0 / self.state.unit();
        let program = |p: &[f64; 6]| scaled(self.state.modal.offsets.program(Position::from(*p)), ratio);
        let (at, end) = (program(trip.unwrap_or(stop)), program(stop));
        for (i, value) in (0..).zip(<[f64; 6]>::from(at)) {
            self.state.params.set(TRIP_FIRST + i, value);
        }
        self.state.params.set(TRIPPED, f64::from(u8::from(trip.is_some())));
        self.state.modal.position = end;
    }

    /// Holds a row that reads PLC variables, and asks for them; false if it reads none or its answer is there.
    pub(super) fn asks_first(&mut self, row: &Row) -> bool {
        let names = self.plc_names(row);
        if names.is_empty() {
            return false;
        }
        match self.check_reads(&names) {
            Ok(()) => self.ask(row, names.into_iter().map(|(name, _)| name).collect()),
            Err(fault) => {
                self.opened = true;
                self.fail(fault);
            }
        }
        true
    }

    /// Behind an O word that failed: true if it lacked PLC variables. They are asked for, and the row comes again.
    pub(super) fn asks_again(&mut self, row: &Row, (spot, here): (Spot, Place)) -> bool {
        let missing = std::mem::take(&mut *self.state.outside.missing.borrow_mut());
        let known = self.state.outside.values.iter().map(|(name, _)| name.clone());
        let mut names: Vec<_> = known.map(|name| (name, row.place)).collect();
        missing.iter().for_each(|name| add(name, row.place, &mut names));
        if missing.is_empty() || self.check_reads(&names).is_err() {
            return false;
        }
        self.flow.back_to(spot, here);
        let quiet = Row { comments: Slice::default(), ..*row };
        self.ask(&quiet, names.into_iter().map(|(name, _)| name).collect());
        true
    }

    fn check_reads(&self, names: &[(String, (u32, u32))]) -> Result<(), Fault> {
        for (name, (start, end)) in names {
            if let Some(Err(e)) = self.state.options.host.plc(name) {
                return Err(Fault::at(e.code, *start, *end, e.label, e.help));
            }
        }
        let (first, last) = (names[0].1.0, names[names.len() - 1].1.1);
        if names.len() > READS {
            let label = format!("{} variables", names.len());
            return Err(Fault::at(Code::TooManyReads, first, last, label, "read some of them in a row before: 16 in a row"));
        }
        if self.state.comp.waits() {
            let help = "the tool has to stop here: write G40 before it, or read the variable before G41";
            return Err(Fault::at(Code::NotInThisMode, first, last, "a PLC variable while G41 or G42 is in force", help));
        }
        Ok(())
    }

    fn ask(&mut self, row: &Row, names: Vec<String>) {
        self.state.outside.values = names.iter().map(|name| (name.clone(), 0.0)).collect();
        self.state.outside.awaits = Some(Awaits::Values);
        let counts = row.oword.is_none() && (row.n.is_some() || !row.words.is_empty() || !row.settings.is_empty());
        let block = self.block.saturating_add(u32::from(counts));
        self.queue.push_back(Step { block, line: row.line, n: row.n, command: Canon::ReadPlc(names) });
        self.held = Some(*row);
    }

    /// PLC variables that the row reads, each once, with the first place of each.
    fn plc_names(&self, row: &Row) -> Vec<(String, (u32, u32))> {
        let mut names = Vec::new();
        let arena = &self.flow.code;
        if arena.names.has_outside() && !self.state.options.drop_in {
            values_of(row, arena, &mut |value| in_value(value, arena, &mut names));
        }
        if !row.comments.is_empty() && !self.state.options.drop_in {
            in_comments(row, arena, &mut names);
        }
        names
    }
}

impl Commands for Interpreter {
    fn answer(&mut self, answer: &Answer) {
        Interpreter::answer(self, answer);
    }
    fn kept(&self) -> Option<Kept> {
        Some(Interpreter::kept(self))
    }
    fn modal(&self) -> Option<Modal> {
        Some(self.state.modal)
    }
    fn result(&self) -> f64 {
        self.state.params.returned.unwrap_or(0.0)
    }
    fn in_main(&self) -> bool {
        self.flow.files.at == 0
    }
}

fn values_of(row: &Row, arena: &Arena, see: &mut dyn FnMut(Value)) {
    arena.words[row.words.range()].iter().for_each(|w| see(w.value));
    for setting in &arena.settings[row.settings.range()] {
        if let Target::Numbered(index) = setting.target {
            see(index);
        }
        see(setting.value);
    }
    if let Some(oword) = &row.oword {
        if let Label::Computed(value) = oword.label {
            see(value);
        }
        arena.args[oword.args.range()].iter().for_each(|v| see(*v));
    }
}

fn in_value(value: Value, arena: &Arena, names: &mut Vec<(String, (u32, u32))>) {
    let Value::Code(slice) = value else { return };
    in_slice(slice, arena, names);
}

fn in_slice(slice: Slice, arena: &Arena, names: &mut Vec<(String, (u32, u32))>) {
    for (op, place) in arena.ops[slice.range()].iter().zip(&arena.places[slice.range()]) {
        if let Op::Named(name) = op
            && name.kind == Kind::Outside
            && let Some(path) = arena.names.text(*name).strip_prefix(PREFIX)
        {
            add(path, *place, names);
        }
    }
}

fn add(path: &str, place: (u32, u32), names: &mut Vec<(String, (u32, u32))>) {
    if !names.iter().any(|(known, _)| known == path) {
        names.push((path.to_owned(), place));
    }
}

/// Comments that put parameters into their text.
fn in_comments(row: &Row, arena: &Arena, names: &mut Vec<(String, (u32, u32))>) {
    for comment in &arena.comments[row.comments.range()] {
        let fills = matches!(comment.kind, CommentKind::Debug | CommentKind::Print | CommentKind::Log | CommentKind::Abort);
        let inside = arena.text(comment.text);
        if !fills || !inside.contains("#<") {
            continue;
        }
        for part in inside.split("#<").skip(1).filter_map(|p| p.split_once('>')) {
            let name: String = part.0.chars().filter(|c| !c.is_whitespace()).collect::<String>().to_ascii_lowercase();
            if let Some(path) = name.strip_prefix(PREFIX) {
                add(path, comment.place, names);
            }
        }
    }
}
