//! Tasks: program instances and function blocks with their entries, and triggers. From: language reference §10.2, §10.3.

use super::Program;
use super::startup::{FirstScan, first_scan};
use super::unit::Unit;
use crate::hir::model::*;
use crate::mir::model::{Function, Module};
use takt_base::index::Index;
use takt_image::image;

/// All tasks; adds the entries of what has connections or addresses to the module.
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
    program.enter_resource(t.resource);
    let hir = program.hir;
    let name = hir.path(Some(t.resource), &t.name);
    let trigger = t.single.as_ref().and_then(|spot| program.data.place(hir, spot));
    let offsets = program.data.instances[number].clone();
    let mut programs: Vec<_> =
        t.programs.iter().zip(offsets).map(|(p, offset)| entry(program, module, first, p, offset, &name)).collect();
    programs.extend(t.blocks.iter().map(|b| block(program, module, first, b, &name)));
    image::Task { name, priority: t.priority, interval: t.interval, trigger, programs }
}

fn entry(
    program: &mut Program<'_>,
    module: &mut Module,
    first: Option<FirstScan>,
    p: &ProgramInstance,
    instance: u32,
    task: &str,
) -> image::Program {
    let name = program.hir.path(Some(p.resource), &p.name);
    let root = p.root();
    let mirrored = program.hir.mirrors.iter().any(|m| m.is_seen_by(&root));
    let connected = first.is_some() || mirrored || !p.inputs.is_empty() || !p.outputs.is_empty();
    let function = if connected {
        module.functions.push(wrapper(program, first, p, format!("{name}@{task}"))).index() as u32
    } else {
        program.view.functions[p.pou].map_or(0, |f| f.0)
    };
    image::Program { name, function, instance }
}

/// Copies the inputs, runs the program, copies the outputs.
fn wrapper(program: &mut Program<'_>, first: Option<FirstScan>, p: &ProgramInstance, name: String) -> Function {
    let pou = &program.hir.pous[p.pou];
    let mut unit = Unit::new(program, None, pou.end);
    unit.run_program(p, first);
    unit.finish(name, pou.name.clone(), None, pou.end)
}

fn block(program: &mut Program<'_>, module: &mut Module, first: Option<FirstScan>, b: &BoundBlock, task: &str) -> image::Program {
    let hir = program.hir;
    let (resource, owner) = program.data.program(hir, &b.program).unwrap_or_default();
    let name = hir.path(Some(resource), &b.name);
    let pou = &hir.pous[b.pou];
    let mut unit = Unit::new(program, None, pou.end);
    unit.run_block(b, owner, first);
    let function = unit.finish(format!("{name}@{task}"), pou.name.clone(), None, pou.end);
    let function = module.functions.push(function).index() as u32;
    image::Program { name, function, instance: owner + b.offset }
}
