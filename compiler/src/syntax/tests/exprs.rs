//! Expressions: precedence (§5.2), signs (§1.5), calls (§4.7).

use super::*;

fn same(cases: &[(&str, &str)]) {
    for (text, want) in cases {
        assert_eq!(expr(text), *want, "{text}");
    }
}

#[test]
fn section_5_2_precedence() {
    same(&[
        ("a OR b AND c", "(OR a (AND b c))"),
        ("a OR b XOR c AND d", "(OR a (XOR b (AND c d)))"),
        ("NOT a = b", "(= (NOT a) b)"),
        ("NOT a AND b", "(AND (NOT a) b)"),
        ("NOT TRUE OR TRUE", "(OR (NOT true) true)"),
        ("-x ** 2", "(** (- x) 2)"),
        ("2 ** 3 ** 2", "(** (** 2 3) 2)"),
        ("a < b = c < d", "(= (< a b) (< c d))"),
        ("a <> b >= c", "(<> a (>= b c))"),
        ("2 + 3 * 4 ** 2", "(+ 2 (* 3 (** 4 2)))"),
        ("10 - 4 - 3", "(- (- 10 4) 3)"),
        ("a / b * c MOD d", "(MOD (* (/ a b) c) d)"),
        ("(a + b) * c", "(* (+ a b) c)"),
        ("-7 / 2", "(/ -7 2)"),
        ("16#F0 AND 16#3C OR 16#01", "(OR (AND 240b 60b) 1b)"),
        ("a & b AND_THEN c OR_ELSE d", "(OR_ELSE (AND_THEN (AND a b) c) d)"),
        ("a + b < c AND d", "(AND (< (+ a b) c) d)"),
        ("a = b = c", "(= (= a b) c)"),
        ("a and not b", "(AND a (NOT b))"),
    ]);
}

#[test]
fn signs_fold_into_literals() {
    same(&[
        ("-2**2", "(** -2 2)"),
        ("a-1", "(- a 1)"),
        ("a - -1", "(- a -1)"),
        ("- 5", "-5"),
        ("-9223372036854775808", "-9223372036854775808"),
        ("-1.5", "-1.5"),
        ("- - 5", "(- -5)"),
        ("+5", "(+ 5)"),
        ("-a.b", "(- a.b)"),
        ("-T#1s", "(- TIME#1000000000)"),
    ]);
}

#[test]
fn postfix_forms_and_calls() {
    same(&[
        ("a[1, i + 1].b.3", "a[1 (+ i 1)].b.%X3"),
        ("a[i][j]", "a[i][j]"),
        ("f()", "(call f)"),
        ("f(1, g(x))", "(call f 1 (call g x))"),
        ("f(a := 1, b => c, NOT q => d, e =>)", "(call f a:=1 b=>c !q=>d e=>)"),
        ("f(a := , b := 2)", "(call f a:= b:=2)"),
        ("fb[2](x)", "(call fb[2] x)"),
        ("TIME()", "(call TIME)"),
        ("AND(a, b)", "(call AND a b)"),
        ("XOR(a, b) OR OR(c, d)", "(OR (call XOR a b) (call OR c d))"),
        ("MOD(7, 2) MOD 3", "(MOD (call MOD 7 2) 3)"),
        ("NOT(a)", "(NOT a)"),
        ("NOT(IN := a)", "(call NOT IN:=a)"),
        ("EXPT(2.0, 3)", "(call EXPT 2.0 3)"),
        ("INT_TO_REAL(x)", "(call INT_TO_REAL x)"),
        ("f(EN := e, IN1 := 1, ENO => ok)", "(call f EN:=e IN1:=1 ENO=>ok)"),
        ("%IX0.1 AND x", "(AND %IX0.1 x)"),
    ]);
}

#[test]
fn contextual_words_are_names() {
    let words = "N R S L D P P0 P1 SD DS SL PRIORITY SINGLE INTERVAL LD ST CAL JMP RET ADD CU CD PV IN PT CLK S1 R1 X T GET SET \
        PROPERTY END_PROPERTY UNION POINTER REFERENCE PERSISTENT VAR_STAT VAR_INST AND_THEN OR_ELSE XORN ADR SIZEOF EN ENO E END";
    for word in words.split_whitespace() {
        let text = format!("FUNCTION_BLOCK b VAR {word} : INT; END_VAR {word} := {word} + a.{word}; END_FUNCTION_BLOCK");
        assert_eq!(tree(&text), format!("(fb b (var ({word} : INT)) (:= {word} (+ {word} a.{word})))"));
    }
}

#[test]
fn keywords_are_no_names_and_reported_once() {
    let text = "PROGRAM p\nVAR exit : BOOL; dt : REAL; x : INT; END_VAR\nexit := TRUE;\ndt := dt + 1;\nx := dt;\nEND_PROGRAM";
    assert_eq!(codes(text), ["P1002 2:5", "P1002 2:18"]);
    assert_eq!(codes("PROGRAM p\nexit := TRUE;\nexit := exit;\nEND_PROGRAM"), ["P1002 2:1"]);
    assert_eq!(codes("PROGRAM p\nx := a.time + b.type;\nEND_PROGRAM"), [""; 0], "members may be called so");
}
