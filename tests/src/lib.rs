//! What the tests of the whole share: generated programs and readers of conformance tables.

pub mod generate;
pub mod random;
