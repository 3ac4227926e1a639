//! The architecture as rules. ARCHITECTURE.md says why; this file says it so that a change that breaks a rule fails.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Dependency arrows inside the workspace, and what a crate may use from outside.
const ARROWS: &[(&str, &[&str], &[&str])] = &[
    ("base", &[], &[]),
    ("image", &["base"], &[]),
    ("stdlib", &["base", "image"], &["libm"]),
    ("compiler", &["base", "image", "stdlib"], &["logos", "cranelift-codegen", "cranelift-frontend"]),
    ("motion", &["base", "image"], &["nom", "libm", "nalgebra"]),
    ("runtime", &["base", "image"], &["libc"]),
    ("cli", &["base", "image", "stdlib", "compiler", "motion", "runtime"], &["clap", "ctrlc", "serde", "serde_json", "toml"]),
];

/// Words that have no place on the cyclic side.
const BANNED_IN_CYCLIC: &[&str] = &[
    "Vec::new",
    "vec![",
    "Box::new",
    "String::",
    "format!",
    "to_owned()",
    "to_string()",
    "Mutex",
    "RwLock",
    "println!",
    "std::fs",
    "HashMap",
    "Instant::now",
];

/// The only files that may read a clock.
const CLOCKS: &[&str] = &["runtime/src/clock.rs"];

/// The only files that may hold `unsafe`: a prefix of the path.
const UNSAFE: &[&str] = &[
    "base/src/ring.rs",
    "runtime/src/load",
    "runtime/src/fault",
    "runtime/src/os.rs",
    "compiler/tests/",
    "runtime/tests/",
    "motion/tests/",
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Paths relative to the root and contents of all Rust files of our crates.
fn rust_files() -> BTreeMap<String, String> {
    let mut files = BTreeMap::new();
    for (krate, ..) in ARROWS {
        collect(&root().join(krate), &mut files);
    }
    collect(&root().join("tests"), &mut files);
    assert!(files.len() > 50, "the sources were not found");
    files
}

fn collect(dir: &Path, files: &mut BTreeMap<String, String>) {
    for entry in fs::read_dir(dir).unwrap().flatten() {
        let path = entry.path();
        if path.is_dir() && !path.ends_with("target") {
            collect(&path, files);
        } else if path.extension().is_some_and(|e| e == "rs") {
            let name = path.strip_prefix(root()).unwrap().to_string_lossy().into_owned();
            files.insert(name, fs::read_to_string(&path).unwrap());
        }
    }
}

/// The code of a file without its unit tests, which stand at its end, and without comments.
fn code(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let product = text.split("#[cfg(test)]\nmod ").next().unwrap_or(text);
    product.lines().enumerate().map(|(i, l)| (i + 1, l.split("//").next().unwrap_or("")))
}

/// Without functions called `new`: they run before the start.
fn without_set_up<'a>(lines: impl Iterator<Item = (usize, &'a str)>) -> impl Iterator<Item = (usize, &'a str)> {
    let mut inside = false;
    lines.filter(move |(_, l)| {
        inside |= l.contains("fn new(");
        let skipped = inside;
        inside &= *l != "    }";
        !skipped
    })
}

fn dependencies(krate: &str) -> Vec<String> {
    let text = fs::read_to_string(root().join(krate).join("Cargo.toml")).unwrap();
    let section = text.split("[dependencies]").nth(1).unwrap_or("").split("\n[").next().unwrap_or("");
    section.lines().filter_map(|l| l.split_once('=')).map(|(name, _)| name.trim().to_owned()).collect()
}

#[test]
fn dependency_arrows_point_down() {
    for (krate, ours, others) in ARROWS {
        for dependency in dependencies(krate) {
            let known = match dependency.strip_prefix("takt-") {
                Some(name) => ours.contains(&name),
                None => others.contains(&dependency.as_str()),
            };
            assert!(known, "{krate} may not depend on {dependency}");
        }
    }
}

#[test]
fn cranelift_is_named_in_codegen_alone() {
    for (file, text) in rust_files() {
        let inside = file.starts_with("compiler/src/codegen") || file.starts_with("tests/");
        assert!(inside || code(&text).all(|(_, l)| !l.contains("cranelift_")), "{file} names Cranelift");
    }
}

#[test]
fn only_the_clock_reads_a_clock() {
    for (file, text) in rust_files() {
        let benchmark = file.contains("/benches/") || file.contains("/tests/") || file.starts_with("cli/");
        if benchmark || CLOCKS.contains(&file.as_str()) {
            continue;
        }
        for (line, l) in code(&text) {
            assert!(!l.contains("Instant::now") && !l.contains("SystemTime::now"), "{file}:{line} reads a clock");
        }
    }
}

#[test]
fn cyclic_modules_do_not_allocate_lock_or_log() {
    let (mut checked, mut wrong) = (0, Vec::new());
    for (file, text) in rust_files() {
        let head: String = text.lines().take_while(|l| l.starts_with("//!")).collect();
        if !head.contains("Runs: cyclic") {
            continue;
        }
        checked += 1;
        for (line, l) in without_set_up(code(&text)) {
            if let Some(word) = BANNED_IN_CYCLIC.iter().find(|w| l.contains(**w)) {
                wrong.push(format!("{file}:{line} is cyclic and uses {word}"));
            }
        }
    }
    assert!(checked >= 5, "the heads of cyclic modules were not found");
    none(&wrong);
}

#[test]
fn unsafe_stands_where_it_is_allowed() {
    let mut wrong = Vec::new();
    for (file, text) in rust_files() {
        if UNSAFE.iter().any(|prefix| file.starts_with(prefix)) || file == "tests/tests/architecture.rs" {
            continue;
        }
        for (line, l) in code(&text) {
            let word =
                l.contains("unsafe {") || l.contains("unsafe fn") || l.contains("unsafe impl") || l.contains("unsafe extern");
            if word {
                wrong.push(format!("{file}:{line} is unsafe"));
            }
        }
    }
    none(&wrong);
}

#[test]
fn files_have_a_head_and_stay_short() {
    let mut wrong = Vec::new();
    for (file, text) in rust_files() {
        let unit_tests = file.ends_with("tests.rs");
        if !text.starts_with("//!") && !unit_tests {
            wrong.push(format!("{file} does not say what it is"));
        }
        let lines = text.lines().count();
        if lines > 600 {
            wrong.push(format!("{file} has {lines} lines: is it still one room with one purpose?"));
        }
    }
    none(&wrong);
}

#[test]
fn every_page_of_a_code_is_written() {
    let short = takt_base::Code::ALL.iter().filter(|c| c.page().lines().count() < 4);
    none(&short.map(|c| format!("docs/codes/{}.md says too little", c.text())).collect::<Vec<_>>());
}

/// Fails with the whole list.
fn none(wrong: &[String]) {
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
