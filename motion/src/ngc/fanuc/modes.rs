//! What stays from block to block beside the modes of the kernel: group codes, transformation, offsets of controls of this kind.

use super::drill::Drill;
use super::settings::{Dialect, Settings};
use super::table::GROUPS;
use super::transform::Transform;
use super::turn_passes::PassWords;
use super::virtual_axis::Virtual;
use crate::canon::Position;
use crate::ngc::state::State;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Further work coordinate systems (G54.1 P1 ..).
pub const MORE_SYSTEMS: usize = 300;

/// Polar coordinates (G16): pole, radius, angle in degrees.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Pole {
    /// First and second coordinate.
    pub centre: [f64; 2],
    /// Length units.
    pub radius: f64,
    /// Counterclockwise from the first axis.
    pub angle: f64,
}

/// Wear of an offset number, in mm: X and Z of turning, length H and radius of milling, nose radius of turning.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
#[allow(missing_docs)]
pub struct Wear {
    pub x: f64,
    pub z: f64,
    pub radius: f64,
}

/// The state.
#[derive(Clone, Debug)]
pub struct Modes {
    /// Machine type.
    pub dialect: Dialect,
    /// Settings of the control.
    pub settings: Arc<Settings>,
    /// G codes in force by group, in tenths.
    pub codes: [u32; GROUPS],
    /// Where the program stands: programmed coordinates, length units, X as a radius.
    pub at: Position,
    /// G50.1, G51, G68.
    pub transform: Transform,
    /// G16.
    pub pole: Option<Pole>,
    /// G91.
    pub incremental: bool,
    /// Shift of all work systems by G92 or G50, of local coordinates by G52, of all systems from outside; mm and degrees.
    pub shift: Position,
    /// See [`Modes::shift`].
    pub local: Position,
    /// See [`Modes::shift`].
    pub external: Position,
    /// Origins of G54.1 P1 ..: mm and degrees.
    pub more: Vec<Position>,
    /// Work system: 0 to 5, then those of G54.1.
    pub work: usize,
    /// G98 of milling.
    pub initial_level: bool,
    /// Drilling cycle in force.
    pub drill: Option<Drill>,
    /// G90, G92, G94 of turning.
    pub pass: PassWords,
    /// Largest spindle speed.
    pub clamp: Option<f64>,
    /// Wear by offset number.
    pub wear: BTreeMap<u32, Wear>,
    /// Offset numbers in force: H, D; of turning that of T.
    pub h: u32,
    /// See [`Modes::h`].
    pub d: u32,
    /// Intermediate point of the last G28 or G30.
    pub middle: Option<Position>,
    /// Polar or cylindrical interpolation.
    pub virtual_axis: Option<Virtual>,
    /// Depth of cut, retract of G71, G72; retract of G74, G75. In mm.
    pub rough: [f64; 2],
    /// Of G73: steps in X and Z (mm), number of cuts.
    pub pattern: ([f64; 2], u32),
    /// See [`Modes::rough`].
    pub groove: f64,
    /// Of G76: finishing passes, pull-out in leads, angle in degrees, smallest cut and finishing allowance in mm.
    pub thread: ThreadWords,
    /// Last words by letter, for variables 4102 to 4130.
    pub last: [f64; 26],
    /// M29.
    pub rigid: bool,
    /// Program and sequence number at hand.
    pub program: u32,
    /// See [`Modes::program`].
    pub n: u32,
}

/// First block of G76 of turning.
#[derive(Clone, Copy, PartialEq, Debug)]
#[allow(missing_docs)]
pub struct ThreadWords {
    pub finishing: u32,
    pub pullout_leads: f64,
    pub angle: f64,
    pub least_mm: f64,
    pub allowance_mm: f64,
}

impl Modes {
    /// At the start of a program.
    pub fn new(dialect: Dialect, settings: Arc<Settings>, state: &State) -> Self {
        let turn = dialect == Dialect::FanucTurn;
        let mut codes = [0; GROUPS];
        for (group, tenths) in [(1, 0), (2, 970), (6, 210), (7, 400), (10, 800), (14, 540), (15, 640), (20, 131), (22, 71)] {
            codes[group] = tenths;
        }
        codes[3] = if turn { 0 } else { 900 };
        codes[5] = if turn { 990 } else { 940 };
        codes[16] = if turn { 180 } else { 170 };
        codes[19] = if turn { 0 } else { 980 };
        let rough = [settings.rough_depth_mm, settings.rough_retract_mm];
        let groove = settings.groove_retract_mm;
        Modes {
            dialect,
            settings,
            codes,
            at: state.modal.position,
            transform: Transform::default(),
            pole: None,
            incremental: state.modal.distance == crate::ngc::modal::Distance::Incremental && !turn,
            shift: Position::default(),
            local: Position::default(),
            external: Position::default(),
            more: Vec::new(),
            work: state.modal.work_offset.min(5),
            initial_level: true,
            drill: None,
            pass: PassWords::default(),
            clamp: None,
            wear: BTreeMap::new(),
            h: 0,
            d: 0,
            middle: None,
            virtual_axis: None,
            rough,
            pattern: ([0.0; 2], 1),
            groove,
            thread: ThreadWords { finishing: 1, pullout_leads: 0.0, angle: 60.0, least_mm: 0.0, allowance_mm: 0.0 },
            last: [0.0; 26],
            rigid: false,
            program: 0,
            n: 0,
        }
    }

    /// A turning machine.
    pub fn turn(&self) -> bool {
        self.dialect == Dialect::FanucTurn
    }

    /// X words are diameters.
    pub fn diameter(&self) -> bool {
        self.turn() && self.settings.diameter
    }

    /// Origin of the work system in force, with the shift from outside; mm and degrees.
    pub fn origin(&self, state: &State) -> Position {
        let own = match self.work {
            0..=5 => state.work(self.work).0,
            n => self.more.get(n - 6).copied().unwrap_or_default(),
        };
        crate::ngc::modal::plus(own, self.external)
    }

    /// Wear of an offset number.
    pub fn wear_of(&self, number: u32) -> Wear {
        self.wear.get(&number).copied().unwrap_or_default()
    }
}
