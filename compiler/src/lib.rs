//! From source text to an image.

pub mod codegen;
pub mod driver;
pub mod hir;
pub mod mir;
pub mod syntax;
