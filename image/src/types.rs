//! The types of a program and their layout in memory: natural alignment, declaration order, BOOL one byte (IEC reference §3.11).
//! One home: code generator, monitor and natives read the same offsets.

use crate::elementary::Elementary;
use std::collections::HashMap;
use takt_base::index::IndexVec;

takt_base::index_type! {
    /// A type in a [`TypeTable`].
    TypeId
}

/// Name of the hidden first field of instances that hold the number of their class. No user's name: it is a keyword.
pub const CLASS_FIELD: &str = "class";

/// A type.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Type {
    /// BOOL, INT, TIME, ...
    Elementary(Elementary),
    /// STRING\[capacity\]: `capacity + 1` bytes, ended by a zero byte.
    String {
        /// Characters, without the zero.
        capacity: u32,
    },
    /// WSTRING\[capacity\]: `capacity + 1` units of 16 bits, ended by a zero unit.
    WString {
        /// Characters, without the zero.
        capacity: u32,
    },
    /// `INT (low..high)`.
    Subrange {
        /// Declared name, or the text of an anonymous one.
        name: String,
        /// Stored as.
        base: Elementary,
        /// Smallest value.
        low: i128,
        /// Largest value.
        high: i128,
    },
    /// Enumeration or named values.
    Enum {
        /// Declared name.
        name: String,
        /// Stored as; INT unless declared otherwise.
        base: Elementary,
        /// Names and values, as declared.
        values: Vec<(String, i128)>,
    },
    /// ARRAY, row-major, last subscript fastest.
    Array {
        /// Type of an element.
        element: TypeId,
        /// Bounds of each dimension.
        dims: Vec<Dim>,
    },
    /// STRUCT.
    Struct(Record),
    /// FUNCTION_BLOCK or PROGRAM instance: inputs, outputs, in-out references, variables, in declaration order of the sections.
    Instance(Record),
    /// The place of a VAR_IN_OUT, or the value of a variable of an interface type: a 32-bit offset into the resource memory.
    Reference {
        /// What it refers to.
        target: TypeId,
    },
    /// A variable that holds the place of another: a 32-bit offset into the resource memory, 0 for NULL. Code checks it at every use.
    Pointer {
        /// What it points to.
        target: TypeId,
        /// How it was declared.
        kind: PointerKind,
    },
}

/// How the place of a variable is held.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum PointerKind {
    /// `REF_TO T`: always NULL or a variable of type T.
    RefTo,
    /// `POINTER TO T` (vendor): any number.
    Pointer,
    /// `REFERENCE TO T` (vendor): another name for a variable.
    Reference,
}

impl PointerKind {
    /// All kinds.
    pub const ALL: &'static [PointerKind] = &[PointerKind::RefTo, PointerKind::Pointer, PointerKind::Reference];
    /// As the user writes it.
    pub const fn text(self) -> &'static str {
        match self {
            PointerKind::RefTo => "REF_TO",
            PointerKind::Pointer => "POINTER TO",
            PointerKind::Reference => "REFERENCE TO",
        }
    }
}

/// Inclusive bounds of an array dimension.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Dim {
    /// First index.
    pub low: i32,
    /// Last index, not below `low`.
    pub high: i32,
}

impl Dim {
    /// Number of elements.
    pub const fn len(self) -> u32 {
        (self.high as i64 - self.low as i64 + 1) as u32
    }
    /// Never true for a well-formed type.
    pub const fn is_empty(self) -> bool {
        self.len() == 0
    }
}

/// A structure or an instance.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Record {
    /// Declared name.
    pub name: String,
    /// Members with their offsets.
    pub fields: Vec<Field>,
    /// Bytes, a multiple of `align`.
    pub size: u32,
    /// Largest alignment of a member; at least 1.
    pub align: u32,
}

/// A member of a record.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Field {
    /// Name as declared.
    pub name: String,
    /// Type.
    pub ty: TypeId,
    /// Bytes from the start of the record.
    pub offset: u32,
    /// How it was declared.
    pub section: Section,
    /// Declared RETAIN.
    pub retain: bool,
}

/// What kind of member it is.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Section {
    /// Member of a STRUCT, or VAR.
    Var,
    /// VAR_INPUT.
    Input,
    /// VAR_OUTPUT.
    Output,
    /// VAR_IN_OUT; the field's type is a [`Type::Reference`].
    InOut,
    /// Made by the compiler: edge memory and the like. Not shown to the user.
    Hidden,
}

/// All types of a program. Equal types get the same [`TypeId`].
#[derive(Clone, Debug, Default)]
pub struct TypeTable {
    types: IndexVec<TypeId, Type>,
    interned: HashMap<Type, TypeId>,
}

impl PartialEq for TypeTable {
    /// The same types under the same ids; how they got there does not matter.
    fn eq(&self, other: &Self) -> bool {
        self.types == other.types
    }
}

impl TypeTable {
    /// An empty table.
    pub fn new() -> Self {
        Self::default()
    }
    /// A table of these types, in order; the first of equal types is the one that [`TypeTable::intern`] finds.
    pub fn from_types(types: Vec<Type>) -> Self {
        let mut table = Self::new();
        for ty in types {
            let id = table.types.push(ty.clone());
            table.interned.entry(ty).or_insert(id);
        }
        table
    }
    /// The id of `ty`, which is added if it is new.
    pub fn intern(&mut self, ty: Type) -> TypeId {
        if let Some(&id) = self.interned.get(&ty) {
            return id;
        }
        let id = self.types.push(ty.clone());
        self.interned.insert(ty, id);
        id
    }
    /// Adds a type without looking for an equal one: for named types, whose name is their identity.
    pub fn add(&mut self, ty: Type) -> TypeId {
        self.types.push(ty)
    }
    /// Completes a type that was added before its members were known.
    pub fn replace(&mut self, id: TypeId, ty: Type) {
        self.types[id] = ty;
    }
    /// The type.
    pub fn get(&self, id: TypeId) -> &Type {
        &self.types[id]
    }
    /// The type, or `None` for an id from elsewhere.
    pub fn try_get(&self, id: TypeId) -> Option<&Type> {
        self.types.get(id)
    }
    /// Number of types.
    pub fn len(&self) -> usize {
        self.types.len()
    }
    /// True if there are none.
    pub fn is_empty(&self) -> bool {
        self.types.is_empty()
    }
    /// All types in order.
    pub fn iter(&self) -> impl Iterator<Item = (TypeId, &Type)> {
        self.types.enumerate()
    }

    /// Size and alignment in bytes.
    pub fn layout(&self, id: TypeId) -> Layout {
        match self.get(id) {
            Type::Elementary(e) | Type::Subrange { base: e, .. } | Type::Enum { base: e, .. } => Layout::of(e.bytes(), e.bytes()),
            Type::String { capacity } => Layout::of(capacity.saturating_add(1), 1),
            Type::WString { capacity } => Layout::of(capacity.saturating_add(1).saturating_mul(2), 2),
            Type::Array { element, dims } => {
                let e = self.layout(*element);
                let count = dims.iter().fold(1u32, |n, d| n.saturating_mul(d.len()));
                Layout::of(e.size.saturating_mul(count), e.align)
            }
            Type::Struct(r) | Type::Instance(r) => Layout::of(r.size, r.align),
            Type::Reference { .. } | Type::Pointer { .. } => Layout::of(4, 4),
        }
    }

    /// Lays members out in order and gives the record its size.
    pub fn record(&self, name: impl Into<String>, members: impl IntoIterator<Item = (String, TypeId, Section, bool)>) -> Record {
        let mut record = Record { name: name.into(), fields: Vec::new(), size: 0, align: 1 };
        for (name, ty, section, retain) in members {
            let l = self.layout(ty);
            let offset = record.size.checked_next_multiple_of(l.align).unwrap_or(u32::MAX);
            record.fields.push(Field { name, ty, offset, section, retain });
            record.size = offset.saturating_add(l.size);
            record.align = record.align.max(l.align);
        }
        record.size = record.size.checked_next_multiple_of(record.align).unwrap_or(u32::MAX);
        record
    }

    /// How the user would write the type.
    pub fn display(&self, id: TypeId) -> String {
        match self.get(id) {
            Type::Elementary(e) => e.name().to_owned(),
            Type::String { capacity } => format!("STRING[{capacity}]"),
            Type::WString { capacity } => format!("WSTRING[{capacity}]"),
            Type::Subrange { name, .. } | Type::Enum { name, .. } => name.clone(),
            Type::Array { element, dims } => {
                let dims: Vec<_> = dims.iter().map(|d| format!("{}..{}", d.low, d.high)).collect();
                format!("ARRAY[{}] OF {}", dims.join(", "), self.display(*element))
            }
            Type::Struct(r) | Type::Instance(r) => r.name.clone(),
            Type::Reference { target } => self.display(*target),
            Type::Pointer { target, kind } => format!("{} {}", kind.text(), self.display(*target)),
        }
    }

    /// The elementary type that a value of this type is stored as, if it is a scalar.
    pub fn storage(&self, id: TypeId) -> Option<Elementary> {
        match self.get(id) {
            Type::Elementary(e) | Type::Subrange { base: e, .. } | Type::Enum { base: e, .. } => Some(*e),
            Type::Reference { .. } | Type::Pointer { .. } => Some(Elementary::Udint),
            _ => None,
        }
    }
}

/// Size and alignment in bytes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Layout {
    /// Bytes; saturated at `u32::MAX` for a type that is too large.
    pub size: u32,
    /// Power of two.
    pub align: u32,
}

impl Layout {
    const fn of(size: u32, align: u32) -> Self {
        Self { size, align }
    }
}

impl Record {
    /// The member of this name; case does not matter.
    pub fn field(&self, name: &str) -> Option<&Field> {
        self.fields.iter().find(|f| f.name.eq_ignore_ascii_case(name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn members_are_naturally_aligned() {
        let mut t = TypeTable::new();
        let b = t.intern(Type::Elementary(Elementary::Bool));
        let d = t.intern(Type::Elementary(Elementary::Dint));
        let s = t.intern(Type::String { capacity: 4 });
        assert_eq!(b, t.intern(Type::Elementary(Elementary::Bool)));
        let m = |n: &str, ty| (n.to_owned(), ty, Section::Var, false);
        let r = t.record("S", [m("a", b), m("b", d), m("c", s), m("d", b)]);
        assert_eq!(r.fields.iter().map(|f| f.offset).collect::<Vec<_>>(), [0, 4, 8, 13]);
        assert_eq!((r.size, r.align), (16, 4));
        let s = t.add(Type::Struct(r));
        let a = t.intern(Type::Array { element: s, dims: vec![Dim { low: -1, high: 1 }, Dim { low: 0, high: 1 }] });
        assert_eq!(t.layout(a), Layout { size: 96, align: 4 });
        assert_eq!(t.display(a), "ARRAY[-1..1, 0..1] OF S");
    }

    #[test]
    fn what_is_too_large_stays_too_large() {
        let mut t = TypeTable::new();
        let l = t.intern(Type::Elementary(Elementary::Lreal));
        let dim = Dim { low: 0, high: i32::MAX };
        let huge = t.intern(Type::Array { element: l, dims: vec![dim, dim] });
        let text = t.intern(Type::WString { capacity: u32::MAX });
        assert_eq!([huge, text].map(|id| t.layout(id).size), [u32::MAX; 2]);
        let r = t.record("S", [huge, l, text].map(|ty| ("m".to_owned(), ty, Section::Var, false)));
        assert_eq!(r.size, u32::MAX);
    }
}
