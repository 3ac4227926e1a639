//! The natives of the library: what is neither compiled from ST nor a few instructions. Runs: binding in the background, calls cyclic.
//!
//! **Names.** A catalogue function with lowering `Native` is called `NAME_T` (`SIN_LREAL`, `LEFT_WSTRING`), without T `NAME`. A
//! conversion is called `FROM_TO_TO` with the short names of the types (`INT_TO_STRING`, `TIME_TO_DINT`); [`native_conversion`] says
//! which conversions are natives, [`native_conversion_in`] which of them a vendor has in a form of its own, with the profile behind
//! the name (`REAL_TO_STRING_CODESYS`). Helpers that stand behind inline functions are in [`helpers`].
//!
//! **Slots**, in this order: the inputs, then the place of a string result. A scalar takes one slot of its machine type (TIME, DATE
//! and the like I64, CHAR I8), an input with a pattern of its own (L, P, YEAR) one I64, a string two I32: offset and capacity.
//! CONCAT takes 2 to 14 strings. The result of every other function is a scalar. Source and target should not overlap; if they do,
//! the text may be wrong, but nothing outside of the target is written.

mod bcd;
mod conversions;
mod dates;
mod exchange;
mod from_string;
pub mod helpers;
mod literals;
mod math;
mod numbers;
mod printf;
mod strings;
mod text;
mod to_string;

use crate::catalog::{Function, Lowering, Pattern, functions};
use crate::lookup::ConversionType;
pub use conversions::{native_conversion, native_conversion_in};
use takt_base::Profile;
use takt_image::natives::MAX_SLOTS;
use takt_image::{BindError, Elementary, Generic, NativeCall, NativeImport, NativeKind, Natives, Scalar, Trap, TypeTable};

/// Code of a native. The types are T, or the two ends of a conversion.
pub(crate) type Run = fn(&mut NativeCall, Types) -> Result<(), Trap>;

/// What a native works on: for a function both are T.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Types {
    from: ConversionType,
    to: ConversionType,
    /// Dialect whose rules it follows.
    profile: Profile,
}

impl Types {
    const fn both(ty: ConversionType) -> Self {
        Self { from: ty, to: ty, profile: Profile::Std }
    }
}

/// The natives that an image has bound.
#[derive(Default)]
pub struct Library {
    bound: Vec<(Run, Types)>,
}

impl Library {
    /// With nothing bound.
    pub fn new() -> Self {
        Self::default()
    }
}

impl Natives for Library {
    fn bind(&mut self, import: &NativeImport, _types: &TypeTable) -> Result<u32, BindError> {
        let native = find(&import.name).ok_or(BindError::Unknown)?;
        native.check(import)?;
        self.bound.push((native.run, native.types));
        Ok(self.bound.len() as u32 - 1)
    }

    fn call(&mut self, native: u32, call: &mut NativeCall) -> Result<(), Trap> {
        let &(run, types) = self.bound.get(native as usize).ok_or(Trap::NativePanic)?;
        run(call, types)
    }
}

/// Signature of the native of this name, in upper case; `None` if the library has none. CONCAT is given with two inputs.
pub fn native_signature(name: &str) -> Option<NativeKind> {
    find(name).map(|native| native.kind())
}

/// A native before it is bound.
struct Native {
    params: Vec<Scalar>,
    result: Option<Scalar>,
    /// CONCAT: any number of strings.
    extensible: bool,
    run: Run,
    types: Types,
}

impl Native {
    fn kind(&self) -> NativeKind {
        NativeKind::Function { params: self.params.clone(), result: self.result }
    }

    fn check(&self, import: &NativeImport) -> Result<(), BindError> {
        let fits = match &import.kind {
            NativeKind::Function { params, result } if self.extensible => {
                *result == self.result
                    && params.len() % 2 == 0
                    && (self.params.len()..=MAX_SLOTS).contains(&params.len())
                    && params.iter().all(|&p| p == Scalar::I32)
            }
            kind => *kind == self.kind(),
        };
        if fits {
            return Ok(());
        }
        Err(BindError::Mismatch(format!("{} is {:?}, not {:?}", import.name, self.kind(), import.kind)))
    }
}

/// A catalogue function, a conversion, or a helper.
fn find(name: &str) -> Option<Native> {
    function(name).or_else(|| conversions::find(name)).or_else(|| helpers::find(name))
}

/// The native of a catalogue function.
fn function(name: &str) -> Option<Native> {
    let native = |f: &&Function| f.lowering == Lowering::Native;
    if let Some(function) = functions().filter(native).find(|f| f.name == name) {
        return function.group().is_none().then(|| of_function(function, Types::both(NO_TYPE)))?;
    }
    let (base, suffix) = name.rsplit_once('_')?;
    let function = functions().filter(native).find(|f| f.name == base)?;
    let ty = ConversionType::from_name(suffix)?;
    let fits = match ty {
        ConversionType::Elementary(e) => e.is_in(function.group()?),
        _ => matches!(function.group()?, Generic::AnyString | Generic::AnyElementary),
    };
    if fits { of_function(function, Types::both(ty)) } else { None }
}

/// Stands for T in a function that has none.
const NO_TYPE: ConversionType = ConversionType::Elementary(Elementary::Lint);

/// The signature follows from the catalogue.
fn of_function(function: &Function, types: Types) -> Option<Native> {
    let run = RUNS.iter().flat_map(|group| group.iter()).find(|(name, _)| *name == function.name)?.1;
    let mut params = Vec::new();
    for param in function.params {
        push(&mut params, param.ty, types.from);
    }
    let result = result(&mut params, function.result, types.to);
    Some(Native { params, result, extensible: function.extensible, run, types })
}

/// Code of the catalogue functions.
const RUNS: &[&[(&str, Run)]] = &[math::RUNS, strings::RUNS, dates::RUNS, bcd::RUNS, exchange::RUNS];

/// The type that a pattern stands for.
fn resolve(pattern: Pattern, ty: ConversionType) -> ConversionType {
    match pattern {
        Pattern::Is(e) => ConversionType::Elementary(e),
        Pattern::T(_) => ty,
        Pattern::Own(_) => ConversionType::Elementary(Elementary::Lint),
    }
}

fn push(params: &mut Vec<Scalar>, pattern: Pattern, ty: ConversionType) {
    match resolve(pattern, ty) {
        ConversionType::Elementary(e) => params.push(e.scalar()),
        _ => params.extend([Scalar::I32, Scalar::I32]),
    }
}

/// A scalar result, or two more slots for a string.
fn result(params: &mut Vec<Scalar>, pattern: Pattern, ty: ConversionType) -> Option<Scalar> {
    match resolve(pattern, ty) {
        ConversionType::Elementary(e) => Some(e.scalar()),
        _ => {
            params.extend([Scalar::I32, Scalar::I32]);
            None
        }
    }
}
