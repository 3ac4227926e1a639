//! Modes in which a program is tried out: single block, dry run, machine lock, optional stop, block skip; and the operator panel.
//! Runs: cyclic. Dry run, machine lock and block skip are taken over when a program starts (R1-85): they do not change in the middle of
//! one. The others count at once. From: R1-39, R1-85..R1-87, R2-115..R2-117, N6, N7, CNC_Panel.

use super::{Channel, CncEvent, CncState};
use crate::axis::{Axis, CommandId};
use crate::feeder::How;
use takt_base::Code;

/// What the operator has switched on.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Modes {
    /// Stop behind every block.
    pub single_block: bool,
    /// M1 stops.
    pub optional_stop: bool,
    /// Feed moves take the feed of the dry run.
    pub dry_run: bool,
    /// The axes stay where they are; everything else goes on.
    pub machine_lock: bool,
    /// The same for single axes: bit 0 is X, bit 1 Y, and so on.
    pub axis_lock: u16,
    /// M, S and T codes are not given out, but for M0, M1, M2 and M30.
    pub aux_lock: bool,
    /// Rows with `/` are left out.
    pub block_skip: bool,
    /// The block in execution ends, the next one is not taken.
    pub read_in_disable: bool,
    /// The path stops, the state stays.
    pub feed_disable: bool,
}

/// Levels and buttons of CNC_Panel in one call.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Panel {
    /// Switches.
    pub modes: Modes,
    /// Button: starts, or goes on.
    pub cycle_start: bool,
    /// Level: holds; beats the start button.
    pub feed_hold: bool,
    /// Button: aborts a program, else leaves cncFault.
    pub reset: bool,
}

impl Channel {
    /// Single block, optional stop, dry run, machine lock, lock of codes, block skip, as they count now.
    pub fn modes_in_force(&self) -> [bool; 6] {
        let m = &self.modes;
        let optional = m.optional_stop || self.config.optional_stop;
        [m.single_block, optional, self.started.dry_run, self.is_locked() && self.joined, m.aux_lock, self.started.block_skip]
    }

    /// An axis of the running program is locked.
    pub fn is_locked(&self) -> bool {
        self.lock() != 0
    }

    /// Axes that the program started with locked.
    fn lock(&self) -> u16 {
        if self.started.machine_lock { u16::MAX } else { self.started.axis_lock }
    }

    pub(super) fn has_lock(&self, coordinate: usize) -> bool {
        self.lock() >> coordinate & 1 != 0
    }

    /// How the next program runs.
    pub(super) fn how(&self, start_line: u32, raw: bool) -> How {
        How { start_line, raw, block_skip: self.modes.block_skip, dry_run: self.modes.dry_run }
    }

    /// CNC_StepBlock: one block, from wherever the program stands.
    pub fn step_block(&mut self) -> Result<(), Code> {
        self.resume()?;
        self.step = true;
        Ok(())
    }

    /// A step is still going on.
    pub fn is_stepping(&self) -> bool {
        self.step && self.state.is_active()
    }

    pub(super) fn stops_at_blocks(&self) -> bool {
        self.modes.single_block || self.step || self.modes.read_in_disable
    }

    /// The path stands in front of the next block.
    pub(super) fn block_end(&mut self) {
        if self.modes.single_block || self.step {
            self.step = false;
            self.event(CncEvent::BlockEnd);
        } else {
            self.kept_back = true;
        }
    }

    /// Nothing keeps the next block back any more.
    pub(super) fn release_block(&mut self) {
        if self.kept_back && !self.stops_at_blocks() {
            self.kept_back = false;
            self.executor.go_on();
        }
    }

    /// One call of CNC_Panel; the error of the last button.
    pub fn panel(&mut self, panel: &Panel, axes: &mut [Axis]) -> Result<(), Code> {
        let before = std::mem::replace(&mut self.panel, *panel);
        self.modes = panel.modes;
        if panel.feed_hold && self.state == CncState::Running {
            self.pressed = self.hold();
        }
        if panel.reset && !before.reset {
            self.pressed = if self.state.is_active() {
                self.abort();
                Ok(())
            } else {
                self.reset()
            };
        }
        if panel.cycle_start && !before.cycle_start && !panel.feed_hold {
            self.pressed = self.cycle_start(axes).map(drop);
        }
        self.pressed
    }

    /// Starts the loaded program, or goes on with it.
    fn cycle_start(&mut self, axes: &mut [Axis]) -> Result<CommandId, Code> {
        match self.state {
            CncState::StepStop | CncState::ProgStop | CncState::Held => self.resume().map(|()| self.command),
            _ => self.run(0, 0, false, axes),
        }
    }

    /// A start would be obeyed.
    pub fn can_start(&self) -> bool {
        match self.state {
            CncState::StepStop | CncState::ProgStop | CncState::Held => true,
            CncState::Ready => self.program_id != 0 && !self.joined,
            _ => false,
        }
    }
}
