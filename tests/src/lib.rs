//! What tests of several crates share: random numbers, random programs, both engines side by side. See ARCHITECTURE.md.

pub mod mir_gen;
pub mod mir_run;
pub mod plc;
pub mod rng;
