//! Retained variables (IEC 61131-3 reference §10.4): copied out of a memory in one run of bytes, stored with path and type, and put
//! back variable by variable, so that a changed program keeps what it still has.
//!
//! `capture` runs cyclic; everything else in the background.
//!
//! Stored form, little-endian: `TAKTRETN`, i64 time, u32 count, then each variable as u32 length and path, u64 type, u32 length and
//! bytes; last the CRC-32C of all before.

use crate::crc::crc32c;
use crate::image::{Image, Place};
use crate::types::{Type, TypeId, TypeTable};
use std::collections::HashMap;

const MAGIC: &[u8; 8] = b"TAKTRETN";

/// Where the retained variables of an image lie in its memory and in a copy.
#[derive(Clone, Debug, Default)]
pub struct RetainMap {
    items: Vec<Item>,
    bytes: usize,
}

#[derive(Clone, Debug)]
struct Item {
    path: String,
    ty: u64,
    place: Place,
    size: usize,
    persistent: bool,
}

/// Which variables a start restores.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Start {
    /// All.
    Warm,
    /// Those that are PERSISTENT.
    Cold,
}

/// What a restoration did.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Restored {
    /// Variables that have their stored value.
    pub count: usize,
    /// Paths whose type has changed: they keep their initial values.
    pub changed: Vec<String>,
    /// Time of the copy in nanoseconds: timers go on from there.
    pub time: i64,
}

/// The stored form is damaged: nothing of it was used.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Damaged;

impl RetainMap {
    /// The map of an image that was validated.
    pub fn new(image: &Image) -> Self {
        let mut types = Descriptions { types: &image.types, known: HashMap::new() };
        let item = |r: &crate::image::Retained| Item {
            path: r.path.clone(),
            ty: types.of(r.ty),
            place: r.place,
            size: if matches!(r.place, Place::Bit(..)) { 1 } else { image.types.layout(r.ty).size as usize },
            persistent: r.persistent,
        };
        let items: Vec<Item> = image.retained.iter().map(item).collect();
        let bytes = items.iter().map(|i| i.size).sum();
        Self { items, bytes }
    }

    /// True if nothing is retained.
    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// Bytes of a copy.
    pub fn bytes(&self) -> usize {
        self.bytes
    }

    /// Copies the variables out of a memory. `copy` has [`RetainMap::bytes`] bytes. Runs: cyclic.
    pub fn capture(&self, memory: &[u8], copy: &mut [u8]) {
        let mut rest = copy;
        for item in &self.items {
            let Some((to, behind)) = rest.split_at_mut_checked(item.size) else { return };
            match item.place {
                Place::Byte(offset) => {
                    if let Some(from) = memory.get(offset as usize..offset as usize + item.size) {
                        to.copy_from_slice(from);
                    }
                }
                bit => to.fill(u8::from(bit.bool(memory) == Some(true))),
            }
            rest = behind;
        }
    }

    /// The stored form of a copy that was made at `time` nanoseconds.
    pub fn encode(&self, copy: &[u8], time: i64) -> Vec<u8> {
        let mut out = MAGIC.to_vec();
        out.extend(time.to_le_bytes());
        out.extend((self.items.len() as u32).to_le_bytes());
        let mut rest = copy;
        for item in &self.items {
            let Some((bytes, behind)) = rest.split_at_checked(item.size) else { break };
            rest = behind;
            out.extend((item.path.len() as u32).to_le_bytes());
            out.extend(item.path.as_bytes());
            out.extend(item.ty.to_le_bytes());
            out.extend((item.size as u32).to_le_bytes());
            out.extend(bytes);
        }
        let sum = crc32c(&out);
        out.extend(sum.to_le_bytes());
        out
    }

    /// Puts stored values back: each variable whole, or not at all.
    pub fn restore(&self, stored: &[u8], memory: &mut [u8], start: Start) -> Result<Restored, Damaged> {
        let (time, found) = decode(stored).ok_or(Damaged)?;
        let mut done = Restored { time, ..Restored::default() };
        for item in self.items.iter().filter(|i| start == Start::Warm || i.persistent) {
            match found.get(item.path.to_ascii_uppercase().as_str()) {
                Some((ty, bytes)) if *ty == item.ty && bytes.len() == item.size => {
                    item.put(bytes, memory);
                    done.count += 1;
                }
                Some(_) => done.changed.push(item.path.clone()),
                None => {}
            }
        }
        Ok(done)
    }
}

impl Item {
    fn put(&self, bytes: &[u8], memory: &mut [u8]) {
        match self.place {
            Place::Byte(offset) => {
                if let Some(to) = memory.get_mut(offset as usize..offset as usize + self.size) {
                    to.copy_from_slice(bytes);
                }
            }
            Place::Bit(offset, bit) => {
                if let (Some(to), Some(from)) = (memory.get_mut(offset as usize), bytes.first()) {
                    let mask = 1 << (bit & 7);
                    *to = *to & !mask | if *from != 0 { mask } else { 0 };
                }
            }
        }
    }
}

/// Type and bytes by path in capitals.
type Found<'s> = HashMap<String, (u64, &'s [u8])>;

fn decode(stored: &[u8]) -> Option<(i64, Found<'_>)> {
    let (body, sum) = stored.split_last_chunk::<4>()?;
    if crc32c(body) != u32::from_le_bytes(*sum) {
        return None;
    }
    let mut rest = body.strip_prefix(MAGIC)?;
    let time = i64::from_le_bytes(take(&mut rest)?);
    let count = u32::from_le_bytes(take(&mut rest)?);
    let mut found = Found::new();
    for _ in 0..count {
        let path = std::str::from_utf8(run(&mut rest)?).ok()?.to_ascii_uppercase();
        let ty = u64::from_le_bytes(take(&mut rest)?);
        found.insert(path, (ty, run(&mut rest)?));
    }
    rest.is_empty().then_some((time, found))
}

fn take<const N: usize>(rest: &mut &[u8]) -> Option<[u8; N]> {
    let (first, behind) = rest.split_first_chunk::<N>()?;
    *rest = behind;
    Some(*first)
}

fn run<'s>(rest: &mut &'s [u8]) -> Option<&'s [u8]> {
    let size = u32::from_le_bytes(take(rest)?) as usize;
    let (bytes, behind) = rest.split_at_checked(size)?;
    *rest = behind;
    Some(bytes)
}

/// Hashes of what types look like: equal ones store their values alike.
struct Descriptions<'t> {
    types: &'t TypeTable,
    known: HashMap<TypeId, u64>,
}

impl Descriptions<'_> {
    fn of(&mut self, id: TypeId) -> u64 {
        if let Some(&known) = self.known.get(&id) {
            return known;
        }
        self.known.insert(id, 0);
        let text = self.text(id);
        let hash = text.bytes().fold(0xCBF2_9CE4_8422_2325u64, |h, b| (h ^ u64::from(b)).wrapping_mul(0x100_0000_01B3));
        self.known.insert(id, hash);
        hash
    }

    fn text(&mut self, id: TypeId) -> String {
        let Some(ty) = self.types.try_get(id) else { return String::new() };
        match ty {
            Type::Elementary(e) => e.name().to_owned(),
            Type::Subrange { base, low, high, .. } => format!("{} {low}..{high}", base.name()),
            Type::Enum { base, values, .. } => {
                let values: Vec<_> = values.iter().map(|(n, v)| format!("{}={v}", n.to_ascii_uppercase())).collect();
                format!("{} ({})", base.name(), values.join(","))
            }
            Type::String { capacity } => format!("STRING {capacity}"),
            Type::WString { capacity } => format!("WSTRING {capacity}"),
            Type::Array { element, dims } => {
                let dims: Vec<_> = dims.iter().map(|d| format!("{}..{}", d.low, d.high)).collect();
                format!("[{}] {:x}", dims.join(","), self.of(*element))
            }
            Type::Struct(r) | Type::Instance(r) => {
                let field =
                    |f: &crate::types::Field| format!("{}@{}:{:x};", f.name.to_ascii_uppercase(), f.offset, self.of(f.ty));
                format!("{{{}}}", r.fields.iter().map(field).collect::<String>())
            }
            other => format!("{other:?}"),
        }
    }
}
