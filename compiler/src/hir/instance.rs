//! Instance paths of VAR_CONFIG and VAR_ACCESS: `Res.Prog.block[2].x` (§3.7, §3.8). The name of the resource may be left out.

use super::builder::Builder;
use super::model::*;
use super::scope::{Local, ReadOnly};
use super::symbols::Unit;
use crate::syntax::ast::{self, PathPart};
use takt_base::{Code, Diag, Span};
use takt_image::types::Type;
use takt_image::{TypeId, types::Dim};

/// A program instance of some resource.
pub(super) struct Planned {
    pub resource: u32,
    pub name: String,
    pub pou: PouId,
}

/// What stands at the end of a path.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Last {
    Program,
    Global(GlobalId),
    Var(PouId, VarId),
    /// A member of a structure or an element of an array.
    Part,
}

/// A variable of an instance.
#[derive(Clone, Debug)]
pub(super) struct Found {
    pub root: Root,
    /// Numbers of fields and elements from the root on.
    pub steps: Vec<u32>,
    /// Bytes behind the start of the root.
    pub offset: u32,
    pub ty: TypeId,
    pub last: Last,
    /// Where it is declared.
    pub declared: Span,
    /// The variable of a program that is located, or that this is a part of; `offset` counts from its start then.
    pub located: Option<(PouId, VarId)>,
    /// One bit of a byte.
    pub is_bit: bool,
}

impl Found {
    fn new(root: Root, ty: TypeId, last: Last, declared: Span) -> Self {
        Self { root, steps: Vec::new(), offset: 0, ty, last, declared, located: None, is_bit: false }
    }
}

impl<'a> Builder<'a> {
    /// Finds the program instances of all resources.
    pub fn plan_programs(&mut self) {
        if self.symbols.configurations.is_empty() {
            let mine = self.hir.pous.enumerate().filter(|(id, p)| p.kind == PouKind::Program && !self.symbols.pous[*id].library);
            self.planned = mine.map(|(pou, p)| Planned { resource: 0, name: p.name.clone(), pou }).collect();
            return;
        }
        for (resource, r) in (0..).zip(self.resources()) {
            for decl in &r.programs {
                if let Some(&(Unit::Pou(pou), _)) = self.symbols.units.get(&decl.ty.key())
                    && self.hir.pous[pou].kind == PouKind::Program
                {
                    self.planned.push(Planned { resource, name: decl.name.text.clone(), pou });
                }
            }
        }
    }

    /// What a path names; reports a path that leads nowhere.
    pub fn instance_path(&mut self, path: &ast::InstancePath) -> Option<Found> {
        let (resource, parts) = self.leading_resource(&path.parts);
        self.variable_path(resource, parts, path.span)
    }

    /// The same for the part behind the name of a resource.
    pub fn variable_path(&mut self, resource: Option<u32>, parts: &[PathPart], span: Span) -> Option<Found> {
        let Some((PathPart::Name(first), rest)) = parts.split_first() else {
            let help = "write Resource.Program.variable";
            self.report(Diag::new(Code::UnknownInstance, span, "no variable of an instance").help(help));
            return None;
        };
        let mut found = self.path_root(resource, first)?;
        for part in rest {
            found = self.path_step(found, part)?;
        }
        Some(found)
    }

    /// What a path names that begins in a unit: its instance lies at the root.
    pub fn path_within(&mut self, pou: PouId, root: Root, parts: &[PathPart]) -> Option<Found> {
        let (ty, declared) = (self.hir.pous[pou].instance?, self.symbols.pous[pou].decl.name.span);
        let mut found = Found::new(root, ty, Last::Program, declared);
        for part in parts {
            found = self.path_step(found, part)?;
        }
        Some(found)
    }

    /// The resource that a path begins with, and the rest.
    pub fn leading_resource<'p>(&self, parts: &'p [PathPart]) -> (Option<u32>, &'p [PathPart]) {
        if let [PathPart::Name(first), rest @ ..] = parts
            && !rest.is_empty()
            && let Some(at) = self.resources().iter().position(|r| r.name.as_ref().is_some_and(|n| n.is(&first.text)))
        {
            return (Some(at as u32), rest);
        }
        (None, parts)
    }

    fn path_root(&mut self, resource: Option<u32>, name: &ast::Name) -> Option<Found> {
        let fits = |p: &&Planned| name.is(&p.name) && resource.is_none_or(|r| r == p.resource);
        let mut programs = self.planned.iter().filter(fits);
        if let Some(program) = programs.next() {
            let (root, pou) = (Root::Program(program.resource, name.key()), program.pou);
            if programs.next().is_some() {
                let help = "write the name of the resource in front";
                self.report(Diag::new(Code::UnknownInstance, name.span, "several resources have it").help(help));
                return None;
            }
            let (ty, declared) = (self.hir.pous[pou].instance?, self.symbols.pous[pou].decl.name.span);
            return Some(Found::new(root, ty, Last::Program, declared));
        }
        let Some(id) = self.global_of_path(resource, name)? else {
            let programs = self.planned.iter().map(|p| p.name.clone());
            let known = programs.chain(self.hir.globals.iter().map(|g| g.name.clone())).collect();
            self.unknown(Code::UnknownInstance, name, known);
            return None;
        };
        let g = &self.hir.globals[id];
        let (root, declared) = (Root::Global(id), g.span);
        Some(Found::new(root, g.ty, Last::Global(id), declared))
    }

    /// The global that a path begins with; `None`: several resources have it, which is reported.
    fn global_of_path(&mut self, resource: Option<u32>, name: &ast::Name) -> Option<Option<GlobalId>> {
        let key = name.key();
        if let Some(resource) = resource {
            return Some(self.visible(resource, &key));
        }
        let list = self.candidates(&key);
        match list.iter().find(|g| self.hir.globals[**g].resource.is_none()).or(list.first()) {
            Some(&id) if list.len() > 1 && self.hir.globals[id].resource.is_some() => {
                let help = "write the name of the resource in front";
                self.report(Diag::new(Code::UnknownInstance, name.span, "several resources have it").help(help));
                None
            }
            found => Some(found.copied()),
        }
    }

    fn path_step(&mut self, found: Found, part: &PathPart) -> Option<Found> {
        if found.ty == self.error {
            return None;
        }
        match (part, self.ty(found.ty)) {
            (PathPart::Name(name), Type::Instance(_)) => self.variable_of(found, name),
            (PathPart::Name(name), Type::Struct(_)) => self.member_of(found, name),
            (PathPart::Index(list, span), Type::Array { element, dims }) => {
                let (element, dims) = (*element, dims.clone());
                let flat = self.element_number(list, &dims, *span)?;
                let size = self.hir.types.layout(element).size;
                Some(follow(found, flat, flat.saturating_mul(size), element, Last::Part, None))
            }
            (PathPart::Name(ast::Name { span, .. }) | PathPart::Index(_, span), _) => {
                let label = format!("{} has no such part", self.show(found.ty));
                self.error(Code::UnknownInstance, *span, label);
                None
            }
            (PathPart::Direct(a), _) => {
                self.error(Code::UnknownInstance, a.span, "an address is no part of a variable");
                None
            }
        }
    }

    /// The unit of an instance type.
    pub fn unit_of(&self, ty: TypeId) -> Option<PouId> {
        self.objects.types.get(&ty).copied().filter(|id| self.hir.pous[*id].instance == Some(ty))
    }

    fn variable_of(&mut self, found: Found, name: &ast::Name) -> Option<Found> {
        let pou = self.unit_of(found.ty)?;
        let vars = &self.hir.pous[pou].vars;
        let shown = |v: &Var| v.role != Role::Hidden;
        let Some((id, var)) = vars.enumerate().find(|(_, v)| shown(v) && name.is(&v.name)) else {
            if let Some((Local::External(_), _)) = self.symbols.pous[pou].scope.names.get(&name.key()) {
                self.not_configurable(name.span, "a VAR_EXTERNAL", "name the global itself");
                return None;
            }
            let known = vars.iter().filter(|v| shown(v)).map(|v| v.name.clone()).collect();
            self.unknown(Code::UnknownInstance, name, known);
            return None;
        };
        let (ty, declared, storage) = (var.ty, var.span, var.storage);
        match var.role {
            Role::InOut => {
                self.not_configurable(name.span, "a VAR_IN_OUT", "it has no value of its own");
                None
            }
            Role::Temp | Role::Result => {
                self.not_configurable(name.span, "a VAR_TEMP", "it lives only while its unit runs");
                None
            }
            _ => {
                let (number, offset) = match storage {
                    Storage::Field(i) => (i, crate::hir::instance::field_offset(self.ty(found.ty), i)?),
                    _ => (u32::MAX, 0),
                };
                let located = found.located.or((number == u32::MAX).then_some((pou, id)));
                Some(Found { located, ..follow(found, number, offset, ty, Last::Var(pou, id), Some(declared)) })
            }
        }
    }

    fn member_of(&mut self, found: Found, name: &ast::Name) -> Option<Found> {
        let Type::Struct(record) = self.ty(found.ty) else { return None };
        match (0..).zip(&record.fields).find(|(_, f)| name.is(&f.name)) {
            Some((i, f)) => {
                let (offset, ty, is_bit) = (f.offset, f.ty, self.bit_members.contains_key(&(found.ty, i)));
                Some(Found { is_bit, ..follow(found, i, offset, ty, Last::Part, None) })
            }
            None => {
                let known = record.fields.iter().map(|f| f.name.clone()).collect();
                self.unknown(Code::UnknownInstance, name, known);
                None
            }
        }
    }

    fn element_number(&mut self, list: &[ast::Expr], dims: &[Dim], span: Span) -> Option<u32> {
        if list.len() != dims.len() {
            let label = format!("{} subscripts, {} wanted", list.len(), dims.len());
            self.error(Code::UnknownInstance, span, label);
            return None;
        }
        let mut flat = 0u32;
        for (e, dim) in list.iter().zip(dims) {
            let i = self.const_int(e)?;
            let Some(n) = u32::try_from(i - i128::from(dim.low)).ok().filter(|n| *n < dim.len()) else {
                self.error(Code::UnknownInstance, e.span, format!("{i} is outside of {}..{}", dim.low, dim.high));
                return None;
            };
            flat = flat.saturating_mul(dim.len()).saturating_add(n);
        }
        Some(flat)
    }

    pub fn not_configurable(&mut self, span: Span, what: &str, help: &str) {
        self.report(Diag::new(Code::NotConfigurable, span, what).help(help));
    }

    /// True for a variable that is declared CONSTANT.
    pub fn is_constant(&self, last: Last) -> bool {
        match last {
            Last::Global(id) => self.hir.globals[id].constant,
            Last::Var(pou, id) => self.symbols.pous[pou].scope.read_only.get(&id) == Some(&ReadOnly::Constant),
            Last::Program | Last::Part => false,
        }
    }
}

/// Offset of a field of a record.
pub(super) fn field_offset(ty: &Type, field: u32) -> Option<u32> {
    match ty {
        Type::Struct(r) | Type::Instance(r) => r.fields.get(field as usize).map(|f| f.offset),
        _ => None,
    }
}

fn follow(mut found: Found, number: u32, offset: u32, ty: TypeId, last: Last, declared: Option<Span>) -> Found {
    found.steps.push(number);
    found.offset = found.offset.saturating_add(offset);
    Found { ty, last, declared: declared.unwrap_or(found.declared), ..found }
}
