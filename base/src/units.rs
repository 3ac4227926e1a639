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
    /// Speed in millimetres a second.
    MmPerS,
    /// Acceleration in millimetres a second squared.
    MmPerS2,
}

/// Millimetres in an inch.
pub const MM_PER_INCH: f64 = 25.4;

impl From<MmPerMin> for MmPerS {
    fn from(f: MmPerMin) -> Self {
        MmPerS(f.0 / 60.0)
    }
}

impl From<MmPerS> for MmPerMin {
    fn from(v: MmPerS) -> Self {
        MmPerMin(v.0 * 60.0)
    }
}

/// A count of basic length units: the smallest length that the control can resolve (PC-10).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default, Hash)]
pub struct Blu(pub i64);
