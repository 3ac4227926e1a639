//! String functions. Each makes its result of parts of its inputs, which `store` puts one after the other. Positions count from 1.
//! From: library reference §7.
//! Runs: cyclic.

use super::text::{Text, source, store, target, width};
use super::{Run, Types};
use takt_image::natives::MAX_SLOTS;
use takt_image::{NativeCall, Trap};

/// Code by catalogue name.
pub(super) const RUNS: &[(&str, Run)] = &[
    ("LEN", len),
    ("LEFT", left),
    ("RIGHT", right),
    ("MID", mid),
    ("CONCAT", concat),
    ("INSERT", insert),
    ("DELETE", delete),
    ("REPLACE", replace),
    ("FIND", find),
];

/// Slots: string. A length above the range of INT saturates.
fn len(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    call.result = as_int(source(call, 0, width(types.from))?.len);
    Ok(())
}

/// A count as INT.
fn as_int(n: usize) -> u64 {
    n.min(i16::MAX as usize) as u64
}

/// Slots: IN, L, target.
fn left(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    let text = source(call, 0, width(types.from))?;
    fail_if(call, call.i64(2) < 0);
    give(call, types, 3, &[text.first(call.i64(2))])
}

/// Slots: IN, L, target.
fn right(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    let text = source(call, 0, width(types.from))?;
    fail_if(call, call.i64(2) < 0);
    let count = call.i64(2).clamp(0, text.len as i64);
    give(call, types, 3, &[text.after(text.len as i64 - count)])
}

/// Slots: IN, L, P, target.
fn mid(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    let text = source(call, 0, width(types.from))?;
    let (count, position) = (call.i64(2), call.i64(3));
    fail_if(call, count < 0 || position < 1 || position > text.len as i64);
    let part = if position < 1 { Text::EMPTY } else { text.part(position - 1, count) };
    give(call, types, 4, &[part])
}

/// Slots: IN1, ... INn, target.
fn concat(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    let inputs = (call.args.len() / 2).saturating_sub(1).min(MAX_SLOTS / 2);
    let mut parts = [Text::EMPTY; MAX_SLOTS / 2];
    for (i, part) in parts.iter_mut().enumerate().take(inputs) {
        *part = source(call, 2 * i, width(types.from))?;
    }
    give(call, types, 2 * inputs, &parts)
}

/// Slots: IN1, IN2, P, target.
fn insert(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    let (text, new) = two(call, types)?;
    let position = call.i64(4);
    fail_if(call, position < 0 || position > text.len as i64);
    let new = if position < 0 { Text::EMPTY } else { new };
    give(call, types, 5, &[text.first(position), new, text.after(position)])
}

/// Slots: IN, L, P, target.
fn delete(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    let text = source(call, 0, width(types.from))?;
    let (count, position) = (call.i64(2), call.i64(3));
    fail_if(call, count < 0 || position < 1 || position > text.len as i64);
    if position < 1 || count <= 0 {
        return give(call, types, 4, &[text]);
    }
    let rest = text.after(position - 1).after(count);
    give(call, types, 4, &[text.first(position - 1), rest])
}

/// Slots: IN1, IN2, L, P, target.
fn replace(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    let (text, new) = two(call, types)?;
    let (count, position) = (call.i64(4), call.i64(5));
    if position < 1 || position > text.len as i64 + 1 || count < 0 {
        call.fail();
        return give(call, types, 6, &[text]);
    }
    let rest = text.after(position - 1).after(count);
    give(call, types, 6, &[text.first(position - 1), new, rest])
}

/// Slots: IN1, IN2.
fn find(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    let (text, wanted) = two(call, types)?;
    let (hay, needle) = (text.bytes(call), wanted.bytes(call));
    let starts = if needle.is_empty() { 0 } else { (text.len + 1).saturating_sub(wanted.len) };
    let w = width(types.from);
    let at = (0..starts).find(|i| hay.get(i * w..).is_some_and(|rest| rest.starts_with(needle)));
    call.result = at.map_or(0, |i| as_int(i + 1));
    Ok(())
}

/// Notes an error of the positions.
fn fail_if(call: &mut NativeCall, wrong: bool) {
    if wrong {
        call.fail();
    }
}

fn two(call: &NativeCall, types: Types) -> Result<(Text, Text), Trap> {
    let w = width(types.from);
    Ok((source(call, 0, w)?, source(call, 2, w)?))
}

fn give(call: &mut NativeCall, types: Types, slot: usize, parts: &[Text]) -> Result<(), Trap> {
    let to = target(call, slot, width(types.from))?;
    store(call, &to, parts)
}
