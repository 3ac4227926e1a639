//! Strings in the resource memory: units of one byte (STRING) or two (WSTRING), ended by a zero unit, capacity given by the caller.
//! Invariant: nothing is read outside of a source or written outside of a target, wherever they lie.
//! Runs: cyclic.

use super::Types;
use crate::lookup::ConversionType;
use takt_image::{NativeCall, Trap, header};

/// Characters that are there: part of a source.
#[derive(Clone, Copy)]
pub(super) struct Text {
    at: usize,
    /// Number of characters.
    pub len: usize,
    /// Bytes of a character.
    width: usize,
}

impl Text {
    /// Without characters.
    pub const EMPTY: Text = Text { at: 0, len: 0, width: 1 };

    /// At most `len` characters behind the first `skip`.
    pub fn part(self, skip: i64, len: i64) -> Text {
        let skip = clip(skip, self.len);
        Text { at: self.at + skip * self.width, len: clip(len, self.len - skip), width: self.width }
    }
    /// The first `len` characters.
    pub fn first(self, len: i64) -> Text {
        self.part(0, len)
    }
    /// Everything behind the first `skip` characters.
    pub fn after(self, skip: i64) -> Text {
        self.part(skip, i64::MAX)
    }
    /// Character `i`, from 0; 0 if there is none.
    pub fn unit(self, call: &NativeCall, i: usize) -> u16 {
        if i < self.len { unit(call.memory, self.at + i * self.width, self.width) } else { 0 }
    }
    /// The bytes of all characters.
    pub fn bytes<'a>(self, call: &'a NativeCall) -> &'a [u8] {
        call.memory.get(self.at..self.at + self.len * self.width).unwrap_or(&[])
    }
}

/// Place of a string result.
pub(super) struct Target {
    at: usize,
    capacity: usize,
    width: usize,
}

/// Bytes of a character.
pub(super) fn width(ty: ConversionType) -> usize {
    if ty == ConversionType::WString { 2 } else { 1 }
}

fn clip(n: i64, max: usize) -> usize {
    usize::try_from(n).map_or(if n < 0 { 0 } else { max }, |n| n.min(max))
}

/// Start and capacity of the string whose slots begin at `slot`. The header is no place for one.
fn area(call: &NativeCall, slot: usize, width: usize) -> Result<(usize, usize), Trap> {
    let (at, capacity) = (call.u32(slot) as usize, call.u32(slot + 1) as usize);
    let end = at + (capacity + 1) * width;
    if at < header::SIZE as usize || end > call.memory.len() { Err(Trap::Memory) } else { Ok((at, capacity)) }
}

/// The string whose slots begin at `slot`.
pub(super) fn source(call: &NativeCall, slot: usize, width: usize) -> Result<Text, Trap> {
    let (at, capacity) = area(call, slot, width)?;
    let len = (0..capacity).position(|i| unit(call.memory, at + i * width, width) == 0).unwrap_or(capacity);
    Ok(Text { at, len, width })
}

/// The place whose slots begin at `slot`.
pub(super) fn target(call: &NativeCall, slot: usize, width: usize) -> Result<Target, Trap> {
    let (at, capacity) = area(call, slot, width)?;
    Ok(Target { at, capacity, width })
}

fn unit(memory: &[u8], at: usize, width: usize) -> u16 {
    match (width, memory.get(at), memory.get(at + 1)) {
        (1, Some(&low), _) => low.into(),
        (_, Some(&low), Some(&high)) => u16::from_le_bytes([low, high]),
        _ => 0,
    }
}

/// Writes parts of sources, of the target's width, one after the other; what passes the capacity is cut.
pub(super) fn store(call: &mut NativeCall, target: &Target, parts: &[Text]) -> Result<(), Trap> {
    let mut done = 0;
    for part in parts {
        let part = part.first((target.capacity - done) as i64);
        let to = target.at + done * target.width;
        call.memory.copy_within(part.at..part.at + part.len * target.width, to);
        done += part.len;
    }
    end(call, target, done)
}

/// Writes characters; what passes the capacity is cut. `next` gives character `i` from the memory.
pub(super) fn store_units(
    call: &mut NativeCall,
    target: &Target,
    len: usize,
    next: impl Fn(&NativeCall, usize) -> u16,
) -> Result<(), Trap> {
    let len = len.min(target.capacity);
    for i in 0..len {
        let value = next(call, i);
        put(call, target, i, value);
    }
    end(call, target, len)
}

fn end(call: &mut NativeCall, target: &Target, len: usize) -> Result<(), Trap> {
    put(call, target, len, 0);
    Ok(())
}

fn put(call: &mut NativeCall, target: &Target, i: usize, value: u16) {
    let at = target.at + i * target.width;
    if let Some(place) = call.memory.get_mut(at..at + target.width) {
        place.copy_from_slice(&value.to_le_bytes()[..target.width]);
    }
}

/// A string with the bytes of every character swapped; those of STRING are one byte.
pub(super) fn swap_bytes(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    let from = source(call, 0, width(types.from))?;
    let to = target(call, 2, width(types.from))?;
    let wide = to.width == 2;
    store_units(call, &to, from.len, |call, i| if wide { from.unit(call, i).swap_bytes() } else { from.unit(call, i) })
}

/// STRING to WSTRING and back; a character that the target does not have becomes `?`.
pub(super) fn string_to_string(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    let from = source(call, 0, width(types.from))?;
    let to = target(call, 2, width(types.to))?;
    let narrow = to.width == 1;
    if narrow && (0..from.len).any(|i| from.unit(call, i) > 0xFF) {
        call.fail();
    }
    store_units(call, &to, from.len, |call, i| if narrow { narrowed(from.unit(call, i)) } else { from.unit(call, i) })
}

/// CHAR or WCHAR to a string of one character; code 0 gives an empty one.
pub(super) fn char_to_string(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    let to = target(call, 1, width(types.to))?;
    let code = call.u32(0) as u16;
    if to.width == 1 && code > 0xFF {
        call.fail();
    }
    let code = if to.width == 1 { narrowed(code) } else { code };
    store_units(call, &to, 1, |_, _| code)
}

/// The first character; code 0 if there is none.
pub(super) fn string_to_char(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    let from = source(call, 0, width(types.from))?;
    let code = from.unit(call, 0);
    let is_char = types.to == ConversionType::Elementary(takt_image::Elementary::Char);
    if from.len == 0 || (is_char && code > 0xFF) {
        call.fail();
    }
    call.result = if is_char { narrowed(code) } else { code }.into();
    Ok(())
}

pub(super) fn wchar_to_char(call: &mut NativeCall, _: Types) -> Result<(), Trap> {
    let code = call.u32(0) as u16;
    if code > 0xFF {
        call.fail();
    }
    call.result = narrowed(code).into();
    Ok(())
}

fn narrowed(code: u16) -> u16 {
    if code > 0xFF { b'?'.into() } else { code }
}
