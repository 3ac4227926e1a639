//! Files that are not what the command expects: a message with a code, status 1, no panic.

mod common;

use common::{file, folder, takt, takt_in};
use std::fs;

#[test]
fn files_that_are_not_sources() {
    let dir = folder("bad-files");
    fs::write(dir.join("empty.st"), "").unwrap();
    fs::write(dir.join("binary.st"), (0..=255u8).cycle().take(5000).collect::<Vec<_>>()).unwrap();
    fs::write(dir.join("deep.st"), format!("PROGRAM main VAR x : INT; END_VAR x := {}1;", "(".repeat(2_000_000))).unwrap();
    fs::write(dir.join("picture.png"), b"\x89PNG").unwrap();
    fs::create_dir(dir.join("nothing")).unwrap();
    for (args, code) in [
        (&["sim", "empty.st"][..], "P4002"),
        (&["check", "binary.st"], "P0"),
        (&["check", "deep.st"], "P0011"),
        (&["check", "missing.st"], "C0005"),
        (&["check", "picture.png"], "C0001"),
        (&["check", "nothing"], "C0001"),
        (&["run", "missing.takt"], "C0005"),
        (&["gcode", "missing.nc", "--check"], "C0005"),
        (&["gcode", "binary.st", "--check"], "N0"),
        (&["gcode", "binary.st", "--canon"], "N0"),
    ] {
        let ran = takt_in(&dir, args);
        assert_eq!(ran.status, 1, "{args:?}: {}", ran.stderr);
        assert!(ran.stderr.contains(&format!("[{code}")), "{args:?}: {}", ran.stderr);
        assert!(!ran.stderr.contains("panicked") && ran.stderr.len() < 200_000, "{args:?}");
    }
    assert_eq!(takt_in(&dir, &["check", "empty.st"]).status, 0);
}

#[test]
fn a_damaged_image_is_refused_with_a_reason() {
    let source = file("damaged", "x.st", "PROGRAM main VAR n : INT; END_VAR n := n + 1; END_PROGRAM");
    let dir = folder("damaged-image");
    let image = dir.join("x.takt");
    assert_eq!(takt(&["build", &source, "-o", &image.display().to_string()]).status, 0);
    let mut bytes = fs::read(&image).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 0x40;
    fs::write(&image, &bytes).unwrap();
    let ran = takt_in(&dir, &["run", "x.takt", "--duration", "1s"]);
    assert!(ran.status == 1 && ran.stderr.contains("C0003") && ran.stderr.contains("damaged"), "{}", ran.stderr);
    fs::write(&image, &bytes[..100]).unwrap();
    let ran = takt_in(&dir, &["run", "x.takt"]);
    assert!(ran.status == 1 && ran.stderr.contains("C0003"), "{}", ran.stderr);
}

#[test]
fn project_files_with_mistakes() {
    let dir = folder("bad-project");
    fs::write(dir.join("main.st"), "PROGRAM main VAR n : INT; END_VAR END_PROGRAM").unwrap();
    for (toml, code, words) in [
        ("[run]\nduratoin = \"1s\"", "C0002", "duration"),
        ("[run]\nduration = 5", "C0001", "takt.toml:2:12"),
        ("[project]\nprofile = \"siemens\"", "C0001", "takt.toml:2:11"),
        ("[run", "C0001", "takt.toml"),
        ("[run]\nduration = \"soon\"", "C0001", "not a duration"),
        ("[run]\nstop_when = \"main.x\"", "C0007", "main"),
        ("[run]\nstop_when = \"main.n\"", "C0001", "not a BOOL"),
        ("[task]\ninterval = \"0s\"", "C0001", "no period"),
        ("[run]\nstimulus = \"no.csv\"", "C0005", "no.csv"),
        ("[[motion.axis]]\nname = \"A1\"\nv_max_mm_s = -5.0", "C0001", "A1"),
        ("[[motion.channel]]\nname = \"C\"\naxes = [\"Nobody\"]", "C0001", "Nobody"),
        ("[[motion.axis]]\nname = \"X\"\n[[motion.channel]]\nname = \"C\"\naxes = [\"X\"]\nmode = \"steam\"", "C0001", "steam"),
        ("[[motion.axis]]\nname = \"X\"\n[[motion.channel]]\nname = \"C\"\naxes = [\"X\"]\nmodes = \"G999\"", "C0001", "G999"),
        (
            "[[motion.axis]]\nname = \"X\"\n[[motion.channel]]\nname = \"C\"\naxes = [\"X\"]\ndialect = \"klartext\"",
            "C0001",
            "klartext",
        ),
        (
            "[[motion.axis]]\nname = \"X\"\n[[motion.channel]]\nname = \"C\"\naxes = [\"X\"]\nsettings = [\"steam\"]",
            "C0001",
            "steam",
        ),
    ] {
        fs::write(dir.join("takt.toml"), toml).unwrap();
        let ran = takt_in(&dir, &["sim", "."]);
        assert_eq!(ran.status, 1, "{toml}\n{}", ran.stderr);
        assert!(ran.stderr.contains(code) && ran.stderr.contains(words), "{toml}\n{}", ran.stderr);
    }
}

#[test]
fn an_interval_of_zero_is_a_usage_error() {
    let path = file("zero-interval", "main.st", "PROGRAM main END_PROGRAM");
    let ran = takt(&["sim", &path, "--interval", "0s"]);
    assert!(ran.status == 2 && ran.stderr.contains("--interval"), "{ran:?}");
}

#[test]
fn a_bare_project_file_name_packs_the_files_of_the_folder() {
    let dir = folder("bare-toml");
    fs::write(dir.join("main.st"), "PROGRAM main END_PROGRAM").unwrap();
    fs::write(dir.join("takt.toml"), "[project]\nname = \"bare\"").unwrap();
    fs::write(dir.join("part.ngc"), "(a part program)").unwrap();
    let ran = takt_in(&dir, &["build", "takt.toml", "-o", "x.takt"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    let image = fs::read(dir.join("x.takt")).unwrap();
    assert!(image.windows(16).any(|w| w == b"(a part program)"));
}

#[test]
fn a_run_that_can_not_start_says_so_at_once() {
    let dir = folder("no-start");
    fs::write(dir.join("main.st"), "PROGRAM main END_PROGRAM").unwrap();
    fs::write(dir.join("takt.toml"), "[run]\nstimulus = \"no.csv\"").unwrap();
    let start = std::time::Instant::now();
    let ran = takt_in(&dir, &["run", "."]);
    assert!(ran.status == 1 && ran.stderr.contains("C0005"), "{ran:?}");
    assert!(start.elapsed().as_secs() < 8, "it waited for counters that never come");
}
