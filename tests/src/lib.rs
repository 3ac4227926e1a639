//! Conformance, architecture, simulation and end-to-end tests. Here is what they share. See ARCHITECTURE.md.

pub mod cycle_table;
pub mod expression_table;
mod markdown;
