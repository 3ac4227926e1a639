//! Instruction List, run on both engines. From: language reference §6 and §18 item 1.

use takt_base::Profile;
use takt_tests::plc::{Plc, check, check_in, compile_st};

/// Runs a list; `expected` are the values afterwards.
fn list(vars: &str, lines: &str, expected: &[(&str, &str)]) {
    check(vars, &lines.replace(" / ", "\n"), expected);
}

/// The codes and lines that a list gives; the first instruction stands in line 1.
fn codes(vars: &str, lines: &str) -> Vec<String> {
    let text = format!("PROGRAM p VAR {vars} END_VAR {}\nEND_PROGRAM", lines.replace(" / ", "\n"));
    let c = compile_st(&text);
    let place = |d: &takt_base::Diag| c.sources.line_col(d.span.source, d.span.start).line;
    c.diags.iter().map(|d| format!("{} {}", d.code.text(), place(d))).collect()
}

/// §18 item 1.
#[test]
fn the_examples_of_the_reference() {
    for bits in 0..8 {
        let [a, b, c] = [0, 1, 2].map(|i| bits >> i & 1 == 1);
        let vars = format!("a : BOOL := {a}; b : BOOL := {b}; c : BOOL := {c}; q : BOOL;");
        let want = if a && !(b || c) { "TRUE" } else { "FALSE" };
        list(&vars, "LD a / ANDN( b / OR c / ) / ST q", &[("q", want)]);
    }
    list("i : INT;", "LD 5 / SUB( 2 / MUL 3 / ) / ST i", &[("i", "-1")]);
    list("x : INT := 11; y : INT;", "LD x / GT 10 / JMPCN end / LD 1 / ST y / end:", &[("y", "1")]);
    list("x : INT := 10; y : INT;", "LD x / GT 10 / JMPCN end / LD 1 / ST y / end:", &[("y", "0")]);
}

/// §6.2: every operator of BOOL, with all modifiers, joined and apart.
#[test]
fn logic() {
    for (op, f) in
        [("AND", (|a, b| a && b) as fn(bool, bool) -> bool), ("OR", |a, b| a || b), ("XOR", |a, b| a != b), ("&", |a, b| a && b)]
    {
        for bits in 0..4 {
            let (a, b) = (bits & 1 == 1, bits & 2 == 2);
            let vars = format!("a : BOOL := {a}; b : BOOL := {b}; p, q, r, s, t : BOOL;");
            let show = |v: bool| if v { "TRUE" } else { "FALSE" };
            let lines = format!(
                "LD a / {op} b / ST p / LD a / {op}N b / ST q / LD a / {op} N b / STN r / LDN a / {op}( b / ) / ST s / LD N a / {op} N ( b / ) / ST N t"
            );
            let expected = [
                ("p", show(f(a, b))),
                ("q", show(f(a, !b))),
                ("r", show(!f(a, !b))),
                ("s", show(f(!a, b))),
                ("t", show(!f(!a, !b))),
            ];
            list(&vars, &lines, &expected);
        }
    }
    list("w : WORD := 16#0F0F; v : WORD;", "LD w / AND 16#00FF / OR 16#1000 / XOR 16#0001 / NOT / ST v", &[("v", "61425")]);
    list("w : WORD := 16#FF00; v : WORD;", "LDN w / ST v", &[("v", "255")]);
    list("N : BOOL := TRUE; q : BOOL;", "LD TRUE / AND N / ST q", &[("q", "TRUE")]);
}

#[test]
fn arithmetic_of_every_type() {
    for ty in ["SINT", "INT", "DINT", "LINT", "USINT", "UINT", "UDINT", "ULINT", "REAL", "LREAL"] {
        let vars = format!("a : {ty} := 20; b : {ty} := 6; s, d, m, q : {ty}; gt, ge, eq, ne, le, lt : BOOL;");
        let lines = "LD a / ADD b / ST s / LD a / SUB b / ST d / LD a / MUL b / ST m / LD a / DIV 5 / ST q / LD a / GT b / ST gt / LD a / GE b / \
                     ST ge / LD a / EQ b / ST eq / LD a / NE b / ST ne / LD a / LE b / ST le / LD a / LT b / ST lt";
        let bools = [("gt", "TRUE"), ("ge", "TRUE"), ("eq", "FALSE"), ("ne", "TRUE"), ("le", "FALSE"), ("lt", "FALSE")];
        let real = ty.ends_with("REAL");
        let numbers = if real { ["26.0", "14.0", "120.0", "4.0"] } else { ["26", "14", "120", "4"] };
        let mut expected: Vec<_> = ["s", "d", "m", "q"].into_iter().zip(numbers).collect();
        expected.extend(bools);
        list(&vars, lines, &expected);
        if !real {
            list(&vars, "LD a / MOD b / ST s", &[("s", "2")]);
        }
    }
    list(
        "t : TIME := T#1s; u : TIME; late : BOOL;",
        "LD t / ADD T#500ms / ST u / GT T#1s / ST late",
        &[("u", "T#1s500ms"), ("late", "TRUE")],
    );
    list("i : INT := 3; d : DINT := 100000; e : DINT;", "LD i / ADD d / ST e", &[("e", "100003")]);
}

#[test]
fn store_set_and_reset_leave_the_result() {
    list(
        "a : BOOL := TRUE; p, q, r : BOOL; s : BOOL := TRUE;",
        "LD a / ST p / S q / R s / ST r",
        &[("p", "TRUE"), ("q", "TRUE"), ("r", "TRUE"), ("s", "FALSE")],
    );
    list("a : BOOL; q : BOOL; s : BOOL := TRUE;", "LD a / S q / R s", &[("q", "FALSE"), ("s", "TRUE")]);
    let text = "PROGRAM p VAR n : INT := 7; m : INT; END_VAR\nLD TRUE\nR n\nS m\nEND_PROGRAM";
    let mut plc = Plc::new_in(Profile::OpenPlc, text);
    plc.scans(1);
    assert_eq!((plc.get("p.n"), plc.get("p.m")), ("0".to_owned(), "1".to_owned()));
    assert_eq!(codes("n : INT;", "LD TRUE / R n"), ["P2001 2"]);
}

#[test]
fn parentheses_nest_and_may_hold_no_operand() {
    list("a, c : BOOL := TRUE; b, q : BOOL;", "LD a / AND( / LD b / OR( c / AND TRUE / ) / ) / ST q", &[("q", "TRUE")]);
    list("i : INT := 2; r : INT;", "LD 10 / SUB( i / ADD( 3 / MUL i / ) / ) / ST r", &[("r", "2")]);
    list("i : INT := 2; q : BOOL;", "LD i / LT( 1 / ADD i / ) / ST q", &[("q", "TRUE")]);
}

#[test]
fn jumps_loops_and_returns() {
    let sum = "LD 1 / ST i / again: / LD s / ADD i / ST s / LD i / ADD 1 / ST i / LE 100 / JMPC again";
    list("i, s : INT;", sum, &[("s", "5050"), ("i", "101")]);
    list("q : INT;", "JMP over / LD 1 / ST q / over: LD 2 / ADD q / ST q", &[("q", "2")]);
    list("q : INT;", "LD 1 / ST q / LD TRUE / RETC / LD 2 / ST q", &[("q", "1")]);
    list("q : INT;", "LD 1 / ST q / LD TRUE / RETCN / LD 2 / ST q / RET / LD 3 / ST q", &[("q", "2")]);
    // The result crosses labels; literals take the type of what reads them.
    for (a, want) in [("TRUE", "1"), ("FALSE", "0")] {
        list(
            &format!("a : BOOL := {a}; y : INT;"),
            "LD a / JMPC one / LD 0 / JMP out / one: / LD 1 / out: / ST y",
            &[("y", want)],
        );
    }
    // The result of a backward jump is read at the label before the jump is met.
    list(
        "n : INT; r : INT;",
        "LD 0 / JMP test / loop: / ADD n / test: / ST r / LD n / ADD 1 / ST n / LE 4 / JMPCN out / LD r / JMP loop / out:",
        &[("r", "10"), ("n", "5")],
    );
}

#[test]
fn two_entries_into_one_loop() {
    let lines = "LD odd / JMPC second / first: / LD n / ADD 1 / ST n / second: / LD m / ADD 2 / ST m / LT 10 / JMPC first";
    list("odd : BOOL := TRUE; n, m : INT;", lines, &[("n", "4"), ("m", "10")]);
    list("odd : BOOL; n, m : DINT;", lines, &[("n", "5"), ("m", "10")]);
    list("odd : BOOL := TRUE; n, m : LREAL;", lines, &[("n", "4.0"), ("m", "10.0")]);
}

#[test]
fn endless_loops_are_stopped() {
    use takt_base::Nanos;
    use takt_image::Trap;
    for body in ["again:\nJMP again", "again:\nLD n\nADD 1\nST n\nJMP again", "LD TRUE\nJMPC b\na:\nLD n\nST n\nb:\nJMP a"] {
        let mut plc = Plc::new(&format!("PROGRAM p VAR n : INT; END_VAR\n{body}\nEND_PROGRAM"));
        let fault = plc.scan_within(0, Nanos(20_000_000)).expect_err(body);
        assert_eq!(fault.trap, Trap::Watchdog, "{body}");
    }
}

const FB: &str = "FUNCTION_BLOCK Acc VAR_INPUT x : INT; y : INT; END_VAR VAR_OUTPUT s : INT; q : BOOL; END_VAR\n\
                  s := s + x + y; q := s > 10; END_FUNCTION_BLOCK\n";

/// §6.5.
#[test]
fn instances_are_called_in_all_forms() {
    let vars = "f : Acc; a : INT := 3; r : INT; q : BOOL;";
    let run = |lines: &str, expected: &[(&str, &str)]| check_in(FB, vars, &lines.replace(" / ", "\n"), expected);
    run("CAL f(x := a, y := 1) / LD f.s / ST r", &[("r", "4")]);
    run("CAL f(x := 7, y := a, s => r, NOT q => q)", &[("r", "10"), ("q", "TRUE")]);
    run("CAL f( / x := 1 / y := ( / LD a / ADD 1 / ) / s => r / )", &[("r", "5")]);
    run("CAL f(\n x := 1,\n y := 2\n )\nLD f.s\nST r", &[("r", "3")]);
    run("CAL f(5, 6) / LD f.s / ST r", &[("r", "11")]);
    run("LD 2 / ST f.x / LD 3 / ST f.y / CAL f / LD f.s / ST r", &[("r", "5")]);
    run("LD TRUE / CALC f(x := 1) / CALCN f(x := 100) / LD f.s / ST r", &[("r", "1")]);
    run("LD FALSE / CAL C f(x := 1) / CAL CN f(x := 100) / LD f.s / ST r", &[("r", "100")]);
    // The result survives a call.
    run("LD a / CAL f(x := 9) / ST r", &[("r", "3")]);
}

#[test]
fn input_operators_store_and_call() {
    list(
        "c : CTU; n : INT; q : BOOL;",
        "LD 2 / PV c / LD TRUE / CU c / LD FALSE / CU c / LD TRUE / CU c / LD c.CV / ST n / LD c.Q / ST q",
        &[("n", "2"), ("q", "TRUE")],
    );
    list("c : CTU; n : INT;", "LD TRUE / CU c / R c / LD c.CV / ST n", &[("n", "0")]);
    list("c : CTD; n : INT;", "LD 5 / PV c / LD TRUE / LD c / LD FALSE / LD c / LD TRUE / CD c / LD c.CV / ST n", &[("n", "4")]);
    list(
        "s : SR; r : RS; p, q : BOOL;",
        "LD TRUE / S1 s / LD s.Q1 / ST p / LD TRUE / S r / LD r.Q1 / ST q",
        &[("p", "TRUE"), ("q", "TRUE")],
    );
    list("e : R_TRIG; q : BOOL;", "LD TRUE / CLK e / LD e.Q / ST q", &[("q", "TRUE")]);
    list("t : TON; q : BOOL;", "LD T#0s / PT t / LD TRUE / IN t / LD t.Q / ST q", &[("q", "TRUE")]);
}

#[test]
fn functions() {
    list("r : INT; b : INT := 7;", "LD 1 / LIMIT b, 5 / ST r", &[("r", "5")]);
    list("r : INT := -4;", "LD r / ABS / ST r", &[("r", "4")]);
    list("r : INT; a : INT := 2;", "LD 1 / ADD a, 3, 4 / ST r", &[("r", "10")]);
    list("r : INT; a : INT := 2;", "LIMIT( / MN := 0 / IN := a / MX := 1 / ) / ST r", &[("r", "1")]);
    list("r : INT; a : INT := 2;", "ADD(IN1 := a, IN2 := 40) / ST r", &[("r", "42")]);
    list("s : STRING; t : STRING := 'ab';", "LD t / CONCAT 'cd' / ST s", &[("s", "'abcd'")]);
    list("d : DINT; i : INT := 5;", "LD i / INT_TO_DINT / MUL 100000 / ST d", &[("d", "500000")]);
    let own = "FUNCTION Twice : INT VAR_INPUT v : INT; END_VAR\nLD v\nMUL 2\nST Twice\nEND_FUNCTION\n";
    check_in(own, "r : INT;", "LD 21\nTwice\nST r", &[("r", "42")]);
    check_in(own, "r : INT;", "r := Twice(4) + Twice(v := 1);", &[("r", "10")]);
}

/// Members, elements, addresses, typed and based literals, enumerators.
#[test]
fn operands() {
    list(
        "a : ARRAY [0..3] OF INT; i : INT := 2;",
        "LD 5 / ST a[i] / LD a[2] / ADD INT#1 / ST a[i + 1]",
        &[("a[2]", "5"), ("a[3]", "6")],
    );
    list("w : WORD; q : BOOL := TRUE;", "LD q / ST w.3", &[("w", "8")]);
    list("e : (Red, Green); q : BOOL;", "LD Green / ST e / EQ Red / ST q", &[("q", "FALSE")]);
    list("i : INT;", "LD -5 / ST i (* a comment\n over lines *) / LD i // another\n / ADD 16#10 / ST i", &[("i", "11")]);
}

#[test]
fn mistakes_have_one_message_each() {
    assert_eq!(codes("a, b : BOOL; n : INT;", "LD a / ANDD b / ST a"), ["P5001 2"]);
    assert_eq!(codes("a, b : BOOL;", "LD a / AND / ST b"), ["P5002 2"]);
    assert_eq!(codes("a, b : BOOL;", "ADD a / ST b"), ["P5003 1"]);
    assert_eq!(codes("a : BOOL;", "JMP x / ST a / x:"), ["P5003 2"]);
    assert_eq!(codes("a, b : BOOL; n : INT;", "LD a / JMPC x / LD n / x: / ST b"), ["P5004 4"]);
    assert_eq!(codes("a : BOOL;", "LD a / JMPC nowhere / ST a"), ["P5005 2"]);
    assert_eq!(codes("a : BOOL;", "x: / LD a / x: / LD a / ST a"), ["P5006 3"]);
    assert_eq!(codes("a : BOOL;", "LD a / AND( a / JMP x / ) / ST a / x:"), ["P5007 3"]);
    assert_eq!(codes("a : BOOL; n : INT;", "LD a / CU n"), ["P5008 2"]);
    assert_eq!(codes("a : BOOL; n : INT;", "LD a / ADD n / ST a / LD n / AND a / LD q"), ["P2002 2", "P2002 5", "P1003 6"]);
    assert_eq!(codes("n : INT;", "LD n / JMPC x / x:"), ["P2006 2"]);
    assert_eq!(codes("a : BOOL;", "LD a; / ST a"), ["P0010 1"]);
    assert_eq!(codes("a : BOOL;", "LD a / a := TRUE; / ST a"), ["P0010 2"]);
    assert_eq!(codes("a : BOOL;", "LD a / AND( a / ST a"), ["P0010 4"]);
    assert_eq!(codes("a : BOOL;", "LD a a / ST a"), ["P0010 1"]);
    assert_eq!(codes("a : BOOL;", "LD a / IF a THEN / ST a"), ["P0010 2"]);
}

#[test]
fn later_units_are_still_checked() {
    let text = "PROGRAM p VAR a : BOOL; END_VAR\nLD a\nANDD a\nST(\nEND_PROGRAM\nPROGRAM q VAR b : INT; END_VAR\nb := TRUE;\nEND_PROGRAM";
    let codes: Vec<_> = compile_st(text).diags.iter().map(|d| d.code.text()).collect();
    assert!(codes.contains(&"P5001") && codes.contains(&"P2001"), "{codes:?}");
}

/// The words of Instruction List stay names in ST (§1.3).
#[test]
fn operators_are_names_in_st() {
    check(
        "LD, ST, S, R, CAL, ADD : INT;",
        "LD := 1; ST := LD + 1; S := 3; R := S; CAL := R * 2; ADD := CAL;",
        &[("ADD", "6"), ("ST", "2")],
    );
}
