//! What a control or a dialect sets before the first block.

use super::code::{Code as Arena, Word};
use super::host::HostRef;
use super::lines::Style;
use super::modal::{Distance, FeedMode, Motion};
use super::reader::Reader;
use super::word::{Action, Control};
use crate::canon::{MotionMode, Plane, Position, ToolEntry, Units};
use std::sync::Arc;
use takt_base::units::{Mm, MmPerMin};
use takt_base::{Code, Diag, SourceId, Span};

/// Travel of the axes in machine coordinates: mm and degrees.
#[derive(Clone, Copy, PartialEq, Debug)]
#[allow(missing_docs)]
pub struct Travel {
    pub min: Position,
    pub max: Position,
}

/// Settings of an [`super::Interpreter`].
#[derive(Clone, PartialEq, Debug)]
pub struct Options {
    /// How blocks end.
    pub style: Style,
    /// Blocks that start with `/` are skipped (R1-39); by default they run.
    pub skip_deleted: bool,
    /// Length unit before G20 or G21.
    pub units: Units,
    /// Plane before G17, G18 or G19.
    pub plane: Plane,
    /// Distance mode before G90 or G91.
    pub distance: Distance,
    /// Arc distance mode before G90.1 or G91.1.
    pub arc_distance: Distance,
    /// Motion that axis words mean before the first G0..G3.
    pub motion: Option<Motion>,
    /// Path control before G61, G61.1 or G64; a tolerance in `units`.
    pub control: MotionMode,
    /// Origins of G54 .. G59 in machine coordinates: mm and degrees.
    pub work_offsets: [Position; 6],
    /// Work offset before G54 .. G59; 0 for G54.
    pub work_offset: usize,
    /// Where the machine stands: machine coordinates, mm and degrees.
    pub start: Position,
    /// Largest F that a program may ask for (PC-13); `None`: any.
    pub feed_max: Option<MmPerMin>,
    /// Travel that a program must keep to (R1-103); `None`: not checked here.
    pub travel: Option<Travel>,
    /// Basic length unit that all places of a program must be whole numbers of (PC-20): what a reference-pulse control needs;
    /// `None`: not checked here.
    pub grid: Option<Mm>,
    /// Behaves and lists as LinuxCNC's stand-alone interpreter also where this one would differ: offsets in parts, what stands
    /// before an error, prologue and epilogue.
    pub drop_in: bool,
    /// Unit of lengths in the parameters from 5161 on.
    pub table_units: Units,
    /// Tool table; without one every tool is allowed and has no offsets.
    pub tools: Option<Arc<[ToolEntry]>>,
    /// Tool in the spindle before the first block.
    pub tool: u32,
    /// Parameters from a file: number and value.
    pub parameters: Arc<[(u16, f64)]>,
    /// Files of subroutines, variables of the PLC program.
    pub host: HostRef,
    /// Calls that may be in progress at one time.
    pub calls_max: usize,
    /// Rows that may run without a command coming out: more is an endless loop.
    pub silent_rows_max: u32,
    /// Dialect, strictness, settings of a control.
    pub language: super::fanuc::Language,
}

impl Default for Options {
    /// G17 G21 G54 G61 G90 G91.1 G94, no motion code, from the origin.
    fn default() -> Self {
        Options {
            style: Style::Auto,
            skip_deleted: false,
            units: Units::Mm,
            plane: Plane::Xy,
            distance: Distance::Absolute,
            arc_distance: Distance::Incremental,
            motion: None,
            control: MotionMode::ExactPath,
            work_offsets: [Position::default(); 6],
            work_offset: 0,
            start: Position::default(),
            feed_max: None,
            travel: None,
            grid: None,
            drop_in: false,
            table_units: Units::Mm,
            tools: None,
            tool: 0,
            parameters: Arc::new([]),
            host: HostRef::default(),
            calls_max: 100,
            silent_rows_max: 1_000_000,
            language: super::fanuc::Language::default(),
        }
    }
}

impl Options {
    /// The same with the modes of a prefix block such as `G17 G21 G91 G91.1`: what dialects put before a program.
    ///
    /// # Errors
    /// A word that sets no mode, or a text that is no block; the place is in `text`, as file `source`.
    pub fn with_modes(mut self, source: SourceId, text: &str) -> Result<Self, Box<Diag>> {
        let mut arena = Arena::default();
        let row = Reader::default().read(text, 0, 1, &mut arena).map_err(|fault| Box::new(fault.diag(source)))?;
        for word in &arena.words[row.words.range()] {
            let (start, end) = word.place;
            self.set_mode(word).ok_or_else(|| Box::new(no_mode(Span { source, start, end })))?;
        }
        Ok(self)
    }

    fn set_mode(&mut self, word: &Word) -> Option<()> {
        match word.action? {
            Action::Motion(motion) => self.motion = motion,
            Action::Plane(plane) => self.plane = plane,
            Action::Units(units) => self.units = units,
            Action::Distance(distance) => self.distance = distance,
            Action::ArcDistance(distance) => self.arc_distance = distance,
            Action::WorkOffset(index) if index < 6 => self.work_offset = index,
            Action::Control(control) => self.control = control.mode(0.0),
            Action::Feed(FeedMode::PerMinute) => {}
            _ => return None,
        }
        Some(())
    }
}

impl Control {
    /// As an argument of the command; a tolerance only counts for G64.
    pub const fn mode(self, tolerance: f64) -> MotionMode {
        match self {
            Control::ExactPath => MotionMode::ExactPath,
            Control::ExactStop => MotionMode::ExactStop,
            Control::Continuous => MotionMode::Continuous(tolerance),
        }
    }
}

fn no_mode(span: Span) -> Diag {
    Diag::new(Code::BadValue, span, "sets no mode")
        .message("only modal G codes can stand before a program")
        .help("write codes such as G17 G21 G91 G91.1")
}
