//! The IEC 61131-3 standard library.

pub mod catalog;
