//! The typed program. See [`model`].

pub mod model;
