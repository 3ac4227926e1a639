//! Threads: G32, G33 in one cut, G76 of turning in passes (R1-70, R1-80).

use super::Machine;
use super::block::Block;
use super::calls::bad;
use super::kernel::Io;
use super::modes::ThreadWords;
use super::moves::Shape;
use crate::canon::Position;
use crate::ngc::execute::Done;
use crate::ngc::request::missing;
use takt_base::{Code, Diag, Span};

/// Cuts that a thread may have.
const CUTS_MAX: u32 = 10_000;

impl Machine {
    /// The lead: F, or E; the spindle turns.
    pub(super) fn lead(&self, b: &Block, io: &Io) -> Result<f64, Box<Diag>> {
        let lead = match b.take(b'E') {
            Some(word) => Some(word.value),
            None => io.state.modal.feed,
        };
        let Some(lead) = lead.filter(|&l| l > 0.0) else {
            return Err(Box::new(missing(b.span, "F").help("F is the lead of the thread")));
        };
        if io.state.modal.spindle.is_none() {
            let diag = Diag::new(Code::SpindleStopped, b.span, "a thread with the spindle stopped");
            return Err(Box::new(diag.help("write S and M3 or M4 before it")));
        }
        Ok(lead)
    }

    /// G32, G33.
    pub(super) fn thread(&mut self, b: &Block, io: &mut Io) -> Done {
        self.free(b.span, "a thread", io)?;
        let lead = self.lead(b, io)?;
        self.no_start_angle(b)?;
        let end = self.target(b, io)?;
        if self.modes.turn() {
            return self.cut_thread(end, end.x, lead, 0.0, b.span, io);
        }
        let (from, to) = (self.modes.at, end);
        let (dx, dy, dz) = (to.x - from.x, to.y - from.y, to.z - from.z);
        let (length, longest) = ((dx * dx + dy * dy + dz * dz).sqrt(), dx.abs().max(dy.abs()).max(dz.abs()));
        if length <= 0.0 {
            return Ok(());
        }
        io.emit(crate::canon::Canon::StartSpeedFeedSync(lead * length / longest));
        self.modes.at = to;
        let end = self.modes.transform.apply(to);
        io.place(crate::canon::Canon::StraightFeed(end), end, b.span);
        io.emit(crate::canon::Canon::StopSpeedFeedSynch);
        Ok(())
    }

    /// G76 in two blocks (`P m r a, Q, R` and `X Z R P Q F`) or in one (`X Z I K D A F`).
    pub(super) fn multi_thread(&mut self, b: &Block, at: Span, io: &mut Io) -> Done {
        if !b.any("XZUW") {
            return self.thread_words(b, io);
        }
        let words = self.modes.thread;
        let lead = self.lead(b, io)?;
        let start = self.modes.at;
        let end = self.target(b, io)?;
        let one_block = b.any("K");
        let unit = io.state.unit();
        let need =
            |letter: u8, help: &str| b.take(letter).ok_or_else(|| Box::new(missing(at, &super::block::name(letter)).help(help)));
        let (height, first, taper) = if one_block {
            let height = need(b'K', "K is the height of the thread")?;
            let first = need(b'D', "D is the depth of the first cut: D300 is 0.3 mm")?;
            (self.length_of(height).abs(), self.increments_of(first).abs(), b.take(b'I').map_or(0.0, |w| self.length_of(w)))
        } else {
            let height = need(b'P', "P is the height of the thread: P1200 is 1.2 mm")?;
            let first = need(b'Q', "Q is the depth of the first cut: Q300 is 0.3 mm")?;
            (self.increments_of(height).abs(), self.increments_of(first).abs(), b.take(b'R').map_or(0.0, |w| self.length_of(w)))
        };
        let angle = if one_block { b.take(b'A').map_or(60.0, |w| w.value) } else { words.angle };
        b.use_all("LP");
        let wrong = |label: &str, help: &str| Err(Box::new(Diag::new(Code::BadValue, at, label).help(help)));
        if height <= 0.0 || first <= 0.0 || first > height {
            return wrong(
                "height and first cut do not fit",
                "P is the height above 0, Q the first cut, not deeper than the thread",
            );
        }
        if !(0.0..=120.0).contains(&angle) {
            return wrong("no angle of a thread", "the angle is from 0 to 120 degrees");
        }
        let cuts = self.cuts(first, height, words, unit);
        let Some(cuts) = cuts else { return wrong("more than 10000 cuts", "make the first or the smallest cut larger") };
        let shape = Thread {
            start,
            end,
            taper,
            height,
            slope: libm::tan((angle / 2.0).to_radians()),
            lead,
            pullout: words.pullout_leads * lead,
        };
        for depth in cuts {
            self.thread_cut(&shape, depth, at, io)?;
        }
        self.step(start, Shape::Rapid, at, io)
    }

    /// Depths of all cuts: growing with the root of their number, each at least the smallest, then the finishing ones.
    fn cuts(&self, first: f64, height: f64, words: ThreadWords, unit: f64) -> Option<Vec<f64>> {
        let rough = (height - words.allowance_mm / unit).max(first.min(height));
        let (mut depths, mut depth, mut n) = (Vec::new(), 0.0, 0_u32);
        while depth < rough - 1e-9 {
            n += 1;
            if n > CUTS_MAX {
                return None;
            }
            let next: f64 = first * f64::from(n).sqrt();
            depth = next.max(depth + words.least_mm / unit).min(rough);
            depths.push(depth);
        }
        let finishing = if rough < height { words.finishing.max(1) } else { words.finishing.saturating_sub(1) };
        depths.extend((0..finishing).map(|_| height));
        Some(depths)
    }

    fn thread_cut(&mut self, t: &Thread, depth: f64, at: Span, io: &mut Io) -> Done {
        let outside = t.start.x >= t.end.x;
        let sign = if outside { 1.0 } else { -1.0 };
        // The root of the thread is at X; a cut that is not full leaves the rest of the height.
        let rest = sign * (t.height - depth);
        let shift = (t.end.z - t.start.z).signum() * depth * t.slope;
        let z = t.start.z + shift;
        self.step(Position { z, ..t.start }, Shape::Rapid, at, io)?;
        self.step(Position { x: t.end.x + t.taper + rest, z, ..t.start }, Shape::Rapid, at, io)?;
        let end = Position { x: t.end.x + rest, ..t.end };
        self.cut_thread(end, t.start.x, t.lead, t.pullout, at, io)?;
        self.step(Position { x: t.start.x, ..self.modes.at }, Shape::Rapid, at, io)?;
        self.step(Position { z: t.start.z, ..self.modes.at }, Shape::Rapid, at, io)
    }

    /// The first block of G76: `P` is two digits each for finishing cuts, pull-out in tenths of the lead, angle.
    fn thread_words(&mut self, b: &Block, io: &Io) -> Done {
        let unit = io.state.unit();
        let mut words = self.modes.thread;
        if let Some(p) = b.take(b'P') {
            let number = p.whole().filter(|&n| n <= 999_999);
            let number =
                number.ok_or_else(|| bad(p, "not three pairs of digits", "write finishing cuts, pull-out and angle: P021060"))?;
            words.finishing = (number / 10_000).max(1);
            words.pullout_leads = f64::from(number / 100 % 100) / 10.0;
            words.angle = f64::from(number % 100);
        }
        if let Some(q) = b.take(b'Q') {
            words.least_mm = self.increments_of(q).abs() * unit;
        }
        if let Some(r) = b.take(b'R') {
            words.allowance_mm = self.length_of(r).abs() * unit;
        }
        self.modes.thread = words;
        Ok(())
    }
}

/// A thread in length units; X as a radius.
struct Thread {
    start: Position,
    end: Position,
    taper: f64,
    height: f64,
    slope: f64,
    lead: f64,
    pullout: f64,
}
