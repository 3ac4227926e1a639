use super::{parse, print};

const SAMPLE: &str = r#"file "a b.st"
line 0:12
line 0:14
native SIN_LREAL (f64) -> f64
native MC_Power block 3

func "fill!" pou Pump.Body frame 16 (v0: i32, v1: i8) -> i32 {
  i32: v2 v3
  f64: v4
b0:
  v2 = load [v0 + 8]
  v3 = add v0, v2 @1
  v1 = eq v0, v3
  trap_if Range, v1
  v4 = float -1.5e-300
  v4 = float 0x7ff8000000000001
  v4 = float inf
  v4 = native SIN_LREAL(v4)
  native MC_Power(signed v0)
  copy_string [frame + 0], 7, [64], 80, 1
  v1 = compare_string [v0], 3, [frame + 8], 3, 2
  call next() @0
  branch v1, b0, b1
b1:
  switch v3, -1: b0, 2: b1, else b2
b2:
  return v3
}

func next () {
b0:
  return
}
"#;

#[test]
fn sample_reads_and_prints_back() {
    let module = parse(SAMPLE).unwrap();
    assert_eq!(print(&module), SAMPLE);
    assert_eq!(crate::mir::verify(&module), []);
}

fn fails(text: &str, line: u32, part: &str) {
    let error = parse(text).unwrap_err();
    assert_eq!(error.line, line, "{error}");
    assert!(error.text.contains(part), "{error}");
}

#[test]
fn errors_have_a_line() {
    fails("file \"a\"\nfoo", 2, "none of file");
    fails("func f () {\nb0:\n  v0 = blend v1\n}", 3, "no operation");
    fails("func f () {\nb1:\n  return\n}", 2, "should");
    fails("func f () {\n i8: v1\nb0:\n  return\n}", 2, "v0 has no type");
    fails("func f (v0: i8, v0: i8) {\nb0:\n return\n}", 1, "twice");
    fails("func f () {\nb0:\n  jump 7\n}", 3, "expected a block");
    fails("func f () {\nb0:\n  call g()\n}", 3, "`g`");
    fails("func f () {\nb0:\n  trap Nothing\n}", 3, "no trap");
    fails("func f () {\nb0:\n", 3, "the end");
    fails("file \"a", 1, "no end");
    fails("file ä", 1, "can't stand");
    fails("func f (v4000000000: i8) {\n}", 1, "too high");
}
