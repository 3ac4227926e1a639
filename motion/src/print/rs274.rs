//! The listing of LinuxCNC's stand-alone interpreter: `    7 N..... STRAIGHT_FEED(1.0000, ...)`. What scripts that read it expect.
//! Names and arguments are those of that program where they differ from the report's. Runs: background.

use super::back::{Back, Count};
use crate::canon::{Arc, Canon, Direction, MotionMode, Position, ProgramEnd, Step, ToolEntry};

/// Writes rows and counts them.
#[derive(Clone, Debug)]
pub struct Listing {
    count: Count,
    /// The modes before the program have been listed.
    opened: bool,
    closed: bool,
    /// Millimetres in the length unit of the tool table.
    table_unit: f64,
    /// The row in the making.
    back: Back,
}

impl Listing {
    /// No rows yet; `table_unit` is the length unit of the tool table in mm.
    pub fn new(table_unit: f64) -> Self {
        Listing { count: Count::default(), opened: false, closed: false, table_unit, back: Back::default() }
    }

    /// The rows of a step in UTF-8, each with its line end, added to `out`. A `PRINT` has none: its text goes to the console.
    pub fn step(&mut self, step: &Step, out: &mut Vec<u8>) {
        if !self.opened && step.line > 0 {
            self.open(out);
        }
        match &step.command {
            Canon::ProgramEnd(end) => {
                self.row(step.n, if *end == ProgramEnd::EndOfFile { "FINISH()" } else { "PROGRAM_END()" }, out);
                self.row(None, "ON_RESET()", out);
                self.closed = true;
            }
            Canon::StraightTraverse(p) => self.straight(step.n, b"STRAIGHT_TRAVERSE(", *p, out),
            Canon::StraightFeed(p) => self.straight(step.n, b"STRAIGHT_FEED(", *p, out),
            Canon::Dwell(seconds) => self.quick(step.n, b"DWELL(", *seconds, out),
            Canon::SetFeedRate(rate) => self.quick(step.n, b"SET_FEED_RATE(", *rate, out),
            Canon::ArcFeed(a) => self.arc(step.n, a, out),
            command => {
                let text = call(command, self.table_unit);
                if !text.is_empty() {
                    self.row(step.n, &text, out);
                }
            }
        }
    }

    /// The calls that programs consist of.
    fn straight<const N: usize>(&mut self, n: Option<u32>, name: &[u8; N], to: Position, out: &mut Vec<u8>) {
        self.back.put(*b")\n");
        self.back.axes(to.into());
        self.back.put(*name);
        self.head(n, out);
    }

    fn quick<const N: usize>(&mut self, n: Option<u32>, name: &[u8; N], number: f64, out: &mut Vec<u8>) {
        self.back.put(*b")\n");
        self.back.fixed4(number);
        self.back.put(*name);
        self.head(n, out);
    }

    fn arc(&mut self, n: Option<u32>, a: &Arc, out: &mut Vec<u8>) {
        let back = &mut self.back;
        back.put(*b")\n");
        back.numbers(&[a.axis_end_point, a.a, a.b, a.c]);
        back.put(*b", ");
        back.digits(u64::from(a.rotation.unsigned_abs()));
        back.text(if a.rotation < 0 { ", -" } else { ", " });
        back.numbers(&[a.first_end, a.second_end, a.first_axis, a.second_axis]);
        back.put(*b"ARC_FEED(");
        self.head(n, out);
    }

    /// N word and number in front of a row, which is then whole.
    fn head(&mut self, n: Option<u32>, out: &mut Vec<u8>) {
        let back = &mut self.back;
        match n {
            None => back.put(*b" N..... "),
            Some(n) => {
                back.padding(n.checked_ilog10().map_or(5, |log| 5_u32.saturating_sub(log)) as usize);
                back.digits(u64::from(n));
                back.put(*b" N");
            }
        }
        back.count(&mut self.count);
        out.extend_from_slice(back.bytes());
        back.clear();
    }

    /// The rows behind the last step, and those of the exit of the process if `exits`.
    pub fn finish(&mut self, exits: bool, out: &mut Vec<u8>) {
        if !self.opened {
            self.open(out);
        }
        if !self.closed {
            self.row(None, "ON_RESET()", out);
        }
        if exits {
            self.row(None, "ON_RESET()", out);
        }
    }

    fn open(&mut self, out: &mut Vec<u8>) {
        self.opened = true;
        self.row(None, "ON_RESET()", out);
    }

    fn row(&mut self, n: Option<u32>, text: &str, out: &mut Vec<u8>) {
        self.head(n, out);
        out.extend_from_slice(text.as_bytes());
        out.push(b'\n');
    }
}

/// The call of a command; empty for what that program does not list.
fn call(command: &Canon, table_unit: f64) -> String {
    match command {
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
        Canon::Remark(text) => format!("COMMENT(\"interpreter: {text}\")"),
        Canon::Message(text) => format!("MESSAGE(\"{text}\")"),
        Canon::Log(text) => format!("LOG(\"{text}\")"),
        Canon::LogOpen(text) => format!("LOGOPEN(\"{text}\")"),
        Canon::LogAppend(text) => format!("LOGAPPEND(\"{text}\")"),
        other => super::command(other),
    }
}

fn six(p: &Position) -> String {
    let mut back = Back::default();
    back.numbers(&<[f64; 6]>::from(*p));
    String::from_utf8_lossy(back.bytes()).into_owned()
}

/// Twice a row of a drilling cycle: without a text between.
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
    use super::*;

    #[test]
    fn numbers_and_n_words_are_padded() {
        let mut listing = Listing { opened: true, ..Listing::new(1.0) };
        for (row, n) in [(1, None), (2, Some(0)), (3, Some(7)), (4, Some(999_999)), (5, Some(u32::MAX))] {
            let mut out = Vec::new();
            let step = Step { block: 1, line: 1, n, command: Canon::Dwell(0.5) };
            listing.step(&step, &mut out);
            let n = n.map_or("..... ".to_owned(), |n| format!("{n:<6}"));
            assert_eq!(out, format!("{:5} N{n}DWELL(0.5000)\n", row).into_bytes());
        }
    }
}
