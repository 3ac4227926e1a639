//! Calls of functions and of natives.

use super::address::flags;
use super::function::{Translator, signature, trap_code};
use crate::mir::model::{FuncId, Local, NativeArg, NativeId};
use cranelift_codegen::ir::{
    AbiParam, ExtFuncData, ExternalName, FuncRef, Inst, InstBuilder, MemFlagsData, SigRef, Signature, StackSlot, StackSlotData,
    StackSlotKind, UserExternalName, Value, types,
};
use cranelift_codegen::isa::CallConv;
use takt_image::natives::MAX_SLOTS;
use takt_image::{Trap, header};

/// Bytes of a slot.
const SLOT: i32 = 8;

impl Translator<'_, '_> {
    /// The callee's frame begins where this one ends.
    pub(super) fn call(&mut self, dst: Option<Local>, function: FuncId, args: &[Local]) {
        let callee = self.callee(function);
        let frame = self.b.ins().iadd_imm_u(self.frame, i64::from(self.function.frame));
        let mut values = vec![self.memory, frame];
        for &arg in args {
            values.push(self.get(arg));
        }
        let call = self.b.ins().call(callee, &values);
        if let (Some(dst), Some(value)) = (dst, self.first_result(call)) {
            self.set(dst, value);
        }
    }

    fn first_result(&self, call: Inst) -> Option<Value> {
        self.b.inst_results(call).first().copied()
    }

    fn callee(&mut self, function: FuncId) -> FuncRef {
        if let Some(&known) = self.functions.get(&function) {
            return known;
        }
        let signature = self.b.import_signature(signature(&self.module.functions[function]));
        let name = self.b.func.declare_imported_user_function(UserExternalName::new(0, function.0));
        let data = ExtFuncData { name: ExternalName::user(name), signature, colocated: true, patchable: false };
        let callee = self.b.import_function(data);
        self.functions.insert(function, callee);
        callee
    }

    /// Arguments go to a stack slot, behind the place for the result. A status that is not 0 ends in `NativePanic`: the runtime
    /// knows which trap the native returned.
    pub(super) fn call_native(&mut self, dst: Option<Local>, native: NativeId, args: &[NativeArg]) {
        let (signature, slot) = self.native_entry();
        for (i, arg) in args.iter().enumerate() {
            let value = self.slot_value(*arg);
            self.b.ins().stack_store(types::I64, value, slot, SLOT * (i as i32 + 1));
        }
        let entry = self.b.ins().load(types::I64, MemFlagsData::trusted(), self.memory, header::NATIVE_ENTRY as i32);
        let import = self.b.ins().iconst(types::I32, i64::from(native.0));
        let args = self.b.ins().stack_addr(types::I64, slot, SLOT);
        let result = self.b.ins().stack_addr(types::I64, slot, 0);
        let call = self.b.ins().call_indirect(signature, entry, &[self.memory, import, args, result]);
        if let Some(status) = self.first_result(call) {
            self.b.ins().trapnz(status, trap_code(Trap::NativePanic));
        }
        if let Some(dst) = dst {
            let ty = self.ty(dst);
            let value = self.b.ins().load(ty, flags(), result, 0);
            self.set(dst, value);
        }
    }

    /// Signature of `takt_image::natives`, and the slot. Made once per function.
    fn native_entry(&mut self) -> (SigRef, StackSlot) {
        if let Some(known) = self.native {
            return known;
        }
        let mut signature = Signature::new(CallConv::SystemV);
        signature.params.extend([types::I64, types::I32, types::I64, types::I64].map(AbiParam::new));
        signature.returns.push(AbiParam::new(types::I32));
        let size = SLOT as u32 * (self.most_slots() + 1);
        let slot = StackSlotData::new(StackSlotKind::ExplicitSlot, size, 3);
        let made = (self.b.import_signature(signature), self.b.create_sized_stack_slot(slot));
        self.native = Some(made);
        made
    }

    /// Most slots that a native call of this function has.
    fn most_slots(&self) -> u32 {
        use crate::mir::model::Op;
        let insts = self.function.blocks.iter().flat_map(|b| &b.insts);
        let slots = insts.map(|i| if let Op::CallNative { args, .. } = &i.op { args.len() } else { 0 });
        slots.max().unwrap_or(0).min(MAX_SLOTS) as u32
    }

    /// The local as 64 bits.
    fn slot_value(&mut self, arg: NativeArg) -> Value {
        let (ty, mut value) = (self.ty(arg.local), self.get(arg.local));
        if ty == types::F32 {
            value = self.b.ins().bitcast(types::I32, MemFlagsData::new(), value);
        }
        match (self.b.func.dfg.value_type(value), arg.signed && !ty.is_float()) {
            (types::I64 | types::F64, _) => value,
            (_, true) => self.b.ins().sextend(types::I64, value),
            (_, false) => self.b.ins().uextend(types::I64, value),
        }
    }
}
