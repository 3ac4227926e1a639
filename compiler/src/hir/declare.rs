//! Resolves all declarations: types, globals, then units with their variables. Each is resolved once, on first use.

use super::builder::Builder;
use super::constant;
use super::late::Owner;
use super::model::*;
use super::symbols::State;
use crate::syntax::ast;
use takt_base::Code;
use takt_base::index::Index;

impl Builder<'_> {
    /// Everything that is declared.
    pub fn declare_all(&mut self) {
        for index in 0..self.symbols.types.len() {
            let span = self.symbols.types[index].decl.name.span;
            if self.symbols.types[index].state == State::Pending {
                self.declared_type(index, span);
            }
        }
        for id in self.hir.globals.indices() {
            self.ensure_global(id);
        }
        // Units of a library are declared when somebody uses them.
        for id in self.own_units() {
            let span = self.symbols.pous[id].decl.name.span;
            self.ensure_pou(id, span);
        }
    }

    /// The units that are not of a library.
    pub(super) fn own_units(&self) -> Vec<PouId> {
        self.hir.pous.indices().filter(|id| !self.symbols.pous[*id].library).collect()
    }

    /// Resolves a global; false if it is being resolved, so that it depends on itself.
    pub fn ensure_global(&mut self, id: GlobalId) -> bool {
        let entry = &mut self.symbols.global_entries[id];
        let Some(decl) = entry.decl else { return true };
        match entry.state {
            State::Done => return true,
            State::Busy => return false,
            State::Pending => entry.state = State::Busy,
        }
        let outer = std::mem::take(&mut self.scope);
        self.scope.resource = self.hir.globals[id].resource;
        self.deeper(decl.span, |b| b.resolve_global(id, decl));
        self.scope = outer;
        self.symbols.global_entries[id].state = State::Done;
        true
    }

    fn resolve_global(&mut self, id: GlobalId, decl: &ast::VarDecl) {
        let used = self.type_ref(&decl.ty);
        self.check_relative(decl);
        if decl.edge.is_some() {
            self.error(Code::SectionNotAllowed, decl.span, "an edge is detected at inputs of function blocks and programs");
        }
        self.hir.globals[id].ty = used.ty;
        self.check_kept_reference(used.ty, self.hir.globals[id].keep.is_kept(), decl.at.is_some(), decl.ty.span);
        if self.hir.globals[id].constant {
            self.check_constant_value(decl, used.ty, &used.default);
        }
        let owner = Owner::Global(id);
        let init = self.declared_value(decl, &used, !self.hir.globals[id].constant, &[owner]);
        let (span, keep) = (self.hir.globals[id].span, self.hir.globals[id].keep);
        if self.startup.late.contains_key(&owner) && keep.is_kept() {
            let bool = self.bool();
            let mark = self.new_global(format!("{}.set", self.hir.globals[id].name), bool, Const::Zero, span);
            self.hir.globals[mark].keep = keep;
            self.startup.marks.insert(owner, Owner::Global(mark));
        }
        self.check_constant_instance(self.hir.globals[id].constant, used.ty, span);
        let kept = self.charge(constant::leaves(&init), decl.span);
        self.hir.globals[id].init = if kept { init } else { Const::Zero };
        if let Some(at) = &decl.at {
            self.locate_global(id, at);
            if at.area == ast::Area::Input {
                self.hir.globals[id].init = Const::Zero;
            }
        }
    }
}

/// Index of the next element.
pub(super) fn next<I: Index, T>(vec: &takt_base::index::IndexVec<I, T>) -> I {
    I::new(vec.len())
}
