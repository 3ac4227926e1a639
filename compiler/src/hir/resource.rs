//! Globals of resources (§3.5, §10.1). With one resource its globals replace those of the configuration that have the same name. With
//! several, each has names of its own: a unit is resolved with one variable of a name, and `check::views` says which one it means in
//! each resource.

use super::builder::Builder;
use super::model::*;
use crate::syntax::ast;
use std::collections::HashMap;
use takt_base::{Code, Diag};
use takt_image::TypeId;

impl<'a> Builder<'a> {
    /// All resources of the configuration, in order.
    pub fn resources(&self) -> Vec<&'a ast::Resource> {
        self.symbols.configurations.iter().flat_map(|c| &c.resources).collect()
    }

    /// Globals of the configuration and its resources.
    pub(super) fn collect_configurations(&mut self) {
        if let Some(second) = self.symbols.configurations.get(1) {
            self.unsupported(second.name.span, "a second CONFIGURATION", "put all resources into one");
        }
        for c in self.symbols.configurations.clone() {
            for section in &c.globals {
                self.collect_globals(section, false, None, &|_, _| false);
            }
        }
        let resources = self.resources();
        if resources.len() > 1 {
            self.name_resources(&resources);
            resources.iter().zip(0..).for_each(|(r, number)| self.collect_resource(r, number));
            return self.group();
        }
        for section in resources.iter().flat_map(|r| &r.globals) {
            self.hide_globals(section);
            self.collect_globals(section, false, None, &|_, _| false);
        }
    }

    fn name_resources(&mut self, resources: &[&'a ast::Resource]) {
        let mut names = HashMap::new();
        for name in resources.iter().filter_map(|r| r.name.as_ref()) {
            self.unique(&mut names, name);
            if let Some(&global) = self.symbols.globals.get(&name.key()) {
                let span = self.hir.globals[global].span;
                self.report(Diag::new(Code::DuplicateName, name.span, "a global has this name").also(span, "declared"));
            }
        }
        let name = |r: &&ast::Resource| r.name.as_ref().map_or_else(String::new, |n| n.text.clone());
        self.hir.resources = resources.iter().map(name).collect();
    }

    /// Globals of the only resource hide those of the configuration.
    fn hide_globals(&mut self, section: &ast::VarSection) {
        let outer = |c: &ast::Configuration, key: &str| {
            let decls = c.globals.iter().flat_map(|s| &s.decls);
            decls.flat_map(|d| &d.names).any(|n| n.key() == key)
        };
        for name in section.decls.iter().flat_map(|d| &d.names) {
            if self.symbols.configurations.iter().any(|c| outer(c, &name.key())) {
                self.symbols.globals.remove(&name.key());
            }
        }
    }

    fn collect_resource(&mut self, resource: &'a ast::Resource, number: u32) {
        let mut own: HashMap<String, GlobalId> = HashMap::new();
        for section in &resource.globals {
            for decl in &section.decls {
                let anonymous = decl.names.is_empty().then(|| decl.at.as_ref().map(super::image::name_of)).flatten();
                for name in decl.names.iter().chain(anonymous.as_ref()) {
                    let id = self.collect_global(section, decl, name, false);
                    self.hir.globals[id].resource = Some(number);
                    let first = *own.entry(name.key()).or_insert(id);
                    if first != id {
                        let span = self.hir.globals[first].span;
                        let diag = Diag::new(Code::DuplicateName, name.span, "declared again");
                        self.report(diag.also(span, "first declared"));
                    }
                }
            }
        }
        self.symbols.resource_globals.push(own);
    }

    /// Each name of a resource's global stands for one variable where no resource is known: the outer one, else the first.
    fn group(&mut self) {
        for own in self.symbols.resource_globals.clone() {
            let mut names: Vec<_> = own.into_iter().collect();
            names.sort_by_key(|n| n.1);
            for (key, id) in names {
                let outer = *self.symbols.globals.entry(key.clone()).or_insert(id);
                self.symbols.grouped.insert(outer, key.clone());
                self.symbols.grouped.insert(id, key);
            }
        }
    }

    /// The global that a name stands for in a resource.
    pub(super) fn visible(&self, resource: u32, key: &str) -> Option<GlobalId> {
        let own = self.symbols.resource_globals.get(resource as usize).and_then(|own| own.get(key));
        let outer = || self.symbols.globals.get(key).filter(|id| !self.is_inner(**id));
        own.or_else(outer).copied()
    }

    /// True for a global of one of several resources.
    fn is_inner(&self, id: GlobalId) -> bool {
        self.hir.globals[id].resource.is_some()
    }

    /// The variables that a name may stand for, the outer one first.
    pub(super) fn candidates(&self, key: &str) -> Vec<GlobalId> {
        let inner = self.symbols.resource_globals.iter().filter_map(|own| own.get(key));
        let mut list: Vec<_> = self.symbols.globals.get(key).into_iter().chain(inner).copied().collect();
        list.dedup();
        list
    }

    /// True if the resource decides which value a CONSTANT has.
    pub(super) fn is_undecided(&self, id: GlobalId) -> bool {
        let key = self.symbols.grouped.get(&id).filter(|_| self.scope.resource.is_none());
        key.is_some_and(|key| self.candidates(key).len() > 1)
    }

    /// Of the variables of a name the first that a VAR_EXTERNAL fits.
    pub(super) fn fitting_global(&mut self, id: GlobalId, ty: TypeId, constant: bool) -> GlobalId {
        let Some(key) = self.symbols.grouped.get(&id).cloned() else { return id };
        let list = self.candidates(&key);
        list.iter().for_each(|g| _ = self.ensure_global(*g));
        let fits = |g: &&GlobalId| self.hir.globals[**g].ty == ty && self.hir.globals[**g].constant == constant;
        list.iter().find(fits).copied().unwrap_or(id)
    }

    /// Remembers which units use a global whose name means different variables in different resources.
    pub(super) fn note_global(&mut self, id: GlobalId, span: takt_base::Span) {
        if self.scope.resource.is_none() && self.symbols.grouped.contains_key(&id) {
            self.uses.push((self.scope.pou, id, span));
        }
    }
}
