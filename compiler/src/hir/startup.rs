//! What runs once before the first scan (vendor): initial values that are not constant (§3.1), and FB_init of the instances (§4.4).
//! Globals in order, then program instances in order; in a unit its base first, then its variables in order.
//!
//! A type whose instances need it gets a second body, which sets up one instance. The lowering calls all of them once, see
//! `mir::lower::startup`. Retained values were restored before: a variable that has its value back is left alone, which its mark tells.

use super::builder::Builder;
use super::convert::constant_expr;
use super::late::{Late, Owner, Part};
use super::model::*;
use crate::syntax::ast;
use std::collections::HashMap;
use takt_base::index::IndexVec;
use takt_base::{SourceId, Span};
use takt_image::types::Type;
use takt_image::{Elementary, TypeId};

/// What is known about the start.
#[derive(Default)]
pub(super) struct Startup {
    /// Values that are computed, by variable.
    pub late: HashMap<Owner, Vec<Late>>,
    /// Marks of variables that may be restored.
    pub marks: HashMap<Owner, Owner>,
    /// Arguments for FB_init in the declaration of instances.
    pub arguments: HashMap<Owner, ast::Init>,
    /// The second bodies; `None` for types that need none.
    units: HashMap<PouId, Option<PouId>>,
}

/// Where the statements of a setup go.
struct Setup {
    pou: PouId,
    body: Vec<Stmt>,
}

impl Builder<'_> {
    /// Makes the code of the start. Runs when all bodies and tasks are there.
    pub fn start_up(&mut self) {
        let programs: Vec<PouId> = self.hir.tasks.iter().flat_map(|t| &t.programs).map(|p| p.pou).collect();
        let mut start = Start { globals: self.setup_globals(), ..Start::default() };
        for pou in programs {
            if let Some(setup) = self.setup_of(pou) {
                self.note_call(setup, self.hir.pous[pou].end);
                let calls = self.calls.last_mut();
                calls.into_iter().for_each(|c| c.0 = None);
                start.programs.push((pou, setup));
            }
        }
        (start.kept, start.alone) = (self.objects.kept_mark, self.tests);
        if start.globals.is_some() || !start.programs.is_empty() {
            self.hir.start = Some(start);
        }
    }

    /// True if instances of the unit need something at the start, FB_init of the unit itself left aside.
    fn has_setup(&self, id: PouId) -> bool {
        let pou = &self.hir.pous[id];
        let late = |v: VarId| self.startup.late.contains_key(&Owner::Var(id, v));
        let inherited = pou.base.map_or(0, |b| self.hir.pous[b].instance.map_or(0, |_| self.own_start(b)));
        pou.base.is_some_and(|b| self.has_setup(b))
            || pou.vars.enumerate().skip(inherited).any(|(v, var)| is_kept(var) && (late(v) || self.type_starts(var.ty)))
    }

    /// Number of the variables that a derived type takes over.
    fn own_start(&self, base: PouId) -> usize {
        self.objects.taken_over.get(&base).copied().unwrap_or(0)
    }

    /// True if a variable of this type needs something at the start.
    fn type_starts(&self, ty: TypeId) -> bool {
        match self.ty(ty) {
            Type::Array { element, .. } => self.type_starts(*element),
            Type::Struct(r) => r.fields.iter().any(|f| self.type_starts(f.ty)),
            Type::Instance(_) => match self.objects.types.get(&ty) {
                Some(id) => !self.initialisers(*id).is_empty() || self.has_setup(*id),
                None => false,
            },
            _ => false,
        }
    }

    /// The second body of a type.
    fn setup_of(&mut self, id: PouId) -> Option<PouId> {
        if let Some(known) = self.startup.units.get(&id) {
            return *known;
        }
        let setup = self.has_setup(id).then(|| self.make_setup(id));
        self.startup.units.insert(id, setup);
        setup
    }

    fn make_setup(&mut self, id: PouId) -> PouId {
        let outer = std::mem::take(&mut self.scope);
        self.scope = self.symbols.pous[id].scope.clone();
        self.scope.pou = Some(id);
        let calls = (self.calls.len(), self.objects.dynamic_calls.len());
        let mut setup = Setup { pou: id, body: Vec::new() };
        let base = self.hir.pous[id].base;
        if let Some(base) = base {
            self.set_up_base(&mut setup, base);
        }
        let first = base.map_or(0, |b| self.own_start(b));
        let vars: Vec<VarId> = self.hir.pous[id].vars.indices().skip(first).collect();
        for v in vars {
            let var = &self.hir.pous[id].vars[v];
            if is_kept(var) {
                let place = Place { base: Base::Var(v), path: Vec::new(), ty: var.ty, span: var.span };
                self.set_up(&mut setup, place, Owner::Var(id, v));
            }
        }
        self.scope = outer;
        let new = self.push_setup(id, setup.body);
        let noted = self.calls.iter_mut().skip(calls.0).chain(self.objects.dynamic_calls.iter_mut().skip(calls.1));
        noted.filter(|c| c.0 == Some(id)).for_each(|c| c.0 = Some(new));
        // Its values were typed as part of the unit: it sees the globals that the unit sees.
        let uses: Vec<_> = self.uses.iter().filter(|u| u.0 == Some(id)).map(|u| (Some(new), u.1, u.2)).collect();
        self.uses.extend(uses);
        new
    }

    fn set_up_base(&mut self, setup: &mut Setup, base: PouId) {
        let (Some(pou), Some(ty)) = (self.setup_of(base), self.hir.pous[base].instance) else { return };
        let span = self.hir.pous[setup.pou].end;
        let instance = Place { base: Base::This, path: Vec::new(), ty, span };
        self.call_setup(setup, instance, pou);
    }

    fn call_setup(&mut self, setup: &mut Setup, instance: Place, pou: PouId) {
        let span = instance.span;
        self.note_call(pou, span);
        let kind = StmtKind::CallBlock { instance, pou, inputs: Vec::new(), outputs: Vec::new() };
        setup.body.push(Stmt { kind, span });
    }

    /// The unit of a second body: the variables of the first, and nothing to call it with.
    fn push_setup(&mut self, id: PouId, body: Vec<Stmt>) -> PouId {
        let pou = &self.hir.pous[id];
        let mut vars = pou.vars.clone();
        for var in vars.iter_mut() {
            var.edge = None;
            if var.role == Role::InOut {
                var.role = Role::Hidden; // bound to nothing yet
            }
        }
        let name = format!("{} at start", pou.name);
        let (source, instance, end) = (pou.source, pou.instance, pou.end);
        self.hir.pous.push(unit(name, PouKind::FunctionBlock, source, instance, vars, body, end))
    }

    /// The function that sets up all global variables.
    fn setup_globals(&mut self) -> Option<PouId> {
        let needs = |b: &Self, g: GlobalId| b.startup.late.contains_key(&Owner::Global(g)) || b.type_starts(b.hir.globals[g].ty);
        let globals: Vec<GlobalId> = self.hir.globals.indices().filter(|g| needs(self, *g)).collect();
        let span = globals.first().map(|g| self.hir.globals[*g].span)?;
        let outer = std::mem::take(&mut self.scope);
        let vars = IndexVec::new();
        let function = unit("globals at start".into(), PouKind::Function, span.source, None, vars, Vec::new(), span);
        let mut setup = Setup { pou: self.hir.pous.push(function), body: Vec::new() };
        for g in globals {
            let global = &self.hir.globals[g];
            let place = Place { base: Base::Global(g), path: Vec::new(), ty: global.ty, span: global.span };
            let calls = self.calls.len();
            self.set_up(&mut setup, place, Owner::Global(g));
            self.calls.iter_mut().skip(calls).for_each(|c| c.0 = None);
        }
        self.scope = outer;
        self.note_call(setup.pou, span);
        self.calls.last_mut().into_iter().for_each(|c| c.0 = None);
        self.hir.pous[setup.pou].body = setup.body;
        Some(setup.pou)
    }

    /// A variable: the instances in it, then its own computed values.
    fn set_up(&mut self, setup: &mut Setup, place: Place, owner: Owner) {
        if self.type_starts(place.ty) {
            let arguments = self.startup.arguments.get(&owner).cloned();
            self.set_up_instances(setup, place.clone(), arguments.as_ref());
        }
        let Some(list) = self.startup.late.get(&owner).cloned() else { return };
        let body = self.late_assignments(&place, &list);
        match self.startup.marks.get(&owner) {
            None => setup.body.extend(body),
            Some(Owner::Var(_, v)) => self.unless_marked(setup, Base::Var(*v), body, place.span),
            Some(Owner::Global(g)) => self.unless_marked(setup, Base::Global(*g), body, place.span),
        }
    }

    /// `IF NOT mark THEN body; mark := TRUE; END_IF`.
    fn unless_marked(&mut self, setup: &mut Setup, mark: Base, mut body: Vec<Stmt>, span: Span) {
        let ty = self.bool();
        let target = Place { base: mark, path: Vec::new(), ty, span };
        let read = Expr { kind: ExprKind::Load(target.clone()), ty, span };
        let unset = Expr { kind: ExprKind::Not(Box::new(read)), ty, span };
        let value = constant_expr(Const::Int(1), ty, span);
        body.push(Stmt { kind: StmtKind::Assign { target, value }, span });
        setup.body.push(Stmt { kind: StmtKind::If { branches: vec![(unset, body)], otherwise: Vec::new() }, span });
    }

    fn set_up_instances(&mut self, setup: &mut Setup, place: Place, arguments: Option<&ast::Init>) {
        match self.ty(place.ty).clone() {
            Type::Instance(_) => self.set_up_instance(setup, place, arguments),
            Type::Struct(r) => {
                for (i, field) in (0..).zip(&r.fields) {
                    let mut part = place.clone();
                    if self.type_starts(field.ty) && self.step_to(&mut part, Part::Field(i), place.span).is_some() {
                        self.set_up_instances(setup, part, None);
                    }
                }
            }
            Type::Array { dims, .. } => match arguments {
                Some(ast::Init::Array(list, _)) => self.set_up_each(setup, &place, list),
                _ => self.set_up_loop(setup, place, dims.len(), arguments),
            },
            _ => {}
        }
    }

    /// The instances of an array one by one, each with its arguments.
    fn set_up_each(&mut self, setup: &mut Setup, place: &Place, list: &[ast::ArrayInit]) {
        let Some((_, dims)) = self.array_parts(place.ty) else { return };
        let count = dims.iter().map(|d| d.len() as usize).fold(1usize, usize::saturating_mul);
        let given = list.iter().filter_map(|item| match item {
            ast::ArrayInit::One(init) => Some(init),
            ast::ArrayInit::Repeat(..) => None,
        });
        let given: Vec<&ast::Init> = given.collect();
        if given.len() != count || given.len() != list.len() {
            let label = format!("{} of {count} instances", given.len());
            return self.error(takt_base::Code::BadInitializer, place.span, label);
        }
        for (i, init) in given.into_iter().enumerate() {
            let mut part = place.clone();
            if self.step_to(&mut part, Part::Element(i), place.span).is_some() {
                self.set_up_instances(setup, part, Some(init));
            }
        }
    }

    /// All instances of an array, in a loop for each dimension.
    fn set_up_loop(&mut self, setup: &mut Setup, place: Place, dims: usize, arguments: Option<&ast::Init>) {
        let Some((element, bounds)) = self.array_parts(place.ty) else { return };
        let dint = self.elem(Elementary::Dint);
        let span = place.span;
        let counters: Vec<Place> = (0..dims).map(|_| self.counter(setup.pou, dint, span)).collect();
        let load = |c: &Place| Expr { kind: ExprKind::Load(c.clone()), ty: dint, span };
        let mut part = Place { ty: element, ..place };
        part.path.push(Step::Index(counters.iter().map(load).collect()));
        let outer = std::mem::take(&mut setup.body);
        self.set_up_instances(setup, part, arguments);
        let mut body = std::mem::replace(&mut setup.body, outer);
        for (variable, bound) in counters.into_iter().zip(bounds).rev() {
            let constant = |v: i32| constant_expr(Const::Int(v.into()), dint, span);
            let values = Box::new([constant(bound.low), constant(bound.high), constant(1)]);
            body = vec![Stmt { kind: StmtKind::For { variable, values, body }, span }];
        }
        setup.body.extend(body);
    }

    fn counter(&mut self, pou: PouId, ty: TypeId, span: Span) -> Place {
        let name = ast::Name { text: "counter".to_owned(), span };
        let var = self.push_var(pou, &name, ty, Role::Hidden, Storage::Local, Const::Zero);
        Place { base: Base::Var(var), path: Vec::new(), ty, span }
    }

    /// One instance: its variables, then FB_init of its bases and its own.
    fn set_up_instance(&mut self, setup: &mut Setup, place: Place, arguments: Option<&ast::Init>) {
        let Some(id) = self.objects.types.get(&place.ty).copied() else { return };
        if let Some(pou) = self.setup_of(id) {
            self.call_setup(setup, place.clone(), pou);
        }
        let mut calls = self.initialiser_calls(id, &place, arguments);
        setup.body.append(&mut calls);
    }
}

/// True for variables that last: they are set up once.
fn is_kept(var: &Var) -> bool {
    var.storage != Storage::Local && !matches!(var.role, Role::InOut | Role::Temp | Role::Result)
}

fn unit(
    name: String,
    kind: PouKind,
    source: SourceId,
    instance: Option<TypeId>,
    vars: IndexVec<VarId, Var>,
    body: Vec<Stmt>,
    end: Span,
) -> Pou {
    Pou {
        name,
        kind,
        owner: None,
        base: None,
        class: None,
        source,
        instance,
        vars,
        params: Vec::new(),
        result: None,
        external: false,
        body,
        end,
        reachable: false,
        unbinds: false,
    }
}
