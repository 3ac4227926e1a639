//! Checks that a module keeps the rules that interpreter and code generator rely on. A problem is a fault of the lowering.
//!
//! Verified:
//! - module: function names are there and unique; natives have unique names and at most [`MAX_SLOTS`] slots; lines name files;
//! - function: at least one block; parameters are distinct locals; the frame is a multiple of 8 and at most [`FRAME_BYTES`];
//! - names: locals, blocks, functions, natives and lines exist (lines are not needed if the module has no line table);
//! - operands: integers or floats as the operation wants, all of one type; results have the type of their local; conditions are
//!   integers; base addresses are I32; conversions go from and to fitting types; F32 constants are exact;
//! - memory: a frame address stays within the frame, any offset and size within [`MAX_MEMORY`]; string units are 1 or 2 bytes;
//! - calls: number and types of arguments and of the result;
//! - switch: integers that fit the type, each once.

use super::model::*;
use super::ops::{float32, mask, signed};
use std::collections::HashSet;
use std::fmt;
use takt_base::index::Index;
use takt_image::memory::{FRAME_BYTES, MAX_MEMORY};
use takt_image::natives::MAX_SLOTS;
use takt_image::{NativeImport, NativeKind, Scalar};

/// A rule that is broken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// `function`, `function b2` or `function b2 #7` (instruction from 0); empty for the module.
    pub place: String,
    /// What is wrong.
    pub text: String,
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.place.is_empty() { write!(f, "{}", self.text) } else { write!(f, "{}: {}", self.place, self.text) }
    }
}

/// All problems of a module, in its order.
pub fn verify(module: &Module) -> Vec<Problem> {
    let mut problems = Vec::new();
    check_module(module, &mut problems);
    for function in module.functions.iter() {
        Verifier { module, function, place: Place::Function, problems: &mut problems }.function();
    }
    problems
}

fn check_module(module: &Module, problems: &mut Vec<Problem>) {
    let mut add = |text: String| problems.push(Problem { place: String::new(), text });
    let mut names = HashSet::new();
    for f in module.functions.iter() {
        if f.name.is_empty() || !names.insert(&f.name) {
            add(format!("function name `{}` is empty or not unique", f.name));
        }
    }
    let mut names = HashSet::new();
    for n in module.natives.iter() {
        if n.name.is_empty() || !names.insert(&n.name) {
            add(format!("native name `{}` is empty or not unique", n.name));
        }
        if native_params(n).len() > MAX_SLOTS {
            add(format!("native `{}` has more than {MAX_SLOTS} slots", n.name));
        }
    }
    for (id, line) in module.lines.enumerate() {
        if line.file as usize >= module.files.len() {
            add(format!("line @{} is in file {}, which is not there", id.0, line.file));
        }
    }
}

/// Types of the slots of a native.
pub fn native_params(native: &NativeImport) -> &[Scalar] {
    match &native.kind {
        NativeKind::Function { params, .. } => params,
        NativeKind::Block { .. } => &[Scalar::I32],
    }
}

/// Type of the result of a native.
pub fn native_result(native: &NativeImport) -> Option<Scalar> {
    match native.kind {
        NativeKind::Function { result, .. } => result,
        NativeKind::Block { .. } => None,
    }
}

/// What is looked at; its text is made only for a problem.
#[derive(Clone, Copy)]
enum Place {
    Function,
    Inst(BlockId, usize),
    End(BlockId),
}

struct Verifier<'a> {
    module: &'a Module,
    function: &'a Function,
    place: Place,
    problems: &'a mut Vec<Problem>,
}

impl Verifier<'_> {
    fn function(&mut self) {
        let f = self.function;
        let mut seen = HashSet::new();
        for &p in &f.params {
            self.ty(p);
            self.check(seen.insert(p), || format!("v{} is a parameter twice", p.0));
        }
        self.check(f.frame.is_multiple_of(8), || format!("frame of {} bytes is no multiple of 8", f.frame));
        self.check(f.frame <= FRAME_BYTES, || format!("frame of {} bytes is larger than {FRAME_BYTES}", f.frame));
        self.check(!f.blocks.is_empty(), || "no blocks".into());
        for (id, block) in f.blocks.enumerate() {
            for (i, inst) in block.insts.iter().enumerate() {
                self.place = Place::Inst(id, i);
                self.line(inst.line);
                self.op(&inst.op);
            }
            self.place = Place::End(id);
            self.line(block.end_line);
            self.end(&block.end);
        }
    }

    fn check(&mut self, holds: bool, text: impl FnOnce() -> String) {
        if !holds {
            self.problems.push(Problem { place: self.place(), text: text() });
        }
    }

    fn place(&self) -> String {
        let name = &self.function.name;
        match self.place {
            Place::Function => name.clone(),
            Place::Inst(block, i) => format!("{name} b{} #{i}", block.0),
            Place::End(block) => format!("{name} b{}", block.0),
        }
    }

    fn line(&mut self, line: LineId) {
        let lines = &self.module.lines;
        self.check(lines.is_empty() || line.index() < lines.len(), || format!("line @{} is not there", line.0));
    }

    fn block(&mut self, block: BlockId) {
        self.check(block.index() < self.function.blocks.len(), || format!("block b{} is not there", block.0));
    }

    /// Type of a local; `None`, and a problem, if it is not there.
    fn ty(&mut self, local: Local) -> Option<Scalar> {
        let ty = self.function.locals.get(local).copied();
        self.check(ty.is_some(), || format!("local v{} is not there", local.0));
        ty
    }

    fn expect(&mut self, local: Local, want: Scalar) {
        if let Some(ty) = self.ty(local) {
            self.check(ty == want, || format!("v{} is {ty:?}, not {want:?}", local.0));
        }
    }

    fn integer(&mut self, local: Local) -> Option<Scalar> {
        let ty = self.ty(local)?;
        self.check(!ty.is_float(), || format!("v{} is {ty:?}, not an integer", local.0));
        Some(ty)
    }

    fn float(&mut self, local: Local) -> Option<Scalar> {
        let ty = self.ty(local)?;
        self.check(ty.is_float(), || format!("v{} is {ty:?}, not a float", local.0));
        Some(ty)
    }

    /// All locals are floats, or all integers, of one type.
    fn same(&mut self, float: bool, locals: &[Local]) {
        let Some((&first, rest)) = locals.split_first() else { return };
        if let Some(ty) = if float { self.float(first) } else { self.integer(first) } {
            rest.iter().for_each(|&l| self.expect(l, ty));
        }
    }

    /// `size` bytes at an address.
    fn addr(&mut self, addr: Addr, size: u64) {
        let end = u64::from(addr.offset) + size;
        let limit = match addr.base {
            AddrBase::Frame => self.function.frame,
            AddrBase::Static => MAX_MEMORY,
            AddrBase::Local(base) => {
                self.expect(base, Scalar::I32);
                MAX_MEMORY
            }
        };
        self.check(end <= u64::from(limit), || format!("{size} bytes at offset {} pass {limit}", addr.offset));
    }

    fn string(&mut self, addr: Addr, capacity: u32, unit: u32, with_end: bool) {
        self.addr(addr, (u64::from(capacity) + u64::from(with_end)) * u64::from(unit));
    }

    fn op(&mut self, op: &Op) {
        match *op {
            Op::Int(dst, _) => drop(self.integer(dst)),
            Op::Float(dst, bits) => self.float_constant(dst, bits),
            Op::Copy(dst, src) => self.copy(dst, src),
            Op::Unary(op, dst, a) => self.same(op.is_float(), &[dst, a]),
            Op::Binary(op, dst, a, b) => self.same(op.is_float(), &[dst, a, b]),
            Op::Compare(op, dst, a, b) => {
                self.expect(dst, Scalar::I8);
                self.same(op.is_float(), &[a, b]);
            }
            Op::Convert(op, dst, src) => self.convert(op, dst, src),
            Op::Select { dst, condition, then, otherwise } => {
                self.integer(condition);
                self.copy(dst, then);
                self.copy(dst, otherwise);
            }
            Op::Load(local, addr) | Op::Store(addr, local) => {
                if let Some(ty) = self.ty(local) {
                    self.addr(addr, u64::from(ty.bytes()));
                }
            }
            Op::Address(dst, addr) => {
                self.expect(dst, Scalar::I32);
                self.addr(addr, 0);
            }
            Op::CopyBytes { to, from, size } => {
                self.addr(to, u64::from(size));
                self.addr(from, u64::from(size));
            }
            Op::FillBytes { to, size, .. } => self.addr(to, u64::from(size)),
            Op::CopyString { to, to_capacity, from, from_capacity, unit } => {
                self.check(matches!(unit, 1 | 2), || format!("string unit of {unit} bytes"));
                self.string(to, to_capacity, unit, true);
                self.string(from, from_capacity, unit, false);
            }
            Op::CompareString { dst, a, a_capacity, b, b_capacity, unit } => {
                self.check(matches!(unit, 1 | 2), || format!("string unit of {unit} bytes"));
                self.expect(dst, Scalar::I8);
                self.string(a, a_capacity, unit, false);
                self.string(b, b_capacity, unit, false);
            }
            Op::Call { dst, function, ref args } => self.call(dst, function, args),
            Op::CallNative { dst, native, ref args } => self.call_native(dst, native, args),
            Op::TrapIf(_, condition) => drop(self.integer(condition)),
        }
    }

    fn float_constant(&mut self, dst: Local, bits: u64) {
        if self.float(dst) == Some(Scalar::F32) {
            let value = f64::from_bits(bits);
            let exact = value.is_nan() || f64::from(float32(bits)).to_bits() == bits;
            self.check(exact, || format!("{value:?} is no F32"));
        }
    }

    fn copy(&mut self, dst: Local, src: Local) {
        if let Some(ty) = self.ty(dst) {
            self.expect(src, ty);
        }
    }

    fn convert(&mut self, op: Convert, dst: Local, src: Local) {
        if let (Some(to), Some(from)) = (self.ty(dst), self.ty(src)) {
            self.check(op.accepts(from, to), || format!("{op:?} does not convert {from:?} to {to:?}"));
        }
    }

    fn call(&mut self, dst: Option<Local>, function: FuncId, args: &[Local]) {
        let Some(callee) = self.module.functions.get(function) else {
            return self.check(false, || format!("function {} is not there", function.0));
        };
        let params: Vec<Scalar> = callee.params.iter().filter_map(|&p| callee.locals.get(p).copied()).collect();
        self.args(&callee.name, args.iter().copied(), &params);
        self.result(&callee.name, dst, callee.result);
    }

    fn call_native(&mut self, dst: Option<Local>, native: NativeId, args: &[NativeArg]) {
        let Some(import) = self.module.natives.get(native) else {
            return self.check(false, || format!("native {} is not there", native.0));
        };
        self.args(&import.name, args.iter().map(|a| a.local), native_params(import));
        self.result(&import.name, dst, native_result(import));
    }

    fn args(&mut self, callee: &str, args: impl ExactSizeIterator<Item = Local>, params: &[Scalar]) {
        let count = args.len();
        self.check(count == params.len(), || format!("`{callee}` takes {} arguments, not {count}", params.len()));
        args.zip(params).for_each(|(arg, &ty)| self.expect(arg, ty));
    }

    fn result(&mut self, callee: &str, dst: Option<Local>, result: Option<Scalar>) {
        match (dst, result) {
            (Some(dst), Some(ty)) => self.expect(dst, ty),
            (Some(_), None) => self.check(false, || format!("`{callee}` has no result")),
            (None, _) => (),
        }
    }

    fn end(&mut self, end: &End) {
        match end {
            End::Jump(to) => self.block(*to),
            End::Branch { condition, then, otherwise } => {
                self.integer(*condition);
                self.block(*then);
                self.block(*otherwise);
            }
            End::Switch { value, cases, otherwise } => {
                if let Some(ty) = self.integer(*value) {
                    self.cases(ty, cases);
                }
                cases.iter().for_each(|c| self.block(c.1));
                self.block(*otherwise);
            }
            End::Return(value) => self.ret(*value),
            End::Trap(_) => (),
        }
    }

    fn cases(&mut self, ty: Scalar, cases: &[(i64, BlockId)]) {
        let mut seen = HashSet::new();
        for &(value, _) in cases {
            let bits = mask(ty, value as u64);
            let fits = signed(ty, bits) == value || bits as i64 == value;
            self.check(fits, || format!("case {value} does not fit {ty:?}"));
            self.check(seen.insert(bits), || format!("case {value} stands twice"));
        }
    }

    fn ret(&mut self, value: Option<Local>) {
        match (value, self.function.result) {
            (Some(value), Some(ty)) => self.expect(value, ty),
            (None, None) => (),
            (Some(_), None) => self.check(false, || "returns a value, but has no result".into()),
            (None, Some(_)) => self.check(false, || "returns nothing, but has a result".into()),
        }
    }
}

#[cfg(test)]
#[path = "verify_tests.rs"]
mod tests;
