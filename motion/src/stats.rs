//! Figures of a program: lengths, extent, time at the programmed feed. A reader of canonical commands.

use crate::canon::{Canon, Position, Step};
use crate::toolpath::{Kind, Tracker};

/// Smallest box around a path, X Y Z in mm, machine coordinates.
#[derive(Clone, Copy, PartialEq, Debug)]
#[allow(missing_docs)]
pub struct Extent {
    pub min: [f64; 3],
    pub max: [f64; 3],
}

/// Figures of a program.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Stats {
    /// Blocks executed.
    pub blocks: u32,
    /// Traverses, straight feeds, arcs.
    pub rapids: u32,
    /// Straight feeds.
    pub lines: u32,
    /// Arcs and helices.
    pub arcs: u32,
    /// Length of all traverses in mm.
    pub rapid_length_mm: f64,
    /// Length of all straight feeds in mm.
    pub line_length_mm: f64,
    /// Length of all arcs in mm.
    pub arc_length_mm: f64,
    /// Around all feed moves; `None` if there are none.
    pub feed_extent: Option<Extent>,
    /// Around all moves.
    pub extent: Option<Extent>,
    /// Time of all feed moves at the programmed feed, without acceleration, in seconds.
    pub feed_time_s: f64,
    /// Time of all dwells in seconds.
    pub dwell_time_s: f64,
}

impl Stats {
    /// Figures of `steps`, from `start` in machine coordinates (mm, degrees).
    pub fn of<'a>(steps: impl IntoIterator<Item = &'a Step>, start: Position) -> Self {
        let mut reader = Reader::new(start);
        steps.into_iter().for_each(|step| reader.read(step));
        reader.stats
    }

    /// Length of all feed moves in mm.
    pub fn feed_length_mm(&self) -> f64 {
        self.line_length_mm + self.arc_length_mm
    }

    /// Time without acceleration, in seconds; traverses count nothing, as the program does not say their rate.
    pub fn ideal_time_s(&self) -> f64 {
        self.feed_time_s + self.dwell_time_s
    }
}

/// Gathers [`Stats`] command by command.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Reader {
    tracker: Tracker,
    stats: Stats,
}

impl Reader {
    /// From `start` in machine coordinates (mm, degrees).
    pub fn new(start: Position) -> Self {
        Reader { tracker: Tracker::new(start), stats: Stats::default() }
    }

    /// The figures so far.
    pub fn stats(&self) -> &Stats {
        &self.stats
    }

    /// Counts a step.
    pub fn read(&mut self, step: &Step) {
        self.stats.blocks = self.stats.blocks.max(step.block);
        if let Canon::Dwell(seconds) = step.command {
            self.stats.dwell_time_s += seconds;
        }
        let Some(m) = self.tracker.follow(&step.command) else { return };
        let stats = &mut self.stats;
        let (count, length) = match m.kind {
            Kind::Rapid => (&mut stats.rapids, &mut stats.rapid_length_mm),
            Kind::Feed { .. } => (&mut stats.lines, &mut stats.line_length_mm),
            Kind::Arc { .. } => (&mut stats.arcs, &mut stats.arc_length_mm),
        };
        *count = count.saturating_add(1);
        *length += m.length();
        stats.feed_time_s += m.feed_time();
        let places = m.extremes();
        widen(&mut stats.extent, &places);
        if m.kind != Kind::Rapid {
            widen(&mut stats.feed_extent, &places);
        }
    }
}

fn widen(extent: &mut Option<Extent>, places: &[Position]) {
    for p in places {
        let p = [p.x, p.y, p.z];
        let e = extent.get_or_insert(Extent { min: p, max: p });
        for (i, &value) in p.iter().enumerate() {
            e.min[i] = e.min[i].min(value);
            e.max[i] = e.max[i].max(value);
        }
    }
}
