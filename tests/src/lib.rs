//! What tests of several crates share: tables, random programs, both engines side by side, whole programs. See ARCHITECTURE.md.

pub mod cycle_table;
pub mod expression_table;
mod markdown;
pub mod mir_gen;
pub mod mir_run;
pub mod plc;
pub mod rng;
