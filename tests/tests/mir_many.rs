//! Many functions: they are compiled on several threads, and every call reaches its function all the same. And giants: they are
//! compiled in a time that grows with their size alone, and mean the same.

use std::fmt::Write;
use std::sync::Arc;
use takt_compiler::mir::model::FuncId;
use takt_compiler::mir::{text, verify};
use takt_image::{MemoryMap, header};
use takt_tests::mir_run::{interpret, native};

/// Functions that each add their number to what the one before gives; the last one stores the sum.
fn chain(count: u32) -> String {
    let mut out = String::from("func f0 (v0: i32) -> i32 {\nb0:\n  return v0\n}\n");
    for i in 1..count {
        let body = format!("  v1 = int {i}\n  v0 = call f{}(v0)\n  v0 = add v0, v1\n  return v0\n", i - 1);
        let _ = writeln!(out, "func f{i} (v0: i32) -> i32 {{\n  i32: v1\nb0:\n{body}}}");
    }
    let _ = writeln!(out, "func main (v0: i32) {{\nb0:\n  v0 = call f{}(v0)\n  store [64], v0\n  return\n}}", count - 1);
    out
}

/// Runs `main`, the last function, with the argument 7 on both engines; what they leave at 64.
fn result(source: &str) -> u32 {
    let module = Arc::new(text::parse(source).expect("the text is right"));
    assert_eq!(verify(&module), []);
    let map = MemoryMap::new(0, 0, 0, 64, 64).expect("small enough");
    let contents = vec![0; (map.size() - header::SIZE) as usize];
    let entry = FuncId(module.functions.len() as u32 - 1);
    let outcome = interpret(&module, map, &contents, entry, 7);
    assert_eq!(outcome.result, Ok(()));
    assert!(outcome == native(&module, map, &contents, entry, 7));
    u32::from_le_bytes([outcome.memory[0], outcome.memory[1], outcome.memory[2], outcome.memory[3]])
}

#[test]
fn calls_reach_their_functions() {
    let count = 500;
    assert_eq!(result(&chain(count)), 7 + count * (count - 1) / 2);
}

/// Optimised, this would take minutes.
#[test]
fn a_giant_of_one_block_is_compiled() {
    let body = "  v1 = add v1, v0\n  v2 = mul v1, v2\n  v2 = xor v2, v0\n".repeat(30_000);
    let source = format!("func main (v0: i32) {{\n  i32: v1 v2\nb0:\n{body}  store [64], v1\n  return\n}}\n");
    assert_eq!(result(&source), 7 * 30_000);
}

#[test]
fn a_giant_of_many_blocks_is_compiled() {
    let count = 10_000;
    let mut source = String::from("func main (v0: i32) {\n  i32: v1\n  i8: v2\n");
    for i in 0..count {
        let (next, after) = (i + 1, (i + 2).min(count));
        let _ = writeln!(source, "b{i}:\n  v1 = add v1, v0\n  v2 = slt v1, v0\n  branch v2, b{after}, b{next}");
    }
    let _ = writeln!(source, "b{count}:\n  store [64], v1\n  return\n}}");
    assert_eq!(result(&source), 7 * count);
}
