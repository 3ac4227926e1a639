//! Source text to trees. Never fails: what is wrong is reported and marked as an error node.
//! From: IEC 61131-3 edition 3, §6 and §7.3; profile `std`, plus vendor forms that can't be mistaken for anything else.

pub mod ast;
mod conditional;
pub mod il;
mod keyword;
mod lexer;
mod literal;
mod parser;
mod report;
pub mod silence;
pub mod test_pragma;
#[cfg(test)]
mod tests;
mod unclosed;

pub(crate) use parser::il::nearest_operator;
pub use parser::parse;
