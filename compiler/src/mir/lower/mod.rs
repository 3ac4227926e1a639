//! From the typed program to MIR and the data parts of the image. The program is well formed: what can still be wrong is its size.
//!
//! Invariant: an address that the code makes is inside of the object that the program named, or the code has trapped before.

mod builder;
mod call;
mod case;
mod convert;
mod counted;
mod data;
mod entry;
mod expr;
mod graph;
mod guarded;
mod index;
mod init;
mod interval;
mod intrinsic;
mod lines;
mod native;
mod object;
mod open;
mod operator;
mod place;
mod pointer;
mod retain;
mod shape;
mod startup;
mod stmt;
mod symbols;
mod task;
mod time;
mod unit;
mod view;
mod walk;

use crate::hir::model::*;
use crate::mir::model::{FuncId, Module, NativeId};
use data::Data;
use lines::Lines;
use std::collections::HashMap;
use takt_base::index::IndexVec;
use takt_base::{Diag, Sources};
use takt_image::image::{Chunk, Retained, Symbol, Task};
use takt_image::memory::MAX_MEMORY;
use takt_image::{MemoryMap, NativeImport, Type};
use view::View;

/// A lowered program: everything of an image but the machine code.
#[derive(Clone, Debug)]
pub struct Lowered {
    /// The code.
    pub module: Module,
    /// Sizes of the memory's parts.
    pub memory: MemoryMap,
    /// Initial contents.
    pub init: Vec<Chunk>,
    /// Named variables.
    pub symbols: Vec<Symbol>,
    /// What keeps its value over a restart.
    pub retained: Vec<Retained>,
    /// Tasks; their functions are indices into the module's.
    pub tasks: Vec<Task>,
}

/// What the functions of a program share while they are lowered.
pub struct Program<'h> {
    hir: &'h Hir,
    lines: Lines<'h>,
    data: Data,
    /// What names mean in what is lowered now.
    view: View,
    /// Its number, once one of `views` is entered.
    entered: Option<usize>,
    views: Vec<View>,
    /// Units that can be entered again while they run.
    recursive: IndexVec<PouId, bool>,
    natives: IndexVec<NativeId, NativeImport>,
    diags: Vec<Diag>,
    statics: pointer::Statics,
    reach: pointer::Reach,
    /// Pointers may hold any number.
    wild: bool,
    /// References to variables are kept.
    referred: bool,
}

/// Lowers a program that was checked without errors.
pub fn lower(hir: &Hir, sources: &Sources) -> Result<Lowered, Vec<Diag>> {
    let too_large = oversized(hir);
    if !too_large.is_empty() {
        return Err(too_large);
    }
    let data = Data::new(hir).map_err(|d| vec![d])?;
    let mut program = Program::new(hir, sources, data);
    let mut module = Module::default();
    view::units(&mut program, &mut module);
    let tasks = task::tasks(&mut program, &mut module);
    program.finish(module, tasks)
}

fn is_lowered(pou: &Pou) -> bool {
    pou.reachable && !pou.external
}

/// Variables whose type alone is larger than the memory.
fn oversized(hir: &Hir) -> Vec<Diag> {
    let vars = hir.pous.iter().filter(|p| p.reachable).flat_map(|p| p.vars.iter());
    let all = vars.map(|v| (v.ty, v.span, &v.name)).chain(hir.globals.iter().map(|g| (g.ty, g.span, &g.name)));
    let large = all.filter(|(ty, ..)| hir.types.layout(*ty).size > MAX_MEMORY);
    large.map(|(_, span, name)| data::too_large(span, &format!("`{name}`"))).collect()
}

impl<'h> Program<'h> {
    fn new(hir: &'h Hir, sources: &'h Sources, data: Data) -> Self {
        let mut next = 0;
        let number = |pou: &Pou| {
            is_lowered(pou).then(|| {
                next += 1;
                FuncId(next - 1)
            })
        };
        let functions = hir.pous.iter().map(number).collect();
        let view = View { globals: data.globals.clone(), functions, ..View::default() };
        let (lines, recursive) = (Lines::new(sources), graph::recursive(hir));
        let referred = hir.types.iter().any(|(_, t)| matches!(t, Type::Pointer { .. }));
        let mut program = Program {
            hir,
            lines,
            data,
            view,
            entered: None,
            views: Vec::new(),
            recursive,
            natives: IndexVec::new(),
            diags: Vec::new(),
            statics: HashMap::new(),
            reach: pointer::Reach::default(),
            wild: pointer::has_pointers(hir),
            referred,
        };
        program.prepare_pointers();
        program
    }

    /// The number of an import, the same for all its calls.
    fn import(&mut self, import: NativeImport) -> NativeId {
        let known = self.natives.enumerate().find(|(_, n)| **n == import).map(|(id, _)| id);
        known.unwrap_or_else(|| self.natives.push(import))
    }

    fn finish(self, mut module: Module, tasks: Vec<Task>) -> Result<Lowered, Vec<Diag>> {
        if !self.diags.is_empty() {
            return Err(self.diags);
        }
        let retained = retain::retained(self.hir, &self.data).map_err(|d| vec![d])?;
        let symbols = symbols::symbols(self.hir, &self.data);
        let Some((memory, init)) = self.data.finish(self.hir) else {
            return Err(vec![data::too_large(data::nowhere(), "the program")]);
        };
        (module.natives, module.lines, module.files) = (self.natives, self.lines.lines, self.lines.files);
        Ok(Lowered { module, memory, init, symbols, retained, tasks })
    }
}
