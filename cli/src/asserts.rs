//! Failed assertions in words.

use takt_image::image::Place;
use takt_image::literal_time::format_duration;
use takt_image::value::{Value, read};
use takt_image::{Elementary, TypeId, TypeTable};
use takt_stdlib::asserts::{AssertLog, Check, Compared, Failure, Text};

/// A failed assertion, ready to show.
pub struct Shown {
    /// Where the call stands.
    pub file: String,
    /// Line, from 1.
    pub line: u32,
    /// `expected 3, actual 4`.
    pub what: String,
    /// What the program says about it; may be empty.
    pub message: String,
}

impl std::fmt::Display for Shown {
    /// `expected 3, actual 4: the counter stands still`.
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let colon = if self.message.is_empty() { "" } else { ": " };
        write!(f, "{}{colon}{}", self.what, self.message)
    }
}

/// In words.
pub fn show(failure: &Failure, types: &TypeTable) -> Shown {
    let (expected, actual) = (compared(&failure.expected, failure.ty, types), compared(&failure.actual, failure.ty, types));
    let what = match failure.check {
        Check::Eq => format!("expected {expected}, actual {actual}"),
        Check::Ne => format!("expected anything but {expected}"),
        Check::Lt => format!("{expected} < {actual} does not hold"),
        Check::Le => format!("{expected} <= {actual} does not hold"),
        Check::Gt => format!("{expected} > {actual} does not hold"),
        Check::Ge => format!("{expected} >= {actual} does not hold"),
        Check::Near => {
            let tolerance = scalar(failure.tolerance, failure.ty, types);
            format!("expected {expected} within {tolerance}, actual {actual}")
        }
    };
    Shown { file: text(&failure.file), line: failure.line, what, message: text(&failure.message) }
}

/// Failed assertions of a run on stderr.
pub fn report(log: &AssertLog, types: &TypeTable) {
    for failure in log.failures() {
        let shown = show(failure, types);
        eprintln!("assertion failed, {}:{} at {}: {shown}", shown.file, shown.line, format_duration(failure.now.0));
    }
    let more = log.failed - log.failures().len() as u64;
    if more > 0 {
        eprintln!("{more} more assertions failed");
    }
}

/// A line of the summary, if the program asserts anything.
pub fn summary(log: &AssertLog) -> String {
    let (passed, failed) = (log.passed, log.failed);
    if passed + failed == 0 { String::new() } else { format!("assertions: {passed} held, {failed} failed\n") }
}

fn compared(value: &Compared, ty: u32, types: &TypeTable) -> String {
    match value {
        Compared::Scalar(bits) => scalar(*bits, ty, types),
        Compared::Text(t) => format!("{}{}", value_of(t), if t.cut { ".." } else { "" }),
    }
}

/// As an IEC literal.
fn scalar(bits: u64, ty: u32, types: &TypeTable) -> String {
    let value = read(types, &bits.to_le_bytes(), Place::Byte(0), TypeId(ty));
    let words = |e: Elementary| e.is_bit() && e != Elementary::Bool;
    match (value, types.storage(TypeId(ty))) {
        (Some(Value::Int(i)), Some(e)) if words(e) => format!("16#{i:X}"),
        (Some(value), _) => value.to_string(),
        (None, _) => format!("16#{bits:X}"),
    }
}

fn value_of(t: &Text) -> Value {
    let units = t.bytes().chunks_exact(2).map(|u| u16::from_le_bytes([u[0], u[1]]));
    if t.wide { Value::WString(units.collect()) } else { Value::String(t.bytes().to_vec()) }
}

fn text(t: &Text) -> String {
    value_of(t).as_text().unwrap_or_default()
}
