//! FOR at the ends of its type, against a model in wide integers. From: language reference §5.6.

use takt_tests::plc::{Plc, check};
use takt_tests::rng::Rng;

/// Passes and last value: the trip count is computed without overflow; a value that is not representable is not stored.
fn model(from: i128, to: i128, by: i128, low: i128, high: i128) -> (u64, i128) {
    let (mut v, mut passes) = (from, 0);
    while (by > 0 && v <= to) || (by < 0 && v >= to) {
        passes += 1;
        if !(low..=high).contains(&(v + by)) {
            break;
        }
        v += by;
    }
    (passes, v)
}

fn program(ty: &str) -> String {
    format!(
        "PROGRAM p VAR v, a, b, s : {ty}; n : DINT; END_VAR
        n := 0; FOR v := a TO b BY s DO n := n + 1; END_FOR END_PROGRAM"
    )
}

/// A number near an end of the type, near zero, or any.
fn number(random: &mut Rng, low: i128, high: i128) -> i128 {
    let near = random.below(5) as i128;
    match random.below(4) {
        0 => low + near,
        1 => high - near,
        2 => (near - 2).clamp(low, high),
        _ => low + i128::from(random.bits()) % (high - low + 1),
    }
}

#[test]
fn variable_ends_and_steps() {
    for (ty, low, high) in [("SINT", -128, 127), ("USINT", 0, 255)] {
        let mut plc = Plc::new(&program(ty));
        let mut random = Rng::new(5);
        for _ in 0..1500 {
            let [a, b, s] = std::array::from_fn(|_| number(&mut random, low, high));
            if s == 0 {
                continue;
            }
            run(&mut plc, [a, b, s], model(a, b, s, low, high));
        }
    }
}

/// Wide types: steps so large that there are few passes.
#[test]
fn wide_types() {
    let wide = [
        ("INT", i128::from(i16::MIN), i128::from(i16::MAX)),
        ("UINT", 0, i128::from(u16::MAX)),
        ("DINT", i128::from(i32::MIN), i128::from(i32::MAX)),
        ("UDINT", 0, i128::from(u32::MAX)),
        ("LINT", i128::from(i64::MIN), i128::from(i64::MAX)),
        ("ULINT", 0, i128::from(u64::MAX)),
    ];
    for (ty, low, high) in wide {
        let mut plc = Plc::new(&program(ty));
        let mut random = Rng::new(9);
        for _ in 0..300 {
            let (a, b) = (number(&mut random, low, high), number(&mut random, low, high));
            let step = (b - a) / (1 + random.below(6) as i128);
            let s = if step == 0 || !(low..=high).contains(&step) { high / 3 } else { step };
            run(&mut plc, [a, b, s], model(a, b, s, low, high));
        }
    }
}

fn run(plc: &mut Plc, [a, b, s]: [i128; 3], (passes, last): (u64, i128)) {
    for (name, value) in [("p.a", a), ("p.b", b), ("p.s", s)] {
        plc.set(name, &value.to_string());
    }
    assert_eq!(plc.scan(0), Ok(()), "{a} TO {b} BY {s}");
    assert_eq!((plc.get("p.n"), plc.get("p.v")), (passes.to_string(), last.to_string()), "{a} TO {b} BY {s}");
}

/// The same with literals, which the compiler may count beforehand.
#[test]
fn constant_ends_and_steps() {
    let mut random = Rng::new(17);
    let mut vars = String::from("n : DINT;");
    let (mut body, mut expected) = (String::new(), Vec::new());
    for i in 0..120 {
        let (ty, low, high) = random.pick(&[("SINT", -128, 127), ("USINT", 0, 255)]);
        let [a, b, s] = std::array::from_fn(|_| number(&mut random, low, high));
        let s = if s == 0 { 1 } else { s };
        let (passes, last) = model(a, b, s, low, high);
        vars += &format!("v{i} : {ty}; n{i} : DINT;");
        body += &format!("FOR v{i} := {a} TO {b} BY {s} DO n{i} := n{i} + 1; END_FOR;\n");
        expected.push((format!("v{i}"), last.to_string()));
        expected.push((format!("n{i}"), passes.to_string()));
    }
    let expected: Vec<_> = expected.iter().map(|(name, value)| (name.as_str(), value.as_str())).collect();
    check(&vars, &body, &expected);
}
