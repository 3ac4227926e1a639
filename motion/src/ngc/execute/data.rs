//! G10: L1, L10, L11 change the tool table, L2 and L20 a work offset system.

use super::offsets::work_that_makes;
use super::{Done, Run};
use crate::canon::{Canon, Position, ToolEntry};
use crate::ngc::modal::minus;
use crate::ngc::request::{bad_value, missing};
use crate::ngc::word::Group;
use takt_base::Diag;

impl Run<'_, '_> {
    pub(super) fn set_data(&mut self) -> Done {
        let at = self.request.code_span(Group::NonModal);
        let Some(word) = self.request.word('L') else {
            return Err(Box::new(missing(at, "L").help("write G10 L1, L2, L10, L11 or L20")));
        };
        match word.whole() {
            Some(0) => Ok(()),
            Some(l @ (1 | 10 | 11)) => self.set_tool(l),
            Some(l @ (2 | 20)) => self.set_system(l == 20),
            _ => Err(Box::new(bad_value(word, "no such table", "write L1, L2, L10, L11 or L20"))),
        }
    }

    fn set_system(&mut self, relative: bool) -> Done {
        let at = self.request.code_span(Group::NonModal);
        self.uncompensated(at, "G10")?;
        let Some(word) = self.request.word('P') else {
            return Err(Box::new(missing(at, "P").help("write the number of the system: P1 is G54, P0 the one in force")));
        };
        let index = match word.whole() {
            Some(0) => self.state.modal.work_offset,
            Some(p @ 1..=9) => p as usize - 1,
            _ => return Err(Box::new(bad_value(word, "no such work offset system", "write P0 to P9"))),
        };
        if let Some(r) = self.request.word('R').filter(|_| relative) {
            return Err(Box::new(bad_value(r, "G10 L20 has no rotation", "set it with G10 L2 R")));
        }
        let (old, old_rotation) = self.state.work(index);
        let rotation = self.request.value('R').unwrap_or(old_rotation);
        let work = if relative { self.relative_work(old, rotation) } else { self.axes_in_mm(old) };
        self.set_work(index, work, rotation);
        Ok(())
    }

    /// G10 L20: the named axes get the coordinates of the words, in the system that changes.
    fn relative_work(&self, old: Position, rotation: f64) -> Position {
        let state = &*self.state;
        let offsets = crate::ngc::modal::Offsets { work: old, rotation, ..state.modal.offsets };
        let here = offsets.program(state.modal.machine(state.modal.position));
        let work = work_that_makes(state, rotation, self.axes_in_mm(here));
        if rotation != 0.0 {
            return work;
        }
        let (mut all, new): ([f64; 6], [f64; 6]) = (old.into(), work.into());
        for (i, letter) in crate::ngc::request::AXES.into_iter().enumerate() {
            if self.request.word(letter).is_some() {
                all[i] = new[i];
            }
        }
        all.into()
    }

    fn set_tool(&mut self, l: u32) -> Done {
        let at = self.request.code_span(Group::NonModal);
        let Some(word) = self.request.word('P') else {
            return Err(Box::new(missing(at, "P").help("write the number of the tool")));
        };
        let Some(number) = word.whole().filter(|&p| p > 0) else {
            return Err(Box::new(bad_value(word, "not the number of a tool", "write a whole number from 1")));
        };
        let mut entry = self.tool(number, word.span)?;
        self.set_tool_offsets(&mut entry, l);
        self.set_tool_shape(&mut entry)?;
        self.state.tools.set(entry);
        self.emit(Canon::SetToolTableEntry(Box::new(entry)));
        if number == self.state.modal.tool_in_spindle {
            self.state.tools.load(entry);
            self.emit(Canon::SetToolTableEntry(Box::new(ToolEntry { index: 0, ..entry })));
        }
        Ok(())
    }

    fn set_tool_offsets(&mut self, entry: &mut ToolEntry, l: u32) {
        let state = &*self.state;
        let [x, y, z, a, b, c, ..] = entry.offset;
        let old = Position { x, y, z, a, b, c };
        let new = if l == 1 {
            self.axes_in_mm(old)
        } else {
            // The offset with which the present place has the coordinates of the words: of the system in force (L10), or of G59.3 (L11).
            let machine = state.modal.machine(state.modal.position);
            let system = if l == 10 { state.modal.offsets.origin() } else { state.work(8).0 };
            let here = minus(minus(machine, system), old);
            let want = self.axes_in_mm(here);
            minus(minus(machine, system), want)
        };
        let (new, mut all): ([f64; 6], [f64; 6]) = (new.into(), old.into());
        for (i, letter) in crate::ngc::request::AXES.into_iter().enumerate() {
            if self.request.word(letter).is_some() {
                all[i] = new[i];
            }
        }
        entry.offset[..6].copy_from_slice(&all);
    }

    fn set_tool_shape(&self, entry: &mut ToolEntry) -> Result<(), Box<Diag>> {
        if let Some(radius) = self.request.value('R') {
            entry.diameter = 2.0 * radius * self.state.unit();
        }
        if let Some(front) = self.request.value('I') {
            entry.front = front;
        }
        if let Some(back) = self.request.value('J') {
            entry.back = back;
        }
        if let Some(word) = self.request.word('Q') {
            let bad = || Box::new(bad_value(word, "no such orientation", "write a whole number from 0 to 9"));
            entry.orientation = word.whole().filter(|&q| q <= 9).ok_or_else(bad)?;
        }
        Ok(())
    }
}
