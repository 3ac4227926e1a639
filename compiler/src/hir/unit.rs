//! The variables of a unit: sections, storage, signature, and the layout of its instances (§3.1, §3.2, §4).

use super::builder::Builder;
use super::constant;
use super::declare::next;
use super::late::Owner;
use super::model::*;
use super::objects::has_actions;
use super::scope::{Local, ReadOnly};
use super::symbols::State;
use super::types::TypeUse;
use super::types::structure::Member;
use crate::syntax::ast::{self, SectionKind};
use takt_base::index::Index;
use takt_base::{Code, Diag, Span};
use takt_image::types::{Section, Type};
use takt_image::{Elementary, TypeId};

impl Builder<'_> {
    /// Resolves the variables of a unit; false if that is going on, so that it would contain itself.
    pub fn ensure_pou(&mut self, id: PouId, at: Span) -> bool {
        let entry = &mut self.symbols.pous[id];
        let decl = entry.decl;
        match entry.state {
            State::Done => return true,
            State::Busy => return false,
            State::Pending => entry.state = State::Busy,
        }
        let outer = std::mem::take(&mut self.scope);
        self.scope.pou = Some(id);
        self.deeper(at, |b| b.resolve_pou(id, decl));
        let own = std::mem::replace(&mut self.scope, outer);
        let entry = &mut self.symbols.pous[id];
        entry.scope = own;
        entry.state = State::Done;
        true
    }

    fn resolve_pou(&mut self, id: PouId, decl: &ast::Pou) {
        let kind = self.hir.pous[id].kind;
        match kind {
            PouKind::Interface => return self.declare_interface(id, decl),
            PouKind::Method => self.enter_owner(id),
            PouKind::Function => {}
            _ => self.inherit(id, decl),
        }
        if kind.is_called_by_value() {
            self.declare_result(id, decl);
        }
        // Constants first: bounds and lengths may use one that is declared further down.
        let constant = |s: &&ast::VarSection| s.constant && matches!(s.kind, SectionKind::Var | SectionKind::External);
        let sections = decl.sections.iter().filter(constant).chain(decl.sections.iter().filter(|s| !constant(s)));
        for section in sections {
            self.check_section(decl, section);
            if section.kind == SectionKind::Inst {
                self.declare_instance_variables(id, decl, section);
            }
            for d in &section.decls {
                self.declare_vars(id, decl, section, d);
            }
        }
        if !kind.is_called_by_value() {
            self.add_instance_variables(id, decl);
            self.lay_out(id, decl);
        }
    }

    fn declare_result(&mut self, id: PouId, decl: &ast::Pou) {
        let Some(result) = &decl.result else { return };
        let used = self.type_ref(result);
        if matches!(self.ty(used.ty), Type::Instance(_)) {
            let label = format!("{} has memory", self.show(used.ty));
            self.report(
                Diag::new(Code::SectionNotAllowed, result.span, label).message("a function can't return a function block"),
            );
        }
        if decl.external && matches!(self.ty(used.ty), Type::Array { .. } | Type::Struct(_)) {
            self.unsupported(result.span, "an external function with such a result", "return it through a VAR_IN_OUT");
        }
        let var = self.push_var(id, &decl.name, used.ty, Role::Result, Storage::Local, used.default);
        self.hir.pous[id].result = Some(var);
        self.declare_local(&decl.name, Local::Var(var));
    }

    pub(super) fn push_var(
        &mut self,
        id: PouId,
        name: &ast::Name,
        ty: TypeId,
        role: Role,
        storage: Storage,
        init: Const,
    ) -> VarId {
        let init = if self.charge(constant::leaves(&init) - 1, name.span) { init } else { Const::Zero };
        let (name, span, keep) = (name.text.clone(), name.span, Keep::Unsaid);
        self.hir.pous[id].vars.push(Var { name, ty, role, storage, init, keep, copied_back: false, edge: None, span })
    }

    fn declare_vars(&mut self, id: PouId, pou: &ast::Pou, section: &ast::VarSection, d: &ast::VarDecl) {
        if section.kind == SectionKind::External {
            d.names.iter().for_each(|name| self.declare_external(section, d, name));
            return;
        }
        if section.kind == SectionKind::Global {
            return;
        }
        if section.kind == SectionKind::Inst {
            return; // see `resolve_pou`
        }
        if section.kind == SectionKind::Stat {
            return self.declare_static(id, pou, section, d);
        }
        let outer = std::mem::replace(&mut self.objects.abstract_allowed, section.kind == SectionKind::InOut);
        let used = self.declared_var_type(pou, section, &d.ty);
        self.objects.abstract_allowed = outer;
        self.check_decl(pou, section, d, used.ty);
        self.check_kept_reference(used.ty, section.retain == Some(true), d.at.is_some(), d.ty.span);
        if section.constant && section.kind == SectionKind::Var {
            self.check_constant_value(d, used.ty, &used.default);
        }
        let called = self.hir.pous[id].kind.is_called_by_value();
        let late = match section.kind {
            SectionKind::Input | SectionKind::InOut => !called && section.kind == SectionKind::Input,
            _ => !section.constant && d.at.as_ref().is_none_or(|at| !at.path.is_empty()),
        };
        let first = next(&self.hir.pous[id].vars);
        let owners: Vec<Owner> = (0..d.names.len().max(1)).map(|i| Owner::Var(id, VarId::new(first.index() + i))).collect();
        let init = self.declared_value(d, &used, late, &owners);
        let used = TypeUse { default: init, ..used };
        let anonymous = d.names.is_empty().then(|| d.at.as_ref().map(super::image::name_of)).flatten();
        for name in d.names.iter().chain(anonymous.as_ref()) {
            self.declare_var(id, pou, section, d, name, &used);
        }
        if !called && section.kind != SectionKind::Temp {
            self.mark_late(id, d, &owners, Keep::of(section));
        }
    }

    /// Marks behind variables whose values are computed at the start: these may be restored instead.
    fn mark_late(&mut self, id: PouId, d: &ast::VarDecl, owners: &[Owner], keep: Keep) {
        for (name, owner) in d.names.iter().zip(owners) {
            if self.startup.late.contains_key(owner) {
                let mark = self.add_mark(id, name, keep);
                self.startup.marks.insert(*owner, Owner::Var(id, mark));
            }
        }
    }

    fn declare_var(
        &mut self,
        id: PouId,
        pou: &ast::Pou,
        section: &ast::VarSection,
        d: &ast::VarDecl,
        name: &ast::Name,
        used: &TypeUse,
    ) {
        let copied_back = section.kind == SectionKind::InOut && self.is_copied(pou, name.span, used.ty);
        let role = match section.kind {
            SectionKind::InOut if copied_back => Role::Input,
            SectionKind::Input => Role::Input,
            SectionKind::Output => Role::Output,
            SectionKind::InOut => Role::InOut,
            SectionKind::Temp => Role::Temp,
            _ => Role::Local,
        };
        let var = next(&self.hir.pous[id].vars);
        if !self.declare_own(id, name, Local::Var(var)) {
            return;
        }
        if let Some(access) = section.access {
            self.objects.var_access.insert((id, var), (access, id));
        }
        let enables = matches!((role, d.init.is_none()), (Role::Input, true)) && name.is("EN")
            || role == Role::Output && d.init.is_none() && name.is("ENO");
        let on = enables && self.elementary(used.ty) == Some(Elementary::Bool) && !self.profile(name.span).is_codesys();
        let init = match role {
            Role::InOut => Const::Zero,
            _ if on => Const::Int(1),
            _ => used.default.clone(),
        };
        self.push_var(id, name, used.ty, role, Storage::Local, init);
        self.hir.pous[id].vars[var].keep = Keep::of(section);
        self.hir.pous[id].vars[var].copied_back = copied_back;
        if matches!(role, Role::Input | Role::Output | Role::InOut) {
            self.hir.pous[id].params.push(var);
        }
        if role == Role::InOut {
            self.note_open_string(id, var, &d.ty);
        }
        let constant = section.constant && role != Role::Input;
        if constant || role == Role::Input && !copied_back {
            self.scope.read_only.insert(var, if constant { ReadOnly::Constant } else { ReadOnly::Input });
        }
        if let Some(edge) = d.edge {
            self.hir.pous[id].vars[var].edge = Some((edge, var));
        }
        let may_locate = |at: &&ast::Address| {
            let block = matches!(pou.kind, ast::PouKind::FunctionBlock | ast::PouKind::Class);
            let kind = pou.kind == ast::PouKind::Program || block && at.path.is_empty();
            kind && section.kind == SectionKind::Var
        };
        if let Some(at) = d.at.as_ref().filter(may_locate) {
            self.locate_var(id, var, at);
            if at.area == ast::Area::Input {
                self.hir.pous[id].vars[var].init = Const::Zero;
            }
        }
    }

    /// VAR_STAT (vendor): one variable for all calls and instances of the unit.
    fn declare_static(&mut self, id: PouId, pou: &ast::Pou, section: &ast::VarSection, d: &ast::VarDecl) {
        let used = self.type_ref(&d.ty);
        self.check_decl(pou, section, d, used.ty);
        let first = next(&self.hir.globals);
        let owners: Vec<Owner> = (0..d.names.len()).map(|i| Owner::Global(GlobalId::new(first.index() + i))).collect();
        let init = self.declared_value(d, &used, false, &owners);
        for name in &d.names {
            let full = format!("{}.{}", self.hir.pous[id].name, name.text);
            let init = if self.charge(constant::leaves(&init) - 1, name.span) { init.clone() } else { Const::Zero };
            let global = self.new_global(full, used.ty, init, name.span);
            self.hir.globals[global].constant = section.constant;
            self.declare_local(name, Local::External(global));
        }
    }

    /// VAR_EXTERNAL: a global of the same name and type, CONSTANT if that is (§3.5).
    fn declare_external(&mut self, section: &ast::VarSection, d: &ast::VarDecl, name: &ast::Name) {
        let used = self.type_ref(&d.ty);
        let Some(id) = self.global_id(name) else {
            let known: Vec<String> = self.hir.globals.iter().map(|g| g.name.clone()).collect();
            self.unknown(Code::ExternalMismatch, name, known);
            self.declare_unmatched(name, used.ty);
            return;
        };
        self.ensure_global(id);
        let id = self.fitting_global(id, used.ty, section.constant);
        self.note_global(id, name.span);
        self.declare_local(name, Local::External(id));
        let global = &self.hir.globals[id];
        let (ty, constant, span) = (global.ty, global.constant, global.span);
        let label = match () {
            () if ty == self.error || used.ty == self.error => return,
            () if ty != used.ty => format!("{}, the global is {}", self.show(used.ty), self.show(ty)),
            () if constant && !section.constant => "the global is CONSTANT, this is not".to_owned(),
            () if section.constant && !constant => "this is CONSTANT, the global is not".to_owned(),
            () if d.init.is_some() => "has an initial value".to_owned(),
            () => return,
        };
        let help = "repeat the declaration of the global exactly, without its initial value";
        self.report(Diag::new(Code::ExternalMismatch, name.span, label).also(span, "the global").help(help));
    }

    /// A variable that stands for an external without a global, so that its uses are not reported again.
    fn declare_unmatched(&mut self, name: &ast::Name, ty: TypeId) {
        if let Some(id) = self.scope.pou {
            let var = next(&self.hir.pous[id].vars);
            if self.declare_local(name, Local::Var(var)) {
                self.push_var(id, name, ty, Role::Temp, Storage::Local, Const::Zero);
            }
        }
    }

    /// A VAR_IN_OUT of this type is copied in and back. What has memory of its own, or any bounds, is always referred to.
    fn is_copied(&self, pou: &ast::Pou, at: Span, ty: TypeId) -> bool {
        let whole = |t: &Type| matches!(t, Type::Instance(_) | Type::Reference { .. });
        let block = pou.kind == ast::PouKind::FunctionBlock;
        block && self.profile(at).copies_in_outs() && !self.hir.types.holds(ty, whole) && self.open_parts(ty).is_none()
    }

    /// The instance: inputs, outputs, in-outs, variables, edge memory (§3.11).
    fn lay_out(&mut self, id: PouId, decl: &ast::Pou) {
        self.add_edge_memory(id);
        let mut order = self.inherited_fields(id);
        for (section, role) in [
            (Section::Input, Role::Input),
            (Section::Output, Role::Output),
            (Section::InOut, Role::InOut),
            (Section::Var, Role::Local),
            (Section::Hidden, Role::Hidden),
            (Section::Hidden, Role::Temp),
        ] {
            if role == Role::Temp && !has_actions(decl) {
                continue; // they live on the frame of the body, where no action finds them
            }
            let vars = self.hir.pous[id]
                .vars
                .enumerate()
                .filter(|(v, var)| var.role == role && self.image.area_of_var(id, *v).is_none());
            let new: Vec<_> = vars.map(|(v, _)| (section, v)).filter(|(_, v)| order.iter().all(|o| o.1 != *v)).collect();
            order.extend(new);
        }
        let mut retained = retained(decl);
        retained.extend(self.inherited_retain(id));
        let mut members = Vec::new();
        for (i, &(section, v)) in order.iter().enumerate() {
            let var = &mut self.hir.pous[id].vars[v];
            var.storage = Storage::Field(i as u32);
            let (name, init, retain) = (var.name.clone(), var.init.clone(), retained.contains(&var.name));
            let target = var.ty;
            let ty = if section == Section::InOut { self.hir.types.intern(Type::Reference { target }) } else { target };
            members.push(Member { name, ty, section, retain, init });
        }
        let Some((record, default)) = self.record(self.hir.pous[id].name.clone(), members, decl.name.span) else { return };
        let ty = self.reserved_instance(id);
        self.hir.types.replace(ty, Type::Instance(record));
        self.defaults.insert(ty, default);
        self.hir.pous[id].instance = Some(ty);
        self.objects.types.insert(ty, id);
    }

    /// The hidden variable of each edge input holds the previous value of the actual input (§3.3).
    fn add_edge_memory(&mut self, id: PouId) {
        let bool = self.elem(Elementary::Bool);
        for v in self.hir.pous[id].vars.indices() {
            let var = &self.hir.pous[id].vars[v];
            let Some((edge, _)) = var.edge else { continue };
            let name = ast::Name { text: format!("{}.edge", var.name), span: var.span };
            let keep = var.keep;
            let memory = self.push_var(id, &name, bool, Role::Hidden, Storage::Local, Const::Zero);
            self.hir.pous[id].vars[memory].keep = keep;
            self.hir.pous[id].vars[v].edge = Some((edge, memory));
        }
    }
}

/// Names of the variables declared RETAIN.
fn retained(decl: &ast::Pou) -> Vec<String> {
    let sections = decl.sections.iter().filter(|s| s.retain == Some(true));
    sections.flat_map(|s| &s.decls).flat_map(|d| &d.names).map(|n| n.text.clone()).collect()
}
