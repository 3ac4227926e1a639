//! T, M6, M61, G43, G43.1, G43.2, G49.

use super::{Done, Run};
use crate::canon::{Canon, Position, ToolEntry};
use crate::ngc::modal::scaled;
use crate::ngc::request::{AXES, Word, bad_value, missing, not_now};
use crate::ngc::word::{Action, Group, Length};
use takt_base::{Code, Diag, Span};

impl Run<'_, '_> {
    pub(super) fn tools(&mut self) -> Done {
        if let Some(word) = self.request.word('T')
            && let Some(tool) = word.whole()
        {
            self.tool(tool, word.span)?;
            self.modal().tool = tool;
            self.emit(Canon::SelectTool(tool));
        }
        match self.request.code(Group::ToolChange) {
            Some(Action::ToolChange) => self.change_tool(),
            Some(Action::ToolNumber) => self.tool_number(),
            _ => Ok(()),
        }
    }

    /// The row of a tool.
    ///
    /// # Errors
    /// It is not in the table.
    pub fn tool(&self, number: u32, at: Span) -> Result<ToolEntry, Box<Diag>> {
        self.state.tools.find(number).ok_or_else(|| Box::new(unknown_tool(number, at)))
    }

    fn change_tool(&mut self) -> Done {
        let at = self.request.code_span(Group::ToolChange);
        if self.state.modal.side.is_some() {
            return Err(Box::new(not_now(at, "a tool change while G41 or G42 is in force", "write G40 and a move out first")));
        }
        let tool = self.state.modal.tool;
        let entry = self.tool(tool, at)?;
        if self.state.options.drop_in {
            self.emit(Canon::StartChange);
        }
        self.modal().spindle = None;
        self.emit(Canon::StopSpindleTurning);
        self.load(entry);
        self.emit(Canon::ChangeTool(tool));
        Ok(())
    }

    fn load(&mut self, entry: ToolEntry) {
        self.state.tools.load(entry);
        self.modal().tool_in_spindle = entry.tool;
    }

    fn tool_number(&mut self) -> Done {
        let at = self.request.code_span(Group::ToolChange);
        let Some(word) = self.request.word('Q') else {
            return Err(Box::new(missing(at, "Q").help("write the number of the tool in the spindle, such as M61 Q3")));
        };
        let rounded = Word { value: word.value.round(), ..word };
        let Some(number) = if self.state.options.drop_in { rounded } else { word }.whole() else {
            return Err(Box::new(bad_value(word, "not the number of a tool", "write a whole number from 0")));
        };
        let entry = self.tool(number, word.span)?;
        if self.state.options.drop_in {
            self.modal().tool_in_spindle = number;
        } else {
            self.load(entry);
        }
        self.modal().tool = number;
        self.emit(Canon::ChangeToolNumber(number));
        Ok(())
    }

    pub(super) fn tool_length(&mut self) -> Done {
        let Some(Action::Length(length)) = self.request.code(Group::Length) else { return Ok(()) };
        self.uncompensated(self.request.code_span(Group::Length), "another tool length")?;
        let present = self.state.modal.offsets.tool;
        let offset = match length {
            Length::Off => Position::default(),
            Length::Tool => self.offset_of_h()?,
            Length::Dynamic => self.given(present),
            Length::Additional => {
                let at = self.request.code_span(Group::Length);
                let added = match self.request.word('H') {
                    Some(_) => self.offset_of_h()?,
                    None if self.request.any("XYZABC") && !self.state.options.drop_in => self.given(Position::default()),
                    None => {
                        return Err(Box::new(missing(at, "H").help("write the tool whose offset is added, such as G43.2 H2")));
                    }
                };
                crate::ngc::modal::plus(present, added)
            }
        };
        self.modal().length_on = length != Length::Off;
        self.use_tool_offset(offset);
        Ok(())
    }

    /// Axis words in mm; the others as in `p`.
    fn given(&self, p: Position) -> Position {
        let (mut all, unit): ([f64; 6], f64) = (p.into(), self.state.unit());
        for (i, letter) in AXES.into_iter().enumerate() {
            if let Some(value) = self.request.value(letter) {
                all[i] = if i < 3 { value * unit } else { value };
            }
        }
        all.into()
    }

    /// Offset of the tool that H names, or of the one in the spindle; mm.
    fn offset_of_h(&self) -> Result<Position, Box<Diag>> {
        let entry = match self.request.word('H') {
            Some(word) => self.tool(whole_tool(word)?, word.span)?,
            None => self.state.tools.in_spindle(),
        };
        let [x, y, z, a, b, c, ..] = entry.offset;
        Ok(Position { x, y, z, a, b, c })
    }

    /// Puts a tool offset (mm) into force.
    pub(super) fn use_tool_offset(&mut self, offset: Position) {
        let offsets = crate::ngc::modal::Offsets { tool: offset, ..self.state.modal.offsets };
        self.modal().change_offsets(offsets);
        self.emit_tool_offset();
    }

    /// The command for the tool offset in force.
    pub(super) fn emit_tool_offset(&mut self) {
        let p = scaled(self.state.modal.offsets.tool, 1.0 / self.state.unit());
        let straight = [p.x, p.y, p.a, p.b, p.c].iter().all(|&v| v == 0.0);
        self.emit(if straight { Canon::UseToolLengthOffset(p.z) } else { Canon::UseToolLengthOffsets(p) });
    }
}

fn whole_tool(word: Word) -> Result<u32, Box<Diag>> {
    word.whole().ok_or_else(|| Box::new(bad_value(word, "not the number of a tool", "write a whole number from 0")))
}

fn unknown_tool(number: u32, at: Span) -> Diag {
    Diag::new(Code::UnknownTool, at, format!("tool {number}"))
        .message(format!("tool {number} is not in the tool table"))
        .help("add a row for it to the tool table, or write the number of another tool")
}
