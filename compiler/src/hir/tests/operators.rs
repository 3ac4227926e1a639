//! Overloads of the library: common types, typed names, conversions (library reference §1 to §8, §13).

use super::*;

#[test]
fn overloaded_functions() {
    expect(
        expr,
        &[
            ("ABS(i)", "INT"),
            ("ABS(-5)", "DINT 5"),
            ("ABS(b1)", "P2003"),
            ("SQRT(r)", "REAL"),
            ("SQRT(i)", "REAL"),
            ("SQRT(d)", "LREAL"),
            ("SQRT(vLINT)", "P2003"),
            ("SQRT(2)", "LREAL 1.4142135623730951"),
            ("SIN(0.0)", "LREAL 0.0"),
            ("SIN(vLREAL)", "LREAL"),
            ("ATAN2(1.0, r)", "REAL"),
            ("MAX(i, j)", "INT"),
            ("MAX(i, d, 3)", "DINT"),
            ("MAX(3, 7, 5)", "DINT 7"),
            ("MIN(r, i)", "REAL"),
            ("MAX(s, s8)", "STRING[254]"),
            ("MAX(light, Red)", "P2003"),
            ("MAX(i, b1)", "P2002"),
            ("LIMIT(0, i, 100)", "INT"),
            ("LIMIT(0, 500, 100)", "DINT 100"),
            ("SEL(b1, i, d)", "DINT"),
            ("SEL(b1, p1, p2)", "Point"),
            ("SEL(b1, Red, light)", "Light"),
            ("SEL(i, 1, 2)", "P2001"),
            ("MUX(i, 1.5, r)", "REAL"),
            ("MUX(1, 10, 20, 30)", "DINT 20"),
            ("MUX(r, 1, 2)", "P2001"),
            ("MOVE(p1)", "Point"),
            ("SHL(vWORD, 3)", "WORD"),
            ("SHL(BYTE#16#45, 2)", "BYTE 20"),
            ("ROL(BYTE#16#C0, 2)", "BYTE 3"),
            ("ROR(BYTE#16#01, 1)", "BYTE 128"),
            ("SHR(vBYTE, i)", "BYTE"),
            ("SHL(i, 3)", "P2003"),
            ("SHL(16#FF, 1)", "P2003"),
            ("SHL(vWORD, r)", "P2001"),
            ("ADD(i, 1, d)", "DINT"),
            ("ADD(t, t)", "TIME"),
            ("SUB(vDT, t)", "DT"),
            ("MUL(t, 2)", "TIME"),
            ("DIV(7, 2)", "DINT 3"),
            ("MOD(7, 2)", "DINT 1"),
            ("EXPT(r, 2)", "REAL"),
            ("GT(i, j)", "BOOL"),
            ("GT(i, j, d)", "BOOL"),
            ("EQ(light, Red)", "BOOL"),
            ("NE(s, 'x')", "BOOL"),
            ("NE(i, j, 3)", "P2013"),
            ("AND(b1, b2, b1)", "BOOL"),
            ("NOT(vWORD)", "WORD"),
            ("TRUNC(r)", "DINT"),
            ("TRUNC(-1.6)", "DINT -1"),
            ("IS_VALID(r)", "BOOL"),
            ("TIME()", "TIME"),
        ],
    );
}

#[test]
fn strings() {
    expect(
        expr,
        &[
            ("LEN(s)", "INT"),
            ("LEFT(s8, 3)", "STRING[8]"),
            ("MID(IN := s8, L := 2, P := 1)", "STRING[8]"),
            ("CONCAT(s8, s8)", "STRING[16]"),
            ("CONCAT(s8, 'abc', vCHAR)", "STRING[12]"),
            ("CONCAT(ws, \"x\")", "WSTRING[255]"),
            ("CONCAT(s, ws)", "P2002"),
            ("INSERT(s8, 'xy', 1)", "STRING[10]"),
            ("REPLACE(s8, 'xy', 1, 1)", "STRING[10]"),
            ("FIND(s, 'x')", "INT"),
            ("LEN(i)", "P2003"),
            ("LEFT(s, r)", "P2001"),
        ],
    );
}

/// A native has 32 slots; longer chains are joined in steps.
#[test]
fn long_concatenations() {
    let many = |n: usize| format!("s := CONCAT({});", vec!["s8"; n].join(", "));
    assert_eq!(stmt(&many(15)), "");
    assert_eq!(stmt(&many(64)), "");
    assert_eq!(stmt(&many(65)), "P2013 4:6");
    fn widest(e: &Expr) -> usize {
        match &e.kind {
            ExprKind::Native { args, .. } => args.iter().map(widest).max().unwrap_or(0).max(args.len()),
            _ => 0,
        }
    }
    let built = build(&program(TYPES, VARS, &many(64)));
    let StmtKind::Assign { value, .. } = &built.pou("p").body[0].kind else { panic!("no assignment") };
    assert_eq!(widest(value), 15);
}

#[test]
fn typed_names() {
    expect(
        expr,
        &[
            ("ADD_INT(i, j)", "INT"),
            ("ADD_INT(i, d)", "P2007"),
            ("ADD_DINT(i, d)", "DINT"),
            ("MAX_TIME(t, T#1s)", "TIME"),
            ("SIN_LREAL(r)", "LREAL"),
            ("SEL_REAL(TRUE, 1, 2)", "REAL 2.0"),
            ("ABS_BOOL(b1)", "P1003"),
            ("ADD_TIME(t, t)", "TIME"),
            ("ADD_DT_TIME(vDT, t)", "DT"),
            ("SUB_DATE_DATE(vDATE, vDATE)", "TIME"),
            ("MUL_TIME(t, 2.5)", "TIME"),
            ("CONCAT_DATE_TOD(vDATE, vTOD)", "DT"),
            ("DAY_OF_WEEK(D#2024-12-31)", "INT 2"),
        ],
    );
}

/// Library reference §2.1; the values of §2.2 and §2.6, profile std.
#[test]
fn conversion_functions() {
    expect(
        expr,
        &[
            ("INT_TO_REAL(i)", "REAL"),
            ("DINT_TO_INT(d)", "INT"),
            ("DINT_TO_INT(i)", "INT"),
            ("INT_TO_DINT(d)", "P2007"),
            ("TO_INT(r)", "INT"),
            ("TO_REAL(d)", "REAL"),
            ("TO_INT(light)", "INT"),
            ("INT_TO_DWORD(-1)", "DWORD 65535"),
            ("INT_TO_UDINT(-1)", "P2004"),
            ("DWORD_TO_REAL(16#3F800000)", "REAL 1.0"),
            ("REAL_TO_DWORD(1.0)", "DWORD 1065353216"),
            ("BYTE_TO_BOOL(2#10)", "BOOL 0"),
            ("BYTE_TO_SINT(16#FF)", "SINT -1"),
            ("INT_TO_BOOL(2)", "BOOL 1"),
            ("BOOL_TO_INT(TRUE)", "INT 1"),
            ("TIME_TO_DINT(T#1s500ms)", "DINT 1500"),
            ("DINT_TO_TIME(1500)", "TIME 1500000000"),
            ("REAL_TO_INT(0.5)", "INT 0"),
            ("REAL_TO_INT(1.5)", "INT 2"),
            ("REAL_TO_INT(2.5)", "INT 2"),
            ("REAL_TO_INT(-2.5)", "INT -2"),
            ("REAL_TO_INT(32767.4)", "INT 32767"),
            ("LREAL_TO_REAL(0.1)", "REAL 0.10000000149011612"),
            ("TRUNC_INT(r)", "INT"),
            ("REAL_TRUNC_DINT(1.6)", "DINT 1"),
            ("DT_TO_DATE(DT#2024-02-29-23:59:59)", "DATE 1709164800000000000"),
            ("DT_TO_TOD(DT#1969-12-31-23:00:00)", "TOD 82800000000000"),
            ("INT_TO_STRING(i)", "STRING[64]"),
            ("STRING_TO_INT(s)", "INT"),
            ("STRING_TO_WSTRING(s8)", "WSTRING[8]"),
            ("CHAR_TO_BYTE(vCHAR)", "BYTE"),
            ("WORD_TO_REAL(vWORD)", "P2001"),
            ("INT_TO_CHAR(i)", "P1003"),
            ("TO_INT(vCHAR)", "P2001"),
            ("INT_TO_REAL(IN := i)", "REAL"),
            ("INT_TO_REAL(X := i)", "P1006"),
            ("INT_TO_REAL(i, i)", "P2013"),
            ("INT_TO_REAL()", "P2013"),
            ("USINT_TO_BCD_BYTE(42)", "BYTE 66"),
            ("WORD_BCD_TO_UINT(16#1234)", "UINT 1234"),
        ],
    );
    // TRUNC gives what the context wants.
    accept(stmt, &["vSINT := TRUNC(r);", "vULINT := TRUNC(vLREAL);", "r := TO_REAL(vLINT);"]);
}

#[test]
fn formal_names_of_standard_functions() {
    expect(
        expr,
        &[
            ("LIMIT(MN := 0, IN := i, MX := 9)", "INT"),
            ("LIMIT(MX := 9, MN := 0, IN := i)", "INT"),
            ("ADD(IN1 := i, IN2 := 2, IN3 := 3)", "INT"),
            ("ADD(IN1 := i, IN3 := 3)", "P2013"),
            ("MUX(K := i, IN0 := 1, IN1 := 2, IN2 := 3)", "DINT"),
            ("SEL(G := b1, IN0 := i, IN1 := j)", "INT"),
            ("SHL(IN := vWORD, N := 2)", "WORD"),
            ("SIN(IN := r)", "REAL"),
            ("SIN(X := r)", "P1006"),
            ("SIN(IN := r, IN := r)", "P2013"),
            ("ADD(EN := b1, IN1 := 1, IN2 := 2)", "P0012"),
            ("SIN(OUT => r)", "P1006"),
        ],
    );
}
