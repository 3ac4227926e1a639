//! Advice (P6 codes): each rule with hits and near misses, how to silence it, and silence about what ships with the project.

use takt_base::{Code, Profile, Severity};
use takt_tests::plc::compile_in;

/// `CODE marked text` of all advice about a file.
fn advice_in(profile: Profile, text: &str) -> Vec<String> {
    let c = compile_in(profile, text);
    assert!(c.image.is_some(), "{text}\n{:?}", c.diags);
    let advice = c.diags.iter().filter(|d| d.code.is_advice());
    advice
        .map(|d| {
            assert!(d.severity == Severity::Warning && d.help.is_some() && !d.label.is_empty(), "{d:?}");
            format!("{} {}", d.code.text(), c.sources.text(d.span))
        })
        .collect()
}

fn advice(text: &str) -> Vec<String> {
    advice_in(Profile::Std, text)
}

/// Advice of one code about a function with these variables behind an input `n`, and this body.
fn in_function(code: Code, vars: &str, body: &str) -> Vec<String> {
    let text = format!(
        "FUNCTION f : INT VAR_INPUT n : INT; END_VAR VAR {vars} END_VAR f := n;\n{body}\nEND_FUNCTION
        PROGRAM main VAR r : INT; END_VAR r := f(1); END_PROGRAM"
    );
    of(code, advice(&text))
}

/// The same about a program.
fn in_program(code: Code, vars: &str, body: &str) -> Vec<String> {
    of(code, advice(&format!("PROGRAM main VAR {vars} END_VAR\n{body}\nEND_PROGRAM")))
}

/// What is marked by one code.
fn of(code: Code, all: Vec<String>) -> Vec<String> {
    all.iter().filter_map(|a| a.strip_prefix(code.text())).map(|a| a.trim_start().to_owned()).collect()
}

#[test]
fn p6001_unreachable() {
    let hit = |body| in_program(Code::Unreachable, "x : INT; b : BOOL;", body);
    assert_eq!(hit("RETURN; ; x := 1; x := 2;"), ["x := 1"]);
    assert_eq!(hit("WHILE x < 9 DO x := x + 1; EXIT; x := 3; END_WHILE"), ["x := 3"]);
    assert_eq!(hit("IF b THEN RETURN; ELSE x := 1; RETURN; END_IF; x := 2;"), ["x := 2"]);
    assert_eq!(hit("CASE x OF 1: RETURN; ELSE RETURN; END_CASE; x := 2;"), ["x := 2"]);
    assert_eq!(hit("WHILE TRUE DO x := x + 1; IF b THEN RETURN; END_IF; END_WHILE; x := 2;"), ["x := 2"]);
    assert!(hit("IF b THEN RETURN; END_IF x := 1;").is_empty());
    assert!(hit("IF b THEN RETURN; ELSIF x > 1 THEN RETURN; END_IF x := 1;").is_empty());
    assert!(hit("CASE x OF 1: RETURN; END_CASE; x := 2;").is_empty());
    assert!(hit("FOR x := 1 TO 9 DO IF b THEN CONTINUE; END_IF END_FOR RETURN;").is_empty());
    assert!(hit("WHILE TRUE DO x := x + 1; IF b THEN EXIT; END_IF; END_WHILE; x := 2;").is_empty());
    assert!(hit("REPEAT x := x + 1; UNTIL x > 3 END_REPEAT; x := 2; IF FALSE THEN x := 3; END_IF;").is_empty());
    let jumps = "PROGRAM main VAR x : INT; END_VAR a: x := x + 1; IF x > 3 THEN JMP b; END_IF; JMP a; b: x := 2; JMP c; x := 3; c: ; END_PROGRAM";
    assert_eq!(of(Code::Unreachable, advice_in(Profile::Codesys, jumps)), ["x := 3"]);
}

#[test]
fn p6002_read_before_anything_is_assigned() {
    let hit = |vars, body| in_function(Code::NotYetAssigned, vars, body);
    assert_eq!(hit("a : INT;", "f := a; a := 1;"), ["a"]);
    assert_eq!(hit("a : INT;", "IF a > n THEN f := 2; END_IF;"), ["a"]);
    assert_eq!(hit("a, i : INT;", "FOR i := 1 TO a DO f := f + 1; END_FOR; a := 3;"), ["a"]);
    assert!(hit("a : INT := 0;", "f := a;").is_empty());
    assert!(hit("a : INT; b : INT;", "IF n > 1 THEN a := 1; END_IF; f := a; b := f; f := b;").is_empty());
    assert!(hit("sum, i : INT;", "FOR i := 1 TO n DO sum := sum + i; END_FOR; f := sum;").is_empty());
    assert!(
        hit("last, i : INT;", "WHILE i < n DO IF i > 2 THEN f := last; END_IF; last := i; i := i + 1; END_WHILE;").is_empty()
    );
    assert!(hit("l : ARRAY [0..3] OF INT;", "f := l[1];").is_empty());
    assert!(in_program(Code::NotYetAssigned, "a : INT; b : INT;", "b := a; a := 1;").is_empty());
    let temp = "PROGRAM main VAR x : INT; END_VAR VAR_TEMP t, u : INT; END_VAR x := t; u := x; t := u; END_PROGRAM";
    assert_eq!(of(Code::NotYetAssigned, advice(temp)), ["t"]);
    let lent = "FUNCTION g : INT VAR_IN_OUT io : INT; END_VAR VAR_OUTPUT o : INT; END_VAR io := 1; o := 2; g := 3; END_FUNCTION
        FUNCTION f : INT VAR a, b : INT; END_VAR f := g(io := a, o => b); f := a + b; END_FUNCTION
        PROGRAM main VAR r : INT; END_VAR r := f(); END_PROGRAM";
    assert!(advice(lent).is_empty());
}

#[test]
fn p6003_unused_variables() {
    assert_eq!(
        advice("PROGRAM main VAR a, b : INT; c : BOOL; t : TON; END_VAR a := 1; END_PROGRAM"),
        ["P6003 b", "P6003 c", "P6003 t"]
    );
    let fine = "VAR_GLOBAL g : INT; END_VAR
        FUNCTION f : INT VAR_INPUT a : INT; END_VAR VAR CONSTANT n : INT := 3; m : INT := n; END_VAR VAR t : ARRAY [0..n] OF INT; END_VAR
        t[0] := 1; f := t[0] + m; END_FUNCTION
        PROGRAM main VAR_EXTERNAL g : INT; END_VAR VAR x : INT; button AT %IX0.0 : BOOL; END_VAR x := f(g); END_PROGRAM";
    assert!(advice(fine).is_empty(), "{:?}", advice(fine));
    let external = "VAR_GLOBAL g : INT; END_VAR PROGRAM main VAR_EXTERNAL g : INT; END_VAR END_PROGRAM";
    assert_eq!(advice(external), ["P6003 g"]);
    let block = "FUNCTION_BLOCK b VAR x, y : INT; END_VAR METHOD PUBLIC m x := x + 1; THIS.y := 2; END_METHOD END_FUNCTION_BLOCK
        PROGRAM main VAR i : b; END_VAR i.m(); END_PROGRAM";
    assert!(advice(block).is_empty(), "{:?}", advice(block));
    let derived = "FUNCTION_BLOCK b VAR x : INT; END_VAR END_FUNCTION_BLOCK
        FUNCTION_BLOCK d EXTENDS b x := x + 1; END_FUNCTION_BLOCK PROGRAM main VAR i : d; END_VAR i(); END_PROGRAM";
    assert!(advice(derived).is_empty(), "{:?}", advice(derived));
    let il = "PROGRAM main VAR a, b, c : INT; END_VAR LD a\nADD b\nST a\nEND_PROGRAM";
    assert_eq!(advice(il), ["P6003 c"]);
    let c = "FUNCTION_BLOCK b VAR x : INT; END_VAR {extern int y; y = x;} END_FUNCTION_BLOCK
        PROGRAM main VAR a : INT; END_VAR a := a + 1; END_PROGRAM";
    assert!(advice_in(Profile::OpenPlc, c).is_empty(), "C may use it");
}

#[test]
fn p6004_never_read() {
    let hit = |vars, body| in_function(Code::NeverRead, vars, body);
    assert_eq!(hit("a : INT;", "a := n; a := 2;"), ["a"]);
    assert_eq!(hit("l : ARRAY [0..3] OF INT;", "l[n] := 1;"), ["l[n]"]);
    assert!(hit("a, i : INT;", "a := n; f := a; FOR i := 1 TO 3 DO f := f + 1; END_FOR;").is_empty());
    assert!(in_program(Code::NeverRead, "a : INT;", "a := 1;").is_empty());
    let thrown = "FUNCTION g : INT VAR_OUTPUT o : INT; END_VAR o := 1; g := 2; END_FUNCTION
        FUNCTION f : INT VAR a, b : INT; END_VAR a := g(o => b); f := 1; END_FUNCTION
        PROGRAM main VAR r : INT; END_VAR r := f(); END_PROGRAM";
    assert!(advice(thrown).is_empty(), "{:?}", advice(thrown));
}

#[test]
fn p6005_private_methods() {
    let text = |body: &str| {
        format!(
            "FUNCTION_BLOCK b METHOD PRIVATE m : INT m := 1; END_METHOD METHOD PRIVATE r : INT r := 2; END_METHOD {body} END_FUNCTION_BLOCK
            PROGRAM main VAR i : b; END_VAR i(); END_PROGRAM"
        )
    };
    assert_eq!(of(Code::UnusedMethod, advice(&text("VAR x : INT; END_VAR x := m();"))), ["r"]);
    assert!(of(Code::UnusedMethod, advice(&text("VAR x : INT; END_VAR x := m() + THIS.r();"))).is_empty());
}

#[test]
fn p6006_hidden_names() {
    let global = |vars: &str| {
        format!(
            "VAR_GLOBAL speed : INT; END_VAR FUNCTION ramp : INT ramp := 1; END_FUNCTION PROGRAM main {vars} speed := 1; END_PROGRAM"
        )
    };
    assert_eq!(advice(&global("VAR speed : INT; END_VAR")), ["P6006 speed"]);
    assert_eq!(advice(&global("VAR speed, ramp : INT; END_VAR ramp := 1;")), ["P6006 speed", "P6006 ramp"]);
    assert!(advice(&global("VAR_EXTERNAL speed : INT; END_VAR")).is_empty());
    assert!(advice(&global("VAR_OUTPUT speed : INT; END_VAR")).is_empty());
    let method = |section: &str| {
        format!(
            "FUNCTION_BLOCK b VAR x : INT; END_VAR METHOD PUBLIC m : INT {section} x : INT; END_VAR m := x + 1; x := m; END_METHOD x := 1; END_FUNCTION_BLOCK
            PROGRAM main VAR i : b; r : INT; mid : INT; END_VAR i(); r := i.m(); mid := 1; END_PROGRAM"
        )
    };
    assert_eq!(of(Code::HidesOuter, advice(&method("VAR"))), ["x"]);
    assert!(advice(&method("VAR_OUTPUT")).is_empty());
}

#[test]
fn p6007_equality_of_reals() {
    let hit = |body| in_program(Code::RealEquality, "a, b : REAL; l : LREAL; i : INT; q : BOOL; m : ARRAY [0..3] OF REAL;", body);
    assert_eq!(hit("q := a = b; q := l <> a; q := a = 1.5;"), ["a = b", "l <> a", "a = 1.5"]);
    assert!(hit("q := a = 0.0; q := i = 1; q := ABS(a - b) < 0.1; q := l > a; q := a <> a; q := a = INT_TO_REAL(i);").is_empty());
    assert!(hit("IF a <> b THEN b := a; END_IF; q := l = m[i]; l := m[3];").is_empty());
    assert!(hit("a := SEL(q, b, m[0]); q := a = b;").is_empty());
}

#[test]
fn p6008_conditions_with_one_outcome() {
    let vars = "u : USINT; i : INT; r : REAL; q : BOOL; y : BYTE; l : ARRAY [0..3] OF INT; p : INT (0..100); END_VAR VAR CONSTANT first : USINT := 0;";
    let hit = |body: &str| in_program(Code::OneOutcome, vars, body);
    for one in [
        "u < 0",
        "0 <= u",
        "u > 255",
        "i <= 32767",
        "i >= -32768",
        "i = i",
        "l[2] <> l[2]",
        "i <> 1 OR i <> 2",
        "i = 1 AND i = 2",
        "i > 9 AND i < 1",
        "i > 3 AND i < 4",
        "i < 5 OR i > 4",
        "r > 9.0 AND r < 1.0",
        "u >= 0 AND q",
        "p < 0",
        "q OR i <> 1 OR i <> 2",
    ] {
        assert_eq!(hit(&format!("q := {one};")).len(), 1, "{one}");
    }
    for fine in [
        "u > 0",
        "u <= 0",
        "u >= 255",
        "i < 0",
        "u = 0",
        "r <> r",
        "i <> 1 AND i <> 2",
        "i = 1 OR i = 2",
        "i > 1 AND i < 9",
        "i > 3 AND i < 5",
        "r > 1.0 OR r <= 1.0",
        "l[i] <> l[u]",
        "i < 1 OR i > 9",
        "u >= first",
        "i = 1 AND u = 2",
        "TRUE",
        "i >= 5 AND i <= 5",
    ] {
        let found = hit(&format!("q := {fine};"));
        assert!(found.is_empty(), "{fine}: {found:?}");
    }
    assert!(
        in_program(Code::OneOutcome, "q : BOOL;", "IF 2 > 1 THEN q := TRUE; END_IF; WHILE FALSE DO q := FALSE; END_WHILE;")
            .is_empty()
    );
}

#[test]
fn p6009_shifts() {
    let hit = |body| in_program(Code::ShiftTooFar, "b : BYTE; d : DWORD; n : INT;", body);
    assert_eq!(hit("b := SHL(b, 8); d := SHR(IN := d, N := 40);"), ["SHL(b, 8)", "SHR(IN := d, N := 40)"]);
    assert!(hit("b := SHL(b, 7); d := SHR(d, 31); d := SHL(d, n); d := ROL(d, 40);").is_empty());
}

#[test]
fn p6010_success() {
    let f = "FUNCTION safe : INT VAR_INPUT n : INT; END_VAR VAR_OUTPUT ENO : BOOL; END_VAR
        IF n > 9 THEN ENO := FALSE; RETURN; END_IF; safe := n; END_FUNCTION
        FUNCTION calm : INT VAR_INPUT n : INT; END_VAR VAR_OUTPUT ENO : BOOL; END_VAR ENO := TRUE; calm := n; END_FUNCTION";
    let hit = |body: &str| {
        of(Code::SuccessIgnored, advice(&format!("{f} PROGRAM main VAR x : INT; q, ok : BOOL; END_VAR {body} END_PROGRAM")))
    };
    assert_eq!(hit("x := 1 + ABS(EN := q, IN := x);"), ["ABS(EN := q, IN := x)"]);
    assert_eq!(hit("x := safe(x);"), ["safe(x)"]);
    assert!(hit("x := ABS(EN := q, IN := x);").is_empty());
    assert!(hit("x := 1 + ABS(EN := q, IN := x, ENO => ok);").is_empty());
    assert!(hit("x := safe(n := x, ENO => ok); x := calm(x);").is_empty());
}

#[test]
fn p6011_two_writers() {
    let text = |lamp: &str, a: &str, b: &str| {
        format!(
            "VAR_GLOBAL lamp AT {lamp}; flag : BOOL; END_VAR
            FUNCTION_BLOCK light VAR_EXTERNAL lamp : BOOL; END_VAR lamp := NOT lamp; END_FUNCTION_BLOCK
            PROGRAM one VAR_EXTERNAL lamp, flag : BOOL; END_VAR VAR l : light; END_VAR flag := TRUE; {a} END_PROGRAM
            PROGRAM two VAR_EXTERNAL lamp, flag : BOOL; END_VAR VAR l : light; own AT %QX0.1 : BOOL; END_VAR flag := FALSE; {b} END_PROGRAM"
        )
    };
    let hit = |lamp: &str, a: &str, b: &str| of(Code::TwoWriters, advice(&text(lamp, a, b)));
    let q = "%QX0.0 : BOOL";
    assert_eq!(hit(q, "lamp := TRUE;", "lamp := FALSE;"), ["lamp"]);
    assert_eq!(hit(q, "lamp := TRUE;", "%QX0.0 := FALSE;"), ["%QX0.0"]);
    assert_eq!(hit(q, "%QB0 := 16#FF;", "own := FALSE;"), ["own"]);
    assert_eq!(hit(q, "l();", "lamp := FALSE;"), ["lamp"]);
    assert!(hit(q, "lamp := TRUE;", "own := lamp;").is_empty());
    assert!(hit("%MX0.0 : BOOL", "lamp := TRUE;", "lamp := FALSE;").is_empty());
    assert!(hit(q, "%QX0.2 := TRUE; lamp := TRUE;", "own := FALSE;").is_empty());
}

#[test]
fn p6012_overwritten() {
    let hit = |body: &str| {
        let text = format!(
            "FUNCTION_BLOCK b VAR_INPUT n : INT; END_VAR VAR_OUTPUT q, r : INT; END_VAR VAR x : INT; END_VAR x := n; x := x; {body} END_FUNCTION_BLOCK
            FUNCTION_BLOCK c VAR_OUTPUT o : INT; END_VAR o := o + 1; END_FUNCTION_BLOCK
            PROGRAM main VAR i : b; k : c; END_VAR i(); k(); END_PROGRAM"
        );
        of(Code::Overwritten, advice(&text))
    };
    assert_eq!(hit("q := 1; q := 2;"), ["q"]);
    assert_eq!(hit("q := 1; IF n > 1 THEN r := 2; END_IF; q := n;"), ["q"]);
    assert_eq!(hit("IF n > 1 THEN q := 1; r := 3; q := 2; END_IF;"), ["q"]);
    assert!(hit("q := 0; IF n > 1 THEN q := 2; END_IF; r := q;").is_empty());
    assert!(hit("q := 1; r := q; q := 2; q := q + 1;").is_empty());
    assert!(hit("q := 1; IF n > 1 THEN RETURN; END_IF; q := 2;").is_empty());
    assert!(hit("q := 1; IF n > 1 THEN r := q; END_IF; q := 2;").is_empty());
    assert!(hit("CASE n OF 1: q := 1; 2: q := 2; ELSE q := 3; END_CASE;").is_empty());
    assert!(hit("FOR r := 0 TO 3 DO q := r; END_FOR;").is_empty());
    let global = |between: &str| {
        format!(
            "VAR_GLOBAL g : INT; END_VAR FUNCTION f : INT VAR_EXTERNAL g : INT; END_VAR f := g; END_FUNCTION
            PROGRAM main VAR_EXTERNAL g : INT; END_VAR VAR x : INT; END_VAR g := 1; x := {between}; g := 2; END_PROGRAM"
        )
    };
    assert_eq!(of(Code::Overwritten, advice(&global("3"))), ["g"]);
    assert!(advice(&global("f()")).is_empty());
}

#[test]
fn p6013_self_assignment() {
    let types = "TYPE S : STRUCT a, b : INT; END_STRUCT END_TYPE";
    let hit = |body| {
        let text = format!("{types} PROGRAM main VAR s : S; x : INT; l : ARRAY [0..3] OF INT; END_VAR {body} END_PROGRAM");
        of(Code::SelfAssignment, advice(&text))
    };
    assert_eq!(hit("x := x; s.b := s.b; l[1] := l[1]; l[x] := l[x];"), ["x := x", "s.b := s.b", "l[1] := l[1]", "l[x] := l[x]"]);
    assert!(hit("x := x + 1; s.a := s.b; l[x] := l[x + 1]; l[1] := l[2];").is_empty());
}

#[test]
fn pragmas_silence_regions() {
    let text = |before: &str, between: &str| {
        format!(
            "PROGRAM main VAR x, y : INT; END_VAR\n{before}\nx := x;\n{between}\ny := y;\nEND_PROGRAM\nFUNCTION f : INT VAR a : INT; END_VAR f := 1; END_FUNCTION"
        )
    };
    let all = ["P6013 x := x", "P6013 y := y", "P6003 a"];
    assert_eq!(advice(&text("", "")), all);
    assert_eq!(advice(&text("{warning disable P6013}", "{warning restore P6013}")), all[1..]);
    assert_eq!(advice(&text("{warning disable P6013}", "")), all[2..]);
    assert!(advice(&text("{warning disable p6013, P6003}", "")).is_empty());
    assert_eq!(advice(&text("{warning disable C0371}", "{warning 'note'}")), all);
    // Other warnings can be silenced too, errors can't.
    let codes = |text: &str| compile_in(Profile::Std, text).diags.iter().map(|d| d.code.text()).collect::<Vec<_>>();
    assert!(codes("{warning disable P3012} FUNCTION f : INT END_FUNCTION PROGRAM main END_PROGRAM").is_empty());
    assert_eq!(codes("{warning disable P1003} PROGRAM main x := 1; END_PROGRAM"), ["P1003"]);
}

/// After an error there is no advice: what is wrong is left out of the program, and much would seem unused.
#[test]
fn errors_come_first() {
    let c = compile_in(Profile::Std, "PROGRAM main VAR x, y : INT; END_VAR x := y + 'a'; END_PROGRAM");
    assert!(c.diags.iter().all(|d| !d.code.is_advice()) && c.image.is_none());
}
