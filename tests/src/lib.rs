//! What the tests of the whole share: random numbers, random programs, whole programs on both engines, readers of conformance tables.

pub mod cases;
pub mod cycle_table;
pub mod differential;
pub mod expression_table;
pub mod fuzz;
pub mod generate;
mod markdown;
pub mod mir_gen;
pub mod mir_run;
pub mod plc;
pub mod rng;
pub mod run_time;
pub mod timed;
pub mod workloads;
