//! From an image to something that runs: code mapped read-execute, natives bound, machine checked.
//! Runs: background, once before the first scan.

mod map;

pub use map::{CodeMap, Memory};

use takt_base::Code;
use takt_image::image::Target;
use takt_image::{BindError, Image, ImageError, NativeKind, Natives};

/// Why an image can't be started here.
#[derive(Clone, PartialEq, Debug)]
pub enum LoadError {
    /// The image is damaged or contradicts itself.
    Image(ImageError),
    /// The code is for another machine; the text says what is missing.
    Target(&'static str),
    /// The image needs a native that this controller does not have, or has with another signature.
    Native {
        /// Name of the import.
        name: String,
        /// What does not fit.
        reason: BindError,
    },
    /// The system refuses memory, a timer or a signal handler: what, and the error number.
    System(&'static str, i32),
    /// An option makes no sense; the text says which.
    Option(String),
}

impl LoadError {
    /// The last call of the system failed.
    pub(crate) fn last(what: &'static str) -> Self {
        LoadError::System(what, std::io::Error::last_os_error().raw_os_error().unwrap_or(0))
    }
    /// The diagnostic code.
    pub const fn code(&self) -> Code {
        match self {
            LoadError::Native { .. } => Code::MissingNative,
            LoadError::Option(_) => Code::BadProjectFile,
            _ => Code::BadImage,
        }
    }
    /// What to do.
    pub fn help(&self) -> &'static str {
        match self {
            LoadError::Image(e) => e.help(),
            LoadError::Target(_) => "run it with `--engine interp`, or build it for this machine",
            LoadError::Native { .. } => "build the project again with this version of takt",
            LoadError::System(..) => "see whether limits of memory or signals are set for this process (`ulimit -a`)",
            LoadError::Option(_) => "mend the option",
        }
    }
}

impl std::fmt::Display for LoadError {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            LoadError::Image(e) => write!(f, "{e}"),
            LoadError::Target(missing) => f.write_str(missing),
            LoadError::Native { name, reason: BindError::Unknown } => write!(f, "this controller has no `{name}`"),
            LoadError::Native { name, reason: BindError::Mismatch(how) } => write!(f, "`{name}` does not fit: {how}"),
            LoadError::System(what, number) => write!(f, "{what}: {}", std::io::Error::from_raw_os_error(*number)),
            LoadError::Option(what) => f.write_str(what),
        }
    }
}

impl std::error::Error for LoadError {}

impl From<ImageError> for LoadError {
    fn from(e: ImageError) -> Self {
        LoadError::Image(e)
    }
}

/// An import, bound.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Bound {
    /// The number to call it by.
    pub native: u32,
    /// Slots that a call passes.
    pub slots: u32,
}

/// Binds every import of the image, in order.
pub fn bind(image: &Image, natives: &mut dyn Natives) -> Result<Vec<Bound>, LoadError> {
    let one = |import: &takt_image::NativeImport| {
        let native =
            natives.bind(import, &image.types).map_err(|reason| LoadError::Native { name: import.name.clone(), reason })?;
        let slots = match &import.kind {
            NativeKind::Function { params, .. } => params.len() as u32,
            NativeKind::Block { .. } => 1,
        };
        Ok(Bound { native, slots })
    };
    image.natives.iter().map(one).collect()
}

/// Whether this machine runs the image's code.
pub fn check_target(target: Target) -> Result<(), LoadError> {
    match target {
        Target::None => Err(LoadError::Target("the image has no machine code, only the interpreter runs it")),
        Target::X86_64V2 => x86_64_v2(),
    }
}

#[cfg(target_arch = "x86_64")]
fn x86_64_v2() -> Result<(), LoadError> {
    let known = is_x86_feature_detected!("sse3")
        && is_x86_feature_detected!("ssse3")
        && is_x86_feature_detected!("sse4.1")
        && is_x86_feature_detected!("sse4.2")
        && is_x86_feature_detected!("popcnt");
    if known { Ok(()) } else { Err(LoadError::Target("the code needs a processor with SSE4.2 and POPCNT (x86-64-v2)")) }
}

#[cfg(not(target_arch = "x86_64"))]
fn x86_64_v2() -> Result<(), LoadError> {
    Err(LoadError::Target("the code is for x86-64, this machine is another"))
}
