//! Programs as instances (vendor, §4.3): `PRG()` and `PRG.x` mean one instance that is there without a declaration. If the program
//! runs once in a task, that instance is the same.

use super::builder::Builder;
use super::model::*;
use super::place::{Access, Target};
use super::symbols::{GlobalEntry, State, Unit};
use crate::syntax::ast;
use std::collections::HashSet;
use takt_base::{Code, Span};
use takt_image::TypeId;

impl Builder<'_> {
    /// The program of this name, where programs are instances.
    pub(super) fn named_program(&self, name: &ast::Name) -> Option<PouId> {
        match self.unit(name) {
            Some((Unit::Pou(id), _)) if self.hir.pous[id].kind == PouKind::Program => Some(id),
            _ => None,
        }
        .filter(|_| self.profile(name.span).is_vendor() && self.global_id(name).is_none())
    }

    /// The instance that a program's name stands for. `None`: it stands for none; `Some(None)`: reported.
    pub(super) fn program_place(&mut self, name: &ast::Name) -> Option<Option<Target>> {
        let id = self.named_program(name)?;
        if !self.ensure_pou(id, name.span) {
            let label = format!("`{}` is not complete here", self.hir.pous[id].name);
            self.error(Code::RecursiveType, name.span, label);
            return Some(None);
        }
        let global = self.program_global(id);
        let ty = self.hir.globals[global].ty;
        let place = Place { base: Base::Global(global), path: Vec::new(), ty, span: name.span };
        Some((ty != self.error).then_some(Target { place, access: Access::Write }))
    }

    fn program_global(&mut self, id: PouId) -> GlobalId {
        if let Some(known) = self.program_globals.get(&id) {
            return *known;
        }
        let pou = &self.hir.pous[id];
        let (name, ty) = (pou.name.clone(), pou.instance.unwrap_or(self.error));
        let init = self.defaults.get(&ty).cloned().unwrap_or(Const::Zero);
        let global = self.new_global(name, ty, init, self.symbols.pous[id].decl.name.span);
        self.hir.programs_are_instances = true;
        self.program_globals.insert(id, global);
        global
    }

    /// A global variable that no section declares.
    pub(super) fn new_global(&mut self, name: String, ty: TypeId, init: Const, span: Span) -> GlobalId {
        self.symbols.global_entries.push(GlobalEntry { decl: None, library: true, state: State::Done });
        self.hir.globals.push(Global { name, ty, place: None, init, constant: false, keep: Keep::Unsaid, resource: None, span })
    }

    /// Programs that others call: without CONFIGURATION no task runs them.
    pub(super) fn called_programs(&self) -> HashSet<PouId> {
        let calls = self.calls.iter().filter_map(|(from, to, _)| from.filter(|f| f != to).map(|_| *to));
        calls.filter(|to| self.program_globals.contains_key(to)).collect()
    }

    /// The only task instance of a program is the one that its name stands for.
    pub(super) fn share_programs(&mut self) {
        let mut shared: Vec<(PouId, GlobalId)> = self.program_globals.iter().map(|(p, g)| (*p, *g)).collect();
        shared.sort();
        for (pou, global) in shared {
            let mut runs: Vec<_> = self.hir.tasks.iter_mut().flat_map(|t| &mut t.programs).filter(|p| p.pou == pou).collect();
            if let [only] = runs.as_mut_slice() {
                only.global = Some(global);
                let root = only.root();
                let variable = &mut self.hir.globals[global];
                (variable.name, variable.resource) = (only.name.clone(), Some(only.resource));
                variable.keep = only.keep;
                if let Some(init) = only.init.take() {
                    variable.init = init;
                }
                let mirrors = self.hir.mirrors.iter_mut();
                mirrors.filter(|m| m.root == root).for_each(|m| m.root = Root::Global(global));
            }
        }
    }
}
