//! Operators, precedence (language reference §5.2), calls and what can stand between.

use super::*;

fn table(rows: &[(&str, &str)]) {
    for (text, want) in rows {
        assert_eq!(expr(text), *want, "{text}");
    }
}

/// §5.2, from the tightest level to the loosest.
#[test]
fn precedence() {
    table(&[("(a + b) * c", "(* (+ a b) c)"), ("-f(x)", "(- (call f x))"), ("-a.b[1]", "(- a.b[1])")]);
    table(&[("-x ** 2", "(** (- x) 2)"), ("2 ** -x", "(** 2 (- x))"), ("NOT a = b", "(= (NOT a) b)")]);
    table(&[("a ** b * c", "(* (** a b) c)"), ("a * b ** c", "(* a (** b c))"), ("a * b / c MOD d", "(MOD (/ (* a b) c) d)")]);
    table(&[
        ("a + b * c - d", "(- (+ a (* b c)) d)"),
        ("a < b + c", "(< a (+ b c))"),
        ("a < b = c >= d", "(= (< a b) (>= c d))"),
    ]);
    table(&[("a = b AND c <> d", "(AND (= a b) (<> c d))"), ("a & b", "(AND a b)"), ("a OR b AND c", "(OR a (AND b c))")]);
    table(&[("a XOR b AND c", "(XOR a (AND b c))"), ("a OR b XOR c", "(OR a (XOR b c))"), ("a XOR b OR c", "(OR (XOR a b) c)")]);
    table(&[("a AND_THEN b OR_ELSE c", "(OR_ELSE (AND_THEN a b) c)"), ("a <= b", "(<= a b)"), ("a > b", "(> a b)")]);
}

/// §5.2: operators of one level go from left to right.
#[test]
fn associativity() {
    table(&[("2 ** 3 ** 2", "(** (** 2 3) 2)"), ("10 - 4 - 3", "(- (- 10 4) 3)"), ("a / b / c", "(/ (/ a b) c)")]);
    table(&[("a < b < c", "(< (< a b) c)"), ("a = b = c", "(= (= a b) c)"), ("a OR b OR c", "(OR (OR a b) c)")]);
}

/// §1.5: a sign directly before a literal belongs to it.
#[test]
fn signs() {
    table(&[("a-1", "(- a 1)"), ("a - -1", "(- a -1)"), ("a -1", "(- a 1)"), ("-2**2", "(** -2 2)"), ("- 5", "-5")]);
    table(&[
        ("-9223372036854775808", "-9223372036854775808"),
        ("--5", "(- -5)"),
        ("- -x", "(- (- x))"),
        ("NOT NOT a", "(NOT (NOT a))"),
    ]);
    table(&[
        ("+5", "5"),
        ("-1.5", "-1.5"),
        ("-(5)", "-5"),
        ("-16#10", "-16"),
        ("-7 / 2", "(/ -7 2)"),
        ("-7 MOD 2", "(MOD -7 2)"),
    ]);
}

/// §4.7.
#[test]
fn calls() {
    table(&[("f()", "(call f)"), ("f(1, a + b)", "(call f 1 (+ a b))"), ("f(IN := 1, Q => y)", "(call f IN:=1 Q=>y)")]);
    table(&[
        ("f(a, NOT q => v, r =>)", "(call f a !q=>v r=>)"),
        ("f(a := , b := 2)", "(call f a:= b:=2)"),
        ("f(NOT a)", "(call f (NOT a))"),
    ]);
    table(&[
        ("f(g(h(1)))", "(call f (call g (call h 1)))"),
        ("a.b(1).c", "(call a.b 1).c"),
        ("t[2](IN := x)", "(call t[2] IN:=x)"),
    ]);
    table(&[("f(EN := e, ENO => ok)", "(call f EN:=e ENO=>ok)"), ("f(q => a.b[3].1)", "(call f q=>a.b[3].%X1)")]);
}

/// §5.1 and §12: keywords that are functions too.
#[test]
fn operators_as_functions() {
    table(&[("AND(a, b)", "(call AND a b)"), ("OR(a, b, c)", "(call OR a b c)"), ("XOR(a, b)", "(call XOR a b)")]);
    table(&[("MOD(a, b)", "(call MOD a b)"), ("MOD(IN1 := a, IN2 := b)", "(call MOD IN1:=a IN2:=b)"), ("TIME()", "(call TIME)")]);
    table(&[("NOT(x)", "(NOT x)"), ("NOT(IN := x)", "(call NOT IN:=x)"), ("NOT(a) AND b", "(AND (NOT a) b)")]);
    table(&[("a AND (b)", "(AND a b)"), ("a MOD (b)", "(MOD a b)"), ("NOT(EN := e, IN := x)", "(call NOT EN:=e IN:=x)")]);
    table(&[
        ("AND(a, b) OR c", "(OR (call AND a b) c)"),
        ("INT_TO_REAL(x)", "(call INT_TO_REAL x)"),
        ("REAL(x)", "(call REAL x)"),
    ]);
}

/// §1.3: contextual words are names; members and parameters may be called like keywords.
#[test]
fn words_as_names() {
    for name in ["N", "R", "S", "L", "D", "P", "SD", "PRIORITY", "SINGLE", "INTERVAL", "LD", "ST", "CAL", "CU", "PV", "IN", "PT"]
    {
        assert_eq!(expr(&format!("{name} + {name}.{name}")), format!("(+ {name} {name}.{name})"));
        assert_eq!(stmt(&format!("{name} := 1;")), format!("(:= {name} 1)"));
        assert_eq!(stmt(&format!("{name}({name} := 1);")), format!("(call {name} {name}:=1)"));
    }
    for name in
        ["GET", "SET", "PROPERTY", "UNION", "POINTER", "REFERENCE", "PERSISTENT", "VAR_STAT", "ACTIONS", "JMP", "VOID", "X", "T"]
    {
        let want = format!("(program p (var (a {name} : INT)) (:= {name} {name}))");
        assert_eq!(tree(&format!("PROGRAM p VAR a, {name} : INT; END_VAR {name} := {name}; END_PROGRAM")), want);
    }
    table(&[("a.Step", "a.Step"), ("f(Step := 1, on => x)", "(call f Step:=1 on=>x)"), ("a.DATE + b.TIME", "(+ a.DATE b.TIME)")]);
}

#[test]
fn direct_addresses_and_enumerators_are_operands() {
    table(&[("%IX0.0 AND NOT %IX0.1", "(AND %IX0.0 (NOT %IX0.1))"), ("c = Color#Red OR d", "(OR (= c Color#Red) d)")]);
    assert_eq!(stmt("%QW3 := 5;"), "(:= %QW3 5)");
}
