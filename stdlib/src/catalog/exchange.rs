//! Byte order of data that is exchanged. From: library reference §9. The controller is little-endian.

use super::Intrinsic::Move;
use super::Lowering::{Inline, Native};
use super::Pattern::T;
use super::{Function, Param, f, p};
use takt_image::Generic as G;

const VALUE: &[Param] = &[p("IN", T(G::AnyElementary))];
const ANY: &[Param] = &[p("IN", T(G::Any))];

/// The table.
pub const FUNCTIONS: &[Function] = &[
    f("TO_BIG_ENDIAN", VALUE, T(G::AnyElementary), Native, "IN with its bytes in the order most significant first"),
    f("FROM_BIG_ENDIAN", VALUE, T(G::AnyElementary), Native, "Value of bytes in the order most significant first"),
    f("TO_LITTLE_ENDIAN", ANY, T(G::Any), Inline(Move), "IN with its bytes in the order least significant first: as it is"),
    f("FROM_LITTLE_ENDIAN", ANY, T(G::Any), Inline(Move), "Value of bytes in the order least significant first: as it is"),
];
