//! From a written type to a type id and its default value (§2). Declared types are resolved on first use, so order does not matter.

mod array;
mod enumeration;
pub(super) mod layout;
mod open;
pub(super) mod structure;

use super::builder::Builder;
use super::constant;
use super::model::*;
use super::symbols::{State, Unit};
use crate::syntax::ast;
use takt_base::{Code, Diag, Span};
use takt_image::memory::MAX_MEMORY;
use takt_image::types::Type;
use takt_image::{Elementary, TypeId};

/// Most characters of a STRING.
pub(super) const STRING_MAX: u32 = 32767;

/// A type as it is used: an alias may have its own default value.
#[derive(Clone)]
pub(super) struct TypeUse {
    pub ty: TypeId,
    pub default: Const,
}

impl Builder<'_> {
    /// The type that stands there.
    pub fn type_ref(&mut self, t: &ast::TypeRef) -> TypeUse {
        self.deeper(t.span, |b| b.type_kind(t)).unwrap_or_else(|| self.bad_type())
    }

    /// Something wrong, already reported.
    pub fn bad_type(&self) -> TypeUse {
        TypeUse { ty: self.error, default: Const::Zero }
    }

    /// A type with the default value that belongs to it.
    pub fn plain(&self, ty: TypeId) -> TypeUse {
        TypeUse { ty, default: self.defaults.get(&ty).cloned().unwrap_or(Const::Zero) }
    }

    fn type_kind(&mut self, t: &ast::TypeRef) -> TypeUse {
        match &t.kind {
            ast::TypeRefKind::Named(name) => self.named_type(name),
            ast::TypeRefKind::String { open: true, .. } => self.misplaced_open_string(t.span),
            ast::TypeRefKind::String { wide, capacity, .. } => self.string_type(*wide, capacity.as_deref(), t.span),
            ast::TypeRefKind::Subrange { base, low, high } => self.subrange(None, base, low, high, t.span),
            ast::TypeRefKind::Array { dims, element } => self.array_type(dims, element, t.span),
            ast::TypeRefKind::Enum(decl) => self.anonymous_enum(decl),
            ast::TypeRefKind::Struct(members) => {
                let name = self.sources.text(t.span).split_whitespace().collect::<Vec<_>>().join(" ");
                self.structure(name, members, t.span, (None, None))
            }
            ast::TypeRefKind::Pointer { kind, target } => self.pointer_type(*kind, target),
            ast::TypeRefKind::Layout(layout) => {
                let name = self.sources.text(t.span).split_whitespace().collect::<Vec<_>>().join(" ");
                self.placed_structure(name, layout, t.span)
            }
            ast::TypeRefKind::OpenArray { .. } => self.misplaced_open(t.span),
            ast::TypeRefKind::Error => self.bad_type(),
        }
    }

    /// An elementary type, a declared type or a function block.
    pub fn named_type(&mut self, name: &ast::Name) -> TypeUse {
        if let Some(e) = Elementary::from_name(&name.text) {
            let ty = self.elem(e);
            return self.plain(ty);
        }
        if name.is("BIT") && self.unit(name).is_none() && self.profile(name.span).is_codesys() {
            let ty = self.bool();
            return self.plain(ty);
        }
        self.check_unit_use(name);
        match self.named_unit(name) {
            Some(Unit::Type(index)) => self.declared_type(index, name.span),
            Some(Unit::Pou(id)) => self.instance_type(id, name.span),
            None if self.is_vendor_block(name) => self.bad_type(),
            None if self.profile(name.span).is_codesys() && wide(name).is_some() => self.wide_type(name),
            None if name.is("ANY") || name.key().starts_with("ANY_") => {
                let help = "declare a function for each type, or take POINTER TO BYTE and a size (ADR and SIZEOF of the actual)";
                self.unsupported(name.span, "a parameter of a generic type", help);
                self.bad_type()
            }
            None => {
                let known = self.unit_names().into_iter().chain(Elementary::ALL.iter().map(|e| e.name().to_owned())).collect();
                self.unknown(Code::UnknownType, name, known);
                self.bad_type()
            }
        }
    }

    /// Types as wide as a pointer (vendor), which has 32 bits here.
    fn wide_type(&mut self, name: &ast::Name) -> TypeUse {
        let e = wide(name).unwrap_or(Elementary::Dword);
        let ty = self.elem(e);
        if name.is("PVOID") {
            let byte = self.elem(Elementary::Byte);
            let ty = self.pointer_to(takt_image::types::PointerKind::Pointer, byte);
            return self.plain(ty);
        }
        self.plain(ty)
    }

    fn instance_type(&mut self, id: PouId, at: Span) -> TypeUse {
        let pou = &self.hir.pous[id];
        if pou.kind == PouKind::Interface {
            return self.interface_type(id, at);
        }
        let tested = pou.kind == PouKind::Program && self.in_test();
        let program = pou.kind == PouKind::Program && self.profile(at).is_vendor();
        self.hir.programs_are_instances |= program;
        if !tested && !program && !matches!(pou.kind, PouKind::FunctionBlock | PouKind::Class) {
            let what = if pou.kind == PouKind::Program { "a PROGRAM" } else { "a FUNCTION" };
            let help = "only function blocks have instances; programs are listed in the CONFIGURATION";
            self.report(Diag::new(Code::UnknownType, at, what).message("this is not a type").help(help));
            return self.bad_type();
        }
        self.check_instantiable(id, at);
        if !self.ensure_pou(id, at) {
            let label = format!("`{}` would contain itself", self.hir.pous[id].name);
            self.error(Code::RecursiveType, at, label);
            return self.bad_type();
        }
        let ty = self.hir.pous[id].instance.unwrap_or(self.error);
        self.plain(ty)
    }

    /// A type of TYPE ... END_TYPE.
    pub fn declared_type(&mut self, index: usize, at: Span) -> TypeUse {
        let entry = &mut self.symbols.types[index];
        let decl = entry.decl;
        match entry.state {
            State::Done => return entry.result.clone().unwrap_or_else(|| self.bad_type()),
            State::Busy => {
                let label = format!("`{}` would contain itself", decl.name.text);
                self.error(Code::RecursiveType, at, label);
                return self.bad_type();
            }
            State::Pending => entry.state = State::Busy,
        }
        let outer = std::mem::take(&mut self.scope);
        let resolved = self.deeper(at, |b| b.type_body(index, decl)).unwrap_or_else(|| self.bad_type());
        self.scope = outer;
        let entry = &mut self.symbols.types[index];
        entry.state = State::Done;
        entry.result = Some(resolved.clone());
        resolved
    }

    fn type_body(&mut self, index: usize, decl: &ast::TypeDecl) -> TypeUse {
        let name = &self.full_name(&decl.name).text;
        let body = match &decl.body {
            ast::TypeBody::Ref(ast::TypeRef { kind: ast::TypeRefKind::Subrange { base, low, high }, span }) => {
                self.subrange(Some(name), base, low, high, *span)
            }
            ast::TypeBody::Ref(ast::TypeRef { kind: ast::TypeRefKind::Layout(layout), .. }) => {
                self.placed_structure(name.clone(), layout, decl.name.span)
            }
            ast::TypeBody::Ref(t) => self.type_ref(t),
            ast::TypeBody::Enum(e) => self.enumeration(name.clone(), e),
            ast::TypeBody::Struct(members) => {
                let id = self.reserved_type(index);
                self.structure(name.clone(), members, decl.name.span, (Some(id), decl.extends.as_ref()))
            }
        };
        let Some(init) = &decl.init else { return body };
        let default = self.initial(init, &body);
        // A nominal type carries its default wherever it is used; an alias only under its own name.
        if !matches!(decl.body, ast::TypeBody::Ref(_)) || matches!(self.ty(body.ty), Type::Subrange { name: n, .. } if n == name)
        {
            self.defaults.insert(body.ty, default.clone());
        }
        TypeUse { ty: body.ty, default }
    }

    fn string_type(&mut self, wide: bool, capacity: Option<&ast::Expr>, span: Span) -> TypeUse {
        let capacity = match capacity {
            None => Some(self.profile(span).string_capacity()),
            Some(e) => self.const_int(e).and_then(|n| self.capacity(n, e.span)),
        };
        let Some(capacity) = capacity else { return self.bad_type() };
        let ty = if wide { Type::WString { capacity } } else { Type::String { capacity } };
        let ty = self.hir.types.intern(ty);
        self.plain(ty)
    }

    fn capacity(&mut self, n: i128, at: Span) -> Option<u32> {
        let fits = (1..=STRING_MAX as i128).contains(&n);
        if !fits {
            let help = format!("a string holds 1 to {STRING_MAX} characters");
            self.report(Diag::new(Code::OutOfRange, at, n.to_string()).help(help));
        }
        fits.then_some(n as u32)
    }

    fn subrange(&mut self, name: Option<&str>, base: &ast::Name, low: &ast::Expr, high: &ast::Expr, at: Span) -> TypeUse {
        let Some(base) = self.subrange_base(base) else { return self.bad_type() };
        let want = self.elem(base);
        let (Some(lo), Some(hi)) = (self.const_of(low, want), self.const_of(high, want)) else { return self.bad_type() };
        if lo > hi {
            let help = "write the smaller bound first";
            self.report(Diag::new(Code::OutOfRange, at, format!("{lo} is above {hi}")).help(help));
            return self.bad_type();
        }
        let text = || format!("{} ({lo}..{hi})", base.name());
        let ty = Type::Subrange { name: name.map_or_else(text, str::to_owned), base, low: lo, high: hi };
        let ty = if name.is_some() { self.hir.types.add(ty) } else { self.hir.types.intern(ty) };
        self.defaults.insert(ty, constant::normal(Const::Int(lo)));
        self.plain(ty)
    }

    fn subrange_base(&mut self, base: &ast::Name) -> Option<Elementary> {
        let ty = self.named_type(base).ty;
        if ty == self.error {
            return None;
        }
        let found = self.elementary(ty).filter(|e| e.is_int() || e.is_bit() && self.profile(base.span).mixes_bits_and_integers());
        if found.is_none() {
            let label = self.show(ty);
            self.report(Diag::new(Code::BadOperand, base.span, label).message("a subrange needs an integer type"));
        }
        found
    }

    /// False and a report if the type would not fit into the memory of a resource.
    pub fn check_size(&mut self, bytes: u64, at: Span) -> bool {
        let fits = bytes <= MAX_MEMORY as u64;
        if !fits {
            let label = format!("{bytes} bytes; a resource has {MAX_MEMORY}");
            self.report(Diag::new(Code::TypeTooLarge, at, label).help("use smaller arrays"));
        }
        fits
    }
}

/// What a type as wide as a pointer stands for (language reference §2.1).
fn wide(name: &ast::Name) -> Option<Elementary> {
    Some(match &*name.key() {
        "__XWORD" | "PVOID" => Elementary::Dword,
        "__UXINT" => Elementary::Udint,
        "__XINT" => Elementary::Dint,
        _ => return None,
    })
}
