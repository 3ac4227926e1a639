//! How a value of a type is handled: in a register, as a zero-ended string, or as bytes.

use takt_image::{Elementary, Type, TypeId, TypeTable};

/// Handling of a type's values.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Shape {
    /// One register.
    Scalar(Elementary),
    /// STRING or WSTRING in memory.
    Text {
        /// Characters without the zero.
        capacity: u32,
        /// Bytes of a character.
        unit: u32,
    },
    /// Array, structure or instance in memory.
    Bytes,
}

/// Shape of a type. A reference is handled as its 32-bit offset.
pub fn shape(types: &TypeTable, ty: TypeId) -> Shape {
    match types.get(ty) {
        Type::Elementary(e) | Type::Subrange { base: e, .. } | Type::Enum { base: e, .. } => Shape::Scalar(*e),
        Type::String { capacity } => Shape::Text { capacity: *capacity, unit: 1 },
        Type::WString { capacity } => Shape::Text { capacity: *capacity, unit: 2 },
        Type::Reference { .. } | Type::Pointer { .. } => Shape::Scalar(Elementary::Udint),
        Type::Array { .. } | Type::Struct(_) | Type::Instance(_) => Shape::Bytes,
    }
}
