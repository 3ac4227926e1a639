//! G38.2 .. G38.5. Where the probe trips is not known while the program is read ahead: the end point stands for it.

use super::{check_feed, need, target};
use crate::canon::{Canon, Position, Probe};
use crate::ngc::execute::{Done, Run};
use crate::ngc::modal::{FeedMode, Motion, minus, mm_per_unit};
use crate::ngc::outside::Awaits;
use crate::ngc::request::{AXES, not_now};

/// First parameter of the tripped position, and the one that says whether the probe tripped.
const RESULT_FIRST: u16 = 5061;
const TRIPPED: u16 = 5070;
/// How far LinuxCNC's stand-alone interpreter backs off behind a probe, in mm.
const BACK_OFF_MM: f64 = 0.254;

/// Makes the probe move `code`: 2 and 3 towards the contact, 4 and 5 away from it; 2 and 4 must trip.
///
/// # Errors
/// No axis word, no feed, a mode that does not fit.
pub fn run(run: &mut Run, code: u8) -> Done {
    let at = run.request.motion_span();
    let motion = Motion::Probe(code);
    if !run.request.any("XYZABCUVW@^") {
        need(run.request, 'X', "write where the probe goes, such as G38.2 Z-10")?;
    }
    run.uncompensated(at, "probing")?;
    if run.state.modal.feed_mode == FeedMode::InverseTime {
        return Err(Box::new(not_now(at, "probing with G93", "write G94 and F before it")));
    }
    check_feed(run, motion)?;
    let end = target(run.request, run.state)?;
    run.emit(Canon::TurnProbeOn);
    super::checked(
        run,
        Canon::StraightProbe(end, Probe { towards: code < 4, must_trip: code.is_multiple_of(2) }),
        run.request.span,
    );
    run.emit(Canon::TurnProbeOff);
    run.state.outside.awaits = Some(Awaits::Probe);
    let values: [f64; 6] = end.into();
    for (i, _) in AXES.iter().enumerate() {
        run.state.params.set(RESULT_FIRST + i as u16, values[i]);
    }
    let drop_in = run.state.options.drop_in;
    run.state.params.set(TRIPPED, if drop_in { 0.0 } else { 1.0 });
    let behind = if drop_in { backed_off(run, end) } else { end };
    run.modal().position = behind;
    Ok(())
}

fn backed_off(run: &Run, end: Position) -> Position {
    let from = run.state.modal.position;
    let d = minus(end, from);
    let length = (d.x * d.x + d.y * d.y + d.z * d.z).sqrt();
    if length == 0.0 {
        return end;
    }
    let share = BACK_OFF_MM / mm_per_unit(run.state.modal.units) / length;
    Position { x: end.x - d.x * share, y: end.y - d.y * share, z: end.z - d.z * share, ..end }
}
