//! Tasks and program instances (§10.1, §10.2). A project without CONFIGURATION runs one instance of each of its programs.

use super::body::expression_addresses;
use super::builder::Builder;
use super::instance::Found;
use super::model::*;
use crate::syntax::ast;
use std::collections::HashMap;
use takt_base::{Code, Diag, Nanos, Span};
use takt_image::Elementary;
use takt_image::validate::MAX_TASKS;

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
        if self.symbols.configurations.is_empty() {
            self.default_configuration();
        }
        for (resource, number) in self.resources().into_iter().zip(0..) {
            self.scope.resource = Some(number);
            self.resource(resource, number);
            self.scope.resource = None;
        }
        self.check_all_tasks();
        self.share_programs();
        self.access_paths();
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
            self.hir.tasks.push(Task { interval, programs, ..new_task(DEFAULT_TASK, 0, 0) });
        }
    }

    fn resource(&mut self, resource: &'a ast::Resource, number: u32) {
        let first = self.hir.tasks.len();
        let mut names: HashMap<String, Span> = HashMap::new();
        for decl in &resource.tasks {
            let task = self.task(decl, number);
            if self.unique(&mut names, &decl.name) {
                self.hir.tasks.push(task);
            }
        }
        self.check_task_count(resource);
        let mut names = HashMap::new();
        for decl in &resource.programs {
            let program = self.program(decl, number);
            if let (Some(program), true) = (program, self.unique(&mut names, &decl.name)) {
                self.bind_blocks(decl, &program);
                self.assign_task(decl, program);
            }
        }
        // A trigger may be an output of a program, which had to be there first.
        let triggers: Vec<_> = resource.tasks.iter().map(|t| t.single.as_ref().and_then(|e| self.trigger(e, number))).collect();
        for (decl, single) in resource.tasks.iter().zip(triggers) {
            if let Some(task) = self.hir.tasks[first..].iter_mut().find(|t| decl.name.is(&t.name)) {
                task.single = task.single.take().or(single);
            }
        }
    }

    /// All resources share one scheduler.
    fn check_all_tasks(&mut self) {
        let last = self.resources().into_iter().rev().flat_map(|r| r.tasks.last()).next();
        if let Some(task) = last.filter(|_| self.hir.tasks.len() > MAX_TASKS) {
            let help = format!("all resources together have at most {MAX_TASKS} tasks");
            self.report(Diag::new(Code::BadTask, task.name.span, "too many tasks").help(help));
        }
    }

    fn check_task_count(&mut self, resource: &ast::Resource) {
        if let Some(task) = resource.tasks.get(TASKS_MAX) {
            let help = format!("a resource has at most {TASKS_MAX} tasks");
            self.report(Diag::new(Code::BadTask, task.name.span, "one task too many").help(help));
        }
    }

    pub(super) fn unique(&mut self, names: &mut HashMap<String, Span>, name: &ast::Name) -> bool {
        let first = *names.entry(name.key()).or_insert(name.span);
        if first != name.span {
            self.report(Diag::new(Code::DuplicateName, name.span, "declared again").also(first, "first declared"));
        }
        first == name.span
    }

    fn task(&mut self, decl: &ast::TaskDecl, resource: u32) -> Task {
        let interval = decl.interval.as_ref().map_or(Some(Nanos::ZERO), |e| self.interval(e));
        let priority = decl.priority.as_ref().map_or(0, |e| self.priority(e));
        if interval == Some(Nanos::ZERO) && decl.single.as_ref().is_none_or(|e| fixed_level(e) == Some(false)) {
            let help = "give it a period, INTERVAL := T#10ms, or a trigger, SINGLE := variable";
            self.report(Diag::new(Code::BadTask, decl.name.span, "nothing ever starts it").help(help));
        }
        let interval = interval.filter(|i| *i > Nanos::ZERO);
        Task { interval, ..new_task(&decl.name.text, priority, resource) }
    }

    /// The period, zero for none; `None` if it was wrong. It is fixed before anything runs.
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

    /// SINGLE: a BOOL that is a global, a direct address or a variable of a program.
    fn trigger(&mut self, e: &ast::Expr, resource: u32) -> Option<Spot> {
        let bool = self.bool();
        let help = "a rising edge of this variable starts the task";
        if let Some(level) = fixed_level(e) {
            if level {
                self.report(Diag::new(Code::BadTask, e.span, "never rises").help("name a variable, or leave SINGLE out"));
            }
            return None;
        }
        if let Some(found) = self.program_variable(e, resource) {
            let found = found?;
            if found.ty != bool {
                let label = format!("{}, a BOOL wanted", self.show(found.ty));
                self.report(Diag::new(Code::BadTask, e.span, label).help(help));
                return None;
            }
            return self.spot(&found, e.span);
        }
        let place = self.place(e)?.place;
        match place.base {
            Base::Global(id) if place.ty == bool && place.path.is_empty() => Some(Spot::Part(Root::Global(id), 0)),
            Base::Image(at) if place.ty == bool => Some(Spot::Image(at)),
            _ => {
                let label = format!("{}, a BOOL global, output or address wanted", self.show(place.ty));
                self.report(Diag::new(Code::BadTask, e.span, label).help(help));
                None
            }
        }
    }

    /// `prog.output`; `None` if the expression does not begin with a program of this resource.
    fn program_variable(&mut self, e: &ast::Expr, resource: u32) -> Option<Option<Found>> {
        let ast::ExprKind::Member(base, output) = &e.kind else { return None };
        let ast::ExprKind::Name(name) = &base.kind else { return None };
        if !self.planned.iter().any(|p| p.resource == resource && name.is(&p.name)) {
            return None;
        }
        let parts = [name, output].map(|n| ast::PathPart::Name(n.clone()));
        Some(self.variable_path(Some(resource), &parts, e.span))
    }

    fn assign_task(&mut self, decl: &ast::ProgramDecl, program: ProgramInstance) {
        let Some(name) = &decl.task else { return self.background(program) };
        if let Some(task) = self.task_of(name, program.resource) {
            self.hir.tasks[task].programs.push(program);
        }
    }

    /// The task of a resource by its name.
    pub(super) fn task_of(&mut self, name: &ast::Name, resource: u32) -> Option<usize> {
        let found = self.hir.tasks.iter().position(|t| t.resource == resource && name.is(&t.name));
        if found.is_none() {
            let known = self.hir.tasks.iter().filter(|t| t.resource == resource).map(|t| t.name.as_str());
            let diag = Diag::new(Code::UnknownTask, name.span, "not declared");
            let diag = match takt_base::nearest(&name.text, known) {
                Some(near) => diag.help(format!("did you mean `{near}`?")),
                None => diag.help("declare it: TASK name (INTERVAL := T#10ms, PRIORITY := 1);"),
            };
            self.report(diag);
        }
        found
    }

    fn background(&mut self, program: ProgramInstance) {
        let resource = program.resource;
        let found = self.hir.tasks.iter().position(|t| t.resource == resource && t.priority == u32::MAX);
        let at = found.unwrap_or_else(|| {
            self.hir.tasks.push(new_task(BACKGROUND_TASK, u32::MAX, resource));
            self.hir.tasks.len() - 1
        });
        self.hir.tasks[at].programs.push(program);
    }
}

/// The value of a SINGLE that is a literal: FALSE is as good as none.
fn fixed_level(e: &ast::Expr) -> Option<bool> {
    match e.kind {
        ast::ExprKind::Literal(ast::Literal::Bool(level)) => Some(level),
        _ => None,
    }
}

/// A task with nothing to start it and nothing to run.
pub(super) fn new_task(name: &str, priority: u32, resource: u32) -> Task {
    let (programs, blocks) = (Vec::new(), Vec::new());
    Task { name: name.to_owned(), priority, interval: None, single: None, resource, programs, blocks }
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
        expression_addresses(singles.chain(super::connect::expressions(r)).collect(), on);
    }
    super::access::addresses(&c.access, on);
}
