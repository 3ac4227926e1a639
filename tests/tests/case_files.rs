//! The case files of the library can be read, name what the library has, and leave no block out.

use std::collections::BTreeSet;
use std::path::Path;
use takt_base::Profile;
use takt_stdlib::{Found, SOURCES, lookup, vendor};
use takt_tests::{cycle_table, expression_table};

/// File name and contents of `conformance/iec/<folder>/*.md`, by name.
fn files(folder: &str) -> Vec<(String, String)> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("conformance/iec").join(folder);
    let mut files: Vec<_> = std::fs::read_dir(&path)
        .unwrap_or_else(|e| panic!("{}: {e}", path.display()))
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "md"))
        .map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), std::fs::read_to_string(&path).unwrap()))
        .collect();
    files.sort();
    assert!(!files.is_empty());
    files
}

/// Text of a unit in the library, from its name to its end.
fn source_of(kind: &str, name: &str) -> &'static str {
    let (head, end) = (format!("\n{kind} {name}\n"), format!("END_{kind}\n"));
    let all = SOURCES.iter().map(|(_, text)| text).chain(vendor::VENDOR_SOURCES.iter().map(|(_, text, _)| text));
    let text = all.filter_map(|text| Some(text.split_once(&head)?.1)).next();
    text.and_then(|t| Some(t.split_once(&end)?.0)).unwrap_or_else(|| panic!("no {kind} {name}"))
}

/// Each table of the folder names a unit of this kind and pins that it has; each such unit has a table.
fn check_tables(folder: &str, kind: &str) {
    let mut seen = BTreeSet::new();
    for (file, text) in files(folder) {
        let profile = Profile::from_name(file.trim_end_matches(".md")).unwrap_or_default();
        for mut table in cycle_table::parse(&text).unwrap_or_else(|e| panic!("{file}: {e:?}")) {
            table.block = vendor::block(&table.block, profile).unwrap_or(table.block);
            let source = source_of(kind, &table.block);
            let constants = table.constants.iter().map(|(name, _)| name);
            for pin in constants.chain(table.inputs.iter().chain(&table.outputs).map(|row| &row.name)) {
                let pin = vendor::pin(&table.block, pin).unwrap_or(pin);
                assert!(source.contains(&format!("    {pin} : ")), "{file}:{}: {} has no {pin}", table.line, table.block);
            }
            assert!(table.scans > 0);
            seen.insert(table.block);
        }
    }
    let head = format!("{kind} ");
    for unit in SOURCES.iter().flat_map(|(_, text)| text.lines()).filter_map(|line| line.strip_prefix(&head)) {
        assert!(seen.contains(unit), "no table for {unit}");
    }
}

#[test]
fn every_table_fits_its_block() {
    check_tables("blocks", "FUNCTION_BLOCK");
}

#[test]
fn every_table_fits_its_procedure() {
    check_tables("procedures", "FUNCTION");
}

/// Words before an opening parenthesis are functions of the library.
#[test]
fn every_expression_calls_what_there_is() {
    let mut called = 0;
    for (file, text) in files("values") {
        for case in expression_table::parse(&text).unwrap_or_else(|e| panic!("{file}: {e:?}")) {
            for (before, _) in case.text.match_indices('(').map(|(i, _)| case.text.split_at(i)) {
                let name = before.rsplit(|c: char| !c.is_ascii_alphanumeric() && c != '_').next().unwrap_or_default();
                let found = lookup(name).unwrap_or_else(|| panic!("{file}:{}: no function {name}", case.line));
                called += usize::from(matches!(found, Found::Function { .. }));
            }
        }
    }
    assert!(called > 100);
}
