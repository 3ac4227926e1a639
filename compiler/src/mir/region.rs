//! What an address can point to: lets passes tell apart what never overlaps. The lowering records it while it still knows the types.

use super::model::{Addr, AddrBase, Local};
use std::collections::HashMap;
use std::ops::Range;

/// A run of bytes of an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    /// Which object.
    pub object: Object,
    /// First byte within the object.
    pub low: u64,
    /// One past the last byte.
    pub high: u64,
    /// True if an address with this region is exactly `low`; otherwise somewhere within.
    pub exact: bool,
}

/// What addresses start from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Object {
    /// The resource memory at fixed offsets.
    Memory,
    /// The frame of this call.
    Frame,
    /// The instance of the running block or program.
    Instance,
    /// Anything but the frame: what a VAR_IN_OUT refers to.
    Foreign,
    /// Not known.
    Any,
}

/// Regions of the locals that hold addresses. A local that is not here can point anywhere.
#[derive(Clone, Debug, Default)]
pub struct Regions {
    locals: HashMap<Local, Region>,
    /// Fixed offsets at which the running instance may be; empty for a program, whose instances have no name.
    pub named_instances: Range<u64>,
}

impl Region {
    /// All that an object has.
    pub fn whole(object: Object) -> Self {
        Region { object, low: 0, high: u64::MAX, exact: false }
    }
}

impl Regions {
    /// Records what a local points to. It must hold whenever the local is used as an address.
    pub fn set(&mut self, local: Local, region: Region) {
        self.locals.insert(local, region);
    }

    /// Bytes that an access of `size` bytes at `addr` can touch.
    pub fn of(&self, addr: Addr, size: u64) -> Region {
        let (object, start) = match addr.base {
            AddrBase::Static => (Object::Memory, 0),
            AddrBase::Frame => (Object::Frame, 0),
            AddrBase::Local(l) => match self.locals.get(&l) {
                None => return Region::whole(Object::Any),
                Some(r) if !r.exact => return *r,
                Some(r) => (r.object, r.low),
            },
        };
        let low = start + addr.offset as u64;
        Region { object, low, high: low + size, exact: true }
    }

    /// True unless the two can't have a byte in common.
    pub fn may_overlap(&self, a: Region, b: Region) -> bool {
        use Object::*;
        match (a.object, b.object) {
            (Any, _) | (_, Any) => true,
            (Frame, Frame) | (Memory, Memory) | (Instance, Instance) => a.low < b.high && b.low < a.high,
            (Frame, _) | (_, Frame) => false,
            (Foreign, _) | (_, Foreign) => true,
            (Memory, Instance) => self.may_be_instance(a),
            (Instance, Memory) => self.may_be_instance(b),
        }
    }

    fn may_be_instance(&self, fixed: Region) -> bool {
        fixed.low < self.named_instances.end && self.named_instances.start < fixed.high
    }
}
