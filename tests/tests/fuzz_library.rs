//! Standard functions of random arguments: as literals, which the compiler computes where it can, and as variables, on the
//! interpreter and as native code, in all profiles. A constant that is refused is passed over. `TAKT_RUNS` and `TAKT_SEED` set how
//! many and from where. From: library reference §1.

use takt_base::Profile;
use takt_image::{Elementary as E, Generic as G};
use takt_stdlib::catalog::{Function, Pattern, functions};
use takt_stdlib::lookup::converts;
use takt_stdlib::{ConversionType as C, native_conversion};
use takt_tests::plc::Plc;
use takt_tests::rng::Rng;

fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(default)
}

/// A literal of the type, mostly near its limits.
fn literal(random: &mut Rng, ty: C) -> String {
    let C::Elementary(e) = ty else {
        let text = random.pick(&["", "A", "ABC", "ABCBC", "12", "16#FF", "-7", "1.5E3", "T#5m", "TRUE", "x y"]);
        return if ty == C::String { format!("'{text}'") } else { format!("\"{text}\"") };
    };
    let day = random.pick(&["1970-01-01", "2024-02-29", "1969-12-31", "2100-03-01", "1700-01-01"]);
    let clock = random.pick(&["00:00:00", "23:59:59.999", "12:30:15.5", "07:05:03.250000001"]);
    match e {
        E::Bool => random.pick(&["TRUE", "FALSE"]).to_owned(),
        E::Real => format!(
            "REAL#{}",
            random.pick(&["0.0", "-0.0", "0.5", "2.5", "-2.5", "1.0E10", "-1.0E30", "0.3", "127.5", "32767.5"])
        ),
        E::Lreal => format!(
            "LREAL#{}",
            random.pick(&["0.0", "-0.0", "0.5", "2.5", "-2.5", "1.0E10", "-1.0E300", "0.3", "9.0E18", "1.0E-300"])
        ),
        E::Char => format!("'{}'", random.pick(&["A", "z", "$00", "$FF"])),
        E::Wchar => format!("\"{}\"", random.pick(&["A", "z", "$0000", "$00FF", "$20AC"])),
        E::Time | E::Ltime => {
            format!("{}#{}", e.name(), random.pick(&["0s", "5ms", "-5ms", "1d2h3m4s5ms6us7ns", "-1ns", "100000d"]))
        }
        E::Date | E::Ldate => format!("{}#{day}", e.name()),
        E::Tod | E::Ltod => format!("{}#{clock}", e.name()),
        E::Dt | E::Ldt => format!("{}#{day}-{clock}", e.name()),
        _ => integer(random, e),
    }
}

fn integer(random: &mut Rng, e: E) -> String {
    if e.is_bit() {
        return format!("{}#16#{:X}", e.name(), random.bits() >> (64 - e.bits()));
    }
    let (low, high) = e.int_range().expect("an integer");
    let value = random.pick(&[low, low + 1, 0, 1, 2, 3, 7, 10, high - 1, high]);
    format!("{}#{value}", e.name())
}

/// Types that T may be.
fn candidates(group: G) -> Vec<C> {
    let strings = matches!(group, G::AnyString | G::AnyElementary | G::Any);
    let fits = |ty: &C| match ty {
        C::Elementary(e) => e.is_in(group),
        _ => strings,
    };
    C::all().filter(fits).collect()
}

/// A call: result type, name, types of the arguments.
struct Call {
    result: C,
    name: String,
    args: Vec<C>,
}

fn call_of(random: &mut Rng, f: &Function) -> Call {
    let t = f.group().map(|group| {
        let all = candidates(group);
        all[random.below(all.len())]
    });
    let resolve = |random: &mut Rng, pattern| match pattern {
        Pattern::Is(e) => C::Elementary(e),
        Pattern::T(_) => t.expect("a common type"),
        Pattern::Own(G::AnyInt) => C::Elementary(random.pick(&[E::Int, E::Sint, E::Uint, E::Dint])),
        Pattern::Own(_) => C::Elementary(random.pick(&[E::Int, E::Lint, E::Lreal, E::Real])),
    };
    let mut args: Vec<C> = f.params.iter().map(|p| resolve(random, p.ty)).collect();
    if f.extensible && random.one_in(2) {
        args.push(*args.last().expect("inputs"));
    }
    let result = match f.result {
        Pattern::Own(_) => C::Elementary(E::Dint),
        pattern => resolve(random, pattern),
    };
    Call { result, name: f.name.to_owned(), args }
}

fn conversion(random: &mut Rng) -> Call {
    let all: Vec<C> = C::all().collect();
    loop {
        let (from, to) = (all[random.below(all.len())], all[random.below(all.len())]);
        let bits = |ty: C| matches!(ty, C::Elementary(e) if e.is_bit() && e != E::Bool);
        let real = |ty: C| matches!(ty, C::Elementary(e) if e.is_real());
        let transfer = bits(from) && real(to) || real(from) && bits(to);
        if converts(from, to) && !transfer {
            // Whether it is a native is of no importance, but the names must agree.
            let name = format!("{}_TO_{}", from.name(), to.name());
            assert!(native_conversion(from, to).is_none_or(|native| native == name));
            return Call { result: to, name, args: vec![from] };
        }
    }
}

/// False if the constant is refused or the call faults.
fn check(profile: Profile, random: &mut Rng, call: &Call) -> bool {
    let literals: Vec<_> = call.args.iter().map(|ty| literal(random, *ty)).collect();
    let variables: Vec<_> = (0..literals.len()).map(|i| format!("a{i}")).collect();
    let declared: String =
        variables.iter().zip(&call.args).zip(&literals).map(|((v, ty), l)| format!("{v} : {} := {l}; ", ty.name())).collect();
    let result = call.result.name();
    let program = |body: String| format!("PROGRAM p VAR {declared} x, y : {result}; END_VAR {body} END_PROGRAM");
    let folded = format!("x := {}({});", call.name, literals.join(", "));
    let computed = format!("y := {}({});", call.name, variables.join(", "));
    let text = program(format!("{folded} {computed}"));
    let Ok(mut plc) = Plc::load_in(profile, &text) else {
        // Alone the variables are never refused.
        let mut plc = Plc::new_in(profile, &program(computed));
        let _ = plc.scan(0);
        return false;
    };
    if plc.scan(0).is_err() {
        return false;
    }
    assert_eq!(plc.get("p.x"), plc.get("p.y"), "{text} in {profile:?}");
    true
}

fn run(mut next: impl FnMut(&mut Rng) -> Call) {
    let (seed, runs) = (setting("TAKT_SEED", 1), setting("TAKT_RUNS", 150));
    let (mut random, mut accepted) = (Rng::new(seed), 0);
    for _ in 0..runs {
        let call = next(&mut random);
        let profile = random.pick(&Profile::ALL);
        accepted += u64::from(check(profile, &mut random, &call));
    }
    assert!(2 * accepted > runs, "{accepted} of {runs}");
}

#[test]
fn functions_of_constants_are_as_at_run_time() {
    let all: Vec<&Function> = functions().filter(|f| !f.params.is_empty()).collect();
    run(|random| {
        let f = all[random.below(all.len())];
        call_of(random, f)
    });
}

#[test]
fn conversions_of_constants_are_as_at_run_time() {
    run(conversion);
}
