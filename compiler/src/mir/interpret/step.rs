//! The loop of the interpreter: one machine per activation of a task.

use super::memory::{self, Text};
use super::{Activation, Context, INSTRUCTIONS_PER_US, Interpreter, MAX_DEPTH, MAX_REGISTERS, arith, fault};
use crate::mir::model::*;
use crate::mir::ops::{float32, mask, signed};
use crate::mir::verify::native_result;
use takt_base::index::Index;
use takt_image::natives::MAX_SLOTS;
use takt_image::{Fault, NativeCall, Scalar, Trap, header};

pub(super) struct Machine<'a, 'c> {
    module: &'a Module,
    bindings: &'a [u32],
    registers: &'a mut Vec<u64>,
    calls: &'a mut Vec<Activation>,
    context: &'a mut Context<'c>,
    /// The running function.
    at: Activation,
    /// Instructions left.
    fuel: u64,
    frames: u32,
    frame_limit: u32,
}

/// What follows an instruction.
enum Next {
    Inst,
    Enter(FuncId),
}

impl<'a, 'c> Machine<'a, 'c> {
    pub(super) fn new(module: &'a Module, interpreter: &'a mut Interpreter, context: &'a mut Context<'c>) -> Self {
        let fuel = (context.budget.0.max(0) as u64).saturating_mul(INSTRUCTIONS_PER_US) / 1000;
        let at = Activation { function: FuncId(0), block: BlockId(0), next: 0, registers: 0, frame: 0 };
        Machine {
            module,
            bindings: &interpreter.bindings,
            registers: &mut interpreter.registers,
            calls: &mut interpreter.calls,
            frames: interpreter.frames.start,
            frame_limit: frame_limit(context.memory),
            context,
            at,
            fuel,
        }
    }

    /// Runs a function to its end.
    pub(super) fn call(mut self, function: FuncId, args: &[u64]) -> Result<u64, Fault> {
        let Some(f) = self.module.functions.get(function) else {
            return Err(fault(self.module, Trap::Memory, function, None));
        };
        self.enter(function, self.frames).map_err(|trap| self.fault_at_entry(trap, function))?;
        for (&param, &value) in f.params.iter().zip(args) {
            self.registers[param.index()] = mask(f.locals[param], value);
        }
        loop {
            if let Some(result) = self.block()? {
                return Ok(result);
            }
        }
    }

    /// The function that runs. Outlives `self`.
    fn function(&self) -> &'a Function {
        &self.module.functions[self.at.function]
    }

    /// Runs to the end of the block or to a call. Returns the result when the outermost function returns.
    fn block(&mut self) -> Result<Option<u64>, Fault> {
        let block = &self.function().blocks[self.at.block];
        for inst in &block.insts[self.at.next..] {
            self.at.next += 1;
            let next = self.inst(&inst.op).map_err(|trap| fault(self.module, trap, self.at.function, Some(inst.line)))?;
            if let Next::Enter(callee) = next {
                self.enter_call(callee, &inst.op)?;
                return Ok(None);
            }
        }
        self.end(&block.end).map_err(|trap| fault(self.module, trap, self.at.function, Some(block.end_line)))
    }

    fn burn(&mut self, cost: u64) -> Result<(), Trap> {
        self.fuel = self.fuel.checked_sub(cost).ok_or(Trap::Watchdog)?;
        Ok(())
    }

    fn get(&self, local: Local) -> u64 {
        self.registers[self.at.registers + local.index()]
    }

    fn set(&mut self, local: Local, value: u64) {
        self.registers[self.at.registers + local.index()] = value;
    }

    fn ty(&self, local: Local) -> Scalar {
        self.function().locals[local]
    }

    fn addr(&self, addr: Addr) -> u64 {
        let base = match addr.base {
            AddrBase::Static => 0,
            AddrBase::Frame => u64::from(self.at.frame),
            AddrBase::Local(base) => self.get(base),
        };
        base + u64::from(addr.offset)
    }

    fn text(&self, addr: Addr, capacity: u32, unit: u32) -> Text {
        Text { at: self.addr(addr), capacity, unit }
    }

    fn inst(&mut self, op: &Op) -> Result<Next, Trap> {
        self.burn(1)?;
        match *op {
            Op::Int(dst, value) => self.set(dst, mask(self.ty(dst), value as u64)),
            Op::Float(dst, bits) => {
                self.set(dst, if self.ty(dst) == Scalar::F32 { u64::from(float32(bits).to_bits()) } else { bits });
            }
            Op::Copy(dst, src) => self.set(dst, self.get(src)),
            Op::Unary(op, dst, a) => self.set(dst, arith::unary(op, self.ty(dst), self.get(a))),
            Op::Binary(op, dst, a, b) => self.set(dst, arith::binary(op, self.ty(dst), self.get(a), self.get(b))?),
            Op::Compare(op, dst, a, b) => {
                self.set(dst, u64::from(arith::compare(op, self.ty(a), self.get(a), self.get(b))));
            }
            Op::Convert(op, dst, src) => self.set(dst, arith::convert(op, self.ty(src), self.ty(dst), self.get(src))),
            Op::Select { dst, condition, then, otherwise } => {
                self.set(dst, self.get(if self.get(condition) != 0 { then } else { otherwise }));
            }
            Op::Load(dst, addr) => self.set(dst, memory::load(self.context.memory, self.addr(addr), self.ty(dst).bytes())?),
            Op::Store(addr, src) => {
                memory::store(self.context.memory, self.addr(addr), self.ty(src).bytes(), self.get(src))?;
            }
            Op::Address(dst, addr) => self.set(dst, mask(Scalar::I32, self.addr(addr))),
            Op::Call { function, .. } => return Ok(Next::Enter(function)),
            Op::CallNative { dst, native, ref args } => self.call_native(dst, native, args)?,
            Op::TrapIf(trap, condition) if self.get(condition) != 0 => return Err(trap),
            Op::TrapIf(..) => (),
            ref bulk => self.bulk(bulk)?,
        }
        Ok(Next::Inst)
    }

    /// Operations on runs of bytes. They cost by their size.
    fn bulk(&mut self, op: &Op) -> Result<(), Trap> {
        match *op {
            Op::CopyBytes { to, from, size } => {
                self.burn(u64::from(size / 16))?;
                memory::copy(self.context.memory, self.addr(to), self.addr(from), size)?;
            }
            Op::FillBytes { to, size, value } => {
                self.burn(u64::from(size / 16))?;
                memory::fill(self.context.memory, self.addr(to), size, value)?;
            }
            Op::CopyString { to, to_capacity, from, from_capacity, unit } => {
                self.burn(u64::from(to_capacity / 8))?;
                let (to, from) = (self.text(to, to_capacity, unit), self.text(from, from_capacity, unit));
                memory::copy_string(self.context.memory, to, from)?;
            }
            Op::CompareString { dst, a, a_capacity, b, b_capacity, unit } => {
                self.burn(u64::from(a_capacity.max(b_capacity) / 8))?;
                let (a, b) = (self.text(a, a_capacity, unit), self.text(b, b_capacity, unit));
                let order = memory::compare_strings(self.context.memory, a, b)?;
                self.set(dst, mask(Scalar::I8, order as u64));
            }
            _ => (),
        }
        Ok(())
    }

    fn call_native(&mut self, dst: Option<Local>, native: NativeId, args: &[NativeArg]) -> Result<(), Trap> {
        let mut slots = [0; MAX_SLOTS];
        for (slot, arg) in slots.iter_mut().zip(args) {
            let (ty, value) = (self.ty(arg.local), self.get(arg.local));
            *slot = if arg.signed && !ty.is_float() { signed(ty, value) as u64 } else { value };
        }
        let number = self.bindings.get(native.index()).copied().ok_or(Trap::NativePanic)?;
        let args = slots.get(..args.len()).ok_or(Trap::NativePanic)?;
        let mut call = NativeCall { memory: self.context.memory, args, result: 0, now: self.context.now };
        self.context.natives.call(number, &mut call)?;
        let result = call.result;
        if let (Some(dst), Some(ty)) = (dst, native_result(&self.module.natives[native])) {
            self.set(dst, mask(ty, result));
        }
        Ok(())
    }

    /// Goes into a function that is called with the locals of the running one.
    fn enter_call(&mut self, callee: FuncId, op: &Op) -> Result<(), Fault> {
        let Op::Call { args, .. } = op else { return Ok(()) };
        if self.calls.len() >= MAX_DEPTH {
            return Err(self.fault_at_entry(Trap::StackOverflow, callee));
        }
        let caller = self.at;
        self.calls.push(caller);
        let frame = caller.frame.wrapping_add(self.function().frame);
        self.enter(callee, frame).map_err(|trap| self.fault_at_entry(trap, callee))?;
        for (&param, arg) in self.function().params.iter().zip(args) {
            self.registers[self.at.registers + param.index()] = self.registers[caller.registers + arg.index()];
        }
        Ok(())
    }

    /// Makes registers and a frame for a function and starts it.
    fn enter(&mut self, function: FuncId, frame: u32) -> Result<(), Trap> {
        let f = &self.module.functions[function];
        let registers = self.registers.len();
        let end = u64::from(frame) + u64::from(f.frame);
        if (f.frame > 0 && end > u64::from(self.frame_limit)) || registers + f.locals.len() > MAX_REGISTERS {
            return Err(Trap::StackOverflow);
        }
        self.registers.resize(registers + f.locals.len(), 0);
        self.at = Activation { function, block: BlockId(0), next: 0, registers, frame };
        Ok(())
    }

    /// A fault in the prologue: it is reported at the first line of the function, as in native code.
    fn fault_at_entry(&self, trap: Trap, function: FuncId) -> Fault {
        fault(self.module, trap, function, self.module.functions[function].first_line())
    }

    fn end(&mut self, end: &End) -> Result<Option<u64>, Trap> {
        self.burn(1)?;
        match *end {
            End::Jump(to) => self.jump(to),
            End::Branch { condition, then, otherwise } => self.jump(if self.get(condition) != 0 { then } else { otherwise }),
            End::Switch { value, ref cases, otherwise } => {
                let (ty, value) = (self.ty(value), self.get(value));
                self.jump(cases.iter().find(|c| mask(ty, c.0 as u64) == value).map_or(otherwise, |c| c.1));
            }
            End::Return(value) => return Ok(self.leave(value.map_or(0, |v| self.get(v)))),
            End::Trap(trap) => return Err(trap),
        }
        Ok(None)
    }

    fn jump(&mut self, to: BlockId) {
        self.at.block = to;
        self.at.next = 0;
    }

    /// Back to the caller; the result if there is none.
    fn leave(&mut self, result: u64) -> Option<u64> {
        self.registers.truncate(self.at.registers);
        let Some(caller) = self.calls.pop() else { return Some(result) };
        self.at = caller;
        let call = self.function().blocks[caller.block].insts.get(caller.next - 1);
        if let Some(Inst { op: Op::Call { dst: Some(dst), .. }, .. }) = call {
            self.set(*dst, result);
        }
        None
    }
}

/// End of the frame area: from the header, or the end of the memory if nothing is there.
fn frame_limit(memory: &[u8]) -> u32 {
    let set = memory::load(memory, u64::from(header::FRAME_LIMIT), 4).unwrap_or(0) as u32;
    if set != 0 { set } else { u32::try_from(memory.len()).unwrap_or(u32::MAX) }
}
