//! Bodies of the fuzz targets: what must hold for any bytes from outside. `fuzz/` calls them under libFuzzer, a test with random bytes.

use crate::differential::{Outcome, run};
use crate::generate::fuzzed;
use takt_base::diag::render;
use takt_base::{Severity, SourceId, Sources};
use takt_compiler::driver::{File, Project, compile};
use takt_image::encode::{decode, encode};
use takt_image::validate::validate;
use takt_motion::ngc::{Dialect, Language, Options, check};

/// Source text: the compiler ends, gives an image or an error, and each message has a place that can be shown.
pub fn st(bytes: &[u8]) {
    let file = File { name: "fuzz.st".into(), bytes: bytes.into(), library: false, profile: takt_base::Profile::Std };
    let c = compile(Project { name: "fuzz".into(), files: vec![file], attachments: vec![], interval: None, native: true });
    let refused = c.diags.iter().any(|d| d.severity == Severity::Error);
    assert_eq!(c.image.is_some(), !refused, "an image or an error");
    for diag in &c.diags {
        assert!(!render(diag, &c.sources).is_empty());
    }
    if let Some(image) = &c.image {
        assert!(validate(image).is_ok(), "the compiler's image is valid");
    }
}

/// A part program in any dialect: reading it ends, and each message has a place.
pub fn ngc(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let mut sources = Sources::new();
    sources.add("fuzz.ngc", &*text);
    for dialect in [Dialect::LinuxCnc, Dialect::FanucMill, Dialect::FanucTurn] {
        let language = Language { dialect, lenient: bytes.len() % 2 == 1, ..Language::default() };
        for diag in check(SourceId(0), &*text, Options { language, ..Options::default() }) {
            assert!(!render(&diag, &sources).is_empty());
        }
    }
}

/// A file of an image: refused, or the same bytes come out again.
pub fn image(bytes: &[u8]) {
    if let Ok(image) = decode(bytes) {
        assert!(validate(&image).is_ok(), "what is decoded is valid");
        assert_eq!(encode(&image), bytes, "the format has one form");
    }
}

/// The seed of a generated program: both engines agree on it.
pub fn seed(bytes: &[u8]) {
    let mut number = [0; 8];
    let length = bytes.len().min(8);
    number[..length].copy_from_slice(&bytes[..length]);
    let seed = u64::from_le_bytes(number);
    if let Outcome::Refused(why) | Outcome::Broken(why) = run(seed, 3) {
        panic!("seed {seed}: {why}\n{}", fuzzed(seed));
    }
}
