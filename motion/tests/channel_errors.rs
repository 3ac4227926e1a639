//! The codes that a channel alone can find: the example of each page provokes its code.

mod common;
use common::shop::{disk, shop, three_axes};
use takt_base::Code;
use takt_motion::machine::ChannelConfig;

fn example(code: Code, language: &str) -> &'static str {
    let rest = code.page().split_once(&format!("```{language}\n")).expect("an example").1;
    rest.split("```").next().expect("its end")
}

/// What the channel says to a program; the probe is in contact or not.
fn said(text: &str, contact: bool, start_line: u32) -> Option<Code> {
    let mut config = three_axes(ChannelConfig::default());
    config.axes.iter_mut().for_each(|a| a.v_max_mm_s = 200.0);
    let mut rig = shop(&config, &disk(&[("a.ngc", text)]));
    let (load, run, io) = (rig.fb("CNC_LoadProgram"), rig.fb("CNC_Run"), rig.fb("CNC_Io"));
    rig.set(&io, "Enable", true);
    rig.set(&io, "Probe", contact);
    rig.text(&load, "FileName", "a.ngc");
    rig.set(&load, "Execute", true);
    rig.word(&run, "StartLine", start_line);
    rig.int(&run, "StartMode", 1);
    for _ in 0..30_000 {
        rig.run(&[&load, &run, &io], 1);
        let ready = rig.get(&load, "Done");
        rig.set(&run, "Execute", ready);
        if rig.get(&load, "Error") || rig.get(&run, "Error") || rig.get(&run, "Done") {
            break;
        }
    }
    rig.error().map(|e| e.0)
}

#[test]
fn pages_show_what_they_say() {
    let all: Vec<_> = Code::ALL.iter().filter(|c| ("N0070".."N0090").contains(&c.text())).collect();
    assert_eq!(all.len(), 9);
    for code in all {
        let found = match code {
            Code::NoStartLine => said("F600\nG1 X1\nM2\n", false, 500),
            // The example does not write all seventeen.
            Code::TooManyReads => {
                assert!(example(*code, "ngc").contains("and so on"));
                let sum: Vec<_> = (0..17).map(|k| format!("#<_plc_a{k}>")).collect();
                said(&format!("#1 = [{}]\nM2\n", sum.join(" + ")), false, 0)
            }
            code => said(example(*code, "ngc"), *code == Code::ProbeNotReady, 0),
        };
        assert_eq!(found, Some(*code), "{}", code.text());
    }
}

/// Other ways to the same codes.
#[test]
fn more_ways() {
    for (text, code) in [
        ("#<_plc_nothing> = 1\nM2\n", Code::UnknownPlcVariable),
        ("o1 if [#<_plc_nothing> EQ 1]\no1 endif\nM2\n", Code::UnknownPlcVariable),
        ("(PRINT, #<_plc_nothing>)\nM2\n", Code::UnknownPlcVariable),
        ("#<_plc_main.timer.et> = 1\nM2\n", Code::PlcVariableType),
        ("#<_plc_door> = 1\nM2\n", Code::PlcValue),
        ("#<_plc_flag> = 2\nM2\n", Code::PlcValue),
        ("#<_plc_main.count> = 40000\nM2\n", Code::PlcValue),
        ("M66 P64 L0\nM2\n", Code::NoSuchInput),
        ("M68 E16 Q1\nM2\n", Code::NoSuchInput),
        ("M62 P70\nG0 X1\nM2\n", Code::NoSuchInput),
        ("G41.1 D1 F100\nG1 X10\nG1 Y10\nM66 P1 L0\nG40\nM2\n", Code::NotInThisMode),
        ("G41.1 D1 F100\nG1 X10\nG1 Y10\n#1 = #<_plc_level>\nG40\nM2\n", Code::NotInThisMode),
        ("G38.2 Z0 F100\nM2\n", Code::ProbeMissed),
    ] {
        assert_eq!(said(text, false, 0), Some(code), "{text}");
    }
    assert_eq!(said("#1 = #<_plc_door>\n#2 = EXISTS[#<_plc_nothing>]\nM2\n", false, 0), None);
}
