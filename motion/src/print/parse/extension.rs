//! Commands that the report does not have.

use super::{BadLine, one, one_number, read_number, read_numbers, read_position, unquoted};
use crate::canon::{Canon, Input, Nurbs, Position, Probe, ToolEntry};

pub(super) fn read(name: &str, inside: &str, args: &[&str]) -> Result<Canon, BadLine> {
    let known = match name {
        "PRINT" => unquoted(inside).map(Canon::Print),
        "LOG" => unquoted(inside).map(Canon::Log),
        "LOGOPEN" => unquoted(inside).map(Canon::LogOpen),
        "LOGAPPEND" => unquoted(inside).map(Canon::LogAppend),
        "SET_XY_ROTATION" => one_number(args).map(Canon::SetXyRotation),
        "SET_G5X_OFFSET" => indexed_position(args).map(|(i, p)| Canon::SetG5xOffset(i, p)),
        "SET_G92_OFFSET" => read_position(args).map(Canon::SetG92Offset),
        "USE_TOOL_LENGTH_OFFSETS" => read_position(args).map(Canon::UseToolLengthOffsets),
        "SET_FEED_MODE" => one(args).and_then(flag).map(Canon::SetFeedMode),
        "SET_SPINDLE_MODE" => one_number(args).map(|max| Canon::SetSpindleMode((max > 0.0).then_some(max))),
        "SET_NAIVECAM_TOLERANCE" => one_number(args).map(Canon::SetNaivecamTolerance),
        "CHANGE_TOOL_NUMBER" => count(args).map(Canon::ChangeToolNumber),
        "SET_TOOL_TABLE_ENTRY" => tool_entry(args).map(|entry| Canon::SetToolTableEntry(Box::new(entry))),
        "ORIENT_SPINDLE_MODE" => angle_and_mode(args),
        "WAIT_ORIENT_COMPLETE" => one_number(args).map(Canon::WaitOrientComplete),
        "START_SPEED_FEED_SYNC" => one_number(args).map(Canon::StartSpeedFeedSync),
        "STRAIGHT_PROBE" => probe(args),
        "RIGID_TAP" => read_position(args).map(Canon::RigidTap),
        "NURBS_FEED" => nurbs(args).map(Canon::NurbsFeed),
        "SET_MOTION_OUTPUT_BIT" => count(args).map(Canon::SetMotionOutputBit),
        "CLEAR_MOTION_OUTPUT_BIT" => count(args).map(Canon::ClearMotionOutputBit),
        "SET_AUX_OUTPUT_BIT" => count(args).map(Canon::SetAuxOutputBit),
        "CLEAR_AUX_OUTPUT_BIT" => count(args).map(Canon::ClearAuxOutputBit),
        "SET_MOTION_OUTPUT_VALUE" => indexed_value(args).map(|(i, v)| Canon::SetMotionOutputValue(i, v)),
        "SET_AUX_OUTPUT_VALUE" => indexed_value(args).map(|(i, v)| Canon::SetAuxOutputValue(i, v)),
        "READ_PLC" => args.iter().map(|a| unquoted(a)).collect::<Option<_>>().map(Canon::ReadPlc),
        "SET_PLC" => named_value(args),
        "WAIT_INPUT" => input(args).map(Canon::WaitInput),
        _ => return Err(BadLine::Name),
    };
    known.ok_or(BadLine::Arguments)
}

fn count(args: &[&str]) -> Option<u32> {
    one(args)?.parse().ok()
}

fn flag(text: &str) -> Option<bool> {
    match text {
        "0" => Some(false),
        "1" => Some(true),
        _ => None,
    }
}

fn indexed_position(args: &[&str]) -> Option<(u32, Position)> {
    let (index, rest) = args.split_first()?;
    Some((index.parse().ok()?, read_position(rest)?))
}

fn indexed_value(args: &[&str]) -> Option<(u32, f64)> {
    let [index, value] = args else { return None };
    Some((index.parse().ok()?, read_number(value)?))
}

fn named_value(args: &[&str]) -> Option<Canon> {
    let [name, value] = args else { return None };
    Some(Canon::SetPlc(unquoted(name)?, read_number(value)?))
}

fn angle_and_mode(args: &[&str]) -> Option<Canon> {
    let [angle, mode] = args else { return None };
    Some(Canon::OrientSpindleMode(read_number(angle)?, mode.parse().ok()?))
}

fn probe(args: &[&str]) -> Option<Canon> {
    let [rest @ .., towards, must_trip] = args else { return None };
    let probe = Probe { towards: flag(towards)?, must_trip: flag(must_trip)? };
    Some(Canon::StraightProbe(read_position(rest)?, probe))
}

fn input(args: &[&str]) -> Option<Input> {
    let [number, analog, wait, timeout] = args else { return None };
    Some(Input { number: number.parse().ok()?, analog: flag(analog)?, wait: wait.parse().ok()?, timeout: read_number(timeout)? })
}

fn tool_entry(args: &[&str]) -> Option<ToolEntry> {
    let [index, tool, pocket, rest @ .., orientation] = args else { return None };
    let values = read_numbers::<12>(rest)?;
    let mut offset = [0.0; 9];
    offset.copy_from_slice(&values[..9]);
    Some(ToolEntry {
        index: index.parse().ok()?,
        tool: tool.parse().ok()?,
        pocket: pocket.parse().ok()?,
        offset,
        diameter: values[9],
        front: values[10],
        back: values[11],
        orientation: orientation.parse().ok()?,
    })
}

fn nurbs(args: &[&str]) -> Option<Nurbs> {
    let [count, order, rest @ ..] = args else { return None };
    let values: Vec<f64> = rest.iter().map(|a| read_number(a)).collect::<Option<_>>()?;
    let points: Vec<[f64; 3]> = values.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect();
    let fits = count.parse() == Ok(points.len()) && values.len() == 3 * points.len();
    Some(Nurbs { order: order.parse().ok()?, points }).filter(|_| fits)
}
