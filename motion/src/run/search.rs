//! Block search: a program is taken up at a line. What stands before it is read and not moved; codes that the PLC program has to know
//! come again, collected, before the first move.
//! Runs: background.

use super::{Emit, RunError, RunReader};
use crate::canon::{Canon, Step};
use crate::geometry::{Path, Point};
use crate::segment::{Action, Mark, Switch};

/// What the search has passed.
#[derive(Clone, Debug, Default)]
pub struct Passed {
    /// Where the machine really stands.
    from: Option<Point>,
    tool: Option<u32>,
    change: Option<Canon>,
    mist: bool,
    flood: bool,
    /// The feed override counts.
    feed_override: Option<bool>,
}

impl Passed {
    fn see(&mut self, command: &Canon) {
        match command {
            Canon::SelectTool(tool) => self.tool = Some(*tool),
            Canon::ChangeTool(_) | Canon::ChangeToolNumber(_) => self.change = Some(command.clone()),
            Canon::MistOn => self.mist = true,
            Canon::MistOff => self.mist = false,
            Canon::FloodOn => self.flood = true,
            Canon::FloodOff => self.flood = false,
            Canon::EnableFeedOverride => self.feed_override = Some(true),
            Canon::DisableFeedOverride => self.feed_override = Some(false),
            _ => {}
        }
    }
}

impl RunReader {
    /// Reads a command of which nothing comes out.
    pub fn read_silently(&mut self, step: &Step) -> Result<(), RunError> {
        self.passed.from.get_or_insert(self.position);
        self.passed.see(&step.command);
        let result = self.read(step, &mut |_, _| {});
        self.aux = None;
        self.pending.clear();
        result
    }

    /// The line has come: collected codes, and a straight move at the feed in force to where the path goes on.
    pub fn take_up(&mut self, mark: Mark, emit: Emit) -> Result<(), RunError> {
        let passed = std::mem::take(&mut self.passed);
        self.aux = None;
        self.spindle.forget_shown();
        if let Some(tool) = passed.tool {
            self.auxiliary(mark, &Canon::SelectTool(tool), emit)?;
        }
        if let Some(change) = &passed.change {
            self.auxiliary(mark, change, emit)?;
        }
        for command in self.spindle.codes() {
            self.auxiliary(mark, &command, emit)?;
        }
        for (on, command) in [(passed.mist, Canon::MistOn), (passed.flood, Canon::FloodOn)] {
            if on {
                self.auxiliary(mark, &command, emit)?;
            }
        }
        if let Some(on) = passed.feed_override {
            self.action(mark, Action::Switch(Switch::Feed, on), emit)?;
        }
        self.flush_aux(emit);
        let to = self.position;
        if let Some(from) = passed.from.filter(|from| *from != to) {
            self.position = from;
            let rapid = self.feed_mm_s <= 0.0 && self.dry_run.is_none();
            self.go(mark, Path::line(from, to), rapid, emit)?;
        }
        Ok(())
    }
}
