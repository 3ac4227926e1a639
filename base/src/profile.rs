//! Dialects of the languages: one front end, and flags where the vendors differ (language reference, section 0).
//! A profile is a property of a source file: a project may mix them.

/// A dialect.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Profile {
    /// IEC 61131-3 edition 3 as it stands.
    #[default]
    Std,
    /// CODESYS 3 and TwinCAT 3.
    Codesys,
    /// CODESYS 2, with its `.EXP` exports.
    Codesys2,
    /// MATIEC, Beremiz and the OpenPLC editor.
    OpenPlc,
}

impl Profile {
    /// All of them.
    pub const ALL: [Profile; 4] = [Profile::Std, Profile::Codesys, Profile::Codesys2, Profile::OpenPlc];

    /// As the command line and `takt.toml` write it.
    pub const fn name(self) -> &'static str {
        match self {
            Profile::Std => "std",
            Profile::Codesys => "codesys",
            Profile::Codesys2 => "codesys2",
            Profile::OpenPlc => "openplc",
        }
    }

    /// The profile of this name.
    pub fn from_name(name: &str) -> Option<Profile> {
        Profile::ALL.into_iter().find(|p| p.name() == name)
    }

    /// What to do about a form that only CODESYS has: the help text of [`crate::Code::VendorForm`].
    pub const CODESYS_HELP: &'static str =
        "CODESYS has this form: give the file that profile with `--profile codesys`, or `profile = \"codesys\"` in takt.toml";

    /// CODESYS of any version: pointers, bit access to integers, `S=`, free mixing of bit strings and integers, and so on.
    pub const fn is_codesys(self) -> bool {
        matches!(self, Profile::Codesys | Profile::Codesys2)
    }

    /// Any dialect but the standard itself: vendor forms that harm nobody are accepted.
    pub const fn is_vendor(self) -> bool {
        !matches!(self, Profile::Std)
    }

    /// Bit strings and integers convert implicitly, and bit strings take part in arithmetic (§2.3).
    pub const fn mixes_bits_and_integers(self) -> bool {
        self.is_codesys()
    }

    /// A unit may write its own VAR_INPUT; with a warning.
    pub const fn writes_inputs(self) -> bool {
        self.is_vendor()
    }

    /// Comments nest. MATIEC closes them at the first `*)`; CODESYS 2 files say it themselves (`@NESTEDCOMMENTS`).
    pub const fn nests_comments(self) -> bool {
        matches!(self, Profile::Std | Profile::Codesys)
    }

    /// The words that edition 3 brought (CLASS, METHOD, LDT, ...) and those of SFC are reserved (§1.3).
    pub const fn reserves_new_words(self) -> bool {
        matches!(self, Profile::Std | Profile::Codesys)
    }

    /// Two underscores in a row, and one at the end, may stand in a name (§1.2).
    pub const fn takes_any_underscores(self) -> bool {
        self.is_vendor()
    }

    /// Capacity of a STRING without a length.
    pub const fn string_capacity(self) -> u32 {
        match self {
            Profile::Std => 254,
            Profile::OpenPlc => 126,
            Profile::Codesys | Profile::Codesys2 => 80,
        }
    }

    /// Index of the first character of a string (§2.9).
    pub const fn string_index_base(self) -> u32 {
        if self.is_codesys() { 0 } else { 1 }
    }

    /// REAL to integer: halves go away from zero; otherwise to even.
    pub const fn rounds_half_away(self) -> bool {
        self.is_codesys()
    }

    /// F_TRIG pulses at its first call with CLK = FALSE.
    pub const fn f_trig_pulses_first(self) -> bool {
        !self.is_codesys()
    }

    /// A bit string is TRUE if it is not zero; in the standard if its lowest bit is set.
    pub const fn bits_to_bool_is_nonzero(self) -> bool {
        self.is_vendor()
    }

    /// DWORD to REAL and INT to DWORD convert the number; in the standard they transfer the bits.
    pub const fn converts_bits_as_numbers(self) -> bool {
        self.is_vendor()
    }

    /// Durations count milliseconds in 32 bits without a sign; otherwise nanoseconds in 64.
    pub const fn has_millisecond_time(self) -> bool {
        self.is_codesys()
    }

    /// The VAR_IN_OUT of a function block is a variable of the instance, copied in before a call and back after it; it may be read and
    /// set from outside, and a call may leave it out.
    pub const fn copies_in_outs(self) -> bool {
        matches!(self, Profile::OpenPlc)
    }

    /// CTU stops at PV and CTD at 0.
    pub const fn counters_stop_at_preset(self) -> bool {
        matches!(self, Profile::OpenPlc)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_read_back() {
        for p in Profile::ALL {
            assert_eq!(Profile::from_name(p.name()), Some(p));
        }
        assert_eq!(Profile::from_name("CODESYS"), None);
    }
}
