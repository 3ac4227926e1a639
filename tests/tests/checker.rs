//! What the checker accepts and refuses, by clause of the language reference. A case is a text and the codes with their places.

use takt_image::Elementary as E;
use takt_tests::plc::compile_st;

/// `CODE line:column` of all messages about the text.
fn messages(text: &str) -> Vec<String> {
    let c = compile_st(text);
    // Most texts declare more than they use; advice has tests of its own.
    let user = c.diags.iter().filter(|d| !c.sources.get(d.span.source).library && !d.code.is_advice());
    user.map(|d| {
        let at = c.sources.line_col(d.span.source, d.span.start);
        format!("{} {}:{}", d.code.text(), at.line, at.column)
    })
    .collect()
}

/// Codes without places.
fn codes(text: &str) -> Vec<String> {
    messages(text).iter().map(|m| m[..5].to_owned()).collect()
}

/// A program with these variables and statements, after these declarations.
fn program(declarations: &str, vars: &str, body: &str) -> String {
    format!("{declarations}\nPROGRAM p\nVAR\n{vars}\nEND_VAR\n{body}\nEND_PROGRAM\n")
}

/// Each case: declarations, variables, statements, and the codes of what is wrong with them, separated by blanks.
fn check(cases: &[(&str, &str, &str, &str)]) {
    let mut wrong = Vec::new();
    for (declarations, vars, body, expected) in cases {
        let text = program(declarations, vars, body);
        let found = codes(&text).join(" ");
        if found != *expected {
            wrong.push(format!("{text}expected `{expected}`, found `{found}`\n"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// One step of the implicit conversions of §2.3, as the reference lists them.
const WIDENINGS: &str = "SINT>INT INT>DINT DINT>LINT USINT>UINT UINT>UDINT UDINT>ULINT USINT>INT UINT>DINT UDINT>LINT SINT>REAL INT>REAL \
    USINT>REAL UINT>REAL REAL>LREAL DINT>LREAL UDINT>LREAL BOOL>BYTE BYTE>WORD WORD>DWORD DWORD>LWORD TIME>LTIME DATE>LDATE TOD>LTOD DT>LDT";

/// Reflexive, transitive closure of [`WIDENINGS`].
fn widens(from: &str, to: &str) -> bool {
    from == to || WIDENINGS.split(' ').filter_map(|w| w.split_once('>')).any(|(a, b)| a == from && widens(b, to))
}

#[test]
fn section_2_3_assignments_between_all_elementary_types() {
    let mut wrong = Vec::new();
    for from in E::ALL.iter().map(|e| e.name()) {
        // All targets of one source in one text: the messages name the lines.
        let vars: Vec<_> = E::ALL.iter().enumerate().map(|(i, to)| format!("t{i} : {};", to.name())).collect();
        let body: Vec<_> = (0..E::ALL.len()).map(|i| format!("t{i} := s;")).collect();
        let text = format!("PROGRAM p VAR s : {from}; {} END_VAR\n{}\nEND_PROGRAM", vars.join(" "), body.join("\n"));
        let refused = messages(&text);
        for (i, to) in E::ALL.iter().map(|e| e.name()).enumerate() {
            let message = refused.iter().find(|m| m.contains(&format!(" {}:", i + 2)));
            let fine = message.is_none();
            if fine != widens(from, to) || message.is_some_and(|m| !m.starts_with("P2001") && !m.starts_with("P2007")) {
                wrong.push(format!("{from} to {to}: {message:?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn section_1_5_untyped_literals_take_the_type_of_the_context() {
    check(&[
        (
            "",
            "a : SINT; b : UINT; c : REAL; d : LREAL; e : LINT;",
            "a := 127; a := -128; b := 65535; c := 1; d := 1.5; e := 9223372036854775807;",
            "",
        ),
        ("", "a : SINT;", "a := 128;", "P2004"),
        ("", "a : USINT;", "a := -1;", "P2004"),
        ("", "a : UINT;", "a := 65536;", "P2004"),
        ("", "a : WORD;", "a := 16#FF00; a := 2#1010; a := WORD#5;", ""),
        ("", "a : WORD;", "a := 5;", "P2001"),
        ("", "a : BOOL;", "a := 1; a := 0; a := BOOL#1;", ""),
        ("", "a : BOOL;", "a := 2;", "P2004"),
        ("", "a : INT;", "a := 1.5;", "P2001"),
        ("", "a : INT;", "a := INT#16#7FFF; a := -32768;", ""),
        ("", "a : TIME; b : DATE;", "a := T#5s; b := D#2024-02-29;", ""),
        ("", "a : TIME;", "a := 5;", "P2001"),
        ("", "a : STRING[3]; b : CHAR;", "a := 'abc'; b := 'x';", ""),
        ("", "a : STRING[3];", "a := 'abcd';", "P2004"),
        ("", "a : CHAR;", "a := 'xy';", "P2001"),
        ("", "a : STRING; b : WSTRING;", "b := a;", "P2001"),
    ]);
}

#[test]
fn section_2_5_enumerations() {
    let types =
        "TYPE Light : (Red, Amber, Green) := Amber; Fruit : (Apple, Red); Col : DWORD (Dark := 16#0, Bright := 16#FF); END_TYPE";
    check(&[
        (types, "l : Light; f : Fruit;", "l := Red; f := Red; l := Light#Green; IF l = Red THEN l := Amber; END_IF;", ""),
        (types, "l : Light; f : Fruit;", "l := f;", "P2001"),
        (types, "l : Light;", "l := Apple;", "P2001"),
        (types, "l : Light;", "l := 1;", "P2001"),
        (types, "l : Light; n : INT;", "n := l;", "P2001"),
        (types, "l : Light;", "l := Light#Blue;", "P1005"),
        (types, "l : Light; b : BOOL;", "b := Red = Red;", "P1007 P1007"),
        (types, "c : Col; d : DWORD;", "c := Bright; d := c OR Dark; c := 16#1234;", ""),
        (types, "l : Light;", "CASE l OF Red: ; Amber, Green: ; END_CASE;", ""),
        (types, "l : Light;", "CASE l OF Red: ; Red: ; END_CASE;", "P3004"),
        ("", "s : (idle, run) := run;", "IF s = idle THEN s := run; END_IF;", ""),
        ("TYPE A : (x, y, x); END_TYPE", "a : A;", "", "P1001"),
    ]);
}

#[test]
fn sections_2_6_to_2_11_subranges_arrays_structures_strings_bits() {
    check(&[
        ("TYPE Pct : INT (0..100) := 50; END_TYPE", "p : Pct; n : INT;", "p := 100; n := p; p := n;", ""),
        ("TYPE Pct : INT (0..100); END_TYPE", "p : Pct;", "p := 101;", "P2004"),
        ("TYPE Bad : INT (9..1); END_TYPE", "p : Bad;", "", "P2004"),
        ("TYPE Bad : REAL (0..1); END_TYPE", "p : Bad;", "", "P2003"),
        ("", "a : ARRAY[1..3, 0..1] OF INT := [1, 2(3), 4, 2()];", "a[1, 0] := a[3][1];", ""),
        ("", "a : ARRAY[1..3] OF INT;", "a[0] := 1;", "P2009"),
        ("", "a : ARRAY[1..3] OF INT;", "a[1, 2] := 1;", "P2008"),
        ("", "a : ARRAY[1..3, 1..2] OF INT;", "a[1] := 1;", "P2013"),
        ("", "a : ARRAY[1..3] OF INT; r : REAL;", "a[r] := 1;", "P2001"),
        ("", "a : ARRAY[3..1] OF INT;", "", "P2004"),
        ("", "a : ARRAY[1..3] OF INT; b : ARRAY[1..3] OF INT; c : ARRAY[0..2] OF INT;", "a := b;", ""),
        ("", "a : ARRAY[1..3] OF INT; c : ARRAY[0..2] OF INT;", "a := c;", "P2001"),
        (
            "TYPE S : STRUCT a : INT := 1; b : ARRAY[0..1] OF BOOL; END_STRUCT; END_TYPE",
            "s : S := (a := 2, b := [TRUE, FALSE]); t : S;",
            "t := s; t.b[1] := s.a > 1;",
            "",
        ),
        ("TYPE S : STRUCT a : INT; END_STRUCT; END_TYPE", "s : S;", "s.c := 1;", "P1005"),
        ("TYPE S : STRUCT a : INT; END_STRUCT; END_TYPE", "s : S := (c := 1);", "", "P1005"),
        ("TYPE S : STRUCT a : INT; END_STRUCT; T : STRUCT a : INT; END_STRUCT; END_TYPE", "s : S; t : T;", "s := t;", "P2001"),
        ("TYPE S : STRUCT a : S; END_STRUCT; END_TYPE", "n : INT;", "", "P2015"),
        ("TYPE A : B; B : A; END_TYPE", "n : INT;", "", "P2015"),
        ("", "s : STRING[5]; c : CHAR;", "c := s[1]; s[2] := 'x';", ""),
        ("", "s : STRING[5]; c : CHAR;", "c := s[6];", "P2009"),
        ("", "w : WORD; b : BOOL; y : BYTE;", "b := w.3; w.%X15 := TRUE; y := w.%B1;", ""),
        ("", "w : WORD; b : BOOL;", "b := w.16;", "P2009"),
        ("", "n : INT; b : BOOL;", "b := n.3;", "P2003"),
        ("", "a : STRING[0];", "", "P2004"),
        ("TYPE Freq : REAL := 50.0; END_TYPE", "f : Freq; r : REAL;", "r := f; f := r;", ""),
    ]);
}

#[test]
fn section_3_variables_and_constants() {
    check(&[
        ("", "a : INT; A : REAL;", "", "P1001"),
        ("", "a : INT;", "b := 1;", "P1003"),
        ("", "a : Nothing;", "", "P1004"),
        ("", "a : INT := 'x';", "", "P2001"),
        ("", "a : INT := 1 + 2 * 3; b : LREAL := 1.0 / 3.0;", "", ""),
        ("VAR_GLOBAL CONSTANT n : INT := 4; END_VAR", "a : ARRAY[1..n] OF INT;", "a[4] := 1;", "P1008"),
        ("VAR_GLOBAL g : INT; END_VAR", "a : ARRAY[1..g] OF INT;", "", "P1008 P2005"),
        (
            "",
            "a AT %QW0 : INT; b AT %QX2.7 : BOOL; c AT %MD1 : REAL; d AT %IB9 : SINT;",
            "a := 1; b := d = 0; %QX0.0 := TRUE;",
            "",
        ),
        ("", "a AT %QW0 : DINT;", "", "P3011"),
        ("", "a AT %IX0.0 : BOOL;", "a := TRUE;", "P3013"),
        ("", "n : INT;", "%IW1 := 1;", "P3013"),
        ("", "a AT %QX0.9 : BOOL;", "", "P0008"),
        ("", "a AT %I* : BOOL;", "", "P3080"),
        (
            "FUNCTION_BLOCK F VAR_INPUT i : INT; END_VAR VAR_OUTPUT o : INT; END_VAR VAR v : INT; END_VAR o := i + v; END_FUNCTION_BLOCK",
            "f : F; n : INT;",
            "f.i := 1; n := f.o;",
            "",
        ),
        ("FUNCTION_BLOCK F VAR_INPUT i : INT; END_VAR i := 1; END_FUNCTION_BLOCK", "f : F;", "f();", "P3002"),
        ("FUNCTION_BLOCK F VAR_OUTPUT o : INT; END_VAR o := 1; END_FUNCTION_BLOCK", "f : F;", "f.o := 2;", "P3010"),
        ("FUNCTION_BLOCK F VAR CONSTANT k : INT := 5; END_VAR k := 6; END_FUNCTION_BLOCK", "f : F;", "f();", "P3001"),
        ("FUNCTION_BLOCK F VAR_IN_OUT x : INT; END_VAR x := 1; END_FUNCTION_BLOCK", "f : F; n : INT;", "n := f.x;", "P1005"),
        ("FUNCTION_BLOCK F VAR f : F; END_VAR END_FUNCTION_BLOCK", "n : INT;", "", "P2015"),
        (
            "FUNCTION_BLOCK F VAR_INPUT c : BOOL R_EDGE; n : BOOL F_EDGE; END_VAR END_FUNCTION_BLOCK",
            "f : F;",
            "f(c := TRUE);",
            "",
        ),
        ("FUNCTION_BLOCK F VAR c : BOOL R_EDGE; END_VAR END_FUNCTION_BLOCK", "f : F;", "f();", "P3008"),
    ]);
}

#[test]
fn section_4_calls() {
    let units = "FUNCTION f : INT VAR_INPUT a : INT; b : INT := 5; END_VAR VAR_OUTPUT o : INT; END_VAR VAR_IN_OUT io : INT; END_VAR f := a + b; o := a; io := b; END_FUNCTION
FUNCTION q VAR_INPUT a : INT; END_VAR END_FUNCTION
FUNCTION_BLOCK B VAR_INPUT a : INT; c : BOOL; END_VAR VAR_OUTPUT o : INT; END_VAR o := a; END_FUNCTION_BLOCK";
    check(&[
        (units, "n, m : INT;", "n := f(a := 1, io := m, o => m); n := f(1, 2, m, m); q(1);", ""),
        (units, "n, m : INT; w : DINT;", "n := f(a := 1, io := m, o => w);", ""),
        (units, "n, m : INT; w : SINT;", "n := f(a := 1, io := m, o => w);", "P2007"),
        (units, "n, m : INT;", "n := f(a := 1);", "P3007"),
        (units, "n, m : INT;", "n := f(x := 1, io := m);", "P1006"),
        (units, "n, m : INT;", "n := f(a => m, io := m);", "P1006"),
        (units, "n, m : INT;", "n := f(1);", "P2013"),
        (units, "n, m : INT;", "n := f(1, 2, m, m, 5);", "P2013"),
        (units, "n, m : INT;", "n := f(a := 1, a := 2, io := m);", "P2013"),
        (units, "n, m : INT;", "n := f(a := 1.5, io := m);", "P2001"),
        (units, "n : INT;", "n := f(a := 1, io := 5);", "P2014"),
        (units, "n : INT; w : DINT;", "n := f(a := 1, io := w);", "P2001"),
        (units, "n : INT;", "n := q(1);", "P2012"),
        (units, "n : INT; b : B;", "b(a := 1, c := TRUE, o => n); b(1, FALSE); b(); n := b.o;", ""),
        (units, "n : INT; b : B;", "n := b(a := 1);", "P2012"),
        (units, "n : INT;", "B(a := 1);", "P2012"),
        (units, "n : INT; b : ARRAY[0..1] OF B;", "b[n](a := 1);", ""),
        (units, "n : INT; b : B;", "b(a := TRUE);", "P2001"),
        (units, "n : INT; b : B; x : BOOL;", "b(EN := x, a := 1);", ""),
        ("", "n : INT;", "n := unknown(1);", "P1003"),
        ("FUNCTION g : INT g := g(); END_FUNCTION", "n : INT;", "n := g();", "P3009"),
        ("FUNCTION g : INT END_FUNCTION", "n : INT;", "n := g();", "P3012"),
        ("FUNCTION g : INT VAR t : TON; END_VAR g := 1; END_FUNCTION", "n : INT;", "n := g();", "P3008"),
        ("FUNCTION ABS : INT VAR_INPUT x : INT; END_VAR ABS := x; END_FUNCTION", "n : INT;", "n := ABS(x := 1);", "P1001"),
    ]);
}

#[test]
fn section_5_expressions() {
    check(&[
        (
            "",
            "i : INT; d : DINT; u : UINT; r : REAL; l : LREAL;",
            "d := i + u; l := d + r; r := i * 2.0; i := i MOD 3; l := r ** 2;",
            "",
        ),
        ("", "i : INT; u : UINT;", "i := i + u;", "P2007"),
        ("", "a : LINT; b : ULINT;", "a := a + b;", "P2002"),
        ("", "b : BYTE; w : WORD; d : DWORD;", "d := b OR w; w := NOT w AND 16#FF;", ""),
        ("", "w : WORD;", "w := w + w;", "P2003"),
        ("", "w : WORD; i : INT; b : BOOL;", "b := w = i;", "P2002"),
        ("", "r : REAL;", "r := r MOD 2.0;", "P2003"),
        ("", "b : BOOL;", "b := NOT b XOR b OR b AND b & b;", ""),
        ("", "i : INT; b : BOOL;", "b := i AND b;", "P2002"),
        ("", "b : BOOL; s : STRING;", "b := s < 'x'; b := s = s;", ""),
        ("", "s : STRING;", "s := s + 'x';", "P2003"),
        (
            "",
            "b : BOOL; t : TIME; d : DT; x : TOD; y : DATE;",
            "t := t + T#1s; d := d + t; t := d - d; t := t * 2; t := t / 2.0; x := x - t; t := y - y; b := t > T#0s;",
            "",
        ),
        ("", "d : DT;", "d := d + d;", "P2003"),
        ("", "t : TIME;", "t := t * t;", "P2003"),
        ("", "t : TIME;", "t := t + 5;", "P2003"),
        ("", "i : INT;", "i := 10 / 0;", "P2011"),
        ("", "i : INT;", "i := 32767 + 1;", "P2004"),
        ("", "i : INT; b : BOOL;", "b := -i < 5 AND (i > 3) = TRUE;", ""),
        ("TYPE S : STRUCT a : INT; END_STRUCT; END_TYPE", "s, t : S; b : BOOL;", "b := s = t;", "P2003"),
    ]);
}

#[test]
fn section_5_statements() {
    check(&[
        (
            "",
            "i : INT; b : BOOL;",
            "IF b THEN ; ELSIF i > 1 THEN ; ELSE ; END_IF; WHILE b DO EXIT; END_WHILE; REPEAT CONTINUE; UNTIL b END_REPEAT; RETURN;",
            "",
        ),
        ("", "i : INT;", "IF i THEN ; END_IF;", "P2006"),
        ("", "i : INT;", "WHILE 1.5 DO ; END_WHILE;", "P2006"),
        ("", "i : INT;", "EXIT;", "P3003"),
        ("", "i : INT;", "CONTINUE;", "P3003"),
        ("", "i : INT;", "CASE i OF 1: CONTINUE; END_CASE;", "P3003"),
        ("", "i : INT;", "CASE i OF 1, 3..5: ; 2: ; -1: ; ELSE ; END_CASE;", ""),
        ("", "i : INT;", "CASE i OF 1..5: ; 5..9: ; END_CASE;", "P3004"),
        ("", "i : INT;", "CASE i OF 40000: ; END_CASE;", "P2004"),
        ("", "i, j : INT;", "CASE i OF j: ; END_CASE;", "P2005"),
        ("", "r : REAL;", "CASE r OF 1: ; END_CASE;", "P2003"),
        ("", "i : INT; n : DINT;", "FOR i := 1 TO 10 BY 2 DO n := n + i; END_FOR;", ""),
        ("", "i : INT;", "FOR i := 1 TO 40000 DO ; END_FOR;", "P2004"),
        ("", "r : REAL;", "FOR r := 1.0 TO 2.0 DO ; END_FOR;", "P3005"),
        ("", "a : ARRAY[0..1] OF INT;", "FOR a[0] := 1 TO 2 DO ; END_FOR;", "P3005"),
        ("", "i : INT;", "FOR i := 1 TO 5 DO i := i + 1; END_FOR;", "P3005"),
        ("", "i : INT;", "FOR i := 1 TO 5 BY 0 DO ; END_FOR;", "P3006"),
        ("", "i : INT;", "i;", "P0010"),
        ("", "i : INT; t : TON;", "t(IN := i > 0, PT := T#1s, Q => i);", "P2001"),
    ]);
}

#[test]
fn library_functions_and_conversions() {
    check(&[
        (
            "",
            "i : INT; r : REAL; l : LREAL;",
            "i := ABS(i); r := SQRT(r); l := SIN(l); r := EXPT(r, 2); i := LIMIT(1, i, 9); i := MAX(i, 2, 3, 4);",
            "",
        ),
        (
            "",
            "i : INT; w : WORD; b : BOOL;",
            "w := SHL(w, 3); w := ROL(IN := w, N := i); i := SEL(b, 1, 2); i := MUX(i, 1, 2, 3); i := SEL(G := b, IN0 := 1, IN1 := 2);",
            "",
        ),
        ("", "i : INT;", "i := SHL(i, 2);", "P2003"),
        ("", "i : LINT; l : LREAL;", "l := SIN(i);", "P2003"),
        ("", "s : STRING; i : INT;", "i := LEN(s); s := CONCAT(s, 'a', s); s := MID(s, 2, 1); i := FIND(s, 'x');", ""),
        ("", "i : INT;", "i := LEN(i);", "P2003"),
        (
            "",
            "i : INT; r : REAL; s : STRING; d : DWORD; t : TIME;",
            "r := INT_TO_REAL(i); i := REAL_TO_INT(r); s := INT_TO_STRING(i); d := REAL_TO_DWORD(r); t := DINT_TO_TIME(5); i := TRUNC(r); i := TO_INT(s);",
            "",
        ),
        ("", "i : INT; r : REAL;", "i := INT_TO_REAL(r);", "P2007"),
        ("", "i : INT; d : DATE;", "i := DATE_TO_TOD(d);", "P1003"),
        ("", "i : INT;", "i := ABS(i, i);", "P2013"),
        ("", "i : INT;", "i := LIMIT(MN := 1, IN := i, MAX := 3);", "P1006"),
        ("", "i : INT;", "i := ADD_INT(i, 1) + SUB(i, 1) + MUL(i, 2, 3) + DIV(i, 2) + MOD(i, 2);", ""),
        ("", "b : BOOL; i : INT;", "b := GT(i, 2, 1) AND EQ(i, i) AND NE(i, 1); b := AND(b, TRUE, b); b := NOT(b);", ""),
        ("", "t : TIME;", "t := TIME(); t := ADD_TIME(t, T#1s); t := MUL_TIME(t, 3);", ""),
    ]);
}

#[test]
fn section_10_configurations() {
    let with = |tasks: &str| {
        format!(
            "PROGRAM P1 VAR_INPUT i : INT; END_VAR VAR_OUTPUT o : INT; END_VAR o := i; END_PROGRAM\nCONFIGURATION c\nVAR_GLOBAL g : INT; key : BOOL; END_VAR\nRESOURCE r ON PC\n{tasks}\nEND_RESOURCE\nEND_CONFIGURATION\n"
        )
    };
    for (tasks, expected) in [
        ("TASK t (INTERVAL := T#10ms, PRIORITY := 1); PROGRAM a WITH t : P1 (i := g, o => g); PROGRAM b : P1;", ""),
        ("TASK t (SINGLE := key, PRIORITY := 0); PROGRAM a WITH t : P1;", ""),
        ("TASK t (INTERVAL := T#10ms, PRIORITY := 1); PROGRAM a WITH u : P1;", "P4001"),
        ("TASK t (INTERVAL := 10, PRIORITY := 1); PROGRAM a WITH t : P1;", "P2001"),
        ("TASK t (INTERVAL := T#-1s, PRIORITY := 1); PROGRAM a WITH t : P1;", "P4003"),
        ("TASK t (INTERVAL := T#1s, PRIORITY := 99999); PROGRAM a WITH t : P1;", "P4003"),
        ("TASK t (SINGLE := g, PRIORITY := 1); PROGRAM a WITH t : P1;", "P4003"),
        ("TASK t (INTERVAL := T#1s, PRIORITY := 1); PROGRAM a WITH t : P2;", "P1004"),
        ("TASK t (INTERVAL := T#1s, PRIORITY := 1); PROGRAM a WITH t : P1; PROGRAM a WITH t : P1;", "P1001"),
        ("TASK t (INTERVAL := T#1s, PRIORITY := 1); PROGRAM a WITH t : P1 (x := g);", "P1006"),
    ] {
        assert_eq!(codes(&with(tasks)).join(" "), expected, "{tasks}");
    }
}

#[test]
fn externals_match_their_globals() {
    let with = |externals: &str| {
        format!(
            "VAR_GLOBAL g : INT; END_VAR VAR_GLOBAL CONSTANT k : INT := 3; END_VAR\nPROGRAM p\n{externals}\n g := g + 1;\nEND_PROGRAM\n"
        )
    };
    for (externals, expected) in [
        ("VAR_EXTERNAL g : INT; END_VAR", ""),
        ("VAR_EXTERNAL CONSTANT k : INT; END_VAR VAR_EXTERNAL g : INT; END_VAR", ""),
        ("", "P1008"),
        ("VAR_EXTERNAL g : REAL; END_VAR", "P1009"),
        ("VAR_EXTERNAL g : INT; h : INT; END_VAR", "P1009"),
        ("VAR_EXTERNAL g : INT; k : INT; END_VAR", "P1009"),
    ] {
        assert_eq!(codes(&with(externals)).join(" "), expected, "{externals}");
    }
}

#[test]
fn one_mistake_gives_one_message_at_its_place() {
    assert_eq!(
        messages("PROGRAM p\nVAR a : INT; END_VAR\n  a := b + c * (b - d[1].e);\nEND_PROGRAM"),
        ["P1003 3:8", "P1003 3:12", "P1003 3:21"],
        "each unknown name once"
    );
    assert_eq!(messages("PROGRAM p\nVAR a : Wrong; END_VAR\n  a.x := a + 1; a(1);\nEND_PROGRAM"), ["P1004 2:9"]);
    assert_eq!(
        messages(
            "FUNCTION f : Wrong VAR_INPUT x : INT; END_VAR f := x; END_FUNCTION\nPROGRAM p VAR n : INT; END_VAR n := f(1) + 2; END_PROGRAM"
        ),
        ["P1004 1:14"]
    );
    assert_eq!(messages("PROGRAM p\nVAR a : ARRAY[1..x] OF INT; END_VAR\n  a[1] := 2;\nEND_PROGRAM"), ["P1003 2:18"]);
}

#[test]
fn large_programs_are_checked_in_bounded_time() {
    let many: String = (0..10_000).map(|i| format!("v{i} : INT := {};\n", i % 100)).collect();
    let body: String = (1..10_000).map(|i| format!("v{i} := v{} + 1;\n", i - 1)).collect();
    assert_eq!(codes(&program("", &many, &body)), [""; 0]);
    assert_eq!(codes(&program("", "a : ARRAY[0..2000000000] OF LREAL;", "")), ["P2016"]);
    assert_eq!(codes(&program("", "a : ARRAY[0..9] OF ARRAY[0..99999999] OF ARRAY[0..99999999] OF LREAL;", "")), ["P2016"]);
    let chain: String = (0..500)
        .map(|i| format!("T{i} : STRUCT a, b : {}; END_STRUCT;", if i == 0 { "INT".into() } else { format!("T{}", i - 1) }))
        .collect();
    assert_eq!(codes(&program(&format!("TYPE {chain} END_TYPE"), "", "")), ["P2016"]);
}
