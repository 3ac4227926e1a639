//! Rules about types as a whole: what they promise they have, what they replace they may replace (§4.4).

use super::key;
use crate::hir::builder::Builder;
use crate::hir::model::*;
use crate::syntax::ast::{self, AccessSpec};
use takt_base::{Code, Diag};

impl Builder<'_> {
    /// Checks all types. Runs when everything is declared.
    pub(in crate::hir) fn check_objects(&mut self) {
        for id in self.hir.pous.indices() {
            match self.hir.pous[id].kind {
                PouKind::Method => self.check_method(id),
                PouKind::FunctionBlock | PouKind::Class => self.check_promises(id),
                PouKind::Program => self.check_program(id),
                _ => {}
            }
        }
    }

    fn check_program(&mut self, id: PouId) {
        let decl = self.symbols.pous[id].decl;
        if let Some(name) = decl.objects.implements.first() {
            let help = "put the methods into a function block and declare an instance of it";
            self.report(Diag::new(Code::NotABase, name.span, "a program implements nothing").help(help));
        }
    }

    fn check_method(&mut self, id: PouId) {
        let decl = self.symbols.pous[id].decl;
        let Some(owner) = self.hir.pous[id].owner else { return };
        if self.hir.pous[owner].kind == PouKind::Function {
            return; // reported by the parser
        }
        self.check_clash(owner, decl);
        self.check_abstract(id, owner, decl);
        self.check_life_cycle(decl);
        if self.hir.pous[owner].kind != PouKind::Interface {
            self.check_override(id, owner, decl);
        }
    }

    /// A method with the name of a variable of its type.
    fn check_clash(&mut self, owner: PouId, decl: &ast::Pou) {
        let vars = &self.hir.pous[owner].vars;
        let Some(at) = vars.iter().find(|v| v.role != Role::Hidden && decl.name.is(&v.name)).map(|v| v.span) else { return };
        self.report(Diag::new(Code::MemberClash, decl.name.span, "a method").also(at, "the variable").help("rename one of them"));
    }

    fn check_abstract(&mut self, id: PouId, owner: PouId, decl: &ast::Pou) {
        let Some(span) = decl.objects.modifiers.is_abstract else { return };
        if self.hir.pous[owner].kind != PouKind::Interface && !self.is_abstract(owner) {
            let at = self.symbols.pous[owner].decl.name.span;
            let label = format!("`{}` is not ABSTRACT", self.hir.pous[owner].name);
            self.report(
                Diag::new(Code::AbstractMethod, span, label).also(at, "declared").help("write ABSTRACT in front of its name too"),
            );
        }
        if let Some(first) = decl.body.first() {
            let label = format!("the body of `{}`, which is ABSTRACT", self.hir.pous[id].name);
            self.report(
                Diag::new(Code::AbstractMethod, first.span, label).help("leave the body to the types that extend this one"),
            );
        }
    }

    /// What the method replaces, if anything.
    fn check_override(&mut self, id: PouId, owner: PouId, decl: &ast::Pou) {
        let modifiers = &decl.objects.modifiers;
        let base = self.hir.pous[owner].base;
        let name = key(&decl.name, decl.objects.accessor);
        let old = base.and_then(|b| self.line(b).into_iter().find_map(|t| self.objects.methods.get(&(t, name.clone())).copied()));
        let old = old.filter(|old| self.method_access(*old).0 != AccessSpec::Private);
        let Some(old) = old else {
            if let Some(span) = modifiers.is_override
                && (base.is_some() || self.symbols.pous[owner].decl.objects.extends.is_empty())
                && base.is_none_or(|b| self.find_method(b, &name).is_none())
            {
                let help = "remove OVERRIDE; a method of an interface needs none";
                self.report(Diag::new(Code::NothingToOverride, span, "no base has this method").help(help));
            }
            return;
        };
        let (old_decl, at) = (self.symbols.pous[old].decl, self.symbols.pous[old].decl.name.span);
        if let Some(span) = old_decl.objects.modifiers.is_final {
            self.report(Diag::new(Code::OverridesFinal, decl.name.span, "replaces a FINAL method").also(span, "declared"));
            return;
        }
        let new = decl.name.span;
        let wordless = decl.objects.accessor.is_some() || decl.objects.action;
        if modifiers.is_override.is_none() && !wordless && !self.profile(new).is_vendor() {
            let label = format!("replaces `{}`", self.hir.pous[old].name);
            self.report(
                Diag::new(Code::MissingOverride, new, label)
                    .also(at, "declared")
                    .help("write METHOD OVERRIDE, or choose another name"),
            );
        }
        let (access, old_access) = (self.method_access(id).0, self.method_access(old).0);
        if access != old_access && modifiers.access.is_some() {
            let label = format!("{access:?}, there {old_access:?}").to_uppercase().replace("THERE", "there");
            self.report(Diag::new(Code::SignatureMismatch, new, label).also(at, "declared").help("repeat the access specifier"));
        }
        let life_cycle = ["FB_INIT", "FB_REINIT", "FB_EXIT"].iter().any(|n| decl.name.is(n));
        if !life_cycle || !self.profile(new).is_codesys() {
            self.compare_signatures(id, old);
        }
    }

    /// Methods of interfaces, and abstract methods of bases.
    fn check_promises(&mut self, id: PouId) {
        let mut missing = Vec::new();
        for interface in self.all_interfaces(id) {
            for method in self.objects.own.get(&interface).cloned().unwrap_or_default() {
                self.check_promise(id, method, &mut missing);
            }
        }
        for base in self.line(id).into_iter().skip(1) {
            for method in self.objects.own.get(&base).cloned().unwrap_or_default() {
                if self.is_signature(method) {
                    self.check_promise(id, method, &mut missing);
                }
            }
        }
        let decl = self.symbols.pous[id].decl;
        if missing.is_empty() || self.is_abstract(id) {
            return;
        }
        let list: Vec<String> = missing.iter().map(|m| format!("`{}`", self.hir.pous[*m].name)).collect();
        let at = self.symbols.pous[missing[0]].decl.name.span;
        let label = format!("lacks {}", list.join(", "));
        let help = "add the methods, or make the type ABSTRACT";
        self.report(Diag::new(Code::MissingMethod, decl.name.span, label).also(at, "declared").help(help));
    }

    fn check_promise(&mut self, id: PouId, method: PouId, missing: &mut Vec<PouId>) {
        let decl = self.symbols.pous[method].decl;
        let name = key(&decl.name, decl.objects.accessor);
        let found = self.line(id).into_iter().find_map(|t| self.objects.methods.get(&(t, name.clone())).copied());
        match found.filter(|f| !self.is_signature(*f)) {
            Some(found) => {
                let from_interface = self.hir.pous[method].owner.is_some_and(|o| self.hir.pous[o].kind == PouKind::Interface);
                let own = self.hir.pous[found].owner == Some(id);
                if from_interface && (own || !self.named_by_base(id, method)) {
                    self.compare_signatures(found, method);
                    self.check_public(found, method);
                }
            }
            None => missing.push(method),
        }
    }

    /// True if a base of the type has the interface too, so that the comparison was made there.
    fn named_by_base(&self, id: PouId, method: PouId) -> bool {
        let interface = self.hir.pous[method].owner;
        self.hir.pous[id].base.is_some_and(|b| interface.is_some_and(|i| self.all_interfaces(b).contains(&i)))
    }

    /// Everybody may call a method of an interface.
    fn check_public(&mut self, found: PouId, method: PouId) {
        let decl = self.symbols.pous[found].decl;
        if let Some((AccessSpec::Private | AccessSpec::Protected, span)) = decl.objects.modifiers.access {
            let at = self.symbols.pous[method].decl.name.span;
            let diag = Diag::new(Code::SignatureMismatch, span, "methods of interfaces are PUBLIC");
            self.report(diag.also(at, "declared in the interface").help("write PUBLIC"));
        }
    }
}
