//! VAR_ACCESS: names for variables that others see (§3.8). Each becomes a symbol of the image, with its direction.

use super::builder::Builder;
use super::image::{Owner, name_of, size_type};
use super::instance::{Found, Last};
use super::model::*;
use crate::syntax::ast::{self, PathPart};
use std::collections::HashMap;
use takt_base::{Code, Diag, Span};
use takt_image::image::Place as ImagePlace;
use takt_image::{Elementary, TypeId};

impl<'a> Builder<'a> {
    /// All access paths. Runs when every address has its place and the programs are connected.
    pub(super) fn access_paths(&mut self) {
        let mut names = HashMap::new();
        for decl in self.symbols.configurations.clone().into_iter().flat_map(|c| &c.access) {
            let fresh = self.unique(&mut names, &decl.name) && self.is_free(&decl.name);
            if let (Some((spot, ty)), true) = (self.access_path(decl, None), fresh) {
                let (name, writable) = (decl.name.text.clone(), decl.writable);
                self.hir.accesses.push(AccessPath { name, spot, ty, writable });
            }
        }
        for pou in self.hir.pous.indices() {
            self.unit_paths(pou);
        }
    }

    /// Globals and programs have paths of their own.
    fn is_free(&mut self, name: &ast::Name) -> bool {
        let program = self.planned.iter().find(|p| name.is(&p.name)).map(|p| self.symbols.pous[p.pou].decl.name.span);
        let taken = self.symbols.globals.get(&name.key()).map(|g| self.hir.globals[*g].span).or(program);
        if let Some(span) = taken {
            self.report(Diag::new(Code::DuplicateName, name.span, "has this path already").also(span, "declared"));
        }
        taken.is_none()
    }

    /// VAR_ACCESS of a program: a path for each of its instances.
    fn unit_paths(&mut self, pou: PouId) {
        let decl = self.symbols.pous[pou].decl;
        if let Some(first) = decl.paths.first().filter(|_| self.hir.pous[pou].kind != PouKind::Program) {
            let help = "VAR_ACCESS stands in a CONFIGURATION or a PROGRAM";
            return self.report(Diag::new(Code::SectionNotAllowed, first.name.span, "an access path").help(help));
        }
        let mut names = HashMap::new();
        for path in &decl.paths {
            let own = self.hir.pous[pou].vars.iter().find(|v| path.name.is(&v.name)).map(|v| v.span);
            if let Some(span) = own {
                self.report(Diag::new(Code::DuplicateName, path.name.span, "a variable has it").also(span, "declared"));
            }
            let fresh = self.unique(&mut names, &path.name) && own.is_none();
            if let (Some((spot, ty)), true) = (self.access_path(path, Some(pou)), fresh) {
                self.for_instances(pou, path, &spot, ty);
            }
        }
    }

    fn for_instances(&mut self, pou: PouId, decl: &ast::AccessDecl, spot: &Spot, ty: TypeId) {
        for program in self.planned.iter().filter(|p| p.pou == pou) {
            let root = Root::Program(program.resource, program.name.to_ascii_uppercase());
            let spot = match spot {
                Spot::Part(_, offset) => Spot::Part(root, *offset),
                image => image.clone(),
            };
            let name = format!("{}.{}", self.hir.path(Some(program.resource), &program.name), decl.name.text);
            self.hir.accesses.push(AccessPath { name, spot, ty, writable: decl.writable });
        }
    }

    /// Place and type of what a path names; reports what is wrong with it.
    fn access_path(&mut self, decl: &ast::AccessDecl, within: Option<PouId>) -> Option<(Spot, TypeId)> {
        let used = self.type_ref(&decl.ty);
        let (resource, parts) = match within {
            None => self.leading_resource(&decl.path.parts),
            Some(_) => (None, decl.path.parts.as_slice()),
        };
        if let [PathPart::Direct(a)] = parts {
            return self.access_address(a, used.ty, decl);
        }
        let found = match within {
            None => self.variable_path(resource, parts, decl.path.span)?,
            Some(pou) => self.path_within(pou, within_unit(), parts)?,
        };
        if used.ty == self.error || found.ty == self.error {
            return None;
        }
        if used.ty != found.ty {
            let label = format!("{}, declared {}", self.show(used.ty), self.show(found.ty));
            let diag = Diag::new(Code::InstanceMismatch, decl.ty.span, label).also(found.declared, "declared");
            self.report(diag.help("repeat the type of the declaration"));
            return None;
        }
        if decl.writable && !self.may_be_written(&found, decl.path.span) {
            return None;
        }
        Some((self.spot(&found, decl.path.span)?, found.ty))
    }

    fn access_address(&mut self, a: &ast::Address, ty: TypeId, decl: &ast::AccessDecl) -> Option<(Spot, TypeId)> {
        let Base::Image(place) = self.direct(a)?.place.base else { return None };
        let wanted = size_type(a.size);
        if ty == self.error {
            return None;
        }
        if self.hir.types.storage(ty).map(Elementary::bits) != Some(wanted.bits()) {
            let label = format!("{} at {}", self.show(ty), name_of(a).text);
            let help = format!("an address of this size takes {} bit", wanted.bits());
            self.report(Diag::new(Code::InstanceMismatch, decl.ty.span, label).help(help));
            return None;
        }
        if decl.writable && a.area == ast::Area::Input {
            self.not_writable(a.span, "%I is read anew before each scan");
            return None;
        }
        Some((Spot::Image(place), ty))
    }

    /// Not a CONSTANT, not in %I, not an input that is connected.
    fn may_be_written(&mut self, found: &Found, span: Span) -> bool {
        let owner = match found.last {
            Last::Global(id) => Some(Owner::Global(id)),
            Last::Var(pou, var) => Some(Owner::Var(pou, var)),
            Last::Program | Last::Part => None,
        };
        let why = match () {
            () if self.is_constant(found.last) || self.is_in_constant(found) => "a CONSTANT",
            () if owner.is_some_and(|o| self.is_input(o)) => "%I is read anew before each scan",
            () if self.is_connected(found) => "its resource connects it",
            () => return true,
        };
        self.not_writable(span, why);
        false
    }

    fn not_writable(&mut self, span: Span, why: &str) {
        self.report(Diag::new(Code::AccessDirection, span, why).help("declare the path READ_ONLY"));
    }

    fn is_input(&self, owner: Owner) -> bool {
        let area = match owner {
            Owner::Global(id) => self.image.area_of_global(id),
            Owner::Var(pou, var) => self.image.area_of_var(pou, var),
        };
        area.or(self.image.open_area(owner)) == Some(ast::Area::Input)
    }

    fn is_in_constant(&self, found: &Found) -> bool {
        matches!(found.root, Root::Global(id) if self.hir.globals[id].constant)
    }

    fn is_connected(&self, found: &Found) -> bool {
        let Last::Var(pou, var) = found.last else { return false };
        let this = |p: &&ProgramInstance| p.root() == found.root || found.root == within_unit() && p.pou == pou;
        let mut programs = self.hir.tasks.iter().flat_map(|t| &t.programs).filter(this);
        found.steps.len() == 1 && programs.any(|p| p.inputs.iter().any(|(connected, _)| *connected == var))
    }

    /// Where a variable lies.
    pub(super) fn spot(&mut self, found: &Found, span: Span) -> Option<Spot> {
        if found.is_bit {
            self.unsupported(span, "a bit of a structure by a path", "name the whole structure");
            return None;
        }
        let Some((pou, var)) = found.located else { return Some(Spot::Part(found.root.clone(), found.offset)) };
        match self.hir.pous[pou].vars[var].storage {
            Storage::Image(ImagePlace::Byte(start)) => Some(Spot::Image(ImagePlace::Byte(start + found.offset))),
            Storage::Image(bit) => Some(Spot::Image(bit)),
            Storage::Field(_) | Storage::Local => None,
        }
    }
}

/// Stands for the instance of a path that begins in a unit.
fn within_unit() -> Root {
    Root::Program(0, String::new())
}

/// Reports every direct address of the paths.
pub(super) fn addresses<'t>(list: &'t [ast::AccessDecl], on: &mut dyn FnMut(&'t ast::Address)) {
    for part in list.iter().flat_map(|d| &d.path.parts) {
        if let PathPart::Direct(a) = part {
            on(a);
        }
    }
}
