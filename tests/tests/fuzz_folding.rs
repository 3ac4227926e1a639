//! What the compiler computes beforehand is what the machine computes: random expressions of literals beside the same expressions of
//! variables. A constant that is refused (overflow, division by zero) is passed over. `TAKT_RUNS` and `TAKT_SEED` set how many and from where.

use takt_image::Trap;
use takt_tests::plc::Plc;
use takt_tests::rng::Rng;

const TYPES: [&str; 10] = ["SINT", "INT", "DINT", "LINT", "USINT", "UDINT", "REAL", "LREAL", "WORD", "TIME"];

fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(default)
}

/// Grows one expression in two forms.
struct Twin {
    random: Rng,
    vars: String,
}

/// With literals, with variables.
type Texts = (String, String);

impl Twin {
    fn leaf(&mut self, ty: &str) -> Texts {
        let n = self.random.below(100);
        let literal = match ty {
            "BOOL" => self.random.pick(&["TRUE", "FALSE"]).to_owned(),
            "REAL" | "LREAL" => format!("{ty}#{}", self.random.pick(&["0.1", "-2.5", "3.0", "1.0E7", "7.25", "-0.0", "1.0E-20"])),
            "WORD" => format!("WORD#16#{:X}", self.random.bits() >> 48),
            "TIME" => format!("T#{n}ms{n}us"),
            "USINT" | "UDINT" => format!("{ty}#{}", n % 16),
            _ => format!("{ty}#{}", n as i64 % 14 - 6),
        };
        let name = format!("k{}", self.vars.matches(';').count());
        self.vars += &format!("{name} : {ty} := {literal};");
        (literal, name)
    }

    fn grow(&mut self, ty: &str, depth: usize) -> Texts {
        if depth == 0 || self.random.one_in(6) {
            return self.leaf(ty);
        }
        match (ty, self.random.below(6)) {
            ("BOOL", 0..=2) => {
                let of = self.random.pick(&TYPES);
                self.pair(of, &["=", "<>", "<", ">", "<=", ">="], depth)
            }
            ("BOOL", _) => self.pair(ty, &["AND", "OR", "XOR"], depth),
            (_, 0) => {
                let (g, a, b) = (self.grow("BOOL", depth - 1), self.grow(ty, depth - 1), self.grow(ty, depth - 1));
                (format!("SEL({}, {}, {})", g.0, a.0, b.0), format!("SEL({}, {}, {})", g.1, a.1, b.1))
            }
            ("WORD", 1) => self.one("NOT ", ty, depth),
            ("WORD", _) => self.pair(ty, &["AND", "OR", "XOR"], depth),
            ("TIME", _) => self.pair(ty, &["+", "-"], depth),
            ("REAL" | "LREAL", 1) => self.one("-", ty, depth),
            ("REAL" | "LREAL", 2) => self.converted(ty, depth),
            ("REAL" | "LREAL", _) => self.pair(ty, &["+", "-", "*", "/"], depth),
            ("USINT" | "UDINT", 1) => self.pair(ty, &["+", "*"], depth),
            ("SINT" | "INT" | "DINT" | "LINT", 1) => self.one("-", ty, depth),
            _ => self.pair(ty, &["+", "-", "*", "/", "MOD"], depth),
        }
    }

    fn pair(&mut self, ty: &str, operators: &[&'static str], depth: usize) -> Texts {
        let (a, b, op) = (self.grow(ty, depth - 1), self.grow(ty, depth - 1), self.random.pick(operators));
        (format!("({} {op} {})", a.0, b.0), format!("({} {op} {})", a.1, b.1))
    }

    fn one(&mut self, operator: &str, ty: &str, depth: usize) -> Texts {
        let a = self.grow(ty, depth - 1);
        (format!("({operator}({}))", a.0), format!("({operator}({}))", a.1))
    }

    fn converted(&mut self, ty: &str, depth: usize) -> Texts {
        let from = self.random.pick(&["INT", "LINT", "USINT"]);
        let a = self.grow(from, depth - 1);
        (format!("{from}_TO_{ty}({})", a.0), format!("{from}_TO_{ty}({})", a.1))
    }
}

/// `None` if the constant is refused or a divisor is zero.
fn check(seed: u64) -> Option<()> {
    let mut twin = Twin { random: Rng::new(seed), vars: String::new() };
    let ty = if twin.random.one_in(4) { "BOOL" } else { twin.random.pick(&TYPES) };
    let (literals, variables) = twin.grow(ty, 4);
    let declared = format!("{} x, y : {ty};", twin.vars);
    let program = |statement: &str| format!("PROGRAM p VAR {declared} END_VAR {statement} END_PROGRAM");
    let mut plc = Plc::load(&program(&format!("x := {literals}; y := {variables};"))).ok()?;
    if plc.scan(0).is_err_and(|fault| fault.trap == Trap::DivisionByZero) {
        return None;
    }
    assert_eq!(plc.get("p.x"), plc.get("p.y"), "seed {seed}: {literals}");
    Some(())
}

#[test]
fn constants_are_computed_as_at_run_time() {
    let (first, runs) = (setting("TAKT_SEED", 1), setting("TAKT_RUNS", 300));
    let accepted = (first..first + runs).filter_map(check).count() as u64;
    println!("{accepted} of {runs} accepted");
    assert!(2 * accepted > runs, "{accepted} of {runs}");
}

/// With variables alone every expression is accepted.
#[test]
fn variables_are_never_refused() {
    for seed in 1..200 {
        let mut twin = Twin { random: Rng::new(seed), vars: String::new() };
        let (_, variables) = twin.grow("DINT", 4);
        let text = format!("PROGRAM p VAR {} x : DINT; END_VAR x := {variables}; END_PROGRAM", twin.vars);
        assert!(Plc::load(&text).is_ok(), "{text}");
    }
}
