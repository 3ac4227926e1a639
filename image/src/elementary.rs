//! The elementary types of IEC 61131-3 §6.4.2: width, range, generic group, and which converts to which without a call.
//! One home: checker, layout, library catalogue and monitor all ask here.

use crate::natives::Scalar;
use Elementary as E;

macro_rules! elementary {
    ($($name:ident $text:literal $alias:literal $bytes:literal;)*) => {
        /// An elementary type. STRING and WSTRING carry a length and are types of their own.
        #[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, PartialOrd, Ord)]
        pub enum Elementary { $(#[doc = $text] $name,)* }

        impl Elementary {
            /// All elementary types.
            pub const ALL: &'static [Elementary] = &[$(Elementary::$name,)*];
            /// The standard's name, `DINT`.
            pub const fn name(self) -> &'static str {
                match self { $(Elementary::$name => $text,)* }
            }
            /// Size in memory, which is also the alignment. BOOL is one byte, 0 or 1.
            pub const fn bytes(self) -> u32 {
                match self { $(Elementary::$name => $bytes,)* }
            }
            /// From the standard's name or its long form (`TIME_OF_DAY`), in any case.
            pub fn from_name(name: &str) -> Option<Elementary> {
                $(if name.eq_ignore_ascii_case($text) || name.eq_ignore_ascii_case($alias) { return Some(Elementary::$name); })*
                None
            }
        }
    };
}

elementary! {
    Bool "BOOL" "BOOL" 1;
    Sint "SINT" "SINT" 1;
    Int "INT" "INT" 2;
    Dint "DINT" "DINT" 4;
    Lint "LINT" "LINT" 8;
    Usint "USINT" "USINT" 1;
    Uint "UINT" "UINT" 2;
    Udint "UDINT" "UDINT" 4;
    Ulint "ULINT" "ULINT" 8;
    Real "REAL" "REAL" 4;
    Lreal "LREAL" "LREAL" 8;
    Time "TIME" "TIME" 8;
    Ltime "LTIME" "LTIME" 8;
    Date "DATE" "DATE" 8;
    Ldate "LDATE" "LDATE" 8;
    Tod "TOD" "TIME_OF_DAY" 8;
    Ltod "LTOD" "LTIME_OF_DAY" 8;
    Dt "DT" "DATE_AND_TIME" 8;
    Ldt "LDT" "LDATE_AND_TIME" 8;
    Byte "BYTE" "BYTE" 1;
    Word "WORD" "WORD" 2;
    Dword "DWORD" "DWORD" 4;
    Lword "LWORD" "LWORD" 8;
    Char "CHAR" "CHAR" 1;
    Wchar "WCHAR" "WCHAR" 2;
}

/// A generic group (IEC 61131-3 §6.4.3), for signatures of library functions.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[allow(missing_docs)]
pub enum Generic {
    Any,
    AnyElementary,
    AnyMagnitude,
    AnyNum,
    AnyReal,
    AnyInt,
    AnySigned,
    AnyUnsigned,
    AnyDuration,
    AnyBit,
    AnyDate,
    AnyString,
    AnyChar,
}

impl Elementary {
    /// Number of value bits; 1 for BOOL.
    pub const fn bits(self) -> u32 {
        if matches!(self, E::Bool) { 1 } else { self.bytes() * 8 }
    }
    /// The register that holds it.
    pub const fn scalar(self) -> Scalar {
        match (self, self.bytes()) {
            (E::Real, _) => Scalar::F32,
            (E::Lreal, _) => Scalar::F64,
            (_, 1) => Scalar::I8,
            (_, 2) => Scalar::I16,
            (_, 4) => Scalar::I32,
            _ => Scalar::I64,
        }
    }
    /// SINT, INT, DINT, LINT.
    pub const fn is_signed_int(self) -> bool {
        matches!(self, E::Sint | E::Int | E::Dint | E::Lint)
    }
    /// USINT, UINT, UDINT, ULINT.
    pub const fn is_unsigned_int(self) -> bool {
        matches!(self, E::Usint | E::Uint | E::Udint | E::Ulint)
    }
    /// ANY_INT.
    pub const fn is_int(self) -> bool {
        self.is_signed_int() || self.is_unsigned_int()
    }
    /// ANY_REAL.
    pub const fn is_real(self) -> bool {
        matches!(self, E::Real | E::Lreal)
    }
    /// ANY_BIT, BOOL included.
    pub const fn is_bit(self) -> bool {
        matches!(self, E::Bool | E::Byte | E::Word | E::Dword | E::Lword)
    }
    /// ANY_DURATION.
    pub const fn is_duration(self) -> bool {
        matches!(self, E::Time | E::Ltime)
    }
    /// ANY_DATE.
    pub const fn is_date(self) -> bool {
        matches!(self, E::Date | E::Ldate | E::Tod | E::Ltod | E::Dt | E::Ldt)
    }
    /// CHAR, WCHAR.
    pub const fn is_char(self) -> bool {
        matches!(self, E::Char | E::Wchar)
    }
    /// True if the stored integer is signed: signed integers, durations and dates (i64 nanoseconds).
    pub const fn is_signed_storage(self) -> bool {
        self.is_signed_int() || self.is_duration() || self.is_date()
    }
    /// Smallest and largest value, for everything that is stored as an integer; `None` for REAL and LREAL.
    pub const fn int_range(self) -> Option<(i128, i128)> {
        if self.is_real() {
            return None;
        }
        let bits = self.bits();
        Some(if self.is_signed_storage() { (-(1 << (bits - 1)), (1 << (bits - 1)) - 1) } else { (0, (1 << bits) - 1) })
    }
    /// Membership in a generic group.
    pub const fn is_in(self, group: Generic) -> bool {
        match group {
            Generic::Any | Generic::AnyElementary => true,
            Generic::AnyMagnitude => self.is_int() || self.is_real() || self.is_duration(),
            Generic::AnyNum => self.is_int() || self.is_real(),
            Generic::AnyReal => self.is_real(),
            Generic::AnyInt => self.is_int(),
            Generic::AnySigned => self.is_signed_int(),
            Generic::AnyUnsigned => self.is_unsigned_int(),
            Generic::AnyDuration => self.is_duration(),
            Generic::AnyBit => self.is_bit(),
            Generic::AnyDate => self.is_date(),
            Generic::AnyString => false,
            Generic::AnyChar => self.is_char(),
        }
    }
    /// True if a value of `self` may stand where `to` is wanted, without a conversion call (edition 3, figure 12): always
    /// value-preserving.
    pub fn widens_to(self, to: Elementary) -> bool {
        WIDER[self as usize] & to.bit() != 0
    }
    /// The smallest type that both widen to. Where there is no smallest (INT and UINT fit DINT and REAL) an integer is preferred.
    pub fn common(self, other: Elementary) -> Option<Elementary> {
        let both = WIDER[self as usize] & WIDER[other as usize];
        let mut all = Elementary::ALL.iter().copied().filter(|t| both & t.bit() != 0);
        let first = all.next()?;
        Some(std::iter::once(first).chain(all).find(|&t| WIDER[t as usize] & both == both).unwrap_or(first))
    }
    const fn bit(self) -> u32 {
        1 << self as u32
    }
}

/// One step of the implicit conversion lattice; [`Elementary::widens_to`] takes the closure.
const WIDENINGS: &[(Elementary, Elementary)] = &[
    (E::Sint, E::Int),
    (E::Int, E::Dint),
    (E::Dint, E::Lint),
    (E::Usint, E::Uint),
    (E::Uint, E::Udint),
    (E::Udint, E::Ulint),
    (E::Usint, E::Int),
    (E::Uint, E::Dint),
    (E::Udint, E::Lint),
    (E::Int, E::Real),
    (E::Uint, E::Real),
    (E::Real, E::Lreal),
    (E::Dint, E::Lreal),
    (E::Udint, E::Lreal),
    (E::Bool, E::Byte),
    (E::Byte, E::Word),
    (E::Word, E::Dword),
    (E::Dword, E::Lword),
    (E::Time, E::Ltime),
    (E::Date, E::Ldate),
    (E::Tod, E::Ltod),
    (E::Dt, E::Ldt),
];

/// For each type the set of those that it widens to, itself included.
const WIDER: [u32; Elementary::ALL.len()] = wider();

const fn wider() -> [u32; Elementary::ALL.len()] {
    let mut sets = [0; Elementary::ALL.len()];
    let mut i = 0;
    while i < sets.len() {
        sets[i] = 1 << i;
        i += 1;
    }
    // Each round adds the sets of the next types; a path has no more steps than there are types.
    let mut round = 0;
    while round < sets.len() {
        let mut step = 0;
        while step < WIDENINGS.len() {
            let (from, to) = WIDENINGS[step];
            sets[from as usize] |= sets[to as usize];
            step += 1;
        }
        round += 1;
    }
    sets
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lattice_of_section_2_3() {
        for (a, b, common) in [
            (E::Int, E::Uint, Some(E::Dint)),
            (E::Dint, E::Udint, Some(E::Lint)),
            (E::Int, E::Real, Some(E::Real)),
            (E::Dint, E::Real, Some(E::Lreal)),
            (E::Sint, E::Usint, Some(E::Int)),
            (E::Lint, E::Ulint, None),
            (E::Lint, E::Lreal, None),
            (E::Byte, E::Word, Some(E::Word)),
            (E::Byte, E::Usint, None),
            (E::Time, E::Ltime, Some(E::Ltime)),
        ] {
            assert_eq!(a.common(b), common, "{a:?} {b:?}");
            assert_eq!(b.common(a), common, "{b:?} {a:?}");
        }
    }

    #[test]
    fn names_ranges_and_long_names() {
        assert_eq!(E::from_name("time_of_day"), Some(E::Tod));
        assert_eq!(E::Sint.int_range(), Some((-128, 127)));
        assert_eq!(E::Ulint.int_range(), Some((0, u64::MAX as i128)));
        assert_eq!(E::Bool.int_range(), Some((0, 1)));
    }
}
