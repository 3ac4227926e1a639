//! Programs for the tests: canonical commands made by hand, so that the motion tests need no interpreter.
#![allow(dead_code)] // Each test file uses its own part.

pub mod oracle;
pub mod programs;
pub mod rig;
pub mod shop;

use takt_motion::canon::{Arc, Canon, Position, ProgramEnd, Step};

/// The 27 blocks of the contour of PC-T1: G, X, Y, I, J, incremental.
pub const PLATE: [(u8, f64, f64, f64, f64); 27] = [
    (0, 20., 30., 0., 0.),
    (1, 0., 60., 0., 0.),
    (1, 52., 0., 0., 0.),
    (3, 16., 16., 0., 16.),
    (3, -16., 16., -16., 0.),
    (1, -52., 0., 0., 0.),
    (1, 0., 72., 0., 0.),
    (2, 40., 40., 40., 0.),
    (1, 52., 0., 0., 0.),
    (1, 0., -68., 0., 0.),
    (3, 16., -16., 16., 0.),
    (3, 16., 16., 0., 16.),
    (1, 0., 68., 0., 0.),
    (1, 52., 0., 0., 0.),
    (2, 40., -40., 0., -40.),
    (1, 0., -72., 0., 0.),
    (1, -52., 0., 0., 0.),
    (3, -16., -16., 0., -16.),
    (3, 16., -16., 16., 0.),
    (1, 52., 0., 0., 0.),
    (1, 0., -60., 0., 0.),
    (1, -92., 0., 0., 0.),
    (1, 0., 68., 0., 0.),
    (3, -16., 16., -16., 0.),
    (3, -16., -16., 0., -16.),
    (1, 0., -68., 0., 0.),
    (1, -92., 0., 0., 0.),
];

/// Builds a program step by step.
pub struct Program {
    pub steps: Vec<Step>,
    pub at: Position,
}

impl Default for Program {
    fn default() -> Self {
        Self::from(0.0, 0.0)
    }
}

impl Program {
    pub fn from(x: f64, y: f64) -> Self {
        Self { steps: Vec::new(), at: Position { x, y, ..Position::default() } }
    }

    /// A block of one command.
    pub fn block(&mut self, command: Canon) -> &mut Self {
        let block = self.steps.last().map_or(0, |s| s.block) + 1;
        self.steps.push(Step { block, line: block, n: None, command });
        self
    }

    /// Another command in the same block.
    pub fn also(&mut self, command: Canon) -> &mut Self {
        let last = self.steps.last().expect("a block");
        let step = Step { command, ..last.clone() };
        self.steps.push(step);
        self
    }

    pub fn feed(&mut self, mm_min: f64) -> &mut Self {
        self.block(Canon::SetFeedRate(mm_min))
    }

    pub fn rapid(&mut self, x: f64, y: f64) -> &mut Self {
        (self.at.x, self.at.y) = (x, y);
        self.block(Canon::StraightTraverse(self.at))
    }

    pub fn line(&mut self, x: f64, y: f64) -> &mut Self {
        (self.at.x, self.at.y) = (x, y);
        self.block(Canon::StraightFeed(self.at))
    }

    /// Arc in XY round an absolute centre.
    pub fn arc(&mut self, x: f64, y: f64, cx: f64, cy: f64, rotation: i32) -> &mut Self {
        (self.at.x, self.at.y) = (x, y);
        let (first_end, second_end, first_axis, second_axis) = (x, y, cx, cy);
        let (axis_end_point, a, b, c) = (self.at.z, self.at.a, self.at.b, self.at.c);
        self.block(Canon::ArcFeed(Arc { first_end, second_end, first_axis, second_axis, rotation, axis_end_point, a, b, c }))
    }

    pub fn end(&mut self) -> Vec<Step> {
        self.block(Canon::ProgramEnd(ProgramEnd::EndOfFile));
        std::mem::take(&mut self.steps)
    }
}

/// The contour of PC-T1 at F60000, from (x, y).
pub fn plate(x: f64, y: f64) -> Vec<Step> {
    let mut p = Program::from(x, y);
    p.feed(60000.0);
    for (g, dx, dy, i, j) in PLATE {
        let (x, y) = (p.at.x, p.at.y);
        match g {
            0 => p.rapid(x + dx, y + dy),
            1 => p.line(x + dx, y + dy),
            2 => p.arc(x + dx, y + dy, x + i, y + j, -1),
            _ => p.arc(x + dx, y + dy, x + i, y + j, 1),
        };
    }
    p.end()
}

/// Small generator for test programs: the same numbers on every machine.
pub struct Random(pub u64);

impl Random {
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
    pub fn below(&mut self, n: usize) -> usize {
        (self.unit() * n as f64) as usize
    }
}

/// A program of lines and arcs: corners, tangent joints, slight bends, rapids, full circles, short and long elements.
pub fn random_program(seed: u64) -> Vec<Step> {
    let mut r = Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0xABCD);
    let mut p = Program::default();
    p.feed(r.between(100.0, 90_000.0));
    let mut heading = r.between(-3.0, 3.0);
    let scale = [0.02, 0.5, 5.0, 60.0][r.below(4)];
    for _ in 0..3 + r.below(12) {
        match r.below(8) {
            0 => {
                heading = r.between(-3.0, 3.0);
            }
            1 => heading += r.between(-0.05, 0.05),
            2 => {
                p.feed(r.between(100.0, 90_000.0));
            }
            _ => {}
        }
        let (sin, cos) = libm::sincos(heading);
        let (x, y) = (p.at.x, p.at.y);
        let size = scale * r.between(0.05, 1.0);
        match r.below(5) {
            0 => {
                p.rapid(x + size * cos, y + size * sin);
            }
            1 | 2 => {
                // Tangent arc: the centre is beside the start.
                let sense = if r.below(2) == 0 { 1.0 } else { -1.0 };
                let (cx, cy) = (x - sense * size * sin, y + sense * size * cos);
                let sweep = if r.below(8) == 0 { std::f64::consts::TAU } else { r.between(0.05, 5.0) };
                let angle = libm::atan2(y - cy, x - cx) + sense * sweep;
                let (s2, c2) = libm::sincos(angle);
                let end = if sweep > 6.0 { (x, y) } else { (cx + size * c2, cy + size * s2) };
                p.arc(end.0, end.1, cx, cy, if sense > 0.0 { 1 } else { -1 });
                heading += sense * sweep;
            }
            _ => {
                p.line(x + size * cos, y + size * sin);
            }
        }
    }
    p.end()
}
