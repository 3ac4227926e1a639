//! What unit tests did, for people (`human`) and for machines: TAP version 14, JUnit XML, JSON.

use serde_json::json;
use std::fmt::Write;
use std::time::Duration;
use takt_compiler::hir::Test;

/// A reason why a test failed.
pub struct Failed {
    /// `assertion`, or the code of a fault.
    pub kind: &'static str,
    /// Source file; empty if unknown.
    pub file: String,
    /// Line, from 1.
    pub line: u32,
    /// In which scan of the test, from 1.
    pub scan: u64,
    /// In words.
    pub text: String,
}

impl std::fmt::Display for Failed {
    /// `lamp.st:31, scan 2: expected TRUE, actual FALSE`.
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "{}:{}, scan {}: {}", self.file, self.line, self.scan, self.text)
    }
}

/// A test that ran.
pub struct Outcome {
    /// Which.
    pub test: Test,
    /// Scans that ran.
    pub scans: u64,
    /// How long that took.
    pub time: Duration,
    /// Assertions that held.
    pub passed: u64,
    /// Assertions that did not.
    pub failed: u64,
    /// The first failed assertions, and the fault; a test without any passed.
    pub failures: Vec<Failed>,
}

impl Outcome {
    fn is_ok(&self) -> bool {
        self.failures.is_empty()
    }
    /// One line each; the last says how many are not shown.
    fn lines(&self) -> Vec<String> {
        let shown = self.failures.iter().filter(|f| f.kind == "assertion").count() as u64;
        let more = (self.failed > shown).then(|| format!("{} more assertions failed", self.failed - shown));
        self.failures.iter().map(Failed::to_string).chain(more).collect()
    }
}

/// All tests that ran.
pub struct Report {
    /// Name of the project.
    pub project: String,
    /// In the order of the sources.
    pub outcomes: Vec<Outcome>,
}

impl Report {
    /// Tests that failed.
    pub fn failed(&self) -> usize {
        self.outcomes.iter().filter(|o| !o.is_ok()).count()
    }

    /// In a format of the command line.
    pub fn text(&self, format: &str) -> String {
        match format {
            "tap" => self.tap(),
            "junit" => self.junit(),
            "json" => self.json(),
            _ => self.human(),
        }
    }

    fn human(&self) -> String {
        let mut out = String::new();
        for o in &self.outcomes {
            let word = if o.is_ok() { "ok    " } else { "FAILED" };
            let (scans, assertions) = (counted(o.scans, "scan"), counted(o.passed + o.failed, "assertion"));
            let _ = writeln!(out, "{word} {} ({scans}, {assertions})", o.test.name);
            out.extend(o.lines().iter().map(|line| format!("  {line}\n")));
        }
        let (count, failed) = (self.outcomes.len(), self.failed());
        let _ = writeln!(out, "{}: {} passed, {failed} failed", counted(count as u64, "test"), count - failed);
        out
    }

    fn tap(&self) -> String {
        let mut out = format!("TAP version 14\n1..{}\n", self.outcomes.len());
        for (i, o) in self.outcomes.iter().enumerate() {
            let name = one_line(&o.test.name).replace('\\', "\\\\").replace('#', "\\#");
            let _ = writeln!(out, "{} {} - {name}", if o.is_ok() { "ok" } else { "not ok" }, i + 1);
            if !o.is_ok() {
                // JSON strings are YAML strings.
                let lines: String = o.lines().iter().map(|l| format!("    - {}\n", json!(l))).collect();
                let _ = write!(out, "  ---\n  failures:\n{lines}  ...\n");
            }
        }
        out
    }

    fn junit(&self) -> String {
        let time: Duration = self.outcomes.iter().map(|o| o.time).sum();
        let counts = format!("tests=\"{}\" failures=\"{}\" errors=\"0\"", self.outcomes.len(), self.failed());
        let head = format!("name=\"{}\" {counts} time=\"{:.6}\"", escape(&self.project), time.as_secs_f64());
        let cases: String = self.outcomes.iter().map(case).collect();
        format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {head}>\n  <testsuite {head}>\n{cases}  </testsuite>\n</testsuites>\n"
        )
    }

    fn json(&self) -> String {
        let failed = |f: &Failed| json!({ "kind": f.kind, "file": f.file, "line": f.line, "scan": f.scan, "message": f.text });
        let test = |o: &Outcome| {
            json!({
                "name": o.test.name,
                "program": o.test.pou,
                "ok": o.is_ok(),
                "scans": o.scans,
                "passed": o.passed,
                "failed": o.failed,
                "failures": o.failures.iter().map(failed).collect::<Vec<_>>(),
            })
        };
        let tests: Vec<_> = self.outcomes.iter().map(test).collect();
        serde_json::to_string_pretty(&json!({ "tests": tests, "failed": self.failed() })).unwrap_or_default()
    }
}

/// A testcase of JUnit.
fn case(o: &Outcome) -> String {
    let (name, class, time) = (escape(&o.test.name), escape(&o.test.pou), o.time.as_secs_f64());
    let open = format!("    <testcase name=\"{name}\" classname=\"{class}\" time=\"{time:.6}\"");
    match o.failures.first() {
        None => format!("{open}/>\n"),
        Some(first) => {
            let (message, text) = (escape(&first.to_string()), escape(&o.lines().join("\n")));
            let failure = format!("      <failure message=\"{message}\" type=\"{}\">{text}</failure>", first.kind);
            format!("{open}>\n{failure}\n    </testcase>\n")
        }
    }
}

/// For text and attributes of XML, which has no control characters.
fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\n' | '\t' => out.push(c),
            c if c.is_control() || matches!(c, '\u{FFFE}' | '\u{FFFF}') => out.push('\u{FFFD}'),
            c => out.push(c),
        }
    }
    out
}

/// `1 test`, `2 tests`.
fn counted(n: u64, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

fn one_line(text: &str) -> String {
    text.replace(|c: char| c.is_control(), " ")
}
