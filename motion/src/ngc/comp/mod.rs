//! Cutter radius compensation G40, G41, G42 and their .1 forms (RS274/NGC appendix B, LinuxCNC "Cutter Compensation").

use super::execute::{Done, Run};
use super::modal::Modal;
use crate::canon::{Canon, Position};

/// The state of compensation.
#[derive(Clone, Debug, Default)]
pub struct Comp {
    _p: (),
}

impl Comp {
    /// True if moves have to be compensated.
    pub fn active(&self, modal: &Modal) -> bool {
        modal.side.is_some()
    }
}

/// A move of the contour.
///
/// # Errors
/// The tool can't follow.
pub fn follow(_run: &mut Run, _command: Canon, _end: Position) -> Done {
    Ok(())
}

impl Run<'_, '_> {
    pub(super) fn compensation(&mut self) -> Done {
        Ok(())
    }
}
