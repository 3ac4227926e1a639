//! Program instances of a resource: their type, their connections, and the function blocks with a task of their own (§10.1, §10.2).

use super::body::arg_expr;
use super::builder::Builder;
use super::config::instance;
use super::convert::Operand;
use super::model::*;
use super::place::Target;
use super::symbols::Unit;
use crate::syntax::ast;
use std::collections::HashMap;
use takt_base::{Code, Diag, Span};
use takt_image::types::Type;
use takt_image::{Elementary, TypeId};

impl<'a> Builder<'a> {
    pub(super) fn program(&mut self, decl: &'a ast::ProgramDecl, resource: u32) -> Option<ProgramInstance> {
        self.check_unit_use(&decl.ty);
        let pou = match self.unit(&decl.ty) {
            Some((Unit::Pou(id), _)) if self.hir.pous[id].kind == PouKind::Program => id,
            Some(_) => {
                let diag = Diag::new(Code::UnknownType, decl.ty.span, "not a PROGRAM").message("a task runs programs");
                self.report(diag.help("wrap it: declare an instance in a PROGRAM and call it there"));
                return None;
            }
            None => {
                let known = self.hir.pous.iter().filter(|p| p.kind == PouKind::Program).map(|p| p.name.clone()).collect();
                self.unknown(Code::UnknownType, &decl.ty, known);
                return None;
            }
        };
        self.check_bound(pou, decl.name.span);
        let unit = self.symbols.pous[pou].decl;
        if unit.test.is_some() {
            let diag = Diag::new(Code::TestInConfiguration, decl.ty.span, "a unit test").also(unit.name.span, "declared");
            self.report(diag.help("tests are run by `takt test`, not by tasks"));
            return None;
        }
        let mut program = ProgramInstance { resource, ..instance(decl.name.text.clone(), pou) };
        program.keep = match decl.retain {
            Some(true) => Keep::Retain,
            Some(false) => Keep::NonRetain,
            None => Keep::Unsaid,
        };
        program.init = self.values.remove(&program.root());
        for arg in &decl.connections {
            self.connect(&mut program, arg, decl.name.span);
        }
        Some(program)
    }

    /// A task binds nothing to a VAR_IN_OUT (§4.7).
    pub(super) fn check_bound(&mut self, pou: PouId, at: Span) {
        let unbound = self.hir.pous[pou].vars.iter().find(|v| v.role == Role::InOut);
        if let Some(var) = unbound {
            let (label, declared) = (format!("a task can't bind `{}`", var.name), var.span);
            let help = "use VAR_EXTERNAL, or VAR_INPUT and VAR_OUTPUT";
            self.report(Diag::new(Code::MissingInOut, at, label).also(declared, "declared").help(help));
        }
    }

    /// `in := global`, `out => global`.
    fn connect(&mut self, program: &mut ProgramInstance, arg: &ast::Arg, at: Span) {
        match arg {
            ast::Arg::Input { name, value: Some(value) } => {
                if let Some((var, ty)) = self.connected(program.pou, name, &[Role::Input]) {
                    let direct = self.direct_as(value, ty);
                    let value = match direct {
                        Some(target) => Expr { kind: ExprKind::Load(target.place), ty, span: value.span },
                        None => self.value(value, ty),
                    };
                    program.inputs.push((var, value));
                }
            }
            ast::Arg::Output { name, negated: false, target: Some(target) } => {
                let Some((var, ty)) = self.connected(program.pou, name, &[Role::Output]) else { return };
                let Some(mut place) = self.writable(target) else { return };
                if let Some(direct) = self.direct_as(target, ty) {
                    place = direct.place;
                }
                let from = Expr { kind: ExprKind::Load(place.clone()), ty, span: target.span };
                if self.fit(Operand::fixed(from), place.ty).ty != self.error {
                    program.outputs.push((var, place));
                }
            }
            ast::Arg::Input { name, .. } | ast::Arg::Output { name, .. } => {
                self.unsupported(name.span, "this connection", "write `input := value` or `output => variable`");
            }
            ast::Arg::Positional(e) => {
                self.report(
                    Diag::new(Code::UnknownParameter, e.span, "no name").also(at, "program").help("write `name := value`"),
                );
            }
        }
    }

    /// A direct address as a variable of a type that has its width.
    fn direct_as(&mut self, e: &ast::Expr, ty: TypeId) -> Option<Target> {
        let ast::ExprKind::Direct(a) = &e.kind else { return None };
        let bits = super::image::size_type(a.size).bits();
        if self.hir.types.storage(ty).map(Elementary::bits) != Some(bits) {
            return None;
        }
        let mut target = self.direct(a)?;
        target.place.ty = ty;
        Some(target)
    }

    fn connected(&mut self, pou: PouId, name: &ast::Name, roles: &[Role]) -> Option<(VarId, TypeId)> {
        let vars = &self.hir.pous[pou].vars;
        let found = vars.enumerate().find(|(_, v)| name.is(&v.name) && roles.contains(&v.role)).map(|(id, v)| (id, v.ty));
        if found.is_none() {
            let known = vars.iter().filter(|v| roles.contains(&v.role)).map(|v| v.name.clone()).collect();
            self.unknown(Code::UnknownParameter, name, known);
        }
        found
    }

    /// `fb WITH task`: the body of `fb` runs in that task alone.
    pub(super) fn bind_blocks(&mut self, decl: &ast::ProgramDecl, program: &ProgramInstance) {
        let mut names = HashMap::new();
        for (block, task) in &decl.blocks {
            let bound = self.bound_block(block, program);
            let task = self.task_of(task, program.resource);
            if let (Some(bound), Some(task), true) = (bound, task, self.unique(&mut names, block)) {
                self.hir.tasks[task].blocks.push(bound);
            }
        }
    }

    fn bound_block(&mut self, name: &ast::Name, program: &ProgramInstance) -> Option<BoundBlock> {
        let Some((_, var)) = self.hir.pous[program.pou].vars.enumerate().find(|(_, v)| name.is(&v.name)) else {
            let blocks = self.hir.pous[program.pou].vars.iter().filter(|v| v.role == Role::Local);
            let known = blocks.map(|v| v.name.clone()).collect();
            self.unknown(Code::UnknownParameter, name, known);
            return None;
        };
        let (ty, storage, role, declared, spelt) = (var.ty, var.storage, var.role, var.span, var.name.clone());
        let block = self.unit_of(ty).filter(|p| self.hir.pous[*p].kind == PouKind::FunctionBlock && role == Role::Local);
        let (Some(pou), Storage::Field(field), Some(whole)) = (block, storage, self.hir.pous[program.pou].instance) else {
            let label = format!("{}, a function block in VAR wanted", self.show(ty));
            let diag = Diag::new(Code::BadBinding, name.span, label).also(declared, "declared");
            self.report(diag.help("give the task to the program, or put the statements into a function block"));
            return None;
        };
        self.check_bound(pou, name.span);
        let offset = match self.ty(whole) {
            Type::Instance(r) => r.fields.get(field as usize)?.offset,
            _ => return None,
        };
        Some(BoundBlock { name: format!("{}.{spelt}", program.name), pou, program: program.root(), offset })
    }
}

/// Expressions of the connections, for the addresses in them.
pub(super) fn expressions(r: &ast::Resource) -> impl Iterator<Item = &ast::Expr> {
    r.programs.iter().flat_map(|p| &p.connections).filter_map(arg_expr)
}
