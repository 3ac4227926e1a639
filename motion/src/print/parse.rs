//! Reads a listing back (CM-T16).

mod extension;

use super::names::{direction_of, plane_of, reference_of, units_of};
use crate::canon::{Arc, Canon, MotionMode, Position, ProgramEnd};

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

/// Reads a line that [`super::line`] printed.
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
        _ => return extension::read(name, inside, &args),
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
    read_numbers::<6>(args).map(Position::from)
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

/// Commands without arguments.
pub(super) const BARE: [(&str, Canon); 28] = [
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
    ("START_CHANGE", Canon::StartChange),
    ("TURN_PROBE_ON", Canon::TurnProbeOn),
    ("TURN_PROBE_OFF", Canon::TurnProbeOff),
    ("ENABLE_ADAPTIVE_FEED", Canon::EnableAdaptiveFeed),
    ("DISABLE_ADAPTIVE_FEED", Canon::DisableAdaptiveFeed),
    ("ENABLE_FEED_HOLD", Canon::EnableFeedHold),
    ("DISABLE_FEED_HOLD", Canon::DisableFeedHold),
    ("LOGCLOSE", Canon::LogClose),
    ("PROGRAM_END", Canon::ProgramEnd(ProgramEnd::M2)),
];
