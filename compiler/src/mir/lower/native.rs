//! Calls of natives: scalars take one slot, strings offset and capacity, a string result two slots at the end.
//! From: `takt_image::natives`.

use super::expr::{Text, Value};
use super::shape::Shape;
use super::unit::Unit;
use crate::hir::model::*;
use crate::mir::model::*;
use takt_base::{Code, Diag, Span};
use takt_image::natives::MAX_SLOTS;
use takt_image::{Elementary, NativeImport, NativeKind, Scalar, TypeId};

impl Unit<'_, '_> {
    /// A library native. CONCAT of many strings is made from pairs: an import has one signature.
    pub fn native(&mut self, name: &str, args: &[Expr], ty: TypeId) -> Value {
        let values = self.operands(&args.iter().collect::<Vec<_>>());
        self.native_of(name, values, args, ty)
    }

    /// Like [`Unit::native`], with the values of the arguments at hand.
    pub fn native_of(&mut self, name: &str, values: Vec<Value>, args: &[Expr], ty: TypeId) -> Value {
        let shape = self.shape(ty);
        if let (Shape::Text { capacity, .. }, true) = (shape, name.starts_with("CONCAT") && values.len() > 2) {
            return values.into_iter().reduce(|a, b| self.concat(name, a, b, capacity)).expect("strings");
        }
        let typed = values.into_iter().zip(args).map(|(v, a)| (v, self.hir.elementary(a.ty))).collect::<Vec<_>>();
        self.call_native(name, &typed, shape, args.first().map(|a| a.span))
    }

    fn concat(&mut self, name: &str, a: Value, b: Value, most: u32) -> Value {
        let (Value::Text(x), Value::Text(y)) = (a, b) else { unreachable!("CONCAT joins strings") };
        let capacity = x.capacity.saturating_add(y.capacity).min(most);
        self.call_native(name, &[(a, None), (b, None)], Shape::Text { capacity, unit: x.unit }, None)
    }

    /// A native of scalars.
    pub fn native_scalar(&mut self, name: &str, args: &[(Local, Elementary)], result: Elementary) -> Local {
        let args: Vec<_> = args.iter().map(|(l, e)| (Value::Scalar(*l), Some(*e))).collect();
        match self.call_native(name, &args, Shape::Scalar(result), None) {
            Value::Scalar(l) => l,
            _ => unreachable!("a scalar result"),
        }
    }

    /// Calls a native with values at hand; an array or structure is passed as its offset.
    pub fn call_native(&mut self, name: &str, args: &[(Value, Option<Elementary>)], result: Shape, span: Option<Span>) -> Value {
        let mut slots = Vec::new();
        args.iter().for_each(|(value, e)| self.slots(*value, *e, &mut slots));
        let (dst, value) = self.native_result(result, &mut slots);
        self.import(name, slots, dst, span);
        value
    }

    /// Appends the slots of a value.
    pub fn slots(&mut self, value: Value, e: Option<Elementary>, slots: &mut Vec<NativeArg>) {
        let local = self.address_of(value);
        slots.push(NativeArg { local, signed: e.is_some_and(Elementary::is_signed_storage) });
        if let Value::Text(t) = value {
            slots.push(NativeArg { local: self.f.int(Scalar::I32, t.capacity as i64), signed: false });
        }
    }

    fn native_result(&mut self, result: Shape, slots: &mut Vec<NativeArg>) -> (Option<Local>, Value) {
        match result {
            Shape::Scalar(e) => {
                let dst = self.f.local(e.scalar());
                (Some(dst), Value::Scalar(dst))
            }
            Shape::Text { capacity, unit } => {
                let text = Value::Text(Text { addr: self.text_temp(capacity, unit), capacity, unit });
                self.slots(text, None, slots);
                (None, text)
            }
            Shape::Bytes => unreachable!("natives have no aggregate results"),
        }
    }

    /// Calls the import of this name and signature.
    pub fn import(&mut self, name: &str, args: Vec<NativeArg>, dst: Option<Local>, span: Option<Span>) {
        let params = args.iter().map(|a| self.f.ty(a.local)).collect();
        let kind = NativeKind::Function { params, result: dst.map(|d| self.f.ty(d)) };
        if let (true, Some(span)) = (args.len() > MAX_SLOTS, span) {
            let label = format!("{name} is given {} values", args.len());
            let diag = Diag::new(Code::WrongArgumentCount, span, label).message("a library function has too many arguments");
            self.program.diags.push(diag.help(format!("pass {MAX_SLOTS} at most; a string counts as two")));
        }
        let native = self.program.import(NativeImport { name: name.to_owned(), kind });
        self.f.emit(Op::CallNative { dst, native, args });
    }
}

/// An offset as a slot.
pub fn slot_of(local: Local) -> NativeArg {
    NativeArg { local, signed: false }
}
