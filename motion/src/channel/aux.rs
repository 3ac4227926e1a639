//! Strobe and finish: how M, S and T codes reach the PLC program and how it answers.
//! Runs: cyclic. One step a call of CNC_AuxHandshake: codes, one call later strobes, Fin, strobes low, Fin low.
//! From: sync classes note and before, scenario S39.

use crate::segment::AuxCodes;

/// Notes that wait for the PLC program to look; older ones give way.
const NOTES: usize = 16;

#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
enum Phase {
    #[default]
    Idle,
    /// A note is shown, its strobe comes with the next call.
    Note,
    /// The strobe of a note is up for this one call.
    NoteStrobe,
    /// Codes are shown; the strobes rise as soon as Fin is low.
    Shown,
    /// Strobes are up; Fin is awaited.
    Strobe,
    /// Fin was seen: the strobes fall with the next call.
    Seen,
    /// Strobes are low; Fin must follow.
    FinLow,
}

/// State of the handshake of one channel.
#[derive(Clone, Debug, Default)]
pub struct Aux {
    phase: Phase,
    shown: AuxCodes,
    pending: Option<AuxCodes>,
    notes: [AuxCodes; NOTES],
    note_count: usize,
    strobes: bool,
    seq: u32,
    finished: bool,
    cancelled: bool,
    cancelled_shown: bool,
    waited_s: f64,
    pre_fin: u16,
}

impl Aux {
    /// Codes that wait for the PLC program.
    pub fn begin(&mut self, codes: AuxCodes) {
        self.pending = Some(codes);
        self.finished = false;
        self.waited_s = 0.0;
    }

    /// Codes that are shown, and nobody waits.
    pub fn note(&mut self, codes: AuxCodes) {
        if self.note_count == NOTES {
            self.notes.rotate_left(1);
            self.note_count -= 1;
        }
        self.notes[self.note_count] = codes;
        self.note_count += 1;
    }

    /// The wait is given up: strobes fall at once.
    pub fn cancel(&mut self) {
        self.cancelled = self.pending.is_some() || !matches!(self.phase, Phase::Idle);
        self.pending = None;
        self.note_count = 0;
        self.strobes = false;
        self.phase = Phase::Idle;
    }

    /// True once for a finished wait.
    pub fn take_finished(&mut self) -> bool {
        std::mem::take(&mut self.finished)
    }

    /// Time passes while the channel waits; true if it has been too long.
    pub fn wait(&mut self, dt: f64, timeout_s: f64) -> bool {
        self.waited_s += dt;
        timeout_s > 0.0 && self.waited_s > timeout_s
    }

    /// One call of the block. `pre_fin`: an M code that is finished before it is asked for; 0: none.
    pub fn call(&mut self, fin: bool, pre_fin: u16) {
        self.cancelled_shown = std::mem::take(&mut self.cancelled);
        if pre_fin != 0 {
            self.pre_fin = pre_fin;
        }
        self.phase = match self.phase {
            Phase::Idle => self.idle(),
            Phase::Note => self.strobe(true, Phase::NoteStrobe),
            Phase::NoteStrobe => self.strobe(false, Phase::Idle),
            Phase::Shown if !fin => self.strobe(true, Phase::Strobe),
            Phase::Strobe if fin => Phase::Seen,
            Phase::Seen if !fin => {
                self.strobe(false, Phase::Idle);
                self.finish()
            }
            Phase::Seen => self.strobe(false, Phase::FinLow),
            Phase::FinLow if !fin => self.finish(),
            same => same,
        };
    }

    fn idle(&mut self) -> Phase {
        if self.note_count > 0 {
            let note = self.notes[0];
            self.notes.rotate_left(1);
            self.note_count -= 1;
            return self.show(note, Phase::Note);
        }
        let Some(codes) = self.pending else { return Phase::Idle };
        if self.pre_fin != 0 && codes.m_count == 1 && codes.m[0] == self.pre_fin {
            self.pre_fin = 0;
            self.show(codes, Phase::Idle);
            return self.finish();
        }
        self.show(codes, Phase::Shown)
    }

    fn show(&mut self, codes: AuxCodes, next: Phase) -> Phase {
        self.shown = codes;
        self.seq = self.seq.wrapping_add(1);
        next
    }

    fn strobe(&mut self, up: bool, next: Phase) -> Phase {
        self.strobes = up;
        next
    }

    fn finish(&mut self) -> Phase {
        self.pending = None;
        self.finished = true;
        Phase::Idle
    }

    /// The codes shown last.
    pub fn shown(&self) -> &AuxCodes {
        &self.shown
    }
    /// Strobe of the M codes.
    pub fn mf(&self) -> bool {
        self.strobes && self.shown.m_count > 0
    }
    /// Strobe of the S code.
    pub fn sf(&self) -> bool {
        self.strobes && self.shown.s.is_some()
    }
    /// Strobe of the T code.
    pub fn tf(&self) -> bool {
        self.strobes && self.shown.t.is_some()
    }
    /// This M code is shown with its strobe.
    pub fn has_m(&self, m: u16) -> bool {
        self.mf() && self.shown.m[..usize::from(self.shown.m_count)].contains(&m)
    }
    /// Counts outputs.
    pub fn seq(&self) -> u32 {
        self.seq
    }
    /// A wait was given up; TRUE for one call.
    pub fn is_cancelled(&self) -> bool {
        self.cancelled_shown
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn codes(m: u16, wait: bool) -> AuxCodes {
        AuxCodes { m: [m, 0, 0, 0], m_count: 1, wait, ..AuxCodes::default() }
    }

    /// Scenario S39: a note strobes for one call; then the seven steps of the handshake.
    #[test]
    fn note_then_handshake() {
        let mut aux = Aux::default();
        aux.note(codes(8, false));
        aux.begin(codes(10, true));
        let mut seen = Vec::new();
        for fin in [false, false, false, false, false, false, true, true, true, false, false] {
            aux.call(fin, 0);
            seen.push((aux.shown().m[0], aux.mf(), aux.finished));
        }
        let want = [
            (8, false, false),
            (8, true, false),
            (8, false, false),
            (10, false, false),
            (10, true, false),
            (10, true, false),
            (10, true, false),
            (10, false, false),
            (10, false, false),
            (10, false, true),
            (10, false, true),
        ];
        assert_eq!(seen, want);
        assert_eq!(aux.seq(), 2);
    }

    #[test]
    fn fin_that_is_already_up_holds_the_strobe_back() {
        let mut aux = Aux::default();
        aux.begin(codes(3, true));
        (0..5).for_each(|_| aux.call(true, 0));
        assert!(!aux.mf());
        aux.call(false, 0);
        assert!(aux.mf());
        aux.cancel();
        assert!(!aux.mf());
        aux.call(false, 0);
        assert!(aux.is_cancelled());
        aux.call(false, 0);
        assert!(!aux.is_cancelled());
    }

    #[test]
    fn finished_in_advance() {
        let mut aux = Aux::default();
        aux.call(false, 10);
        aux.begin(codes(10, true));
        aux.call(false, 0);
        assert!(aux.take_finished() && !aux.mf());
    }
}
