//! One function: signature, entry, blocks and how they end.

use super::isa::successors;
use crate::mir::model::*;
use crate::mir::ops::mask;
use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{
    self, AbiParam, ArgumentPurpose, BlockArg, FuncRef, GlobalValueData, InstBuilder, MemFlagsData, SigRef, Signature, SourceLoc,
    StackSlot, TrapCode, Type, UserFuncName, Value, types,
};
use cranelift_codegen::isa::{CallConv, TargetFrontendConfig};
use cranelift_frontend::{FunctionBuilder, FunctionBuilderContext, Switch, Variable};
use std::collections::HashMap;
use takt_base::index::Index;
use takt_image::{Scalar, Trap, header};

/// Translates a function of a verified module.
pub(super) fn build(
    module: &Module,
    id: FuncId,
    func: &mut ir::Function,
    memory: &mut FunctionBuilderContext,
    target: TargetFrontendConfig,
) {
    let function = &module.functions[id];
    func.name = UserFuncName::user(0, id.0);
    func.signature = signature(function);
    limit_stack(func);
    let mut translator = Translator::new(module, function, FunctionBuilder::new(func, memory));
    translator.entry();
    translator.blocks();
    translator.b.seal_all_blocks();
    translator.b.finalize(target);
}

/// The machine type.
pub(super) fn clif_type(ty: Scalar) -> Type {
    match ty {
        Scalar::I8 => types::I8,
        Scalar::I16 => types::I16,
        Scalar::I32 => types::I32,
        Scalar::I64 => types::I64,
        Scalar::F32 => types::F32,
        Scalar::F64 => types::F64,
    }
}

/// `(memory, frame, params...) -> result`. The memory is what Cranelift calls the VM context: the stack limit is found in it.
pub(super) fn signature(f: &Function) -> Signature {
    let mut signature = Signature::new(CallConv::SystemV);
    signature.params.push(AbiParam::special(types::I64, ArgumentPurpose::VMContext));
    signature.params.push(AbiParam::new(types::I32));
    signature.params.extend(f.params.iter().map(|&p| AbiParam::new(clif_type(f.locals[p]))));
    signature.returns.extend(f.result.map(|ty| AbiParam::new(clif_type(ty))));
    signature
}

fn limit_stack(func: &mut ir::Function) {
    let Ok(flags) = func.dfg.mem_flags.insert(MemFlagsData::trusted()) else { return };
    let base = func.create_global_value(GlobalValueData::VMContext);
    let offset = (header::STACK_LIMIT as i32).into();
    let limit = GlobalValueData::Load { base, offset, global_type: types::I64, flags };
    func.stack_limit = Some(func.create_global_value(limit));
}

/// The trap code of a trap: its number.
pub(super) fn trap_code(trap: Trap) -> TrapCode {
    TrapCode::user(trap as u8).unwrap_or(TrapCode::HEAP_OUT_OF_BOUNDS)
}

/// Where the value of a local is kept. A variable takes room for every block in front of its last assignment, which a local that
/// lives within one block does not need.
enum Slot {
    Variable(Variable),
    Value(Option<Value>),
}

/// A function under translation.
pub(super) struct Translator<'m, 'b> {
    pub(super) module: &'m Module,
    pub(super) function: &'m Function,
    pub(super) b: FunctionBuilder<'b>,
    /// The memory: I64.
    pub(super) memory: Value,
    /// Offset of the frame: I32.
    pub(super) frame: Value,
    /// Address of the frame: I64.
    pub(super) frame_address: Value,
    pub(super) functions: HashMap<FuncId, FuncRef>,
    /// Signature of the native entry and the slot for arguments and result.
    pub(super) native: Option<(SigRef, StackSlot)>,
    slots: Vec<Slot>,
    blocks: Vec<ir::Block>,
    /// Edges into each block that are not translated yet.
    open_edges: Vec<usize>,
}

impl<'m, 'b> Translator<'m, 'b> {
    fn new(module: &'m Module, function: &'m Function, mut b: FunctionBuilder<'b>) -> Self {
        let entry = b.create_block();
        b.append_block_params_for_function_params(entry);
        b.switch_to_block(entry);
        b.seal_block(entry);
        let (memory, frame) = (b.block_params(entry)[0], b.block_params(entry)[1]);
        let slot = |(&ty, local)| if local { Slot::Value(None) } else { Slot::Variable(b.declare_var(clif_type(ty))) };
        let slots = function.locals.iter().zip(function.block_local()).map(slot).collect();
        let blocks = function.blocks.iter().map(|_| b.create_block()).collect();
        let mut open_edges = vec![0; function.blocks.len()];
        let ends = function.blocks.iter().map(|b| &b.end);
        ends.flat_map(successors).for_each(|to| open_edges[to.index()] += 1);
        let functions = HashMap::new();
        let frame_address = frame;
        Self { module, function, b, memory, frame, frame_address, functions, native: None, slots, blocks, open_edges }
    }

    /// Defines all locals, checks the frame and goes to block 0.
    fn entry(&mut self) {
        if let Some(line) = self.function.first_line() {
            self.line(line);
        }
        self.define_locals();
        self.check_frame();
        let extended = self.b.ins().uextend(types::I64, self.frame);
        self.frame_address = self.b.ins().iadd(self.memory, extended);
        if let Some(&first) = self.blocks.first() {
            self.b.ins().jump(first, &[]);
        }
    }

    /// Parameters get their arguments, all others that outlive a block 0; what is never read costs nothing.
    fn define_locals(&mut self) {
        let mut zeros = HashMap::new();
        for (local, &ty) in self.function.locals.enumerate() {
            if matches!(self.slots[local.index()], Slot::Value(_)) {
                continue;
            }
            let zero = *zeros.entry(ty).or_insert_with(|| zero(&mut self.b, ty));
            self.set(local, zero);
        }
        for (i, &param) in self.function.params.iter().enumerate() {
            let entry = self.b.current_block().map(|e| self.b.block_params(e)[i + 2]);
            if let Some(value) = entry {
                self.set(param, value);
            }
        }
    }

    fn check_frame(&mut self) {
        if self.function.frame == 0 {
            return;
        }
        let limit = self.b.ins().load(types::I32, MemFlagsData::trusted(), self.memory, header::FRAME_LIMIT as i32);
        let end = self.b.ins().iadd_imm_u(self.frame, i64::from(self.function.frame));
        let beyond = self.b.ins().icmp(IntCC::UnsignedGreaterThan, end, limit);
        self.b.ins().trapnz(beyond, trap_code(Trap::StackOverflow));
    }

    fn blocks(&mut self) {
        let function = self.function;
        for (id, block) in function.blocks.enumerate() {
            let at = self.blocks[id.index()];
            self.b.switch_to_block(at);
            if self.open_edges[id.index()] == 0 {
                self.b.seal_block(at);
            }
            for inst in &block.insts {
                self.line(inst.line);
                self.op(&inst.op);
            }
            self.line(block.end_line);
            self.end(&block.end);
            successors(&block.end).for_each(|to| self.close_edge(id, to));
        }
    }

    /// A block is sealed as soon as all its predecessors are known: late sealing makes needless block parameters.
    fn close_edge(&mut self, from: BlockId, to: BlockId) {
        let open = &mut self.open_edges[to.index()];
        *open -= 1;
        if *open == 0 && to.index() <= from.index() {
            self.b.seal_block(self.blocks[to.index()]);
        }
    }

    fn line(&mut self, line: LineId) {
        self.b.set_srcloc(SourceLoc::new(line.0.wrapping_add(1)));
    }

    /// Value of a local.
    pub(super) fn get(&mut self, local: Local) -> Value {
        match self.slots[local.index()] {
            Slot::Variable(variable) => self.b.use_var(variable),
            Slot::Value(Some(value)) => value,
            Slot::Value(None) => unreachable!("a local of one block is written before it is read"),
        }
    }

    /// Assigns a local.
    pub(super) fn set(&mut self, local: Local, value: Value) {
        match &mut self.slots[local.index()] {
            Slot::Variable(variable) => self.b.def_var(*variable, value),
            Slot::Value(place) => *place = Some(value),
        }
    }

    /// Machine type of a local.
    pub(super) fn ty(&self, local: Local) -> Type {
        clif_type(self.function.locals[local])
    }

    /// A new block with parameters of these types.
    pub(super) fn new_block(&mut self, params: &[Type]) -> (ir::Block, Vec<Value>) {
        let block = self.b.create_block();
        let params = params.iter().map(|&ty| self.b.append_block_param(block, ty)).collect();
        (block, params)
    }

    /// Branches to two blocks, each with one argument or none.
    pub(super) fn branch(&mut self, condition: Value, then: (ir::Block, &[Value]), otherwise: (ir::Block, &[Value])) {
        let args = |values: &[Value]| values.iter().map(|&v| BlockArg::from(v)).collect::<Vec<_>>();
        self.b.ins().brif(condition, then.0, &args(then.1), otherwise.0, &args(otherwise.1));
    }

    /// Jumps with arguments.
    pub(super) fn jump(&mut self, to: ir::Block, args: &[Value]) {
        let args: Vec<BlockArg> = args.iter().map(|&v| BlockArg::from(v)).collect();
        self.b.ins().jump(to, &args);
    }

    fn end(&mut self, end: &End) {
        match *end {
            End::Jump(to) => self.jump(self.blocks[to.index()], &[]),
            End::Branch { condition, then, otherwise } => {
                let condition = self.get(condition);
                self.branch(condition, (self.blocks[then.index()], &[]), (self.blocks[otherwise.index()], &[]));
            }
            End::Switch { value, ref cases, otherwise } => self.switch(value, cases, otherwise),
            End::Return(value) => {
                let value = value.map(|v| self.get(v));
                self.b.ins().return_(value.as_slice());
            }
            End::Trap(trap) => drop(self.b.ins().trap(trap_code(trap))),
        }
    }

    fn switch(&mut self, local: Local, cases: &[(i64, BlockId)], otherwise: BlockId) {
        let ty = self.function.locals[local];
        let mut switch = Switch::new();
        for &(value, to) in cases {
            switch.set_entry(u128::from(mask(ty, value as u64)), self.blocks[to.index()]);
        }
        let value = self.get(local);
        switch.emit(&mut self.b, value, self.blocks[otherwise.index()]);
    }
}

fn zero(b: &mut FunctionBuilder, ty: Scalar) -> Value {
    match ty {
        Scalar::F32 => b.ins().f32const(0.0),
        Scalar::F64 => b.ins().f64const(0.0),
        ty => b.ins().iconst(clif_type(ty), 0),
    }
}
