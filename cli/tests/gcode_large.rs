//! Part programs that are too large to be held: memory, messages, and where to start.

mod common;

use common::{folder, takt};
use std::fs;
use std::io::{Read, Write};
use std::path::Path;
use std::process::{Command, Stdio};

/// 40,000 rows of a kilobyte, since rows take time and bytes do not; the last one is `end`.
fn large(path: &Path, end: &str) {
    let mut file = std::io::BufWriter::new(fs::File::create(path).unwrap());
    let padding = "x".repeat(1000);
    file.write_all(b"F100\n").unwrap();
    for i in 0..40_000 {
        writeln!(file, "G1 X{}.5 ;{padding}", i % 1000).unwrap();
    }
    file.write_all(end.as_bytes()).unwrap();
}

/// Most memory that a run has used when it had written `bytes` bytes, in KiB. It still has some to write and waits for its reader.
fn peak_kib(args: &[&str], bytes: usize) -> usize {
    let mut child = Command::new(env!("CARGO_BIN_EXE_takt")).args(args).stdout(Stdio::piped()).spawn().unwrap();
    let mut out = child.stdout.take().unwrap();
    out.read_exact(&mut vec![0; bytes]).unwrap();
    let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap();
    let mut rest = Vec::new();
    out.read_to_end(&mut rest).unwrap();
    assert!(child.wait().unwrap().success());
    assert!(rest.len() > 150_000, "the run had ended before it was looked at");
    let peak = status.lines().find_map(|l| l.strip_prefix("VmHWM:")).unwrap();
    peak.trim().trim_end_matches(" kB").parse().unwrap()
}

/// 40 MB of program in less than half of that, most of which is the command itself.
#[test]
fn a_large_program_is_not_held() {
    let path = folder("large").join("p.ngc");
    large(&path, "M2\n");
    assert!(fs::metadata(&path).unwrap().len() > 40_000_000);
    let path = path.display().to_string();
    for args in [&["rs274", "-g", path.as_str()][..], &["gcode", path.as_str(), "--canon"]] {
        let peak = peak_kib(args, 2_200_000);
        assert!(peak < 20 << 10, "{args:?}: {peak} KiB");
    }
    fs::remove_file(path).unwrap();
}

#[test]
fn messages_of_a_large_program_show_their_lines() {
    let path = folder("large-errors").join("p.ngc");
    large(&path, "(gr\u{fc}n) G0 X1 X2\nG0 Z Y1\nM2\n");
    let path = path.display().to_string();
    let ran = takt(&["gcode", &path, "--check"]);
    assert_eq!(ran.status, 1);
    assert!(ran.stderr.contains("p.ngc:40002:14\n40002 | (grün) G0 X1 X2\n"), "{}", ran.stderr);
    assert!(ran.stderr.contains("p.ngc:40003:4\n40003 | G0 Z Y1\n") && ran.stderr.contains("2 errors"), "{}", ran.stderr);
    let ran = takt(&["rs274", "-g", &path]);
    assert!(
        ran.status == 1 && ran.stderr.contains("line 40002, column 14") && ran.stderr.contains("\n(grün) G0 X1 X2\n"),
        "{}",
        ran.stderr
    );
    fs::remove_file(path).unwrap();
}

#[test]
fn a_listing_starts_at_any_line() {
    let path = folder("large-from").join("p.ngc");
    large(&path, "G0 X7\nM2\n");
    let path = path.display().to_string();
    let from = |line: &str| takt(&["gcode", &path, "--canon", "--number-lines", "--from-line", line]);
    let ran = from("40002");
    assert_eq!((ran.status, ran.stderr.as_str()), (0, ""));
    let first = ran.stdout.lines().find(|l| !l.starts_with("N00000")).unwrap_or("");
    assert_eq!(first, "N40002 STRAIGHT_TRAVERSE(7.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)");
    let ran = from("40004");
    assert!(ran.status == 1 && ran.stderr.contains("N0044") && ran.stderr.contains("40003 | M2"), "{}", ran.stderr);
    fs::remove_file(path).unwrap();
}
