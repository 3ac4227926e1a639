//! Names inside a unit, and the search for a name from the inside out (§3.10).

use super::builder::Builder;
use super::model::*;
use super::symbols::Unit;
use crate::syntax::ast;
use std::collections::{HashMap, HashSet};
use takt_base::{Code, Diag, Span};
use takt_image::TypeId;

/// The scope of the unit that is being worked on; without a unit the global scope.
#[derive(Default, Clone)]
pub(super) struct Scope {
    pub pou: Option<PouId>,
    /// The resource that names belong to: in its tasks and connections, and in the values of its globals.
    pub resource: Option<u32>,
    pub names: HashMap<String, (Local, Span)>,
    /// Names of the type that a method belongs to.
    pub members: HashMap<String, Local>,
    /// Variables of that type that must not be written.
    pub fixed_members: HashMap<VarId, ReadOnly>,
    /// Anonymous enumerations declared here.
    pub enums: Vec<TypeId>,
    /// Earlier values of the enumeration that is being declared.
    pub values: Vec<(String, TypeId, i128)>,
    /// Variables that must not be written, with the reason.
    pub read_only: HashMap<VarId, ReadOnly>,
    /// Labels of the body.
    pub labels: super::label::Labels,
    /// Loops around the current statement.
    pub loops: u32,
    /// Control variables of the FOR loops around the current statement.
    pub controls: Vec<VarId>,
    /// The result variable was written.
    pub result_written: bool,
    /// Globals whose direct use has been mentioned.
    pub mentioned: HashSet<GlobalId>,
    /// Unknown names that have been reported.
    pub unknown: HashSet<String>,
}

/// Why a variable can't be written.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum ReadOnly {
    /// CONSTANT: its initial value is its value.
    Constant,
    /// VAR_INPUT of the unit itself.
    Input,
}

/// What a name of a unit stands for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Local {
    Var(VarId),
    External(GlobalId),
    /// Variable of the type that the running method belongs to.
    Member(VarId),
}

impl Builder<'_> {
    /// Enters a name into the unit's scope; false and a report if it is taken.
    pub fn declare_local(&mut self, name: &ast::Name, local: Local) -> bool {
        if let Some(&(_, first)) = self.scope.names.get(&name.key()) {
            self.report(Diag::new(Code::DuplicateName, name.span, "declared again").also(first, "first declared"));
            return false;
        }
        self.scope.names.insert(name.key(), (local, name.span));
        true
    }

    /// The variable of this name in the unit.
    pub fn local(&self, key: &str) -> Option<Local> {
        self.scope.names.get(key).map(|l| l.0).or_else(|| self.scope.members.get(key).copied())
    }

    /// Remembers that the variable of this name, if there is one in the unit or its type, is mentioned.
    pub fn note_use(&mut self, n: &ast::Name) {
        let key = n.key();
        if let Some(&(_, span)) = self.scope.names.get(&key) {
            self.used.insert(span);
        } else if let Some(Local::Member(v)) = self.scope.members.get(&key)
            && let Some(owner) = self.own_type()
        {
            self.used.insert(self.hir.pous[owner].vars[*v].span);
        }
    }

    /// The same for a variable that is reached through an instance, by the number of its field.
    pub fn note_member_use(&mut self, instance: TypeId, field: usize) {
        let Some(pou) = self.objects.types.get(&instance).map(|id| &self.hir.pous[*id]) else { return };
        let is = |v: &&Var| v.storage == Storage::Field(field as u32);
        if let Some(var) = pou.vars.iter().find(is) {
            self.used.insert(var.span);
        }
    }

    /// The global of this name; its direct use without VAR_EXTERNAL is mentioned once a unit.
    pub fn global(&mut self, name: &ast::Name) -> Option<GlobalId> {
        let id = self.global_id(name)?;
        self.check_global_use(name, id);
        if self.scope.pou.is_some()
            && !self.profile(name.span).is_vendor()
            && !self.symbols.global_entries[id].library
            && self.scope.mentioned.insert(id)
        {
            let span = self.hir.globals[id].span;
            self.report(
                Diag::new(Code::GlobalWithoutExternal, name.span, "a global variable")
                    .also(span, "declared")
                    .help("declare it in a VAR_EXTERNAL section of this unit"),
            );
        }
        Some(id)
    }

    /// The unit of this name.
    pub fn pou(&self, name: &ast::Name) -> Option<PouId> {
        match self.unit(name) {
            Some((Unit::Pou(id), _)) => Some(id),
            _ => None,
        }
    }

    /// Reports an unknown name with the nearest known one.
    pub fn unknown(&mut self, code: Code, name: &ast::Name, known: Vec<String>) {
        let mut diag = Diag::new(code, name.span, "not found");
        if let Some(near) = takt_base::nearest(&name.text, known.iter().map(String::as_str)) {
            diag = diag.help(format!("did you mean `{near}`?"));
        }
        self.report(diag);
    }

    /// All names that may stand for a value here.
    pub fn value_names(&self) -> Vec<String> {
        let vars = self.scope.pou.map(|p| self.hir.pous[p].vars.iter().map(|v| v.name.clone()));
        let globals = self.hir.globals.iter().map(|g| g.name.clone());
        let enums =
            self.symbols.types.iter().filter_map(|t| if let ast::TypeBody::Enum(e) = &t.decl.body { Some(e) } else { None });
        let values = enums.flat_map(|e| &e.values).map(|(n, _)| n.text.clone());
        vars.into_iter().flatten().chain(globals).chain(values).collect()
    }

    /// All names of types and units.
    pub fn unit_names(&self) -> Vec<String> {
        let types = self.symbols.types.iter().map(|t| t.decl.name.text.clone());
        types.chain(self.hir.pous.iter().map(|p| p.name.clone())).collect()
    }
}
