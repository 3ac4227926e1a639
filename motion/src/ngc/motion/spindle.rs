//! G33 and G33.1: motion in step with the spindle.

use super::{checked, need, target};
use crate::canon::Canon;
use crate::ngc::execute::{Done, Run};
use takt_base::{Code, Diag};

/// G33.
///
/// # Errors
/// No K, or the spindle stands.
pub fn synchronized(run: &mut Run) -> Done {
    let pitch = pitch(run, "G33")?;
    let end = target(run.request, run.state)?;
    run.emit(Canon::StartSpeedFeedSync(pitch));
    checked(run, Canon::StraightFeed(end), run.request.span);
    run.emit(Canon::StopSpeedFeedSynch);
    run.modal().position = end;
    Ok(())
}

/// G33.1: to the end and back.
///
/// # Errors
/// No K, or the spindle stands.
pub fn rigid_tap(run: &mut Run) -> Done {
    let pitch = pitch(run, "G33.1")?;
    let end = target(run.request, run.state)?;
    run.emit(Canon::StartSpeedFeedSync(pitch));
    checked(run, Canon::RigidTap(end), run.request.span);
    run.emit(Canon::StopSpeedFeedSynch);
    Ok(())
}

fn pitch(run: &Run, code: &str) -> Result<f64, Box<Diag>> {
    let at = run.request.motion_span();
    let axes = run.request.any("XYZABCUVW@^");
    let stands = run.state.modal.spindle.is_none();
    if !axes {
        need(run.request, 'X', "write where the motion ends")?;
    }
    let pitch = need(run.request, 'K', "K is the distance a revolution of the spindle")?.value;
    if stands {
        let label = format!("{code} with the spindle stopped");
        return Err(Box::new(Diag::new(Code::SpindleStopped, at, label).help("write S and M3 before it")));
    }
    Ok(pitch)
}
