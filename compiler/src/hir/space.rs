//! Namespaces and USING: which full names a written name may stand for, by the place where it stands (§3.10, §4.6).
//! Every type, unit and global has one full name, `A.B.F` for F in `NAMESPACE A.B`; what is in no namespace has its short name.
//! A name is sought in the namespaces around it, from the inside out, then in what USING imports, then among the global names.

use super::builder::Builder;
use super::model::*;
use super::symbols::Unit;
use crate::syntax::ast;
use std::collections::{BTreeMap, HashMap, HashSet};
use takt_base::{Code, Diag, SourceId, Span};

/// Most levels of namespaces.
const NESTED_MAX: usize = 64;

/// A stretch of a file with names of its own: a namespace, a unit with USING, or a file with USING.
struct Space {
    span: Span,
    parent: Option<usize>,
    /// Full name of the namespace with a point behind it, as looked up; empty outside of all.
    path: String,
    /// The same as written.
    shown: String,
    usings: Vec<ast::Name>,
    /// The namespaces that `usings` name.
    imported: Vec<String>,
}

/// All stretches.
#[derive(Default)]
pub(super) struct Spaces {
    list: Vec<Space>,
    /// By file, in order of their start.
    by_source: HashMap<SourceId, Vec<usize>>,
    /// Every namespace by its path, with its name as written and the INTERNAL one's place.
    known: BTreeMap<String, (String, Option<Span>)>,
    /// Names that a qualified name may begin with.
    heads: HashSet<String>,
}

/// Keys that a name may stand for: of each step only one may exist, and the first step with one decides.
type Steps = Vec<Vec<String>>;

impl Spaces {
    fn at(&self, span: Span) -> Option<usize> {
        let list = self.by_source.get(&span.source)?;
        let behind = list.partition_point(|i| self.list[*i].span.start <= span.start);
        let mut found = list.get(behind.checked_sub(1)?).copied();
        while let Some(i) = found.filter(|i| self.list[*i].span.end <= span.start) {
            found = self.list[i].parent;
        }
        found
    }

    /// True if `at` is in the namespace of what is declared at `declared`: INTERNAL may be used there.
    pub(super) fn holds(&self, declared: Span, at: Span) -> bool {
        self.path(self.at(at)).0.starts_with(self.path(self.at(declared)).0)
    }

    fn path(&self, at: Option<usize>) -> (&str, &str) {
        at.map_or(("", ""), |i| (&self.list[i].path, &self.list[i].shown))
    }

    /// What the name may be at a place.
    fn steps(&self, key: &str, span: Span) -> Steps {
        if let Some(global) = key.strip_prefix('.') {
            return vec![vec![global.to_owned()]];
        }
        let at = self.at(span);
        let mut steps: Steps = enclosing(self.path(at).0).map(|path| vec![format!("{path}{key}")]).collect();
        let mut next = at;
        while let Some(i) = next {
            if !key.contains('.') {
                steps.push(self.list[i].imported.iter().map(|path| format!("{path}{key}")).collect());
            }
            next = self.list[i].parent;
        }
        steps.push(vec![key.to_owned()]);
        steps
    }

    /// The full key of a name, and those that it could be as well.
    fn resolve(&self, key: &str, span: Span, exists: &dyn Fn(&str) -> bool) -> Vec<String> {
        let found = self.steps(key, span).into_iter().map(|step| step.into_iter().filter(|k| exists(k)).collect::<Vec<_>>());
        found.into_iter().find(|step| !step.is_empty()).unwrap_or_default()
    }

    fn plain(&self, key: &str, span: Span) -> bool {
        !key.starts_with('.') && !self.by_source.contains_key(&span.source)
    }

    /// Names may begin with this one.
    pub fn add_head(&mut self, key: String) {
        self.heads.insert(key);
    }

    fn enter(&mut self, space: Space) -> usize {
        let index = self.list.len();
        self.by_source.entry(space.span.source).or_default().push(index);
        self.list.push(space);
        index
    }
}

/// `A.B.`, `A.` for `A.B.`.
fn enclosing(path: &str) -> impl Iterator<Item = &str> {
    let ends = path.char_indices().rev().filter(|(_, c)| *c == '.').map(|(i, _)| i + 1);
    ends.map(|end| &path[..end])
}

impl<'a> Builder<'a> {
    /// Notes the namespaces and USINGs of all files.
    pub(super) fn collect_spaces(&mut self, files: &'a [(SourceId, ast::File)]) {
        for (source, file) in files {
            let usings: Vec<ast::Name> = file.items.iter().filter_map(using).flatten().cloned().collect();
            let whole = Span::new(*source, 0, self.sources.get(*source).text.len() + 1);
            let parent = (!usings.is_empty()).then(|| self.enter_space(None, whole, "", usings));
            self.collect_space_items(&file.items, parent);
        }
        self.resolve_usings();
    }

    fn enter_space(&mut self, parent: Option<usize>, span: Span, name: &str, usings: Vec<ast::Name>) -> usize {
        let shown = self.symbols.spaces.path(parent).1;
        let shown = if name.is_empty() { shown.to_owned() } else { format!("{shown}{name}.") };
        let path = shown.to_ascii_uppercase();
        self.symbols.spaces.enter(Space { span, parent, path, shown, usings, imported: Vec::new() })
    }

    fn collect_space_items(&mut self, items: &'a [ast::Item], parent: Option<usize>) {
        for item in items {
            match item {
                ast::Item::Namespace(n) => self.collect_space(n, parent),
                ast::Item::Pou(p) if !p.objects.usings.is_empty() => {
                    self.enter_space(parent, p.span, "", p.objects.usings.clone());
                }
                _ => {}
            }
        }
    }

    fn collect_space(&mut self, n: &'a ast::Namespace, parent: Option<usize>) {
        let usings = n.usings.iter().chain(n.items.iter().filter_map(using).flatten()).cloned().collect();
        let depth = n.name.text.split('.').count() + self.symbols.spaces.path(parent).0.split('.').count();
        if depth > NESTED_MAX {
            let label = format!("more than {NESTED_MAX} levels");
            return self.report(Diag::new(Code::NestedTooDeep, n.name.span, label).help("use fewer levels of namespaces"));
        }
        let index = self.enter_space(parent, n.span, &n.name.text, usings);
        let spaces = &mut self.symbols.spaces;
        let shown = spaces.list[index].shown.clone();
        for path in enclosing(&shown) {
            let name = path.trim_end_matches('.');
            spaces.heads.insert(name.rsplit('.').next().unwrap_or(name).to_ascii_uppercase());
            spaces.known.entry(path.to_ascii_uppercase()).or_insert((name.to_owned(), None));
        }
        if let Some(entry) = spaces.known.get_mut(&shown.to_ascii_uppercase()).filter(|_| n.internal) {
            entry.1 = Some(n.name.span);
        }
        self.deeper(n.span, |b| b.collect_space_items(&n.items, Some(index)));
    }

    fn resolve_usings(&mut self) {
        for i in 0..self.symbols.spaces.list.len() {
            for name in std::mem::take(&mut self.symbols.spaces.list[i].usings) {
                if let Some(path) = self.namespace(&name) {
                    self.check_internal(&path, name.span);
                    let imported = &mut self.symbols.spaces.list[i].imported;
                    if !imported.contains(&path) {
                        imported.push(path);
                    }
                }
            }
        }
    }

    /// The namespace of a USING.
    fn namespace(&mut self, name: &ast::Name) -> Option<String> {
        let spaces = &self.symbols.spaces;
        let found = spaces.resolve(&format!("{}.", name.key()), name.span, &|k| spaces.known.contains_key(k)).pop();
        if found.is_none() {
            let known = spaces.known.values().map(|(shown, _)| shown.clone()).collect();
            self.unknown(Code::UnknownNamespace, name, known);
        }
        found
    }

    /// The name with the namespace that it is declared in.
    pub(super) fn full_name(&self, name: &ast::Name) -> ast::Name {
        let spaces = &self.symbols.spaces;
        let shown = spaces.path(spaces.at(name.span)).1;
        ast::Name { text: format!("{shown}{}", name.text), span: name.span }
    }

    /// The type or unit that a name stands for at its place.
    pub(super) fn unit(&self, name: &ast::Name) -> Option<(Unit, Span)> {
        let (units, key) = (&self.symbols.units, name.key());
        if self.symbols.spaces.plain(&key, name.span) {
            return units.get(&key).copied();
        }
        let found = self.symbols.spaces.resolve(&key, name.span, &|k| units.contains_key(k));
        units.get(found.first()?).copied()
    }

    /// The global variable that a name stands for at its place.
    pub(super) fn global_id(&self, name: &ast::Name) -> Option<GlobalId> {
        let (globals, key) = (&self.symbols.globals, name.key());
        let resource = self.scope.resource.filter(|_| !self.symbols.resource_globals.is_empty());
        if let Some(own) = resource.and_then(|r| self.visible(r, &key)) {
            return Some(own);
        }
        let known = |k: &str| globals.get(k).copied().filter(|id| resource.is_none() || self.hir.globals[*id].resource.is_none());
        if self.symbols.spaces.plain(&key, name.span) {
            return known(&key);
        }
        let found = self.symbols.spaces.resolve(&key, name.span, &|k| known(k).is_some());
        known(found.first()?)
    }

    /// Reports a name that two USINGs import, or one of an INTERNAL namespace elsewhere.
    pub(super) fn check_unit_use(&mut self, name: &ast::Name) {
        let (units, spaces, key) = (&self.symbols.units, &self.symbols.spaces, name.key());
        if spaces.plain(&key, name.span) && spaces.known.is_empty() {
            return;
        }
        let found = spaces.resolve(&key, name.span, &|k| units.contains_key(k));
        if let [one, other, ..] = found.as_slice() {
            let places = [one, other].map(|k| units.get(k).map_or(name.span, |u| u.1));
            self.report_ambiguous(name, one, places);
        }
        for path in found.first().map(String::as_str).into_iter().flat_map(enclosing) {
            if !self.check_internal(path, name.span) {
                return;
            }
        }
    }

    fn report_ambiguous(&mut self, name: &ast::Name, one: &str, [first, second]: [Span; 2]) {
        let space = one.strip_suffix(&name.key()).unwrap_or_default();
        let shown = self.symbols.spaces.known.get(space).map_or(space.trim_end_matches('.'), |k| &k.0);
        let help = format!("write which one is meant, for example {shown}.{}", name.text);
        let diag = Diag::new(Code::AmbiguousName, name.span, "found in more than one place");
        self.report(diag.also(first, "one").also(second, "another").help(help));
    }

    /// False and a report if the namespace is INTERNAL to one that does not enclose the place.
    fn check_internal(&mut self, path: &str, span: Span) -> bool {
        let spaces = &self.symbols.spaces;
        let Some((shown, Some(declared))) = spaces.known.get(path) else { return true };
        let outer = enclosing(path).nth(1).unwrap_or_default();
        let fine = spaces.path(spaces.at(span)).0.starts_with(outer);
        if !fine {
            let outer = spaces.known.get(outer).map_or("", |k| &k.0);
            let label = format!("`{shown}` is INTERNAL to `{outer}`");
            let diag = Diag::new(Code::InternalNamespace, span, label).also(*declared, "declared");
            self.report(diag.help("use it inside of the namespace around it, or remove INTERNAL"));
        }
        fine
    }

    /// `a.b.c` as one name, if `a` is no variable of the unit and may be a namespace or a list of globals.
    pub(super) fn qualified(&self, e: &ast::Expr) -> Option<ast::Name> {
        let mut parts = Vec::new();
        let mut root = e;
        while let ast::ExprKind::Member(base, name) = &root.kind {
            parts.push(name);
            root = base;
        }
        let ast::ExprKind::Name(first) = &root.kind else { return None };
        let head = first.key();
        let known = self.symbols.spaces.heads.contains(head.trim_start_matches('.')) && self.local(&head).is_none();
        if !known || parts.is_empty() {
            return None;
        }
        let text = parts.iter().rev().fold(first.text.clone(), |text, part| text + "." + &part.text);
        Some(ast::Name { text, span: e.span })
    }

    /// The callee with the namespaces in front of it made one name, if it is that of a type or unit.
    pub(super) fn qualified_callee(&self, callee: &ast::Expr) -> Option<ast::Expr> {
        let name = self.qualified(callee)?;
        self.unit(&name)?;
        Some(ast::Expr { kind: ast::ExprKind::Name(name), span: callee.span })
    }

    /// True if an enumerator of this type may be written without the type's name: its short name means this type here.
    pub(super) fn is_visible(&self, index: usize, span: Span) -> bool {
        let decl = &self.symbols.types[index].decl.name;
        if self.symbols.spaces.list.is_empty() {
            return true;
        }
        let here = ast::Name { text: decl.text.clone(), span };
        matches!(self.unit(&here), Some((Unit::Type(i), _)) if i == index)
    }
}

fn using(item: &ast::Item) -> Option<&Vec<ast::Name>> {
    if let ast::Item::Using(names) = item { Some(names) } else { None }
}
