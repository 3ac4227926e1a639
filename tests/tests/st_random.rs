//! Random integer expressions and subscripts, compared with a model in wide numbers. Both engines run them.

use takt_image::{Elementary as E, Trap};
use takt_tests::plc::Plc;
use takt_tests::rng::Rng;

const INTEGERS: [E; 8] = [E::Sint, E::Int, E::Dint, E::Lint, E::Usint, E::Uint, E::Udint, E::Ulint];
/// Variables of each type.
const VARS: usize = 4;
const STATEMENTS: usize = 30;
const PROGRAMS: u64 = 40;

/// Text of an expression and its value; `None` if it divides by zero.
type Made = (String, Option<i128>);

struct Generator {
    rng: Rng,
    values: Vec<[i128; VARS]>,
}

fn wrap(e: E, v: i128) -> i128 {
    let (low, high) = e.int_range().expect("an integer");
    (v - low).rem_euclid(high - low + 1) + low
}

/// A value of the type: small, near a bound, or any.
fn value(rng: &mut Rng, e: E) -> i128 {
    let (low, high) = e.int_range().expect("an integer");
    let near = i128::from(rng.range(0, 3));
    match rng.below(4) {
        0 => wrap(e, near - 1).clamp(low, high),
        1 => low + near,
        2 => high - near,
        _ => wrap(e, i128::from(rng.bits())),
    }
}

impl Generator {
    fn new(seed: u64) -> Self {
        let mut rng = Rng::new(seed);
        let values = INTEGERS.iter().map(|e| std::array::from_fn(|_| value(&mut rng, *e))).collect();
        Self { rng, values }
    }

    fn variable(&mut self, t: usize) -> Made {
        let i = self.rng.below(VARS);
        (format!("v{t}_{i}"), Some(self.values[t][i]))
    }

    /// A literal that is not 0: a constant divisor of 0 is a compile error.
    fn literal(&mut self, t: usize) -> Made {
        let v = value(&mut self.rng, INTEGERS[t]);
        let v = if v == 0 { 3 } else { v };
        (format!("{}#{v}", INTEGERS[t].name()), Some(v))
    }

    fn expression(&mut self, t: usize, depth: u32) -> Made {
        if depth == 0 {
            return self.variable(t);
        }
        match self.rng.below(8) {
            0 => self.conversion(t, depth),
            1 => self.selection(t, depth),
            2 if INTEGERS[t].is_signed_int() => {
                let (text, v) = self.expression(t, depth - 1);
                (format!("(-{text})"), v.map(|v| wrap(INTEGERS[t], -v)))
            }
            _ => self.operation(t, depth),
        }
    }

    fn operation(&mut self, t: usize, depth: u32) -> Made {
        let e = INTEGERS[t];
        let (a, x) = self.expression(t, depth - 1);
        let (b, y) = if self.rng.one_in(3) { self.literal(t) } else { self.expression(t, depth - 1) };
        let op = self.rng.pick(&["+", "-", "*", "/", "MOD"]);
        let result = x.zip(y).and_then(|(x, y)| match op {
            "+" => Some(x + y),
            "-" => Some(x - y),
            "*" => Some((x as i64 as i128).wrapping_mul(y as i64 as i128)),
            "/" => x.checked_div(y),
            _ => Some(x.checked_rem(y).unwrap_or(0)),
        });
        (format!("({a} {op} {b})"), result.map(|v| wrap(e, v)))
    }

    fn conversion(&mut self, t: usize, depth: u32) -> Made {
        let from = self.rng.below(INTEGERS.len());
        let (text, v) = self.expression(from, depth - 1);
        (format!("{}_TO_{}({text})", INTEGERS[from].name(), INTEGERS[t].name()), v.map(|v| wrap(INTEGERS[t], v)))
    }

    fn selection(&mut self, t: usize, depth: u32) -> Made {
        let (a, x) = self.expression(t, depth - 1);
        let (b, y) = self.variable(t);
        let both = x.zip(y);
        match self.rng.below(4) {
            0 => (format!("MAX({a}, {b})"), both.map(|(x, y)| x.max(y))),
            1 => (format!("MIN({a}, {b})"), both.map(|(x, y)| x.min(y))),
            2 => (format!("SEL({a} > {b}, {a}, {b})"), both.map(|(x, y)| if x > y { y } else { x })),
            _ => (format!("ABS({a})"), x.map(|x| wrap(INTEGERS[t], x.abs()))),
        }
    }

    fn declarations(&self) -> String {
        let var = |t: usize, i: usize| format!("v{t}_{i} : {} := {}; ", INTEGERS[t].name(), self.values[t][i]);
        (0..INTEGERS.len()).flat_map(|t| (0..VARS).map(move |i| (t, i))).map(|(t, i)| var(t, i)).collect()
    }
}

#[test]
fn integer_expressions() {
    for seed in 0..PROGRAMS {
        let mut g = Generator::new(seed);
        let all = (0..STATEMENTS).map(|_| {
            let t = g.rng.below(INTEGERS.len());
            (t, g.expression(t, 3))
        });
        let all: Vec<_> = all.collect::<Vec<_>>().into_iter().filter(|(_, (_, v))| v.is_some()).collect();
        let results: String = all.iter().enumerate().map(|(i, (t, _))| format!("r{i} : {}; ", INTEGERS[*t].name())).collect();
        let body: String = all.iter().enumerate().map(|(i, (_, (text, _)))| format!("r{i} := {text};\n")).collect();
        let text = format!("PROGRAM p VAR {}{results}END_VAR\n{body}END_PROGRAM", g.declarations());
        let mut plc = Plc::new(&text);
        plc.scans(1);
        for (i, (_, (text, v))) in all.iter().enumerate() {
            assert_eq!(
                plc.get(&format!("p.r{i}")),
                v.expect("kept").to_string(),
                "seed {seed}: {text} with {}",
                g.declarations()
            );
        }
    }
}

/// Subscripts `i * a + b` in a loop: the program runs if all are inside, else it stops with `Index`.
#[test]
fn subscripts_in_loops() {
    let mut rng = Rng::new(5);
    let (mut inside, mut outside) = (0, 0);
    for _ in 0..250 {
        let small = |rng: &mut Rng, n: u32| i64::from(rng.range(0, 2 * n)) - i64::from(n);
        let (low, a, b) = (small(&mut rng, 5), small(&mut rng, 3), small(&mut rng, 6));
        let high = low + i64::from(rng.range(0, 12));
        let (from, to) = (small(&mut rng, 5), small(&mut rng, 5));
        let by = if rng.one_in(2) { 1 + i64::from(rng.range(0, 2)) } else { -1 - i64::from(rng.range(0, 2)) };
        let passes: Vec<i64> = std::iter::successors(Some(from), |i| Some(i + by))
            .take_while(|i| if by > 0 { *i <= to } else { *i >= to })
            .collect();
        let sum: i64 = passes.iter().map(|i| i * a + b).sum();
        let fits = passes.iter().all(|i| (low..=high).contains(&(i * a + b)));
        let text = format!(
            "PROGRAM p VAR x : ARRAY[{low}..{high}] OF DINT; i, s : DINT; END_VAR
             FOR i := {low} TO {high} DO x[i] := i; END_FOR; FOR i := {from} TO {to} BY {by} DO s := s + x[i * {a} + {b}]; END_FOR; END_PROGRAM"
        );
        let mut plc = Plc::new(&text);
        match plc.scan(0) {
            Ok(()) => assert!(fits && plc.get("p.s") == sum.to_string(), "{text}"),
            Err(fault) => assert!(!fits && fault.trap == Trap::Index, "{text}"),
        }
        if fits { inside += 1 } else { outside += 1 }
    }
    assert!(inside > 30 && outside > 30, "{inside} {outside}");
}
