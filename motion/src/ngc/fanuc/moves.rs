//! Moves of a block: where they end, straight or round; their way through corner, contour, virtual axis and transformation to the kernel.

use super::Machine;
use super::block::{Block, Word};
use super::corner::{Corner, Spec};
use super::kernel::Io;
use super::modes::Pole;
use super::table::{self, Meaning};
use super::transform::axes_of;
use crate::canon::{Canon, Position};
use crate::ngc::arc::Point;
use crate::ngc::execute::Done;
use crate::ngc::modal::{Distance, FeedMode, from_plane, in_plane};
use crate::ngc::motion::arc_in_plane;
use crate::ngc::motion::arc_words::ArcWords;
use crate::ngc::request::{AXES, Request, not_now};
use takt_base::{Code, Diag, Span};

/// A move in programmed coordinates and length units.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Seg {
    /// Where it starts.
    pub from: Position,
    /// Where it ends.
    pub to: Position,
    /// Its form.
    pub shape: Shape,
    /// The block.
    pub at: Span,
}

/// Form of a move.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Shape {
    /// At traverse.
    Rapid,
    /// At feed.
    Line,
    /// About a centre in the plane; turns are positive counterclockwise.
    Arc {
        /// First and second coordinate.
        centre: Point,
        /// Never 0.
        turns: i32,
    },
}

/// Words that move axes.
const AXIS_WORDS: &str = "XYZABC";
const TURN_WORDS: &str = "XYZABCUVWH";

impl Machine {
    /// The value of a length or angle, in length units or degrees.
    pub(super) fn length_of(&self, word: Word) -> f64 {
        if self.modes.settings.calculator || word.exact {
            return word.value;
        }
        let linear = !matches!(word.letter, b'A' | b'B' | b'C' | b'H');
        word.value / if linear && self.modes.codes[6] == 200 { 10_000.0 } else { 1000.0 }
    }

    /// A word along an axis in length units; along X of a diameter half of it counts.
    pub(super) fn along(&self, axis: usize, word: Word) -> f64 {
        self.length_of(word) * if axis == 0 && self.modes.diameter() { 0.5 } else { 1.0 }
    }

    /// A length that has no point counts increments whatever the settings are: P and Q of turning cycles.
    pub(super) fn increments_of(&self, word: Word) -> f64 {
        match word.exact {
            true => word.value,
            false => word.value / if self.modes.codes[6] == 200 { 10_000.0 } else { 1000.0 },
        }
    }

    /// The increment word of an axis.
    pub(super) fn increment(&self, b: &Block, axis: usize) -> Option<Word> {
        let letter = *[Some(b'U'), Some(b'V'), Some(b'W'), None, None, Some(b'H')].get(axis)?;
        if self.modes.turn() { b.take(letter?) } else { None }
    }

    /// True if the block names an axis.
    pub(super) fn names_axis(&self, b: &Block) -> bool {
        b.any(if self.modes.turn() { TURN_WORDS } else { AXIS_WORDS })
    }

    /// Where the axis words lead.
    pub(super) fn target(&mut self, b: &Block, io: &Io) -> Result<Position, Box<Diag>> {
        self.target_but(b, io, false)
    }

    fn target_but(&mut self, b: &Block, io: &Io, chamfer: bool) -> Result<Position, Box<Diag>> {
        let mut to: [f64; 6] = self.modes.at.into();
        let polar = self.polar_target(b, io);
        for (i, letter) in AXES.into_iter().enumerate() {
            if i == 5 && chamfer {
                continue;
            }
            let (word, increment) = (b.take(letter as u8), self.increment(b, i));
            if let (Some(word), Some(increment)) = (word, increment) {
                let diag = Diag::new(Code::DuplicateWord, increment.span, format!("{letter} stands in the block too"));
                return Err(Box::new(diag.also(word.span, "the first one stands here").help("keep one of them")));
            }
            match (word, increment) {
                (Some(word), _) if self.modes.incremental => to[i] += self.along(i, word),
                (Some(word), _) => to[i] = self.along(i, word),
                (None, Some(word)) => to[i] += self.along(i, word),
                (None, None) => {}
            }
        }
        if let Some([first, second]) = polar {
            let [i, j] = axes_of(Self::plane(io));
            (to[i], to[j]) = (first, second);
        }
        Ok(to.into())
    }

    /// The point of polar words (G16): radius on the first axis of the plane, angle on the second.
    fn polar_target(&mut self, b: &Block, io: &Io) -> Option<Point> {
        let pole = self.modes.pole?;
        let [i, j] = axes_of(Self::plane(io));
        let all: [f64; 6] = self.modes.at.into();
        let (radius, angle) = (b.take(AXES[i] as u8), b.take(AXES[j] as u8));
        if radius.is_none() && angle.is_none() {
            return None;
        }
        let mut new = pole;
        if let Some(word) = radius {
            new.radius = self.length_of(word);
            new.centre = if self.modes.incremental { [all[i], all[j]] } else { [0.0; 2] };
        }
        if let Some(word) = angle {
            let degrees = Word { letter: b'A', ..word };
            let value = self.length_of(degrees);
            new.angle = if self.modes.incremental { pole.angle + value } else { value };
        }
        self.modes.pole = Some(new);
        let Pole { centre, radius, angle } = new;
        let (sin, cos) = libm::sincos(angle.to_radians());
        Some([centre[0] + radius * cos, centre[1] + radius * sin])
    }

    /// The motion of a block: its own code, or the one in force.
    pub(super) fn motion(&mut self, b: &Block, io: &mut Io) -> Done {
        let takes = |c: &super::block::GCode| match c.meaning {
            Meaning::Scale(true) | Meaning::Mirror(_) | Meaning::Rotate(true) | Meaning::Cylinder => true,
            Meaning::ExactBlock | Meaning::Multi(_) => false,
            _ => c.group == 0,
        };
        if b.codes.iter().any(takes) {
            return Ok(());
        }
        if let Some(code) = b.code(|m| matches!(m, Meaning::Multi(_))) {
            return self.multi(b, code, io);
        }
        if self.drilling(b, io)? {
            return self.moved(b, io);
        }
        self.plain_motion(b, io)?;
        self.moved(b, io)
    }

    /// The motion of group 1.
    pub(super) fn plain_motion(&mut self, b: &Block, io: &mut Io) -> Done {
        let meaning = table::find(self.modes.dialect, self.modes.codes[1]).map_or(Meaning::Rapid, |found| found.0);
        if !matches!(meaning, Meaning::Pass(_)) {
            self.modes.pass.forget();
        }
        if meaning != Meaning::Nurbs {
            self.end_nurbs(io);
        }
        let axes = self.names_axis(b);
        match meaning {
            Meaning::Rapid if axes => self.line(b, true, io),
            Meaning::Line if axes => self.line(b, false, io),
            Meaning::Arc(cw) if axes || b.any("IJKR") => self.circle(b, cw, io),
            Meaning::Thread if axes => self.thread(b, io),
            Meaning::Pass(pass) if axes || b.of_group(1).is_some() => self.pass(b, pass, io),
            Meaning::Nurbs => self.nurbs_block(b, io),
            _ => Ok(()),
        }
    }

    /// The macro of G66 follows a block that moves.
    fn moved(&mut self, b: &Block, io: &Io) -> Done {
        if self.modal_macro.is_some() && self.names_axis(b) {
            return self.modal_call(b.span, io);
        }
        Ok(())
    }

    fn line(&mut self, b: &Block, rapid: bool, io: &mut Io) -> Done {
        let (spec, chamfer) = if rapid { (None, false) } else { self.corner_words(b)? };
        let to = self.target_but(b, io, chamfer)?;
        let shape = if rapid { Shape::Rapid } else { Shape::Line };
        self.go(Seg { from: self.modes.at, to, shape, at: b.span }, spec, io)
    }

    fn circle(&mut self, b: &Block, clockwise: bool, io: &mut Io) -> Done {
        let spec = Spec::of_commas(self, b)?;
        let to = self.target(b, io)?;
        let mut request = Request::default();
        request.reset(b.span, None);
        if let Some(r) = b.take(b'R') {
            b.use_all("IJK");
            request.put_word('R', self.length_of(r), r.span);
        } else {
            for letter in ['I', 'J', 'K'] {
                if let Some(word) = b.take(letter as u8) {
                    request.put_word(letter, self.length_of(word), word.span);
                }
            }
        }
        let mut modal = io.state.modal;
        (modal.position, modal.arc_distance) = (self.modes.at, Distance::Incremental);
        if self.modes.virtual_axis.is_some() {
            let seg = self.virtual_arc(&request, to, !clockwise, b.span, io)?;
            return self.go(seg, spec, io);
        }
        let words = ArcWords { request: &request, modal: &modal, end: to, counterclockwise: !clockwise };
        let arc = words.arc(io.out.diags).map_err(Box::new)?;
        let shape = Shape::Arc { centre: [arc.first_axis, arc.second_axis], turns: arc.rotation };
        self.go(Seg { from: self.modes.at, to, shape, at: b.span }, spec, io)
    }

    /// A move: with a corner behind it, it waits for the next one.
    pub(super) fn go(&mut self, seg: Seg, spec: Option<Spec>, io: &mut Io) -> Done {
        self.modes.at = seg.to;
        let seg = match self.corner.take() {
            Some(corner) => self.join(corner, seg, io)?,
            None => seg,
        };
        match spec {
            Some(spec) => {
                self.corner = Some(Corner { seg, spec, feed: io.state.modal.feed });
                Ok(())
            }
            None => self.deliver(seg, io),
        }
    }

    /// A move whose ends are known.
    pub(super) fn deliver(&mut self, seg: Seg, io: &mut Io) -> Done {
        if let Some(contour) = &mut self.recording {
            contour.push(seg);
            return Ok(());
        }
        if seg.shape != Shape::Rapid {
            self.say_feed_mode(io);
        }
        if self.modes.virtual_axis.is_some() {
            return self.virtual_move(seg, io);
        }
        let end = self.modes.transform.apply(seg.to);
        let done = match seg.shape {
            Shape::Rapid => io.straight(end, true, seg.at),
            Shape::Line => io.straight(end, false, seg.at),
            Shape::Arc { centre, turns } => self.deliver_arc(seg, centre, turns, end, io),
        };
        if done.is_err() {
            io.state.modal.position = end;
        }
        done
    }

    fn deliver_arc(&self, seg: Seg, centre: Point, turns: i32, end: Position, io: &mut Io) -> Done {
        let plane = Self::plane(io);
        let Some(flips) = self.modes.transform.turns_arcs(plane) else {
            let help = "scale both axes of the plane alike, and rotate in the plane of the arc; or write the curve as lines";
            return Err(Box::new(not_now(seg.at, "an arc that would become an ellipse", help)));
        };
        let [_, _, third] = in_plane(seg.to, plane);
        let middle = self.modes.transform.apply(from_plane([centre[0], centre[1], third], plane, seg.to));
        let [first, second, _] = in_plane(middle, plane);
        let turns = if flips { -turns } else { turns };
        io.arc(arc_in_plane([first, second], turns, end, plane), end, seg.at)
    }

    /// Turning starts with feed a revolution; that is said before the first move that feeds.
    pub(super) fn say_feed_mode(&mut self, io: &mut Io) {
        if !std::mem::replace(&mut self.said_feed_mode, true) && io.state.modal.feed_mode == FeedMode::PerRevolution {
            io.emit(Canon::SetFeedMode(true));
        }
    }
}
