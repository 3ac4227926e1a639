//! Planes, units, work offsets, G92 and G52, reference positions.

use super::{Done, Run};
use crate::canon::{Canon, Plane, Position, Units};
use crate::ngc::modal::{Modal, Offsets, minus, plus, rotated, scaled};
use crate::ngc::motion;
use crate::ngc::request::{AXES, missing, not_now};
use crate::ngc::state::State;
use crate::ngc::word::{Action, Group, Offset};
use takt_base::Diag;

/// Parameters of the reference positions of G28 and G30.
const REFERENCE_FIRST: [u16; 2] = [5161, 5181];
/// Parameters of G92: whether it counts, and its offsets.
const LOCAL_ON: u16 = 5210;
const LOCAL_FIRST: u16 = 5211;

impl Run<'_, '_> {
    pub(super) fn plane_and_units(&mut self) -> Done {
        if let Some(Action::Plane(plane)) = self.request.code(Group::Plane) {
            if self.state.modal.side.is_some() && plane != self.state.modal.plane {
                let at = self.request.code_span(Group::Plane);
                return Err(Box::new(not_now(at, "another plane while G41 or G42 is in force", "write G40 first")));
            }
            self.modal().plane = plane;
            self.emit(Canon::SelectPlane(plane));
        }
        if let Some(Action::Units(units)) = self.request.code(Group::Units) {
            if self.state.comp.waits() && units != self.state.modal.units {
                let at = self.request.code_span(Group::Units);
                return Err(Box::new(not_now(at, "another unit while G41 or G42 is in force", "write G40 first")));
            }
            self.modal().change_units(units);
            self.emit(Canon::UseLengthUnits(units));
        }
        if let Some(Action::Diameter(on)) = self.request.code(Group::Lathe) {
            self.modal().diameter = on;
            self.say(if on { "Lathe diameter mode changed to diameter" } else { "Lathe diameter mode changed to radius" });
        }
        Ok(())
    }

    /// Another plane, if it is not the one in force.
    pub(super) fn use_plane(&mut self, plane: Plane) {
        if self.state.modal.plane != plane {
            self.modal().plane = plane;
            self.emit(Canon::SelectPlane(plane));
        }
    }

    /// Another unit, if it is not the one in force.
    pub(super) fn use_units(&mut self, units: Units) {
        if self.state.modal.units != units {
            self.modal().change_units(units);
            self.emit(Canon::UseLengthUnits(units));
        }
    }

    pub(super) fn work_offset_code(&mut self) -> Done {
        let Some(Action::WorkOffset(index)) = self.request.code(Group::WorkOffset) else { return Ok(()) };
        self.uncompensated(self.request.code_span(Group::WorkOffset), "another origin")?;
        self.work_offset(index);
        Ok(())
    }

    /// Choosing the work offset that is in force changes nothing and emits nothing.
    pub(super) fn work_offset(&mut self, index: usize) {
        if index == self.state.modal.work_offset {
            return self.say("continuing to use same coordinate system");
        }
        let (work, rotation) = self.state.work(index);
        self.state.params.set(5220, index as f64 + 1.0);
        self.modal().work_offset = index;
        let before = self.state.modal.offsets;
        self.modal().change_offsets(Offsets { work, rotation, ..before });
        self.emit_origin(before, true);
    }

    /// The commands for the offsets in force, after they were `before`.
    pub(super) fn emit_origin(&mut self, before: Offsets, local: bool) {
        let now = self.state.modal.offsets;
        if self.state.options.drop_in {
            self.emit_parts(local, now.rotation != before.rotation);
            return;
        }
        self.emit(origin(&self.state.modal));
        if now.rotation != before.rotation {
            self.emit(Canon::SetXyRotation(now.rotation));
        }
    }

    /// The same in the form of LinuxCNC.
    fn emit_parts(&mut self, local: bool, rotation: bool) {
        let (index, ratio) = (self.state.modal.work_offset as u32 + 1, 1.0 / self.state.unit());
        let now = self.state.modal.offsets;
        self.emit(Canon::SetG5xOffset(index, scaled(now.work, ratio)));
        if local {
            self.emit(Canon::SetG92Offset(scaled(now.local, ratio)));
        }
        if rotation || local {
            self.emit(Canon::SetXyRotation(now.rotation));
        }
    }

    /// Sets origin and rotation of a work offset system.
    pub(super) fn set_work(&mut self, index: usize, work: Position, rotation: f64) {
        self.state.store(crate::ngc::state::WORK_FIRST + 20 * index as u16, work);
        self.state.params.set(crate::ngc::state::WORK_FIRST + 20 * index as u16 + 9, rotation);
        if index != self.state.modal.work_offset {
            return self.say("setting coordinate system origin");
        }
        let before = self.state.modal.offsets;
        self.modal().change_offsets(Offsets { work, rotation, ..before });
        if self.state.options.drop_in {
            self.emit_parts(false, true);
        } else {
            self.emit_origin(before, false);
        }
    }

    /// G10, G28, G30, G52, G92 and their kin.
    pub(super) fn non_modal(&mut self) -> Done {
        match self.request.code(Group::NonModal) {
            Some(Action::SetData) => self.set_data(),
            Some(Action::Reference(index)) => self.go_to_reference(index),
            Some(Action::StoreReference(index)) => {
                let place = self.state.modal.machine(self.state.modal.position);
                self.state.store(REFERENCE_FIRST[index], place);
                Ok(())
            }
            Some(Action::Offset(offset)) => self.local_offset(offset),
            _ => Ok(()),
        }
    }

    fn local_offset(&mut self, offset: Offset) -> Done {
        let at = self.request.code_span(Group::NonModal);
        self.uncompensated(at, "another origin")?;
        let bare = !self.request.any("XYZABCUVW");
        if offset == Offset::Set && bare && self.state.options.language.lenient {
            let help = "all axes become 0 here, as printers take it; write G92 X0 Y0 Z0";
            self.out.diags.push(Diag::new(takt_base::Code::LeftOut, at, "a G92 without axis words").help(help));
        } else if matches!(offset, Offset::Local | Offset::Set) && bare {
            return Err(Box::new(missing(at, "an axis word").help("write the axes whose offset changes, such as G92 X0")));
        }
        let local = match offset {
            Offset::Local => self.axes_in_mm(self.state.modal.offsets.local),
            Offset::Set if bare => plus(self.state.modal.offsets.local, scaled(self.state.modal.position, self.state.unit())),
            Offset::Set => self.offset_that_makes(),
            Offset::Clear | Offset::Suspend => Position::default(),
            Offset::Restore => self.state.stored(LOCAL_FIRST),
        };
        if offset != Offset::Suspend {
            self.state.store(LOCAL_FIRST, local);
        }
        let on = !matches!(offset, Offset::Clear | Offset::Suspend);
        self.state.params.set(LOCAL_ON, f64::from(u8::from(on)));
        let before = self.state.modal.offsets;
        self.modal().change_offsets(Offsets { local, ..before });
        if self.state.options.drop_in {
            self.emit(Canon::SetG92Offset(scaled(local, 1.0 / self.state.unit())));
        } else {
            self.emit_origin(before, false);
        }
        Ok(())
    }

    /// Axis words in mm and degrees; others as in `p`.
    pub(super) fn axes_in_mm(&self, p: Position) -> Position {
        let (mut all, unit): ([f64; 6], f64) = (p.into(), self.state.unit());
        for (i, letter) in AXES.into_iter().enumerate() {
            if let Some(value) = self.request.value(letter) {
                let value = if i == 0 && self.state.modal.diameter { value / 2.0 } else { value };
                all[i] = if i < 3 { value * unit } else { value };
            }
        }
        all.into()
    }

    /// The G92 offset with which the present position has the coordinates of the axis words.
    fn offset_that_makes(&self) -> Position {
        let here = scaled(self.state.modal.position, self.state.unit());
        let want = self.axes_in_mm(here);
        plus(self.state.modal.offsets.local, minus(here, want))
    }

    /// G28, G30: over the place that the axis words name to the reference position; with axis words only these axes go on.
    fn go_to_reference(&mut self, index: usize) -> Done {
        let at = self.request.code_span(Group::NonModal);
        self.uncompensated(at, "G28 or G30")?;
        let middle = motion::target(self.request, self.state)?;
        self.go(middle, at)?;
        let unit = self.state.unit();
        let home = scaled(self.state.modal.offsets.program(self.state.stored(REFERENCE_FIRST[index])), 1.0 / unit);
        let (mut end, home): ([f64; 6], [f64; 6]) = (middle.into(), home.into());
        let named = self.request.any("XYZABCUVW");
        for (i, letter) in AXES.into_iter().enumerate() {
            if !named || self.request.word(letter).is_some() {
                end[i] = home[i];
            }
        }
        self.go(end.into(), at)
    }

    fn go(&mut self, to: Position, at: takt_base::Span) -> Done {
        motion::checked(self, Canon::StraightTraverse(to), at);
        self.modal().position = to;
        Ok(())
    }
}

/// The command for the offsets in force, in length units.
pub fn origin(modal: &Modal) -> Canon {
    let ratio = 1.0 / crate::ngc::modal::mm_per_unit(modal.units);
    Canon::SetOriginOffsets(scaled(modal.offsets.origin(), ratio))
}

/// The work offset that gives the present position the coordinates `want` (G10 L20); all in mm.
pub(super) fn work_that_makes(state: &State, rotation: f64, want: Position) -> Position {
    let machine = state.modal.machine(state.modal.position);
    let Offsets { local, tool, .. } = state.modal.offsets;
    minus(minus(machine, tool), rotated(plus(want, local), rotation))
}
