//! Makes one MIR function: typed locals, blocks, frame space. Knows nothing of the language.
//! Code behind a block's end is dropped, and blocks that nobody reaches are left out of the result.

use crate::mir::loops::{retarget, successors};
use crate::mir::model::*;
use crate::mir::region::{Region, Regions};
use takt_base::index::{Index, IndexVec};
use takt_image::{Scalar, Trap};

/// A function under construction.
pub struct Builder {
    locals: IndexVec<Local, Scalar>,
    blocks: IndexVec<BlockId, Draft>,
    current: BlockId,
    /// Line of what is emitted next.
    pub line: LineId,
    /// What locals with addresses point to.
    pub regions: Regions,
    frame: u64,
    frame_max: u64,
}

#[derive(Default)]
struct Draft {
    insts: Vec<Inst>,
    end: Option<(End, LineId)>,
}

/// Frame space in use; see [`Builder::release`].
#[derive(Clone, Copy)]
pub struct Mark(u64);

impl Builder {
    /// An empty function whose entry block is open.
    pub fn new(line: LineId) -> Self {
        let mut blocks = IndexVec::new();
        let current = blocks.push(Draft::default());
        Self { locals: IndexVec::new(), blocks, current, line, regions: Regions::default(), frame: 0, frame_max: 0 }
    }

    /// A new local.
    pub fn local(&mut self, ty: Scalar) -> Local {
        self.locals.push(ty)
    }
    /// Type of a local.
    pub fn ty(&self, local: Local) -> Scalar {
        self.locals[local]
    }
    /// A new block, not yet entered.
    pub fn block(&mut self) -> BlockId {
        self.blocks.push(Draft::default())
    }
    /// What follows goes into this block.
    pub fn enter(&mut self, block: BlockId) {
        self.current = block;
    }
    /// False behind an end: what is emitted now would never run.
    pub fn is_open(&self) -> bool {
        self.blocks[self.current].end.is_none()
    }
    /// Appends an instruction.
    pub fn emit(&mut self, op: Op) {
        let line = self.line;
        if self.is_open() {
            self.blocks[self.current].insts.push(Inst { op, line });
        }
    }
    /// Ends the block.
    pub fn end(&mut self, end: End) {
        let line = self.line;
        if self.is_open() {
            self.blocks[self.current].end = Some((end, line));
        }
    }
    /// Ends the block with a jump.
    pub fn jump(&mut self, to: BlockId) {
        self.end(End::Jump(to));
    }
    /// Ends the block with a branch.
    pub fn branch(&mut self, condition: Local, then: BlockId, otherwise: BlockId) {
        self.end(End::Branch { condition, then, otherwise });
    }

    fn with(&mut self, ty: Scalar, op: impl FnOnce(Local) -> Op) -> Local {
        let dst = self.local(ty);
        self.emit(op(dst));
        dst
    }
    /// Integer constant.
    pub fn int(&mut self, ty: Scalar, value: i64) -> Local {
        self.with(ty, |d| Op::Int(d, value))
    }
    /// Floating constant.
    pub fn float(&mut self, ty: Scalar, value: f64) -> Local {
        self.with(ty, |d| Op::Float(d, value.to_bits()))
    }
    /// Zero of any type.
    pub fn zero(&mut self, ty: Scalar) -> Local {
        if ty.is_float() { self.float(ty, 0.0) } else { self.int(ty, 0) }
    }
    /// `dst := src`.
    pub fn copy(&mut self, dst: Local, src: Local) {
        if dst != src {
            self.emit(Op::Copy(dst, src));
        }
    }
    /// A copy that later changes of `src` don't reach.
    pub fn duplicate(&mut self, src: Local) -> Local {
        self.with(self.ty(src), |d| Op::Copy(d, src))
    }
    /// One operand.
    pub fn unary(&mut self, op: UnaryOp, a: Local) -> Local {
        self.with(self.ty(a), |d| Op::Unary(op, d, a))
    }
    /// Two operands of one type.
    pub fn binary(&mut self, op: BinaryOp, a: Local, b: Local) -> Local {
        self.with(self.ty(a), |d| Op::Binary(op, d, a, b))
    }
    /// Integer operation with a constant.
    pub fn binary_const(&mut self, op: BinaryOp, a: Local, b: i64) -> Local {
        let b = self.int(self.ty(a), b);
        self.binary(op, a, b)
    }
    /// Comparison: 0 or 1 in an I8.
    pub fn compare(&mut self, op: Compare, a: Local, b: Local) -> Local {
        self.with(Scalar::I8, |d| Op::Compare(op, d, a, b))
    }
    /// Integer comparison with a constant.
    pub fn compare_const(&mut self, op: Compare, a: Local, b: i64) -> Local {
        let b = self.int(self.ty(a), b);
        self.compare(op, a, b)
    }
    /// Conversion to `to`.
    pub fn convert(&mut self, how: Convert, to: Scalar, a: Local) -> Local {
        self.with(to, |d| Op::Convert(how, d, a))
    }
    /// Integer to another width: extended by `signed`, or its low bits.
    pub fn resize(&mut self, a: Local, to: Scalar, signed: bool) -> Local {
        match self.ty(a).bytes().cmp(&to.bytes()) {
            std::cmp::Ordering::Equal => a,
            std::cmp::Ordering::Greater => self.convert(Convert::Truncate, to, a),
            std::cmp::Ordering::Less if signed => self.convert(Convert::SignExtend, to, a),
            std::cmp::Ordering::Less => self.convert(Convert::ZeroExtend, to, a),
        }
    }
    /// `condition <> 0 ? then : otherwise`.
    pub fn select(&mut self, condition: Local, then: Local, otherwise: Local) -> Local {
        self.with(self.ty(then), |dst| Op::Select { dst, condition, then, otherwise })
    }
    /// Reads memory.
    pub fn load(&mut self, ty: Scalar, addr: Addr) -> Local {
        self.with(ty, |d| Op::Load(d, addr))
    }
    /// Writes memory.
    pub fn store(&mut self, addr: Addr, src: Local) {
        self.emit(Op::Store(addr, src));
    }
    /// Offset of a place.
    pub fn address(&mut self, addr: Addr) -> Local {
        match addr {
            Addr { base: AddrBase::Local(l), offset: 0 } => l,
            _ => {
                let local = self.with(Scalar::I32, |d| Op::Address(d, addr));
                self.regions.set(local, self.regions.of(addr, 0));
                local
            }
        }
    }
    /// An address computed by the caller, which is within the `size` bytes at `object`.
    pub fn within(&mut self, local: Local, object: Addr, size: u64) -> Addr {
        let region = self.regions.of(object, size);
        self.regions.set(local, Region { exact: false, ..region });
        at(local)
    }
    /// Traps if the condition is not 0.
    pub fn trap_if(&mut self, trap: Trap, condition: Local) {
        self.emit(Op::TrapIf(trap, condition));
    }

    /// Space on the frame until the enclosing [`Builder::release`].
    pub fn temp(&mut self, size: u32, align: u32) -> Addr {
        let offset = self.frame.next_multiple_of(align.max(1) as u64);
        self.frame = offset + size as u64;
        self.frame_max = self.frame_max.max(self.frame);
        Addr { base: AddrBase::Frame, offset: u32::try_from(offset).unwrap_or(u32::MAX) }
    }
    /// Remembers how much of the frame is in use.
    pub fn mark(&self) -> Mark {
        Mark(self.frame)
    }
    /// Gives back what was taken since.
    pub fn release(&mut self, mark: Mark) {
        self.frame = mark.0;
    }
    /// Bytes of the frame so far; may be more than a frame can have.
    pub fn frame_bytes(&self) -> u64 {
        self.frame_max
    }

    /// The finished function. All reachable blocks must have an end.
    pub fn finish(self, name: String, pou: String, params: Vec<Local>, result: Option<Scalar>) -> (Function, Regions) {
        let reached = self.reached();
        let mut numbers = vec![BlockId(0); self.blocks.len()];
        let kept = self.blocks.indices().filter(|b| reached[b.index()]);
        kept.enumerate().for_each(|(i, b)| numbers[b.index()] = BlockId::new(i));
        let drafts = self.blocks.into_iter().zip(&reached).filter(|(_, r)| **r);
        let blocks = drafts.map(|(draft, _)| close(draft, &numbers)).collect();
        let frame = u32::try_from(self.frame_max.next_multiple_of(8)).unwrap_or(u32::MAX);
        (Function { name, pou, params, result, locals: self.locals, frame, blocks }, self.regions)
    }

    fn reached(&self) -> Vec<bool> {
        let mut reached = vec![false; self.blocks.len()];
        let mut todo = vec![BlockId(0)];
        while let Some(block) = todo.pop() {
            if !std::mem::replace(&mut reached[block.index()], true)
                && let Some((end, _)) = &self.blocks[block].end
            {
                todo.extend(successors(end));
            }
        }
        reached
    }
}

fn close(draft: Draft, numbers: &[BlockId]) -> Block {
    let (end, end_line) = draft.end.expect("a reachable block has an end");
    Block { insts: draft.insts, end: retarget(end, |b| numbers[b.index()]), end_line }
}

/// `addr + bytes`.
pub fn behind(addr: Addr, bytes: u32) -> Addr {
    Addr { offset: addr.offset.saturating_add(bytes), ..addr }
}

/// What an `i32` local points to.
pub fn at(local: Local) -> Addr {
    Addr { base: AddrBase::Local(local), offset: 0 }
}

/// A fixed place.
pub fn fixed(offset: u32) -> Addr {
    Addr { base: AddrBase::Static, offset }
}
