//! One random function: locals, blocks, ends.

use super::SCALARS;
use crate::rng::Rng;
use takt_base::index::IndexVec;
use takt_compiler::mir::model::*;
use takt_image::{Scalar, Trap};

/// A function that is being made.
pub(super) struct Body<'a> {
    pub(super) rng: &'a mut Rng,
    pub(super) module: &'a mut Module,
    /// A network of BOOLs: no loops, mostly I8.
    pub(super) network: bool,
    pub(super) locals: IndexVec<Local, Scalar>,
    /// Locals of each type that any instruction may use, in the order of `SCALARS`.
    pools: Vec<Vec<Local>>,
    pub(super) insts: Vec<Inst>,
    blocks: Vec<Block>,
    pub(super) frame: u32,
    line: LineId,
    pub(super) calls_left: usize,
    /// For the replacement of NaN.
    pub(super) is_number: Local,
    pub(super) nan: [Local; 2],
    /// For addresses.
    pub(super) masked: Local,
    pub(super) limit: Local,
}

impl<'a> Body<'a> {
    pub(super) fn new(rng: &'a mut Rng, module: &'a mut Module, network: bool) -> Self {
        let mut locals = IndexVec::new();
        let mut pools = vec![Vec::new(); SCALARS.len()];
        for _ in 0..rng.range(2, 5) {
            for (pool, ty) in pools.iter_mut().zip(SCALARS) {
                pool.push(locals.push(ty));
            }
        }
        let mut add = |ty| locals.push(ty);
        let (is_number, nan) = (add(Scalar::I8), [add(Scalar::F32), add(Scalar::F64)]);
        let (masked, limit) = (add(Scalar::I32), add(Scalar::I32));
        let (frame, calls_left) = (8 * rng.range(0, 20), rng.below(3));
        let (insts, blocks, line) = (Vec::new(), Vec::new(), LineId(0));
        Self { rng, module, network, locals, pools, insts, blocks, frame, line, calls_left, is_number, nan, masked, limit }
    }

    /// A function of any signature.
    pub(super) fn function(mut self, name: String) -> Function {
        let params = self.params();
        let result = self.rng.one_in(4).then_some(()).map_or_else(|| Some(self.any_type()), |()| None);
        self.start();
        let count = if self.network { self.rng.range(1, 2) } else { self.rng.range(1, 8) };
        let counters = self.counters();
        for id in 0..count {
            let insts = if self.network { self.rng.range(40, 120) } else { self.rng.range(0, 14) };
            (0..insts).for_each(|_| self.random_inst());
            let end = self.random_end(id, count, &counters, result);
            self.block(end);
        }
        self.finish(name, params, result)
    }

    /// A function of one I32 that calls the one before and leaves its result and some locals in memory.
    pub(super) fn entry(mut self) -> Function {
        let params = vec![self.local(Scalar::I32)];
        self.start();
        (0..self.rng.range(0, 6)).for_each(|_| self.random_inst());
        let last = FuncId(self.module.functions.len() as u32 - 1);
        self.call(last);
        for (i, ty) in (0..).zip(SCALARS) {
            let local = self.local(ty);
            self.push(Op::Store(Addr { base: AddrBase::Static, offset: super::header::SIZE + 8 * i }, local));
        }
        self.block(End::Return(None));
        self.finish("main".into(), params, None)
    }

    fn finish(self, name: String, params: Vec<Local>, result: Option<Scalar>) -> Function {
        let pou = if self.rng.one_in(2) { name.clone() } else { "Some Pou".into() };
        let blocks = self.blocks.into_iter().collect();
        Function { name, pou, params, result, locals: self.locals, frame: self.frame, blocks }
    }

    fn params(&mut self) -> Vec<Local> {
        let mut params: Vec<Local> = Vec::new();
        for _ in 0..self.rng.below(10) {
            let ty = self.any_type();
            let local = self.local(ty);
            if !params.contains(&local) {
                params.push(local);
            }
        }
        params
    }

    /// Constants that the rest relies on.
    fn start(&mut self) {
        let [f32_nan, f64_nan] = self.nan;
        self.push(Op::Float(f32_nan, f64::NAN.to_bits()));
        self.push(Op::Float(f64_nan, 0x7ff8_0000_0000_0000));
        self.push(Op::Int(self.limit, 1023));
    }

    /// Counters for edges back, set in block 0, to which no edge leads.
    fn counters(&mut self) -> Vec<Local> {
        let count = if self.network { 0 } else { self.rng.below(4) };
        let counters: Vec<Local> = (0..count).map(|_| self.locals.push(Scalar::I32)).collect();
        for &counter in &counters {
            let times = i64::from(self.rng.range(1, 4));
            self.push(Op::Int(counter, times));
        }
        counters
    }

    /// Appends an instruction, now and then on a new line.
    pub(super) fn push(&mut self, op: Op) {
        if self.rng.one_in(2) {
            let file = self.rng.below(2) as u32;
            self.line = self.module.lines.push(Line { file, line: self.module.lines.len() as u32 + 1 });
        } else if self.line.0 as usize >= self.module.lines.len() {
            self.line = self.module.lines.push(Line { file: 0, line: 1 });
        }
        self.insts.push(Inst { op, line: self.line });
    }

    fn block(&mut self, end: End) {
        let insts = std::mem::take(&mut self.insts);
        self.blocks.push(Block { insts, end, end_line: self.line });
    }

    fn random_end(&mut self, id: u32, count: u32, counters: &[Local], result: Option<Scalar>) -> End {
        if id + 1 == count {
            return if self.rng.one_in(40) { self.trap_end() } else { End::Return(result.map(|ty| self.local(ty))) };
        }
        match self.rng.below(8) {
            0..=2 if id > 0 => self.back_edge(id, count, counters),
            3 => End::Switch { value: self.integer(), cases: Vec::new(), otherwise: self.later(id, count) },
            4 => self.switch(id, count),
            5 => End::Jump(self.later(id, count)),
            _ => End::Branch { condition: self.integer(), then: self.later(id, count), otherwise: self.later(id, count) },
        }
    }

    /// A trap behind a store: alone in its block, it might be reported at the line of the branch before.
    fn trap_end(&mut self) -> End {
        let src = self.integer();
        self.push(Op::Store(Addr { base: AddrBase::Static, offset: super::header::SIZE }, src));
        End::Trap(self.trap())
    }

    /// Goes back as long as a counter lasts.
    fn back_edge(&mut self, id: u32, count: u32, counters: &[Local]) -> End {
        let later = self.later(id, count);
        if counters.is_empty() {
            return End::Jump(later);
        }
        let counter = self.rng.pick(counters);
        let one = self.masked;
        self.push(Op::Int(one, 1));
        self.push(Op::Binary(BinaryOp::Sub, counter, counter, one));
        self.push(Op::Compare(Compare::SGt, self.is_number, counter, one));
        End::Branch { condition: self.is_number, then: BlockId(self.rng.range(1, id)), otherwise: later }
    }

    fn switch(&mut self, id: u32, count: u32) -> End {
        let value = self.integer();
        let start = self.rng.bits() as i8 as i64;
        let step = self.rng.range(1, 3) as i64;
        let values = (0..self.rng.below(12) as i64).map(|i| start + i * step).filter(|v| (-128..128).contains(v));
        let values: Vec<i64> = values.collect();
        let cases = values.into_iter().map(|v| (v, self.later(id, count))).collect();
        End::Switch { value, cases, otherwise: self.later(id, count) }
    }

    fn later(&mut self, id: u32, count: u32) -> BlockId {
        BlockId(self.rng.range(id + 1, count - 1))
    }

    pub(super) fn trap(&mut self) -> Trap {
        self.rng.pick(Trap::ALL)
    }

    pub(super) fn any_type(&mut self) -> Scalar {
        if self.network && !self.rng.one_in(16) { Scalar::I8 } else { self.rng.pick(&SCALARS) }
    }

    /// A local of this type.
    pub(super) fn local(&mut self, ty: Scalar) -> Local {
        let pool = SCALARS.iter().position(|&t| t == ty).map_or(&[][..], |i| &self.pools[i]);
        self.rng.pick(pool)
    }

    /// An integer of any type.
    pub(super) fn integer(&mut self) -> Local {
        let ty = self.rng.pick(&SCALARS[..4]);
        self.local(ty)
    }
}
