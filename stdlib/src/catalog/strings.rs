//! String functions; positions count from 1. From: library reference §7.

use super::Lowering::Native;
use super::Pattern::{Is, Own, T};
use super::{Function, Pattern, ext, f, p};
use takt_image::{Elementary as E, Generic as G};

const S: Pattern = T(G::AnyString);
const INT: Pattern = Own(G::AnyInt);

/// The table.
pub const FUNCTIONS: &[Function] = &[
    f("LEN", &[p("IN", S)], Is(E::Int), Native, "Number of characters"),
    f("LEFT", &[p("IN", S), p("L", INT)], S, Native, "First L characters"),
    f("RIGHT", &[p("IN", S), p("L", INT)], S, Native, "Last L characters"),
    f("MID", &[p("IN", S), p("L", INT), p("P", INT)], S, Native, "L characters from position P on"),
    ext("CONCAT", &[p("IN1", S), p("IN2", S)], S, Native, "Inputs one after the other"),
    f("INSERT", &[p("IN1", S), p("IN2", S), p("P", INT)], S, Native, "IN1 with IN2 put after position P"),
    f("DELETE", &[p("IN", S), p("L", INT), p("P", INT)], S, Native, "IN without L characters from position P on"),
    f(
        "REPLACE",
        &[p("IN1", S), p("IN2", S), p("L", INT), p("P", INT)],
        S,
        Native,
        "IN1 with L characters from position P on replaced by IN2",
    ),
    f("FIND", &[p("IN1", S), p("IN2", S)], Is(E::Int), Native, "Position of the first IN2 in IN1; 0 if there is none"),
];
