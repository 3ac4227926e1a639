//! Copying and filling runs of bytes, without help from outside.

use super::address::Place;
use super::function::Translator;
use crate::mir::model::Addr;
use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{Block, InstBuilder, Type, Value, types};

/// Up to here a copy is done in registers.
const UNROLLED: u32 = 128;
/// Bytes of a step of a loop.
const STEP: u32 = 16;

impl Translator<'_, '_> {
    /// Small runs: everything is loaded before anything is stored. Long ones: in a loop, in the direction in which no byte is
    /// overwritten before it is read.
    pub(super) fn copy_bytes(&mut self, to: Addr, from: Addr, size: u32) {
        if to == from || size == 0 {
            return;
        }
        let (to_place, from_place) = (self.place(to), self.place(from));
        if size <= UNROLLED {
            return self.copy_unrolled(to_place, from_place, size);
        }
        if to.base == from.base {
            return if to.offset < from.offset {
                self.copy_up(to_place, from_place, size)
            } else {
                self.copy_down(to_place, from_place, size)
            };
        }
        self.copy_either(to_place, from_place, size);
    }

    fn copy_unrolled(&mut self, to: Place, from: Place, size: u32) {
        let pieces = pieces(size);
        let values: Vec<Value> = pieces.iter().map(|&(offset, ty)| self.load(ty, from.plus(offset))).collect();
        for (&(offset, _), value) in pieces.iter().zip(values) {
            self.store(value, to.plus(offset));
        }
    }

    fn copy_either(&mut self, to: Place, from: Place, size: u32) {
        let (to, from) = (self.pointer(to), self.pointer(from));
        let ((up, _), (down, _), (done, _)) = (self.new_block(&[]), self.new_block(&[]), self.new_block(&[]));
        let below = self.b.ins().icmp(IntCC::UnsignedLessThan, to, from);
        self.branch(below, (up, &[]), (down, &[]));
        let (to, from) = (Place { base: to, offset: 0 }, Place { base: from, offset: 0 });
        self.start(up);
        self.copy_up(to, from, size);
        self.jump(done, &[]);
        self.start(down);
        self.copy_down(to, from, size);
        self.jump(done, &[]);
        self.start(done);
    }

    /// From the first byte on. The last step may overlap the one before, so it is loaded first.
    fn copy_up(&mut self, to: Place, from: Place, size: u32) {
        let (to, from) = (self.pointer(to), self.pointer(from));
        let last = (size - STEP) as i32;
        let tail = self.load(types::I8X16, Place { base: from, offset: last });
        let whole = size - size % STEP;
        let zero = self.b.ins().iconst(types::I64, 0);
        let (body, i) = self.loop_from(zero);
        self.copy_step(to, from, i);
        let next = self.b.ins().iadd_imm_u(i, i64::from(STEP));
        let more = self.b.ins().icmp_imm_u(IntCC::UnsignedLessThan, next, i64::from(whole));
        self.loop_while(more, body, next);
        self.store(tail, Place { base: to, offset: last });
    }

    /// From the last byte on. The first step may be overlapped, so it is loaded first.
    fn copy_down(&mut self, to: Place, from: Place, size: u32) {
        let (to, from) = (self.pointer(to), self.pointer(from));
        let head = self.load(types::I8X16, Place { base: from, offset: 0 });
        let start = self.b.ins().iconst(types::I64, i64::from(size - STEP));
        let (body, i) = self.loop_from(start);
        self.copy_step(to, from, i);
        let next = self.b.ins().iadd_imm_s(i, -i64::from(STEP));
        let more = self.b.ins().icmp_imm_s(IntCC::SignedGreaterThan, next, 0);
        self.loop_while(more, body, next);
        self.store(head, Place { base: to, offset: 0 });
    }

    fn copy_step(&mut self, to: Value, from: Value, i: Value) {
        let (to, from) = (self.b.ins().iadd(to, i), self.b.ins().iadd(from, i));
        let value = self.load(types::I8X16, Place { base: from, offset: 0 });
        self.store(value, Place { base: to, offset: 0 });
    }

    pub(super) fn fill_bytes(&mut self, to: Addr, size: u32, value: u8) {
        let place = self.place(to);
        let pattern = self.b.ins().iconst(types::I64, i64::from_le_bytes([value; 8]));
        if size <= UNROLLED {
            for (offset, ty) in pieces(size) {
                let piece = self.fill_piece(pattern, ty);
                self.store(piece, place.plus(offset));
            }
            return;
        }
        let piece = self.fill_piece(pattern, types::I8X16);
        let to = self.pointer(place);
        let zero = self.b.ins().iconst(types::I64, 0);
        let (body, i) = self.loop_from(zero);
        let at = self.b.ins().iadd(to, i);
        self.store(piece, Place { base: at, offset: 0 });
        let next = self.b.ins().iadd_imm_u(i, i64::from(STEP));
        let more = self.b.ins().icmp_imm_u(IntCC::UnsignedLessThan, next, i64::from(size - size % STEP));
        self.loop_while(more, body, next);
        self.store(piece, Place { base: to, offset: (size - STEP) as i32 });
    }

    /// The low bytes of the pattern, or twice the pattern.
    fn fill_piece(&mut self, pattern: Value, ty: Type) -> Value {
        match ty {
            types::I64 => pattern,
            types::I8X16 => self.b.ins().splat(types::I64X2, pattern),
            narrow => self.b.ins().ireduce(narrow, pattern),
        }
    }

    /// Goes on in a block whose predecessors are all known.
    pub(super) fn start(&mut self, block: Block) {
        self.b.switch_to_block(block);
        self.b.seal_block(block);
    }

    /// Begins a loop with an I64 counter.
    pub(super) fn loop_from(&mut self, start: Value) -> (Block, Value) {
        let (body, params) = self.new_block(&[types::I64]);
        self.jump(body, &[start]);
        self.b.switch_to_block(body);
        (body, params[0])
    }

    /// Ends it, and goes on behind.
    pub(super) fn loop_while(&mut self, more: Value, body: Block, next: Value) {
        let (done, _) = self.new_block(&[]);
        self.branch(more, (body, &[next]), (done, &[]));
        self.b.seal_block(body);
        self.start(done);
    }
}

/// Cuts a run into pieces of 16, 8, 4, 2 and 1 bytes: offset and type.
fn pieces(size: u32) -> Vec<(u32, Type)> {
    let mut pieces = Vec::new();
    let mut offset = 0;
    for ty in [types::I8X16, types::I64, types::I32, types::I16, types::I8] {
        while size - offset >= ty.bytes() {
            pieces.push((offset, ty));
            offset += ty.bytes();
        }
    }
    pieces
}
