//! What the tests of the whole share: random numbers, random programs, both engines side by side, readers of conformance tables.

pub mod generate;
pub mod mir_gen;
pub mod mir_run;
pub mod rng;
