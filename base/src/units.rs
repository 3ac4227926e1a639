//! Units where modules meet. Inside, one system: mm, degrees, seconds. Inches end at `ngc::block`, counts begin at `drive`.

macro_rules! unit {
    ($($(#[$meta:meta])* $name:ident),* $(,)?) => { $(
        $(#[$meta])*
        #[derive(Clone, Copy, PartialEq, PartialOrd, Debug, Default)]
        pub struct $name(pub f64);
    )* };
}

unit! {
    /// Length in millimetres.
    Mm,
    /// Feed as F says it, in millimetres a minute.
    MmPerMin,
}

/// Millimetres in an inch.
pub const MM_PER_INCH: f64 = 25.4;
