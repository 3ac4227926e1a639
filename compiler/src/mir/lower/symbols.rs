//! Names for monitor and runtime: globals, program instances, located variables of programs as `instance.variable`, access paths. With
//! several resources what belongs to one has its name in front. From: language reference §3.8, §10.1.

use super::data::Data;
use crate::hir::model::*;
use takt_image::TypeId;
use takt_image::image::{Access, Place, Symbol};

/// All symbols of a program.
pub fn symbols(hir: &Hir, data: &Data) -> Vec<Symbol> {
    let globals = hir.globals.iter().zip(data.globals.iter()).map(|(g, place)| Symbol {
        constant: g.constant,
        retain: g.keep.is_kept(),
        ..symbol(hir.global_path(g), g.ty, *place)
    });
    let programs = hir.tasks.iter().zip(&data.instances).flat_map(|(t, offsets)| t.programs.iter().zip(offsets));
    let programs = programs.flat_map(|(p, offset)| program_symbols(hir, p, *offset));
    globals.chain(programs).chain(hir.accesses.iter().filter_map(|a| access(hir, data, a))).collect()
}

fn symbol(name: String, ty: TypeId, place: Place) -> Symbol {
    Symbol { name, ty, place, constant: false, retain: false, access: None }
}

fn program_symbols(hir: &Hir, program: &ProgramInstance, offset: u32) -> Vec<Symbol> {
    let pou = &hir.pous[program.pou];
    let name = hir.path(Some(program.resource), &program.name);
    let itself = pou.instance.filter(|_| program.global.is_none()).map(|ty| symbol(name.clone(), ty, Place::Byte(offset)));
    let located = pou.vars.iter().filter(|v| v.role != Role::Hidden).filter_map(|v| match v.storage {
        Storage::Image(place) => Some(symbol(format!("{name}.{}", v.name), v.ty, place)),
        _ => None,
    });
    itself.into_iter().chain(located).collect()
}

fn access(hir: &Hir, data: &Data, path: &AccessPath) -> Option<Symbol> {
    let direction = if path.writable { Access::ReadWrite } else { Access::ReadOnly };
    Some(Symbol { access: Some(direction), ..symbol(path.name.clone(), path.ty, data.place(hir, &path.spot)?) })
}
