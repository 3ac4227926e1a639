//! All names of the project before anything is resolved: types and units, globals, enumerators. File order does not matter (§4).

use super::builder::Builder;
use super::model::{self, *};
use super::scope::Scope;
use super::space::Spaces;
use super::types::TypeUse;
use crate::syntax::ast;
use std::collections::{HashMap, HashSet};
use takt_base::index::IndexVec;
use takt_base::{Code, Diag, Severity, SourceId, Span};
use takt_image::{Elementary, TypeId};

/// How far a declaration has got.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum State {
    Pending,
    Busy,
    Done,
}

/// A declared type.
pub(super) struct TypeEntry<'a> {
    pub decl: &'a ast::TypeDecl,
    pub state: State,
    pub result: Option<TypeUse>,
    /// Id of a structure that is referred to before it is resolved.
    pub reserved: Option<TypeId>,
}

/// A declared unit.
pub(super) struct PouEntry<'a> {
    pub decl: &'a ast::Pou,
    pub library: bool,
    pub state: State,
    /// Id of an instance that is referred to before it is resolved.
    pub reserved: Option<TypeId>,
    /// Names of the unit, between declaration and body.
    pub scope: Scope,
}

/// A declared global variable.
pub(super) struct GlobalEntry<'a> {
    /// `None`: made by the compiler.
    pub decl: Option<&'a ast::VarDecl>,
    pub library: bool,
    pub state: State,
}

/// What a name of the type-and-unit scope stands for.
#[derive(Clone, Copy)]
pub(super) enum Unit {
    Type(usize),
    Pou(PouId),
}

/// The tables.
#[derive(Default)]
pub(super) struct Symbols<'a> {
    pub units: HashMap<String, (Unit, Span)>,
    pub types: Vec<TypeEntry<'a>>,
    pub pous: IndexVec<PouId, PouEntry<'a>>,
    pub globals: HashMap<String, GlobalId>,
    pub global_entries: IndexVec<GlobalId, GlobalEntry<'a>>,
    /// Enumerator name to the types that declare it.
    pub enumerators: HashMap<String, Vec<usize>>,
    pub configurations: Vec<&'a ast::Configuration>,
    pub spaces: Spaces,
    /// Globals that several lists declare, which need the name of the list.
    pub shared_globals: HashMap<String, GlobalId>,
    /// Globals of each resource, if there are several.
    pub resource_globals: Vec<HashMap<String, GlobalId>>,
    /// The name under which different resources may mean different globals.
    pub grouped: HashMap<GlobalId, String>,
}

/// Names of what is declared at file level.
struct Names {
    /// By the user's files.
    user: HashSet<String>,
    /// By library files.
    library: HashSet<String>,
}

impl Names {
    /// True for the name of a type that no file declares.
    fn lacks(&self, ty: &ast::TypeRef) -> bool {
        let ast::TypeRefKind::Named(name) = &ty.kind else { return false };
        ![&self.user, &self.library].iter().any(|names| names.contains(&name.key()))
            && Elementary::from_name(&name.text).is_none()
    }
}

impl<'a> Builder<'a> {
    /// Collects all declarations. A user's declaration replaces a library's of the same name.
    pub fn collect(&mut self, files: &'a [(SourceId, ast::File)]) {
        let names_in = |library: bool| {
            let files = files.iter().filter(|(id, _)| self.sources.get(*id).library == library);
            files.flat_map(|(_, f)| &f.items).flat_map(item_names).collect()
        };
        let names = Names { user: names_in(false), library: names_in(true) };
        self.collect_spaces(files);
        for (source, file) in files {
            let library = self.sources.get(*source).library;
            for item in &file.items {
                self.collect_item(item, *source, library, &names);
            }
        }
        self.collect_configurations();
        self.number_classes();
    }

    fn collect_item(&mut self, item: &'a ast::Item, source: SourceId, library: bool, names: &Names) {
        let replaced = |name: &ast::Name| library && names.user.contains(&name.key());
        match item {
            ast::Item::Types(decls) => {
                for decl in decls.iter().filter(|d| !replaced(&d.name)) {
                    self.collect_type(decl);
                }
            }
            ast::Item::Pou(decl) if !replaced(&decl.name) => self.collect_pou(decl, source, library),
            ast::Item::Pou(_) => {}
            ast::Item::Globals(section) => {
                let left_out = |name: &ast::Name, ty: &ast::TypeRef| replaced(name) || library && names.lacks(ty);
                let list = self.list_name(section.span);
                self.collect_globals(section, library, list.as_deref(), &left_out);
            }
            ast::Item::Configuration(c) => self.symbols.configurations.push(c),
            ast::Item::Namespace(n) => {
                self.deeper(n.span, |b| n.items.iter().for_each(|i| b.collect_item(i, source, library, names)));
            }
            ast::Item::Using(_) => {}
        }
    }

    fn collect_type(&mut self, decl: &'a ast::TypeDecl) {
        let index = self.symbols.types.len();
        self.symbols.types.push(TypeEntry { decl, state: State::Pending, result: None, reserved: None });
        if self.unit_name(&decl.name, Unit::Type(index))
            && let ast::TypeBody::Enum(e) = &decl.body
        {
            for (value, _) in &e.values {
                self.symbols.enumerators.entry(value.key()).or_default().push(index);
            }
        }
    }

    fn collect_pou(&mut self, decl: &'a ast::Pou, source: SourceId, library: bool) {
        let id = self.enter_pou(decl, source, library);
        let kind = self.hir.pous[id].kind;
        let is_new = self.unit_name(&decl.name, Unit::Pou(id));
        if decl.external && !library && takt_stdlib::native_signature(&decl.name.key()).is_some() {
            self.error(Code::DuplicateName, decl.name.span, "a native of the library has this name");
        } else if is_new && kind == model::PouKind::Function {
            self.warn_replaced(&decl.name);
        }
        self.collect_methods(id, decl, source, library);
    }

    /// A new entry in the tables of units.
    pub fn enter_pou(&mut self, decl: &'a ast::Pou, source: SourceId, library: bool) -> PouId {
        let kind = match decl.kind {
            ast::PouKind::Function => model::PouKind::Function,
            ast::PouKind::FunctionBlock => model::PouKind::FunctionBlock,
            ast::PouKind::Program => model::PouKind::Program,
            ast::PouKind::Class => model::PouKind::Class,
            ast::PouKind::Interface => model::PouKind::Interface,
            ast::PouKind::Method => model::PouKind::Method,
        };
        let id =
            self.symbols.pous.push(PouEntry { decl, library, state: State::Pending, reserved: None, scope: Scope::default() });
        self.hir.pous.push(Pou {
            name: self.full_name(&decl.name).text,
            kind,
            owner: None,
            base: None,
            class: None,
            source,
            instance: None,
            vars: IndexVec::new(),
            params: Vec::new(),
            result: None,
            external: decl.external,
            body: Vec::new(),
            end: end_keyword(decl),
            reachable: false,
            unbinds: false,
        });
        id
    }

    fn warn_replaced(&mut self, name: &ast::Name) {
        if takt_stdlib::lookup(&self.full_name(name).text).is_some() {
            self.report(
                Diag::new(Code::DuplicateName, name.span, "a standard function has this name")
                    .severity(Severity::Warning)
                    .message("this function replaces a standard function")
                    .help("rename it if the standard function is wanted"),
            );
        }
    }

    /// Enters a type or unit; false if the name is taken.
    fn unit_name(&mut self, name: &ast::Name, unit: Unit) -> bool {
        let full = self.full_name(name);
        let first = self.symbols.units.entry(full.key()).or_insert((unit, name.span)).1;
        if first != name.span {
            self.report(Diag::new(Code::DuplicateName, name.span, "declared again").also(first, "first declared"));
        }
        first == name.span
    }

    /// Enters the variables of a VAR_GLOBAL section.
    pub fn collect_globals(
        &mut self,
        section: &'a ast::VarSection,
        library: bool,
        list: Option<&str>,
        left_out: &dyn Fn(&ast::Name, &ast::TypeRef) -> bool,
    ) {
        for decl in &section.decls {
            let anonymous = decl.names.is_empty().then(|| decl.at.as_ref().map(super::image::name_of)).flatten();
            for name in decl.names.iter().chain(anonymous.as_ref()).filter(|n| !left_out(n, &decl.ty)) {
                let id = self.collect_global(section, decl, name, library);
                self.enter_global(id, name, list, section.qualified_only);
            }
        }
    }

    pub(super) fn collect_global(
        &mut self,
        section: &ast::VarSection,
        decl: &'a ast::VarDecl,
        name: &ast::Name,
        library: bool,
    ) -> GlobalId {
        let id = self.hir.globals.push(Global {
            name: self.full_name(name).text,
            ty: self.error,
            place: None,
            init: Const::Zero,
            constant: section.constant,
            keep: Keep::of(section),
            resource: None,
            span: name.span,
        });
        self.symbols.global_entries.push(GlobalEntry { decl: Some(decl), library, state: State::Pending });
        id
    }
}

fn item_names(item: &ast::Item) -> Vec<String> {
    match item {
        ast::Item::Types(decls) => decls.iter().map(|d| d.name.key()).collect(),
        ast::Item::Pou(p) => vec![p.name.key()],
        ast::Item::Globals(s) => s.decls.iter().flat_map(|d| &d.names).map(ast::Name::key).collect(),
        ast::Item::Namespace(_) | ast::Item::Using(_) => Vec::new(),
        ast::Item::Configuration(c) => {
            let sections = c.globals.iter().chain(c.resources.iter().flat_map(|r| &r.globals));
            sections.flat_map(|s| &s.decls).flat_map(|d| &d.names).map(ast::Name::key).collect()
        }
    }
}

/// The END_ keyword of a unit.
fn end_keyword(decl: &ast::Pou) -> Span {
    let length = match decl.kind {
        ast::PouKind::Function => "END_FUNCTION",
        ast::PouKind::FunctionBlock => "END_FUNCTION_BLOCK",
        ast::PouKind::Program => "END_PROGRAM",
        ast::PouKind::Class => "END_CLASS",
        ast::PouKind::Interface => "END_INTERFACE",
        ast::PouKind::Method if decl.objects.accessor.is_some() => "END_GET",
        ast::PouKind::Method => "END_METHOD",
    }
    .len() as u32;
    Span { start: decl.span.end.saturating_sub(length).max(decl.span.start), ..decl.span }
}
