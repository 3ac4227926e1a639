//! Members, elements, bits and characters (language reference §2.7, §2.8, §2.9, §2.11).

use super::*;

#[test]
fn members() {
    expect(
        expr,
        &[
            ("p1.x", "REAL"),
            ("p1.tag", "STRING[8]"),
            ("ps[2].y", "REAL"),
            ("fs.o", "INT"),
            ("fs.i", "INT"),
            ("fb.n", "INT"),
            ("ton1.Q", "BOOL"),
        ],
    );
    expect(
        stmt,
        &[
            ("r := p1.z;", "P1005 4:9"),
            ("r := i.x;", "P1005 4:8"),
            ("d := fb.io;", "P1005 4:9"),
            ("b1 := fb.edge;", "P1005 4:10"),
            ("r := a.x;", "P1005 4:8"),
        ],
    );
}

#[test]
fn elements() {
    expect(
        expr,
        &[
            ("a[3]", "INT"),
            ("a[i]", "INT"),
            ("a[vULINT]", "INT"),
            ("a[pct]", "INT"),
            ("m[1, 3]", "REAL"),
            ("m[1][3]", "REAL"),
            ("rows[0]", "ARRAY[1..3] OF INT"),
            ("rows[0][1]", "INT"),
            ("rows[0, 1]", "INT"),
            ("s[1]", "CHAR"),
            ("ws[i]", "WCHAR"),
            ("p1.tag[3]", "CHAR"),
        ],
    );
    expect(
        stmt,
        &[
            ("i := a[10];", "P2009 4:8"),
            ("i := a[-1];", "P2009 4:8"),
            ("r := m[0, 0];", "P2009 4:8"),
            ("r := m[1];", "P2013 4:6"),
            ("r := m[1, 2, 3];", "P2008 4:6"),
            ("i := a[r];", "P2001 4:8"),
            ("i := a[b1];", "P2001 4:8"),
            ("i := a[Red];", "P2001 4:8"),
            ("i := i[1];", "P2008 4:6"),
            ("i := F[1];", "P2014 4:6"),
            ("vCHAR := s8[9];", "P2009 4:13"),
            ("vCHAR := s8[0];", "P2009 4:13"),
        ],
    );
}

#[test]
fn bits() {
    expect(
        expr,
        &[
            ("vWORD.0", "BOOL"),
            ("vWORD.15", "BOOL"),
            ("vWORD.%X3", "BOOL"),
            ("vDWORD.%B3", "BYTE"),
            ("vLWORD.%D1", "DWORD"),
            ("vLWORD.%W3", "WORD"),
        ],
    );
    expect(
        stmt,
        &[
            ("b1 := vWORD.16;", "P2009 4:7"),
            ("vBYTE := vWORD.%B2;", "P2009 4:10"),
            ("vWORD := vWORD.%D0;", "P2009 4:10"),
            ("b1 := i.3;", "P2003 4:7"),
            ("b1 := b2.0;", "P2003 4:7"),
            ("b1 := r.0;", "P2003 4:7"),
        ],
    );
}

/// Parts of constants are constants.
#[test]
fn elements_of_constants_fold() {
    let vars = "x : ARRAY[0..k[1]] OF INT := [1, 2, 3];";
    let constants = "VAR_GLOBAL CONSTANT k : ARRAY[0..1] OF INT := [5, 2]; z : ARRAY[0..1] OF INT := [2(0)]; END_VAR";
    assert_eq!(check_in(constants, vars, ""), "P1008 2:14");
    assert_eq!(check_in(constants, "x : INT := z[1] + k[0];", ""), "P1008 2:12, P1008 2:19");
}
