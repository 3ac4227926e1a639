//! Words that everybody shares. No I/O, no dependencies.

pub mod diag;
pub mod index;
pub mod nearest;
pub mod profile;
pub mod ring;
pub mod source;
pub mod time;
pub mod units;

pub use diag::{Code, Diag, Severity, Sink};
pub use nearest::nearest;
pub use profile::Profile;
pub use source::{LineCol, SourceId, Sources, Span};
pub use time::Nanos;
