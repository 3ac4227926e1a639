//! Runs expression tables: the expression and its value are both computed and compared as they are shown.

use super::files;
use super::literals::into_variables;
use takt_tests::expression_table::{Expression, parse};
use takt_tests::plc::Plc;

/// Types tried for whole numbers that nothing else gives a type.
const WHOLE: [&str; 5] = ["INT", "UINT", "DINT", "UDINT", "ULINT"];

/// Errors of all rows; `check` gets the file too.
pub fn check_all(check: fn(&str, &Expression) -> Result<(), String>) -> Vec<String> {
    let mut failures = Vec::new();
    let mut rows = 0;
    for (file, text) in files("values") {
        for row in parse(&text).unwrap_or_else(|e| panic!("{file}: {e:?}")) {
            rows += 1;
            failures.extend(check(&file, &row).err().map(|why| format!("{file}:{} {}: {why}", row.line, row.text)));
        }
    }
    assert!(rows > 100);
    failures
}

/// As it stands. What is out of range may be refused, since its arguments are constant.
pub fn as_written(file: &str, row: &Expression) -> Result<(), String> {
    match Plc::load(&program(row, "", &row.text)) {
        Err(_) if file == "out_of_range.md" => Ok(()),
        Err(messages) => Err(messages),
        Ok(plc) => compare(plc, row),
    }
}

/// With literals in variables.
pub fn of_variables(_: &str, row: &Expression) -> Result<(), String> {
    let real = if row.ty == "REAL" { "REAL" } else { "LREAL" };
    let mut refused = String::new();
    for whole in std::iter::once(row.ty.as_str()).chain(WHOLE) {
        for real in [real, "REAL"] {
            let (vars, text) = into_variables(&row.text, whole, real);
            match Plc::load(&program(row, &vars, &text)) {
                Ok(plc) => return compare(plc, row),
                Err(messages) => refused = messages,
            }
        }
    }
    Err(refused)
}

fn program(row: &Expression, vars: &str, text: &str) -> String {
    let (ty, value) = (&row.ty, if row.value == "NaN" { "1.0" } else { &row.value });
    let flag = if ty == "REAL" || ty == "LREAL" { "nan := x <> x;" } else { "" };
    format!("PROGRAM p VAR {vars} x, want : {ty}; nan : BOOL; END_VAR x := {text}; want := {value}; {flag} END_PROGRAM")
}

fn compare(mut plc: Plc, row: &Expression) -> Result<(), String> {
    plc.scan(0).map_err(|fault| format!("{fault:?}"))?;
    let (found, want, nan) = (plc.get("p.x"), plc.get("p.want"), plc.get("p.nan") == "TRUE");
    match row.value == "NaN" {
        true if nan => Ok(()),
        false if found == want => Ok(()),
        _ => Err(format!("{found}, expected {}", row.value)),
    }
}
