//! Runs cycle tables: a fresh instance, one call a column, 10 ms apart.

use takt_base::Profile;
use takt_image::path;
use takt_image::value::VarType;
use takt_stdlib::vendor;
use takt_tests::cycle_table::{CYCLE_MS, CycleTable, Row, parse};
use takt_tests::plc::Plc;

/// Runs all tables of a file; their number.
pub fn check_file(file: &str, text: &str) -> usize {
    let tables = parse(text).unwrap_or_else(|e| panic!("{file}: {e:?}"));
    for table in &tables {
        for literal in [true, false] {
            let profile = profile_of(file);
            run(&format!("{file}:{} {}", table.line, table.block), profile, table, &block_program(profile, table, literal));
        }
    }
    tables.len()
}

/// The same for functions that are called as statements.
pub fn check_procedures(file: &str, text: &str) -> usize {
    let tables = parse(text).unwrap_or_else(|e| panic!("{file}: {e:?}"));
    for table in &tables {
        for literal in [true, false] {
            run(&format!("{file}:{} {}", table.line, table.block), Profile::Std, table, &procedure_program(table, literal));
        }
    }
    tables.len()
}

/// `openplc.md` is of that profile.
fn profile_of(file: &str) -> Profile {
    Profile::from_name(file.trim_end_matches(".md")).unwrap_or_default()
}

/// Inputs come from variables `in_X`, outputs go to `out_X`; `want_X` is written by the test to compare with.
fn block_program(profile: Profile, table: &CycleTable, literal: bool) -> String {
    let probe = Plc::new_in(profile, &format!("PROGRAM p VAR b : {}; END_VAR b(); END_PROGRAM", table.block));
    let ty = |pin: &str| {
        let pin = vendor::pin(&table.block, pin).unwrap_or(pin);
        let found = path::resolve(&probe.image, &format!("p.b.{pin}")).unwrap_or_else(|e| panic!("{}: {e}", table.block));
        type_name(&probe, found.ty)
    };
    program(table, literal, &format!("b : {};", table.block), "b", &ty)
}

fn procedure_program(table: &CycleTable, literal: bool) -> String {
    let ty = |pin: &str| match table.constants.iter().find(|(name, _)| name == pin) {
        Some((_, literal)) => super::literals::type_of(literal, "").expect("a typed literal"),
        None => "LINT".to_owned(),
    };
    program(table, literal, "", &table.block, &ty)
}

fn program(table: &CycleTable, literal: bool, instance: &str, callee: &str, ty: &dyn Fn(&str) -> String) -> String {
    let mut vars = instance.to_owned();
    let mut args = Vec::new();
    for (name, value) in &table.constants {
        vars += &format!(" const_{name} : {} := {value};", ty(name));
        args.push(format!("{name} := {}", if literal { value.clone() } else { format!("const_{name}") }));
    }
    for Row { name, .. } in &table.inputs {
        vars += &format!(" in_{name} : {};", ty(name));
        args.push(format!("{name} := in_{name}"));
    }
    for Row { name, .. } in &table.outputs {
        vars += &format!(" out_{name}, want_{name} : {};", ty(name));
        args.push(format!("{name} => out_{name}"));
    }
    format!("PROGRAM p VAR {vars} END_VAR {callee}({}); END_PROGRAM", args.join(", "))
}

fn run(place: &str, profile: Profile, table: &CycleTable, text: &str) {
    let mut plc = Plc::new_in(profile, text);
    for scan in 0..table.scans {
        for row in &table.inputs {
            set(&mut plc, &format!("p.in_{}", row.name), row, scan);
        }
        let result = plc.scan(1000 + CYCLE_MS * scan as i64);
        assert!(result.is_ok(), "{place}, scan {scan}: {result:?}");
        for row in &table.outputs {
            check(&mut plc, place, row, scan);
        }
    }
}

fn check(plc: &mut Plc, place: &str, row: &Row, scan: usize) {
    let (found, want) = (format!("p.out_{}", row.name), format!("p.want_{}", row.name));
    set(plc, &want, row, scan);
    let (found, want) = (plc.get(&found), plc.get(&want));
    let near = matches!((found.parse::<f64>(), want.parse::<f64>()), (Ok(a), Ok(b)) if (a - b).abs() <= 1e-5 * b.abs().max(1.0));
    assert!(found == want || near, "{place}, scan {scan}: {} is {found}, expected {want}", row.name);
}

/// Writes the number of a column into a variable of any elementary type.
fn set(plc: &mut Plc, name: &str, row: &Row, scan: usize) {
    let place = path::resolve(&plc.image, name).unwrap_or_else(|e| panic!("{e}"));
    let value = &row.values[scan];
    let literal = match type_name(plc, place.ty).as_str() {
        "BOOL" => if value == "0" { "FALSE" } else { "TRUE" }.to_owned(),
        "REAL" | "LREAL" if !value.contains('.') => format!("{value}.0"),
        "DT" => instant(value.parse().expect("milliseconds")),
        ty @ ("TIME" | "LTIME") => format!("{ty}#{value}ms"),
        _ => value.clone(),
    };
    plc.set(name, &literal);
}

fn type_name(plc: &Plc, ty: VarType) -> String {
    match ty {
        VarType::Declared(id) => plc.image.types.display(id),
        VarType::Direct(e) => e.name().to_owned(),
    }
}

/// Milliseconds of the first day of 1970.
fn instant(ms: u32) -> String {
    let (s, ms) = (ms / 1000, ms % 1000);
    format!("DT#1970-01-01-{:02}:{:02}:{:02}.{ms:03}", s / 3600, s / 60 % 60, s % 60)
}
