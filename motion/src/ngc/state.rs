//! Everything that a row can read or change: modes, parameters, tools.

use super::code::Code as Arena;
use super::cycle::Sticky;
use super::modal::{Distance, FeedMode, Modal, Retract, Side, mm_per_unit};
use super::options::Options;
use super::param::{Kind, Name, Params, Predefined};
use super::tool::Table;
use crate::canon::{Direction, Plane, Position, Units};
use std::sync::Arc;

/// The state between two rows.
#[derive(Clone, Debug)]
pub struct State {
    /// Modes.
    pub modal: Modal,
    /// Numbered and named parameters.
    pub params: Params,
    /// Tool table.
    pub tools: Table,
    /// What was set before the program.
    pub options: Arc<Options>,
    /// Line of the row at hand.
    pub line: u32,
    /// Words of the canned cycle in force.
    pub sticky: Sticky,
    /// Control points of a NURBS in the making: x, y, weight; and its order.
    pub nurbs: Option<(u32, Vec<[f64; 3]>)>,
    /// Modes saved by M70, one place a call level.
    pub saved: Vec<Option<Box<SavedModes>>>,
    /// Cutter compensation.
    pub comp: super::comp::Comp,
    /// What the machine and the PLC program say.
    pub outside: super::outside::Outside,
    /// The last straight or circular move, for splines.
    pub spline_end: Option<[f64; 2]>,
}

/// Modes that M70 or M73 saved.
#[derive(Clone, Debug)]
pub struct SavedModes {
    /// The modes.
    pub modal: Modal,
    /// The end of the subroutine brings them back (M73).
    pub automatic: bool,
}

/// First parameter of the work offset systems; they are 20 apart.
pub const WORK_FIRST: u16 = 5221;

impl State {
    /// Before the first row.
    pub fn new(options: Arc<Options>) -> Self {
        let modal = Modal::new(&options);
        let mut state = State {
            modal,
            params: Params::default(),
            tools: Table::new(options.tools.clone()),
            options: options.clone(),
            line: 0,
            sticky: Sticky::default(),
            nurbs: None,
            saved: vec![None],
            comp: super::comp::Comp::default(),
            outside: super::outside::Outside::default(),
            spline_end: None,
        };
        for (i, offset) in options.work_offsets.iter().enumerate() {
            state.store(WORK_FIRST + 20 * i as u16, *offset);
        }
        state.params.set(5599, 1.0);
        state.params.set(5220, modal.work_offset as f64 + 1.0);
        if let Some(entry) = state.tools.find(options.tool).filter(|_| options.tool > 0) {
            state.tools.load(entry);
            state.modal.tool_in_spindle = options.tool;
        }
        for &(index, value) in options.parameters.iter() {
            state.params.set(index, value);
        }
        state.start_offsets();
        state
    }

    /// Offsets that the parameters ask for.
    fn start_offsets(&mut self) {
        if self.options.parameters.is_empty() {
            return;
        }
        let index = (self.params.get(5220) as usize).clamp(1, 9) - 1;
        self.modal.work_offset = index;
        let mut offsets = self.modal.offsets;
        (offsets.work, offsets.rotation) = self.work(index);
        if self.params.get(5210) != 0.0 {
            offsets.local = self.stored(5211);
        }
        self.modal.change_offsets(offsets);
    }

    /// Millimetres in the unit of lengths in parameters and tool table.
    pub fn table_unit(&self) -> f64 {
        mm_per_unit(self.options.table_units)
    }

    /// Millimetres in the active length unit.
    pub fn unit(&self) -> f64 {
        mm_per_unit(self.modal.units)
    }

    /// Origin (mm) and rotation (degrees) of a work offset system, 0 for G54.
    pub fn work(&self, index: usize) -> (Position, f64) {
        let first = WORK_FIRST + 20 * index as u16;
        (self.stored(first), self.params.get(first + 9))
    }

    /// A position that six parameters from `first` hold, in mm and degrees.
    pub fn stored(&self, first: u16) -> Position {
        let (get, unit) = (|i| self.params.get(first + i), self.table_unit());
        Position { x: get(0) * unit, y: get(1) * unit, z: get(2) * unit, a: get(3), b: get(4), c: get(5) }
    }

    /// Stores a position in mm and degrees.
    pub fn store(&mut self, first: u16, p: Position) {
        let unit = self.table_unit();
        for (i, value) in [p.x / unit, p.y / unit, p.z / unit, p.a, p.b, p.c].into_iter().enumerate() {
            self.params.set(first + i as u16, value);
        }
    }

    /// Value of a numbered parameter; some show the state.
    pub fn numbered(&self, index: u16) -> f64 {
        if index < 5400 {
            return self.params.get(index);
        }
        let p: [f64; 6] = self.modal.position.into();
        match index {
            5400..=5413 => self.tool_parameter(index),
            5420..=5425 => p[usize::from(index - 5420)],
            5426..=5428 => 0.0,
            _ => self.params.get(index),
        }
    }

    fn tool_parameter(&self, index: u16) -> f64 {
        let entry = self.tools.in_spindle();
        let unit = self.table_unit();
        match index {
            5400 => f64::from(self.modal.tool_in_spindle),
            5401..=5409 => {
                let i = usize::from(index - 5401);
                if (3..6).contains(&i) { entry.offset[i] } else { entry.offset[i] / unit }
            }
            5410 => entry.diameter / unit,
            5411 => entry.front,
            5412 => entry.back,
            _ => f64::from(entry.orientation),
        }
    }

    /// True if the program may not set the parameter.
    pub fn read_only(index: u16) -> bool {
        matches!(index, 5400..=5413 | 5420..=5428)
    }

    /// Value of a named parameter; `None` if it has none. `arena` knows the names of outside values.
    pub fn named(&self, name: Name, arena: &Arena) -> Option<f64> {
        match name.kind {
            Kind::Fixed(predefined) => Some(self.predefined(predefined)),
            Kind::Outside => self.outside_value(arena.names.text(name)),
            _ => self.params.named(name),
        }
    }

    fn predefined(&self, what: Predefined) -> f64 {
        use Predefined as P;
        let m = &self.modal;
        let flag = |on: bool| f64::from(u8::from(on));
        let p = m.position;
        match what {
            P::VersionMajor => 2.9,
            P::VersionMinor | P::Task | P::RemapLevel | P::U | P::V | P::W => 0.0,
            P::Line => f64::from(self.line),
            P::MotionMode => m.motion.map_or(800.0, |motion| f64::from(motion.code())),
            P::Plane => match m.plane {
                Plane::Xy => 170.0,
                Plane::Xz => 180.0,
                Plane::Yz => 190.0,
            },
            P::Compensation => match (m.side, m.side_dynamic) {
                (None, _) => 400.0,
                (Some(Side::Left), dynamic) => 410.0 + flag(dynamic),
                (Some(Side::Right), dynamic) => 420.0 + flag(dynamic),
            },
            P::Metric => flag(m.units == Units::Mm),
            P::Imperial => flag(m.units == Units::Inches),
            P::Absolute => flag(m.distance == Distance::Absolute),
            P::Incremental => flag(m.distance == Distance::Incremental),
            P::InverseTime => flag(m.feed_mode == FeedMode::InverseTime),
            P::UnitsPerMinute => flag(m.feed_mode == FeedMode::PerMinute),
            P::UnitsPerRev => flag(m.feed_mode == FeedMode::PerRevolution),
            P::CoordSystem => [540.0, 550.0, 560.0, 570.0, 580.0, 590.0, 591.0, 592.0, 593.0][m.work_offset.min(8)],
            P::ToolOffset => flag(m.length_on),
            P::RetractR => flag(m.retract == Retract::R),
            P::RetractOld => flag(m.retract == Retract::OldZ),
            P::SpindleRpm => flag(m.surface_speed.is_none()),
            P::SpindleCss => flag(m.surface_speed.is_some()),
            P::ArcAbsolute => flag(m.arc_distance == Distance::Absolute),
            P::Diameter => flag(m.diameter),
            P::Radius => flag(!m.diameter),
            P::SpindleOn => flag(m.spindle.is_some()),
            P::SpindleCw => flag(m.spindle == Some(Direction::Clockwise)),
            P::Mist => flag(m.mist),
            P::Flood => flag(m.flood),
            P::SpeedOverride => flag(m.speed_override),
            P::FeedOverride => flag(m.overrides),
            P::AdaptiveFeed => flag(m.adaptive_feed),
            P::FeedHold => flag(m.feed_hold),
            P::Feed => m.feed.unwrap_or(0.0),
            P::Rpm => m.speed,
            P::X => p.x,
            P::Y => p.y,
            P::Z => p.z,
            P::A => p.a,
            P::B => p.b,
            P::C => p.c,
            P::AbsoluteX => m.machine(p).x / mm_per_unit(m.units),
            P::AbsoluteY => m.machine(p).y / mm_per_unit(m.units),
            P::AbsoluteZ => m.machine(p).z / mm_per_unit(m.units),
            P::AbsoluteA => m.machine(p).a,
            P::AbsoluteB => m.machine(p).b,
            P::AbsoluteC => m.machine(p).c,
            P::CurrentTool => f64::from(m.tool_in_spindle),
            P::CurrentPocket => f64::from(self.tools.pocket_of(m.tool_in_spindle)),
            P::SelectedTool => f64::from(m.tool),
            P::SelectedPocket => f64::from(self.tools.pocket_of(m.tool)),
            P::Value => self.params.returned.unwrap_or(0.0),
            P::ValueReturned => flag(self.params.returned.is_some()),
            P::CallLevel => self.params.depth() as f64,
        }
    }
}
