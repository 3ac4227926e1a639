//! `takt test`: exit statuses, formats, what a failure says, filter, both engines; assertions in `sim`.

mod common;

use common::{Ran, file, folder, root, takt, takt_in};
use serde_json::json;
use std::fs;

const ENGINES: [&str; 2] = ["native", "interp"];

const GOOD: &str = "{test 'one'}\nPROGRAM one\nASSERT_EQ(1, 1);\nEND_PROGRAM
{test 'two', scans := 3}\nPROGRAM two\nVAR n : INT; END_VAR\nn := n + 1;\nASSERT_LE(n, 3);\nEND_PROGRAM\n";

/// Fails in line 10 in scans 2 and 3, and faults in line 17 in scan 2.
const BAD: &str = "FUNCTION_BLOCK Counter
VAR_OUTPUT n : INT; END_VAR
n := n + 1;
END_FUNCTION_BLOCK

{test 'counts <\"&\">', scans := 3}
PROGRAM counts
VAR c : Counter; END_VAR
c();
ASSERT_EQ(1, c.n, 'it counts & \"on\"');
END_PROGRAM

{test scans := 5}
PROGRAM divides
VAR n, m : INT := 1; END_VAR
n := n - 1;
m := 6 / (n + 1);
ASSERT_TRUE(m > 0);
END_PROGRAM

{test 'good'}
PROGRAM good
ASSERT(TRUE);
END_PROGRAM
";

fn test_with(path: &str, more: &[&str]) -> Ran {
    takt(&[&["test", path], more].concat())
}

/// Name and text of each element that holds no other, in order; panics if the text is no well-formed XML.
fn leaves(xml: &str) -> Vec<(String, String)> {
    let (mut open, mut leaves, mut rest) = (Vec::new(), Vec::new(), xml);
    while let Some((text, behind)) = rest.split_once('<') {
        assert!(!text.contains('>') && entities_are_known(text), "{text}");
        let (tag, behind) = behind.split_once('>').expect("a closed tag");
        if let Some(name) = tag.strip_prefix('/') {
            let (opened, leaf): (String, bool) = open.pop().expect("an open element");
            assert_eq!(opened.split(' ').next(), Some(name));
            if leaf {
                leaves.push((opened, text.to_owned()));
            }
        } else if !tag.starts_with('?') {
            assert!(tag.matches('"').count() % 2 == 0 && entities_are_known(tag), "{tag}");
            open.iter_mut().for_each(|o: &mut (String, bool)| o.1 = false);
            match tag.strip_suffix('/') {
                Some(tag) => leaves.push((tag.to_owned(), String::new())),
                None => open.push((tag.to_owned(), true)),
            }
        }
        rest = behind;
    }
    assert!(open.is_empty() && rest.trim().is_empty(), "{open:?} {rest}");
    leaves
}

fn entities_are_known(text: &str) -> bool {
    text.split('&').skip(1).all(|t| ["amp;", "lt;", "gt;", "quot;"].iter().any(|e| t.starts_with(e)))
}

#[test]
fn tests_that_pass() {
    let path = file("test-good", "good.st", GOOD);
    for engine in ENGINES {
        let ran = test_with(&path, &["--engine", engine]);
        assert_eq!((ran.status, ran.stderr.as_str()), (0, ""));
        let wanted = "ok     one (1 scan, 1 assertion)\nok     two (3 scans, 3 assertions)\n2 tests: 2 passed, 0 failed\n";
        assert_eq!(ran.stdout, wanted);
        let ran = test_with(&path, &["--format", "tap", "--engine", engine]);
        assert_eq!((ran.status, ran.stdout.as_str()), (0, "TAP version 14\n1..2\nok 1 - one\nok 2 - two\n"));
    }
}

#[test]
fn failures_say_where_and_what() {
    let dir = folder("test-bad");
    fs::write(dir.join("bad.st"), BAD).unwrap();
    for engine in ENGINES {
        let ran = takt_in(&dir, &["test", "bad.st", "--engine", engine]);
        assert_eq!((ran.status, ran.stderr.as_str()), (1, ""));
        let wanted = "FAILED counts <\"&\"> (3 scans, 3 assertions)
  bad.st:10, scan 2: expected 1, actual 2: it counts & \"on\"
  bad.st:10, scan 3: expected 1, actual 3: it counts & \"on\"
FAILED divides (2 scans, 1 assertion)
  bad.st:17, scan 2: fault F0701: integer division by zero in divides
ok     good (1 scan, 1 assertion)
3 tests: 1 passed, 2 failed
";
        assert_eq!(ran.stdout, wanted, "{engine}");
    }
}

#[test]
fn tap_lists_failures() {
    let dir = folder("test-tap");
    fs::write(dir.join("bad.st"), BAD.replace("'good'", "'good #1'")).unwrap();
    let ran = takt_in(&dir, &["test", "bad.st", "--format", "tap"]);
    let wanted = r##"TAP version 14
1..3
not ok 1 - counts <"&">
  ---
  failures:
    - "bad.st:10, scan 2: expected 1, actual 2: it counts & \"on\""
    - "bad.st:10, scan 3: expected 1, actual 3: it counts & \"on\""
  ...
not ok 2 - divides
  ---
  failures:
    - "bad.st:17, scan 2: fault F0701: integer division by zero in divides"
  ...
ok 3 - good \#1
"##;
    assert_eq!((ran.status, ran.stdout.as_str()), (1, wanted));
}

#[test]
fn junit_is_xml() {
    let dir = folder("test-junit");
    fs::write(dir.join("bad.st"), BAD).unwrap();
    let ran = takt_in(&dir, &["test", "bad.st", "--format", "junit"]);
    assert_eq!(ran.status, 1);
    assert!(ran.stdout.contains("<testsuites name=\"bad\" tests=\"3\" failures=\"2\" errors=\"0\" time=\""), "{}", ran.stdout);
    assert!(ran.stdout.contains("<testcase name=\"counts &lt;&quot;&amp;&quot;&gt;\" classname=\"counts\" time=\""));
    let leaves = leaves(&ran.stdout);
    let [(first, text), (second, _), (third, _)] = leaves.as_slice() else { panic!("{leaves:?}") };
    let line = "bad.st:10, scan 2: expected 1, actual 2: it counts &amp; &quot;on&quot;";
    assert_eq!(first, &format!("failure message=\"{line}\" type=\"assertion\""));
    assert_eq!(text.lines().collect::<Vec<_>>(), [line, &line.replace("scan 2", "scan 3").replace("actual 2", "actual 3")]);
    assert!(second.ends_with("type=\"F0701\""), "{second}");
    assert!(third.starts_with("testcase name=\"good\""), "{third}");
}

#[test]
fn json_has_everything() {
    let dir = folder("test-json");
    fs::write(dir.join("bad.st"), BAD).unwrap();
    let ran = takt_in(&dir, &["test", "bad.st", "--format", "json"]);
    let found = ran.json();
    assert_eq!((ran.status, &found["failed"]), (1, &json!(2)));
    let failure = json!({ "kind": "assertion", "file": "bad.st", "line": 10, "scan": 2,
        "message": "expected 1, actual 2: it counts & \"on\"" });
    assert_eq!(found["tests"][0]["failures"][0], failure);
    assert_eq!((&found["tests"][1]["failures"][0]["kind"], &found["tests"][2]["ok"]), (&json!("F0701"), &json!(true)));
}

#[test]
fn a_filter_chooses() {
    let path = file("test-filter", "bad.st", BAD);
    let ran = test_with(&path, &["--filter", "GOOD"]);
    assert_eq!((ran.status, ran.stdout.as_str()), (0, "ok     good (1 scan, 1 assertion)\n1 test: 1 passed, 0 failed\n"));
    assert_eq!(test_with(&path, &["--filter", "div"]).status, 1);
    let ran = test_with(&path, &["--filter", "no such test"]);
    assert_eq!((ran.status, ran.stdout.as_str()), (0, "0 tests: 0 passed, 0 failed\n"));
}

#[test]
fn a_wrong_project_has_no_results() {
    let path = file("test-wrong", "wrong.st", "{test}\nPROGRAM t\nASSERT_EQ(1, x);\nEND_PROGRAM\n");
    let ran = test_with(&path, &[]);
    assert_eq!((ran.status, ran.stdout.as_str()), (1, ""));
    assert!(ran.stderr.contains("P1003"), "{}", ran.stderr);
    let ran = test_with(&path, &["--format", "tap"]);
    assert_eq!((ran.status, ran.stdout.as_str()), (1, "TAP version 14\nBail out! the project is wrong\n"));
    assert_eq!(takt(&["check", &path]).status, 1);
    assert_eq!(test_with("no-such-folder", &[]).status, 1);
    assert_eq!(takt(&["test"]).status, 2);
}

/// Every type shows its values as literals.
#[test]
fn values_are_shown_by_their_type() {
    let vars =
        "b : BOOL; i : INT := -3; u : USINT := 200; big : ULINT := 16#FFFF_FFFF_FFFF_FFFF; w : WORD := 16#FF; r : REAL := 0.1;
        d : LREAL := 0.1; s : STRING := 'it$'s'; ws : WSTRING := \"w\"; t : TIME := T#1s500ms; day : DATE := D#2024-02-29;
        c : CHAR := 'x'; m : Mode := fast; p : Percent := 50; nan : REAL; long : STRING[250];";
    let lines = [
        ("ASSERT(b);", "expected TRUE, actual FALSE"),
        ("ASSERT_EQ(2, i);", "expected 2, actual -3"),
        ("ASSERT_EQ(201, u);", "expected 201, actual 200"),
        ("ASSERT_EQ(1, big);", "expected 1, actual 18446744073709551615"),
        ("ASSERT_EQ(16#FE, w);", "expected 16#FE, actual 16#FF"),
        ("ASSERT_EQ(0.25, r);", "expected 0.25, actual 0.1"),
        ("ASSERT_EQ(r, d);", "expected 0.10000000149011612, actual 0.1"),
        ("ASSERT_EQ('its', s);", "expected 'its', actual 'it$'s'"),
        ("ASSERT_EQ(\"v\", ws);", "expected \"v\", actual \"w\""),
        ("ASSERT_EQ(T#1s, t);", "expected T#1s, actual T#1s500ms"),
        ("ASSERT_EQ(D#2024-03-01, day);", "expected D#2024-03-01, actual D#2024-02-29"),
        ("ASSERT_EQ('y', c);", "expected 'y', actual 'x'"),
        ("ASSERT_EQ(idle, m);", "expected idle, actual fast"),
        ("ASSERT_EQ(49, p);", "expected 49, actual 50"),
        ("ASSERT_NE(T#1s500ms, t);", "expected anything but T#1s500ms"),
        ("ASSERT_LT(i, -3);", "-3 < -3 does not hold"),
        ("ASSERT_LE(201, u);", "201 <= 200 does not hold"),
        ("ASSERT_GT('abc', 'abd');", "'abc' > 'abd' does not hold"),
        ("ASSERT_GE(1, big);", "1 >= 18446744073709551615 does not hold"),
        ("ASSERT_NEAR(0.5, r, 0.25);", "expected 0.5 within 0.25, actual 0.1"),
        ("ASSERT_NEAR(T#1s, t, T#499ms);", "expected T#1s within T#499ms, actual T#1s500ms"),
        ("ASSERT_NEAR(0.0, nan, 1000.0);", "expected 0.0 within 1000.0, actual NaN"),
    ];
    let body: String = lines.iter().map(|(call, _)| format!("{call}\n")).collect();
    let types = "TYPE Mode : (idle, fast); Percent : INT (0..100); END_TYPE";
    let text = format!("{types}\n{{test}} PROGRAM t VAR {vars} END_VAR nan := nan / nan;\n{body}END_PROGRAM\n");
    let path = file("test-values", "values.st", text);
    for engine in ENGINES {
        let found = test_with(&path, &["--format", "json", "--engine", engine]).json();
        let failures = found["tests"][0]["failures"].as_array().unwrap();
        let messages: Vec<_> = failures.iter().map(|f| f["message"].as_str().unwrap()).collect();
        assert_eq!(messages, lines.map(|l| l.1), "{engine}");
    }
}

/// What holds is told to the program, is counted, and is never skipped.
#[test]
fn assertions_are_functions() {
    let text = "{test}
PROGRAM t
VAR ok : BOOL; r : REAL := 1.5; c : INT; s : STRING[5] := 'abc'; END_VAR
ok := ASSERT_EQ(1.5, r) AND ASSERT_NE(2, c) AND ASSERT_NEAR(2.0, r, 0.5) AND ASSERT_EQ('abc', s);
IF NOT ASSERT_LT(c, 0) AND ASSERT_GT(c, 0) THEN c := 1; END_IF
ASSERT(ok);
ASSERT_EQ(0, c);
END_PROGRAM
";
    let path = file("test-functions", "functions.st", text);
    for engine in ENGINES {
        let found = test_with(&path, &["--format", "json", "--engine", engine]).json();
        let test = &found["tests"][0];
        assert_eq!((&test["passed"], &test["failed"]), (&json!(6), &json!(2)), "{found}");
        let lines: Vec<_> = test["failures"].as_array().unwrap().iter().map(|f| f["line"].as_u64().unwrap()).collect();
        assert_eq!(lines, [5, 5]);
    }
}

/// Each test begins with initial values and time zero; more failures than are kept are counted.
#[test]
fn tests_do_not_touch_each_other() {
    let one = |name: &str| {
        format!(
            "{{test scans := 100, interval := T#5ms}} PROGRAM {name} VAR_EXTERNAL g : INT; END_VAR VAR t : TON; n : INT; END_VAR
n := n + 1; g := g + 1; %QB0 := INT_TO_BYTE(g); t(IN := TRUE, PT := T#50ms);
ASSERT_EQ(n, g); ASSERT_EQ(n >= 11, t.Q); ASSERT_EQ(INT_TO_BYTE(n), %QB0); ASSERT(FALSE);
END_PROGRAM\n"
        )
    };
    let text = format!("VAR_GLOBAL g : INT; END_VAR\n{}{}", one("a"), one("b"));
    let path = file("test-fresh", "fresh.st", text);
    let found = test_with(&path, &["--format", "json"]).json();
    for test in found["tests"].as_array().unwrap() {
        assert_eq!((&test["passed"], &test["failed"]), (&json!(300), &json!(100)), "{found}");
        assert_eq!(test["failures"].as_array().unwrap().len(), 64);
    }
    assert!(test_with(&path, &[]).stdout.contains("  36 more assertions failed\n"));
}

/// An endless loop is a fault of its test alone.
#[test]
fn the_watchdog_ends_a_test() {
    let text = "{test} PROGRAM endless\nWHILE TRUE DO ; END_WHILE;\nEND_PROGRAM {test} PROGRAM fine ASSERT(TRUE); END_PROGRAM";
    let path = file("test-watchdog", "endless.st", text);
    let ran = test_with(&path, &[]);
    assert_eq!(ran.status, 1);
    assert!(ran.stdout.contains("fault F07") && ran.stdout.contains("ok     fine"), "{}", ran.stdout);
}

#[test]
fn tests_are_no_part_of_the_machine() {
    let text = "PROGRAM main VAR n : INT; END_VAR n := n + 1; END_PROGRAM\n{test} PROGRAM t %IX0.0 := TRUE; END_PROGRAM";
    let path = file("test-machine", "machine.st", text);
    let ran = takt(&["sim", &path, "--scans", "2"]);
    assert_eq!((ran.status, &ran.json()["vars"]), (0, &json!({ "main.n": 2 })), "{}", ran.stderr);
    let alone = file("test-alone", "alone.st", GOOD);
    assert_eq!((takt(&["check", &alone]).status, takt(&["sim", &alone]).status), (0, 1));
}

#[test]
fn a_simulation_tells_and_goes_on() {
    let text = "PROGRAM main\nVAR n : INT; END_VAR\nn := n + 1;\nASSERT_LT(n, 3, 'small');\nEND_PROGRAM";
    let dir = folder("test-sim");
    fs::write(dir.join("a.st"), text).unwrap();
    for engine in ENGINES {
        let ran = takt_in(&dir, &["sim", "a.st", "--scans", "3", "--engine", engine]);
        assert_eq!((ran.status, &ran.json()["vars"]["main.n"]), (0, &json!(3)));
        assert_eq!(ran.stderr, "assertion failed, a.st:4 at 40ms: 3 < 3 does not hold: small\n");
    }
    let ran = takt_in(&dir, &["run", "a.st", "--duration", "90ms"]);
    assert_eq!(ran.status, 0, "{}", ran.stderr);
    assert!(ran.stdout.contains("assertions: 2 held, "), "{}", ran.stdout);
}

#[test]
fn the_example_and_a_new_project_pass() {
    for engine in ENGINES {
        let ran = takt(&["test", "examples/04-tested", "--engine", engine]);
        assert_eq!((ran.status, ran.stderr.as_str()), (0, ""));
        assert!(ran.stdout.ends_with("4 tests: 4 passed, 0 failed\n"), "{}", ran.stdout);
    }
    let dir = folder("test-new");
    assert_eq!(takt_in(&dir, &["new", "machine"]).status, 0);
    let ran = takt_in(&dir, &["test", "machine"]);
    assert_eq!((ran.status, ran.stderr.as_str()), (0, ""));
    assert!(ran.stdout.ends_with("1 test: 1 passed, 0 failed\n"), "{}", ran.stdout);
    assert!(root().join("docs/guide/testing.md").exists());
}
