//! Finds variables of the PLC program by the path behind `_plc_`: `speed`, `main.level`, `main.motor.limits[3]`, `%QX0.1`.
//! Runs: background. Case does not matter. BOOL, integers, bit strings, subranges, enumerations, REAL and LREAL are numbers.

use super::Variable;
use takt_base::Code;
use takt_image::image::Place;
use takt_image::types::Type;
use takt_image::value::VarType;
use takt_image::{Elementary as E, Image, path};

/// Why a part program can't use a variable.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct PlcError {
    /// N0070 or N0071.
    pub code: Code,
    /// What stands there.
    pub label: String,
    /// What to do.
    pub help: String,
}

/// The variables of a PLC program.
pub trait Symbols: Send + Sync {
    /// The variable of a path.
    ///
    /// # Errors
    /// There is none, or it is no number.
    fn find(&self, path: &str) -> Result<Variable, PlcError>;
}

/// Smallest and largest value of a type that is a number.
pub fn range(ty: E) -> Option<(f64, f64)> {
    Some(match ty {
        E::Bool => (0.0, 1.0),
        E::Sint => (f64::from(i8::MIN), f64::from(i8::MAX)),
        E::Int => (f64::from(i16::MIN), f64::from(i16::MAX)),
        E::Dint => (f64::from(i32::MIN), f64::from(i32::MAX)),
        E::Lint => (-9_007_199_254_740_992.0, 9_007_199_254_740_992.0),
        E::Usint | E::Byte => (0.0, f64::from(u8::MAX)),
        E::Uint | E::Word => (0.0, f64::from(u16::MAX)),
        E::Udint | E::Dword => (0.0, f64::from(u32::MAX)),
        E::Ulint | E::Lword => (0.0, 9_007_199_254_740_992.0),
        E::Real => (f64::from(f32::MIN), f64::from(f32::MAX)),
        E::Lreal => (f64::MIN, f64::MAX),
        _ => return None,
    })
}

/// Those of an image.
impl Symbols for Image {
    fn find(&self, path: &str) -> Result<Variable, PlcError> {
        let found = path::resolve(self, path).map_err(|e| PlcError {
            code: Code::UnknownPlcVariable,
            label: e.message.clone(),
            help: e.help.unwrap_or_else(|| "write the name of a global, or instance.variable".to_owned()),
        })?;
        let (ty, limits) = elementary(self, found.ty).ok_or_else(|| not_a_number(&found.name))?;
        let (low, high) = range(ty).ok_or_else(|| not_a_number(&found.name))?;
        let (low, high) = limits.map_or((low, high), |(a, b)| (low.max(a), high.min(b)));
        let offset = match found.place {
            Place::Byte(offset) | Place::Bit(offset, _) => offset,
        };
        let input = self.memory.inputs.range().contains(&(offset as usize));
        let writable = !(found.constant || found.read_only || input);
        Ok(Variable { place: found.place, ty, low, high, writable })
    }
}

/// The elementary type of a variable, and the limits of a subrange.
fn elementary(image: &Image, ty: VarType) -> Option<(E, Option<(f64, f64)>)> {
    match ty {
        VarType::Direct(e) => Some((e, None)),
        VarType::Declared(id) => match image.types.try_get(id)? {
            Type::Elementary(e) | Type::Enum { base: e, .. } => Some((*e, None)),
            Type::Subrange { base, low, high, .. } => Some((*base, Some((*low as f64, *high as f64)))),
            _ => None,
        },
    }
}

fn not_a_number(name: &str) -> PlcError {
    PlcError {
        code: Code::PlcVariableType,
        label: format!("`{name}` is no number"),
        help: "a part program can use BOOL, integers, bit strings, REAL and LREAL; copy the value to such a variable".to_owned(),
    }
}
