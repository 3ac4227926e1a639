//! EXTENDS and IMPLEMENTS: a derived type begins with the variables of its base, under the same ids and at the same places.

use crate::hir::builder::Builder;
use crate::hir::model::*;
use crate::hir::scope::Local;
use crate::hir::symbols::Unit;
use crate::syntax::ast;
use takt_base::{Code, Diag, Span};
use takt_image::types::{Record, Section, Type};
use takt_image::{CLASS_FIELD, Elementary, TypeId};

impl Builder<'_> {
    /// The start of a function block, class or program: what it has from its base, and its class number.
    pub(in crate::hir) fn inherit(&mut self, id: PouId, decl: &ast::Pou) {
        self.interfaces_of(id, &decl.objects.implements);
        let base = self.base_of(id, decl);
        if self.objects.numbered.contains(&id) && self.hir.pous[id].kind != PouKind::Program {
            self.hir.pous[id].class = Some(Self::class_number(id));
        }
        match base {
            Some(base) => self.take_over(id, base),
            None => self.add_class_field(id, decl),
        }
    }

    fn base_of(&mut self, id: PouId, decl: &ast::Pou) -> Option<PouId> {
        if let Some(second) = decl.objects.extends.get(1) {
            let label = "a second base";
            self.report(
                Diag::new(Code::NotABase, second.span, label)
                    .help("a type extends one type; it may implement several interfaces"),
            );
        }
        let name = decl.objects.extends.first()?;
        let kinds: &[PouKind] = match decl.kind {
            ast::PouKind::FunctionBlock => &[PouKind::FunctionBlock, PouKind::Class],
            ast::PouKind::Class => &[PouKind::Class],
            _ => &[],
        };
        let base = self.named_base(name, kinds, "extends")?;
        if !self.ensure_pou(base, name.span) {
            let label = format!("`{}` extends itself", decl.name.text);
            self.report(
                Diag::new(Code::InheritanceCycle, name.span, label)
                    .help("remove one EXTENDS; put what both need into a third type"),
            );
            return None;
        }
        let modifiers = &self.symbols.pous[base].decl.objects.modifiers;
        if let Some(at) = modifiers.is_final {
            self.report(Diag::new(Code::OverridesFinal, name.span, "this type is FINAL").also(at, "declared"));
        }
        self.hir.pous[base].instance?; // too large, and reported
        self.hir.pous[id].base = Some(base);
        Some(base)
    }

    /// The unit of this name, if it is of one of the kinds.
    fn named_base(&mut self, name: &ast::Name, kinds: &[PouKind], verb: &str) -> Option<PouId> {
        self.check_unit_use(name);
        let what = match self.unit(name) {
            Some((Unit::Pou(base), _)) if kinds.contains(&self.hir.pous[base].kind) => return Some(base),
            Some((Unit::Type(_), _)) => "a data type",
            Some((Unit::Pou(base), _)) => match self.hir.pous[base].kind {
                PouKind::Function | PouKind::Method => "a function",
                PouKind::FunctionBlock => "a function block",
                PouKind::Program => "a program",
                PouKind::Class => "a class",
                PouKind::Interface => "an interface",
            },
            None => {
                let known = self.hir.pous.iter().filter(|p| kinds.contains(&p.kind)).map(|p| p.name.clone()).collect();
                self.unknown(Code::UnknownType, name, known);
                return None;
            }
        };
        let help = match (verb, what) {
            ("extends", "an interface") => "write IMPLEMENTS for an interface",
            ("implements", "a class" | "a function block") => "write EXTENDS for a base type",
            ("extends", _) => "a function block extends a function block or class, a class a class, an interface interfaces",
            _ => "only interfaces can be implemented",
        };
        self.report(Diag::new(Code::NotABase, name.span, what).help(help));
        None
    }

    /// Resolves the interfaces that a type names.
    fn interfaces_of(&mut self, id: PouId, names: &[ast::Name]) {
        let mut list = Vec::new();
        for name in names {
            if let Some(found) = self.named_base(name, &[PouKind::Interface], "implements")
                && self.ensure_pou(found, name.span)
                && !list.contains(&found)
            {
                list.push(found);
            }
        }
        self.objects.interfaces.insert(id, list);
    }

    /// An interface: its references point to something that begins with a class number.
    pub(in crate::hir) fn declare_interface(&mut self, id: PouId, decl: &ast::Pou) {
        let mut list = Vec::new();
        for name in &decl.objects.extends {
            let Some(base) = self.named_base(name, &[PouKind::Interface], "extends") else { continue };
            if self.ensure_pou(base, name.span) {
                list.push(base);
            } else {
                let label = format!("`{}` extends itself", decl.name.text);
                self.report(
                    Diag::new(Code::InheritanceCycle, name.span, label)
                        .help("remove one EXTENDS; put what both need into a third type"),
                );
            }
        }
        self.objects.interfaces.insert(id, list);
        if let Some(name) = decl.objects.implements.first() {
            self.report(Diag::new(Code::NotABase, name.span, "an interface implements nothing").help("write EXTENDS"));
        }
        if let Some(section) = decl.sections.first() {
            let diag = Diag::new(Code::SectionNotAllowed, section.span, "an interface has no variables");
            self.report(diag.help("add a property, or methods that read and write"));
        }
        self.interface_target(id);
    }

    /// The type that references of an interface point to.
    fn interface_target(&mut self, id: PouId) -> TypeId {
        if let Some(ty) = self.hir.pous[id].instance {
            return ty;
        }
        let number = self.elem(Elementary::Udint);
        let field = (CLASS_FIELD.to_owned(), number, Section::Hidden, false);
        let record: Record = self.hir.types.record(self.hir.pous[id].name.clone(), [field]);
        let ty = self.hir.types.add(Type::Instance(record));
        self.hir.pous[id].instance = Some(ty);
        self.objects.types.insert(ty, id);
        ty
    }

    /// Type of a variable of an interface type. Starts as NULL.
    pub(in crate::hir) fn interface_type(&mut self, id: PouId, at: Span) -> crate::hir::types::TypeUse {
        let target = self.interface_target(id);
        let _ = at;
        let ty = self.hir.types.intern(Type::Reference { target });
        self.plain(ty)
    }

    fn add_class_field(&mut self, id: PouId, decl: &ast::Pou) {
        let Some(number) = self.hir.pous[id].class else { return };
        let ty = self.elem(Elementary::Udint);
        let name = ast::Name { text: CLASS_FIELD.to_owned(), span: decl.name.span };
        self.push_var(id, &name, ty, Role::Hidden, Storage::Local, Const::Int(number.into()));
    }

    /// Copies the variables of the base and makes their names known.
    fn take_over(&mut self, id: PouId, base: PouId) {
        let mut vars: Vec<Var> = self.hir.pous[base].vars.iter().cloned().collect();
        if let (Some(first), Some(number)) = (vars.first_mut().filter(|v| v.name == CLASS_FIELD), self.hir.pous[id].class) {
            first.init = Const::Int(number.into());
        }
        self.hir.pous[id].params = self.hir.pous[base].params.clone();
        self.objects.taken_over.insert(base, vars.len());
        for (v, var) in vars.into_iter().enumerate() {
            let v = takt_base::index::Index::new(v);
            let access = self.objects.var_access.get(&(base, v)).copied();
            if let Some(access) = access {
                self.objects.var_access.insert((id, v), access);
            }
            let private = access.is_some_and(|a| a.0 == ast::AccessSpec::Private);
            if !private && !matches!(var.role, Role::Hidden | Role::Temp) {
                self.scope.names.insert(var.name.to_ascii_uppercase(), (Local::Var(v), var.span));
            }
            self.image.inherit_open(base, id, v);
            self.hir.pous[id].vars.push(var);
        }
        let scope = &self.symbols.pous[base].scope;
        self.scope.read_only.extend(scope.read_only.clone());
        let externals = scope.names.iter().filter(|(_, (l, _))| matches!(l, Local::External(_)));
        for (name, found) in externals {
            self.scope.names.entry(name.clone()).or_insert(*found);
        }
    }

    /// The fields of the base in order, or the class number: what instances of a type begin with.
    pub(in crate::hir) fn inherited_fields(&self, id: PouId) -> Vec<(Section, VarId)> {
        let pou = &self.hir.pous[id];
        let Some(base) = pou.base.map(|b| &self.hir.pous[b]) else {
            let first = pou.vars.enumerate().next().filter(|(_, v)| v.name == CLASS_FIELD);
            return first.map(|(v, _)| (Section::Hidden, v)).into_iter().collect();
        };
        let Some(Type::Instance(record)) = base.instance.map(|ty| self.ty(ty)) else { return Vec::new() };
        let mut fields: Vec<(u32, VarId)> = base
            .vars
            .enumerate()
            .filter_map(|(v, var)| if let Storage::Field(i) = var.storage { Some((i, v)) } else { None })
            .collect();
        fields.sort_by_key(|f| f.0);
        fields.into_iter().filter_map(|(i, v)| Some((record.fields.get(i as usize)?.section, v))).collect()
    }

    /// Names of the retained variables of the base.
    pub(in crate::hir) fn inherited_retain(&self, id: PouId) -> Vec<String> {
        let base = self.hir.pous[id].base.and_then(|b| self.hir.pous[b].instance);
        let Some(Type::Instance(record)) = base.map(|ty| self.ty(ty)) else { return Vec::new() };
        record.fields.iter().filter(|f| f.retain).map(|f| f.name.clone()).collect()
    }

    /// Enters a variable; one that hides an inherited one is reported.
    pub(in crate::hir) fn declare_own(&mut self, id: PouId, name: &ast::Name, local: Local) -> bool {
        let inherited = self.hir.pous[id].base.map_or(0, |b| self.hir.pous[b].vars.len());
        if let Some(&(Local::Var(v), first)) = self.scope.names.get(&name.key())
            && takt_base::index::Index::index(v) < inherited
        {
            let diag = Diag::new(Code::HidesInherited, name.span, "inherited").also(first, "declared in the base");
            self.report(diag.help("use another name, or make the variable of the base PRIVATE"));
            return false;
        }
        self.declare_local(name, local)
    }

    /// Makes the variables of the owner known to a method.
    pub(in crate::hir) fn enter_owner(&mut self, id: PouId) {
        let Some(owner) = self.hir.pous[id].owner else { return };
        let span = self.symbols.pous[owner].decl.name.span;
        self.ensure_pou(owner, span);
        let action = self.is_action(id);
        let scope = &self.symbols.pous[owner].scope;
        let vars = &self.hir.pous[owner].vars;
        let mut borrowed = Vec::new();
        for (name, (local, _)) in &scope.names {
            let member = match *local {
                Local::Var(v) if vars[v].role == Role::InOut && action => {
                    borrowed.push((name.clone(), v));
                    continue;
                }
                Local::Var(v) if vars[v].role == Role::Temp && vars[v].storage == Storage::Local => continue,
                Local::Var(v) => Local::Member(v),
                other => other,
            };
            self.scope.members.insert(name.clone(), member);
        }
        self.scope.fixed_members = scope.read_only.clone();
        self.scope.enums = scope.enums.clone();
        borrowed.sort();
        borrowed.into_iter().for_each(|(name, v)| self.borrow_in_out(id, owner, &name, v));
    }
}
