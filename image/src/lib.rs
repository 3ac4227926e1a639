//! The contract between a compiled program and its runtime. Inert data and traits; no I/O.

pub mod elementary;
pub mod engine;
pub mod image;
pub mod memory;
pub mod natives;
pub mod traps;
pub mod types;

pub use elementary::{Elementary, Generic};
pub use engine::Engine;
pub use image::Image;
pub use memory::{MemoryMap, header};
pub use natives::{BindError, Cyclic, Host, NativeCall, NativeImport, NativeKind, Natives, Scalar};
pub use traps::{Fault, Trap};
pub use types::{Type, TypeId, TypeTable};
