//! Copying and comparing zero-ended strings: eight bytes at a time as long as no zero is among them, then unit by unit.

use super::address::Place;
use super::function::Translator;
use crate::mir::model::{Addr, Local};
use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{Block, InstBuilder, Type, Value, types};

/// Bytes of a word.
const WORD: u32 = 8;

fn unit_type(unit: u32) -> Type {
    if unit == 1 { types::I8 } else { types::I16 }
}

impl Translator<'_, '_> {
    pub(super) fn copy_string(&mut self, to: (Addr, u32), from: (Addr, u32), unit: u32) {
        let total = to.1.min(from.1) * unit;
        let (to, from) = (self.pointer_to(to.0), self.pointer_to(from.0));
        let ((tail, at), (end, end_at)) = (self.new_block(&[types::I64]), self.new_block(&[types::I64]));
        self.copy_words(to, from, unit, total, tail);
        self.copy_units(to, from, unit, total, (tail, at[0]), end);
        self.start(end);
        let zero = self.b.ins().iconst(unit_type(unit), 0);
        let place = self.indexed(to, end_at[0]);
        self.store(zero, place);
    }

    /// Copies whole words without a zero; then goes to `tail` with the index where it stopped.
    fn copy_words(&mut self, to: Value, from: Value, unit: u32, total: u32, tail: Block) {
        let zero = self.b.ins().iconst(types::I64, 0);
        if total < WORD {
            return self.jump(tail, &[zero]);
        }
        let ((head, at), (body, _)) = (self.new_block(&[types::I64]), self.new_block(&[]));
        self.jump(head, &[zero]);
        self.b.switch_to_block(head);
        let place = self.indexed(from, at[0]);
        let word = self.load(types::I64, place);
        let ends = self.has_zero(word, unit);
        self.branch(ends, (tail, &[at[0]]), (body, &[]));
        self.start(body);
        let place = self.indexed(to, at[0]);
        self.store(word, place);
        self.next_word(at[0], total, head, tail);
    }

    /// Copies units up to a zero or `total` bytes; then goes to `end` with the index of the zero to write.
    fn copy_units(&mut self, to: Value, from: Value, unit: u32, total: u32, (tail, i): (Block, Value), end: Block) {
        let ((read, _), (write, _)) = (self.new_block(&[]), self.new_block(&[]));
        self.b.switch_to_block(tail);
        let full = self.b.ins().icmp_imm_u(IntCC::UnsignedGreaterThanOrEqual, i, i64::from(total));
        self.branch(full, (end, &[i]), (read, &[]));
        self.start(read);
        let place = self.indexed(from, i);
        let value = self.load(unit_type(unit), place);
        self.branch(value, (write, &[]), (end, &[i]));
        self.start(write);
        let place = self.indexed(to, i);
        self.store(value, place);
        let next = self.b.ins().iadd_imm_u(i, i64::from(unit));
        self.jump(tail, &[next]);
        self.b.seal_block(tail);
    }

    pub(super) fn compare_string(&mut self, dst: Local, a: (Addr, u32), b: (Addr, u32), unit: u32) {
        let total = a.1.min(b.1) * unit;
        let longer = (a.1 * unit > total, b.1 * unit > total);
        let (a, b) = (self.pointer_to(a.0), self.pointer_to(b.0));
        let ((tail, at), (rest, _)) = (self.new_block(&[types::I64]), self.new_block(&[]));
        let (done, order) = self.new_block(&[types::I8]);
        self.compare_words(a, b, unit, total, tail);
        self.compare_units(a, b, unit, total, (tail, at[0]), rest, done);
        self.start(rest);
        let order_of_rest = self.compare_rest(a, b, unit, total, longer);
        self.jump(done, &[order_of_rest]);
        self.start(done);
        self.set(dst, order[0]);
    }

    /// Skips whole words that are equal and have no zero; then goes to `tail` with the index where it stopped.
    fn compare_words(&mut self, a: Value, b: Value, unit: u32, total: u32, tail: Block) {
        let zero = self.b.ins().iconst(types::I64, 0);
        if total < WORD {
            return self.jump(tail, &[zero]);
        }
        let ((head, at), (body, _)) = (self.new_block(&[types::I64]), self.new_block(&[]));
        self.jump(head, &[zero]);
        self.b.switch_to_block(head);
        let (place_a, place_b) = (self.indexed(a, at[0]), self.indexed(b, at[0]));
        let (word_a, word_b) = (self.load(types::I64, place_a), self.load(types::I64, place_b));
        let differ = self.b.ins().bxor(word_a, word_b);
        let ends = self.has_zero(word_a, unit);
        let stop = self.b.ins().bor(differ, ends);
        self.branch(stop, (tail, &[at[0]]), (body, &[]));
        self.start(body);
        self.next_word(at[0], total, head, tail);
    }

    /// Compares units up to a difference or a zero (then goes to `done` with the order) or `total` bytes (then to `rest`).
    #[allow(clippy::too_many_arguments)] // two strings and three ways on
    fn compare_units(&mut self, a: Value, b: Value, unit: u32, total: u32, (tail, i): (Block, Value), rest: Block, done: Block) {
        let ((read, _), (same, _), (next, _)) = (self.new_block(&[]), self.new_block(&[]), self.new_block(&[]));
        self.b.switch_to_block(tail);
        let full = self.b.ins().icmp_imm_u(IntCC::UnsignedGreaterThanOrEqual, i, i64::from(total));
        self.branch(full, (rest, &[]), (read, &[]));
        self.start(read);
        let (place_a, place_b) = (self.indexed(a, i), self.indexed(b, i));
        let (unit_a, unit_b) = (self.load(unit_type(unit), place_a), self.load(unit_type(unit), place_b));
        let order = self.order(unit_a, unit_b);
        self.branch(order, (done, &[order]), (same, &[]));
        self.start(same);
        self.branch(unit_a, (next, &[]), (done, &[order]));
        self.start(next);
        let after = self.b.ins().iadd_imm_u(i, i64::from(unit));
        self.jump(tail, &[after]);
        self.b.seal_block(tail);
    }

    /// Both are equal for `total` bytes without an end; the one with the larger capacity may go on.
    fn compare_rest(&mut self, a: Value, b: Value, unit: u32, total: u32, longer: (bool, bool)) -> Value {
        let zero = self.b.ins().iconst(unit_type(unit), 0);
        let offset = total as i32;
        let unit_a = if longer.0 { self.load(unit_type(unit), Place { base: a, offset }) } else { zero };
        let unit_b = if longer.1 { self.load(unit_type(unit), Place { base: b, offset }) } else { zero };
        self.order(unit_a, unit_b)
    }

    /// -1, 0 or 1 as I8: order of two unsigned values.
    fn order(&mut self, a: Value, b: Value) -> Value {
        let above = self.b.ins().icmp(IntCC::UnsignedGreaterThan, a, b);
        let below = self.b.ins().icmp(IntCC::UnsignedLessThan, a, b);
        self.b.ins().isub(above, below)
    }

    /// Not 0 if a unit of the word is 0: only there does the subtraction set the highest bit of a unit that had it clear, or in a
    /// unit above one that is 0.
    fn has_zero(&mut self, word: Value, unit: u32) -> Value {
        let (ones, highs) = if unit == 1 {
            (0x0101_0101_0101_0101_u64, 0x8080_8080_8080_8080_u64)
        } else {
            (0x0001_0001_0001_0001, 0x8000_8000_8000_8000)
        };
        let ones = self.b.ins().iconst(types::I64, ones as i64);
        let highs = self.b.ins().iconst(types::I64, highs as i64);
        let less = self.b.ins().isub(word, ones);
        let clear = self.b.ins().bnot(word);
        let set = self.b.ins().band(less, clear);
        self.b.ins().band(set, highs)
    }

    /// To the next word in `head`, or to `tail` if no whole word is left.
    fn next_word(&mut self, i: Value, total: u32, head: Block, tail: Block) {
        let next = self.b.ins().iadd_imm_u(i, i64::from(WORD));
        let whole = i64::from(total - total % WORD);
        let more = self.b.ins().icmp_imm_u(IntCC::UnsignedLessThan, next, whole);
        self.branch(more, (head, &[next]), (tail, &[next]));
        self.b.seal_block(head);
    }

    fn pointer_to(&mut self, addr: Addr) -> Value {
        let place = self.place(addr);
        self.pointer(place)
    }

    fn indexed(&mut self, base: Value, i: Value) -> Place {
        Place { base: self.b.ins().iadd(base, i), offset: 0 }
    }
}
