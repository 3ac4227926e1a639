//! Values of variables: out of a memory as a tree, and into it from text. What monitors, forces, stimulus files and tests use.
//! Runs: background, but for [`Patch::apply`], which is cyclic. JSON is made by the command line from [`Value`].

use crate::access::AccessError;
use crate::elementary::Elementary as E;
use crate::image::{Image, Place};
use crate::literal::{format_lreal, format_real};
use crate::literal_time::format_time;
use crate::path::Variable;
use crate::types::{Section, Type, TypeId, TypeTable};

mod text;

/// The type of a variable: from the table, or that of a direct address, which needs no entry there.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum VarType {
    /// A declared type.
    Declared(TypeId),
    /// BOOL, BYTE, WORD, DWORD, LWORD of a direct address or a bit of a word.
    Direct(E),
}

impl From<TypeId> for VarType {
    fn from(id: TypeId) -> Self {
        VarType::Declared(id)
    }
}

/// A value. Displayed as an IEC literal.
#[derive(Clone, PartialEq, Debug)]
pub enum Value {
    /// BOOL.
    Bool(bool),
    /// An integer or bit string, or an enumeration's value without a name.
    Int(i128),
    /// REAL.
    Real(f32),
    /// LREAL.
    Lreal(f64),
    /// STRING up to its zero, or CHAR.
    String(Vec<u8>),
    /// WSTRING up to its zero, or WCHAR.
    WString(Vec<u16>),
    /// Durations and dates in nanoseconds, with their type.
    Time(E, i64),
    /// Name of an enumerator.
    Enum(String),
    /// Elements; an array of several dimensions is an array of arrays, first subscript outermost.
    Array(Vec<Value>),
    /// Members in declaration order, without hidden ones and VAR_IN_OUT.
    Struct(Vec<(String, Value)>),
    /// Where a reference points to: an offset into the memory.
    Reference(u32),
}

/// Reads a variable. `None` if it does not lie inside the memory.
pub fn read(types: &TypeTable, memory: &[u8], place: Place, ty: impl Into<VarType>) -> Option<Value> {
    match (place, ty.into()) {
        (Place::Bit(..), _) => place.bool(memory).map(Value::Bool),
        (Place::Byte(offset), VarType::Direct(e)) => elementary(memory, offset, e),
        (Place::Byte(offset), VarType::Declared(id)) => declared(types, memory, offset, id),
    }
}

fn declared(types: &TypeTable, memory: &[u8], offset: u32, id: TypeId) -> Option<Value> {
    match types.try_get(id)? {
        Type::Elementary(e) | Type::Subrange { base: e, .. } => elementary(memory, offset, *e),
        Type::Enum { base, values, .. } => {
            let value = elementary(memory, offset, *base)?;
            Some(values.iter().find(|(_, v)| Some(*v) == value.as_int()).map_or(value, |(name, _)| Value::Enum(name.clone())))
        }
        Type::String { capacity } => {
            let bytes = bytes(memory, offset, *capacity)?;
            Some(Value::String(bytes.iter().copied().take_while(|&b| b != 0).collect()))
        }
        Type::WString { capacity } => {
            let units =
                bytes(memory, offset, capacity.checked_mul(2)?)?.chunks_exact(2).map(|u| u16::from_le_bytes([u[0], u[1]]));
            Some(Value::WString(units.take_while(|&u| u != 0).collect()))
        }
        Type::Array { element, dims } => {
            let counts: Vec<u32> = dims.iter().map(|d| d.len()).collect();
            array(types, memory, offset, *element, &counts)
        }
        Type::Struct(r) | Type::Instance(r) => {
            let shown = r.fields.iter().filter(|f| !matches!(f.section, Section::Hidden | Section::InOut));
            let member =
                |f: &crate::types::Field| Some((f.name.clone(), declared(types, memory, offset.checked_add(f.offset)?, f.ty)?));
            shown.map(member).collect::<Option<_>>().map(Value::Struct)
        }
        Type::Reference { .. } | Type::Pointer { .. } | Type::Open { .. } => {
            Some(Value::Reference(u32::from_le_bytes(bytes(memory, offset, 4)?.try_into().ok()?)))
        }
    }
}

/// One dimension of an array; the elements of a dimension lie together (last subscript fastest).
fn array(types: &TypeTable, memory: &[u8], offset: u32, element: TypeId, counts: &[u32]) -> Option<Value> {
    let Some((&count, inner)) = counts.split_first() else { return declared(types, memory, offset, element) };
    let stride = inner.iter().try_fold(types.layout(element).size, |n, &c| n.checked_mul(c))?;
    let one = |i: u32| array(types, memory, offset.checked_add(i.checked_mul(stride)?)?, element, inner);
    (0..count).map(one).collect::<Option<_>>().map(Value::Array)
}

fn bytes(memory: &[u8], offset: u32, size: u32) -> Option<&[u8]> {
    memory.get(offset as usize..(offset as usize).checked_add(size as usize)?)
}

fn elementary(memory: &[u8], offset: u32, e: E) -> Option<Value> {
    let mut word = [0; 8];
    let stored = bytes(memory, offset, e.bytes())?;
    word[..stored.len()].copy_from_slice(stored);
    let raw = u64::from_le_bytes(word);
    let unused = 64 - 8 * e.bytes();
    let signed = (raw << unused) as i64 >> unused;
    Some(match e {
        E::Bool => Value::Bool(raw != 0),
        E::Real => Value::Real(f32::from_bits(raw as u32)),
        E::Lreal => Value::Lreal(f64::from_bits(raw)),
        E::Char => Value::String(vec![raw as u8]),
        E::Wchar => Value::WString(vec![raw as u16]),
        e if e.is_duration() || e.is_date() => Value::Time(e, signed),
        e if e.is_signed_storage() => Value::Int(signed.into()),
        _ => Value::Int(raw.into()),
    })
}

impl Value {
    /// As an integer, if it is one. BOOL counts as 0 and 1.
    pub fn as_int(&self) -> Option<i128> {
        match self {
            Value::Bool(b) => Some(i128::from(*b)),
            Value::Int(i) => Some(*i),
            Value::Time(_, ns) => Some(i128::from(*ns)),
            _ => None,
        }
    }
    /// The characters of a string; bytes that are not UTF-8 are Latin-1.
    pub fn as_text(&self) -> Option<String> {
        match self {
            Value::String(b) => Some(match std::str::from_utf8(b) {
                Ok(text) => text.to_owned(),
                Err(_) => b.iter().map(|&b| char::from(b)).collect(),
            }),
            Value::WString(u) => Some(String::from_utf16_lossy(u)),
            _ => None,
        }
    }
}

impl std::fmt::Display for Value {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Value::Bool(b) => f.write_str(if *b { "TRUE" } else { "FALSE" }),
            Value::Int(i) => write!(f, "{i}"),
            Value::Real(v) => f.write_str(&format_real(*v)),
            Value::Lreal(v) => f.write_str(&format_lreal(*v)),
            Value::String(_) => write!(f, "'{}'", text::escaped(&self.as_text().unwrap_or_default(), '\'')),
            Value::WString(_) => write!(f, "\"{}\"", text::escaped(&self.as_text().unwrap_or_default(), '"')),
            Value::Time(e, ns) => f.write_str(&format_time(*e, *ns).unwrap_or_default()),
            Value::Enum(name) => f.write_str(name),
            Value::Array(items) => {
                let items: Vec<_> = items.iter().map(Value::to_string).collect();
                write!(f, "[{}]", items.join(", "))
            }
            Value::Struct(members) => {
                let members: Vec<_> = members.iter().map(|(name, v)| format!("{name} := {v}")).collect();
                write!(f, "({})", members.join(", "))
            }
            Value::Reference(0) => f.write_str("NULL"),
            Value::Reference(offset) => write!(f, "16#{offset:08X}"),
        }
    }
}

/// A value ready to be written: made once from text, applied without allocation as often as needed.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Patch {
    place: Place,
    bytes: Vec<u8>,
}

impl Patch {
    /// Prepares the value that `text` stands for. Types and forms are those of [`write_text`].
    pub fn new(types: &TypeTable, place: Place, ty: impl Into<VarType>, text: &str) -> Result<Self, AccessError> {
        Ok(Self { place, bytes: text::parse(types, ty.into(), text.trim())? })
    }
    /// Prepares a value for the variable that `path` names, such as `main.speed`.
    pub fn from_path(image: &Image, path: &str, text: &str) -> Result<Self, AccessError> {
        let v = crate::path::resolve(image, path)?;
        Self::for_variable(image, &v, text)
    }
    /// Prepares a value for a variable; an access path that is READ_ONLY takes none.
    pub fn for_variable(image: &Image, v: &Variable, text: &str) -> Result<Self, AccessError> {
        if v.read_only {
            let e = AccessError::read_only(&v.name);
            return Err(e.help("declare it READ_WRITE, or write the variable by its own path"));
        }
        Self::new(&image.types, v.place, v.ty, text)
    }
    /// Writes it. A place outside of the memory is left alone. Runs: cyclic.
    pub fn apply(&self, memory: &mut [u8]) {
        match self.place {
            Place::Bit(offset, bit) => {
                let set = self.bytes.first().is_some_and(|&b| b != 0);
                if let Some(byte) = memory.get_mut(offset as usize) {
                    *byte = *byte & !(1 << (bit & 7)) | u8::from(set) << (bit & 7);
                }
            }
            Place::Byte(offset) => {
                let start = offset as usize;
                if let Some(to) = memory.get_mut(start..start.saturating_add(self.bytes.len())) {
                    to.copy_from_slice(&self.bytes);
                }
            }
        }
    }
}

/// Writes the value that `text` stands for: `TRUE`, `16#FF`, `-5`, `1.5E3`, `T#1s500ms`, `D#2024-02-29`, `TOD#07:05:03`, `'abc'`,
/// the name of an enumerator; each with or without its type's prefix. Arrays and structures are written member by member.
pub fn write_text(
    types: &TypeTable,
    memory: &mut [u8],
    place: Place,
    ty: impl Into<VarType>,
    text: &str,
) -> Result<(), AccessError> {
    Patch::new(types, place, ty, text).map(|p| p.apply(memory))
}

#[cfg(test)]
mod tests;
