//! Many functions: they are compiled on several threads, and every call reaches its function all the same.

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

#[test]
fn calls_reach_their_functions() {
    let count = 500;
    let module = Arc::new(text::parse(&chain(count)).expect("the text is right"));
    assert_eq!(verify(&module), []);
    let map = MemoryMap::new(0, 0, 0, 64, 64).expect("small enough");
    let contents = vec![0; (map.size() - header::SIZE) as usize];
    let outcomes = [interpret(&module, map, &contents, FuncId(count), 7), native(&module, map, &contents, FuncId(count), 7)];
    for outcome in outcomes {
        assert_eq!(outcome.result, Ok(()));
        assert_eq!(outcome.memory[..4], (7 + count * (count - 1) / 2).to_le_bytes());
    }
}
