//! The machine-level form of a program: its data ([`model`]), its text ([`text`]), its rules ([`mod@verify`]) and its meaning
//! ([`interpret`]).

pub mod interpret;
mod loops;
pub mod lower;
pub mod model;
pub mod ops;
pub mod promote;
pub mod region;
pub mod text;
mod uses;
pub mod verify;

pub use interpret::Interpreter;
pub use lower::{Lowered, lower};
pub use verify::{Problem, verify};
