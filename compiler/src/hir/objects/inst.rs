//! VAR_INST (vendor, §3.1): variables of a method that last, one for each instance. They are hidden fields of the instance.

use super::key;
use crate::hir::builder::Builder;
use crate::hir::late::Owner;
use crate::hir::model::*;
use crate::hir::scope::{Local, ReadOnly};
use crate::hir::types::TypeUse;
use crate::syntax::ast::{self, SectionKind};
use takt_base::{Code, Diag};

impl Builder<'_> {
    /// Makes the fields for all methods of a type.
    pub(in crate::hir) fn add_instance_variables(&mut self, id: PouId, decl: &ast::Pou) {
        for method in &decl.objects.methods {
            let name = key(&method.name, method.objects.accessor);
            for section in method.sections.iter().filter(|s| s.kind == SectionKind::Inst) {
                for d in &section.decls {
                    self.add_instance_variable(id, &name, section, d);
                }
            }
        }
    }

    fn add_instance_variable(&mut self, id: PouId, method: &str, section: &ast::VarSection, d: &ast::VarDecl) {
        let used = self.type_ref(&d.ty);
        self.check_constant_instance(section.constant, used.ty, d.ty.span);
        for name in &d.names {
            let shown = ast::Name { text: format!("{method}.{}", name.text), span: name.span };
            let owner = Owner::Var(id, crate::hir::declare::next(&self.hir.pous[id].vars));
            let init = self.declared_value(d, &used, !section.constant, &[owner]);
            let TypeUse { ty, .. } = used;
            let var = self.push_var(id, &shown, ty, Role::Hidden, Storage::Local, init);
            let keep = Keep::of(section);
            self.hir.pous[id].vars[var].keep = keep;
            if self.startup.late.contains_key(&owner) {
                let mark = self.add_mark(id, &shown, keep);
                self.startup.marks.insert(owner, Owner::Var(id, mark));
            }
            self.objects.instance_vars.insert((id, method.to_owned(), name.key()), var);
        }
    }

    /// Makes the fields known to the method that declares them.
    pub(in crate::hir) fn declare_instance_variables(&mut self, id: PouId, decl: &ast::Pou, section: &ast::VarSection) {
        let Some(owner) = self.hir.pous[id].owner else {
            let diag = Diag::new(Code::SectionNotAllowed, section.span, "VAR_INST outside of a method");
            return self.report(diag.help("write VAR in a function block or program, VAR_STAT in a function"));
        };
        let method = key(&decl.name, decl.objects.accessor);
        for name in section.decls.iter().flat_map(|d| &d.names) {
            let Some(var) = self.objects.instance_vars.get(&(owner, method.clone(), name.key())).copied() else { continue };
            if self.declare_local(name, Local::Member(var)) && section.constant {
                self.scope.fixed_members.insert(var, ReadOnly::Constant);
            }
        }
    }
}
