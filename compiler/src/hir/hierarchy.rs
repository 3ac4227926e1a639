//! Hierarchical addresses `%MW1.2.3` (§16: up to 8 levels): each distinct one has a place of its own behind all plain addresses of its
//! area, in the order of its numbers.

use super::image::{Cell, ImagePlan, Owner, size_type};
use crate::syntax::ast::{self, AddressSize, Area};
use std::collections::BTreeMap;
use takt_base::Span;

/// An address as it is told apart: area, size and numbers.
type Key = (usize, usize, Vec<u32>);

struct Known {
    area: Area,
    bytes: u32,
    /// Its place, once that is known.
    byte: u32,
    span: Span,
}

/// The hierarchical addresses of a project.
#[derive(Default)]
pub(super) struct Hierarchy {
    known: BTreeMap<Key, Known>,
    located: Vec<(Owner, Key)>,
}

/// True for an address with more numbers than say where it is.
pub(super) fn is_hierarchical(a: &ast::Address) -> bool {
    a.path.len() > if a.size == AddressSize::Bit { 2 } else { 1 }
}

fn key(a: &ast::Address) -> Key {
    (a.area as usize, a.size as usize, a.path.clone())
}

impl Hierarchy {
    /// Notes an address that takes so many bytes.
    pub fn note(&mut self, a: &ast::Address, bytes: u32) {
        let entry = self.known.entry(key(a)).or_insert(Known { area: a.area, bytes: 0, byte: 0, span: a.span });
        entry.bytes = entry.bytes.max(bytes);
    }
    /// Notes a variable that lies there.
    pub fn locate(&mut self, owner: Owner, a: &ast::Address) {
        self.located.push((owner, key(a)));
    }
    /// The place of an address that was noted.
    pub fn cell(&self, a: &ast::Address) -> Option<Cell> {
        let known = self.known.get(&key(a))?;
        Some(Cell { area: known.area, byte: known.byte, bit: (a.size == AddressSize::Bit).then_some(0) })
    }
}

impl ImagePlan {
    /// Puts all hierarchical addresses behind the plain ones; where an area is full, that place.
    pub fn place_hierarchy(&mut self, limit: u64) -> Option<Span> {
        for ((_, size, _), known) in &mut self.hierarchy.known {
            let end = &mut self.extent[known.area as usize];
            let width = [1, 1, 2, 4, 8].get(*size).copied().unwrap_or(1);
            known.byte = end.next_multiple_of(width);
            if u64::from(known.byte) + u64::from(known.bytes) > limit {
                return Some(known.span);
            }
            *end = known.byte + known.bytes;
        }
        let bit = |size: usize| (size == AddressSize::Bit as usize).then_some(0);
        for (owner, key) in std::mem::take(&mut self.hierarchy.located) {
            if let Some(known) = self.hierarchy.known.get(&key) {
                self.located.push((owner, Cell { area: known.area, byte: known.byte, bit: bit(key.1) }));
            }
        }
        None
    }
}

/// Bytes of an address without a declaration.
pub(super) fn width(a: &ast::Address) -> u32 {
    size_type(a.size).bytes()
}
