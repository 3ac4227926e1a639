//! Source text to trees. Never fails: what is wrong is reported and marked as an error node.

pub mod ast;
