//! The case files of `conformance/iec`, run on the interpreter and as native code. A failure names the file and the line of the
//! heading or row. From: library reference §2 to §10.

mod conformance;

use conformance::{blocks, files, values};

/// Library reference §10: bistables, edges, counters, timers, clock, semaphore, control blocks.
#[test]
fn blocks_follow_their_tables() {
    let mut tables = 0;
    for (file, text) in files("blocks") {
        tables += blocks::check_file(&file, &text);
    }
    assert!(tables > 30, "{tables}");
}

/// Library reference §8.2: functions without a result.
#[test]
fn procedures_follow_their_tables() {
    let mut tables = 0;
    for (file, text) in files("procedures") {
        tables += blocks::check_procedures(&file, &text);
    }
    assert!(tables > 10, "{tables}");
}

/// Library reference §2 to §8: as written.
#[test]
fn expressions_have_their_values() {
    let failures = values::check_all(values::as_written);
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// The same with every literal in a variable: nothing is folded.
#[test]
fn expressions_of_variables_have_their_values() {
    let failures = values::check_all(values::of_variables);
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
