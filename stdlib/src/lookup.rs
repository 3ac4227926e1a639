//! From a name in a program to a standard function: overloaded, typed (`ADD_INT`) and conversion (`INT_TO_REAL`, `TO_REAL`) names.

use crate::catalog::Function;
use takt_image::Elementary;

/// What a name stands for.
#[derive(Clone, Copy, Debug)]
pub enum Found {
    /// A catalogue entry. `fixed` is the type of a typed name: T must be this type.
    Function {
        /// The entry.
        function: &'static Function,
        /// From the suffix.
        fixed: Option<Elementary>,
    },
    /// `INT_TO_REAL`, `TO_REAL` (`from` is `None`), `TRUNC_INT` and `REAL_TRUNC_INT` (`truncate`).
    Conversion {
        /// Source; `None`: the argument's type.
        from: Option<ConversionType>,
        /// Target.
        to: ConversionType,
        /// Toward zero instead of to nearest.
        truncate: bool,
    },
}

/// End of a conversion.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum ConversionType {
    Elementary(Elementary),
    String,
    WString,
}

/// Finds a standard function; case does not matter. Conversions that the standard does not have are `None`.
pub fn lookup(_name: &str) -> Option<Found> {
    None
}
