//! What runs once before the first scan: the function that sets up globals and program instances, and the look whether it has run.
//! From: language reference §3.1, §3.6, §4.4. It is part of the program: the first program that any task runs begins with it, so it
//! happens wherever programs run, with the fault handling and the watchdog of that scan, when retained values are back.

use super::Program;
use super::builder::fixed;
use super::unit::Unit;
use crate::hir::model::*;
use crate::mir::model::*;
use takt_image::Scalar;
use takt_image::image::Place as ImagePlace;

/// How a program begins.
#[derive(Clone, Copy)]
pub struct FirstScan {
    /// The function that sets everything up.
    function: FuncId,
    /// A byte that is 1 when that has happened.
    done: u32,
}

/// Adds the function to the module, if there is something to do; `task`: for the programs of this task only.
pub fn first_scan(program: &mut Program<'_>, module: &mut Module, task: Option<usize>) -> Option<FirstScan> {
    let hir = program.hir;
    let start = hir.start.as_ref()?;
    let Some(done) = program.data.reserve_bytes(1, 1) else {
        program.diags.push(super::data::too_large(super::data::nowhere(), "the program"));
        return None;
    };
    let mut unit = Unit::new(program, None, start.span(hir));
    unit.set_up_all(start, done, task);
    let function = module.functions.push(unit.finish("start".into(), "start".into(), None, start.span(hir)));
    Some(FirstScan { function, done })
}

impl Start {
    fn span(&self, hir: &Hir) -> takt_base::Span {
        let first = self.globals.or(self.programs.first().map(|p| p.1));
        first.map_or(super::data::nowhere(), |id| hir.pous[id].end)
    }
}

impl Unit<'_, '_> {
    fn set_up_all(&mut self, start: &Start, done: u32, task: Option<usize>) {
        let one = self.f.int(Scalar::I8, 1);
        self.f.store(fixed(done), one);
        if let Some(function) = start.globals.and_then(|id| self.program.view.functions[id]) {
            self.f.emit(Op::Call { dst: None, function, args: Vec::new() });
        }
        let tasks = self.hir.tasks.iter().zip(self.program.data.instances.clone()).enumerate();
        let wanted = tasks.filter(|(i, _)| task.is_none_or(|t| t == *i));
        let instances: Vec<_> = wanted.flat_map(|(_, (t, offsets))| t.programs.iter().zip(offsets)).collect();
        // A program of several resources sets up its instances with the globals of each.
        for (p, offset) in instances.into_iter().filter(|(p, _)| p.global.is_none()) {
            self.program.enter_resource(p.resource);
            let setup = start.programs.iter().find(|s| s.0 == p.pou).and_then(|s| self.program.view.functions[s.1]);
            if let Some(function) = setup {
                let this = self.f.address(fixed(offset));
                self.f.emit(Op::Call { dst: None, function, args: vec![this] });
            }
        }
        if let Some(ImagePlace::Byte(kept)) = start.kept.map(|g| self.program.data.globals[g]) {
            self.f.store(fixed(kept), one);
        }
        self.f.end(End::Return(None));
    }

    /// At the beginning of a program: sets everything up if that has not been done.
    pub fn begin(&mut self, first: FirstScan) {
        let done = self.f.load(Scalar::I8, fixed(first.done));
        let (set_up, go_on) = (self.f.block(), self.f.block());
        self.f.branch(done, go_on, set_up);
        self.f.enter(set_up);
        self.f.emit(Op::Call { dst: None, function: first.function, args: Vec::new() });
        self.f.jump(go_on);
        self.f.enter(go_on);
    }
}
