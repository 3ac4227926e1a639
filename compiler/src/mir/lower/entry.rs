//! What a task runs: programs with their connections, function blocks with a task of their own, and around both the fields that stand
//! for addresses. From: language reference §3.7, §10.2, §10.3.

use super::builder::{behind, fixed};
use super::place::Loc;
use super::shape::Shape;
use super::startup::FirstScan;
use super::unit::Unit;
use crate::hir::model::*;
use crate::mir::model::*;
use takt_image::image::Place as ImagePlace;

impl Unit<'_, '_> {
    /// The entry that a task runs for a program with connections: inputs, program, outputs (§10.3).
    pub fn run_program(&mut self, instance: &ProgramInstance, first: Option<FirstScan>) {
        let pou = &self.hir.pous[instance.pou];
        let this = self.instance_param(pou);
        first.into_iter().for_each(|f| self.begin(f));
        for (var, value) in &instance.inputs {
            self.at_line(value.span);
            let var = &pou.vars[*var];
            let to = self.program_pin(pou, this, var);
            let value = self.operand(value);
            self.assign(to, var.ty, value);
        }
        let address = self.f.address(this);
        self.between_mirrors(&instance.root(), this, |unit| unit.call_body(instance.pou, address));
        for (var, target) in &instance.outputs {
            self.at_line(target.span);
            let var = &pou.vars[*var];
            let from = self.program_pin(pou, this, var);
            let to = self.place(target);
            match (from, self.shape(var.ty)) {
                (Loc::Memory(from), _) => self.copy_out(from, var.ty, to, target.ty, false),
                (from, _) => {
                    let value = self.load(from, var.ty);
                    self.store(to, value);
                }
            }
        }
        self.f.end(End::Return(None));
    }

    /// The entry that a task runs for a function block of its own (§10.2).
    pub fn run_block(&mut self, block: &BoundBlock, program: u32, first: Option<FirstScan>) {
        let this = self.instance_param(&self.hir.pous[block.pou]);
        first.into_iter().for_each(|f| self.begin(f));
        let address = self.f.address(this);
        self.between_mirrors(&block.program, fixed(program), |unit| unit.call_body(block.pou, address));
        self.f.end(End::Return(None));
    }

    /// Runs something with the fields that stand for addresses up to date, and writes them back.
    fn between_mirrors(&mut self, program: &Root, this: Addr, run: impl FnOnce(&mut Self)) {
        let mirrors: Vec<_> = self.hir.mirrors.iter().filter(|m| m.is_seen_by(program)).collect();
        mirrors.iter().for_each(|m| self.copy_mirror(m, this, true));
        run(self);
        mirrors.iter().filter(|m| !m.input).for_each(|m| self.copy_mirror(m, this, false));
    }

    /// From the process image into a field of an instance, or back.
    fn copy_mirror(&mut self, m: &Mirror, this: Addr, inward: bool) {
        let field = match &m.root {
            Root::Program(..) => behind(this, m.offset),
            Root::Global(g) => match self.program.data.globals[*g] {
                ImagePlace::Byte(offset) => fixed(offset + m.offset),
                ImagePlace::Bit(..) => return,
            },
        };
        let (field, image) = (Loc::Memory(field), super::place::image_loc(m.place));
        let (to, from) = if inward { (field, image) } else { (image, field) };
        match (self.shape(m.ty), to, from) {
            (Shape::Scalar(_), ..) => {
                let value = self.load(from, m.ty);
                self.store(to, value);
            }
            (shape, Loc::Memory(to), Loc::Memory(from)) => self.copy_aggregate(to, shape, from, shape, m.ty),
            _ => {}
        }
    }

    fn program_pin(&self, pou: &Pou, this: Addr, var: &Var) -> Loc {
        match (var.storage, self.pin(pou, this, var)) {
            (Storage::Image(place), _) => super::place::image_loc(place),
            (_, Some(addr)) => Loc::Memory(addr),
            _ => unreachable!("a connected variable is a field or located"),
        }
    }
}
