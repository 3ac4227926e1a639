//! Tasks and program instances (§10.1, §10.2). A project without CONFIGURATION runs one instance of each of its programs.

use super::body::{arg_expr, expression_addresses};
use super::builder::Builder;
use super::convert::Operand;
use super::model::*;
use super::symbols::Unit;
use crate::syntax::ast;
use std::collections::HashMap;
use takt_base::{Code, Diag, Nanos, Span};
use takt_image::Elementary;

/// Period of the task that is made up when there is no CONFIGURATION.
pub const DEFAULT_INTERVAL: Nanos = Nanos::from_millis(20);
/// Name of that task.
const DEFAULT_TASK: &str = "Main";
/// Name of the task of programs without a task: it runs when nothing else does.
const BACKGROUND_TASK: &str = "Background";
/// Lowest priority.
const PRIORITY_MAX: i128 = 65_535;
/// Most tasks of a resource.
const TASKS_MAX: usize = 64;

impl<'a> Builder<'a> {
    /// Makes the tasks.
    pub fn configure(&mut self) {
        let resources: Vec<&'a ast::Resource> = self.symbols.configurations.iter().flat_map(|c| &c.resources).collect();
        if self.symbols.configurations.is_empty() {
            self.default_configuration();
            return self.share_programs();
        }
        if let Some(second) = resources.get(1) {
            let name = second.name.as_ref().or_else(|| second.programs.first().map(|p| &p.name));
            if let Some(name) = name {
                self.unsupported(name.span, "a second resource", "put all tasks into one resource");
            }
        }
        if let Some(resource) = resources.first() {
            self.resource(resource);
        }
        self.share_programs();
    }

    fn default_configuration(&mut self) {
        let mine = self.hir.pous.enumerate().filter(|(id, p)| {
            let entry = &self.symbols.pous[*id];
            p.kind == PouKind::Program && !entry.library && entry.decl.test.is_none()
        });
        let mut programs: Vec<_> = mine.map(|(pou, p)| instance(p.name.clone(), pou)).collect();
        let called = self.called_programs();
        if programs.iter().any(|p| !called.contains(&p.pou)) {
            programs.retain(|p| !called.contains(&p.pou));
        }
        programs.iter_mut().for_each(|p| p.init = self.values.remove(&p.root()));
        for program in &programs {
            let at = self.symbols.pous[program.pou].decl.name.span;
            self.check_bound(program.pou, at);
        }
        if !programs.is_empty() {
            let interval = Some(DEFAULT_INTERVAL);
            self.hir.tasks.push(Task { name: DEFAULT_TASK.to_owned(), priority: 0, interval, single: None, programs });
        }
    }

    fn resource(&mut self, resource: &'a ast::Resource) {
        let mut names: HashMap<String, Span> = HashMap::new();
        for decl in &resource.tasks {
            let task = self.task(decl);
            if self.unique(&mut names, &decl.name) {
                self.hir.tasks.push(task);
            }
        }
        self.check_task_count(resource);
        let mut names = HashMap::new();
        for decl in &resource.programs {
            let program = self.program(decl);
            if let (Some(program), true) = (program, self.unique(&mut names, &decl.name)) {
                self.assign_task(decl, program);
            }
        }
    }

    fn check_task_count(&mut self, resource: &ast::Resource) {
        if let Some(task) = resource.tasks.get(TASKS_MAX) {
            let help = format!("a resource has at most {TASKS_MAX} tasks");
            self.report(Diag::new(Code::BadTask, task.name.span, "one task too many").help(help));
        }
    }

    fn unique(&mut self, names: &mut HashMap<String, Span>, name: &ast::Name) -> bool {
        let first = *names.entry(name.key()).or_insert(name.span);
        if first != name.span {
            self.report(Diag::new(Code::DuplicateName, name.span, "declared again").also(first, "first declared"));
        }
        first == name.span
    }

    fn task(&mut self, decl: &ast::TaskDecl) -> Task {
        let interval = decl.interval.as_ref().map_or(Some(Nanos::ZERO), |e| self.interval(e));
        let priority = decl.priority.as_ref().map_or(0, |e| self.priority(e));
        let single = decl.single.as_ref().and_then(|e| self.trigger(e));
        if interval == Some(Nanos::ZERO) && decl.single.is_none() {
            let help = "give it a period, INTERVAL := T#10ms, or a trigger, SINGLE := variable";
            self.report(Diag::new(Code::BadTask, decl.name.span, "nothing ever starts it").help(help));
        }
        let interval = interval.filter(|i| *i > Nanos::ZERO);
        Task { name: decl.name.text.clone(), priority, interval, single, programs: Vec::new() }
    }

    /// The period, zero for none; `None` if it was wrong.
    fn interval(&mut self, e: &ast::Expr) -> Option<Nanos> {
        let time = self.elem(Elementary::Time);
        let ns = self.const_of(e, time)?;
        if ns < 0 {
            self.report(Diag::new(Code::BadTask, e.span, "a negative interval").help("write for example INTERVAL := T#10ms"));
        }
        i64::try_from(ns).ok().filter(|ns| *ns >= 0).map(Nanos)
    }

    fn priority(&mut self, e: &ast::Expr) -> u32 {
        let Some(value) = self.const_int(e) else { return 0 };
        if !(0..=PRIORITY_MAX).contains(&value) {
            let help = format!("priorities are 0 (highest) to {PRIORITY_MAX}");
            self.report(Diag::new(Code::BadTask, e.span, value.to_string()).help(help));
            return 0;
        }
        value as u32
    }

    /// SINGLE: a BOOL that is a global or a direct address.
    fn trigger(&mut self, e: &ast::Expr) -> Option<Place> {
        let bool = self.bool();
        let place = self.place(e)?.place;
        if place.ty != bool || !place.path.is_empty() {
            let label = format!("{}, a BOOL global or address wanted", self.show(place.ty));
            self.report(Diag::new(Code::BadTask, e.span, label).help("a rising edge of this variable starts the task"));
            return None;
        }
        Some(place)
    }

    fn program(&mut self, decl: &'a ast::ProgramDecl) -> Option<ProgramInstance> {
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
        let mut program = instance(decl.name.text.clone(), pou);
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
                    let value = self.value(value, ty);
                    program.inputs.push((var, value));
                }
            }
            ast::Arg::Output { name, negated: false, target: Some(target) } => {
                let Some((var, ty)) = self.connected(program.pou, name, &[Role::Output]) else { return };
                let Some(place) = self.writable(target) else { return };
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

    fn connected(&mut self, pou: PouId, name: &ast::Name, roles: &[Role]) -> Option<(VarId, takt_image::TypeId)> {
        let vars = &self.hir.pous[pou].vars;
        let found = vars.enumerate().find(|(_, v)| name.is(&v.name) && roles.contains(&v.role)).map(|(id, v)| (id, v.ty));
        if found.is_none() {
            let known = vars.iter().filter(|v| roles.contains(&v.role)).map(|v| v.name.clone()).collect();
            self.unknown(Code::UnknownParameter, name, known);
        }
        found
    }

    fn assign_task(&mut self, decl: &ast::ProgramDecl, program: ProgramInstance) {
        let Some(name) = &decl.task else { return self.background(program) };
        match self.hir.tasks.iter_mut().find(|t| name.is(&t.name)) {
            Some(task) => task.programs.push(program),
            None => {
                let known: Vec<_> = self.hir.tasks.iter().map(|t| t.name.clone()).collect();
                let diag = Diag::new(Code::UnknownTask, name.span, "not declared");
                self.report(match takt_base::nearest(&name.text, known.iter().map(String::as_str)) {
                    Some(near) => diag.help(format!("did you mean `{near}`?")),
                    None => diag.help("declare it: TASK name (INTERVAL := T#10ms, PRIORITY := 1);"),
                });
            }
        }
    }

    fn background(&mut self, program: ProgramInstance) {
        let found = self.hir.tasks.iter().position(|t| t.name == BACKGROUND_TASK);
        let at = found.unwrap_or_else(|| {
            let priority = u32::MAX;
            let task = Task { name: BACKGROUND_TASK.to_owned(), priority, interval: None, single: None, programs: Vec::new() };
            self.hir.tasks.push(task);
            self.hir.tasks.len() - 1
        });
        self.hir.tasks[at].programs.push(program);
    }
}

pub(super) fn instance(name: String, pou: PouId) -> ProgramInstance {
    ProgramInstance {
        name,
        pou,
        resource: 0,
        global: None,
        keep: Keep::Unsaid,
        init: None,
        inputs: Vec::new(),
        outputs: Vec::new(),
    }
}

/// Reports every direct address in a configuration.
pub(super) fn addresses<'t>(c: &'t ast::Configuration, on: &mut dyn FnMut(&'t ast::Address)) {
    for r in &c.resources {
        let singles = r.tasks.iter().filter_map(|t| t.single.as_ref());
        let connected = r.programs.iter().flat_map(|p| &p.connections).filter_map(arg_expr);
        expression_addresses(singles.chain(connected).collect(), on);
    }
}
