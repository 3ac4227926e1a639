//! Arrays of variable length: the descriptor that the caller makes on its frame, and the registers that the unit keeps it in.
//! From: language reference §2.7.

use super::builder::{at, behind, fixed};
use super::place::Loc;
use super::unit::{Home, Unit};
use crate::hir::model::*;
use crate::mir::model::*;
use crate::mir::region::{Object, Region};
use takt_image::{Scalar, Trap, Type, TypeId, header};

/// A parameter in registers: I32 each.
#[derive(Clone, Debug)]
pub struct OpenArray {
    /// Place of the first element.
    pub start: Local,
    /// Bounds of each dimension.
    pub bounds: Vec<(Local, Local)>,
}

impl Unit<'_, '_> {
    /// True for an array of variable length.
    pub fn is_open(&self, ty: TypeId) -> bool {
        matches!(self.hir.types.get(ty), Type::Open { .. })
    }

    /// Loads the descriptor that a parameter refers to.
    pub fn open_home(&mut self, descriptor: Local, ty: TypeId) -> Home {
        let Type::Open { element, dims } = *self.hir.types.get(ty) else { unreachable!("an array of variable length") };
        let mut word = |i: u32| self.f.load(Scalar::I32, behind(at(descriptor), 4 * i));
        let start = word(0);
        let bounds = (0..dims).map(|d| (word(1 + 2 * d), word(2 + 2 * d))).collect();
        let array = OpenArray { start, bounds };
        self.check_open(&array, element);
        self.f.regions.set(array.start, Region::whole(Object::Any));
        self.open.push(array);
        Home::Open(self.open.len() - 1)
    }

    /// Pointers could have changed which descriptor that is: traps if the elements are not all within the memory.
    fn check_open(&mut self, array: &OpenArray, element: TypeId) {
        if !self.program.wild {
            return;
        }
        let mut bytes = self.f.int(Scalar::I64, self.hir.types.layout(element).size.into());
        let limit = self.f.load(Scalar::I32, fixed(header::FRAME_LIMIT));
        let limit = self.f.resize(limit, Scalar::I64, false);
        for &(low, high) in &array.bounds {
            let count = self.length(low, high);
            let many = self.f.binary(BinaryOp::Or, bytes, count);
            let many = self.f.compare_const(Compare::UGe, many, 1 << 31);
            self.f.trap_if(Trap::WildPointer, many);
            bytes = self.f.binary(BinaryOp::Mul, bytes, count);
        }
        let start = self.f.resize(array.start, Scalar::I64, false);
        let end = self.f.binary(BinaryOp::Add, start, bytes);
        let header = self.f.compare_const(Compare::ULt, start, header::SIZE.into());
        let beyond = self.f.compare(Compare::UGt, end, limit);
        let outside = self.f.binary(BinaryOp::Or, header, beyond);
        self.f.trap_if(Trap::WildPointer, outside);
    }

    /// Number of elements between two bounds, in an I64.
    fn length(&mut self, low: Local, high: Local) -> Local {
        let (low, high) = (self.f.resize(low, Scalar::I64, true), self.f.resize(high, Scalar::I64, true));
        let distance = self.f.binary(BinaryOp::Sub, high, low);
        self.f.binary_const(BinaryOp::Add, distance, 1)
    }

    /// A bound, or the place of the first element, by its number in the descriptor.
    pub fn open_word(&self, array: usize, index: u32) -> Loc {
        let array = &self.open[array];
        match index.checked_sub(1) {
            None => Loc::Register(array.start),
            Some(i) => {
                let (low, high) = array.bounds[(i / 2) as usize];
                Loc::Register(if i % 2 == 0 { low } else { high })
            }
        }
    }

    /// Address of an element; each subscript traps (Index) outside of its own dimension.
    pub fn open_element(&mut self, array: usize, element: TypeId, indices: &[Expr]) -> Addr {
        let OpenArray { start, bounds } = self.open[array].clone();
        let mut flat = self.f.int(Scalar::I32, 0);
        for (index, (low, high)) in indices.iter().zip(bounds) {
            let line = self.at_line(index.span);
            let value = self.index_value(index);
            if self.is_ulint(index) {
                let huge = self.f.compare_const(Compare::SLt, value, 0);
                self.f.trap_if(Trap::Index, huge);
            }
            let value = self.f.resize(value, Scalar::I64, true);
            let (low, count) = (self.f.resize(low, Scalar::I64, true), self.length(low, high));
            let from_low = self.f.binary(BinaryOp::Sub, value, low);
            let outside = self.f.compare(Compare::UGe, from_low, count);
            self.f.trap_if(Trap::Index, outside);
            let (from_low, count) = (self.f.resize(from_low, Scalar::I32, false), self.f.resize(count, Scalar::I32, false));
            let row = self.f.binary(BinaryOp::Mul, flat, count);
            flat = self.f.binary(BinaryOp::Add, row, from_low);
            self.f.line = line;
        }
        let size = self.hir.types.layout(element).size;
        let bytes = self.f.binary_const(BinaryOp::Mul, flat, size.into());
        let place = self.f.binary(BinaryOp::Add, start, bytes);
        self.f.regions.set(place, Region::whole(Object::Any));
        at(place)
    }

    /// Makes the descriptor of an actual on the frame.
    pub fn describe(&mut self, p: &Place) -> Addr {
        let words = match self.hir.types.get(p.ty) {
            Type::Open { dims, .. } => {
                let Base::Var(v) = p.base else { unreachable!("only parameters have a variable length") };
                let Home::Open(array) = self.homes[v] else { unreachable!("a parameter in registers") };
                (0..1 + 2 * *dims).map(|i| self.open_word(array, i)).collect::<Vec<_>>()
            }
            Type::Array { dims, .. } => {
                let dims = dims.clone();
                let start = self.memory(p, super::pointer::Purpose::Write);
                let start = self.f.address(start);
                let bounds = dims.iter().flat_map(|d| [d.low, d.high]);
                let bounds = bounds.map(|b| Loc::Register(self.f.int(Scalar::I32, b.into()))).collect::<Vec<_>>();
                [Loc::Register(start)].into_iter().chain(bounds).collect()
            }
            _ => unreachable!("only arrays have bounds"),
        };
        let to = self.f.temp(4 * words.len() as u32, 4);
        for (i, word) in words.into_iter().enumerate() {
            if let Loc::Register(value) = word {
                self.f.store(behind(to, 4 * i as u32), value);
            }
        }
        to
    }
}
