//! The listing of LinuxCNC's stand-alone interpreter: `    7 N..... STRAIGHT_FEED(1.0000, ...)`. What scripts that read it expect.
//! Names and arguments are those of that program where they differ from the report's. Runs: background.

use super::names::{plane_name, reference_name, units_name};
use crate::canon::{Arc, Canon, Direction, MotionMode, Position, ProgramEnd, Step, ToolEntry};

/// Writes rows and counts them.
#[derive(Clone, Debug)]
pub struct Listing {
    rows: u32,
    /// The modes before the program have been listed.
    opened: bool,
    closed: bool,
    /// Millimetres in the length unit of the tool table.
    table_unit: f64,
    /// The row in the making.
    bytes: Vec<u8>,
}

impl Listing {
    /// No rows yet; `table_unit` is the length unit of the tool table in mm.
    pub fn new(table_unit: f64) -> Self {
        Listing { rows: 0, opened: false, closed: false, table_unit, bytes: Vec::new() }
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
            Canon::StraightTraverse(p) => self.quick(step.n, "STRAIGHT_TRAVERSE(", &<[f64; 6]>::from(*p), out),
            Canon::StraightFeed(p) => self.quick(step.n, "STRAIGHT_FEED(", &<[f64; 6]>::from(*p), out),
            Canon::Dwell(seconds) => self.quick(step.n, "DWELL(", &[*seconds], out),
            Canon::SetFeedRate(rate) => self.quick(step.n, "SET_FEED_RATE(", &[*rate], out),
            Canon::ArcFeed(a) => {
                self.head(step.n);
                arc(a, &mut self.bytes);
                self.flush(out);
            }
            command => {
                let text = call(command, self.table_unit);
                if !text.is_empty() {
                    self.row(step.n, &text, out);
                }
            }
        }
    }

    /// The calls that programs consist of, without a text between.
    fn quick(&mut self, n: Option<u32>, name: &str, numbers: &[f64], out: &mut String) {
        self.head(n);
        self.bytes.extend_from_slice(name.as_bytes());
        list(&mut self.bytes, numbers);
        self.bytes.extend_from_slice(b")\n");
        self.flush(out);
    }

    /// The row as text: all of it is ASCII, and one look at it is quicker than one for each number.
    fn flush(&mut self, out: &mut String) {
        out.push_str(std::str::from_utf8(&self.bytes).unwrap_or_default());
        self.bytes.clear();
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
        self.head(n);
        self.flush(out);
        out.push_str(text);
        out.push('\n');
    }

    /// Number and N word of a row.
    fn head(&mut self, n: Option<u32>) {
        self.rows = self.rows.wrapping_add(1);
        padded(&mut self.bytes, self.rows);
        match n {
            Some(n) => self.bytes.extend_from_slice(format!(" N{n:<6}").as_bytes()),
            None => self.bytes.extend_from_slice(b" N..... "),
        }
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
        Canon::StraightProbe(p, _) => format!("STRAIGHT_PROBE({})", six(p)),
        Canon::RigidTap(p) => format!("RIGID_TAP({:.4}, {:.4}, {:.4})", p.x, p.y, p.z),
        Canon::NurbsFeed(n) => format!("NURBS_FEED({}, ...)", n.points.len()),
        Canon::SetFeedMode(per_rev) => format!("SET_FEED_MODE(0, {})", u8::from(*per_rev)),
        Canon::SetMotionControlMode(mode) => mode_call(*mode),
        Canon::SetNaivecamTolerance(t) => format!("SET_NAIVECAM_TOLERANCE({t:.4})"),
        Canon::StartSpeedFeedSync(k) => format!("START_SPEED_FEED_SYNC({k:.6},0)"),
        Canon::StopSpeedFeedSynch => "STOP_SPEED_FEED_SYNCH()".into(),
        Canon::SetOriginOffsets(_) | Canon::WaitInput(_) | Canon::Print(_) => String::new(),
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
fn list(out: &mut Vec<u8>, numbers: &[f64]) {
    for (i, number) in numbers.iter().enumerate() {
        if i > 0 {
            out.extend_from_slice(b", ");
        }
        fixed4(out, *number);
    }
}

/// `{:.4}`, in a quick way for numbers of usual size that are not near a tie of the rounding.
fn fixed4(out: &mut Vec<u8>, value: f64) {
    if value.to_bits() == 0 {
        return out.extend_from_slice(b"0.0000");
    }
    let scaled = value.abs() * 1e4;
    let near = (scaled + 0.5) as u64;
    if scaled >= 1e13 || ((scaled - near as f64).abs() - 0.5).abs() < 1e-3 || !value.is_finite() {
        out.extend_from_slice(format!("{value:.4}").as_bytes());
        return;
    }
    let mut text = [b'0'; ROOM];
    text[ROOM - 5] = b'.';
    digits(&mut text, ROOM, near % 10_000);
    let mut start = digits(&mut text, ROOM - 5, near / 10_000);
    if value.is_sign_negative() {
        start -= 1;
        text[start] = b'-';
    }
    out.extend_from_slice(&text[start..]);
}

/// `{:5}`.
fn padded(out: &mut Vec<u8>, number: u32) {
    let mut text = [b' '; ROOM];
    let start = digits(&mut text, ROOM, u64::from(number)).min(ROOM - 5);
    out.extend_from_slice(&text[start..]);
}

/// Bytes for a number of 13 digits, a point and a sign.
const ROOM: usize = 24;

/// Writes `number` so that it ends before `end`; where it starts.
fn digits(text: &mut [u8; ROOM], end: usize, mut number: u64) -> usize {
    let mut i = end;
    loop {
        i -= 1;
        text[i] = b'0' + (number % 10) as u8;
        number /= 10;
        if number == 0 || i == 0 {
            return i;
        }
    }
}

fn six(p: &Position) -> String {
    let mut out = Vec::with_capacity(64);
    list(&mut out, &<[f64; 6]>::from(*p));
    String::from_utf8(out).unwrap_or_default()
}

fn arc(a: &Arc, out: &mut Vec<u8>) {
    out.extend_from_slice(b"ARC_FEED(");
    list(out, &[a.first_end, a.second_end, a.first_axis, a.second_axis]);
    out.extend_from_slice(b", ");
    if a.rotation < 0 {
        out.push(b'-');
    }
    let mut text = [b'0'; ROOM];
    let start = digits(&mut text, ROOM, u64::from(a.rotation.unsigned_abs()));
    out.extend_from_slice(&text[start..]);
    out.extend_from_slice(b", ");
    list(out, &[a.axis_end_point, a.a, a.b, a.c]);
    out.extend_from_slice(b")\n");
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
    use super::{fixed4, padded};

    #[test]
    fn row_numbers_are_padded() {
        for number in [0, 7, 99_999, 100_000, u32::MAX] {
            let mut out = Vec::new();
            padded(&mut out, number);
            assert_eq!(out, format!("{number:5}").into_bytes());
        }
    }

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
            let mut out = Vec::new();
            fixed4(&mut out, value);
            assert_eq!(out, format!("{value:.4}").into_bytes(), "{value:?}");
        }
    }
}
