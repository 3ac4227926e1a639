//! The IEC 61131-3 standard library: a catalogue of functions, function blocks in ST, and natives where ST can't say it.

pub mod calendar;
pub mod catalog;
pub mod lookup;
pub mod natives;
pub mod vendor;

pub use lookup::{ConversionType, Found, lookup};
pub use natives::{Library, native_conversion, native_signature};

/// Declarations that only some projects need: file name and contents, and the profile of a file that brings them in.
pub const PRELUDE: (&str, &str, takt_base::Profile) = ("oscat.st", include_str!("../st/oscat.st"), takt_base::Profile::Codesys2);

macro_rules! sources {
    ($($file:literal)*) => {
        /// Function blocks and procedures as ST text: file name and contents. The compiler parses them before the user's files.
        pub const SOURCES: &[(&str, &str)] = &[$(($file, include_str!(concat!("../st/", $file)))),*];
    };
}

sources! {
    "bistables.st" "edges.st" "ctu.st" "ctd.st" "ctud.st" "ton.st" "tof.st" "tp.st" "rtc.st" "sema.st"
    "control.st" "split.st"
}
