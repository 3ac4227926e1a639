//! The contract between a compiled program and its runtime. Inert data and traits; no I/O.

pub mod access;
mod crc;
mod decode;
pub mod elementary;
pub mod encode;
#[cfg(test)]
mod encode_tests;
pub mod engine;
pub mod image;
pub mod literal;
pub mod literal_time;
pub mod memory;
pub mod natives;
pub mod path;
pub mod retain;
pub mod traps;
pub mod types;
pub mod validate;
pub mod value;

pub use access::AccessError;
pub use elementary::{Elementary, Generic};
pub use encode::{ImageError, decode, encode};
pub use engine::Engine;
pub use image::Image;
pub use memory::{MemoryMap, header};
pub use natives::{BindError, Cyclic, Host, NativeCall, NativeImport, NativeKind, Natives, Scalar};
pub use traps::{Fault, Trap};
pub use types::{CLASS_FIELD, Type, TypeId, TypeTable};
pub use value::{Patch, Value, VarType};
