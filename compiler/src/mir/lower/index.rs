//! Array elements: a bounds check for each subscript that is not proven to be inside, then one multiplication each.

use super::builder::behind;
use super::unit::Unit;
use crate::hir::model::*;
use crate::mir::model::*;
use takt_image::types::Dim;
use takt_image::{Scalar, Trap, TypeId};

impl Unit<'_, '_> {
    /// Address of `array[indices]`. Each subscript traps (Index) outside of its own dimension.
    pub fn element(&mut self, array: Addr, element: TypeId, dims: &[Dim], indices: &[Expr]) -> Addr {
        self.element_of_size(array, self.hir.types.layout(element).size, dims, indices)
    }

    /// The same for elements of `size` bytes.
    pub fn element_of_size(&mut self, array: Addr, size: u32, dims: &[Dim], indices: &[Expr]) -> Addr {
        let strides = strides(size, dims);
        let mut fixed = 0u32;
        let mut moving = None;
        for ((index, dim), stride) in indices.iter().zip(dims).zip(&strides) {
            match self.interval(index) {
                Some((i, j)) if i == j && inside(i, dim) => {
                    fixed = fixed.saturating_add(((i - dim.low as i128) as u32).saturating_mul(*stride))
                }
                _ => {
                    let bytes = self.subscript(index, dim, *stride);
                    moving = Some(moving.map_or(bytes, |sum| self.f.binary(BinaryOp::Add, sum, bytes)));
                }
            }
        }
        let start = behind(array, fixed);
        let size = dims.iter().fold(size, |size, d| size.saturating_mul(d.len()));
        moving.map_or(start, |bytes| self.moved(start, bytes, array, size))
    }

    /// Bytes from the start of the dimension to subscript `index`.
    fn subscript(&mut self, index: &Expr, dim: &Dim, stride: u32) -> Local {
        let line = self.at_line(index.span);
        let proven = self.interval(index).is_some_and(|(i, j)| inside(i, dim) && inside(j, dim));
        let value = self.index_value(index);
        if !proven && dim.low < 0 && self.is_ulint(index) {
            self.no_large_unsigned(value, dim);
        }
        let from_low = if dim.low == 0 { value } else { self.f.binary_const(BinaryOp::Sub, value, dim.low as i64) };
        if !proven {
            let outside = self.f.compare_const(Compare::UGe, from_low, dim.len() as i64);
            self.f.trap_if(Trap::Index, outside);
        }
        self.f.line = line;
        let small = self.f.resize(from_low, Scalar::I32, false);
        if stride == 1 { small } else { self.f.binary_const(BinaryOp::Mul, small, stride as i64) }
    }

    /// Value of a subscript in an I32 or I64 that has room for it, so that it can't wrap into the bounds.
    pub fn index_value(&mut self, index: &Expr) -> Local {
        let e = self.hir.elementary(index.ty).expect("a subscript is an integer");
        let value = self.value(index);
        let fits = e.bytes() < 4 || (e.bytes() == 4 && e.is_signed_storage());
        self.f.resize(value, if fits { Scalar::I32 } else { Scalar::I64 }, e.is_signed_storage())
    }

    /// True for a ULINT that was converted to LINT, where its upper half became negative.
    pub fn is_ulint(&self, index: &Expr) -> bool {
        let ExprKind::Convert(Conversion::Integer, inner) = &index.kind else { return false };
        self.hir.elementary(inner.ty).is_some_and(|e| e.bytes() == 8 && !e.is_signed_storage())
    }

    fn no_large_unsigned(&mut self, value: Local, dim: &Dim) {
        let end = (dim.high as i64 + 1).max(0);
        let outside = self.f.compare_const(Compare::UGe, value, end);
        self.f.trap_if(Trap::Index, outside);
    }

    /// `start + bytes`, which is within the array.
    fn moved(&mut self, start: Addr, bytes: Local, array: Addr, size: u32) -> Addr {
        let (local, offset) = match start.base {
            AddrBase::Static => (bytes, start.offset),
            AddrBase::Local(base) => (self.f.binary(BinaryOp::Add, base, bytes), start.offset),
            AddrBase::Frame => {
                let base = self.f.address(start);
                (self.f.binary(BinaryOp::Add, base, bytes), 0)
            }
        };
        behind(self.f.within(local, array, size as u64), offset)
    }
}

/// Bytes from one element to the next, in each dimension.
fn strides(element: u32, dims: &[Dim]) -> Vec<u32> {
    let inner = |d: usize| dims[d + 1..].iter().fold(element, |size, d| size.saturating_mul(d.len()));
    (0..dims.len()).map(inner).collect()
}

fn inside(i: i128, dim: &Dim) -> bool {
    (dim.low as i128..=dim.high as i128).contains(&i)
}
