//! What vendors have under the names of standard blocks, and names that they have besides. The profile of the file that names the
//! block decides. From: library reference §10.

use takt_base::Profile;

macro_rules! source {
    ($file:literal, $profile:ident) => {
        ($file, include_str!(concat!("../st/", $file)), Profile::$profile)
    };
}

/// Blocks of vendors as ST text: file name, contents, and the profile that they are written in. See [`has_source`].
pub const VENDOR_SOURCES: &[(&str, &str, Profile)] = &[
    source!("codesys.st", Codesys),
    source!("openplc_ctu.st", OpenPlc),
    source!("openplc_ctd.st", OpenPlc),
    source!("openplc_ctud.st", OpenPlc),
    source!("openplc_sema.st", OpenPlc),
];

/// True if files of `profile` need a source written in `source`.
pub const fn has_source(profile: Profile, source: Profile) -> bool {
    match source {
        Profile::Codesys | Profile::Codesys2 => profile.is_codesys(),
        Profile::OpenPlc => matches!(profile, Profile::OpenPlc),
        Profile::Std => true,
    }
}

/// The block that stands for this name, in upper case, in a file of the profile; `None` if it is the one of that name.
pub fn block(name: &str, profile: Profile) -> Option<String> {
    match name {
        "LTP" | "LTON" | "LTOF" if profile.is_codesys() => Some(format!("{}_LTIME", &name[1..])),
        "F_TRIG" if !profile.f_trig_pulses_first() => Some("F_TRIG_CODESYS".to_owned()),
        "RTC" if profile.is_codesys() => Some("RTC_CODESYS".to_owned()),
        "SEMA" if profile == Profile::OpenPlc => Some("SEMA_OPENPLC".to_owned()),
        _ if profile.counters_stop_at_preset() && is_counter(name) => Some(format!("{name}_OPENPLC")),
        _ => None,
    }
}

fn is_counter(name: &str) -> bool {
    let (base, ty) = name.split_once('_').unwrap_or((name, "INT"));
    matches!(base, "CTU" | "CTD" | "CTUD") && matches!(ty, "INT" | "DINT" | "LINT" | "UDINT" | "ULINT")
}

/// Position of the input that edition 2, or CODESYS, calls `input` at a standard function, both in upper case.
pub fn input(function: &str, input: &str, profile: Profile) -> Option<usize> {
    let names: &[&str] = match function {
        _ if function.starts_with("CONCAT_DATE_") => &["IN1", "IN2"],
        _ if !profile.is_codesys() => return None,
        "LEN" => &["STR"],
        "LEFT" | "RIGHT" => &["STR", "SIZE"],
        "MID" | "DELETE" => &["STR", "LEN", "POS"],
        "CONCAT" | "FIND" => &["STR1", "STR2"],
        "INSERT" => &["STR1", "STR2", "POS"],
        "REPLACE" => &["STR1", "STR2", "L", "P"],
        _ => return None,
    };
    names.iter().position(|name| *name == input)
}

/// The pin of a library block that the vendors call `pin`, both in upper case.
pub fn pin(block: &str, pin: &str) -> Option<&'static str> {
    match (block, pin) {
        ("SR", "SET1") => Some("S1"),
        ("SR", "RESET") => Some("R"),
        ("RS", "SET") => Some("S"),
        ("RS", "RESET1") => Some("R1"),
        _ => None,
    }
}
