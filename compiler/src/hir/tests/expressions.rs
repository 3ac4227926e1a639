//! Types and values of expressions; constants fold as they are built.

use super::*;

/// Language reference §18.5 and §18.6.
#[test]
fn micro_examples() {
    expect(
        expr,
        &[
            ("2 + 3 * 4 ** 2", "DINT 50"),
            ("NOT TRUE OR TRUE", "BOOL 1"),
            ("10 - 4 - 3", "DINT 3"),
            ("-7 / 2", "DINT -3"),
            ("-7 MOD 2", "DINT -1"),
            ("INT#300 + UINT#5", "DINT 305"),
            ("WORD#16#FF00 OR BYTE#16#0F", "WORD 65295"),
            ("REAL#1 / 3", "REAL 0.3333333432674408"),
            ("2 ** 3 ** 2", "DINT 64"),
            ("-2 ** 2", "DINT 4"),
            ("i + vUINT", "DINT"),
            ("vSINT + vSINT", "SINT"),
            ("vDINT + vUDINT", "LINT"),
            ("i + r", "REAL"),
            ("vDINT + r", "LREAL"),
            ("vWORD OR vBYTE", "WORD"),
        ],
    );
    // 16#F0 AND 16#3C OR 16#01 takes its type from the context.
    assert_eq!(stmt("vBYTE := 16#F0 AND 16#3C OR 16#01;"), "");
    assert_eq!(init("", "BYTE := 16#F0 AND 16#3C OR 16#01"), "49");
}

#[test]
fn literals_without_a_context() {
    expect(
        expr,
        &[
            ("5", "DINT 5"),
            ("2147483648", "LINT 2147483648"),
            ("9223372036854775808", "ULINT 9223372036854775808"),
            ("1.5", "LREAL 1.5"),
            ("TRUE", "BOOL 1"),
            ("'ab'", "STRING[2] 'ab'"),
            ("\"ab\"", "WSTRING[2] \"ab\""),
            ("T#1s", "TIME 1000000000"),
            ("LT#1ns", "LTIME 1"),
            ("D#1970-01-02", "DATE 86400000000000"),
            ("INT#-5", "INT -5"),
            ("CHAR#'A'", "CHAR 65"),
        ],
    );
}

#[test]
fn literals_beside_typed_operands_take_their_type() {
    expect(
        expr,
        &[
            ("i + 1", "INT"),
            ("1 + i", "INT"),
            ("vUSINT * 2", "USINT"),
            ("r * 2", "REAL"),
            ("r * 0.1", "REAL"),
            ("i * 0.1", "REAL"),
            ("vDINT * 0.1", "LREAL"),
            ("vLINT * 0.1", "P2002"),
            ("vWORD AND 16#FF", "WORD"),
            ("vWORD AND 255", "P2001"),
            ("i + 40000", "P2004"),
            ("vUSINT - 256", "P2004"),
            ("vWORD = 16#0", "BOOL"),
            ("i = 5", "BOOL"),
            ("vBOOL = 1", "BOOL"),
            ("vCHAR = 'x'", "BOOL"),
            ("s = 'x'", "BOOL"),
            ("vCHAR = s", "BOOL"),
            ("i > 1.5", "BOOL"),
        ],
    );
}

#[test]
fn operators_by_type() {
    expect(
        expr,
        &[
            ("vBOOL + vBOOL", "P2003"),
            ("vWORD + vWORD", "P2003"),
            ("i AND j", "P2003"),
            ("NOT i", "P2003"),
            ("NOT 5", "P2003"),
            ("-b1", "P2003"),
            ("-s", "P2003"),
            ("-'5'", "P2003"),
            ("-t", "TIME"),
            ("-r", "REAL"),
            ("+i", "INT"),
            ("r MOD r", "P2003"),
            ("i MOD j", "INT"),
            ("s + s", "P2003"),
            ("s < s8", "BOOL"),
            ("s = ws", "P2002"),
            ("light = Red", "BOOL"),
            ("Red = light", "BOOL"),
            ("light < Red", "P0014"),
            ("light = mode", "P2002"),
            ("light + light", "P2003"),
            ("col OR White", "DWORD"),
            ("col = White", "BOOL"),
            ("p1 = p2", "P2003"),
            ("a = a", "P2003"),
            ("fs = fs", "P2003"),
            ("i + s", "P2002"),
            ("i + b1", "P2002"),
            ("vINT + vWORD", "P2002"),
            ("vLINT + vULINT", "P2002"),
            ("b1 AND vBYTE", "BYTE"),
            ("b1 AND_THEN b2", "BOOL"),
            ("vBYTE AND_THEN vBYTE", "P2003"),
            ("b1 < b2", "BOOL"),
            ("vWORD > vBYTE", "BOOL"),
            ("pct + 1", "INT"),
            ("pct * pct", "INT"),
            ("i < r", "BOOL"),
            ("b1 XOR b2", "BOOL"),
        ],
    );
}

#[test]
fn power() {
    expect(
        expr,
        &[
            ("r ** 2", "REAL"),
            ("r ** i", "REAL"),
            ("vLREAL ** vREAL", "LREAL"),
            ("i ** 2", "LREAL"),
            ("2 ** 10", "DINT 1024"),
            ("2.0 ** 3", "LREAL 8.0"),
            ("2.0 ** 0.5", "LREAL 1.4142135623730951"),
            ("2 ** -1", "LREAL 0.5"),
            ("b1 ** 2", "P2003"),
            ("r ** b1", "P2003"),
            ("t ** 2", "P2003"),
        ],
    );
    accept(stmt, &["r := i ** 2;", "r := r ** r;", "vLREAL := i ** j;", "i := 2 ** 4;", "i := i ** 2;", "i := -(i ** j);"]);
    expect(stmt, &[("r := vDINT ** 2;", "P2007 4:6"), ("i := i ** r;", "P2007 4:6")]);
}

/// Library reference §8.1.
#[test]
fn durations_and_dates() {
    expect(
        expr,
        &[
            ("t + t", "TIME"),
            ("t - t", "TIME"),
            ("t + vLTIME", "LTIME"),
            ("t * 2", "TIME"),
            ("2 * t", "TIME"),
            ("t * i", "TIME"),
            ("t * r", "TIME"),
            ("t * 0.5", "TIME"),
            ("t / 2", "TIME"),
            ("t / r", "TIME"),
            ("vLTIME * vULINT", "LTIME"),
            ("vTOD + t", "TOD"),
            ("vTOD - t", "TOD"),
            ("vTOD - vTOD", "TIME"),
            ("vDT + t", "DT"),
            ("vDT - t", "DT"),
            ("vDT - vDT", "TIME"),
            ("vDATE - vDATE", "TIME"),
            ("vLDT - vLDT", "LTIME"),
            ("vLDT + t", "LDT"),
            ("vLTOD - vLTIME", "LTOD"),
            ("vDATE + t", "P2003"),
            ("vDT + vDT", "P2003"),
            ("t * t", "P2003"),
            ("t / t", "P2003"),
            ("2 / t", "P2003"),
            ("t MOD 2", "P2003"),
            ("t + 5", "P2003"),
            ("t * b1", "P2003"),
            ("vDATE - vDT", "P2003"),
            ("t < T#1s", "BOOL"),
            ("vDT >= DT#2024-01-01-00:00:00", "BOOL"),
            ("t = vDT", "P2002"),
            ("T#1h + T#30m", "TIME 5400000000000"),
            ("T#1s - T#2s", "TIME -1000000000"),
            ("T#1s * 0.3333", "TIME 333300000"),
            ("T#10ms / 4", "TIME 2500000"),
            ("T#-7ns / 2", "TIME -4"),
            ("TOD#23:59:59 + T#2s", "TOD 1000000000"),
            ("D#2024-01-01 - D#2023-01-01", "TIME 31536000000000000"),
            ("T#1s / 0", "P2011"),
        ],
    );
}

/// §11: what is wrong with a constant is an error at compile time.
#[test]
fn constant_expressions_are_checked() {
    expect(
        expr,
        &[
            ("1 / 0", "P2011"),
            ("i / 0", "P2011"),
            ("i MOD 0", "P2011"),
            ("1.0 / 0.0", "P2011"),
            ("r / 0.0", "REAL"),
            ("SINT#100 + SINT#100", "P2004"),
            ("INT#-32768 / INT#-1", "P2004"),
            ("-SINT#-128", "P2004"),
            ("-USINT#1", "P2004"),
            ("100000 * 100000", "LINT 10000000000"),
            ("9223372036854775807 * 4", "P2004"),
            ("1.0E308 * 10.0", "LREAL inf"),
            ("DINT_TO_INT(70000)", "P2004"),
            ("REAL_TO_INT(40000.0)", "P2004"),
            ("SHL(BYTE#1, -1)", "P2004"),
            ("2 < 3", "BOOL 1"),
            ("'a' < 'b'", "BOOL 1"),
            ("NOT WORD#16#FF", "WORD 65280"),
            ("1 AND 3", "P2003"),
        ],
    );
}

/// Whole-number division stays whole, whatever the context wants.
#[test]
fn untyped_division_is_integer_division() {
    assert_eq!(init("", "REAL := 7 / 2"), "3.0");
    assert_eq!(init("", "REAL := 7.0 / 2"), "3.5");
}

/// §5.4: the right side of AND and OR is skipped when it calls nobody and may trap.
#[test]
fn short_circuit() {
    let op = |condition: &str| {
        let built = build(&program(TYPES, VARS, &format!("vBOOL := {condition};")));
        assert_eq!(built.codes(), "", "{condition}");
        match &built.pou("p").body[0].kind {
            StmtKind::Assign { value: Expr { kind: ExprKind::Binary(op, ..), .. }, .. } => format!("{op:?}"),
            other => format!("{other:?}"),
        }
    };
    assert_eq!(op("b1 AND b2"), "And");
    assert_eq!(op("b1 AND i > 0"), "And");
    assert_eq!(op("i <> 0 AND j / i > 2"), "AndThen");
    assert_eq!(op("i > 9 OR a[i] = 0"), "OrElse");
    assert_eq!(op("b1 AND a[3] = 0"), "And");
    assert_eq!(op("b1 AND F(a := i) / i = 0"), "And");
    assert_eq!(op("b1 AND s[i] = 'x'"), "AndThen");
    assert_eq!(op("b1 AND_THEN b2"), "AndThen");
    assert_eq!(op("b1 AND NOT (j MOD i = 0)"), "AndThen");
    assert_eq!(op("j / i > 2 AND b1"), "And");
}

#[test]
fn a_mistake_is_reported_once() {
    expect(
        stmt,
        &[
            ("i := nope + 1 * nope2;", "P1003 4:6, P1003 4:17"),
            ("i := F(a := nope) + r;", "P1003 4:13"),
            ("nope := s + i;", "P1003 4:1, P2002 4:9"),
            ("IF nope > 3 AND b1 THEN i := 1; END_IF;", "P1003 4:4"),
            ("i := a[nope];", "P1003 4:8"),
            ("vSINT := (vBOOL + vBOOL) * 3;", "P2003 4:10"),
            ("nope(i := nope);", "P1003 4:1, P1003 4:11"),
        ],
    );
}
