//! Variables that the user named, or all of them, and their values.

use serde_json::{Map, Value as Json};
use takt_image::access::AccessError;
use takt_image::image::{Image, Symbol};
use takt_image::path::{Variable, resolve};
use takt_image::types::{Section, Type};
use takt_image::value::{Value, read};

/// A list of variables.
pub struct Watch {
    variables: Vec<Variable>,
}

impl Watch {
    /// The variables of a comma-separated list of paths. Commas inside of brackets belong to the path.
    pub fn paths(image: &Image, list: &str) -> Result<Self, AccessError> {
        let variables = split(list).into_iter().map(|p| resolve(image, &p)).collect::<Result<_, _>>()?;
        Ok(Self { variables })
    }

    /// All variables: globals, and those of program instances.
    pub fn all(image: &Image) -> Self {
        let paths = image.symbols.iter().flat_map(|s| expand(image, s));
        Self { variables: paths.filter_map(|p| resolve(image, &p).ok()).collect() }
    }

    /// Names in the declared spelling.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.variables.iter().map(|v| v.name.as_str())
    }

    /// Values now.
    pub fn values<'a>(&'a self, image: &'a Image, memory: &'a [u8]) -> impl Iterator<Item = Option<Value>> + 'a {
        self.variables.iter().map(|v| read(&image.types, memory, v.place, v.ty))
    }

    /// Values now, by name.
    pub fn json(&self, image: &Image, memory: &[u8]) -> Map<String, Json> {
        let values = self.values(image, memory).map(|v| v.map_or(Json::Null, |v| crate::json::value(&v)));
        self.names().map(str::to_owned).zip(values).collect()
    }
}

/// The symbol, or the members of a program instance.
fn expand(image: &Image, symbol: &Symbol) -> Vec<String> {
    let program = image.tasks.iter().flat_map(|t| &t.programs).any(|p| p.name.eq_ignore_ascii_case(&symbol.name));
    match image.types.try_get(symbol.ty) {
        Some(Type::Instance(record)) if program => {
            let shown = record.fields.iter().filter(|f| !matches!(f.section, Section::Hidden | Section::InOut));
            shown.map(|f| format!("{}.{}", symbol.name, f.name)).collect()
        }
        _ => vec![symbol.name.clone()],
    }
}

fn split(list: &str) -> Vec<String> {
    let (mut parts, mut depth) = (vec![String::new()], 0i32);
    for c in list.chars() {
        depth += i32::from(c == '[') - i32::from(c == ']');
        if c == ',' && depth == 0 {
            parts.push(String::new());
        } else if let Some(last) = parts.last_mut() {
            last.push(c);
        }
    }
    parts.retain(|p| !p.trim().is_empty());
    parts
}
