//! Types at run time: enumerations, subranges, arrays, structures, strings, parts. From: language reference §2.5 to §2.11, §3.6.

use takt_image::Trap;
use takt_tests::plc::{Plc, check, check_in, check_program, fault};

/// §2.5: the first literal is the default unless another is given; an alias has its own.
#[test]
fn enumerations_start_where_they_say() {
    let types = "TYPE A : (A1, A2, A3); B : (B1, B2, B3) := B2; C : B := B3; S : STRUCT a : A; b : B; c : C; d : B := B1; END_STRUCT; END_TYPE";
    let vars = "a : A; b : B; c : C; d : C := B1; s : S; l : ARRAY[1..2] OF C; t : S := (a := A3);";
    let expected = [
        ("a", "A1"),
        ("b", "B2"),
        ("c", "B3"),
        ("d", "B1"),
        ("s", "(a := A1, b := B2, c := B3, d := B1)"),
        ("l", "[B3, B3]"),
        ("t", "(a := A3, b := B2, c := B3, d := B1)"),
    ];
    check_in(types, vars, "", &expected);
}

/// §2.5: the type that is wanted decides between literals of one name.
#[test]
fn enumerators_are_found_by_the_type_wanted() {
    let types = "TYPE Light : (Off, Red, Green); Motor : (Off, Slow, Fast) := Fast; END_TYPE";
    let body =
        "l := Off; m := Off; x := l = Off; y := Motor#Off = m; l := SEL(x, Light#Red, Green); k := MUX(i, Motor#Slow, Fast, Off);
        CASE m OF Off: n := 1; Slow, Fast: n := 2; END_CASE;";
    let vars = "l : Light := Green; m, k : Motor; x, y : BOOL; i : INT := 1; n : INT;";
    check_in(types, vars, body, &[("l", "Green"), ("m", "Off"), ("x", "TRUE"), ("y", "TRUE"), ("k", "Fast"), ("n", "1")]);
}

/// §2.5: named values are constants of their base; the variable may hold others.
#[test]
fn named_values() {
    let types = "TYPE Col : DWORD (Red := 16#FF0000, Green := 16#00FF00, Yellow := Red OR Green) := Green; END_TYPE";
    check_in(
        types,
        "a, b, c : Col; w : DWORD; x : BOOL;",
        "b := Yellow; c := b AND 16#00FFFF; w := a; x := c = Green;",
        &[("a", "Green"), ("b", "Yellow"), ("c", "Green"), ("w", "65280"), ("x", "TRUE")],
    );
}

/// §2.6: the lower bound is the default, also below members and elements; in expressions it is its base.
#[test]
fn subranges() {
    let types = "TYPE R : INT (-5..20); W : USINT (3..200) := 7; S : STRUCT r : R; w : W; END_STRUCT; END_TYPE";
    let body = "d := r * 1000 + w; r := 20; r := r - 25; i := MAX(r, 3);";
    let vars = "r : R; w : W; s : S; a : ARRAY[1..2] OF R; b : ARRAY[1..2] OF W := [2(9)]; d, i : INT;";
    check_in(
        types,
        vars,
        body,
        &[("r", "-5"), ("w", "7"), ("s", "(r := -5, w := 7)"), ("a", "[-5, -5]"), ("b", "[9, 9]"), ("d", "-4993"), ("i", "3")],
    );
}

/// §2.6: the value is checked at every store, F0703.
#[test]
fn subranges_are_checked_at_every_store() {
    let head = "TYPE R : INT (-5..20); S : STRUCT r : R; l : ARRAY[1..2] OF R; END_STRUCT; END_TYPE
        FUNCTION out : BOOL VAR_INPUT i : INT; END_VAR VAR_OUTPUT o : INT; END_VAR o := i; END_FUNCTION
        FUNCTION lent : BOOL VAR_INPUT i : INT; END_VAR VAR_IN_OUT r : R; END_VAR r := i; END_FUNCTION";
    let vars = "r : R; s : S; i : INT; x : BOOL; l : ARRAY[0..1] OF S;";
    for store in [
        "r := i;",
        "s.r := i;",
        "s.l[2] := i;",
        "l[1].l[1] := i;",
        "x := out(i, o => r);",
        "x := lent(i, r := s.r);",
        "FOR r := 0 TO i DO ; END_FOR",
    ] {
        let text = |i| format!("{head} PROGRAM p VAR {vars} END_VAR i := {i}; {store} END_PROGRAM").replace('\n', " ");
        assert_eq!(fault(&text(21)).0, Trap::Range, "{store}");
        check_program(&text(19), 1, &[]);
    }
}

/// §2.7: repeats, nesting, flat lists, defaults for what is left over.
#[test]
fn array_initial_values() {
    let types = "TYPE V : ARRAY[1..3] OF INT := [7, 8]; Xy : STRUCT x : INT := 4; y : INT; END_STRUCT; END_TYPE";
    let vars = "a : ARRAY[1..6] OF INT := [1, 2, 3(0), 9]; b : ARRAY[1..6] OF INT := [2(7, 8), 1]; c : ARRAY[0..1, 1..2] OF INT := [1, 2, 3, 4];
        d : ARRAY[0..1] OF ARRAY[1..2] OF INT := [[1, 2], [3]]; e : V; f : ARRAY[1..2] OF V := [[1]]; g : ARRAY[1..3] OF Xy := [(y := 1), 2((x := 0))];
        h : ARRAY[-1..1] OF STRING[4] := ['ab', 2('c')]; k : ARRAY[1..2] OF BOOL := [TRUE];";
    check_in(
        types,
        vars,
        "",
        &[
            ("a", "[1, 2, 0, 0, 0, 9]"),
            ("b", "[7, 8, 7, 8, 1, 0]"),
            ("c", "[[1, 2], [3, 4]]"),
            ("d", "[[1, 2], [3, 0]]"),
            ("e", "[7, 8, 0]"),
            ("f[2]", "[7, 8, 0]"),
            ("g", "[(x := 4, y := 1), (x := 0, y := 0), (x := 0, y := 0)]"),
            ("h", "['ab', 'c', 'c']"),
            ("k", "[TRUE, FALSE]"),
        ],
    );
}

/// §2.7: the last subscript is the fastest; `a[i, j]` and `a[i][j]` are one; assignment copies.
#[test]
fn array_elements() {
    let body = "FOR i := 0 TO 2 DO FOR j := -1 TO 1 DO a[i, j] := 10 * i + j; b[i][j] := a[i][j]; END_FOR; END_FOR;
        c := a; a[1, 1] := 0; x := c[1, 1]; y := b[2, -1]; i := 2; j := 0; z := a[i, j] * 100 + b[i][j];";
    let vars = "a, c : ARRAY[0..2, -1..1] OF INT; b : ARRAY[0..2] OF ARRAY[-1..1] OF INT; i, j, x, y, z : INT;";
    check(
        vars,
        body,
        &[
            ("x", "11"),
            ("y", "19"),
            ("z", "2020"),
            ("c", "[[-1, 0, 1], [9, 10, 11], [19, 20, 21]]"),
            ("b", "[[-1, 0, 1], [9, 10, 11], [19, 20, 21]]"),
        ],
    );
}

/// §2.8, §3.6: type defaults, then type initialisers, then the instance's.
#[test]
fn structures_inside_structures() {
    let types = "TYPE In : STRUCT a : INT := 1; b : STRING[4] := 'in'; END_STRUCT; Mid : STRUCT i : In := (a := 2); l : ARRAY[1..2] OF In := [(a := 3)]; END_STRUCT;
        Alias : Mid := (i := (b := 'al')); END_TYPE
        FUNCTION_BLOCK F VAR_INPUT m : Mid := (i := (a := 5)); END_VAR VAR t : TON := (PT := T#1s); END_VAR END_FUNCTION_BLOCK";
    check_in(
        types,
        "m : Mid; n : Mid := (l := [(b := 'x'), (a := 9)]); k : Alias; f : F; g : F := (m := (i := (a := 6)));",
        "",
        &[
            ("m", "(i := (a := 2, b := 'in'), l := [(a := 3, b := 'in'), (a := 1, b := 'in')])"),
            ("n.l", "[(a := 3, b := 'x'), (a := 9, b := 'in')]"),
            ("k.i.b", "'al'"),
            ("f.m.i.a", "5"),
            ("f.t.PT", "T#1s"),
            ("g.m.i.a", "6"),
        ],
    );
}

/// §2.9: assignment copies and truncates; comparison by code unit; a prefix is smaller.
#[test]
fn strings() {
    let body = "a := b; c := a; n := LEN(a); x := 'ab' < b; y := a < b; z := CONCAT(a, 'f') > b; e := '' = LEFT(b, 0);
        c := INSERT(c, '123', 2); m := LEN(c); w := CONCAT(w, w, w);";
    let vars =
        "a : STRING[5]; b : STRING[12] := 'abcdefgh'; c : STRING[7]; n, m : INT; x, y, z, e : BOOL; w : WSTRING[4] := \"xyz\";";
    let expected = [
        ("a", "'abcde'"),
        ("c", "'ab123cd'"),
        ("n", "5"),
        ("m", "7"),
        ("x", "TRUE"),
        ("y", "TRUE"),
        ("z", "FALSE"),
        ("e", "TRUE"),
        ("w", "\"xyzx\""),
    ];
    check(vars, body, &expected);
}

/// §2.9: STRING is in bytes: characters above 127 are one each; a nul is a character like others.
#[test]
fn strings_of_all_characters() {
    check(
        "s : STRING[5] := 'a$FFb'; n : INT; c : CHAR; b, d : BYTE; x : BOOL;",
        "n := LEN(s); c := s[2]; b := CHAR_TO_BYTE(c); x := s > 'az'; s[3] := BYTE_TO_CHAR(16#80); d := CHAR_TO_BYTE(s[3]);",
        &[("n", "3"), ("b", "255"), ("x", "TRUE"), ("d", "128")],
    );
}

/// §2.11: every part of every bit string, read and written, model in integers.
#[test]
fn partial_access() {
    for (ty, width) in [("BYTE", 8u32), ("WORD", 16), ("DWORD", 32), ("LWORD", 64)] {
        let (mut vars, mut body) = (format!("w : {ty} := 16#{:X};", 0x9ABC_DEF0_1234_5678u64 >> (64 - width)), String::new());
        let mut value = u128::from(0x9ABC_DEF0_1234_5678u64 >> (64 - width));
        let mut expected = Vec::new();
        for (size, name, bits) in [("X", "BOOL", 1), ("B", "BYTE", 8), ("W", "WORD", 16), ("D", "DWORD", 32)] {
            for i in (0..width / bits).filter(|_| bits < width) {
                let (shift, mask) = (i * bits, (1u128 << bits) - 1);
                let part = value >> shift & mask;
                vars += &format!("{size}{i} : {name};");
                body += &format!("{size}{i} := w.%{size}{i}; w.%{size}{i} := NOT {size}{i};");
                let shown = if bits == 1 { if part == 1 { "TRUE" } else { "FALSE" }.to_owned() } else { part.to_string() };
                expected.push((format!("{size}{i}"), shown));
                value = value & !(mask << shift) | ((part ^ mask) << shift);
            }
        }
        expected.push(("w".to_owned(), value.to_string()));
        let expected: Vec<_> = expected.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
        check(&vars, &body, &expected);
    }
}

/// §2.11: parts of members, elements, inputs and located variables.
#[test]
fn parts_of_parts() {
    let text = "TYPE S : STRUCT w : WORD; l : ARRAY[0..1] OF DWORD; END_STRUCT; END_TYPE
        FUNCTION_BLOCK F VAR_INPUT w : WORD; END_VAR VAR_OUTPUT b : BOOL; n : BYTE; END_VAR b := w.15; n := w.%B1; END_FUNCTION_BLOCK
        PROGRAM p VAR s : S; f : F; i : INT := 1; q AT %QW0 : WORD; END_VAR
        s.w.15 := TRUE; s.l[i].%W1 := 16#ABCD; s.l[i].0 := s.w.15; f(w := s.w); q.%B1 := s.l[i].%B3; q.3 := f.b; END_PROGRAM";
    let mut plc = Plc::new(text);
    plc.scans(1);
    let found = ["p.s.w", "p.s.l[1]", "p.f.b", "p.f.n", "%QW0", "%QX1.7"].map(|v| plc.get(v));
    assert_eq!(found, ["32768", "2882338817", "TRUE", "128", "43784", "TRUE"]);
}
