//! Runners of the case files: cycle tables of blocks and procedures, values of expressions.

pub mod blocks;
pub mod literals;
pub mod values;

use std::path::Path;

/// File name and contents of `conformance/iec/<folder>/*.md`, by name.
pub fn files(folder: &str) -> Vec<(String, String)> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("conformance/iec").join(folder);
    let entries = std::fs::read_dir(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let paths = entries.map(|entry| entry.unwrap().path()).filter(|path| path.extension().is_some_and(|e| e == "md"));
    let name = |path: &Path| path.file_name().unwrap().to_string_lossy().into_owned();
    let mut files: Vec<_> = paths.map(|path| (name(&path), std::fs::read_to_string(&path).unwrap())).collect();
    files.sort();
    assert!(!files.is_empty());
    files
}
