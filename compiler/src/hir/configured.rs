//! VAR_CONFIG: address and initial value of single instances; and the check that every open address got one (§3.4, §3.6, §3.7).

use super::builder::Builder;
use super::constant;
use super::image::Owner;
use super::instance::{Found, Last};
use super::model::*;
use super::types::TypeUse;
use crate::syntax::ast;
use std::collections::{HashMap, HashSet};
use takt_base::{Code, Diag, Severity, Span};
use takt_image::image::Place as ImagePlace;
use takt_image::types::Type;
use takt_image::{TypeId, TypeTable};

/// Instances with an address: root and steps, and where it was given.
type Given = HashMap<(Root, Vec<u32>), Span>;

impl Builder<'_> {
    /// All VAR_CONFIG sections. Runs when everything is declared and no address has its place yet.
    pub fn var_config(&mut self) {
        let mut given = Given::new();
        for c in self.symbols.configurations.clone() {
            c.config.iter().for_each(|decl| self.config_decl(decl, &mut given));
        }
        self.mirror_values();
        OpenCheck::new(&given).run(self);
    }

    fn config_decl(&mut self, decl: &ast::ConfigDecl, given: &mut Given) {
        let used = self.type_ref(&decl.ty);
        let Some(found) = self.instance_path(&decl.path) else { return };
        if used.ty == self.error || found.ty == self.error || !self.may_configure(&found, decl) {
            return;
        }
        if used.ty != found.ty {
            let label = format!("{}, declared {}", self.show(used.ty), self.show(found.ty));
            let diag = Diag::new(Code::InstanceMismatch, decl.ty.span, label).also(found.declared, "declared");
            return self.report(diag.help("repeat the type of the declaration"));
        }
        if let Some(at) = &decl.at {
            self.config_address(&found, at, decl.path.span, given);
        }
        if let Some(init) = decl.init.as_ref().filter(|_| self.is_computed(found.last)) {
            self.not_configurable(init.span(), "its value is computed at the start", "give its declaration a constant value");
        } else if let Some(init) = &decl.init {
            self.config_value(&found, init);
        }
    }

    /// True for a variable whose initial value is no constant (vendor).
    fn is_computed(&self, last: Last) -> bool {
        match last {
            Last::Global(g) => self.startup.late.contains_key(&super::late::Owner::Global(g)),
            Last::Var(pou, v) => self.line(pou).iter().any(|t| self.startup.late.contains_key(&super::late::Owner::Var(*t, v))),
            _ => false,
        }
    }

    fn may_configure(&mut self, found: &Found, decl: &ast::ConfigDecl) -> bool {
        if self.is_constant(found.last) {
            self.not_configurable(decl.path.span, "a CONSTANT", "change its declaration");
            return false;
        }
        if found.last == Last::Program {
            self.not_configurable(decl.path.span, "a program", "name one of its variables");
            return false;
        }
        if found.last == Last::Part && found.steps.contains(&u32::MAX) {
            self.not_configurable(decl.path.span, "a part of a located variable", "give the whole variable a value");
            return false;
        }
        true
    }

    fn config_address(&mut self, found: &Found, at: &ast::Address, span: Span, given: &mut Given) {
        let open = owner(found.last).and_then(|o| self.image.open_area(o));
        // A variable of an instance without AT may get an address too; what is located stays where it is.
        let free = matches!(found.last, Last::Var(..)) && !found.steps.contains(&u32::MAX);
        if open.is_none() && !free {
            return self.not_configurable(at.span, "its address is not open", "declare it with AT %I*, AT %Q* or AT %M*");
        }
        if let Some(area) = open.filter(|area| *area != at.area) {
            let label = format!("declared AT %{}*", ["I", "Q", "M"][area as usize]);
            let diag = Diag::new(Code::InstanceMismatch, at.span, label).also(found.declared, "declared");
            return self.report(diag.help("stay in the area of the declaration"));
        }
        if let Some(first) = given.insert((found.root.clone(), found.steps.clone()), span) {
            let diag = Diag::new(Code::DuplicateName, span, "gets its address again").also(first, "first given");
            return self.report(diag);
        }
        if at.path.is_empty() {
            self.report(Diag::new(Code::AddressLeftOpen, at.span, "open here too").help("write the number too: %QX1.0"));
            return;
        }
        match found.last {
            Last::Global(id) => self.locate_global(id, at),
            _ => {
                let (place, init) = (ImagePlace::Byte(0), Const::Zero);
                let (root, offset, ty) = (found.root.clone(), found.offset, found.ty);
                self.mirror(at, Mirror { root, offset, ty, place, input: false, init }, found.declared);
            }
        }
    }

    fn config_value(&mut self, found: &Found, init: &ast::Init) {
        let input = owner(found.last).and_then(|o| self.image.open_area(o)) == Some(ast::Area::Input);
        let default = match (found.last, found.steps.contains(&u32::MAX)) {
            (Last::Var(pou, var), true) => self.hir.pous[pou].vars[var].init.clone(),
            _ => part(self.root_value(&found.root), &found.steps),
        };
        let value = self.initial(init, &TypeUse { ty: found.ty, default });
        if input || !self.charge(constant::leaves(&value), init.span()) {
            return;
        }
        match found.last {
            Last::Var(pou, var) if found.steps.contains(&u32::MAX) => {
                if self.image.area_of_var(pou, var) != Some(ast::Area::Input) {
                    self.hir.pous[pou].vars[var].init = value;
                }
            }
            _ => self.set_value(found, value, init.span()),
        }
    }

    /// Initial value of a whole global or program instance.
    fn root_value(&self, root: &Root) -> &Const {
        match root {
            Root::Global(id) => &self.hir.globals[*id].init,
            Root::Program(..) => match self.values.get(root) {
                Some(value) => value,
                None => self.root_type(root).and_then(|ty| self.defaults.get(&ty)).unwrap_or(&Const::Zero),
            },
        }
    }

    fn root_type(&self, root: &Root) -> Option<TypeId> {
        match root {
            Root::Global(id) => Some(self.hir.globals[*id].ty),
            Root::Program(resource, name) => {
                let program = self.planned.iter().find(|p| p.resource == *resource && p.name.eq_ignore_ascii_case(name))?;
                self.hir.pous[program.pou].instance
            }
        }
    }

    fn set_value(&mut self, found: &Found, value: Const, span: Span) {
        let Some(ty) = self.root_type(&found.root) else { return };
        let mut whole = self.root_value(&found.root).clone();
        if !self.charge(constant::leaves(&whole), span) {
            return;
        }
        set(&self.hir.types, &mut whole, ty, &found.steps, value);
        match &found.root {
            Root::Global(id) => self.hir.globals[*id].init = whole,
            root => _ = self.values.insert(root.clone(), whole),
        }
    }

    /// The process image starts with the initial values of the fields that stand for it.
    fn mirror_values(&mut self) {
        let steps: Vec<_> = self.mirrors().iter().map(|(m, _)| (m.root.clone(), m.offset, m.ty)).collect();
        for (i, (root, offset, ty)) in steps.into_iter().enumerate() {
            let Some(whole) = self.root_type(&root) else { continue };
            let init = at_offset(&self.hir.types, self.root_value(&root), whole, offset, ty).unwrap_or(Const::Zero);
            if let Some((mirror, _)) = self.mirrors().get_mut(i) {
                mirror.init = init;
            }
        }
    }
}

fn owner(last: Last) -> Option<Owner> {
    match last {
        Last::Global(id) => Some(Owner::Global(id)),
        Last::Var(pou, var) => Some(Owner::Var(pou, var)),
        Last::Program | Last::Part => None,
    }
}

fn part(value: &Const, steps: &[u32]) -> Const {
    match (steps, value) {
        ([], _) => value.clone(),
        ([first, rest @ ..], Const::Aggregate(parts)) => parts.get(*first as usize).map_or(Const::Zero, |p| part(p, rest)),
        _ => Const::Zero,
    }
}

/// The part of a type `ty` at an offset.
fn at_offset(types: &TypeTable, value: &Const, whole: TypeId, offset: u32, ty: TypeId) -> Option<Const> {
    if offset == 0 && whole == ty {
        return Some(value.clone());
    }
    let (step, next, rest) = match types.get(whole) {
        Type::Array { element, .. } => {
            let size = types.layout(*element).size.max(1);
            (offset / size, *element, offset % size)
        }
        Type::Struct(r) | Type::Instance(r) => {
            let inside = |f: &takt_image::types::Field| f.offset <= offset && offset - f.offset < types.layout(f.ty).size;
            let (i, f) = (0..).zip(&r.fields).find(|(_, f)| inside(f))?;
            (i, f.ty, offset - f.offset)
        }
        _ => return None,
    };
    at_offset(types, &part(value, &[step]), next, rest, ty)
}

/// Replaces a part of a value; `Zero` is spelt out on the way there.
fn set(types: &TypeTable, value: &mut Const, ty: TypeId, steps: &[u32], new: Const) {
    let [first, rest @ ..] = steps else {
        *value = new;
        return;
    };
    let (count, next) = match types.get(ty) {
        Type::Array { element, dims } => (dims.iter().fold(1usize, |n, d| n.saturating_mul(d.len() as usize)), *element),
        Type::Struct(r) | Type::Instance(r) => {
            let Some(field) = r.fields.get(*first as usize) else { return };
            (r.fields.len(), field.ty)
        }
        _ => return,
    };
    if *value == Const::Zero {
        *value = Const::Aggregate(vec![Const::Zero; count]);
    }
    if let Const::Aggregate(parts) = value
        && let Some(part) = parts.get_mut(*first as usize)
    {
        set(types, part, next, rest, new);
    }
}

/// Looks for instances whose open address nobody gave.
struct OpenCheck<'g> {
    given: &'g Given,
    /// Types with an open address somewhere inside.
    holds: HashMap<TypeId, bool>,
    reported: HashSet<(PouId, VarId)>,
}

impl<'g> OpenCheck<'g> {
    fn new(given: &'g Given) -> Self {
        Self { given, holds: HashMap::new(), reported: HashSet::new() }
    }

    fn run(mut self, b: &mut Builder) {
        let programs: Vec<_> = b.planned.iter().map(|p| (p.resource, p.name.clone(), b.hir.pous[p.pou].instance)).collect();
        for (resource, name, ty) in programs {
            let Some(ty) = ty else { continue };
            let root = Root::Program(resource, name.to_ascii_uppercase());
            let name = b.hir.path(Some(resource), &name);
            self.walk(b, &root, ty, &mut Vec::new(), &name);
        }
        for id in b.hir.globals.indices() {
            let g = &b.hir.globals[id];
            let (name, ty, span) = (b.hir.global_path(g), g.ty, g.span);
            let owner = Owner::Global(id);
            if b.image.open_area(owner).is_some() && !self.given.contains_key(&(Root::Global(id), Vec::new())) {
                left_open(b, span, &name);
            }
            self.walk(b, &Root::Global(id), ty, &mut Vec::new(), &name);
        }
    }

    /// True if something is missing.
    fn walk(&mut self, b: &mut Builder, root: &Root, ty: TypeId, steps: &mut Vec<u32>, path: &str) -> bool {
        if !self.holds_open(b, ty) {
            return false;
        }
        match b.ty(ty).clone() {
            Type::Instance(_) => b.unit_of(ty).is_some_and(|pou| self.walk_unit(b, root, pou, steps, path)),
            Type::Struct(r) => {
                let each = (0..).zip(&r.fields);
                each.fold(false, |bad, (i, f)| self.step(b, root, f.ty, steps, i, format!("{path}.{}", f.name)) | bad)
            }
            Type::Array { element, dims } => {
                let count = dims.iter().fold(1u32, |n, d| n.saturating_mul(d.len()));
                let name = |i: u32| match &dims[..] {
                    [dim] => format!("{path}[{}]", i64::from(dim.low) + i64::from(i)),
                    _ => format!("{path}[..]"),
                };
                (0..count).any(|i| self.step(b, root, element, steps, i, name(i)))
            }
            _ => false,
        }
    }

    fn step(&mut self, b: &mut Builder, root: &Root, ty: TypeId, steps: &mut Vec<u32>, i: u32, path: String) -> bool {
        steps.push(i);
        let missing = self.walk(b, root, ty, steps, &path);
        steps.pop();
        missing
    }

    fn walk_unit(&mut self, b: &mut Builder, root: &Root, pou: PouId, steps: &mut Vec<u32>, path: &str) -> bool {
        let vars: Vec<_> = b.hir.pous[pou].vars.enumerate().map(|(id, v)| (id, v.storage, v.ty, v.role)).collect();
        let mut missing = false;
        for (id, storage, ty, role) in vars {
            let Storage::Field(i) = storage else { continue };
            if role == Role::InOut {
                continue;
            }
            let (name, span) = (format!("{path}.{}", b.hir.pous[pou].vars[id].name), b.hir.pous[pou].vars[id].span);
            if b.image.open_area(Owner::Var(pou, id)).is_none() {
                missing |= self.step(b, root, ty, steps, i, name);
                continue;
            }
            steps.push(i);
            let given = self.given.contains_key(&(root.clone(), steps.clone()));
            steps.pop();
            missing |= !given;
            if !given && self.reported.insert((pou, id)) {
                left_open(b, span, &name);
            }
        }
        missing
    }

    fn holds_open(&mut self, b: &Builder, ty: TypeId) -> bool {
        if let Some(&known) = self.holds.get(&ty) {
            return known;
        }
        let parts: Vec<TypeId> = match b.ty(ty) {
            Type::Array { element, .. } => vec![*element],
            Type::Struct(r) | Type::Instance(r) => r.fields.iter().map(|f| f.ty).collect(),
            _ => return false,
        };
        self.holds.insert(ty, false);
        let own = b.unit_of(ty).is_some_and(|pou| b.image.has_open(pou));
        let found = own || parts.into_iter().any(|p| self.holds_open(b, p));
        self.holds.insert(ty, found);
        found
    }
}

fn left_open(b: &mut Builder, span: Span, path: &str) {
    let help = format!("give it one: VAR_CONFIG {path} AT %QX0.0 : BOOL; END_VAR in the CONFIGURATION");
    let diag = Diag::new(Code::AddressLeftOpen, span, format!("`{path}` has no address")).help(help);
    // Programs are moved from TwinCAT, where the system manager keeps the addresses: there the variable is in no image.
    b.report(if b.profile(span).is_codesys() { diag.severity(Severity::Warning) } else { diag });
}
