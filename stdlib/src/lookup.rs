//! From a name in a program to a standard function: overloaded, typed (`ADD_INT`) and conversion (`INT_TO_REAL`, `TO_REAL`) names.
//! Names are taken apart, not listed. From: library reference §1, §2.1, §2.6.

use crate::catalog::{Function, Pattern, functions};
use std::collections::HashMap;
use std::sync::LazyLock;
use takt_image::{Elementary, Generic};

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
        /// Source; `None`: the argument's type. The caller then asks [`converts`] or [`truncates`].
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

impl ConversionType {
    /// All ends.
    pub fn all() -> impl Iterator<Item = ConversionType> {
        Elementary::ALL.iter().map(|&e| Self::Elementary(e)).chain([Self::String, Self::WString])
    }
    /// `INT`, `STRING`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Elementary(e) => e.name(),
            Self::String => "STRING",
            Self::WString => "WSTRING",
        }
    }
    /// From the standard's name or its long form, in any case.
    pub fn from_name(name: &str) -> Option<Self> {
        if name.eq_ignore_ascii_case("STRING") {
            return Some(Self::String);
        }
        if name.eq_ignore_ascii_case("WSTRING") {
            return Some(Self::WString);
        }
        Elementary::from_name(name).map(Self::Elementary)
    }
    /// STRING or WSTRING.
    pub const fn is_string(self) -> bool {
        matches!(self, Self::String | Self::WString)
    }
}

/// Overloaded names.
static BY_NAME: LazyLock<HashMap<&'static str, &'static Function>> =
    LazyLock::new(|| functions().map(|function| (function.name, function)).collect());

/// Finds a standard function; case does not matter. Conversions that the standard does not have are `None`.
pub fn lookup(name: &str) -> Option<Found> {
    let name = canonical(name)?;
    if let Some(function) = BY_NAME.get(name.as_str()) {
        return Some(Found::Function { function, fixed: None });
    }
    conversion(&name).or_else(|| typed(&name))
}

/// Longest name that is looked at.
const NAME_MAX: usize = 64;

/// Upper case, with the short names of types.
fn canonical(name: &str) -> Option<String> {
    if name.len() > NAME_MAX || !name.is_ascii() {
        return None;
    }
    Some(name.to_ascii_uppercase().replace("DATE_AND_TIME", "DT").replace("TIME_OF_DAY", "TOD"))
}

/// `SIN_LREAL`: the suffix must be in the group of T. The suffix of TRUNC names its result, which makes it a conversion.
fn typed(name: &str) -> Option<Found> {
    let (base, suffix) = name.rsplit_once('_')?;
    let function = BY_NAME.get(base)?;
    let ty = Elementary::from_name(suffix)?;
    if matches!(function.result, Pattern::Own(_)) {
        return None;
    }
    ty.is_in(function.group()?).then_some(Found::Function { function, fixed: Some(ty) })
}

/// `X_TO_Y`, `TO_Y`, `X_TRUNC_Y`, `TRUNC_Y`.
fn conversion(name: &str) -> Option<Found> {
    for (word, truncate) in [("TO_", false), ("TRUNC_", true)] {
        let Some(at) = name.rfind(word) else { continue };
        let Some(to) = ConversionType::from_name(&name[at + word.len()..]) else { continue };
        let from = match &name[..at] {
            "" => None,
            source => Some(ConversionType::from_name(source.strip_suffix('_')?)?),
        };
        let known = match from {
            Some(from) if truncate => truncates(from, to),
            Some(from) => converts(from, to),
            None => ConversionType::all().any(|from| if truncate { truncates(from, to) } else { converts(from, to) }),
        };
        return known.then_some(Found::Conversion { from, to, truncate });
    }
    None
}

/// True if `from_TRUNC_to` exists: a real to an integer.
pub fn truncates(from: ConversionType, to: ConversionType) -> bool {
    use ConversionType::Elementary as E;
    matches!((from, to), (E(from), E(to)) if from.is_real() && to.is_int())
}

/// True if `from_TO_to` exists, identity included.
pub fn converts(from: ConversionType, to: ConversionType) -> bool {
    use ConversionType::Elementary as E;
    match (from, to) {
        (E(from), E(to)) => from == to || elementary_converts(from, to),
        _ => true, // to and from strings everything converts
    }
}

/// The table of §2.1. Between a real and a bit string of another width only the vendors convert: see [`transfers_bits`].
fn elementary_converts(from: Elementary, to: Elementary) -> bool {
    let number = |t: Elementary| t.is_int() || t.is_bit();
    if from.is_char() || to.is_char() {
        return char_converts(from, to);
    }
    if from.is_date() && to.is_date() {
        return date_converts(from, to);
    }
    if from.is_duration() && to.is_duration() {
        return true;
    }
    let scalar = |t: Elementary| number(t) || t.is_real();
    scalar(from) || scalar(to)
}

/// True between a real and a bit string. In the standard their bits are the same, so they must be of one width; the vendors convert
/// the number (§2.1, row f).
pub fn transfers_bits(from: Elementary, to: Elementary) -> bool {
    let bits = |t: Elementary| t.is_bit() && t != Elementary::Bool;
    from.is_real() && bits(to) || bits(from) && to.is_real()
}

/// Characters convert to each other and to bit strings that hold their code; BYTE and WORD back.
fn char_converts(from: Elementary, to: Elementary) -> bool {
    use Elementary as E;
    match (from, to) {
        (E::Char | E::Wchar, E::Char | E::Wchar) | (E::Byte, E::Char) | (E::Word, E::Wchar) => true,
        (E::Char | E::Wchar, _) => to.is_in(Generic::AnyBit) && to != E::Bool && to.bytes() >= from.bytes(),
        _ => false,
    }
}

/// Row j: short and long form of the same, an instant to its date or time of day, a date to its midnight.
fn date_converts(from: Elementary, to: Elementary) -> bool {
    use Elementary as E;
    matches!(
        (from, to),
        (E::Dt | E::Ldt, _) | (E::Date | E::Ldate, E::Date | E::Ldate | E::Dt | E::Ldt) | (E::Tod | E::Ltod, E::Tod | E::Ltod)
    )
}
