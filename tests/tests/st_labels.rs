//! Labels and jumps of ST, run on both engines. From: language reference §5.1.

use takt_base::Profile;
use takt_tests::plc::{Plc, compile_in};

/// Runs a body in profile codesys.
fn run(vars: &str, body: &str, expected: &[(&str, &str)]) {
    let mut plc = Plc::new_in(Profile::Codesys, &format!("PROGRAM p VAR {vars} END_VAR\n{body}\nEND_PROGRAM"));
    plc.scans(1);
    for (name, value) in expected {
        assert_eq!(plc.get(&format!("p.{name}")), *value, "{name} in\n{body}");
    }
}

fn codes(body: &str) -> Vec<&'static str> {
    let text = format!("PROGRAM p VAR i, n : INT; END_VAR\n{body}\nEND_PROGRAM");
    compile_in(Profile::Codesys, &text).diags.iter().map(|d| d.code.text()).collect()
}

#[test]
fn forward_and_backward() {
    run("i, n : INT;", "again: n := n + i; i := i + 1; IF i <= 10 THEN JMP again; END_IF;", &[("n", "55"), ("i", "11")]);
    run("n : INT;", "JMP over; n := 1; over: n := n + 2;", &[("n", "2")]);
}

#[test]
fn out_of_loops() {
    let body =
        "FOR i := 0 TO 9 DO FOR j := 0 TO 9 DO n := n + 1; IF n = 25 THEN JMP out; END_IF; END_FOR; END_FOR; out: m := n * 2;";
    run("i, j, n, m : INT;", body, &[("i", "2"), ("j", "4"), ("m", "50")]);
    let body = "WHILE i < 5 DO i := i + 1; IF i = 3 THEN JMP next; END_IF; n := n + i; next: ; END_WHILE;";
    run("i, n : INT;", body, &[("n", "12"), ("i", "5")]);
}

#[test]
fn two_entries_into_one_loop() {
    let body = "IF odd THEN JMP second; END_IF; first: n := n + 1; second: m := m + 2; IF m < 10 THEN JMP first; END_IF;";
    run("odd : BOOL := TRUE; n, m : DINT;", body, &[("n", "4"), ("m", "10")]);
    run("odd : BOOL; n, m : LREAL;", body, &[("n", "5.0"), ("m", "10.0")]);
}

#[test]
fn mistakes() {
    assert_eq!(codes("JMP nowhere; n := 1;"), ["P5005"]);
    assert_eq!(codes("JMP inside; IF n = 1 THEN inside: n := 2; END_IF;"), ["P5005"]);
    assert_eq!(codes("x: n := 1; x: n := 2; JMP x;"), ["P5006"]);
}
