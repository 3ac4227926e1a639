//! Copying and comparing zero-ended strings: eight bytes at a time as far as the smaller capacity has whole words, then unit by unit.

use super::address::Place;
use super::function::Translator;
use crate::mir::model::{Addr, Local};
use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{Block, InstBuilder, Type, Value, types};

/// Bytes of a word.
const WORD: u32 = 8;

/// Two strings of which `total` bytes are looked at.
#[derive(Clone, Copy)]
struct Pair {
    /// Pointer to the target, or to the left side.
    a: Value,
    /// Pointer to the source, or to the right side.
    b: Value,
    unit: u32,
    total: u32,
}

impl Pair {
    fn unit_type(self) -> Type {
        if self.unit == 1 { types::I8 } else { types::I16 }
    }
    /// Bytes in whole words.
    fn whole(self) -> u32 {
        self.total - self.total % WORD
    }
}

impl Translator<'_, '_> {
    pub(super) fn copy_string(&mut self, to: (Addr, u32), from: (Addr, u32), unit: u32) {
        let pair = Pair { a: self.pointer_to(to.0), b: self.pointer_to(from.0), unit, total: to.1.min(from.1) * unit };
        let ((done, _), (end, end_at)) = (self.new_block(&[]), self.new_block(&[types::I64]));
        self.copy_words(pair, done);
        self.copy_units(pair, end);
        self.start(end);
        let zero = self.b.ins().iconst(pair.unit_type(), 0);
        let place = self.indexed(pair.a, end_at[0]);
        self.store(zero, place);
        self.jump(done, &[]);
        self.start(done);
    }

    /// Copies whole words. At a word with a zero it goes to `done`, else it goes on behind the last word.
    fn copy_words(&mut self, pair: Pair, done: Block) {
        if pair.whole() == 0 {
            return;
        }
        let zero = self.b.ins().iconst(types::I64, 0);
        let (head, i) = self.loop_from(zero);
        let ((last, _), (body, _)) = (self.new_block(&[]), self.new_block(&[]));
        let place = self.indexed(pair.b, i);
        let word = self.load(types::I64, place);
        let zeros = self.zeros(word, pair.unit);
        self.branch(zeros, (last, &[]), (body, &[]));
        self.start(last);
        self.store_last(pair, i, word, zeros);
        self.jump(done, &[]);
        self.start(body);
        let place = self.indexed(pair.a, i);
        self.store(word, place);
        self.next_word(pair, i, head);
    }

    /// Stores the word up to its first zero; what the target has behind it stays.
    fn store_last(&mut self, pair: Pair, i: Value, word: Value, zeros: Value) {
        let place = self.indexed(pair.a, i);
        let old = self.load(types::I64, place);
        let mask = self.up_to_first(zeros);
        let merged = self.b.ins().bitselect(mask, word, old);
        self.store(merged, place);
    }

    /// Copies what is left behind the whole words, unit by unit; then goes to `end` with the index of the zero to write.
    fn copy_units(&mut self, pair: Pair, end: Block) {
        let start = self.b.ins().iconst(types::I64, i64::from(pair.whole()));
        if pair.total == pair.whole() {
            return self.jump(end, &[start]);
        }
        let (head, i) = self.loop_from(start);
        let (write, _) = self.new_block(&[]);
        let place = self.indexed(pair.b, i);
        let value = self.load(pair.unit_type(), place);
        self.branch(value, (write, &[]), (end, &[i]));
        self.start(write);
        let place = self.indexed(pair.a, i);
        self.store(value, place);
        let (next, more) = self.next_unit(pair, i);
        self.branch(more, (head, &[next]), (end, &[next]));
        self.b.seal_block(head);
    }

    pub(super) fn compare_string(&mut self, dst: Local, a: (Addr, u32), b: (Addr, u32), unit: u32) {
        let pair = Pair { a: self.pointer_to(a.0), b: self.pointer_to(b.0), unit, total: a.1.min(b.1) * unit };
        let (done, order) = self.new_block(&[types::I8]);
        self.compare_words(pair, done);
        self.compare_units(pair, done);
        let rest = self.compare_rest(pair, a.1 > b.1, b.1 > a.1);
        self.jump(done, &[rest]);
        self.start(done);
        self.set(dst, order[0]);
    }

    /// Skips whole words that are equal and have no zero. At any other it goes to `done` with the order, if the strings differ or
    /// end there; else it goes on behind the last word.
    fn compare_words(&mut self, pair: Pair, done: Block) {
        if pair.whole() == 0 {
            return;
        }
        let zero = self.b.ins().iconst(types::I64, 0);
        let (head, i) = self.loop_from(zero);
        let ((last, _), (body, _)) = (self.new_block(&[]), self.new_block(&[]));
        let (place_a, place_b) = (self.indexed(pair.a, i), self.indexed(pair.b, i));
        let (word_a, word_b) = (self.load(types::I64, place_a), self.load(types::I64, place_b));
        let differ = self.b.ins().bxor(word_a, word_b);
        let zeros = self.zeros(word_a, pair.unit);
        let stop = self.b.ins().bor(differ, zeros);
        self.branch(stop, (last, &[]), (body, &[]));
        self.start(last);
        let order = self.order_of_words(word_a, word_b, zeros, pair.unit);
        self.jump(done, &[order]);
        self.start(body);
        self.next_word(pair, i, head);
    }

    /// Order of two words up to the first zero of `a`. The first unit counts most.
    fn order_of_words(&mut self, a: Value, b: Value, zeros: Value, unit: u32) -> Value {
        let mask = self.up_to_first(zeros);
        let (a, b) = (self.b.ins().band(a, mask), self.b.ins().band(b, mask));
        let (a, b) = (self.first_unit_high(a, unit), self.first_unit_high(b, unit));
        self.order(a, b)
    }

    /// Reverses the units of a word.
    fn first_unit_high(&mut self, word: Value, unit: u32) -> Value {
        let swapped = self.b.ins().bswap(word);
        if unit == 1 {
            return swapped;
        }
        let low = self.b.ins().iconst(types::I64, 0x00ff_00ff_00ff_00ff);
        let even = self.b.ins().band(swapped, low);
        let even = self.b.ins().ishl_imm_u(even, 8);
        let odd = self.b.ins().ushr_imm_u(swapped, 8);
        let odd = self.b.ins().band(odd, low);
        self.b.ins().bor(even, odd)
    }

    /// Compares what is left behind the whole words, unit by unit. Goes to `done` with the order at a difference or a zero.
    fn compare_units(&mut self, pair: Pair, done: Block) {
        if pair.total == pair.whole() {
            return;
        }
        let start = self.b.ins().iconst(types::I64, i64::from(pair.whole()));
        let (head, i) = self.loop_from(start);
        let ((same, _), (next, _)) = (self.new_block(&[]), self.new_block(&[]));
        let (place_a, place_b) = (self.indexed(pair.a, i), self.indexed(pair.b, i));
        let (unit_a, unit_b) = (self.load(pair.unit_type(), place_a), self.load(pair.unit_type(), place_b));
        let order = self.order(unit_a, unit_b);
        self.branch(order, (done, &[order]), (same, &[]));
        self.start(same);
        self.branch(unit_a, (next, &[]), (done, &[order]));
        self.start(next);
        let (after, more) = self.next_unit(pair, i);
        self.loop_while(more, head, after);
    }

    /// Both are equal for `total` bytes without an end; the one with the larger capacity may go on.
    fn compare_rest(&mut self, pair: Pair, a_longer: bool, b_longer: bool) -> Value {
        let zero = self.b.ins().iconst(pair.unit_type(), 0);
        let offset = pair.total as i32;
        let unit_a = if a_longer { self.load(pair.unit_type(), Place { base: pair.a, offset }) } else { zero };
        let unit_b = if b_longer { self.load(pair.unit_type(), Place { base: pair.b, offset }) } else { zero };
        self.order(unit_a, unit_b)
    }

    /// -1, 0 or 1 as I8: order of two unsigned values.
    fn order(&mut self, a: Value, b: Value) -> Value {
        let above = self.b.ins().icmp(IntCC::UnsignedGreaterThan, a, b);
        let below = self.b.ins().icmp(IntCC::UnsignedLessThan, a, b);
        self.b.ins().isub(above, below)
    }

    /// Marks zero units by their highest bit. The lowest mark is right; marks above it may be wrong, since the subtraction borrows.
    fn zeros(&mut self, word: Value, unit: u32) -> Value {
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

    /// All bits up to the lowest mark; all bits if there is none.
    fn up_to_first(&mut self, zeros: Value) -> Value {
        let one = self.b.ins().iconst(types::I64, 1);
        let below = self.b.ins().isub(zeros, one);
        self.b.ins().bxor(zeros, below)
    }

    /// To the next word, or on behind the loop.
    fn next_word(&mut self, pair: Pair, i: Value, head: Block) {
        let next = self.b.ins().iadd_imm_u(i, i64::from(WORD));
        let more = self.b.ins().icmp_imm_u(IntCC::UnsignedLessThan, next, i64::from(pair.whole()));
        self.loop_while(more, head, next);
    }

    /// Index of the next unit, and whether there is one.
    fn next_unit(&mut self, pair: Pair, i: Value) -> (Value, Value) {
        let next = self.b.ins().iadd_imm_u(i, i64::from(pair.unit));
        let more = self.b.ins().icmp_imm_u(IntCC::UnsignedLessThan, next, i64::from(pair.total));
        (next, more)
    }

    fn pointer_to(&mut self, addr: Addr) -> Value {
        let place = self.place(addr);
        self.pointer(place)
    }

    fn indexed(&mut self, base: Value, i: Value) -> Place {
        Place { base: self.b.ins().iadd(base, i), offset: 0 }
    }
}
