use super::super::region::Object;
use super::super::text;
use super::*;

/// The function of `text` after promotion, printed. v0 is the instance.
fn promoted(source: &str, more: &[(u32, Region)]) -> String {
    let mut module = text::parse(source).expect("a module");
    let mut regions = Regions::default();
    regions.named_instances = 64..1000;
    regions.set(Local(0), Region { object: Object::Instance, low: 0, high: 256, exact: true });
    more.iter().for_each(|(local, region)| regions.set(Local(*local), *region));
    let natives = module.natives.as_slice().to_vec();
    promote(&mut module.functions[FuncId(0)], &regions, &natives);
    assert_eq!(super::super::verify(&module), []);
    text::print(&module)
}

fn count(text: &str, what: &str) -> usize {
    text.matches(what).count()
}

/// A loop that counts [v0 + 8] up to 10 with `body` in it.
fn counting(body: &str) -> String {
    format!(
        "native SIN (f64) -> f64\nnative LEN (i32, i32) -> i16\nfunc f (v0: i32) {{\n  i8: v1\n  i32: v2 v3 v4 v5\n  f64: v6\n  i16: v7\nb0:\n  jump b1\nb1:\n  v2 = load [v0 + 8]\n  v3 = int 1\n  \
         v2 = add v2, v3\n  store [v0 + 8], v2\n{body}  v4 = int 10\n  v1 = slt v2, v4\n  branch v1, b1, b2\nb2:\n  return\n}}\n"
    )
}

#[test]
fn a_counter_is_loaded_before_and_stored_behind() {
    let text = promoted(&counting(""), &[]);
    let blocks: Vec<_> = text.split("\nb").collect();
    assert_eq!((count(&text, "load"), count(&text, "store")), (1, 1), "{text}");
    assert!(!blocks[2].contains("load") && !blocks[2].contains("store"), "{text}");
}

#[test]
fn what_may_alias_stays_in_memory() {
    let stays = |body: &str, regions: &[(u32, Region)]| !promoted(&counting(body), regions).contains("v2 = copy");
    let within = |object, low, high| Region { object, low, high, exact: false };
    assert!(stays("  v5 = load [v3]\n", &[]));
    assert!(stays("  v5 = load [v3]\n", &[(3, Region::whole(Object::Foreign))]));
    assert!(stays("  store [v3 + 4], v2\n", &[(3, within(Object::Instance, 0, 12))]));
    assert!(!stays("  store [v3 + 4], v2\n", &[(3, within(Object::Instance, 16, 64))]));
    assert!(!stays("  store [v3 + 4], v2\n", &[(3, within(Object::Frame, 0, 64))]));
    assert!(stays("  store [128], v2\n", &[]));
    assert!(!stays("  store [32], v2\n", &[]));
    assert!(stays("  v1 = load [v0 + 9]\n", &[]));
    assert!(stays("  v7 = native LEN(v2, v3)\n", &[]));
    assert!(!stays("  v6 = native SIN(v6)\n", &[]));
    assert!(stays("  fill_bytes [v0], 9, 0\n", &[]));
}

#[test]
fn bools_stay_in_memory() {
    let source = counting("  v1 = load [v0 + 16]\n");
    assert!(promoted(&source, &[]).contains("v1 = load [v0 + 16]"));
}

#[test]
fn a_cell_that_is_only_read_is_loaded_once() {
    let text = promoted(&counting("  v5 = load [v0 + 32]\n  v5 = load [32]\n  v5 = load [32]\n"), &[]);
    assert_eq!((count(&text, "load"), count(&text, "store")), (3, 1), "{text}");
}
