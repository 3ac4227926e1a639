//! Which method a name means, which types conform to which, and which methods a dynamic call can reach.

use super::key;
use crate::hir::builder::Builder;
use crate::hir::model::*;
use crate::syntax::ast::{AccessSpec, Accessor, Name};
use std::collections::HashSet;
use takt_base::{Code, Diag, Span};
use takt_image::TypeId;
use takt_image::types::Type;

impl Builder<'_> {
    /// A type and its bases, the nearest first.
    pub(in crate::hir) fn line(&self, id: PouId) -> Vec<PouId> {
        let mut line = vec![id];
        while let Some(base) = line.last().and_then(|id| self.hir.pous[*id].base).filter(|b| !line.contains(b)) {
            line.push(base);
        }
        line
    }

    /// All interfaces of a type, those of its bases and those that they extend included; an interface is one of its own.
    pub(in crate::hir) fn all_interfaces(&self, id: PouId) -> Vec<PouId> {
        let mut todo: Vec<PouId> = self.line(id).into_iter().rev().collect();
        let (mut seen, mut list) = (HashSet::new(), Vec::new());
        while let Some(id) = todo.pop() {
            if seen.insert(id) {
                if self.hir.pous[id].kind == PouKind::Interface {
                    list.push(id);
                }
                todo.extend(self.objects.interfaces.get(&id).into_iter().flatten().rev());
            }
        }
        list
    }

    /// True if an instance of `sub` can be used as a `sup`.
    pub(in crate::hir) fn conforms(&self, sub: PouId, sup: PouId) -> bool {
        match self.hir.pous[sup].kind {
            PouKind::Interface => self.all_interfaces(sub).contains(&sup),
            _ => self.line(sub).contains(&sup),
        }
    }

    /// True if `sub` is an instance type that extends `sup`.
    pub(in crate::hir) fn derives(&self, sub: TypeId, sup: TypeId) -> bool {
        match (self.objects.types.get(&sub), self.objects.types.get(&sup)) {
            (Some(a), Some(b)) => self.line(*a).contains(b),
            _ => false,
        }
    }

    /// The unit that an interface type or an instance type belongs to.
    pub(in crate::hir) fn type_unit(&self, ty: TypeId) -> Option<PouId> {
        match self.ty(ty) {
            Type::Reference { target } => self.objects.types.get(target).copied(),
            Type::Instance(_) => self.objects.types.get(&ty).copied(),
            _ => None,
        }
    }

    /// The method that a type has under this name, its own or an inherited one.
    pub(in crate::hir) fn find_method(&self, ty: PouId, key: &str) -> Option<PouId> {
        let line = if self.hir.pous[ty].kind == PouKind::Interface { self.all_interfaces(ty) } else { self.line(ty) };
        let own = line.into_iter().find_map(|t| self.objects.methods.get(&(t, key.to_owned())).copied());
        // An abstract type may leave a method of its interface to those who extend it.
        own.or_else(|| {
            let open = self.hir.pous[ty].kind != PouKind::Interface && self.is_abstract(ty);
            let interfaces = if open { self.all_interfaces(ty) } else { Vec::new() };
            interfaces.into_iter().find_map(|t| self.objects.methods.get(&(t, key.to_owned())).copied())
        })
    }

    /// GET or SET of a property.
    pub(in crate::hir) fn find_accessor(&self, ty: PouId, name: &Name, accessor: Accessor) -> Option<PouId> {
        self.find_method(ty, &key(name, Some(accessor)))
    }

    /// Names of all methods of a type.
    pub(in crate::hir) fn method_names(&self, ty: PouId) -> Vec<String> {
        let line = if self.hir.pous[ty].kind == PouKind::Interface { self.all_interfaces(ty) } else { self.line(ty) };
        let methods = line.into_iter().flat_map(|t| self.objects.own.get(&t).into_iter().flatten());
        methods.map(|m| self.symbols.pous[*m].decl.name.text.clone()).collect()
    }

    /// Types that can be behind a `ty`, with their class numbers.
    pub(in crate::hir) fn classes_of(&self, ty: PouId) -> Vec<(u32, PouId)> {
        let all = self.hir.pous.enumerate().filter_map(|(id, p)| Some((p.class?, id)));
        all.filter(|(_, id)| !self.is_abstract(*id) && self.conforms(*id, ty)).collect()
    }

    /// What a dynamic call of `key` on a `ty` can run, by class number; empty if there is nothing to choose.
    pub(in crate::hir) fn dispatch(&self, ty: PouId, key: &str) -> Vec<(u32, PouId)> {
        let classes = self.classes_of(ty).into_iter();
        classes
            .filter_map(|(number, id)| Some((number, self.find_method(id, key)?)))
            .filter(|(_, m)| !self.is_signature(*m))
            .collect()
    }

    /// The access of a method and whether it is written there. In an interface all is PUBLIC.
    pub(super) fn method_access(&self, method: PouId) -> (AccessSpec, bool) {
        let decl = self.symbols.pous[method].decl;
        let in_interface = self.hir.pous[method].owner.is_some_and(|o| self.hir.pous[o].kind == PouKind::Interface);
        match decl.objects.modifiers.access {
            _ if in_interface || decl.objects.action => (AccessSpec::Public, true),
            Some((access, _)) => (access, true),
            None if self.profile(decl.name.span).is_vendor() => (AccessSpec::Public, true),
            None => (AccessSpec::Protected, false),
        }
    }

    /// True if the running unit may use what `owner` declares with this access.
    pub(super) fn may_use(&self, access: AccessSpec, owner: PouId, at: Span) -> bool {
        match access {
            AccessSpec::Public => true,
            AccessSpec::Internal => self.symbols.spaces.holds(self.symbols.pous[owner].decl.name.span, at),
            AccessSpec::Private => self.own_type() == Some(owner),
            AccessSpec::Protected => self.own_type().is_some_and(|mine| self.line(mine).contains(&owner)),
        }
    }

    /// False and a report if a method may not be called from here.
    pub(super) fn check_method_access(&mut self, method: PouId, name: &Name) -> bool {
        let (access, written) = self.method_access(method);
        let Some(owner) = self.hir.pous[method].owner.filter(|o| !self.may_use(access, *o, name.span)) else { return true };
        let at = self.symbols.pous[method].decl.name.span;
        let word = access_word(access);
        let owner = self.hir.pous[owner].name.clone();
        let diag = if written {
            Diag::new(Code::AccessDenied, name.span, format!("{word} in `{owner}`")).help("write PUBLIC if everybody may call it")
        } else {
            Diag::new(Code::AccessDenied, name.span, format!("{word}, because nothing is written there"))
                .severity(takt_base::Severity::Warning)
                .message("a method without an access specifier is called from outside")
                .help("write METHOD PUBLIC")
        };
        self.report(diag.also(at, "declared"));
        !written
    }
}

/// As it is written.
pub(super) fn access_word(access: AccessSpec) -> &'static str {
    match access {
        AccessSpec::Public => "PUBLIC",
        AccessSpec::Internal => "INTERNAL",
        AccessSpec::Protected => "PROTECTED",
        AccessSpec::Private => "PRIVATE",
    }
}
