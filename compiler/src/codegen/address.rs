//! Addresses. A place is an I64 pointer and a constant distance, as machine instructions take it.
//!
//! No alias regions: an address in a local may be any place, the process image and this frame included.

use super::function::Translator;
use crate::mir::model::{Addr, AddrBase, Local};
use cranelift_codegen::ir::{InstBuilder, MemFlagsData, Type, Value, types};

/// Pointer and distance.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub(super) base: Value,
    pub(super) offset: i32,
}

impl Place {
    /// `bytes` further on. Offsets and sizes of a verified module are below 2^30 in sum.
    pub(super) fn plus(self, bytes: u32) -> Place {
        Place { base: self.base, offset: self.offset.wrapping_add(bytes as i32) }
    }
}

/// Located variables need not be aligned, so nothing is said about alignment. An offset that the runtime's reserve of address space
/// catches is no trap of this instruction: the access may be removed if nobody needs it.
pub(super) fn flags() -> MemFlagsData {
    MemFlagsData::new().with_notrap()
}

impl Translator<'_, '_> {
    pub(super) fn place(&mut self, addr: Addr) -> Place {
        let base = match addr.base {
            AddrBase::Static => self.memory,
            AddrBase::Frame => self.frame_address,
            AddrBase::Local(base) => {
                let offset = self.get(base);
                let offset = self.b.ins().uextend(types::I64, offset);
                self.b.ins().iadd(self.memory, offset)
            }
        };
        Place { base, offset: addr.offset as i32 }
    }

    /// The pointer alone.
    pub(super) fn pointer(&mut self, place: Place) -> Value {
        if place.offset == 0 { place.base } else { self.b.ins().iadd_imm_s(place.base, i64::from(place.offset)) }
    }

    pub(super) fn load(&mut self, ty: Type, place: Place) -> Value {
        self.b.ins().load(ty, flags(), place.base, place.offset)
    }

    pub(super) fn store(&mut self, value: Value, place: Place) {
        self.b.ins().store(flags(), value, place.base, place.offset);
    }

    /// `dst = offset of addr`.
    pub(super) fn address(&mut self, dst: Local, addr: Addr) {
        let value = match addr.base {
            AddrBase::Static => self.b.ins().iconst(types::I32, i64::from(addr.offset)),
            AddrBase::Frame => self.b.ins().iadd_imm_u(self.frame, i64::from(addr.offset)),
            AddrBase::Local(base) => {
                let base = self.get(base);
                self.b.ins().iadd_imm_u(base, i64::from(addr.offset))
            }
        };
        self.set(dst, value);
    }
}
