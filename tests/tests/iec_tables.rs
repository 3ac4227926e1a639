//! The tables of `conformance/iec` on both engines: function blocks scan by scan, procedures, and values of expressions.

use std::path::Path;
use takt_base::Severity;
use takt_image::Elementary;
use takt_image::literal_time::{format_time, parse_duration, parse_time};
use takt_tests::cycle_table::{self, CYCLE_MS, CycleTable, Row};
use takt_tests::expression_table::{self, Expression};
use takt_tests::plc::{Plc, compile_st};
use takt_tests::run_time;

/// Relative tolerance of REAL outputs.
const TOLERANCE: f64 = 1e-5;

/// File name and contents of `conformance/iec/<folder>/*.md`, by name.
fn files(folder: &str) -> Vec<(String, String)> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("conformance/iec").join(folder);
    let entries = std::fs::read_dir(&path).unwrap().map(|e| e.unwrap().path());
    let read = |p: std::path::PathBuf| (p.display().to_string(), std::fs::read_to_string(&p).unwrap());
    let mut files: Vec<_> = entries.filter(|p| p.extension().is_some_and(|e| e == "md")).map(read).collect();
    files.sort();
    assert!(!files.is_empty());
    files
}

fn tables(folder: &str) -> Vec<(String, CycleTable)> {
    let read = |(file, text): (String, String)| {
        let tables = cycle_table::parse(&text).unwrap_or_else(|e| panic!("{file}: {e:?}"));
        tables.into_iter().map(move |t| (format!("{file}:{}: {}", t.line, t.block), t))
    };
    files(folder).into_iter().flat_map(read).collect()
}

#[test]
fn blocks_follow_their_tables() {
    for (place, table) in tables("blocks") {
        let constants: Vec<_> = table.constants.iter().map(|(n, v)| format!("{n} := {v}")).collect();
        let mut plc =
            Plc::new(&format!("PROGRAM p\nVAR b : {}; END_VAR\nb({});\nEND_PROGRAM\n", table.block, constants.join(", ")));
        for scan in 0..table.scans {
            for row in &table.inputs {
                set(&mut plc, &format!("p.b.{}", row.name), row, scan);
            }
            assert!(plc.scan(CYCLE_MS * scan as i64).is_ok(), "{place}, scan {scan}: a fault");
            for row in &table.outputs {
                expect(&plc.get(&format!("p.b.{}", row.name)), row, scan, &place);
            }
        }
    }
}

/// Durations and instants are written in the form of what stands in the variable.
fn set(plc: &mut Plc, path: &str, row: &Row, scan: usize) {
    let instant = plc.get(path).starts_with("DT#");
    match (row.number(scan), &row.unit) {
        (Some(ns), Some(_)) if instant => plc.set(path, &format_time(Elementary::Dt, ns as i64).unwrap()),
        (_, Some(unit)) => plc.set(path, &format!("T#{}{unit}", row.values[scan])),
        (_, None) => plc.set(path, &row.values[scan]),
    }
}

fn expect(found: &str, row: &Row, scan: usize, place: &str) {
    let wanted = row.number(scan).unwrap_or_else(|| panic!("{place}: `{}` is no number", row.values[scan]));
    let value = number(found).unwrap_or_else(|| panic!("{place}: {} is {found}", row.name));
    let fits = (value - wanted).abs() <= TOLERANCE * wanted.abs().max(1.0);
    assert!(fits, "{place}, scan {scan}: {} is {found}, {} expected", row.name, row.values[scan]);
}

/// A literal as a number; durations and instants in nanoseconds.
fn number(text: &str) -> Option<f64> {
    match text {
        "TRUE" => Some(1.0),
        "FALSE" => Some(0.0),
        _ => {
            let time = text.strip_prefix("LT#").or(text.strip_prefix("T#"));
            let instant = || parse_time(Elementary::Dt, text);
            text.parse().ok().or_else(|| time.and_then(parse_duration).or_else(instant).map(|ns| ns as f64))
        }
    }
}

#[test]
fn procedures_follow_their_tables() {
    for (place, table) in tables("procedures") {
        let inputs = table.constants.iter().map(|(n, v)| format!("{n} := {v}"));
        let outputs = table.outputs.iter().map(|row| format!("{0} => {0}", row.name));
        let names: Vec<_> = table.outputs.iter().map(|row| format!("{} : LINT;", row.name)).collect();
        let args: Vec<_> = inputs.chain(outputs).collect();
        let text = format!("PROGRAM p\nVAR {} END_VAR\n{}({});\nEND_PROGRAM\n", names.join(" "), table.block, args.join(", "));
        let mut plc = Plc::new(&text);
        plc.scans(1);
        for row in &table.outputs {
            expect(&plc.get(&format!("p.{}", row.name)), row, 0, &place);
        }
    }
}

#[test]
fn expressions_have_their_values() {
    let mut wrong = Vec::new();
    for (file, text) in files("values") {
        for row in expression_table::parse(&text).unwrap_or_else(|e| panic!("{file}: {e:?}")) {
            if let Err(why) = evaluate(&row) {
                wrong.push(format!("{file}:{}: {} : {why}", row.line, row.text));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The expression as it stands, which the compiler computes or refuses as a constant, and with its first argument in a variable, which
/// the engines compute.
fn evaluate(row: &Expression) -> Result<(), String> {
    match run(row, "", &row.text) {
        Err(why) if !["P2004", "P2011"].iter().any(|code| why.starts_with(code)) => return Err(why),
        _ => {}
    }
    let Some(opened) = run_time::open(&row.text) else { return Ok(()) };
    let text = format!("{}a{}", opened.before, opened.after);
    let attempts = opened.types.iter().map(|ty| run(row, &format!("a : {ty} := {};", opened.literal), &text));
    let mut refused = String::new();
    for attempt in attempts {
        match attempt {
            Err(why) if why.starts_with('P') => refused = why,
            result => return result.map_err(|why| format!("in a variable {why}")),
        }
    }
    Err(format!("in a variable {refused}"))
}

/// Compares the expression with the value, both assigned to variables of the row's type. Starts with a code if it does not compile.
fn run(row: &Expression, vars: &str, expression: &str) -> Result<(), String> {
    let nan = row.value == "NaN";
    let value = if nan { "x" } else { &row.value };
    let text = format!("PROGRAM p\nVAR x, w : {}; {vars} END_VAR\nx := {expression};\nw := {value};\nEND_PROGRAM\n", row.ty);
    let compilation = compile_st(&text);
    if compilation.image.is_none() {
        let first = compilation.diags.iter().find(|d| d.severity == Severity::Error);
        return Err(first.map_or_else(String::new, |d| format!("{} {}", d.code.text(), d.label)));
    }
    let mut plc = Plc::new(&text);
    plc.scans(1);
    let (found, wanted) = (plc.get("p.x"), if nan { "NaN".to_owned() } else { plc.get("p.w") });
    if found == wanted { Ok(()) } else { Err(format!("{found}, {wanted} expected")) }
}
