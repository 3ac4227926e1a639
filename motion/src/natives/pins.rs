//! Pins of a function block, and the ST text that declares it.

use super::{Core, Frame};
use std::fmt::Write;

/// Where a pin stands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Section {
    /// VAR_IN_OUT
    InOut,
    /// VAR_INPUT
    Input,
    /// VAR_OUTPUT
    Output,
    /// VAR: the memory of the block itself.
    Private,
}

/// One pin.
#[derive(Clone, Copy, Debug)]
pub struct Pin {
    /// Name.
    pub name: &'static str,
    /// Type as in ST.
    pub ty: &'static str,
    /// Section.
    pub section: Section,
    /// Initial value in ST; empty: that of the type.
    pub init: &'static str,
}

/// A function block.
#[derive(Clone, Copy)]
pub struct Block {
    /// Name.
    pub name: &'static str,
    /// What it does, for the declaration.
    pub doc: &'static str,
    /// Pins; their order is that of the block's `P`.
    pub pins: &'static [Pin],
    /// One call. Runs: cyclic.
    pub call: fn(&mut Core, &mut Frame),
}

/// Declares the pins of a block once: `P` numbers them, `BLOCK` describes them.
#[macro_export]
#[doc(hidden)]
macro_rules! block {
    ($(#[doc = $doc:literal])* $name:literal, $call:path; $($section:ident $pin:ident : $ty:literal $(= $init:literal)?;)*) => {
        /// Numbers of the pins.
        #[derive(Clone, Copy)]
        #[allow(missing_docs)]
        pub enum P { $($pin,)* }
        impl From<P> for usize {
            fn from(p: P) -> usize {
                p as usize
            }
        }
        /// The block.
        pub const BLOCK: $crate::natives::Block = $crate::natives::Block {
            name: $name,
            doc: concat!($($doc, "\n",)*),
            pins: &[$($crate::natives::Pin {
                name: stringify!($pin),
                ty: $ty,
                section: $crate::natives::Section::$section,
                init: concat!($($init)?),
            },)*],
            call: $call,
        };
    };
}

impl Block {
    /// The declaration: an external function block with an empty body.
    pub fn declaration(&self) -> String {
        let mut out = String::new();
        for line in self.doc.lines() {
            let _ = writeln!(out, "//{line}");
        }
        let _ = writeln!(out, "{{external}}\nFUNCTION_BLOCK {}", self.name);
        for (section, word) in [
            (Section::InOut, "VAR_IN_OUT"),
            (Section::Input, "VAR_INPUT"),
            (Section::Output, "VAR_OUTPUT"),
            (Section::Private, "VAR"),
        ] {
            let pins: Vec<_> = self.pins.iter().filter(|p| p.section == section).collect();
            if pins.is_empty() {
                continue;
            }
            let _ = writeln!(out, "    {word}");
            for pin in pins {
                let init = if pin.init.is_empty() { String::new() } else { format!(" := {}", pin.init) };
                let _ = writeln!(out, "        {} : {}{init};", pin.st_name(), pin.ty);
            }
            let _ = writeln!(out, "    END_VAR");
        }
        out + "END_FUNCTION_BLOCK\n\n"
    }
}

impl Pin {
    /// Name in ST: what belongs to the block itself starts with an underscore.
    pub fn st_name(&self) -> String {
        let mark = if self.section == Section::Private { "_" } else { "" };
        format!("{mark}{}", self.name)
    }
}
