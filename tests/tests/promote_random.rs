//! Promotion keeps what random modules do: on the interpreter every byte is the same with and without it, unless they trap.

use std::sync::Arc;
use takt_compiler::mir::promote::promote;
use takt_compiler::mir::region::Regions;
use takt_compiler::mir::{text, verify};
use takt_tests::mir_gen::generate;
use takt_tests::mir_run::interpret;

#[test]
fn promoted_modules_do_the_same() {
    let mut changed = 0;
    for seed in 1..4000 {
        let case = generate(seed);
        let mut module = case.module.clone();
        let natives = module.natives.as_slice().to_vec();
        module.functions.iter_mut().for_each(|f| promote(f, &Regions::default(), &natives));
        changed += u32::from(module != case.module);
        assert_eq!(verify(&module), [], "seed {seed}");
        let before = interpret(&Arc::new(case.module.clone()), case.map, &case.contents, case.entry(), seed as u32);
        let after = interpret(&Arc::new(module.clone()), case.map, &case.contents, case.entry(), seed as u32);
        match (&before.result, &after.result) {
            (Ok(()), Ok(())) => assert!(before.memory == after.memory, "seed {seed}:\n{}", text::print(&module)),
            // Instructions of the interpreter's budget differ; all else is the same fault.
            (Err(a), Err(b)) => assert_eq!((a.trap, a.line), (b.trap, b.line), "seed {seed}"),
            (a, b) => panic!("seed {seed}: {a:?} became {b:?}"),
        }
    }
    assert!(changed > 50, "only {changed} modules were changed");
}
