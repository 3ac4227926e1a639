//! M, S and T codes of canonical commands: those of a block go to the PLC program together.
//! Runs: background. From: sync classes of M codes as in LinuxCNC and scenario S39.

use super::{Emit, Item, RunError, RunReader, outputs};
use crate::canon::Canon;
use crate::segment::{Action, AuxCodes, Mark};

impl RunReader {
    pub(super) fn auxiliary(&mut self, mark: Mark, command: &Canon, emit: Emit) -> Result<(), RunError> {
        if let Some((output, with_move)) = outputs::output(command)? {
            return self.output(mark, output, with_move, emit);
        }
        self.spindle.see(command);
        match command {
            Canon::SetSpindleSpeed(s) => self.add(mark, true, emit, |c| c.s = Some(*s)),
            Canon::SelectTool(t) => self.add(mark, false, emit, |c| c.t = Some(*t)),
            Canon::UserMCode { code, p, q } => {
                let words = [p.unwrap_or(0.0), q.unwrap_or(0.0)];
                self.add_m(mark, u16::try_from(*code).unwrap_or(u16::MAX), words, emit);
            }
            Canon::ChangeToolNumber(tool) => self.add_m(mark, 61, [0.0, f64::from(*tool)], emit),
            Canon::OrientSpindle(angle, _) => self.add_m(mark, 19, [*angle, 0.0], emit),
            other => {
                if let Some(code) = m_code(other) {
                    self.add_m(mark, code, [0.0; 2], emit);
                }
            }
        }
        Ok(())
    }

    fn add_m(&mut self, mark: Mark, code: u16, words: [f64; 2], emit: Emit) {
        if mark.block == 0 || self.aux.is_some_and(|(_, c)| c.m[..usize::from(c.m_count)].contains(&code)) {
            return;
        }
        if self.aux.is_some_and(|(_, c)| usize::from(c.m_count) == c.m.len()) {
            self.flush_aux(emit);
        }
        self.add(mark, !matches!(code, 7..=9), emit, |codes| {
            let i = usize::from(codes.m_count);
            codes.m[i] = code;
            codes.m_param[i] = words;
            codes.m_count += 1;
        });
    }

    /// Codes of a block go out together unless their sync classes differ.
    fn add(&mut self, mark: Mark, wait: bool, emit: Emit, put: impl FnOnce(&mut AuxCodes)) {
        let wait = wait && self.work.handshake;
        if self.aux.is_some_and(|(_, c)| c.wait != wait) {
            self.flush_aux(emit);
        }
        let (_, codes) = self.aux.get_or_insert((mark, AuxCodes { wait, ..AuxCodes::default() }));
        put(codes);
    }

    pub(super) fn flush_aux(&mut self, emit: Emit) {
        let at = self.aux.take().map(|(mark, codes)| {
            emit(mark, Item::Action(Action::Aux(codes)));
            mark
        });
        if let Some(command) = self.spindle.changed(self.unit_mm, self.origin[0] + self.tool[0]) {
            emit(at.unwrap_or(self.mark), Item::Action(Action::Spindle(command)));
        }
    }
}

/// The M code that a canonical command came from.
fn m_code(command: &Canon) -> Option<u16> {
    Some(match command {
        Canon::StartSpindleClockwise => 3,
        Canon::StartSpindleCounterclockwise => 4,
        Canon::StopSpindleTurning => 5,
        Canon::ChangeTool(_) => 6,
        Canon::MistOn => 7,
        Canon::FloodOn => 8,
        Canon::MistOff | Canon::FloodOff => 9,
        Canon::PalletShuttle => 60,
        _ => return None,
    })
}
