//! Places: where a variable, field, element, bit or character is, and how it is read and written.

use super::builder::{at, behind, fixed};
use super::pointer::Purpose;
use super::shape::{Shape, shape};
use super::unit::{Home, Unit};
use crate::hir::model::*;
use crate::mir::model::*;
use takt_image::image::Place as ImagePlace;
use takt_image::types::{Dim, Field};
use takt_image::{Scalar, Trap, Type, TypeId, TypeTable};

/// Where a value is.
#[derive(Clone, Copy, Debug)]
pub enum Loc {
    /// In a register.
    Register(Local),
    /// In memory.
    Memory(Addr),
    /// One bit of a byte in memory.
    Bit(Addr, u32),
    /// Bits of a register.
    Part { register: Local, bit: u32, width: u32 },
}

/// A field of a record type.
pub fn field(types: &TypeTable, record: TypeId, index: u32) -> Option<&Field> {
    match types.get(record) {
        Type::Struct(r) | Type::Instance(r) => r.fields.get(index as usize),
        _ => None,
    }
}

impl Unit<'_, '_> {
    /// Evaluates the index expressions of a place, with their checks, and says where it is.
    pub fn place(&mut self, p: &Place) -> Loc {
        self.place_for(p, Purpose::Write)
    }

    /// The same, with the checks for what is done there: what a pointer leads to is checked when the place is known.
    pub fn place_for(&mut self, p: &Place, purpose: Purpose) -> Loc {
        let mut path = p.path.as_slice();
        let (mut loc, mut ty) = match (&p.base, path) {
            (&Base::Var(v), [first, rest @ ..]) if matches!(self.homes[v], Home::Open(_)) => {
                path = rest;
                self.open_step(v, first, p.ty)
            }
            _ => self.base(p),
        };
        let mut pointed = false;
        for step in path {
            match step {
                Step::Deref => {
                    if pointed {
                        loc = self.checked(loc, ty, Purpose::Read);
                    }
                    loc = Loc::Memory(at(self.pointer(loc, ty, purpose)));
                    ty = self.pointee(ty);
                    pointed = true;
                    continue;
                }
                Step::Part { .. } | Step::Character(_) if pointed => {
                    loc = self.checked(loc, ty, purpose);
                    pointed = false;
                }
                Step::Index(list) if matches!(self.shape(ty), Shape::Text { .. }) => {
                    (loc, ty) = (self.text_unit(loc, ty, list), p.ty);
                    continue;
                }
                _ => {}
            }
            (loc, ty) = self.step(loc, ty, step);
        }
        if pointed { self.checked(loc, ty, purpose) } else { loc }
    }

    /// A unit of a string by its number from 0, the zero behind the last included (vendor).
    fn text_unit(&mut self, loc: Loc, ty: TypeId, index: &[Expr]) -> Loc {
        let (Loc::Memory(addr), Shape::Text { capacity, unit }) = (loc, self.shape(ty)) else {
            unreachable!("strings are in memory")
        };
        let dim = Dim { low: 0, high: i32::try_from(capacity).unwrap_or(i32::MAX) };
        Loc::Memory(self.element_of_size(addr, unit, &[dim], index))
    }

    /// An element, or a word of the descriptor, of an array of variable length.
    fn open_step(&mut self, v: VarId, step: &Step, last: TypeId) -> (Loc, TypeId) {
        let (Home::Open(array), Type::Open { element, .. }) = (self.homes[v], self.hir.types.get(self.var(v).ty)) else {
            unreachable!("an array of variable length")
        };
        match step {
            Step::Index(indices) => (Loc::Memory(self.open_element(array, *element, indices)), *element),
            Step::Field(i) => (self.open_word(array, *i), last),
            _ => unreachable!("it has elements and bounds"),
        }
    }

    fn pointee(&self, ty: TypeId) -> TypeId {
        match self.hir.types.get(ty) {
            Type::Pointer { target, .. } => *target,
            _ => unreachable!("only references are followed"),
        }
    }

    /// A place behind a pointer, checked.
    fn checked(&mut self, loc: Loc, ty: TypeId, purpose: Purpose) -> Loc {
        match (loc, purpose) {
            (Loc::Memory(addr), Purpose::Read | Purpose::Write) => {
                Loc::Memory(self.reachable(addr, self.hir.types.layout(ty).size, purpose))
            }
            _ => loc,
        }
    }

    fn base(&mut self, p: &Place) -> (Loc, TypeId) {
        match &p.base {
            Base::Value(e) => (Loc::Register(self.value(e)), e.ty),
            Base::This => (Loc::Memory(self.this.expect("only types have instances")), self.this_type()),
            &Base::Var(v) => (self.home(v), self.var(v).ty),
            &Base::Global(g) => (image_loc(self.program.view.globals[g]), self.hir.globals[g].ty),
            &Base::Image(place) => (image_loc(place), p.ty),
        }
    }

    fn home(&self, v: VarId) -> Loc {
        match self.homes[v] {
            Home::Register(l) => Loc::Register(l),
            Home::Memory(a) => Loc::Memory(a),
            Home::Image(place) => image_loc(place),
            Home::Open(_) => unreachable!("an array of variable length is not used as a whole"),
        }
    }

    fn step(&mut self, loc: Loc, ty: TypeId, step: &Step) -> (Loc, TypeId) {
        match (step, loc) {
            (Step::Field(i), Loc::Memory(addr)) => {
                let f = field(&self.hir.types, ty, *i).expect("a field of this record");
                (Loc::Memory(behind(addr, f.offset)), f.ty)
            }
            (Step::Index(indices), Loc::Memory(addr)) => {
                let Type::Array { element, dims } = self.hir.types.get(ty) else { unreachable!("only arrays are indexed") };
                (Loc::Memory(self.element(addr, *element, dims, indices)), *element)
            }
            (Step::Character(index), Loc::Memory(addr)) => (Loc::Memory(self.character(addr, ty, index)), ty),
            (Step::Part { bit, width }, Loc::Memory(addr)) if width % 8 == 0 && bit % 8 == 0 => {
                (Loc::Memory(behind(addr, bit / 8)), ty)
            }
            (Step::Part { bit, .. }, Loc::Memory(addr)) => (Loc::Bit(behind(addr, bit / 8), bit % 8), ty),
            (Step::Part { bit, width }, Loc::Register(register)) => (Loc::Part { register, bit: *bit, width: *width }, ty),
            (Step::Part { .. }, Loc::Bit(..)) => (loc, ty),
            _ => unreachable!("steps go through memory; parts come last"),
        }
    }

    /// Address of a character; traps outside of the current length, which is where the first zero is.
    fn character(&mut self, text: Addr, ty: TypeId, index: &Expr) -> Addr {
        let Shape::Text { capacity, unit } = shape(&self.hir.types, ty) else { unreachable!("only strings have characters") };
        let line = self.at_line(index.span);
        let index = self.index_value(index);
        let wide = self.f.resize(index, Scalar::I64, true);
        let from_zero = self.f.binary_const(BinaryOp::Sub, wide, 1);
        let outside = self.f.compare_const(Compare::UGe, from_zero, capacity as i64);
        self.f.trap_if(Trap::StringIndex, outside);
        let position = self.f.resize(from_zero, Scalar::I32, false);
        let start = self.f.address(text);
        let offset = self.f.binary_const(BinaryOp::Mul, position, unit as i64);
        let target = self.f.binary(BinaryOp::Add, start, offset);
        let bytes = (capacity as u64 + 1) * unit as u64;
        let cursor = self.f.duplicate(start);
        self.f.within(cursor, text, bytes);
        self.no_zero_up_to(cursor, target, unit);
        self.f.line = line;
        self.f.within(target, text, bytes)
    }

    /// Moves the cursor to `last`; traps at a zero unit on the way or there.
    fn no_zero_up_to(&mut self, cursor: Local, last: Local, unit: u32) {
        let (head, next, done) = (self.f.block(), self.f.block(), self.f.block());
        self.f.jump(head);
        self.f.enter(head);
        let c = self.f.load(if unit == 1 { Scalar::I8 } else { Scalar::I16 }, at(cursor));
        let ended = self.f.compare_const(Compare::Eq, c, 0);
        self.f.trap_if(Trap::StringIndex, ended);
        let found = self.f.compare(Compare::Eq, cursor, last);
        self.f.branch(found, done, next);
        self.f.enter(next);
        let moved = self.f.binary_const(BinaryOp::Add, cursor, unit as i64);
        self.f.copy(cursor, moved);
        self.f.jump(head);
        self.f.enter(done);
    }

    /// Reads a scalar.
    pub fn load(&mut self, loc: Loc, ty: TypeId) -> Local {
        let s = self.scalar(ty);
        match loc {
            Loc::Register(l) => l,
            Loc::Memory(addr) => self.f.load(s, addr),
            Loc::Bit(addr, bit) => {
                let byte = self.f.load(Scalar::I8, addr);
                self.bits(byte, bit, 1, Scalar::I8)
            }
            Loc::Part { register, bit, width } => self.bits(register, bit, width, s),
        }
    }

    fn bits(&mut self, from: Local, bit: u32, width: u32, to: Scalar) -> Local {
        let low = if bit == 0 { from } else { self.f.binary_const(BinaryOp::LShr, from, bit as i64) };
        let cut = self.f.resize(low, to, false);
        if width == 8 * to.bytes() { cut } else { self.f.binary_const(BinaryOp::And, cut, mask(width)) }
    }

    /// Writes a scalar.
    pub fn store(&mut self, loc: Loc, value: Local) {
        match loc {
            Loc::Register(l) => self.f.copy(l, value),
            Loc::Memory(addr) => self.f.store(addr, value),
            Loc::Bit(addr, bit) => {
                let byte = self.f.load(Scalar::I8, addr);
                let merged = self.merge(byte, value, bit, 1);
                self.f.store(addr, merged);
            }
            Loc::Part { register, bit, width } => {
                let merged = self.merge(register, value, bit, width);
                self.f.copy(register, merged);
            }
        }
    }

    /// `whole` with `value` in the bits from `bit` on.
    fn merge(&mut self, whole: Local, value: Local, bit: u32, width: u32) -> Local {
        let ty = self.f.ty(whole);
        let wide = self.f.resize(value, ty, false);
        let there = if bit == 0 { wide } else { self.f.binary_const(BinaryOp::Shl, wide, bit as i64) };
        let kept = self.f.binary_const(BinaryOp::And, whole, !(mask(width) << bit));
        self.f.binary(BinaryOp::Or, kept, there)
    }

    /// The register of a scalar type.
    pub fn scalar(&self, ty: TypeId) -> Scalar {
        match shape(&self.hir.types, ty) {
            Shape::Scalar(e) => e.scalar(),
            _ => unreachable!("{} is not a scalar", self.hir.types.display(ty)),
        }
    }
}

/// The lowest `width` bits.
fn mask(width: u32) -> i64 {
    if width >= 64 { -1 } else { (1 << width) - 1 }
}

pub fn image_loc(place: ImagePlace) -> Loc {
    match place {
        ImagePlace::Byte(offset) => Loc::Memory(fixed(offset)),
        ImagePlace::Bit(offset, bit) => Loc::Bit(fixed(offset), bit as u32),
    }
}
