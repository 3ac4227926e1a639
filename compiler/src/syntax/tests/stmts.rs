//! Every statement, and the disambiguation of CASE labels (§5.1).

use super::*;

fn same(cases: &[(&str, &str)]) {
    for (text, want) in cases {
        assert_eq!(stmt(text), *want, "{text}");
    }
}

#[test]
fn every_statement() {
    same(&[
        ("a := 1;", "(:= a 1)"),
        ("a[i].b.3 := TRUE;", "(:= a[i].b.%X3 true)"),
        ("%QX0.0 := a;", "(:= %QX0.0 a)"),
        ("t(IN := a, PT := T#1s);", "(call t IN:=a PT:=TIME#1000000000)"),
        ("a.b();", "(call a.b)"),
        ("a();;", "(call a) ;"),
        ("RETURN;", "return"),
        ("IF a THEN b := 1; END_IF;", "(if a {(:= b 1)})"),
        ("IF a THEN ELSIF b THEN RETURN; ELSIF c THEN ; ELSE x(); END_IF;", "(if a {} b {return} c {;} else {(call x)})"),
        ("FOR i := 1 TO 10 DO a(); END_FOR;", "(for i 1 10 {(call a)})"),
        ("FOR i := 10 TO 1 BY -3 DO EXIT; CONTINUE; END_FOR;", "(for i 10 1 by -3 {exit continue})"),
        ("FOR s.i := 1 TO n DO END_FOR;", "(for s.i 1 n {})"),
        ("WHILE a < 3 DO a := a + 1; END_WHILE;", "(while (< a 3) {(:= a (+ a 1))})"),
        ("REPEAT a := 1; UNTIL b END_REPEAT;", "(repeat {(:= a 1)} b)"),
        ("REPEAT UNTIL b; END_REPEAT;", "(repeat {} b)"),
        ("if a then b := 1; end_if;", "(if a {(:= b 1)})"),
    ]);
}

#[test]
fn semicolons_behind_end_may_be_missing() {
    same(&[
        ("IF a THEN END_IF b := 1;", "(if a {}) (:= b 1)"),
        ("WHILE a DO FOR i := 1 TO 2 DO END_FOR END_WHILE", "(while a {(for i 1 2 {})})"),
    ]);
}

#[test]
fn case_labels() {
    same(&[
        ("CASE x OF 1, 5: a(); 2..4: b(); ELSE c(); END_CASE;", "(case x (1,5 {(call a)}) (2..4 {(call b)}) else {(call c)})"),
        ("CASE x OF Red: a := 1; b := 2; Green: c(); END_CASE;", "(case x (Red {(:= a 1) (:= b 2)}) (Green {(call c)}))"),
        (
            "CASE x OF C#Red, C.Green: s.a := 1; s.b(); C.Blue: END_CASE;",
            "(case x (C#Red,C.Green {(:= s.a 1) (call s.b)}) (C.Blue {}))",
        ),
        ("CASE x OF -5..-1: ; N + 1: a[1] := 2; N..M: END_CASE;", "(case x (-5..-1 {;}) ((+ N 1) {(:= a[1] 2)}) (N..M {}))"),
        ("CASE x OF 16#10: ; INT#3: ; 'a': ; TRUE: ; END_CASE;", "(case x (16b {;}) (INT#3 {;}) ('a' {;}) (true {;}))"),
        ("CASE x OF 1: IF a THEN b := 2; END_IF; 2: END_CASE;", "(case x (1 {(if a {(:= b 2)})}) (2 {}))"),
        ("CASE x OF ELSE END_CASE;", "(case x else {})"),
        ("CASE x OF 1: CASE y OF 2: ; END_CASE; 3: END_CASE;", "(case x (1 {(case y (2 {;}))}) (3 {}))"),
    ]);
}

#[test]
fn unsupported_statements_say_so_once() {
    let one = |body: &str| codes(&format!("PROGRAM p\n{body}\nx := 1;\nEND_PROGRAM"));
    for body in [
        "a S= b;",
        "a R= b;",
        "r REF= b;",
        "r ?= b;",
        "JMP l;",
        "l: x := 1;",
        "l:",
        "RETURN 5;",
        "a := b := c;",
        "p^ := 1;",
        "x := p^;",
    ] {
        let got = one(body);
        assert!(got.len() == 1 && got[0].starts_with("P0012 2:"), "{body}: {got:?}");
    }
    for body in ["x := REF(a);", "r := NULL;", "THIS.x := 1;", "SUPER();", "x := (a := b);", "f(x ?= y);"] {
        let got = one(body);
        assert!(got.len() == 1 && got[0].starts_with("P0012 2:"), "{body}: {got:?}");
    }
}
