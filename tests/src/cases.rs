//! Tables of small programs: what they compute on both engines, or which error they get.

use crate::plc::{Plc, compile_in};
use std::panic::{AssertUnwindSafe, catch_unwind};
use takt_base::{Profile, Severity};

/// Section, declarations in front, variables, statements, and values behind one scan: `a=1 b='x y'` by ` | ` if one has blanks.
pub type Row = (&'static str, &'static str, &'static str, &'static str, &'static str);

/// Runs each row in a program `p`; all that is wrong is reported at once.
pub fn run(profile: Profile, rows: &[Row]) {
    let wrong: Vec<String> = rows.iter().filter_map(|row| failure(profile, row)).collect();
    assert!(wrong.is_empty(), "{} of {} rows:\n{}", wrong.len(), rows.len(), wrong.join("\n"));
}

fn failure(profile: Profile, row: &Row) -> Option<String> {
    let (section, decls, vars, body, want) = row;
    let text = format!("{decls}\nPROGRAM p\nVAR\n{vars}\nEND_VAR\n{body}\nEND_PROGRAM\n");
    let outcome = catch_unwind(AssertUnwindSafe(|| values(profile, &text, want)));
    match outcome {
        Ok(Ok(())) => None,
        Ok(Err(why)) => Some(format!("{section}: {why}\n{text}")),
        Err(_) => Some(format!("{section}: panics\n{text}")),
    }
}

fn values(profile: Profile, text: &str, want: &str) -> Result<(), String> {
    let mut plc = Plc::load_in(profile, text)?;
    plc.scan(0).map_err(|fault| format!("{fault:?}"))?;
    let blank = if want.contains(" | ") { " | " } else { " " };
    for pair in want.split(blank).filter(|p| !p.is_empty()) {
        let (name, value) = pair.split_once('=').ok_or("name=value")?;
        let found = plc.get(&format!("p.{name}"));
        if found != value {
            return Err(format!("{name} is {found}, {value} wanted"));
        }
    }
    Ok(())
}

/// Each text has exactly these errors, by code.
pub fn reject(profile: Profile, rows: &[(&str, &str, &str)]) {
    let wrong: Vec<String> = rows.iter().filter_map(|row| not_rejected(profile, row)).collect();
    assert!(wrong.is_empty(), "{} of {} rows:\n{}", wrong.len(), rows.len(), wrong.join("\n"));
}

fn not_rejected(profile: Profile, (section, text, want): &(&str, &str, &str)) -> Option<String> {
    let c = compile_in(profile, text);
    let errors = c.diags.iter().filter(|d| d.severity == Severity::Error);
    let codes: Vec<String> = errors.map(|d| d.code.text().to_owned()).collect();
    (codes.join(" ") != *want).then(|| format!("{section}: {codes:?}, {want} wanted\n{text}"))
}
