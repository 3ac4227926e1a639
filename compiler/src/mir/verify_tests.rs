use super::verify;
use crate::mir::text::parse;

/// The only problem of a module has this text in it.
fn check(source: &str, part: &str) {
    let module = parse(source).unwrap_or_else(|e| panic!("{e}\n{source}"));
    let problems = verify(&module);
    assert_eq!(problems.len(), 1, "{problems:?}\n{source}");
    assert!(problems[0].to_string().contains(part), "{}\n{source}", problems[0]);
}

/// A function of a few locals with this instruction.
fn inst(inst: &str, part: &str) {
    let locals = "  i8: v0\n  i16: v1\n  i32: v2\n  i64: v3\n  f32: v4\n  f64: v5\n";
    let natives = "native n (i32) -> i64\nnative b block 3\nfunc g (v0: i16) -> i16 {\nb0:\n return v0\n}\n";
    check(&format!("{natives}func f frame 16 () {{\n{locals}b0:\n  {inst}\n  return\n}}"), part);
}

/// A function with this end.
fn end(head: &str, end: &str, part: &str) {
    check(&format!("func f {head} {{\n  i8: v0\n  f64: v1\nb0:\n  {end}\n}}"), part);
}

#[test]
fn operands() {
    inst("v0 = int 1\n  v4 = int 1", "f b0 #1: v4 is F32, not an integer");
    inst("v0 = float 1.0", "not a float");
    inst("v4 = float 0.1", "is no F32");
    inst("v1 = copy v2", "v2 is I32, not I16");
    inst("v1 = copy v9", "v9 is not there");
    inst("v4 = neg v4", "not an integer");
    inst("v2 = fabs v2", "not a float");
    inst("v2 = add v2, v3", "v3 is I64, not I32");
    inst("v5 = fadd v5, v4", "v4 is F32, not F64");
    inst("v1 = eq v2, v2", "v1 is I16, not I8");
    inst("v0 = flt v2, v2", "not a float");
    inst("v2 = select v5, v2, v2", "not an integer");
    inst("v2 = select v0, v2, v3", "v3 is I64, not I32");
    inst("trap_if Range, v5", "not an integer");
}

#[test]
fn conversions() {
    inst("v1 = sign_extend v2", "SignExtend does not convert I32 to I16");
    inst("v1 = truncate v1", "Truncate does not convert");
    inst("v5 = bits v2", "Bits does not convert");
    inst("v2 = float_to_float v5", "Float does not convert");
    inst("v5 = float_to_signed v2", "FloatToSigned does not convert");
    inst("v2 = unsigned_to_float v5", "UnsignedToFloat does not convert");
}

#[test]
fn memory() {
    inst("v3 = load [frame + 9]", "8 bytes at offset 9 pass 16");
    inst("store [1073741823], v1", "pass 1073741824");
    inst("v2 = load [v3]", "v3 is I64, not I32");
    inst("v1 = address [v2]", "v1 is I16, not I32");
    inst("v2 = address [frame + 17]", "pass 16");
    inst("copy_bytes [frame + 0], [64], 17", "17 bytes");
    inst("fill_bytes [64], 4000000000, 0", "pass");
    inst("copy_string [64], 4, [80], 4, 3", "unit of 3");
    inst("copy_string [frame + 0], 16, [80], 4, 1", "17 bytes at offset 0 pass 16");
    inst("v0 = compare_string [64], 4, [frame + 0], 9, 2", "18 bytes");
    inst("v1 = compare_string [64], 4, [80], 9, 2", "not I8");
}

#[test]
fn calls() {
    inst("v1 = call g()", "takes 1 arguments, not 0");
    inst("v1 = call g(v2)", "v2 is I32, not I16");
    inst("v2 = call g(v1)", "v2 is I32, not I16");
    inst("v3 = native n(v1)", "v1 is I16, not I32");
    inst("v3 = native b(v2)", "`b` has no result");
    inst("native b(v2, v2)", "takes 1 arguments, not 2");
}

#[test]
fn ends() {
    end("()", "jump b7", "block b7 is not there");
    end("()", "branch v1, b0, b0", "not an integer");
    end("()", "switch v0, 300: b0, else b0", "300 does not fit I8");
    end("()", "switch v0, -1: b0, 255: b0, else b0", "255 stands twice");
    end("()", "return v0", "has no result");
    end("() -> i8", "return", "returns nothing");
    end("() -> i8", "return v1", "v1 is F64, not I8");
}

#[test]
fn functions_and_module() {
    check("func f frame 12 () {\nb0:\n return\n}", "no multiple of 8");
    check("func f frame 80000000 () {\nb0:\n return\n}", "larger than");
    check("func f () {\n}", "no blocks");
    check("func f () {\nb0:\n return\n}\nfunc f () {\nb0:\n return\n}", "`f` is empty or not unique");
    check("native n ()\nnative n ()", "`n` is empty or not unique");
    check("line 0:1", "which is not there");
    check("file \"a\"\nline 0:1\nfunc f () {\nb0:\n return @5\n}", "line @5 is not there");
    let slots = vec!["i8"; 33].join(", ");
    check(&format!("native n ({slots})"), "more than 32 slots");
}
