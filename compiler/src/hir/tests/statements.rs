//! Statements (language reference §5.5 to §5.8) and the right to assign (§3.1, §11).

use super::*;

#[test]
fn conditions_are_bool() {
    accept(
        stmt,
        &["IF b1 THEN ; ELSIF i > 3 THEN ; ELSE ; END_IF;", "WHILE b1 DO ; END_WHILE;", "REPEAT ; UNTIL i = 3 END_REPEAT;"],
    );
    expect(
        stmt,
        &[
            ("IF i THEN ; END_IF;", "P2006 4:4"),
            ("IF b1 THEN ; ELSIF vWORD THEN ; END_IF;", "P2006 4:20"),
            ("WHILE 5 DO ; END_WHILE;", "P2006 4:7"),
            ("REPEAT ; UNTIL s END_REPEAT;", "P2006 4:16"),
            ("IF s = 'a' AND i THEN ; END_IF;", "P2002 4:4"),
        ],
    );
}

#[test]
fn case_labels() {
    accept(
        stmt,
        &[
            "CASE i OF 1, 5: ; 2..4: ; ELSE ; END_CASE;",
            "CASE light OF Red: ; Green: ; END_CASE;",
            "CASE vCHAR OF 'a'..'z': ; 'A': ; END_CASE;",
            "CASE vBYTE OF 16#01: ; BYTE#2: ; END_CASE;",
            "CASE pct OF 1: ; -5: ; END_CASE;",
            "CASE i + j OF -1: ; 0: ; END_CASE;",
            "CASE col OF White: ; 16#1: ; END_CASE;",
            "CASE vULINT OF 18446744073709551615: ; END_CASE;",
            "CASE s OF 'a': ; END_CASE;",
        ],
    );
    expect(
        stmt,
        &[
            ("CASE i OF 1: ; 1: ; END_CASE;", "P3004 4:16"),
            ("CASE i OF 1..5: ; 3: ; END_CASE;", "P3004 4:19"),
            ("CASE i OF 3: ; 1..5: ; END_CASE;", "P3004 4:16"),
            ("CASE i OF 1, 2, 1: ; END_CASE;", "P3004 4:17"),
            ("CASE i OF 9: ; 5..7: ; 6..8: ; END_CASE;", "P3004 4:24"),
            ("CASE i OF 5..1: ; END_CASE;", "P2004 4:11"),
            ("CASE i OF j: ; END_CASE;", "P2005 4:11"),
            ("CASE i OF 40000: ; END_CASE;", "P2004 4:11"),
            ("CASE r OF 1: ; END_CASE;", "P2003 4:6"),
            ("CASE light OF Red: ; Red: ; END_CASE;", "P3004 4:22"),
            ("CASE light OF 1: ; END_CASE;", "P2001 4:15"),
            ("CASE i OF Red: ; END_CASE;", "P2001 4:11"),
            ("CASE vBYTE OF 1: ; END_CASE;", "P2001 4:15"),
            ("CASE nope OF 1: i := nope2; END_CASE;", "P1003 4:6, P1003 4:22"),
        ],
    );
}

#[test]
fn for_loops() {
    accept(
        stmt,
        &[
            "FOR i := 1 TO 10 DO a[0] := i; END_FOR;",
            "FOR i := 10 TO 1 BY -3 DO ; END_FOR;",
            "FOR vUSINT := 250 TO 255 DO ; END_FOR;",
            "FOR vLINT := 0 TO d BY i DO ; END_FOR;",
            "FOR pct := 0 TO 100 DO ; END_FOR;",
            "FOR i := 0 TO 3 DO FOR j := 0 TO i DO ; END_FOR; END_FOR;",
            "FOR i := 0 TO 3 DO ; END_FOR; i := 5; FOR i := 1 TO 2 DO ; END_FOR;",
        ],
    );
    expect(
        stmt,
        &[
            ("FOR r := 1 TO 10 DO ; END_FOR;", "P3005 4:5"),
            ("FOR a[1] := 1 TO 10 DO ; END_FOR;", "P3005 4:5"),
            ("FOR p1.x := 1 TO 10 DO ; END_FOR;", "P3005 4:5"),
            ("FOR i := 1 TO d DO ; END_FOR;", "P2007 4:15"),
            ("FOR i := 1 TO 40000 DO ; END_FOR;", "P2004 4:15"),
            ("FOR i := 1 TO 9 BY 0 DO ; END_FOR;", "P3006 4:20"),
            ("FOR vUSINT := 9 TO 1 BY -1 DO ; END_FOR;", "P2004 4:25"),
            ("FOR i := 1 TO 9 DO i := 3; END_FOR;", "P3005 4:20"),
            ("FOR i := 1 TO 9 DO FOR i := 1 TO 2 DO ; END_FOR; END_FOR;", "P3005 4:24"),
            ("FOR i := 1 TO 9 DO fs(o => i); END_FOR;", "P3005 4:28"),
            ("FOR d := 1 TO 9 DO fb(io := d); END_FOR;", "P3005 4:29"),
            ("FOR nope := 1 TO 9 DO i := nope; END_FOR;", "P1003 4:5"),
        ],
    );
}

#[test]
fn exit_and_continue() {
    accept(
        stmt,
        &[
            "WHILE b1 DO IF b2 THEN EXIT; END_IF; CONTINUE; END_WHILE;",
            "FOR i := 1 TO 2 DO CASE i OF 1: EXIT; END_CASE; END_FOR;",
        ],
    );
    expect(
        stmt,
        &[
            ("EXIT;", "P3003 4:1"),
            ("CONTINUE;", "P3003 4:1"),
            ("IF b1 THEN EXIT; END_IF;", "P3003 4:12"),
            ("REPEAT EXIT; UNTIL b1 END_REPEAT; EXIT;", "P3003 4:35"),
        ],
    );
    accept(stmt, &["RETURN;", "IF b1 THEN RETURN; END_IF;"]);
}

#[test]
fn what_can_be_assigned() {
    accept(
        stmt,
        &[
            "p1.x := r;",
            "a[i] := 3;",
            "m[1, 2] := r;",
            "m[1][2] := r;",
            "rows[1][2] := 3;",
            "rows[1, 2] := 3;",
            "vWORD.3 := b1;",
            "vWORD.%B1 := vBYTE;",
            "vLWORD.%D0 := vDWORD;",
            "s[2] := 'x';",
            "fs.i := 3;",
            "fbs[1].i := 3;",
            "ps[i].x := 1;",
            "ton1.PT := t;",
            "%QW3 := vWORD;",
            "%QX0.1 := b1;",
            "%MD4 := vDWORD;",
        ],
    );
    expect(
        stmt,
        &[
            ("fs.o := 3;", "P3010 4:1"),
            ("fb.n := 3;", "P3010 4:1"),
            ("fbs[2].o := 3;", "P3010 4:1"),
            ("ton1.Q := b1;", "P3010 4:1"),
            ("%IX0.0 := b1;", "P3013 4:1"),
            ("%IW3 := vWORD;", "P3013 4:1"),
            ("F(a := 1) := 3;", "P2014 4:1"),
        ],
    );
    expect(
        check,
        &[
            ("PROGRAM p VAR CONSTANT k : INT := 5; END_VAR k := 6; END_PROGRAM", "P3001 1:46"),
            ("PROGRAM p VAR CONSTANT k : ARRAY[0..1] OF INT := [1, 2]; END_VAR k[0] := 6; END_PROGRAM", "P3001 1:66"),
            ("FUNCTION_BLOCK b VAR_INPUT i : INT; END_VAR i := 6; END_FUNCTION_BLOCK", "P3002 1:45"),
            ("FUNCTION f : INT VAR_INPUT i : INT; END_VAR i := 6; f := i; END_FUNCTION", "P3002 1:45"),
            ("PROGRAM p VAR x AT %IX0.0 : BOOL; END_VAR x := TRUE; END_PROGRAM", "P3013 1:43"),
            ("VAR_GLOBAL x AT %IW0 : INT; END_VAR PROGRAM p VAR_EXTERNAL x : INT; END_VAR x := 1; END_PROGRAM", "P3013 1:77"),
            ("FUNCTION_BLOCK b VAR_OUTPUT o : INT; END_VAR VAR_IN_OUT io : INT; END_VAR o := 1; io := o; END_FUNCTION_BLOCK", ""),
        ],
    );
}

#[test]
fn results() {
    expect(
        check,
        &[
            ("FUNCTION f : INT END_FUNCTION", "P3012 1:10"),
            ("FUNCTION f : INT VAR x : INT; END_VAR x := f; END_FUNCTION", "P3012 1:10"),
            ("FUNCTION f : INT IF TRUE THEN f := 1; END_IF; END_FUNCTION", ""),
            ("FUNCTION f : ARRAY[0..1] OF INT f[1] := 2; END_FUNCTION", ""),
            ("TYPE s : STRUCT a : INT; END_STRUCT; END_TYPE FUNCTION f : s f.a := 2; END_FUNCTION", ""),
            ("FUNCTION f VAR_INPUT i : INT; END_VAR END_FUNCTION", ""),
            ("{external} FUNCTION f : INT END_FUNCTION", ""),
            ("FUNCTION f : INT FOR f := 1 TO 3 DO ; END_FOR; END_FUNCTION", ""),
        ],
    );
}
