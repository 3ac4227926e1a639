//! Rules about whole units and the whole program: one rule, one file.

mod bound;
mod inline_c;
mod reach;
mod recursion;
mod result;
mod section;
mod views;

use super::builder::Builder;

/// Rules that need all bodies. Runs last.
pub(super) fn all(builder: &mut Builder) {
    bound::check(builder);
    reach::mark(builder);
    views::check(builder);
    recursion::check(builder);
    inline_c::check(builder);
}
