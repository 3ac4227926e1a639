//! Tasks: program instances with their entries and triggers. From: language reference §10.2, §10.3.

use super::startup::{FirstScan, first_scan};
use super::unit::Unit;
use super::{Program, place};
use crate::hir::model::*;
use crate::mir::model::{Function, Module};
use takt_base::index::Index;
use takt_base::{Code, Diag};
use takt_image::image::{self, Place as ImagePlace};
use takt_image::{Type, TypeId};

/// All tasks; adds the entries of programs with connections to the module.
pub fn tasks(program: &mut Program<'_>, module: &mut Module) -> Vec<image::Task> {
    let hir = program.hir;
    let alone = hir.start.as_ref().is_some_and(|s| s.alone);
    let all = if alone { None } else { first_scan(program, module, None) };
    let mut list = Vec::new();
    for (i, t) in hir.tasks.iter().enumerate() {
        let first = if alone { first_scan(program, module, Some(i)) } else { all };
        list.push(task(program, module, first, t, i));
    }
    list
}

fn task(program: &mut Program<'_>, module: &mut Module, first: Option<FirstScan>, t: &Task, number: usize) -> image::Task {
    let trigger = t.single.as_ref().and_then(|p| fixed_place(program, p));
    let offsets = program.data.instances[number].clone();
    let programs = t.programs.iter().zip(offsets).map(|(p, offset)| entry(program, module, first, p, offset, t)).collect();
    image::Task { name: t.name.clone(), priority: t.priority, interval: t.interval, trigger, programs }
}

fn entry(
    program: &mut Program<'_>,
    module: &mut Module,
    first: Option<FirstScan>,
    p: &ProgramInstance,
    instance: u32,
    t: &Task,
) -> image::Program {
    let connected =
        first.is_some() || !p.inputs.is_empty() || !p.outputs.is_empty() || program.hir.mirrors.iter().any(|m| m.is_seen_by(p));
    let function = if connected {
        module.functions.push(wrapper(program, first, p, &t.name)).index() as u32
    } else {
        program.functions[p.pou].map_or(0, |f| f.0)
    };
    image::Program { name: p.name.clone(), function, instance }
}

/// Copies the inputs, runs the program, copies the outputs.
fn wrapper(program: &mut Program<'_>, first: Option<FirstScan>, p: &ProgramInstance, task: &str) -> Function {
    let pou = &program.hir.pous[p.pou];
    let mut unit = Unit::new(program, None, pou.end);
    unit.run_program(p, first);
    unit.finish(format!("{}@{task}", p.name), pou.name.clone(), None, pou.end)
}

/// A place that is known now; reports one that is not.
fn fixed_place(program: &mut Program<'_>, p: &Place) -> Option<ImagePlace> {
    let (mut at, mut ty) = match p.base {
        Base::Global(g) => (program.data.globals[g], program.hir.globals[g].ty),
        Base::Image(place) => (place, p.ty),
        Base::Var(_) | Base::This | Base::Value(_) => return unfit(program, p),
    };
    for step in &p.path {
        let Some(next) = fixed_step(program.hir, at, ty, step) else { return unfit(program, p) };
        (at, ty) = next;
    }
    Some(at)
}

fn fixed_step(hir: &Hir, at: ImagePlace, ty: TypeId, step: &Step) -> Option<(ImagePlace, TypeId)> {
    let ImagePlace::Byte(offset) = at else { return None };
    match (step, hir.types.get(ty)) {
        (Step::Field(i), _) => place::field(&hir.types, ty, *i).map(|f| (ImagePlace::Byte(offset + f.offset), f.ty)),
        (Step::Part { bit, width: 1 }, _) => Some((ImagePlace::Bit(offset + bit / 8, (bit % 8) as u8), ty)),
        (Step::Index(indices), Type::Array { element, dims }) => {
            let mut flat = 0;
            for (index, dim) in indices.iter().zip(dims) {
                let ExprKind::Const(Const::Int(i)) = index.kind else { return None };
                let from_low = u32::try_from(i - dim.low as i128).ok().filter(|d| *d < dim.len())?;
                flat = flat * dim.len() + from_low;
            }
            Some((ImagePlace::Byte(offset + flat * hir.types.layout(*element).size), *element))
        }
        _ => None,
    }
}

fn unfit(program: &mut Program<'_>, p: &Place) -> Option<ImagePlace> {
    let diag = Diag::new(Code::BadTask, p.span, "has no fixed place");
    program.diags.push(diag.help("SINGLE wants a global BOOL, a member of one, or a direct address such as %IX0.0"));
    None
}
