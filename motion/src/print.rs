//! Prints canonical commands, one a line, and reads the lines back (CM-04, CM-T16): `NAME(ARG, ARG, ...)`.
//!
//! Names and enumerators are those of NISTIR 5970. Numbers have 4 decimals and no negative zero; counts (turns, tools, M codes) have none; strings
//! stand in double quotes with `\"`, `\\` and `\n`. Extensions carry LinuxCNC's names: `PROGRAM_STOP()`, `OPTIONAL_PROGRAM_STOP()`,
//! `PROGRAM_END()` whichever word ended the program (it reads back as M2), a tolerance behind `CANON_CONTINUOUS`. A user M code is
//! `USER_M_CODE(number)` with `P` and `Q` words behind the number if it has them.

mod back;
mod names;
mod parse;
pub mod rs274;

pub use parse::{BadLine, Line, parse};

use crate::canon::{Arc, Canon, MotionMode, Nurbs, Position, Step, ToolEntry};
use names::{direction_name, plane_name, reference_name, units_name};

/// The line for a command, without a line end.
pub fn command(command: &Canon) -> String {
    let (name, args) = parts(command);
    format!("{name}({args})")
}

/// The line for a step; `numbered` puts the source line first, as in `N00012 `.
pub fn line(step: &Step, numbered: bool) -> String {
    let prefix = if numbered { format!("N{:05} ", step.line) } else { String::new() };
    prefix + &command(&step.command)
}

fn parts(command: &Canon) -> (&'static str, String) {
    match command {
        Canon::SelectPlane(p) => ("SELECT_PLANE", plane_name(*p).into()),
        Canon::SetOriginOffsets(p) => ("SET_ORIGIN_OFFSETS", position(p)),
        Canon::UseLengthUnits(u) => ("USE_LENGTH_UNITS", units_name(*u).into()),
        Canon::SetTraverseRate(rate) => ("SET_TRAVERSE_RATE", number(*rate)),
        Canon::StraightTraverse(p) => ("STRAIGHT_TRAVERSE", position(p)),
        Canon::SetFeedRate(rate) => ("SET_FEED_RATE", number(*rate)),
        Canon::SetFeedReference(r) => ("SET_FEED_REFERENCE", reference_name(*r).into()),
        Canon::SetMotionControlMode(mode) => ("SET_MOTION_CONTROL_MODE", mode_text(*mode)),
        Canon::ArcFeed(a) => ("ARC_FEED", arc(a)),
        Canon::Dwell(seconds) => ("DWELL", number(*seconds)),
        Canon::StraightFeed(p) => ("STRAIGHT_FEED", position(p)),
        Canon::SetSpindleSpeed(speed) => ("SET_SPINDLE_SPEED", number(*speed)),
        Canon::OrientSpindle(angle, d) => ("ORIENT_SPINDLE", format!("{}, {}", number(*angle), direction_name(*d))),
        Canon::ChangeTool(slot) => ("CHANGE_TOOL", slot.to_string()),
        Canon::SelectTool(slot) => ("SELECT_TOOL", slot.to_string()),
        Canon::UseToolLengthOffset(length) => ("USE_TOOL_LENGTH_OFFSET", number(*length)),
        Canon::Comment(text) => ("COMMENT", quoted(text)),
        Canon::Message(text) => ("MESSAGE", quoted(text)),
        Canon::UserMCode { code, p, q } => ("USER_M_CODE", user(*code, *p, *q)),
        Canon::SetXyRotation(degrees) => ("SET_XY_ROTATION", number(*degrees)),
        Canon::SetG5xOffset(index, p) => ("SET_G5X_OFFSET", format!("{index}, {}", position(p))),
        Canon::SetG92Offset(p) => ("SET_G92_OFFSET", position(p)),
        Canon::UseToolLengthOffsets(p) => ("USE_TOOL_LENGTH_OFFSETS", position(p)),
        Canon::SetFeedMode(per_rev) => ("SET_FEED_MODE", u8::from(*per_rev).to_string()),
        Canon::SetSpindleMode(max) => ("SET_SPINDLE_MODE", number(max.unwrap_or(0.0))),
        Canon::SetNaivecamTolerance(length) => ("SET_NAIVECAM_TOLERANCE", number(*length)),
        Canon::Remark(text) => ("COMMENT", quoted(text)),
        Canon::StartChange => ("START_CHANGE", String::new()),
        Canon::ChangeToolNumber(tool) => ("CHANGE_TOOL_NUMBER", tool.to_string()),
        Canon::SetToolTableEntry(entry) => ("SET_TOOL_TABLE_ENTRY", tool_entry(entry)),
        Canon::OrientSpindleMode(angle, mode) => ("ORIENT_SPINDLE_MODE", format!("{}, {mode}", number(*angle))),
        Canon::WaitOrientComplete(seconds) => ("WAIT_ORIENT_COMPLETE", number(*seconds)),
        Canon::StartSpeedFeedSync(pitch) => ("START_SPEED_FEED_SYNC", number(*pitch)),
        Canon::StraightProbe(p, probe) => {
            ("STRAIGHT_PROBE", format!("{}, {}, {}", position(p), u8::from(probe.towards), u8::from(probe.must_trip)))
        }
        Canon::TurnProbeOn => ("TURN_PROBE_ON", String::new()),
        Canon::TurnProbeOff => ("TURN_PROBE_OFF", String::new()),
        Canon::RigidTap(p) => ("RIGID_TAP", position(p)),
        Canon::NurbsFeed(nurbs) => ("NURBS_FEED", nurbs_args(nurbs)),
        Canon::EnableAdaptiveFeed => ("ENABLE_ADAPTIVE_FEED", String::new()),
        Canon::DisableAdaptiveFeed => ("DISABLE_ADAPTIVE_FEED", String::new()),
        Canon::EnableFeedHold => ("ENABLE_FEED_HOLD", String::new()),
        Canon::DisableFeedHold => ("DISABLE_FEED_HOLD", String::new()),
        Canon::SetMotionOutputBit(i) => ("SET_MOTION_OUTPUT_BIT", i.to_string()),
        Canon::ClearMotionOutputBit(i) => ("CLEAR_MOTION_OUTPUT_BIT", i.to_string()),
        Canon::SetAuxOutputBit(i) => ("SET_AUX_OUTPUT_BIT", i.to_string()),
        Canon::ClearAuxOutputBit(i) => ("CLEAR_AUX_OUTPUT_BIT", i.to_string()),
        Canon::SetMotionOutputValue(i, v) => ("SET_MOTION_OUTPUT_VALUE", format!("{i}, {}", number(*v))),
        Canon::SetAuxOutputValue(i, v) => ("SET_AUX_OUTPUT_VALUE", format!("{i}, {}", number(*v))),
        Canon::WaitInput(i) => ("WAIT_INPUT", format!("{}, {}, {}, {}", i.number, u8::from(i.analog), i.wait, number(i.timeout))),
        Canon::ReadPlc(names) => ("READ_PLC", names.iter().map(|n| quoted(n)).collect::<Vec<_>>().join(", ")),
        Canon::SetPlc(name, value) => ("SET_PLC", format!("{}, {}", quoted(name), number(*value))),
        Canon::Print(text) => ("PRINT", quoted(text)),
        Canon::Log(text) => ("LOG", quoted(text)),
        Canon::LogOpen(text) => ("LOGOPEN", quoted(text)),
        Canon::LogAppend(text) => ("LOGAPPEND", quoted(text)),
        Canon::LogClose => ("LOGCLOSE", String::new()),
        Canon::ProgramEnd(_) => ("PROGRAM_END", String::new()),
        Canon::InitCanon => ("INIT_CANON", String::new()),
        Canon::EndCanon => ("END_CANON", String::new()),
        Canon::StartSpeedFeedSynch => ("START_SPEED_FEED_SYNCH", String::new()),
        Canon::StopSpeedFeedSynch => ("STOP_SPEED_FEED_SYNCH", String::new()),
        Canon::Stop => ("STOP", String::new()),
        Canon::StartSpindleClockwise => ("START_SPINDLE_CLOCKWISE", String::new()),
        Canon::StartSpindleCounterclockwise => ("START_SPINDLE_COUNTERCLOCKWISE", String::new()),
        Canon::StopSpindleTurning => ("STOP_SPINDLE_TURNING", String::new()),
        Canon::FloodOff => ("FLOOD_OFF", String::new()),
        Canon::FloodOn => ("FLOOD_ON", String::new()),
        Canon::MistOff => ("MIST_OFF", String::new()),
        Canon::MistOn => ("MIST_ON", String::new()),
        Canon::DisableFeedOverride => ("DISABLE_FEED_OVERRIDE", String::new()),
        Canon::DisableSpeedOverride => ("DISABLE_SPEED_OVERRIDE", String::new()),
        Canon::EnableFeedOverride => ("ENABLE_FEED_OVERRIDE", String::new()),
        Canon::EnableSpeedOverride => ("ENABLE_SPEED_OVERRIDE", String::new()),
        Canon::PalletShuttle => ("PALLET_SHUTTLE", String::new()),
        Canon::ProgramStop => ("PROGRAM_STOP", String::new()),
        Canon::OptionalProgramStop => ("OPTIONAL_PROGRAM_STOP", String::new()),
    }
}

/// 4 decimals, no negative zero.
pub fn number(value: f64) -> String {
    let text = format!("{value:.4}");
    match text.strip_prefix('-') {
        Some(digits) if digits.bytes().all(|b| matches!(b, b'0' | b'.')) => digits.to_owned(),
        _ => text,
    }
}

fn numbers(values: &[f64]) -> String {
    values.iter().map(|&v| number(v)).collect::<Vec<_>>().join(", ")
}

fn position(p: &Position) -> String {
    numbers(&<[f64; 6]>::from(*p))
}

fn arc(a: &Arc) -> String {
    let plane = numbers(&[a.first_end, a.second_end, a.first_axis, a.second_axis]);
    format!("{plane}, {}, {}", a.rotation, numbers(&[a.axis_end_point, a.a, a.b, a.c]))
}

fn tool_entry(entry: &ToolEntry) -> String {
    let head = format!("{}, {}, {}", entry.index, entry.tool, entry.pocket);
    let tail = numbers(&[entry.diameter, entry.front, entry.back]);
    format!("{head}, {}, {tail}, {}", numbers(&entry.offset), entry.orientation)
}

fn nurbs_args(nurbs: &Nurbs) -> String {
    let points: Vec<f64> = nurbs.points.iter().flatten().copied().collect();
    format!("{}, {}, {}", nurbs.points.len(), nurbs.order, numbers(&points))
}

fn mode_text(mode: MotionMode) -> String {
    match mode {
        MotionMode::ExactStop => "CANON_EXACT_STOP".into(),
        MotionMode::ExactPath => "CANON_EXACT_PATH".into(),
        MotionMode::Continuous(tolerance) => format!("CANON_CONTINUOUS, {}", number(tolerance)),
    }
}

fn user(code: u32, p: Option<f64>, q: Option<f64>) -> String {
    let word = |letter, value: Option<f64>| value.map_or_else(String::new, |v| format!(", {letter}{}", number(v)));
    format!("{code}{}{}", word('P', p), word('Q', q))
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n"))
}

#[cfg(test)]
mod tests {
    use super::parse::BARE;
    use super::*;
    use crate::canon::{Direction, FeedReference, Plane, Units};

    /// One of each command, with numbers of 4 decimals.
    fn samples() -> Vec<Canon> {
        let p = Position { x: 1.5, y: -2.25, z: 0.0001, a: 90.0, b: -0.5, c: 720.0 };
        let arc = Arc {
            first_end: 1.0,
            second_end: -2.0,
            first_axis: 3.5,
            second_axis: 4.0,
            rotation: -2,
            axis_end_point: 5.0,
            a: 6.0,
            b: 7.0,
            c: 8.0,
        };
        let mut all: Vec<Canon> = BARE.iter().map(|(_, c)| c.clone()).collect();
        all.extend([Plane::Xy, Plane::Yz, Plane::Xz].map(Canon::SelectPlane));
        all.extend([Units::Inches, Units::Mm, Units::Cm].map(Canon::UseLengthUnits));
        all.extend([MotionMode::ExactStop, MotionMode::ExactPath, MotionMode::Continuous(0.05)].map(Canon::SetMotionControlMode));
        all.extend([FeedReference::Workpiece, FeedReference::Xyz].map(Canon::SetFeedReference));
        all.extend([Canon::SetOriginOffsets(p), Canon::StraightTraverse(p), Canon::StraightFeed(p), Canon::ArcFeed(arc)]);
        all.extend([Canon::SetTraverseRate(1.0), Canon::SetFeedRate(2.5), Canon::Dwell(0.25), Canon::SetSpindleSpeed(3000.0)]);
        all.extend([Canon::ChangeTool(7), Canon::SelectTool(0), Canon::UseToolLengthOffset(12.5)]);
        all.extend([Direction::Clockwise, Direction::Counterclockwise].map(|d| Canon::OrientSpindle(359.5, d)));
        all.extend(["", "a, b) \"c\" \\ \n", "(", "ä"].map(|t| Canon::Comment(t.into())));
        all.push(Canon::Message(" hello".into()));
        all.push(Canon::ReadPlc(vec!["speed".into(), "main.levels[2]".into()]));
        all.push(Canon::SetPlc("main.level".into(), -2.5));
        all.extend(
            [(None, None), (Some(1.5), None), (None, Some(-2.0)), (Some(1.0), Some(2.0))].map(|(p, q)| Canon::UserMCode {
                code: 110,
                p,
                q,
            }),
        );
        all
    }

    /// CM-T16
    #[test]
    fn every_command_prints_and_reads_back() {
        for sample in samples() {
            let text = command(&sample);
            assert!(!text.starts_with('('), "{sample:?} has no name");
            assert_eq!(parse(&text), Ok(Line { number: None, command: sample }), "{text}");
            assert_eq!(text.lines().count(), 1);
        }
    }

    #[test]
    fn numbers_have_four_decimals_and_no_negative_zero() {
        let cases = [
            (0.0, "0.0000"),
            (-0.0, "0.0000"),
            (-0.00004, "0.0000"),
            (-0.00006, "-0.0001"),
            (1.0 / 3.0, "0.3333"),
            (1e12, "1000000000000.0000"),
        ];
        for (value, want) in cases {
            assert_eq!(number(value), want);
        }
    }

    #[test]
    fn source_line_comes_first() {
        let step = Step { block: 1, line: 12, n: Some(3), command: Canon::Dwell(1.0) };
        assert_eq!(line(&step, true), "N00012 DWELL(1.0000)");
        assert_eq!(line(&step, false), "DWELL(1.0000)");
        assert_eq!(parse("N00012 DWELL(1.0000)"), Ok(Line { number: Some(12), command: Canon::Dwell(1.0) }));
    }

    #[test]
    fn what_is_no_listing() {
        let cases = [
            ("", BadLine::Form),
            ("DWELL", BadLine::Form),
            ("DWELL(1.0", BadLine::Form),
            ("dwell(1.0)", BadLine::Form),
            ("(1.0)", BadLine::Form),
            ("HOLD(1.0)", BadLine::Name),
            ("DWELL()", BadLine::Arguments),
            ("DWELL(1.0, 2.0)", BadLine::Arguments),
            ("DWELL(inf)", BadLine::Arguments),
            ("STOP(1)", BadLine::Arguments),
            ("STRAIGHT_FEED(1, 2, 3)", BadLine::Arguments),
            ("ARC_FEED(1, 2, 3, 4)", BadLine::Arguments),
            ("ARC_FEED(1, 2, 3, 4, 1.5, 6, 7, 8, 9)", BadLine::Arguments),
            ("COMMENT(\"a\"b\")", BadLine::Arguments),
            ("USER_M_CODE(10, P1, P2)", BadLine::Arguments),
            ("SELECT_PLANE(XY)", BadLine::Arguments),
        ];
        for (text, want) in cases {
            assert_eq!(parse(text), Err(want), "{text}");
        }
    }
}
