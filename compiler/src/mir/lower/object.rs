//! Methods: a call of one that the instance chooses reads the class number and switches over it. From: language reference §4.4.

use super::builder::{at, behind};
use super::call::Given;
use super::expr::Value;
use super::pointer::Purpose;
use super::unit::Unit;
use super::walk::argument_calls;
use crate::hir::model::*;
use crate::mir::model::*;
use takt_base::Span;
use takt_image::types::Section;
use takt_image::{CLASS_FIELD, Scalar, Trap, Type, TypeId};

/// Bytes of a class number.
const CLASS_BYTES: u32 = 4;

impl Unit<'_, '_> {
    /// Calls a method; `None` if it has no result.
    pub fn call_method(&mut self, call: &MethodCall, span: Span) -> Option<Value> {
        let line = self.at_line(span);
        let this = self.receiver(&call.receiver);
        let pou = &self.hir.pous[call.method];
        let mut back = Vec::new();
        let last_call = call.args.iter().rposition(argument_calls).unwrap_or(0);
        let mut given: Vec<Given> = Vec::new();
        for (i, (arg, param)) in call.args.iter().zip(&pou.params).enumerate() {
            given.push(self.argument(arg, &pou.vars[*param], i < last_call, &mut back));
        }
        let (dst, place, value) = self.result_place(pou.result.map(|r| pou.vars[r].ty));
        let mut args = vec![this];
        args.extend(place);
        args.extend(given.iter().map(|(value, _)| self.address_of(*value)));
        let targets = call.targets();
        match (&targets[..], self.program.view.functions[targets[0]]) {
            ([_], Some(function)) => self.f.emit(Op::Call { dst, function, args }),
            _ => self.call_chosen(this, &call.dynamic, dst, &args),
        }
        self.write_back(back);
        self.f.line = line;
        value
    }

    /// Offset of the instance.
    fn receiver(&mut self, receiver: &Receiver) -> Local {
        match receiver {
            Receiver::Place(p) => {
                let addr = self.memory(p, Purpose::Write);
                self.f.address(addr)
            }
            Receiver::Reference(e) => {
                let value = self.value(e);
                let this = self.f.duplicate(value);
                let null = self.f.compare_const(Compare::Eq, this, 0);
                self.f.trap_if(Trap::NullReference, null);
                this
            }
        }
    }

    /// Calls what belongs to the class number of an instance.
    pub fn call_chosen(&mut self, this: Local, choices: &[(u32, PouId)], dst: Option<Local>, args: &[Local]) {
        let class = self.f.load(Scalar::I32, at(this));
        let done = self.f.block();
        let mut blocks: Vec<(FuncId, BlockId)> = Vec::new();
        let mut cases = Vec::new();
        for (number, pou) in choices {
            let Some(function) = self.program.view.functions[*pou] else { continue };
            let known = blocks.iter().find(|b| b.0 == function).map(|b| b.1);
            let block = known.unwrap_or_else(|| self.f.block());
            if known.is_none() {
                blocks.push((function, block));
            }
            cases.push((*number as i64, block));
        }
        let nothing = self.f.block();
        self.f.end(if cases.is_empty() { End::Jump(nothing) } else { End::Switch { value: class, cases, otherwise: nothing } });
        for (function, block) in blocks {
            self.f.enter(block);
            self.f.emit(Op::Call { dst, function, args: args.to_vec() });
            self.f.jump(done);
        }
        self.f.enter(nothing);
        let always = self.f.int(Scalar::I8, 1);
        self.f.trap_if(Trap::Reference, always);
        if let Some(dst) = dst {
            let zero = self.f.zero(self.f.ty(dst));
            self.f.copy(dst, zero);
        }
        self.f.jump(done);
        self.f.enter(done);
    }

    /// The bodies that a call of a function block can run. SUPER() and a variable of the unit's own run that of their type.
    pub fn bodies(&self, instance: &Place, id: PouId) -> Vec<(u32, PouId)> {
        let handed_over = match (instance.path.last(), &instance.base) {
            (Some(Step::Field(_) | Step::Index(_)), _) | (None, Base::Global(_) | Base::Image(_) | Base::This) => false,
            (None, Base::Var(v)) => self.var(*v).role == Role::InOut,
            _ => true,
        };
        if !handed_over || self.hir.pous[id].class.is_none() {
            return Vec::new();
        }
        let derived = self.hir.pous.enumerate().filter(|(d, p)| p.kind == PouKind::FunctionBlock && self.hir.extends(*d, id));
        derived.filter_map(|(d, p)| Some((p.class?, d))).collect()
    }

    /// The reference if its instance is of one of the classes, else NULL.
    pub fn of_class(&mut self, reference: &Expr, classes: &[u32]) -> Local {
        let value = self.value(reference);
        let result = self.f.duplicate(value);
        let (look, wrong, done) = (self.f.block(), self.f.block(), self.f.block());
        let null = self.f.compare_const(Compare::Eq, result, 0);
        self.f.branch(null, done, look);
        self.f.enter(look);
        let class = self.f.load(Scalar::I32, at(result));
        let cases: Vec<_> = classes.iter().map(|c| (*c as i64, done)).collect();
        self.f.end(if cases.is_empty() { End::Jump(wrong) } else { End::Switch { value: class, cases, otherwise: wrong } });
        self.f.enter(wrong);
        let zero = self.f.int(Scalar::I32, 0);
        self.f.copy(result, zero);
        self.f.jump(done);
        self.f.enter(done);
        result
    }

    /// Bytes of a value. Of an instance with a class number all but that, and nothing behind its own variables.
    pub fn copy_bytes(&mut self, to: Addr, from: Addr, ty: TypeId) {
        let size = self.hir.types.layout(ty).size;
        let Some(end) = self.class_end(ty) else {
            return self.f.emit(Op::CopyBytes { to, from, size });
        };
        if end > CLASS_BYTES {
            let (to, from) = (behind(to, CLASS_BYTES), behind(from, CLASS_BYTES));
            self.f.emit(Op::CopyBytes { to, from, size: end - CLASS_BYTES });
        }
    }

    /// One past the last variable of an instance that has a class number.
    fn class_end(&self, ty: TypeId) -> Option<u32> {
        let Type::Instance(r) = self.hir.types.get(ty) else { return None };
        r.fields.first().filter(|f| f.section == Section::Hidden && f.name == CLASS_FIELD)?;
        let last = r.fields.last()?;
        Some(last.offset.saturating_add(self.hir.types.layout(last.ty).size))
    }

    /// Gives a copy of an instance the number of its static type.
    pub fn set_class(&mut self, to: Addr, ty: TypeId) {
        let number = self.hir.pous.iter().find(|p| p.instance == Some(ty)).and_then(|p| p.class);
        if let Some(number) = number {
            let number = self.f.int(Scalar::I32, number as i64);
            self.f.store(to, number);
        }
    }
}
