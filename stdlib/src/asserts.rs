//! What the assertions of a program found: how often each outcome, and the first failures as raw bits.
//! Runs: [`AssertLog::new`] and the questions in the background, [`AssertLog::note`] cyclic: its memory is taken beforehand, and words
//! are made of a failure after the scan.

use std::cell::RefCell;
use std::rc::Rc;
use takt_base::Nanos;

/// Failures that are kept; later ones are only counted.
pub const FAILURES_MAX: usize = 64;
/// Bytes of a text that are kept.
pub const TEXT_MAX: usize = 160;

/// A log that the natives and its reader share.
pub type Asserts = Rc<RefCell<AssertLog>>;

/// What an assertion compares.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Check {
    Eq,
    Ne,
    Lt,
    Le,
    Gt,
    Ge,
    /// |expected - actual| <= tolerance
    Near,
}

impl Check {
    /// All of them.
    pub const ALL: [Check; 7] = [Check::Eq, Check::Ne, Check::Lt, Check::Le, Check::Gt, Check::Ge, Check::Near];

    /// `EQ`.
    pub const fn name(self) -> &'static str {
        match self {
            Check::Eq => "EQ",
            Check::Ne => "NE",
            Check::Lt => "LT",
            Check::Le => "LE",
            Check::Gt => "GT",
            Check::Ge => "GE",
            Check::Near => "NEAR",
        }
    }
}

/// The beginning of a STRING or WSTRING.
#[derive(Clone, Copy, Debug)]
pub struct Text {
    bytes: [u8; TEXT_MAX],
    len: usize,
    /// Two bytes a character.
    pub wide: bool,
    /// There was more.
    pub cut: bool,
}

impl Text {
    /// Keeps what there is room for.
    pub fn new(text: &[u8], wide: bool) -> Self {
        let len = text.len().min(TEXT_MAX);
        let mut bytes = [0; TEXT_MAX];
        bytes[..len].copy_from_slice(&text[..len]);
        Self { bytes, len, wide, cut: len < text.len() }
    }
    /// As they stand in the memory.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes[..self.len]
    }
}

/// A value that was compared.
#[derive(Clone, Copy, Debug)]
pub enum Compared {
    /// A scalar, extended to 64 bits by its type.
    Scalar(u64),
    /// A string.
    Text(Text),
}

/// An assertion that did not hold.
#[derive(Clone, Copy, Debug)]
pub struct Failure {
    /// What was compared.
    pub check: Check,
    /// [`takt_image::TypeId`] of both values.
    pub ty: u32,
    /// First argument.
    pub expected: Compared,
    /// Second argument.
    pub actual: Compared,
    /// Third argument of NEAR.
    pub tolerance: u64,
    /// What the program says about it; may be empty.
    pub message: Text,
    /// Source file.
    pub file: Text,
    /// Line of the call, from 1.
    pub line: u32,
    /// Time sample of the activation.
    pub now: Nanos,
}

/// Outcomes of assertions.
#[derive(Debug)]
pub struct AssertLog {
    /// Assertions that held.
    pub passed: u64,
    /// Assertions that did not.
    pub failed: u64,
    failures: Vec<Failure>,
}

impl AssertLog {
    /// Without outcomes, with room for [`FAILURES_MAX`].
    pub fn new() -> Self {
        Self { passed: 0, failed: 0, failures: Vec::with_capacity(FAILURES_MAX) }
    }
    /// Counts an outcome. Runs: cyclic.
    pub fn note(&mut self, failure: Option<Failure>) {
        match failure {
            None => self.passed += 1,
            Some(failure) => {
                self.failed += 1;
                if self.failures.len() < self.failures.capacity() {
                    self.failures.push(failure);
                }
            }
        }
    }
    /// The first failures, in order.
    pub fn failures(&self) -> &[Failure] {
        &self.failures
    }
}

impl Default for AssertLog {
    fn default() -> Self {
        Self::new()
    }
}
