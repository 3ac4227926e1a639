//! Part programs and PLC program together: the mill of the examples gives the same twice, and what a channel keeps survives a restart.

mod common;

use common::{folder, root, takt_in};
use std::fs;
use std::path::Path;

/// Sub file, PLC variables read and set, M101, M62, M66, G38.2, a NURBS: twice the same set points and the same scans, on both engines.
#[test]
fn the_mill_is_the_same_twice() {
    let dir = folder("mill-twice");
    let mill = root().join("examples/05-mill").display().to_string();
    let watch = "main.Phase,main.Surface,main.Parts,main.Clamp3,main.CoolantOn,main.Status.Status.Line";
    let run = |trace: &str, engine: &str| {
        let args = ["sim", &mill, "--engine", engine, "--trace", trace, "--format", "csv", "--watch", watch];
        let ran = takt_in(&dir, &args);
        assert_eq!(ran.status, 0, "{}", ran.stderr);
        (ran.stdout, fs::read(dir.join(trace)).unwrap())
    };
    let first = run("a.csv", "native");
    assert!(first.1.len() > 100_000);
    assert!(first == run("b.csv", "native"), "the second run differs");
    assert!(first == run("c.csv", "interp"), "the interpreter differs");
    assert!(!root().join("examples/05-mill/.takt").exists(), "a simulation keeps nothing");
}

const TOML: &str = "\
[run]\nstop_when = \"main.Complete\"\nduration = \"10s\"\n\
[[motion.axis]]\nname = \"AxisX\"\n\
[[motion.channel]]\nname = \"Mill\"\naxes = [\"AxisX\"]\nparameter_file = \"kept/mill.par\"\ntool_table = \"mill.tbl\"\n";

const ST: &str = "\
PROGRAM main\nVAR_EXTERNAL AxisX : AXIS_REF; Mill : CNC_REF; END_VAR\n\
VAR Power : MC_Power; Load : CNC_LoadProgram; Job : CNC_Run; Fault : CNC_ReadError; Complete : BOOL; Seen : LREAL; END_VAR\n\
  Power(Axis := AxisX, Enable := TRUE);\n\
  Load(Cnc := Mill, Execute := Power.Status, FileName := 'count.ngc');\n\
  Job(Cnc := Mill, Execute := Load.Done);\n\
  Fault(Cnc := Mill, Enable := TRUE);\n\
  Complete := Job.Done OR Job.Error OR Load.Error;\n\
END_PROGRAM\n";

fn project(name: &str) -> std::path::PathBuf {
    let dir = folder(name);
    for (file, text) in [
        ("takt.toml", TOML),
        ("main.st", ST),
        ("count.ngc", "#31 = [#31 + 1]\nG10 L2 P1 X#31\nG10 L1 P1 Z[#31 * 10]\n#<_plc_main.Seen> = #31\nM2\n"),
        ("mill.tbl", "T1 P1 Z1 ;the only one\n"),
    ] {
        fs::write(dir.join(file), text).unwrap();
    }
    let _ = fs::remove_dir_all(dir.join("kept"));
    dir
}

fn run(dir: &Path) {
    let ran = takt_in(dir, &["run", ".", "--picture", "path.svg"]);
    assert_eq!(ran.status, 0, "{}", ran.stderr);
}

/// R1-75 and the parameters of RS274/NGC: the numbers go on after a restart, in real time with the background in its own thread.
#[test]
fn parameters_survive_a_restart() {
    let dir = project("channel-kept");
    fs::create_dir_all(dir.join("kept")).unwrap();
    fs::write(dir.join("kept/mill.par"), "31 4\n").unwrap();
    for turn in [5, 6] {
        run(&dir);
        let text = fs::read_to_string(dir.join("kept/mill.par")).unwrap();
        for row in [format!("31\t{turn}.000000"), format!("5221\t{turn}.000000")] {
            assert!(text.lines().any(|l| l == row), "{row}\n{text}");
        }
        assert_eq!(fs::read_to_string(dir.join("mill.tbl")).unwrap(), format!("T1 P1 Z+{turn}0.000000 ;the only one\n"));
        assert!(!dir.join("kept/mill.par.new").exists());
    }
}

/// A parameter file that does not exist is made; the folder too.
#[test]
fn a_parameter_file_is_made() {
    let dir = project("channel-new");
    run(&dir);
    let text = fs::read_to_string(dir.join("kept/mill.par")).unwrap();
    assert!(text.lines().any(|l| l == "5221\t1.000000"), "{text}");
    // `#31` is none of those that every file has, so it is not kept.
    run(&dir);
    assert_eq!(fs::read_to_string(dir.join("kept/mill.par")).unwrap(), text);
}
