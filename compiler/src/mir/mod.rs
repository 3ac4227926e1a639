//! The machine-level form of a program. See [`model`].

pub mod model;
