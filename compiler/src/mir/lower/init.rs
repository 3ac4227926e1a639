//! Initial contents as sparse chunks: zeros cost nothing, neighbours share a chunk.

use super::data::scalar_bytes;
use crate::hir::model::{Const, GlobalId};
use takt_base::index::IndexVec;
use takt_image::image::{Chunk, Place};
use takt_image::{Type, TypeId, TypeTable};

/// Zeros between two pieces that are cheaper to store than a second chunk.
const GAP: u32 = 16;

/// Places of the global variables.
pub type Globals = IndexVec<GlobalId, Place>;

/// Chunks in ascending order.
#[derive(Default)]
pub struct Chunks {
    done: Vec<Chunk>,
}

impl Chunks {
    /// Adds bytes behind everything added before.
    pub fn put(&mut self, offset: u32, bytes: &[u8]) {
        let Some(first) = bytes.iter().position(|b| *b != 0) else { return };
        let last = bytes.iter().rposition(|b| *b != 0).unwrap_or(first);
        let (offset, bytes) = (offset + first as u32, &bytes[first..=last]);
        match self.done.last_mut() {
            Some(chunk) if offset - end(chunk) <= GAP => {
                chunk.bytes.resize((offset - chunk.offset) as usize, 0);
                chunk.bytes.extend_from_slice(bytes);
            }
            _ => self.done.push(Chunk { offset, bytes: bytes.to_vec() }),
        }
    }
    /// All chunks.
    pub fn finish(self) -> Vec<Chunk> {
        self.done
    }
}

fn end(chunk: &Chunk) -> u32 {
    chunk.offset + chunk.bytes.len() as u32
}

/// Hands out the non-zero parts of a constant in ascending order, with their offsets from its start.
pub fn constant(types: &TypeTable, globals: &Globals, ty: TypeId, value: &Const, put: &mut dyn FnMut(u32, &[u8])) {
    part((types, globals), ty, value, 0, put);
}

/// The value of a reference to a part of a global variable.
pub fn address(globals: &Globals, global: GlobalId, bytes: u32) -> u32 {
    match globals.get(global) {
        Some(Place::Byte(offset)) => offset.saturating_add(bytes),
        _ => 0,
    }
}

fn part(known: (&TypeTable, &Globals), ty: TypeId, value: &Const, at: u32, put: &mut dyn FnMut(u32, &[u8])) {
    let (types, globals) = known;
    match (value, types.get(ty)) {
        (Const::Zero, _) | (_, Type::Reference { .. }) => {}
        (Const::Address(global, bytes), _) => put(at, &address(globals, *global, *bytes).to_le_bytes()),
        (Const::String(s), _) => put(at, s),
        (Const::WString(s), _) => put(at, &s.iter().flat_map(|u| u.to_le_bytes()).collect::<Vec<_>>()),
        (Const::Aggregate(items), Type::Array { element, .. }) => {
            let size = types.layout(*element).size;
            items.iter().zip(0..).for_each(|(item, i)| part(known, *element, item, at + i * size, put));
        }
        (Const::Aggregate(items), Type::Struct(r) | Type::Instance(r)) => {
            items.iter().zip(&r.fields).for_each(|(item, f)| part(known, f.ty, item, at + f.offset, put));
        }
        (scalar, _) => {
            if let Some(e) = types.storage(ty) {
                put(at, &scalar_bytes(e, scalar));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chunk(offset: u32, bytes: &[u8]) -> Chunk {
        Chunk { offset, bytes: bytes.to_vec() }
    }

    #[test]
    fn zeros_are_left_out_and_neighbours_merge() {
        let mut c = Chunks::default();
        for (offset, bytes) in [(8, &[0, 1, 0, 0][..]), (16, &[0; 1000]), (20, &[2, 3]), (100, &[0, 0, 4])] {
            c.put(offset, bytes);
        }
        assert_eq!(c.finish(), [chunk(9, &[1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 3]), chunk(102, &[4])]);
    }
}
