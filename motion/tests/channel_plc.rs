//! Part programs and the PLC program: variables, inputs, outputs, user codes, subroutines in files, tables that are kept.

mod common;
use common::rig::Rig;
use common::shop::{COUNT, Disk, FLAG, LEVEL, V, disk, running, shop, three_axes};
use takt_base::Code;
use takt_motion::channel::CncState;
use takt_motion::machine::ChannelConfig;

fn plain() -> ChannelConfig {
    ChannelConfig::default()
}

fn int(rig: &Rig, at: usize) -> i16 {
    i16::from_le_bytes([rig.memory[at], rig.memory[at + 1]])
}

/// A row that reads a variable runs when the motion before it has ended, with the value of that moment; a write acts there too.
#[test]
fn reading_waits_and_writing_acts_where_it_stands() {
    let text = "G21 F6000\nG1 X50\n#<_plc_flag> = 1\nG1 X100\n#1 = #<_plc_level>\nG1 X#1\n#<_plc_main.count> = [#1 / 2]\nM2\n";
    let (mut rig, run) = running(plain(), text);
    rig.set_real(LEVEL, 1.0);
    let (mut seen, mut moved_past) = (None, false);
    for _ in 0..20_000 {
        rig.call(&run);
        if seen.is_none() && rig.memory[FLAG] == 1 {
            seen = Some((rig.axis(0), rig.velocity()));
        }
        // The program was read long ago, and the variable changes while it moves.
        if rig.axis(0) > 99.0 && !moved_past {
            moved_past = true;
            rig.set_real(LEVEL, 30.0);
        }
        if rig.get(&run, "Done") {
            break;
        }
        rig.tick();
    }
    assert!(rig.get(&run, "Done"), "{:?}", rig.error());
    let (at, speed) = seen.expect("the flag was set");
    assert!((50.0..50.2).contains(&at) && speed > 99.0, "the path goes on: {at} at {speed}");
    assert_eq!((rig.axis(0), int(&rig, COUNT)), (30.0, 15));
}

/// Reads in conditions, loops, `elseif`, arguments, comments; all names of a row are read in one moment.
#[test]
fn reading_in_o_words() {
    let text = "\
o<w> sub\n#<_plc_v3> = [#1 + #2]\no<w> endsub\n\
o1 while [#<_plc_level> LT 3]\n  #<_plc_level> = [#<_plc_level> + 1]\no1 endwhile\n\
o2 if [#<_plc_v0> GT 0]\n  #<_plc_v1> = 1\no2 elseif [#<_plc_level> EQ 3]\n  #<_plc_v1> = 2\no2 endif\n\
o<w> call [#<_plc_level>] [#<_plc_v1> * 10]\n\
o3 do\n  #<_plc_v4> = [#<_plc_v4> + 1]\n  o3 continue\no3 while [#<_plc_v4> LT 2]\n\
(PRINT, #<_plc_v4>)\n#<_plc_v5> = EXISTS[#<_plc_level>]\n#<_plc_v6> = EXISTS[#<_plc_nothing>]\nM2\n";
    let (mut rig, run) = running(plain(), text);
    rig.until(&[&run], &run, "Done", 3000);
    let v = |rig: &Rig, i: usize| rig.real(V + 8 * i);
    assert_eq!(rig.real(LEVEL), 3.0);
    assert_eq!([v(&rig, 1), v(&rig, 3), v(&rig, 4), v(&rig, 5), v(&rig, 6)], [2.0, 23.0, 2.0, 1.0, 0.0]);
}

/// M62, M63 and M67 with the next move, M64, M65, M68 where they stand; without a stop.
#[test]
fn outputs_on_the_path() {
    let text = "F6000\nM64 P1\nG1 X20\nM62 P2\nM67 E3 Q1.5\nM65 P1\nG1 X40\nM63 P2\nM68 E4 Q-2\nM2\n";
    let (mut rig, run) = running(plain(), text);
    let io = rig.fb("CNC_Io");
    rig.set(&io, "Enable", true);
    let mut on = Vec::new();
    let mut before = [false; 2];
    let mut slowest: f64 = 1000.0;
    for _ in 0..2000 {
        rig.call(&run);
        rig.call(&io);
        let now = [rig.get_at(&io, "Out", 1), rig.get_at(&io, "Out", 2)];
        if now != before {
            on.push((rig.axis(0).round() as i64, now));
            before = now;
        }
        if (10.0..30.0).contains(&rig.axis(0)) {
            slowest = slowest.min(rig.velocity());
        }
        if rig.get(&run, "Done") {
            break;
        }
        rig.tick();
    }
    // M63 stands before no move: it never acts. M65 acts where it stands, M62 where the next move begins: the same place.
    assert_eq!(on, [(0, [true, false]), (20, [false, true])]);
    assert!(slowest > 99.0, "{slowest}");
    rig.run(&[&run, &io], 2);
    assert_eq!([rig.get_lreal_at(&io, "AOut", 3), rig.get_lreal_at(&io, "AOut", 4)], [1.5, -2.0]);
}

/// M66: the path rests, the state is cncAuxWait, #5399 is the value or -1.
#[test]
fn waiting_for_an_input() {
    let text = "F6000\nG1 X10\nM66 P5 L3 Q2\n#<_plc_v0> = #5399\nM66 P6 L3 Q0.1\n#<_plc_v1> = #5399\nM66 E2 L0\n#<_plc_v2> = #5399\nG1 X20\nM2\n";
    let (mut rig, run) = running(plain(), text);
    let io = rig.fb("CNC_Io");
    rig.set(&io, "Enable", true);
    rig.lreal_at(&io, "AIn", 2, 7.25);
    rig.run(&[&run, &io], 1000);
    assert_eq!((rig.cnc(), rig.axis(0)), (CncState::AuxWait, 10.0));
    rig.set_at(&io, "In", 5, true);
    rig.until(&[&run, &io], &run, "Done", 1000);
    assert_eq!([rig.real(V), rig.real(V + 8), rig.real(V + 16)], [1.0, -1.0, 7.25]);
    assert_eq!(rig.axis(0), 20.0);
}

/// A subroutine in a file of a `subs` folder, with a user code that waits for the PLC program.
#[test]
fn subroutine_in_a_file_and_a_user_code() {
    let files = disk(&[
        ("jobs/a.ngc", "F6000\no<drill> call [5] [2]\n#<_plc_v0> = #<_value>\nM2\n"),
        ("lib/drill.ngc", "o<drill> sub\nG1 Z-#1\nM101 P3 Q#2\nG0 Z0\no<drill> endsub [#1 * #2]\nM2\n"),
    ]);
    let channel = ChannelConfig { subs: vec!["lib".into()], handshake: true, ..plain() };
    let mut rig = shop(&three_axes(channel), &files);
    let (aux, run) = (rig.fb("CNC_AuxHandshake"), rig.start("jobs/a.ngc"));
    rig.set(&aux, "Enable", true);
    let mut seen = None;
    for _ in 0..5000 {
        rig.call(&run);
        rig.call(&aux);
        let mf = rig.get(&aux, "Mf");
        if mf && rig.get_u16(&aux, "MCode") == 101 && seen.is_none() {
            seen = Some((rig.axis(2), rig.get_lreal_at(&aux, "MParam", 0), rig.get_lreal_at(&aux, "MParam", 1)));
        }
        rig.set(&aux, "Fin", mf);
        if rig.get(&run, "Done") {
            break;
        }
        rig.tick();
    }
    assert_eq!(seen, Some((-5.0, 3.0, 2.0)), "{:?}", rig.error());
    assert_eq!(rig.real(V), 10.0);
}

/// An error in a file of subroutines names the file.
#[test]
fn an_error_in_a_subroutine_names_its_file() {
    let files = disk(&[("a.ngc", "o<bad> call\nM2\n"), ("bad.ngc", "o<bad> sub\nG1 X1\no<bad> endsub\n")]);
    let mut rig = shop(&three_axes(plain()), &files);
    let load = rig.fb("CNC_LoadProgram");
    rig.text(&load, "FileName", "a.ngc");
    rig.set(&load, "Execute", true);
    rig.until(&[&load], &load, "Error", 100);
    let (code, text) = rig.error().expect("an error");
    assert_eq!(code, Code::NoFeed);
    assert!(text.starts_with("bad.ngc: "), "{text}");
}

fn run_program(rig: &mut Rig, name: &str) {
    let run = rig.start(name);
    rig.until(&[&run], &run, "Done", 5000);
    rig.set(&run, "Execute", false);
    rig.run(&[&run], 3);
}

fn file(disk: &Disk, name: &str) -> String {
    disk.lock().unwrap().get(name).cloned().unwrap_or_default()
}

fn kept() -> ChannelConfig {
    ChannelConfig { parameter_file: Some("mill.par".into()), tool_table: Some("mill.tbl".into()), ..plain() }
}

/// Parameters, offsets, tools and the tool in the spindle outlive the program; the files outlive the machine.
#[test]
fn parameters_and_tools_survive() {
    let files = disk(&[
        ("set.ngc", "G10 L2 P1 X10 Y20\n#31 = 7\n#5221 = [#5221 + 1]\nT2 M6\nG10 L1 P2 Z12.5 R3\nG28.1\nM2\n"),
        ("use.ngc", "#<_plc_v0> = #31\n#<_plc_v1> = #5400\nG0 X0 Y0\nG43 H2\n#<_plc_v2> = #5403\nM2\n"),
        ("mill.tbl", "T1 P1 Z5\nT2 P2 Z1 D1 ;mill\n"),
        ("mill.par", "31\t1.5\n"),
    ]);
    let mut rig = shop(&three_axes(kept()), &files);
    run_program(&mut rig, "set.ngc");
    assert_eq!(file(&files, "mill.tbl"), "T1 P1 Z5\nT2 P2 Z+12.500000 D+6.000000 ;mill\n");
    let text = file(&files, "mill.par");
    for row in ["31\t7.000000", "5221\t11.000000", "5222\t20.000000"] {
        assert!(text.lines().any(|l| l == row), "{row}\n{text}");
    }
    run_program(&mut rig, "use.ngc");
    assert_eq!([rig.real(V), rig.real(V + 8), rig.real(V + 16)], [7.0, 2.0, 12.5]);
    assert_eq!([rig.axis(0), rig.axis(1)], [11.0, 20.0]);
    drop(rig);
    let mut rig = shop(&three_axes(kept()), &files);
    run_program(&mut rig, "use.ngc");
    // No file says which tool is in the spindle; G43 H2 finds its length in the table.
    assert_eq!([rig.real(V), rig.axis(0), rig.axis(1), rig.real(V + 16)], [7.0, 11.0, 20.0, 0.0]);
}

/// The codes of the configuration are in force at the start of every program, whatever the one before has left.
#[test]
fn every_program_starts_alike() {
    let files = disk(&[("a.ngc", "G10 L2 P2 X5\nG0 X0\nG91 G20 G57\nM30\n")]);
    let mut rig = shop(&three_axes(ChannelConfig { modes: "G55".into(), ..plain() }), &files);
    for _ in 0..2 {
        run_program(&mut rig, "a.ngc");
        assert_eq!(rig.axis(0), 5.0);
    }
}

/// What a program was read ahead to do and did not is not kept: an abort in the middle keeps what the last synchronisation point had.
#[test]
fn an_abort_keeps_what_was_executed() {
    let text = "F600\n#31 = 1\nM66 P0 L0\n#31 = 2\nG1 X100\n#31 = 3\nM2\n";
    let files = disk(&[("a.ngc", text), ("mill.par", "31 0\n"), ("mill.tbl", "")]);
    let mut rig = shop(&three_axes(kept()), &files);
    let (run, abort) = (rig.start("a.ngc"), rig.fb("CNC_Abort"));
    rig.run(&[&run, &abort], 1000);
    rig.set(&abort, "Execute", true);
    rig.until(&[&run, &abort], &abort, "Done", 200);
    rig.run(&[&run], 3);
    assert!(file(&files, "mill.par").contains("31\t1.000000"), "{}", file(&files, "mill.par"));
}

/// F0625 and F0626: tables that can't be written or read.
#[test]
fn tables_that_fail() {
    let channel = ChannelConfig { parameter_file: Some("bad/mill.par".into()), ..plain() };
    let files = disk(&[("a.ngc", "#5221 = 3\nM2\n")]);
    let mut rig = shop(&three_axes(channel), &files);
    run_program(&mut rig, "a.ngc");
    assert_eq!(rig.error().map(|e| e.0), Some(Code::KeptFile));
    assert_eq!(rig.cnc(), CncState::Ready);
    let channel = ChannelConfig { tool_table: Some("mill.tbl".into()), ..plain() };
    let files = disk(&[("a.ngc", "M2\n"), ("mill.tbl", "T1 P1\nP2\n")]);
    let mut rig = shop(&three_axes(channel), &files);
    let load = rig.fb("CNC_LoadProgram");
    rig.text(&load, "FileName", "a.ngc");
    rig.set(&load, "Execute", true);
    rig.until(&[&load], &load, "Error", 100);
    let (code, text) = rig.error().expect("an error");
    assert_eq!((code, text.starts_with("mill.tbl")), (Code::TableFile, true));
}

/// The same program in real time, with the background in a thread of its own: the same answers and end, whenever they come.
#[test]
fn questions_in_real_time() {
    let text = "F6000\nG1 X5\n#1 = #<_plc_level>\no1 while [#<_plc_v0> LT 3]\nG1 X[#1 + #<_plc_v0>]\n#<_plc_v0> = [#<_plc_v0> + 1]\n\
        M66 P1 L0\no1 endwhile\nM2\n";
    let config = three_axes(plain());
    let machine = takt_motion::Machine::with_environment(
        &config,
        common::shop::environment(&disk(&[("a.ngc", text)])),
        takt_motion::feeder::ngc_reader(),
        takt_motion::Background::Thread,
    );
    let mut rig = Rig::on(&config, machine);
    rig.power_on();
    rig.set_real(LEVEL, 10.0);
    let (load, run) = (rig.fb("CNC_LoadProgram"), rig.fb("CNC_Run"));
    rig.text(&load, "FileName", "a.ngc");
    rig.set(&load, "Execute", true);
    for _ in 0..60_000 {
        rig.run(&[&load, &run], 1);
        let ready = rig.get(&load, "Done");
        rig.set(&run, "Execute", ready);
        if rig.get(&run, "Done") || rig.get(&run, "Error") {
            break;
        }
        std::thread::sleep(std::time::Duration::from_micros(100));
    }
    assert!(rig.get(&run, "Done"), "{:?}", rig.error());
    assert_eq!([rig.axis(0), rig.real(V)], [12.0, 3.0]);
    assert_eq!(rig.machine.report().channels[0].late_ticks, 0);
}
