//! Functions, function blocks, programs and tasks, run on both engines. From: language reference §4, §10; library reference §10.

use takt_base::Severity;
use takt_image::{NativeKind, Scalar, Trap};
use takt_tests::plc::{Plc, check_in, check_program, compile_st, fault};

#[test]
fn functions_with_outputs_and_in_outs() {
    let f =
        "FUNCTION split : INT VAR_INPUT x : INT; END_VAR VAR_OUTPUT q, r : INT; z : BOOL; END_VAR VAR_IN_OUT n : DINT; END_VAR
        q := x / 10; r := x MOD 10; z := r = 0; n := n + 1; split := q + r; END_FUNCTION";
    let body = "s := split(x := 47, q => a, r => b, NOT z => c, n := k); s := s * 100 + split(x := 50, n := k, r => b);";
    check_in(f, "s, a, b : INT; c : BOOL; k : DINT;", body, &[("s", "1105"), ("a", "4"), ("b", "0"), ("c", "TRUE"), ("k", "2")]);
}

#[test]
fn results_of_all_shapes() {
    let f = "TYPE Pt : STRUCT x, y : INT; END_STRUCT; A : ARRAY[1..3] OF INT; END_TYPE
        FUNCTION point : Pt VAR_INPUT x, y : INT; END_VAR point.x := x; point.y := y; END_FUNCTION
        FUNCTION turn : Pt VAR_INPUT p : Pt; END_VAR turn.x := -p.y; turn.y := p.x; END_FUNCTION
        FUNCTION three : A VAR_INPUT n : INT; END_VAR three[1] := n; three[3] := 3 * n; END_FUNCTION
        FUNCTION greet : STRING[12] VAR_INPUT who : STRING[5]; END_VAR greet := CONCAT('hello ', who); END_FUNCTION
        FUNCTION half : REAL VAR_INPUT x : REAL; END_VAR half := x / 2.0; END_FUNCTION";
    let body = "p := turn(turn(point(1, 2))); a := three(4); s := greet(greet('world')); r := half(3.0); p2 := turn(p := p);";
    check_in(
        f,
        "p, p2 : Pt; a : A; s : STRING[30]; r : REAL;",
        body,
        &[("p", "(x := -1, y := -2)"), ("a", "[4, 0, 12]"), ("s", "'hello hello'"), ("r", "1.5"), ("p2", "(x := 2, y := -1)")],
    );
}

/// Aggregates are passed by value even though only an offset is handed over.
#[test]
fn inputs_are_not_aliases() {
    let f = "TYPE A : ARRAY[1..2] OF INT; END_TYPE VAR_GLOBAL g : A := [1, 2]; END_VAR
        FUNCTION f : INT VAR_INPUT a : A; END_VAR VAR_IN_OUT b : A; END_VAR b[1] := 100; f := a[1]; END_FUNCTION
        FUNCTION k : INT VAR_INPUT a : A; END_VAR VAR_EXTERNAL g : A; END_VAR g[1] := 50; k := a[1]; END_FUNCTION
        FUNCTION bump : INT VAR_EXTERNAL g : A; END_VAR g[2] := g[2] + 1; bump := g[2]; END_FUNCTION
        FUNCTION second : INT VAR_INPUT a : A; n : INT; END_VAR second := a[2] * 10 + n; END_FUNCTION";
    let vars = "x : A := [7, 8]; r, s, t : INT; END_VAR VAR_EXTERNAL g : A;";
    check_in(
        f,
        vars,
        "r := f(a := x, b := x); s := k(g); t := second(g, bump());",
        &[("r", "7"), ("s", "1"), ("t", "23"), ("x", "[100, 8]")],
    );
}

/// §18 example 8.
#[test]
fn in_outs_alias() {
    let f = "FUNCTION_BLOCK swap VAR_IN_OUT a, b : INT; END_VAR VAR t : INT; END_VAR t := a; a := b; b := t; END_FUNCTION_BLOCK";
    check_in(
        f,
        "s : swap; x : INT := 5; y : INT := 6; z : ARRAY[1..2] OF INT := [1, 2]; i : INT := 2;",
        "s(a := x, b := x); s(a := x, b := y); s(a := z[1], b := z[i]);",
        &[("x", "6"), ("y", "5"), ("z", "[2, 1]")],
    );
}

#[test]
fn bits_of_the_process_image_can_be_lent() {
    let text = "FUNCTION set : BOOL VAR_IN_OUT b : BOOL; END_VAR VAR_OUTPUT o : BOOL; END_VAR set := b; b := NOT b; o := b; END_FUNCTION
        FUNCTION_BLOCK flip VAR_IN_OUT b : BOOL; END_VAR VAR_OUTPUT o : BOOL; END_VAR b := NOT b; o := b; END_FUNCTION_BLOCK
        PROGRAM p VAR q AT %QX0.3 : BOOL; w AT %QX0.5 : BOOL; f : flip; r : BOOL; END_VAR r := set(b := q, o => w); f(b := w, o => q); END_PROGRAM";
    check_program(text, 1, &[("p.q", "FALSE"), ("p.w", "FALSE"), ("p.r", "FALSE")]);
    check_program(text, 2, &[("p.q", "FALSE"), ("%QB0", "0")]);
}

#[test]
fn recursion_works_and_its_depth_is_limited() {
    let f = "FUNCTION fib : DINT VAR_INPUT n : DINT; END_VAR IF n < 2 THEN fib := n; ELSE fib := fib(n - 1) + fib(n - 2); END_IF; END_FUNCTION";
    check_in(f, "r : DINT;", "r := fib(15);", &[("r", "610")]);
    let f = "FUNCTION deep : DINT\nVAR_INPUT n : DINT; END_VAR VAR a : ARRAY[1..1000] OF DINT; END_VAR\na[1] := n; deep := deep(n + a[1]);\nEND_FUNCTION PROGRAM p VAR r : DINT; END_VAR r := deep(1); END_PROGRAM";
    assert_eq!(fault(f).0, Trap::StackOverflow);
}

#[test]
fn nested_blocks_keep_their_state() {
    let f = "FUNCTION_BLOCK count VAR_INPUT inc : INT := 1; END_VAR VAR_OUTPUT n : INT; END_VAR n := n + inc; END_FUNCTION_BLOCK
        FUNCTION_BLOCK pair VAR_INPUT k : INT; END_VAR VAR_OUTPUT sum : INT; END_VAR VAR a, b : count; END_VAR
        a(); b(inc := k); sum := a.n + b.n; END_FUNCTION_BLOCK
        PROGRAM p VAR x : pair; y : ARRAY[1..2] OF pair; i, s : INT; END_VAR
        x(k := 10); FOR i := 1 TO 2 DO y[i](k := i, sum => s); END_FOR; y[2].a(inc := 100); END_PROGRAM";
    check_program(
        f,
        3,
        &[
            ("p.x.sum", "33"),
            ("p.y[1].sum", "6"),
            ("p.y[2].sum", "407"),
            ("p.s", "407"),
            ("p.x.b.n", "30"),
            ("p.y[2].a.n", "501"),
        ],
    );
}

#[test]
fn outputs_are_copied_negated_and_widened() {
    let f = "FUNCTION_BLOCK o VAR_INPUT x : INT; END_VAR VAR_OUTPUT b : BOOL; n : INT; s : STRING[5]; END_VAR b := x > 0; n := x; s := CONCAT('abcd', 'efg'); END_FUNCTION_BLOCK";
    check_in(
        f,
        "f : o; b, c : BOOL; d : DINT; r : REAL; s : STRING[3];",
        "f(x := 5, b => b, n => d, s => s); f(x := -7, NOT b => c, n => r);",
        &[("b", "TRUE"), ("c", "TRUE"), ("d", "5"), ("r", "-7.0"), ("s", "'abc'")],
    );
}

/// §18 example 7.
#[test]
fn edge_inputs() {
    let text = "FUNCTION_BLOCK e VAR_INPUT c : BOOL R_EDGE; d : BOOL F_EDGE; END_VAR VAR_OUTPUT r, f : BOOL; n : INT; END_VAR
        r := c; f := d; IF c THEN n := n + 1; END_IF; END_FUNCTION_BLOCK
        PROGRAM p VAR x : BOOL; e1 : e; k : INT; END_VAR e1(c := x, d := x); END_PROGRAM";
    let mut plc = Plc::new(text);
    let seen = ["FALSE", "TRUE", "TRUE", "FALSE", "TRUE"].map(|x| {
        plc.set("p.x", x);
        plc.scans(1);
        (plc.get("p.e1.r") == "TRUE", plc.get("p.e1.f") == "TRUE")
    });
    assert_eq!(seen, [(false, false), (true, false), (false, false), (false, true), (true, false)]);
    assert_eq!(plc.get("p.e1.n"), "2");
}

#[test]
fn timers_follow_the_time_of_the_scan() {
    let text = "PROGRAM p VAR x : BOOL; t : TON := (PT := T#25ms); f : TOF; p1 : TP; c : CTU; r : R_TRIG; q : BOOL; END_VAR
        t(IN := x); f(IN := x, PT := T#15ms); p1(IN := x, PT := T#20ms); r(CLK := x); c(CU := x, PV := 2, Q => q); END_PROGRAM";
    let mut plc = Plc::new(text);
    plc.set("p.x", "TRUE");
    let on: Vec<_> = (0..5)
        .map(|i| {
            plc.scan(100 + 10 * i).expect("no fault");
            [plc.get("p.t.Q"), plc.get("p.t.ET"), plc.get("p.p1.Q"), plc.get("p.r.Q")].join(" ")
        })
        .collect();
    assert_eq!(
        on,
        [
            "FALSE T#0s TRUE TRUE",
            "FALSE T#10ms TRUE FALSE",
            "FALSE T#20ms FALSE FALSE",
            "TRUE T#25ms FALSE FALSE",
            "TRUE T#25ms FALSE FALSE"
        ]
    );
    plc.set("p.x", "FALSE");
    let off: Vec<_> = (0..3)
        .map(|i| {
            plc.scan(150 + 10 * i).expect("no fault");
            [plc.get("p.t.Q"), plc.get("p.f.Q"), plc.get("p.c.CV")].join(" ")
        })
        .collect();
    assert_eq!(off, ["FALSE TRUE 1", "FALSE TRUE 1", "FALSE FALSE 1"]);
}

/// §10.3.
#[test]
fn program_connections() {
    let text = "PROGRAM add VAR_INPUT a : INT; b : BOOL; END_VAR VAR_OUTPUT s : INT; q : BOOL; END_VAR s := a + 1; q := NOT b; END_PROGRAM
        CONFIGURATION c VAR_GLOBAL g : INT := 5; h : INT; trig : BOOL; END_VAR
        RESOURCE r ON plc
        TASK t (INTERVAL := T#10ms, PRIORITY := 1); TASK e (SINGLE := trig, PRIORITY := 0);
        PROGRAM one WITH t : add (a := g, b := %IX0.2, s => h, q => %QX0.4); PROGRAM two WITH e : add (a := 41);
        END_RESOURCE END_CONFIGURATION";
    let mut plc = Plc::new(text);
    plc.scans(1);
    assert_eq!(["h", "%QX0.4", "one.s", "two.s"].map(|v| plc.get(v)), ["6", "TRUE", "6", "42"]);
    let tasks: Vec<_> =
        plc.image.tasks.iter().map(|t| (t.name.as_str(), t.priority, t.interval.map(|i| i.0), t.trigger.is_some())).collect();
    assert_eq!(tasks, [("t", 1, Some(10_000_000), false), ("e", 0, None, true)]);
}

#[test]
fn faults_are_found_in_called_units() {
    let text = "FUNCTION inv : INT\nVAR_INPUT x : INT; END_VAR\ninv := 100 / x;\nEND_FUNCTION\nPROGRAM p VAR r, z : INT; END_VAR\nr := inv(z);\nEND_PROGRAM";
    assert_eq!(fault(text), (Trap::DivisionByZero, 3));
}

#[test]
fn external_units_are_imports() {
    let text = "{external} FUNCTION_BLOCK MC_Test VAR_INPUT Execute : BOOL; END_VAR VAR_OUTPUT Done : BOOL; END_VAR END_FUNCTION_BLOCK
        {external} FUNCTION Probe : LREAL VAR_INPUT n : INT; s : STRING[10]; END_VAR VAR_IN_OUT x : DINT; END_VAR END_FUNCTION
        PROGRAM p VAR m : MC_Test; x : DINT; r : LREAL; d : BOOL; END_VAR m(Execute := TRUE, Done => d); r := Probe(n := 3, s := 'ab', x := x); END_PROGRAM";
    let image = compile_st(text).image.expect("no errors");
    let imports: Vec<_> = image.natives.iter().map(|n| n.name.as_str()).collect();
    assert_eq!(imports, ["MC_Test", "Probe"]);
    assert!(matches!(&image.natives[0].kind, NativeKind::Block { ty } if image.types.display(*ty) == "MC_Test"));
    let params = vec![Scalar::I16, Scalar::I32, Scalar::I32, Scalar::I32];
    assert_eq!(image.natives[1].kind, NativeKind::Function { params, result: Some(Scalar::F64) });
}

/// P2016.
#[test]
fn memory_is_limited() {
    let codes = |text: &str| compile_st(text).diags.iter().map(|d| (d.code.text(), d.severity)).collect::<Vec<_>>();
    let error = [("P2016", Severity::Error)];
    assert_eq!(codes("PROGRAM p VAR a : ARRAY[1..200000000] OF LREAL; END_VAR END_PROGRAM"), error);
    assert_eq!(codes("PROGRAM p VAR a, b, c : ARRAY[1..50000000] OF LREAL; END_VAR END_PROGRAM"), error);
    let f = "FUNCTION f : INT VAR a : ARRAY[1..2000000] OF INT; END_VAR f := a[2]; END_FUNCTION PROGRAM p VAR n : INT; END_VAR n := f(); END_PROGRAM";
    assert_eq!(codes(f), error);
}

/// A block that is a global variable may be reached by its name and as the running instance.
#[test]
fn global_blocks_see_themselves() {
    let text = "VAR_GLOBAL g : count; END_VAR
        FUNCTION_BLOCK count VAR_INPUT a : DINT; END_VAR VAR_OUTPUT n : DINT; END_VAR VAR i : DINT; END_VAR
        FOR i := 1 TO 3 DO n := n + a; IF g.n > 3 THEN g.a := 10; END_IF; END_FOR; END_FUNCTION_BLOCK
        PROGRAM p VAR_EXTERNAL g : count; END_VAR VAR d : DINT; END_VAR g(a := 2); d := g.n; END_PROGRAM";
    check_program(text, 1, &[("p.d", "14")]);
}

/// A function that nothing but the connection of a program calls.
#[test]
fn connections_call_functions() {
    let text = "TYPE S : STRUCT a, b : INT; END_STRUCT; END_TYPE
        FUNCTION twice : INT VAR_INPUT a : INT; END_VAR twice := inner(a) * 2; END_FUNCTION
        FUNCTION inner : INT VAR_INPUT a : INT; END_VAR inner := a + 1; END_FUNCTION
        FUNCTION pair : S VAR_INPUT a : INT; END_VAR pair.a := a; pair.b := a + 5; END_FUNCTION
        PROGRAM p VAR_INPUT i : INT; s : S; END_VAR VAR x, y : INT; END_VAR x := i; y := s.b; END_PROGRAM
        CONFIGURATION c VAR_GLOBAL g : INT := 20; END_VAR
        RESOURCE r ON PLC TASK t(INTERVAL := T#10ms, PRIORITY := 1);
        PROGRAM q WITH t : p (i := twice(g), s := pair(g)); END_RESOURCE END_CONFIGURATION";
    check_program(text, 1, &[("q.x", "42"), ("q.y", "25")]);
}
