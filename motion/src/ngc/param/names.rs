//! Names of parameters and subroutines as numbers.

use super::predefined::Predefined;
use std::collections::HashMap;

/// An interned name, lower case.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Name {
    /// Index into [`Names`].
    pub id: u32,
    /// Whose it is.
    pub kind: Kind,
}

/// Where the value of a name is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// Of the subroutine that runs.
    Local,
    /// Starts with `_`.
    Global,
    /// Shows the state; read only.
    Fixed(Predefined),
    /// A variable of the PLC program or of a configuration: asked for outside.
    Outside,
}

/// All names.
#[derive(Clone, Debug, Default)]
pub struct Names {
    map: HashMap<String, Name>,
    texts: Vec<String>,
    bytes: usize,
    outside: bool,
}

/// Names that a program may have, and bytes of all of them.
const NAMES_MAX: usize = 50_000;
const BYTES_MAX: usize = 4 << 20;

impl Names {
    /// The name for `text`.
    pub fn intern(&mut self, text: &str) -> Name {
        if let Some(&name) = self.map.get(text) {
            return name;
        }
        let lower = text.to_ascii_lowercase();
        let kind = match Predefined::named(&lower) {
            Some(predefined) => Kind::Fixed(predefined),
            None if ["_plc_", "_ini[", "_hal["].iter().any(|p| lower.starts_with(p)) => Kind::Outside,
            None if lower.starts_with('_') => Kind::Global,
            None => Kind::Local,
        };
        self.outside |= kind == Kind::Outside;
        let name = Name { id: self.texts.len() as u32, kind };
        self.texts.push(text.to_owned());
        self.bytes += text.len();
        self.map.insert(text.to_owned(), name);
        name
    }

    /// True if there is room for no other name than those that were read.
    pub fn is_full(&self) -> bool {
        self.texts.len() >= NAMES_MAX || self.bytes >= BYTES_MAX
    }

    /// True if an outside name was ever read.
    pub fn has_outside(&self) -> bool {
        self.outside
    }

    /// A name that shows the state of the interpreter.
    pub fn fixed(text: &str) -> Option<Name> {
        Predefined::named(text).map(|predefined| Name { id: u32::MAX, kind: Kind::Fixed(predefined) })
    }

    /// The name, if it was ever read.
    pub fn find(&self, text: &str) -> Option<Name> {
        self.map.get(text).copied()
    }

    /// The text with this index.
    pub fn text_of(&self, id: u32) -> &str {
        self.texts.get(id as usize).map_or("", String::as_str)
    }

    /// Its text.
    pub fn text(&self, name: Name) -> &str {
        self.texts.get(name.id as usize).map_or("", String::as_str)
    }
}
