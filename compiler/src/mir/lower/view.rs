//! Resources that mean different variables by one name (language reference §3.5), and function blocks with a task of their own
//! (§10.2). Both change what code is lowered for a unit, not how: a unit that a resource sees in its own way is lowered once more with
//! the places of that resource; a call of a block goes to a guard in front of its body, which knows the instances that others run.

use super::Program;
use super::init::Globals;
use super::unit::{self, Unit};
use crate::hir::model::*;
use crate::mir::model::*;
use std::collections::BTreeMap;
use takt_base::index::{Index, IndexVec};

/// What names mean while something is lowered.
#[derive(Clone, Default)]
pub struct View {
    /// Places of the globals.
    pub globals: Globals,
    /// What a call of each unit calls; `None` for those that are not lowered.
    pub functions: IndexVec<PouId, Option<FuncId>>,
    /// Bodies of the units that have a guard.
    pub bodies: BTreeMap<PouId, Option<FuncId>>,
}

/// A function to be lowered, in the order of the functions of the module.
enum Job {
    Unit { pou: PouId, view: usize },
    Guard { pou: PouId, view: usize },
}

/// Lowers all units into an empty module: first as they are, then as resources see them, then the guards.
pub fn units(program: &mut Program<'_>, module: &mut Module) {
    let jobs = plan(program);
    for job in jobs {
        let (Job::Unit { view, .. } | Job::Guard { view, .. }) = job;
        program.enter(view);
        let function = match job {
            Job::Unit { pou, view } => {
                let mut function = unit::function(program, pou);
                if view > 0 {
                    function.name = format!("{}@{}", function.name, program.hir.resources[view - 1]);
                }
                function
            }
            Job::Guard { pou, view } => guard(program, pou, view),
        };
        module.functions.push(function);
    }
}

/// Numbers the functions. View 0 is that of nobody in particular, then comes one for each of several resources.
fn plan(program: &mut Program<'_>) -> Vec<Job> {
    let hir = program.hir;
    let lowered = |pou: &PouId| program.view.functions[*pou].is_some();
    let mut jobs: Vec<Job> = hir.pous.indices().filter(lowered).map(|pou| Job::Unit { pou, view: 0 }).collect();
    let mut views = vec![program.view.clone()];
    for (v, number) in hir.views.iter().zip(1..) {
        let mut view = program.view.clone();
        for (from, to) in &v.renamed {
            view.globals[*from] = program.data.globals[*to];
        }
        for pou in v.own.iter().filter(|p| program.view.functions[**p].is_some()) {
            view.functions[*pou] = Some(FuncId::new(jobs.len()));
            jobs.push(Job::Unit { pou: *pou, view: number });
        }
        views.push(view);
    }
    let mut bound: Vec<PouId> = hir.tasks.iter().flat_map(|t| &t.blocks).map(|b| b.pou).collect();
    bound.sort();
    bound.dedup();
    for pou in bound {
        guard_jobs(&mut views, &mut jobs, pou);
    }
    program.views = views;
    jobs
}

/// Views with the same body share its guard.
fn guard_jobs(views: &mut [View], jobs: &mut Vec<Job>, pou: PouId) {
    let mut known: Vec<(Option<FuncId>, FuncId)> = Vec::new();
    for (number, view) in views.iter_mut().enumerate() {
        let body = view.functions[pou];
        let found = known.iter().find(|k| k.0 == body).map(|k| k.1);
        let guard = found.unwrap_or_else(|| {
            jobs.push(Job::Guard { pou, view: number });
            FuncId::new(jobs.len() - 1)
        });
        known.push((body, guard));
        view.bodies.insert(pou, body);
        view.functions[pou] = Some(guard);
    }
}

/// Runs the body of a block unless the instance has a task of its own.
fn guard(program: &mut Program<'_>, id: PouId, view: usize) -> Function {
    let pou = &program.hir.pous[id];
    let bound = program.data.bound(program.hir, id);
    let mut unit = Unit::new(program, None, pou.end);
    let this = unit.instance_param(pou);
    let (address, done) = (unit.f.address(this), unit.f.block());
    for offset in bound {
        let own = unit.f.compare_const(Compare::Eq, address, offset.into());
        let next = unit.f.block();
        unit.f.branch(own, done, next);
        unit.f.enter(next);
    }
    unit.call_body(id, address);
    unit.f.jump(done);
    unit.f.enter(done);
    unit.f.end(End::Return(None));
    unit.finish(format!("{}@call{view}", pou.name), pou.name.clone(), None, pou.end)
}

impl Program<'_> {
    /// From here on names mean what they do in a view.
    pub fn enter(&mut self, view: usize) {
        if self.entered.replace(view) != Some(view) {
            self.view = self.views[view].clone();
        }
    }

    /// From here on names mean what they do in a resource.
    pub fn enter_resource(&mut self, resource: u32) {
        let view = resource as usize + 1;
        self.enter(if view < self.views.len() { view } else { 0 });
    }
}

impl Unit<'_, '_> {
    /// Runs the body of a block itself, whoever its task is.
    pub fn call_body(&mut self, id: PouId, address: Local) {
        let known = self.program.view.bodies.get(&id).copied();
        match known.unwrap_or(self.program.view.functions[id]) {
            Some(function) => self.f.emit(Op::Call { dst: None, function, args: vec![address] }),
            None => self.call_native_block(&self.hir.pous[id], address),
        }
    }
}
