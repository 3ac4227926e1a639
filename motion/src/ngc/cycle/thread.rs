//! G76: a thread in passes of growing depth (LinuxCNC "G76 Threading Cycle").

use crate::canon::{Canon, Position};
use crate::ngc::execute::{Done, Run};
use crate::ngc::motion::{checked, need, need_positive};
use crate::ngc::request::bad_value;
use takt_base::{Code, Diag};

/// Passes that a thread may have.
const PASSES_MAX: u32 = 10_000;

/// A thread, in length units.
struct Thread {
    /// Drive line, Y and Z at the start.
    start: Position,
    /// From outside to inside: -1, or 1 for a bore.
    side: f64,
    pitch: f64,
    /// Depth of the first cut, and full depth from the drive line.
    cut: f64,
    full: f64,
    /// From the drive line to the peak of the thread.
    peak: f64,
    height: f64,
    end_z: f64,
    degression: f64,
    /// Tangent of the angle of infeed.
    slope: f64,
    taper: f64,
    entry: bool,
    exit: bool,
    springs: u32,
}

/// Makes the thread.
///
/// # Errors
/// A word is missing or out of range, or the spindle stands.
pub fn run(run: &mut Run) -> Done {
    let thread = words(run)?;
    if run.state.modal.spindle.is_none() {
        let at = run.request.motion_span();
        let help = "write S and M3 before it";
        return Err(Box::new(Diag::new(Code::SpindleStopped, at, "G76 with the spindle stopped").help(help)));
    }
    thread.make(run)
}

fn words(run: &Run) -> Result<Thread, Box<Diag>> {
    let request = run.request;
    let refuse = |letter: char, help: &str| match request.word(letter) {
        Some(word) => Box::new(bad_value(word, "does not fit a thread", help)),
        None => Box::new(Diag::new(Code::BadValue, request.motion_span(), "does not fit a thread").help(help)),
    };
    let pitch = need_positive(request, 'P', "P is the pitch, above 0")?;
    let i = need(request, 'I', "I is the offset of the thread peak from the drive line")?.value;
    let cut = need_positive(request, 'J', "J is the depth of the first cut, above 0")?;
    let height = need_positive(request, 'K', "K is the full depth of the thread, above 0")?;
    let end_z = need(request, 'Z', "Z is the end of the thread")?.value;
    let degression = request.value('R').unwrap_or(1.0).max(1.0);
    if cut > height {
        return Err(refuse('J', "the first cut is not deeper than the thread (K)"));
    }
    let taper = request.value('E').unwrap_or(0.0);
    let start = run.state.modal.position;
    let ends = request.value('L').map_or(0, |l| l.round() as i64);
    if !(0..=3).contains(&ends) {
        return Err(refuse('L', "L0: no tapers, L1: at the start, L2: at the end, L3: both"));
    }
    let end_z = match run.state.modal.distance {
        crate::ngc::modal::Distance::Absolute => end_z,
        crate::ngc::modal::Distance::Incremental => start.z + end_z,
    };
    if taper < 0.0 || taper * if ends == 3 { 2.0 } else { 1.0 } > (end_z - start.z).abs() {
        return Err(refuse('E', "the tapers (E) are not longer than the thread"));
    }
    let springs = match request.word('H') {
        None => 0,
        Some(word) => word.whole().filter(|&h| h <= PASSES_MAX).ok_or_else(|| refuse('H', "H is a number of spring passes"))?,
    };
    Ok(Thread {
        start,
        side: if i > 0.0 { 1.0 } else { -1.0 },
        pitch,
        cut,
        full: i.abs() + height,
        peak: i.abs(),
        height,
        end_z,
        degression,
        slope: libm::tan(request.value('Q').unwrap_or(0.0).to_radians()),
        taper,
        entry: ends & 1 != 0 && taper > 0.0,
        exit: ends & 2 != 0 && taper > 0.0,
        springs,
    })
}

impl Thread {
    fn make(&self, run: &mut Run) -> Done {
        let depth_of = |pass: u32| self.peak + self.cut * libm::pow(f64::from(pass), 1.0 / self.degression);
        let (mut pass, mut depth) = (1_u32, depth_of(1));
        while depth < self.full {
            self.pass(run, depth);
            pass += 1;
            if pass > PASSES_MAX {
                let at = run.request.motion_span();
                let help = "make J larger or R smaller";
                return Err(Box::new(Diag::new(Code::BadValue, at, "more than 10000 passes").help(help)));
            }
            depth = depth_of(pass);
        }
        for _ in 0..=self.springs {
            self.pass(run, self.full);
        }
        let end = self.at(0.0, self.end_z);
        checked(run, Canon::StraightTraverse(end), run.request.span);
        run.modal().position = end;
        Ok(())
    }

    /// The point `depth` beyond the drive line, towards the work.
    fn at(&self, depth: f64, z: f64) -> Position {
        Position { x: self.start.x + self.side * depth, z, ..self.start }
    }

    fn pass(&self, run: &mut Run, depth: f64) {
        let (cut, full_cut) = (depth - (self.full - self.height), self.height);
        let down = if self.end_z < self.start.z { -1.0 } else { 1.0 };
        let start_z = self.start.z - cut * self.slope;
        let end_z = self.end_z + (full_cut - cut) * self.slope;
        let back = depth - self.full;
        let shallow = depth - self.height;
        let taper_pitch =
            if self.taper > 0.0 { self.pitch * libm::hypot(self.taper, self.height) / self.taper } else { self.pitch };
        let go = |run: &mut Run, to, feed| {
            checked(run, if feed { Canon::StraightFeed(to) } else { Canon::StraightTraverse(to) }, run.request.span);
        };
        go(run, self.at(back, start_z), false);
        if self.entry {
            run.emit(Canon::DisableFeedOverride);
            run.emit(Canon::StartSpeedFeedSync(taper_pitch));
            go(run, self.at(shallow, start_z), true);
            go(run, self.at(depth, start_z + down * self.taper), true);
            run.emit(Canon::StartSpeedFeedSync(self.pitch));
        } else {
            go(run, self.at(depth, start_z), false);
            run.emit(Canon::DisableFeedOverride);
            run.emit(Canon::StartSpeedFeedSync(self.pitch));
        }
        if self.exit {
            go(run, self.at(depth, end_z - down * self.taper), true);
            run.emit(Canon::StartSpeedFeedSync(taper_pitch));
            go(run, self.at(shallow, end_z), true);
        } else {
            go(run, self.at(depth, end_z), true);
        }
        run.emit(Canon::StopSpeedFeedSynch);
        go(run, self.at(back, end_z), false);
        run.emit(Canon::EnableFeedOverride);
    }
}
