//! The machine-level form of a program: its data ([`model`]), its text ([`text`]), its rules ([`verify`]) and its meaning
//! ([`interpret`]).

pub mod interpret;
pub mod lower;
pub mod model;
pub mod ops;
pub mod text;
pub mod verify;

pub use interpret::Interpreter;
pub use lower::{Lowered, lower};
pub use verify::{Problem, verify};
