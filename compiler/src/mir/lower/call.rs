//! Calls of functions and function blocks. From: language reference §4.7.
//!
//! What has no address of its own (a bit of the process image, a part of a word) is lent through a place on the frame and written
//! back after the call.

use super::builder::behind;
use super::expr::{Text, Value};
use super::native::slot_of;
use super::place::{Loc, field};
use super::pointer::Purpose;
use super::shape::Shape;
use super::unit::Unit;
use super::walk::argument_calls;
use crate::hir::model::*;
use crate::mir::model::*;
use takt_base::Span;
use takt_image::{Elementary, NativeImport, NativeKind, Scalar, TypeId};

/// Something to copy when a call is over.
pub(super) struct WriteBack {
    from: Addr,
    from_ty: TypeId,
    to: Loc,
    to_ty: TypeId,
    negated: bool,
}

/// An argument as it is handed over; the type tells how a scalar is extended for a native.
pub(super) type Given = (Value, Option<Elementary>);

impl Unit<'_, '_> {
    /// Calls a function; `None` if it has no result.
    pub fn call(&mut self, id: PouId, args: &[Arg], span: Span) -> Option<Value> {
        let line = self.at_line(span);
        let pou = &self.hir.pous[id];
        let mut back = Vec::new();
        let last_call = args.iter().rposition(argument_calls).unwrap_or(0);
        let mut given = Vec::new();
        for (i, (arg, param)) in args.iter().zip(&pou.params).enumerate() {
            given.push(self.argument(arg, &pou.vars[*param], i < last_call, &mut back));
        }
        let result = pou.result.map(|r| pou.vars[r].ty);
        let value = match self.program.view.functions[id] {
            Some(function) => self.call_unit(function, &given, result),
            None => self.call_external(pou, &given, result, span),
        };
        self.write_back(back);
        self.f.line = line;
        value
    }

    fn call_unit(&mut self, function: FuncId, given: &[Given], result: Option<TypeId>) -> Option<Value> {
        let (dst, place, value) = self.result_place(result);
        let mut args: Vec<_> = place.into_iter().collect();
        args.extend(given.iter().map(|(value, _)| self.address_of(*value)));
        self.f.emit(Op::Call { dst, function, args });
        value
    }

    /// Register of a scalar result, or the frame place of any other.
    pub(super) fn result_place(&mut self, result: Option<TypeId>) -> (Option<Local>, Option<Local>, Option<Value>) {
        let Some(ty) = result else { return (None, None, None) };
        if let Shape::Scalar(e) = self.shape(ty) {
            let dst = self.f.local(e.scalar());
            return (Some(dst), None, Some(Value::Scalar(dst)));
        }
        let layout = self.hir.types.layout(ty);
        let addr = self.f.temp(layout.size, layout.align);
        (None, Some(self.f.address(addr)), Some(self.at_address(addr, ty)))
    }

    /// A value in memory by its address; a scalar counts as the address itself.
    fn at_address(&mut self, addr: Addr, ty: TypeId) -> Value {
        match self.shape(ty) {
            Shape::Scalar(_) => Value::Scalar(self.f.address(addr)),
            Shape::Text { capacity, unit } => Value::Text(Text { addr, capacity, unit }),
            Shape::Bytes => Value::Bytes(addr),
        }
    }

    fn call_external(&mut self, pou: &Pou, given: &[Given], result: Option<TypeId>, span: Span) -> Option<Value> {
        match result.map(|ty| self.shape(ty)) {
            Some(shape) if shape != Shape::Bytes => Some(self.call_native(&pou.name, given, shape, Some(span))),
            _ => {
                let mut slots = Vec::new();
                given.iter().for_each(|(value, e)| self.slots(*value, *e, &mut slots));
                self.import(&pou.name, slots, None, Some(span));
                None
            }
        }
    }

    pub(super) fn argument(&mut self, arg: &Arg, param: &Var, before_call: bool, back: &mut Vec<WriteBack>) -> Given {
        match arg {
            Arg::Value(e) => {
                let value = self.operand(e);
                let kept = if before_call { self.snapshot(value, e.ty) } else { value };
                (self.fitted(kept, param.ty), self.hir.elementary(param.ty))
            }
            Arg::Reference(place) => {
                let addr = if self.is_open(param.ty) { self.describe(place) } else { self.lend(place, param.ty, back) };
                (self.at_address(addr, param.ty), None)
            }
            Arg::Output { target, negated } => {
                let addr = self.output_place(target, *negated, param.ty, back);
                (self.at_address(addr, param.ty), None)
            }
            Arg::Unused => {
                let layout = self.hir.types.layout(param.ty);
                let addr = self.f.temp(layout.size, layout.align);
                (self.at_address(addr, param.ty), None)
            }
        }
    }

    /// A string cut to the parameter's capacity.
    fn fitted(&mut self, value: Value, ty: TypeId) -> Value {
        match (value, self.shape(ty)) {
            (Value::Text(t), Shape::Text { capacity, .. }) => Value::Text(self.cut(t, capacity)),
            _ => value,
        }
    }

    /// Address of an actual VAR_IN_OUT.
    fn lend(&mut self, place: &Place, wanted: TypeId, back: &mut Vec<WriteBack>) -> Addr {
        let to = self.place(place);
        if let Loc::Memory(addr) = to {
            return self.lend_text(addr, place.ty, wanted, back).unwrap_or(addr);
        }
        let value = self.load(to, place.ty);
        let layout = self.hir.types.layout(place.ty);
        let from = self.f.temp(layout.size, layout.align);
        self.f.store(from, value);
        back.push(WriteBack { from, from_ty: place.ty, to, to_ty: place.ty, negated: false });
        from
    }

    /// A string for a parameter with more room (vendor): a copy, which goes back cut to the room that there is.
    fn lend_text(&mut self, addr: Addr, ty: TypeId, wanted: TypeId, back: &mut Vec<WriteBack>) -> Option<Addr> {
        let (Shape::Text { capacity, unit }, Shape::Text { capacity: most, .. }) = (self.shape(ty), self.shape(wanted)) else {
            return None;
        };
        if capacity == most {
            return None;
        }
        let from = self.text_temp(most, unit);
        self.copy_text(Text { addr: from, capacity: most, unit }, Text { addr, capacity, unit });
        back.push(WriteBack { from, from_ty: wanted, to: Loc::Memory(addr), to_ty: ty, negated: false });
        Some(from)
    }

    /// Where a function writes an output: directly, if nothing has to be done to the value on the way.
    fn output_place(&mut self, target: &Place, negated: bool, ty: TypeId, back: &mut Vec<WriteBack>) -> Addr {
        let to = self.place(target);
        if let (Loc::Memory(addr), false, true) = (to, negated, target.ty == ty) {
            return addr;
        }
        let layout = self.hir.types.layout(ty);
        let from = self.f.temp(layout.size, layout.align);
        back.push(WriteBack { from, from_ty: ty, to, to_ty: target.ty, negated });
        from
    }

    pub(super) fn write_back(&mut self, back: Vec<WriteBack>) {
        for w in back {
            self.copy_out(w.from, w.from_ty, w.to, w.to_ty, w.negated);
        }
    }

    /// Copies from memory to a place, complemented and widened on the way.
    pub(super) fn copy_out(&mut self, from: Addr, from_ty: TypeId, to: Loc, to_ty: TypeId, negated: bool) {
        let value = match self.shape(from_ty) {
            Shape::Scalar(e) => {
                let value = self.load(Loc::Memory(from), from_ty);
                let value = if negated { self.complement(value, e) } else { value };
                Value::Scalar(if from_ty == to_ty { value } else { self.widen(value, from_ty, to_ty) })
            }
            _ => self.at_address(from, from_ty),
        };
        self.assign(to, to_ty, value);
    }

    /// Runs a function block: inputs, body, outputs, each in order.
    pub fn call_block(&mut self, instance: &Place, id: PouId, inputs: &[(VarId, Arg)], outputs: &[Output]) {
        let pou = &self.hir.pous[id];
        let this = self.memory(instance, Purpose::Write);
        let mut back = Vec::new();
        for (var, arg) in inputs {
            self.block_input(pou, this, &pou.vars[*var], arg, &mut back);
        }
        let address = self.f.address(this);
        let bodies = self.bodies(instance, id);
        match self.program.view.functions[id] {
            _ if bodies.len() > 1 => self.call_chosen(address, &bodies, None, &[address]),
            Some(function) => self.f.emit(Op::Call { dst: None, function, args: vec![address] }),
            None => self.call_native_block(pou, address),
        }
        self.write_back(back);
        if self.hir.unbinds(id) && !is_own(instance) {
            self.unbind(pou, this);
        }
        for output in outputs {
            let var = &pou.vars[output.var];
            let Some(from) = self.pin(pou, this, var) else { continue };
            let (from_ty, to_ty) = output.convert.unwrap_or((var.ty, output.target.ty));
            let to = self.place(&output.target);
            self.copy_out(from, from_ty, to, to_ty, output.negated);
        }
    }

    /// Takes back what the VAR_IN_OUT variables of an instance were bound to: an action that is called later must not find it.
    fn unbind(&mut self, pou: &Pou, this: Addr) {
        for var in pou.vars.iter().filter(|v| v.role == Role::InOut) {
            if let Some(pin) = self.pin(pou, this, var) {
                let nothing = self.f.int(Scalar::I32, 0);
                self.f.store(pin, nothing);
            }
        }
    }

    fn block_input(&mut self, pou: &Pou, this: Addr, var: &Var, arg: &Arg, back: &mut Vec<WriteBack>) {
        let Some(pin) = self.pin(pou, this, var) else { return };
        match arg {
            Arg::Value(e) => {
                let value = self.operand(e);
                self.assign(Loc::Memory(pin), var.ty, value);
            }
            Arg::Reference(place) => {
                let addr = if self.is_open(var.ty) { self.describe(place) } else { self.lend(place, var.ty, back) };
                let offset = self.f.address(addr);
                self.f.store(pin, offset);
            }
            Arg::Output { .. } | Arg::Unused => {}
        }
    }

    /// Place of a pin in an instance.
    pub(super) fn pin(&self, pou: &Pou, this: Addr, var: &Var) -> Option<Addr> {
        let Storage::Field(i) = var.storage else { return None };
        Some(behind(this, field(&self.hir.types, pou.instance?, i)?.offset))
    }

    pub(super) fn call_native_block(&mut self, pou: &Pou, address: Local) {
        let Some(ty) = pou.instance else { return };
        let native = self.program.import(NativeImport { name: pou.name.clone(), kind: NativeKind::Block { ty } });
        debug_assert_eq!(self.f.ty(address), Scalar::I32);
        self.f.emit(Op::CallNative { dst: None, native, args: vec![slot_of(address)] });
    }
}

/// True for SUPER(): the call of a body within that of the same instance.
fn is_own(instance: &Place) -> bool {
    matches!(instance.base, Base::This) && instance.path.is_empty()
}
