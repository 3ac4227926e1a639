//! Text form of a module: [`print()`] and [`parse`] are inverse to each other.
//!
//! ```text
//! file "pump.st"                      ; a comment
//! line 0:12                           ; defines @0: file 0, line 12
//! native SIN_LREAL (f64) -> f64
//! native MC_Power block 3             ; its instance has type 3
//!
//! func fill pou Pump frame 16 (v0: i32, v1: i8) -> i32 {
//!   i32: v2 v3                        ; the other locals by type
//!   f64: v4
//! b0:
//!   v2 = load [v0 + 8]                ; [64] is a fixed place, [frame + 8] one in the frame
//!   v3 = add v0, v2 @1                ; from here on line @1
//!   trap_if Range, v1
//!   v4 = native SIN_LREAL(v4)
//!   branch v1, b0, b1
//! b1:
//!   return v3
//! }
//! ```
//! A line number holds until the next one or the end of the function, which begins at @0. Names that are no identifiers stand in
//! quotes. Locals and blocks are numbered from 0 without gaps.

mod lex;
mod parse;
mod parse_body;
mod print;

pub use parse::{ParseError, parse};
pub use print::{print, print_function};

#[cfg(test)]
mod tests;
