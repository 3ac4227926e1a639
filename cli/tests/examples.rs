//! Each folder of `examples/` runs in simulation against its `expect.csv`; the plotter's report and picture say what they must.

mod common;

use common::{folder, root, takt, takt_in};
use std::fs;

/// Times of `expect.csv` in nanoseconds.
fn nanos(text: &str) -> u64 {
    text.trim().strip_suffix("ms").and_then(|n| n.parse::<u64>().ok()).unwrap_or_else(|| panic!("time {text}")) * 1_000_000
}

#[test]
fn examples_do_what_they_expect() {
    let mut count = 0;
    for entry in fs::read_dir(root().join("examples")).unwrap().flatten() {
        let dir = entry.path();
        let expected = fs::read_to_string(dir.join("expect.csv")).unwrap_or_else(|e| panic!("{}: {e}", dir.display()));
        assert!(dir.join("README.md").exists(), "{} has no README.md", dir.display());
        check(&dir.display().to_string(), &expected);
        count += 1;
    }
    assert!(count >= 3);
}

fn check(dir: &str, expected: &str) {
    let mut lines = expected.lines();
    let (_, paths) = lines.next().unwrap().split_once(',').unwrap();
    for engine in ["native", "interp"] {
        let ran = takt(&["sim", dir, "--format", "csv", "--watch", paths, "--engine", engine]);
        assert_eq!(ran.status, 0, "{dir}: {}", ran.stderr);
        for line in lines.clone() {
            let (time, cells) = line.split_once(',').unwrap();
            let scan = ran.stdout.lines().skip(1).find(|l| l.split(',').nth(1).unwrap().parse::<u64>().unwrap() >= nanos(time));
            let found: Vec<_> = scan.unwrap_or_else(|| panic!("{dir}: no scan at {time}")).split(',').skip(2).collect();
            for (i, cell) in cells.split(',').enumerate().filter(|(_, c)| !c.is_empty()) {
                let path = paths.split(',').nth(i).unwrap();
                assert_eq!(found[i], cell, "{dir}, {time}: {path} ({engine})");
            }
        }
    }
}

#[test]
fn set_points_are_the_same_bit_for_bit() {
    let dir = folder("set-points");
    let plotter = root().join("examples/02-plotter").display().to_string();
    let trace = |name: &str, engine: &str| {
        let ran = takt_in(&dir, &["sim", &plotter, "--engine", engine, "--trace", name, "--watch", "main.Phase"]);
        assert_eq!(ran.status, 0, "{}", ran.stderr);
        fs::read(dir.join(name)).unwrap()
    };
    let first = trace("a.csv", "native");
    assert!(first.len() > 10_000);
    assert_eq!(first, trace("b.csv", "native"));
    assert_eq!(first, trace("c.csv", "interp"));
}

#[test]
fn the_plotter_reports_and_draws() {
    let dir = folder("plotter-report");
    let plotter = root().join("examples/02-plotter").display().to_string();
    let ran = takt_in(&dir, &["run", &plotter]);
    assert_eq!(ran.status, 0, "{}", ran.stderr);
    let wanted = "channel Plotter: 29 blocks run, path length 1358.726 mm, end point (20, 30), maximum path deviation 0.0";
    assert!(ran.stdout.contains(wanted), "{}", ran.stdout);
    assert!(ran.stdout.contains("scan time  p50") && ran.stdout.contains("jitter     p50"), "{}", ran.stdout);
    let svg = fs::read_to_string(dir.join("plotter-path.svg")).unwrap();
    assert!(svg.starts_with("<svg") || svg.starts_with("<?xml"));
    assert!(svg.contains("commanded") && svg.contains("actual"));
}

/// PC-T2: pulse counts are exact.
#[test]
fn pulses_are_counted() {
    let dir = folder("pulses");
    let pulses = root().join("examples/03-pulses").display().to_string();
    let ran = takt_in(&dir, &["run", &pulses]);
    assert_eq!(ran.status, 0, "{}", ran.stderr);
    assert!(ran.stdout.contains("pulses X +372 -352, Y +402 -372;"), "{}", ran.stdout);
}

/// PC-T10: the PLC program beside the motion misses no release: 411 scans of 10 ms up to 4100 ms.
#[test]
fn motion_does_not_delay_the_scan() {
    let ran = takt(&["sim", "examples/02-plotter", "--watch", "main.Phase"]);
    let json = ran.json();
    assert_eq!((json["scans"].as_u64(), json["time_ns"].as_u64()), (Some(411), Some(4_100_000_000)));
}
