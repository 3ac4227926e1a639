//! The listing of LinuxCNC's stand-alone interpreter: `    7 N..... STRAIGHT_FEED(1.0000, ...)`. What scripts that read it expect.
//! Names and arguments are those of that program where they differ from the report's. Runs: background.

use super::names::{plane_name, reference_name, units_name};
use crate::canon::{Arc, Canon, Direction, MotionMode, Position, ProgramEnd, Step, ToolEntry};
use std::fmt::Write;

/// Writes rows and counts them.
#[derive(Clone, Debug)]
pub struct Listing {
    rows: u32,
    /// The modes before the program have been listed.
    opened: bool,
    closed: bool,
    /// Millimetres in the length unit of the tool table.
    table_unit: f64,
}

impl Listing {
    /// No rows yet; `table_unit` is the length unit of the tool table in mm.
    pub fn new(table_unit: f64) -> Self {
        Listing { rows: 0, opened: false, closed: false, table_unit }
    }

    /// The rows of a step, each with its line end, added to `out`. A `PRINT` has none: its text goes to the console.
    pub fn step(&mut self, step: &Step, out: &mut String) {
        if !self.opened && step.line > 0 {
            self.open(out);
        }
        match &step.command {
            Canon::ProgramEnd(end) => {
                self.row(step.n, if *end == ProgramEnd::EndOfFile { "FINISH()" } else { "PROGRAM_END()" }, out);
                self.row(None, "ON_RESET()", out);
                self.closed = true;
            }
            command => {
                let text = call(command, self.table_unit);
                if !text.is_empty() {
                    self.row(step.n, &text, out);
                }
            }
        }
    }

    /// The rows behind the last step.
    pub fn finish(&mut self, out: &mut String) {
        if !self.opened {
            self.open(out);
        }
        if !self.closed {
            self.row(None, "ON_RESET()", out);
        }
        self.row(None, "ON_RESET()", out);
    }

    fn open(&mut self, out: &mut String) {
        self.opened = true;
        self.row(None, "ON_RESET()", out);
    }

    fn row(&mut self, n: Option<u32>, text: &str, out: &mut String) {
        self.rows = self.rows.wrapping_add(1);
        let _ = match n {
            Some(n) => writeln!(out, "{:5} N{n:<6}{text}", self.rows),
            None => writeln!(out, "{:5} N..... {text}", self.rows),
        };
    }
}

/// The call of a command; empty for what that program does not list.
fn call(command: &Canon, table_unit: f64) -> String {
    match command {
        Canon::SelectPlane(p) => format!("SELECT_PLANE({})", plane_name(*p)),
        Canon::UseLengthUnits(u) => format!("USE_LENGTH_UNITS({})", units_name(*u)),
        Canon::SetFeedReference(r) => format!("SET_FEED_REFERENCE({})", reference_name(*r)),
        Canon::SetG5xOffset(i, p) => format!("SET_G5X_OFFSET({i}, {})", six(p)),
        Canon::SetG92Offset(p) => format!("SET_G92_OFFSET({})", six(p)),
        Canon::SetXyRotation(r) => format!("SET_XY_ROTATION({r:.4})"),
        Canon::StraightTraverse(p) => format!("STRAIGHT_TRAVERSE({})", six(p)),
        Canon::StraightFeed(p) => format!("STRAIGHT_FEED({})", six(p)),
        Canon::StraightProbe(p, _) => format!("STRAIGHT_PROBE({})", six(p)),
        Canon::RigidTap(p) => format!("RIGID_TAP({:.4}, {:.4}, {:.4})", p.x, p.y, p.z),
        Canon::ArcFeed(a) => arc(a),
        Canon::NurbsFeed(n) => format!("NURBS_FEED({}, ...)", n.points.len()),
        Canon::SetFeedRate(f) => format!("SET_FEED_RATE({f:.4})"),
        Canon::SetFeedMode(per_rev) => format!("SET_FEED_MODE(0, {})", u8::from(*per_rev)),
        Canon::SetMotionControlMode(mode) => mode_call(*mode),
        Canon::SetNaivecamTolerance(t) => format!("SET_NAIVECAM_TOLERANCE({t:.4})"),
        Canon::Dwell(s) => format!("DWELL({s:.4})"),
        Canon::StartSpeedFeedSync(k) => format!("START_SPEED_FEED_SYNC({k:.6},0)"),
        Canon::StopSpeedFeedSynch => "STOP_SPEED_FEED_SYNCH()".into(),
        Canon::SetOriginOffsets(_) | Canon::WaitInput(_) | Canon::Print(_) | Canon::ReadPlc(_) | Canon::SetPlc(..) => {
            String::new()
        }
        other => switch(other, table_unit),
    }
}

fn switch(command: &Canon, table_unit: f64) -> String {
    match command {
        Canon::SetSpindleSpeed(s) => format!("SET_SPINDLE_SPEED(0, {s:.4})"),
        Canon::SetSpindleMode(max) => format!("SET_SPINDLE_MODE(0 {:.4})", max.unwrap_or(0.0)),
        Canon::StartSpindleClockwise => "START_SPINDLE_CLOCKWISE(0)".into(),
        Canon::StartSpindleCounterclockwise => "START_SPINDLE_COUNTERCLOCKWISE(0)".into(),
        Canon::StopSpindleTurning => "STOP_SPINDLE_TURNING(0)".into(),
        Canon::OrientSpindle(angle, Direction::Clockwise) => format!("ORIENT_SPINDLE(0, {angle:.4}, 2)"),
        Canon::OrientSpindle(angle, Direction::Counterclockwise) => format!("ORIENT_SPINDLE(0, {angle:.4}, 3)"),
        Canon::OrientSpindleMode(angle, mode) => format!("ORIENT_SPINDLE(0, {angle:.4}, {mode})"),
        Canon::WaitOrientComplete(s) => format!("SPINDLE.0.WAIT_ORIENT_COMPLETE({s:.4})"),
        Canon::EnableSpeedOverride => "ENABLE_SPEED_OVERRIDE(0)".into(),
        Canon::DisableSpeedOverride => "DISABLE_SPEED_OVERRIDE(0)".into(),
        Canon::UseToolLengthOffset(z) => tool_offset(&Position { z: *z, ..Position::default() }),
        Canon::UseToolLengthOffsets(p) => tool_offset(p),
        Canon::SetToolTableEntry(entry) => tool_entry(entry, table_unit),
        Canon::SetMotionOutputValue(i, v) => format!("SET_MOTION_OUTPUT_VALUE({i},{v:.6})"),
        Canon::SetAuxOutputValue(i, v) => format!("SET_AUX_OUTPUT_VALUE({i},{v:.6})"),
        Canon::Comment(text) => format!("COMMENT(\"{text}\")"),
        Canon::Message(text) => format!("MESSAGE(\"{text}\")"),
        Canon::Log(text) => format!("LOG(\"{text}\")"),
        Canon::LogOpen(text) => format!("LOGOPEN(\"{text}\")"),
        Canon::LogAppend(text) => format!("LOGAPPEND(\"{text}\")"),
        other => super::command(other),
    }
}

/// Numbers with 4 decimals and commas between them.
fn list(out: &mut String, numbers: &[f64]) {
    for (i, number) in numbers.iter().enumerate() {
        if i > 0 {
            out.push_str(", ");
        }
        fixed4(out, *number);
    }
}

/// `{:.4}`, in a quick way for numbers of usual size that are not near a tie of the rounding.
fn fixed4(out: &mut String, value: f64) {
    let scaled = value.abs() * 1e4;
    let near = scaled.round();
    if scaled >= 1e13 || ((scaled - near).abs() - 0.5).abs() < 1e-3 || !value.is_finite() {
        let _ = write!(out, "{value:.4}");
        return;
    }
    if value.is_sign_negative() {
        out.push('-');
    }
    let (whole, part) = (near as u64 / 10_000, near as u64 % 10_000);
    let mut digits = [b'0'; 20];
    let (mut i, mut rest) = (digits.len(), part);
    for _ in 0..4 {
        i -= 1;
        digits[i] = b'0' + (rest % 10) as u8;
        rest /= 10;
    }
    i -= 1;
    digits[i] = b'.';
    rest = whole;
    loop {
        i -= 1;
        digits[i] = b'0' + (rest % 10) as u8;
        rest /= 10;
        if rest == 0 {
            break;
        }
    }
    out.push_str(std::str::from_utf8(&digits[i..]).unwrap_or("0.0000"));
}

fn six(p: &Position) -> String {
    let mut out = String::with_capacity(64);
    list(&mut out, &<[f64; 6]>::from(*p));
    out
}

fn arc(a: &Arc) -> String {
    let mut out = String::with_capacity(96);
    out.push_str("ARC_FEED(");
    list(&mut out, &[a.first_end, a.second_end, a.first_axis, a.second_axis]);
    let _ = write!(out, ", {}, ", a.rotation);
    list(&mut out, &[a.axis_end_point, a.a, a.b, a.c]);
    out.push(')');
    out
}

fn mode_call(mode: MotionMode) -> String {
    match mode {
        MotionMode::ExactStop => "SET_MOTION_CONTROL_MODE(CANON_EXACT_STOP)".into(),
        MotionMode::ExactPath => "SET_MOTION_CONTROL_MODE(CANON_EXACT_PATH)".into(),
        MotionMode::Continuous(t) => format!("SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, {t:.6})"),
    }
}

fn tool_offset(p: &Position) -> String {
    let rotary = format!("{:.4} {:.4} {:.4}", p.a, p.b, p.c);
    format!("USE_TOOL_LENGTH_OFFSET({:.4} {:.4} {:.4}, {rotary}, 0.0000 0.0000 0.0000)", p.x, p.y, p.z)
}

fn tool_entry(entry: &ToolEntry, unit: f64) -> String {
    let length = |i: usize| if (3..6).contains(&i) { entry.offset[i] } else { entry.offset[i] / unit };
    let offsets = (0..9).map(|i| format!("{:.4}", length(i))).collect::<Vec<_>>().join(" ");
    let shape = format!("{:.4}, {:.4}, {}", entry.front, entry.back, entry.orientation);
    format!("SET_TOOL_TABLE_ENTRY({}, {}, {offsets}, {shape})", entry.index, entry.tool)
}

#[cfg(test)]
mod tests {
    use super::fixed4;

    #[test]
    fn the_quick_way_prints_the_same() {
        let mut x = 99_u64;
        for i in 0..200_000 {
            x = x.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let value = match i % 4 {
                0 => f64::from_bits(x),
                1 => (x >> 40) as f64 / 100_000.0,
                2 => -((x >> 30) as f64) / 1e6,
                _ => (x >> 60) as f64 / 16.0 + 0.00005,
            };
            let mut out = String::new();
            fixed4(&mut out, value);
            assert_eq!(out, format!("{value:.4}"), "{value:?}");
        }
    }
}
