//! Object orientation (§4.2 to §4.4): types with methods, inheritance, interfaces. The whole program is known, so dynamic binding needs
//! no addresses of code: an instance begins with the number of its class, and a call chooses among the methods that it can mean.

mod action;
mod bind;
mod call;
mod check;
mod inherit;
mod inst;
mod life;
mod lookup;
mod property;
mod section;
mod signature;
mod value;

pub(super) use action::has_actions;

use super::builder::Builder;
use super::model::*;
use super::symbols::Unit;
use crate::syntax::ast::{self, AccessSpec, Accessor};
use std::collections::{HashMap, HashSet};
use takt_base::index::Index;
use takt_base::{Code, Diag, SourceId, Span};
use takt_image::TypeId;

/// What is known about types with methods.
#[derive(Default)]
pub(super) struct Table {
    /// Methods by type and name, see [`key`].
    pub methods: HashMap<(PouId, String), PouId>,
    /// Methods of a type in order.
    pub own: HashMap<PouId, Vec<PouId>>,
    /// Names of all properties.
    pub properties: HashSet<String>,
    /// Interfaces of a type as it names them; of an interface those that it extends.
    pub interfaces: HashMap<PouId, Vec<PouId>>,
    /// Types whose instances have a class number.
    pub numbered: HashSet<PouId>,
    /// The unit of an instance type; of an interface, of the type that its references point to.
    pub types: HashMap<TypeId, PouId>,
    /// Access specifiers of variables, with the type that declares them.
    pub var_access: HashMap<(PouId, VarId), (AccessSpec, PouId)>,
    /// An abstract type may stand here: it is not instantiated.
    pub abstract_allowed: bool,
    /// Variables of units that were assigned or lent, and interface variables that were called.
    pub written: HashSet<(PouId, VarId)>,
    pub called: Vec<(PouId, VarId, Span)>,
    /// Fields of VAR_INST variables, by type, method and name.
    pub instance_vars: HashMap<(PouId, String, String), VarId>,
    /// How many variables types have that others extend.
    pub taken_over: HashMap<PouId, usize>,
    /// Tells that retained variables were restored; made when an FB_init asks.
    pub kept_mark: Option<GlobalId>,
    /// Who may call whom through a class number, and where.
    pub dynamic_calls: Vec<(Option<PouId>, PouId, Span)>,
}

/// Name under which a method is found. A property has two.
pub(super) fn key(name: &ast::Name, accessor: Option<Accessor>) -> String {
    match accessor {
        None => name.key(),
        Some(Accessor::Get) => format!("{}.GET", name.key()),
        Some(Accessor::Set) => format!("{}.SET", name.key()),
    }
}

impl<'a> Builder<'a> {
    /// Enters the methods of a type.
    pub(super) fn collect_methods(&mut self, owner: PouId, decl: &'a ast::Pou, source: SourceId, library: bool) {
        for method in &decl.objects.methods {
            let accessor = method.objects.accessor;
            if accessor.is_some() {
                self.objects.properties.insert(method.name.key());
            }
            let id = self.enter_pou(method, source, library);
            let name = match accessor {
                None => format!("{}.{}", decl.name.text, method.name.text),
                Some(a) => format!("{}.{}.{a:?}", decl.name.text, method.name.text),
            };
            let pou = &mut self.hir.pous[id];
            (pou.name, pou.owner) = (name, Some(owner));
            let first = *self.objects.methods.entry((owner, key(&method.name, accessor))).or_insert(id);
            if first == id {
                self.objects.own.entry(owner).or_default().push(id);
            } else {
                let span = self.symbols.pous[first].decl.name.span;
                let diag = Diag::new(Code::DuplicateName, method.name.span, "declared again").also(span, "first declared");
                self.report(diag.help("methods differ in their names, not only in their parameters"));
            }
        }
    }

    /// Finds the types whose instances need a class number: those that extend, are extended, or implement something.
    pub(super) fn number_classes(&mut self) {
        for id in self.hir.pous.indices() {
            let decl = self.symbols.pous[id].decl;
            let interface = decl.kind == ast::PouKind::Interface;
            if interface || decl.objects.extends.is_empty() && decl.objects.implements.is_empty() {
                continue;
            }
            let mut next = Some(id);
            while let Some(id) = next.filter(|id| self.objects.numbered.insert(*id)) {
                let extends = self.symbols.pous[id].decl.objects.extends.first();
                next = extends.and_then(|n| match self.unit(n) {
                    Some((Unit::Pou(base), _)) => Some(base),
                    _ => None,
                });
            }
        }
    }

    /// The number in the instances of a type.
    pub(super) fn class_number(id: PouId) -> u32 {
        id.index() as u32 + 1
    }

    /// The type that the running unit is or belongs to.
    pub(super) fn own_type(&self) -> Option<PouId> {
        let id = self.scope.pou?;
        let pou = &self.hir.pous[id];
        match pou.kind {
            PouKind::Function => None,
            PouKind::Method => pou.owner,
            _ => Some(id),
        }
    }

    /// True if the type has no instances.
    pub(super) fn is_abstract(&self, id: PouId) -> bool {
        self.symbols.pous[id].decl.objects.modifiers.is_abstract.is_some()
    }

    /// True for what has no body: methods of interfaces, ABSTRACT methods, interfaces.
    pub(super) fn is_signature(&self, id: PouId) -> bool {
        let pou = &self.hir.pous[id];
        let in_interface = pou.owner.is_some_and(|o| self.hir.pous[o].kind == PouKind::Interface);
        pou.kind == PouKind::Interface || in_interface || pou.kind == PouKind::Method && self.is_abstract(id)
    }

    /// Reports an instance of an abstract type.
    pub(super) fn check_instantiable(&mut self, id: PouId, at: Span) {
        if self.is_abstract(id) && !self.objects.abstract_allowed {
            let span = self.symbols.pous[id].decl.name.span;
            let label = format!("`{}` is ABSTRACT", self.hir.pous[id].name);
            let diag = Diag::new(Code::AbstractInstance, at, label).also(span, "declared");
            self.report(diag.help("declare an instance of a type that extends it, or pass it as VAR_IN_OUT"));
        }
    }
}
