//! Every statement (language reference §5.1).

use super::*;

#[test]
fn assignments_and_calls() {
    assert_eq!(stmt("a := b;"), "(:= a b)");
    assert_eq!(stmt("a.b[1, i].%X3 := b;"), "(:= a.b[1 i].%X3 b)");
    assert_eq!(stmt("t(IN := x, PT := T#1s, Q => y);"), "(call t IN:=x PT:=TIME#1000000000 Q=>y)");
    assert_eq!(stmt("inst(); a.b(); f(1, 2);"), "(call inst) (call a.b) (call f 1 2)");
    assert_eq!(stmt("a := 1; ; ;"), "(:= a 1) ; ;");
}

#[test]
fn if_and_its_branches() {
    assert_eq!(stmt("IF a THEN b := 1; END_IF;"), "(if a {(:= b 1)})");
    assert_eq!(stmt("IF a THEN ELSE b := 1; END_IF;"), "(if a {} else {(:= b 1)})");
    let want = "(if a {x} b {y} c {} else {z})".replace('x', "(call f)").replace('y', "(call g)").replace('z', "exit");
    assert_eq!(stmt("IF a THEN f(); ELSIF b THEN g(); ELSIF c THEN ELSE EXIT; END_IF;"), want);
    assert_eq!(stmt("IF a THEN IF b THEN c(); ELSE d(); END_IF; END_IF;"), "(if a {(if b {(call c)} else {(call d)})})");
}

/// §12: `;` behind END_xxx may be missing.
#[test]
fn semicolon_behind_an_end_is_optional() {
    assert_eq!(stmt("IF a THEN b(); END_IF c();"), "(if a {(call b)}) (call c)");
    assert_eq!(stmt("WHILE a DO b(); END_WHILE REPEAT UNTIL c END_REPEAT d();"), "(while a {(call b)}) (repeat {} c) (call d)");
}

#[test]
fn case_labels() {
    let want = "(case x (1,5 {(call a)}) (2..4 {(call b)}) (-3 {(call c)}) else {(call d)})";
    assert_eq!(stmt("CASE x OF 1, 5: a(); 2..4: b(); -3: c(); ELSE d(); END_CASE;"), want);
    assert_eq!(
        stmt("CASE x OF Red: a := 1; Color#Green, BLUE: b.c := 2; END_CASE"),
        "(case x (Red {(:= a 1)}) (Color#Green,BLUE {(:= b.c 2)}))"
    );
    assert_eq!(stmt("CASE x OF LOW..HIGH: ; c + 1: ; A.B: ; END_CASE"), "(case x (LOW..HIGH {;}) ((+ c 1) {;}) (A.B {;}))");
    assert_eq!(
        stmt("CASE x OF 16#10: ; INT#5: ; 'a': ; TRUE: ; (5): ; END_CASE"),
        "(case x (16b {;}) (INT#5 {;}) ('a' {;}) (true {;}) (5 {;}))"
    );
    assert_eq!(stmt("CASE x OF END_CASE"), "(case x)");
    assert_eq!(stmt("CASE x OF 1: ELSE END_CASE"), "(case x (1 {}) else {})");
}

/// §5.1: what looks like a label but is a statement, and the other way round.
#[test]
fn case_labels_and_statements() {
    let want = "(case x (A {(:= B 1) (call C) (:= D.E 2) (:= F[1] 3)}) (G {(call H)}))";
    assert_eq!(stmt("CASE x OF A: B := 1; C(); D.E := 2; F[1] := 3; G: H(); END_CASE"), want);
    let want = "(case x (1 {(case y (2 {(call a)}) (3 {(call b)}))}) (4 {(call c)}))";
    assert_eq!(stmt("CASE x OF 1: CASE y OF 2: a(); 3: b(); END_CASE; 4: c(); END_CASE"), want);
    let want = "(case x (1 {(if a {(call b)})}) (2 {}))";
    assert_eq!(stmt("CASE x OF 1: IF a THEN b(); END_IF 2: END_CASE"), want);
}

#[test]
fn loops() {
    assert_eq!(stmt("FOR i := 1 TO 10 DO a(); END_FOR;"), "(for i 1 10 {(call a)})");
    assert_eq!(stmt("FOR i := 10 TO n - 1 BY -3 DO EXIT; END_FOR;"), "(for i 10 (- n 1) by -3 {exit})");
    assert_eq!(stmt("WHILE a AND b DO CONTINUE; END_WHILE;"), "(while (AND a b) {continue})");
    assert_eq!(stmt("REPEAT a(); UNTIL b END_REPEAT;"), "(repeat {(call a)} b)");
    assert_eq!(stmt("REPEAT a(); UNTIL b; END_REPEAT;"), "(repeat {(call a)} b)");
    assert_eq!(stmt("WHILE a DO REPEAT UNTIL b END_REPEAT; END_WHILE"), "(while a {(repeat {} b)})");
}

#[test]
fn one_word_statements() {
    assert_eq!(stmt("EXIT; CONTINUE; RETURN; return;"), "exit continue return return");
}

#[test]
fn keywords_in_any_case() {
    assert_eq!(stmt("If a Then b := True; eLsIf c tHen End_If;"), "(if a {(:= b true)} c {})");
}

#[test]
fn spans_cover_the_statement() {
    let (file, _, sources) = parse("PROGRAM p\n  IF a THEN b := 1; END_IF;\n x := y + 2;\nEND_PROGRAM");
    let Item::Pou(p) = &file.items[0] else { panic!("no unit") };
    let texts: Vec<&str> = p.body.iter().map(|s| sources.text(s.span)).collect();
    assert_eq!(texts, ["IF a THEN b := 1; END_IF", "x := y + 2"]);
    assert!(sources.text(p.span).starts_with("PROGRAM p") && sources.text(p.span).ends_with("END_PROGRAM"));
}
