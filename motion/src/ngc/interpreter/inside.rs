//! What the cycles that read a contour (G70 to G72) ask of the interpreter. Runs: background.

use super::*;

impl Interpreter {
    /// The parts at work, for a cycle that makes many moves.
    pub(in crate::ngc) fn parts(&mut self) -> (&Request, &mut State, &mut VecDeque<Step>, &mut Vec<Diag>, u32) {
        (&self.request, &mut self.state, &mut self.queue, &mut self.diags, self.block)
    }

    /// Enters the subroutine of a contour.
    pub(in crate::ngc) fn enter_sub(&mut self, number: u32, place: (u32, u32)) -> Result<(), Fault> {
        self.flow.call_program(number, 1, place, &mut self.state)
    }

    /// Leaves it before its end.
    pub(in crate::ngc) fn leave_sub(&mut self) {
        self.flow.leave(&mut self.state);
    }

    /// An O word of a contour; modes that were saved in it are forgotten.
    pub(in crate::ngc) fn contour_word(&mut self, word: &crate::ngc::oword::OWord) -> Result<After, Fault> {
        self.flow.obey(word, &mut self.state, &mut self.stack)
    }

    /// Computes the words of a row of a contour; returns how many diagnostics there were before.
    pub(in crate::ngc) fn fill_request(&mut self, row: &Row) -> usize {
        let (source, before) = (self.flow.files.source(), self.diags.len());
        self.state.line = row.line;
        self.request.fill(row, source, &self.flow.code, &mut self.state, &mut self.stack, &mut self.diags);
        before
    }
}
