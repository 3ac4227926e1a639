//! Prints canonical commands, one a line, and reads the lines back (CM-04, CM-T16): `NAME(ARG, ARG, ...)`.
//!
//! Names and enumerators are those of NISTIR 5970. Numbers have 4 decimals and no negative zero; counts (turns, tools, M codes) have none; strings
//! stand in double quotes with `\"`, `\\` and `\n`. Extensions carry LinuxCNC's names: `PROGRAM_STOP()`, `OPTIONAL_PROGRAM_STOP()`,
//! `PROGRAM_END()` whichever word ended the program (it reads back as M2), a tolerance behind `CANON_CONTINUOUS`. A user M code is
//! `USER_M_CODE(number)` with `P` and `Q` words behind the number if it has them.

use crate::canon::{Arc, Canon, Direction, FeedReference, MotionMode, Plane, Position, ProgramEnd, Step, Units};

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
        Canon::ProgramEnd(_) => ("PROGRAM_END", String::new()),
        bare => (bare_name(bare), String::new()),
    }
}

/// Commands without arguments, for printing and reading.
const BARE: [(&str, Canon); 20] = [
    ("INIT_CANON", Canon::InitCanon),
    ("END_CANON", Canon::EndCanon),
    ("START_SPEED_FEED_SYNCH", Canon::StartSpeedFeedSynch),
    ("STOP_SPEED_FEED_SYNCH", Canon::StopSpeedFeedSynch),
    ("STOP", Canon::Stop),
    ("START_SPINDLE_CLOCKWISE", Canon::StartSpindleClockwise),
    ("START_SPINDLE_COUNTERCLOCKWISE", Canon::StartSpindleCounterclockwise),
    ("STOP_SPINDLE_TURNING", Canon::StopSpindleTurning),
    ("FLOOD_OFF", Canon::FloodOff),
    ("FLOOD_ON", Canon::FloodOn),
    ("MIST_OFF", Canon::MistOff),
    ("MIST_ON", Canon::MistOn),
    ("DISABLE_FEED_OVERRIDE", Canon::DisableFeedOverride),
    ("DISABLE_SPEED_OVERRIDE", Canon::DisableSpeedOverride),
    ("ENABLE_FEED_OVERRIDE", Canon::EnableFeedOverride),
    ("ENABLE_SPEED_OVERRIDE", Canon::EnableSpeedOverride),
    ("PALLET_SHUTTLE", Canon::PalletShuttle),
    ("PROGRAM_STOP", Canon::ProgramStop),
    ("OPTIONAL_PROGRAM_STOP", Canon::OptionalProgramStop),
    ("PROGRAM_END", Canon::ProgramEnd(ProgramEnd::M2)),
];

fn bare_name(command: &Canon) -> &'static str {
    BARE.iter().find(|(_, c)| c == command).map_or("", |(name, _)| name)
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
    numbers(&[p.x, p.y, p.z, p.a, p.b, p.c])
}

fn arc(a: &Arc) -> String {
    let plane = numbers(&[a.first_end, a.second_end, a.first_axis, a.second_axis]);
    format!("{plane}, {}, {}", a.rotation, numbers(&[a.axis_end_point, a.a, a.b, a.c]))
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

/// An enumeration and its names in the report.
macro_rules! names {
    ($name_of:ident, $of_name:ident, $ty:ty, $($value:path => $text:literal),*) => {
        fn $name_of(value: $ty) -> &'static str {
            match value { $($value => $text,)* }
        }
        fn $of_name(text: &str) -> Option<$ty> {
            match text { $($text => Some($value),)* _ => None }
        }
    };
}
names!(plane_name, plane_of, Plane, Plane::Xy => "CANON_PLANE_XY", Plane::Yz => "CANON_PLANE_YZ", Plane::Xz => "CANON_PLANE_XZ");
names!(units_name, units_of, Units, Units::Inches => "CANON_UNITS_INCHES", Units::Mm => "CANON_UNITS_MM", Units::Cm => "CANON_UNITS_CM");
names!(reference_name, reference_of, FeedReference, FeedReference::Workpiece => "CANON_WORKPIECE", FeedReference::Xyz => "CANON_XYZ");
names!(direction_name, direction_of, Direction, Direction::Clockwise => "CANON_DIRECTION_CLOCKWISE",
    Direction::Counterclockwise => "CANON_DIRECTION_COUNTERCLOCKWISE");

/// A line of a listing.
#[derive(Clone, PartialEq, Debug)]
pub struct Line {
    /// Source line, if the listing has them.
    pub number: Option<u32>,
    /// The command; lengths have the 4 decimals of the listing.
    pub command: Canon,
}

/// Why a line can't be read.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum BadLine {
    /// Not of the form `NAME(ARG, ARG, ...)`.
    Form,
    /// No command has this name.
    Name,
    /// The number or kind of the arguments does not fit the command.
    Arguments,
}

/// Reads a line that [`line`] printed.
pub fn parse(text: &str) -> Result<Line, BadLine> {
    let (number, rest) = line_number(text.trim());
    let (name, rest) = rest.split_once('(').ok_or(BadLine::Form)?;
    let inside = rest.strip_suffix(')').ok_or(BadLine::Form)?;
    if !name.bytes().all(|b| b.is_ascii_uppercase() || b == b'_') || name.is_empty() {
        return Err(BadLine::Form);
    }
    Ok(Line { number, command: read(name, inside)? })
}

fn line_number(text: &str) -> (Option<u32>, &str) {
    let number = text.strip_prefix('N').and_then(|t| t.split_once(' '));
    match number.and_then(|(digits, rest)| Some((digits.parse().ok()?, rest))) {
        Some((number, rest)) => (Some(number), rest),
        None => (None, text),
    }
}

fn read(name: &str, inside: &str) -> Result<Canon, BadLine> {
    if let Some((_, command)) = BARE.iter().find(|(bare, _)| *bare == name) {
        return if inside.is_empty() { Ok(command.clone()) } else { Err(BadLine::Arguments) };
    }
    let args: Vec<&str> = inside.split(',').map(str::trim).collect();
    let known = match name {
        "COMMENT" => unquoted(inside).map(Canon::Comment),
        "MESSAGE" => unquoted(inside).map(Canon::Message),
        "SELECT_PLANE" => one(&args).and_then(plane_of).map(Canon::SelectPlane),
        "USE_LENGTH_UNITS" => one(&args).and_then(units_of).map(Canon::UseLengthUnits),
        "SET_FEED_REFERENCE" => one(&args).and_then(reference_of).map(Canon::SetFeedReference),
        "SET_MOTION_CONTROL_MODE" => read_mode(&args).map(Canon::SetMotionControlMode),
        "SET_ORIGIN_OFFSETS" => read_position(&args).map(Canon::SetOriginOffsets),
        "STRAIGHT_TRAVERSE" => read_position(&args).map(Canon::StraightTraverse),
        "STRAIGHT_FEED" => read_position(&args).map(Canon::StraightFeed),
        "ARC_FEED" => read_arc(&args).map(Canon::ArcFeed),
        "SET_TRAVERSE_RATE" => one_number(&args).map(Canon::SetTraverseRate),
        "SET_FEED_RATE" => one_number(&args).map(Canon::SetFeedRate),
        "DWELL" => one_number(&args).map(Canon::Dwell),
        "SET_SPINDLE_SPEED" => one_number(&args).map(Canon::SetSpindleSpeed),
        "USE_TOOL_LENGTH_OFFSET" => one_number(&args).map(Canon::UseToolLengthOffset),
        "CHANGE_TOOL" => one(&args).and_then(|a| a.parse().ok()).map(Canon::ChangeTool),
        "SELECT_TOOL" => one(&args).and_then(|a| a.parse().ok()).map(Canon::SelectTool),
        "ORIENT_SPINDLE" => read_orientation(&args),
        "USER_M_CODE" => read_user(&args),
        _ => return Err(BadLine::Name),
    };
    known.ok_or(BadLine::Arguments)
}

fn one<'a>(args: &[&'a str]) -> Option<&'a str> {
    <[&str; 1]>::try_from(args).ok().map(|[a]| a)
}

fn one_number(args: &[&str]) -> Option<f64> {
    one(args).and_then(read_number)
}

fn read_number(text: &str) -> Option<f64> {
    let plain = text.bytes().all(|b| b.is_ascii_digit() || matches!(b, b'-' | b'.'));
    text.parse().ok().filter(|_| plain)
}

fn read_numbers<const N: usize>(args: &[&str]) -> Option<[f64; N]> {
    let values: Option<Vec<f64>> = args.iter().map(|a| read_number(a)).collect();
    values?.try_into().ok()
}

fn read_position(args: &[&str]) -> Option<Position> {
    let [x, y, z, a, b, c] = read_numbers(args)?;
    Some(Position { x, y, z, a, b, c })
}

fn read_arc(args: &[&str]) -> Option<Arc> {
    let [first_end, second_end, first_axis, second_axis] = read_numbers(args.get(..4)?)?;
    let rotation = args.get(4)?.parse().ok()?;
    let [axis_end_point, a, b, c] = read_numbers(args.get(5..)?)?;
    Some(Arc { first_end, second_end, first_axis, second_axis, rotation, axis_end_point, a, b, c })
}

fn read_mode(args: &[&str]) -> Option<MotionMode> {
    match args {
        ["CANON_EXACT_STOP"] => Some(MotionMode::ExactStop),
        ["CANON_EXACT_PATH"] => Some(MotionMode::ExactPath),
        ["CANON_CONTINUOUS", tolerance] => read_number(tolerance).map(MotionMode::Continuous),
        _ => None,
    }
}

fn read_orientation(args: &[&str]) -> Option<Canon> {
    let [angle, direction] = args else { return None };
    Some(Canon::OrientSpindle(read_number(angle)?, direction_of(direction)?))
}

fn read_user(args: &[&str]) -> Option<Canon> {
    let (code, words) = args.split_first()?;
    let (mut p, mut q) = (None, None);
    for word in words {
        let place = if word.starts_with('P') { &mut p } else { &mut q };
        let value = read_number(word.strip_prefix(['P', 'Q'])?)?;
        if place.replace(value).is_some() {
            return None;
        }
    }
    Some(Canon::UserMCode { code: code.parse().ok()?, p, q })
}

fn unquoted(text: &str) -> Option<String> {
    let mut chars = text.strip_prefix('"')?.strip_suffix('"')?.chars();
    let mut out = String::new();
    while let Some(c) = chars.next() {
        match (c, c == '\\') {
            (_, true) => match chars.next()? {
                'n' => out.push('\n'),
                c @ ('"' | '\\') => out.push(c),
                _ => return None,
            },
            ('"', _) => return None,
            _ => out.push(c),
        }
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

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
