//! Tables of the generated code: lines, traps, calls, sameness.
use super::{Code, clif, disassemble, emit};
use crate::mir::model::{FuncId, Module};
use crate::mir::{text, verify};
use takt_image::Trap;
use takt_image::image::{LineSite, TrapSite};

fn module(source: &str) -> Module {
    let module = text::parse(source).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(verify(&module), []);
    module
}

/// The assembly of the first function has, or lacks, an instruction.
fn check(source: &str, has: &[&str], lacks: &[&str]) {
    let assembly = disassemble(&module(source), FuncId(0)).unwrap();
    for part in has {
        assert!(assembly.contains(part), "`{part}` is missing in\n{assembly}");
    }
    for part in lacks {
        assert!(!assembly.contains(part), "`{part}` is in\n{assembly}");
    }
}

#[test]
fn division_by_a_constant_is_a_multiplication() {
    check(
        "func f (v0: i32) -> i32 {\n i32: v1\nb0:\n v1 = int 10\n v0 = sdiv v0, v1\n return v0\n}",
        &["imull"],
        &["idiv", "cmov"],
    );
    check("func f (v0: i32) -> i32 {\n i32: v1\nb0:\n v1 = int 8\n v0 = urem v0, v1\n return v0\n}", &["and"], &["div"]);
}

#[test]
fn unused_locals_and_frames_leave_no_code() {
    let source = "func f (v0: i32) -> i32 {\n i64: v1 v2\n f64: v3\nb0:\n return v0\n}";
    check(source, &[], &["xmm", "xor", "rsp)", "trap"]);
}

#[test]
fn small_copies_are_done_in_registers() {
    check("func f () {\nb0:\n copy_bytes [64], [128], 40\n return\n}", &["movdqu"], &["j "]);
}

#[test]
fn a_frame_is_checked_against_its_limit() {
    check("func f frame 16 () {\nb0:\n return\n}", &["0x20(%rdi)", "trap=user4"], &[]);
}

const SITES: &str = "file \"a.st\"
line 0:5
line 0:6
line 0:7
func f (v0: i32, v1: i32) -> i32 {
  i8: v2
b0:
  v0 = add v0, v1
  v2 = sgt v0, v1 @1
  trap_if Range, v2
  v0 = udiv v0, v1 @2
  return v0
}
func g (v0: i32) -> i32 {
b0:
  v0 = call f(v0, v0) @1
  return v0
}
";

/// The line of a code offset, as `Image::line_at` finds it.
fn line_at(code: &Code, offset: u32) -> LineSite {
    code.lines[code.lines.partition_point(|l| l.offset <= offset) - 1]
}

#[test]
fn traps_know_their_lines() {
    let code = emit(&module(SITES)).unwrap();
    let line_of = |trap: Trap| {
        let site = |t: &&TrapSite| t.trap == trap as u8;
        line_at(&code, code.traps.iter().find(site).unwrap().offset).line
    };
    assert_eq!((line_of(Trap::Range), line_of(Trap::DivisionByZero), line_of(Trap::StackOverflow)), (6, 7, 6));
}

#[test]
fn tables_are_in_order() {
    let code = emit(&module(SITES)).unwrap();
    let [f, g] = &code.functions[..] else { panic!("two functions") };
    assert_eq!((f.start, f.size % 16, g.start, g.start + g.size), (0, 0, f.size, code.code.len() as u32));
    assert!(code.lines.windows(2).all(|l| l[0].offset < l[1].offset));
    assert!(code.traps.windows(2).all(|t| t[0].offset < t[1].offset));
    assert_eq!((line_at(&code, 0).line, line_at(&code, g.start).line), (5, 6));
}

#[test]
fn calls_are_patched() {
    let code = emit(&module(SITES)).unwrap();
    let g = code.functions[1].start as usize;
    let at = g + code.code[g..].iter().position(|&b| b == 0xe8).unwrap() + 1;
    let distance = i32::from_le_bytes(code.code[at..at + 4].try_into().unwrap());
    assert_eq!(at as i32 + 4 + distance, 0);
}

#[test]
fn same_module_gives_the_same_bytes() {
    let many: String = (0..300)
        .map(|i| SITES[SITES.find("func f").unwrap()..SITES.find("func g").unwrap()].replace(" f ", &format!(" f{i} ")))
        .collect();
    let many = module(&format!("{}{many}", &SITES[..SITES.find("func f").unwrap()]));
    let code = emit(&many).unwrap();
    assert_eq!(code.functions.len(), 300);
    assert_eq!(code, emit(&many).unwrap());
}

#[test]
fn clif_shows_the_function() {
    let text = clif(&module(SITES), FuncId(1)).unwrap();
    assert!(text.contains("call fn0") && text.contains("stack_limit"), "{text}");
}
