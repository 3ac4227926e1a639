//! Damaged text of random modules: parser, verifier and interpreter answer, and none of them panics.

use std::sync::Arc;
use takt_base::Nanos;
use takt_compiler::mir::model::FuncId;
use takt_compiler::mir::{Interpreter, text, verify};
use takt_image::{Engine, TypeTable};
use takt_tests::mir_gen::{generate, memory_map};
use takt_tests::mir_run::TestNatives;
use takt_tests::rng::Rng;

/// Changes some places: a digit becomes another, a character goes, or another text comes in its place.
fn damage(rng: &mut Rng, text: &str) -> String {
    let mut chars: Vec<char> = text.chars().collect();
    for _ in 0..rng.range(1, 3) {
        let at = rng.below(chars.len());
        if chars[at].is_ascii_digit() && !rng.one_in(4) {
            chars[at] = char::from(b'0' + rng.below(10) as u8);
            continue;
        }
        let piece = rng.pick(&["", "0", "9", "v", "b", "-", "\n", "\"", "@", "[", ",", "4294967295", "frame", "i8", "ü"]);
        chars.splice(at..=at, piece.chars());
    }
    chars.into_iter().collect()
}

#[test]
fn damaged_text_does_no_harm() {
    let (mut read, mut ran) = (0, 0);
    for seed in 0..3000 {
        let printed = text::print(&generate(seed % 40).module);
        let damaged = damage(&mut Rng::new(seed), &printed);
        let Ok(module) = text::parse(&damaged) else { continue };
        read += 1;
        if verify(&module).is_empty() {
            ran += 1;
            run(module);
        }
    }
    assert!(read > 100 && ran > 100, "{read} read, {ran} ran");
}

fn run(module: takt_compiler::mir::model::Module) {
    let mut natives = TestNatives::default();
    let bindings = Interpreter::bind(&module, &mut natives, &TypeTable::default()).expect("natives bind");
    let functions: Vec<FuncId> = module.functions.indices().collect();
    let mut engine = Interpreter::new(Arc::new(module), bindings, memory_map().frames).expect("module is right");
    let mut memory = vec![0; memory_map().size() as usize];
    for function in functions {
        let _ = engine.run(function.0, 64, Nanos(0), Nanos(100_000), &mut memory, &mut natives);
    }
}
