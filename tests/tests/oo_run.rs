//! Object orientation (language reference, sections 4.2 to 4.4, 4.7) run on both engines.

use takt_base::Profile;
use takt_image::Trap;
use takt_tests::plc::Plc;

/// Runs `scans` scans of a program and compares variables.
fn check(text: &str, scans: i64, want: &[(&str, &str)]) {
    check_in(Profile::Std, text, scans, want);
}

fn check_in(profile: Profile, text: &str, scans: i64, want: &[(&str, &str)]) {
    let mut plc = Plc::new_in(profile, text);
    plc.scans(scans);
    for (name, value) in want {
        assert_eq!(plc.get(name), *value, "{name} in\n{text}");
    }
}

const COUNTER: &str = "CLASS Counter
    VAR value : INT := 5; END_VAR
    METHOD PUBLIC up : INT VAR_INPUT inc : INT := 1; END_VAR value := value + inc; up := value; END_METHOD
    METHOD PUBLIC get : INT get := value; END_METHOD
    METHOD PUBLIC reset THIS.value := 0; END_METHOD
END_CLASS ";

#[test]
fn s4_4_methods_of_a_class() {
    let text = format!(
        "{COUNTER} PROGRAM main VAR c, d : Counter; list : ARRAY[1..3] OF Counter; i, a, b : INT; END_VAR
        a := c.up(inc := 3); a := c.up(); d.reset(); b := d.up(10);
        FOR i := 1 TO 3 DO list[i].up(i); END_FOR END_PROGRAM"
    );
    let want =
        [("main.a", "9"), ("main.b", "10"), ("main.c.value", "9"), ("main.list[1].value", "6"), ("main.list[3].value", "8")];
    check(&text, 1, &want);
}

#[test]
fn s4_7_all_forms_of_arguments_and_results() {
    check(
        "TYPE P : STRUCT x, y : INT; END_STRUCT END_TYPE
        FUNCTION_BLOCK F VAR n : INT; END_VAR
          METHOD PUBLIC point : P VAR_INPUT x, y : INT; END_VAR point.x := x; point.y := y + n; END_METHOD
          METHOD PUBLIC text : STRING[20] VAR_INPUT s : STRING[20]; END_VAR text := CONCAT('<', CONCAT(s, '>')); END_METHOD
          METHOD PUBLIC sum : LREAL VAR_INPUT a : P; END_VAR VAR_IN_OUT io : INT; END_VAR VAR_OUTPUT q : BOOL; d : DINT; END_VAR
            VAR t : INT := 7; END_VAR
            io := io + t; q := io > 10; d := a.x; sum := 0.5; n := n + 1; END_METHOD
          METHOD PUBLIC proc VAR_OUTPUT o : INT; END_VAR o := 42; END_METHOD
          n := n + 100;
        END_FUNCTION_BLOCK
        PROGRAM main VAR f : F; p : P; s : STRING[20]; r : LREAL; i : INT := 4; q, nq : BOOL; d : DINT; o : INT; END_VAR
        p := f.point(1, y := 2);
        s := f.text('hi');
        r := f.sum(a := p, io := i, q => q, d => d) + f.sum(p, i, NOT q => nq);
        f.proc(o => o); f(); END_PROGRAM"
            .replace("+ f.sum(p, i, NOT q => nq)", "+ f.sum(a := p, io := i, NOT q => nq)")
            .as_str(),
        1,
        &[
            ("main.p.x", "1"),
            ("main.p.y", "2"),
            ("main.s", "'<hi>'"),
            ("main.r", "1.0"),
            ("main.i", "18"),
            ("main.q", "TRUE"),
            ("main.nq", "FALSE"),
            ("main.d", "1"),
            ("main.o", "42"),
            ("main.f.n", "102"),
        ],
    );
}

const SHAPES: &str =
    "INTERFACE Shape METHOD area : REAL END_METHOD METHOD scale VAR_INPUT k : REAL; END_VAR END_METHOD END_INTERFACE
    INTERFACE Named METHOD name : STRING[10] END_METHOD END_INTERFACE
    INTERFACE Solid EXTENDS Shape, Named METHOD volume : REAL END_METHOD END_INTERFACE
    CLASS Square IMPLEMENTS Shape VAR PUBLIC side : REAL := 2.0; END_VAR
      METHOD PUBLIC area : REAL area := side * side; END_METHOD
      METHOD PUBLIC scale VAR_INPUT k : REAL; END_VAR side := side * k; END_METHOD
    END_CLASS
    CLASS Cube EXTENDS Square IMPLEMENTS Solid
      METHOD PUBLIC OVERRIDE area : REAL area := 6.0 * SUPER.area(); END_METHOD
      METHOD PUBLIC name : STRING[10] name := 'cube'; END_METHOD
      METHOD PUBLIC volume : REAL volume := side * side * side; END_METHOD
    END_CLASS
    FUNCTION_BLOCK Disk IMPLEMENTS Shape, Named VAR r : REAL := 1.0; END_VAR
      METHOD PUBLIC area : REAL area := 3.0 * r * r; END_METHOD
      METHOD PUBLIC scale VAR_INPUT k : REAL; END_VAR r := r * k; END_METHOD
      METHOD PUBLIC name : STRING[10] name := 'disk'; END_METHOD
    END_FUNCTION_BLOCK ";

#[test]
fn s4_4_interfaces_bind_dynamically() {
    let text = format!(
        "{SHAPES} PROGRAM main VAR sq : Square; cube : Cube; disk : Disk; s : Shape; list : ARRAY[1..3] OF Shape;
        i : INT; total, one : REAL; isnull, same, other : BOOL; END_VAR
        isnull := s = NULL;
        list[1] := sq; list[2] := cube; list[3] := disk;
        FOR i := 1 TO 3 DO list[i].scale(k := 2.0); total := total + list[i].area(); END_FOR
        s := list[3]; one := s.area(); same := s = list[3]; other := s <> disk; END_PROGRAM"
    );
    let want =
        [("main.total", "124.0"), ("main.one", "12.0"), ("main.isnull", "TRUE"), ("main.same", "TRUE"), ("main.other", "FALSE")];
    check(&text, 1, &want);
}

#[test]
fn s4_4_interfaces_as_parameters_members_and_results() {
    let text = format!("{SHAPES} TYPE Box : STRUCT what : Shape; n : INT; END_STRUCT END_TYPE
        FUNCTION area_of : REAL VAR_INPUT s : Shape; END_VAR area_of := s.area(); END_FUNCTION
        FUNCTION larger : Shape VAR_INPUT a, b : Shape; END_VAR
          IF a.area() > b.area() THEN larger := a; ELSE larger := b; END_IF END_FUNCTION
        FUNCTION swap : BOOL VAR_IN_OUT a, b : Shape; END_VAR VAR t : Shape; END_VAR t := a; a := b; b := t; swap := TRUE; END_FUNCTION
        PROGRAM main VAR sq : Square; disk : Disk; bx : Box; x, y, z, w : REAL; a, b : Shape; ok : BOOL; END_VAR
        bx.what := sq; x := area_of(bx.what); y := area_of(disk); z := larger(sq, disk).area();
        a := sq; b := disk; ok := swap(a, b); w := a.area(); END_PROGRAM");
    check(&text, 1, &[("main.x", "4.0"), ("main.y", "3.0"), ("main.z", "4.0"), ("main.w", "3.0"), ("main.ok", "TRUE")]);
}

#[test]
fn assignment_attempts_give_null_when_the_type_does_not_fit() {
    let text = format!("{SHAPES} PROGRAM main VAR sq : Square; cube : Cube; s : Shape; n : Named; solid : Solid; a, b, c, d : BOOL; t : STRING[10]; END_VAR
        s := sq; n ?= s; a := n = NULL;
        s := cube; n ?= s; b := n <> NULL; IF b THEN t := n.name(); END_IF
        solid ?= n; c := solid <> NULL; s := NULL; n ?= s; d := n = NULL; END_PROGRAM");
    check(&text, 1, &[("main.a", "TRUE"), ("main.b", "TRUE"), ("main.t", "'cube'"), ("main.c", "TRUE"), ("main.d", "TRUE")]);
}

#[test]
fn a_call_through_null_traps() {
    let text = format!("{SHAPES} PROGRAM main VAR s, t : Shape; x : REAL; END_VAR s := t; x := s.area(); END_PROGRAM");
    assert_eq!(Plc::new(&text).scan(0).unwrap_err().trap, Trap::NullReference);
}

#[test]
fn s4_2_a_derived_block_has_the_variables_of_its_base_first() {
    check("FUNCTION_BLOCK Base VAR_INPUT a : INT := 1; END_VAR VAR_OUTPUT q : INT; END_VAR VAR calls : INT; b : BYTE := 16#09; END_VAR
          calls := calls + 1; q := a * 10; END_FUNCTION_BLOCK
        FUNCTION_BLOCK Derived EXTENDS Base VAR_INPUT c : INT := 3; END_VAR VAR_OUTPUT r : INT; END_VAR VAR d : LREAL := 1.5; END_VAR
          SUPER(); r := q + c; END_FUNCTION_BLOCK
        FUNCTION_BLOCK Silent EXTENDS Base END_FUNCTION_BLOCK
        PROGRAM main VAR x : Derived := (c := 4); y : Silent; z : Base; q1, q2, q3 : INT; END_VAR
        x(a := 2, r => q1); y(a := 5, q => q2); z(q => q3); END_PROGRAM",
        2,
        &[("main.q1", "24"), ("main.q2", "50"), ("main.q3", "10"), ("main.x.calls", "2"), ("main.x.b", "9"), ("main.x.d", "1.5"),
          ("main.y.calls", "2")]);
}

#[test]
fn s4_4_this_and_in_out_bind_dynamically_and_instances_statically() {
    check("FUNCTION_BLOCK A VAR_OUTPUT n : INT; END_VAR
          METHOD PUBLIC who : INT who := 1; END_METHOD
          METHOD PUBLIC ask : INT ask := THIS.who() * 10 + who(); END_METHOD
          n := n + 1; END_FUNCTION_BLOCK
        FUNCTION_BLOCK B EXTENDS A METHOD PUBLIC OVERRIDE who : INT who := 2; END_METHOD n := n + 10; END_FUNCTION_BLOCK
        FUNCTION_BLOCK C EXTENDS B METHOD PUBLIC OVERRIDE who : INT who := SUPER.who() + 1; END_METHOD n := n + 100; END_FUNCTION_BLOCK
        FUNCTION test : INT VAR_IN_OUT x : A; END_VAR x(); test := x.ask() * 100 + x.who(); END_FUNCTION
        PROGRAM main VAR a : A; b : B; c : C; r1, r2, r3 : INT; END_VAR
        r1 := test(a); r2 := test(b); r3 := test(c); END_PROGRAM",
        1,
        &[("main.r1", "1101"), ("main.r2", "2202"), ("main.r3", "3303"), ("main.a.n", "1"), ("main.b.n", "10"), ("main.c.n", "100")]);
}

#[test]
fn copies_of_instances_keep_their_class() {
    check(
        "CLASS A VAR PUBLIC v : INT; b : BYTE; END_VAR METHOD PUBLIC who : INT who := 1; END_METHOD END_CLASS
        CLASS B EXTENDS A VAR PUBLIC w : BYTE := 16#07; END_VAR METHOD PUBLIC OVERRIDE who : INT who := 2; END_METHOD END_CLASS
        FUNCTION copy : INT VAR_IN_OUT dst, src : A; END_VAR dst := src; copy := dst.who() * 10 + src.who(); END_FUNCTION
        PROGRAM main VAR a, a2 : A; b : B; r, r2 : INT; END_VAR
        b.v := 5; a2.v := 6; r := copy(a, b); r2 := copy(b, a2); END_PROGRAM",
        1,
        &[("main.r", "12"), ("main.a.v", "5"), ("main.r2", "21"), ("main.b.v", "6"), ("main.b.w", "7")],
    );
}

#[test]
fn properties_are_read_and_assigned_like_variables() {
    let text = "INTERFACE HasLevel PROPERTY level : INT GET END_GET SET END_SET END_PROPERTY END_INTERFACE
        FUNCTION_BLOCK Tank IMPLEMENTS HasLevel VAR raw : INT; END_VAR
          PROPERTY PUBLIC level : INT GET level := raw / 2; END_GET SET raw := level * 2; END_SET END_PROPERTY
          PROPERTY PUBLIC full : BOOL GET VAR limit : INT := 100; END_VAR full := raw >= limit; END_GET END_PROPERTY
          METHOD PUBLIC fill level := level + 1; END_METHOD
        END_FUNCTION_BLOCK
        PROGRAM main VAR t : Tank; i : HasLevel; x, y : INT; f : BOOL; END_VAR
        t.level := 10; t.fill(); x := t.level + 1; i := t; i.level := i.level * 5; y := i.level; f := t.full; END_PROGRAM";
    for profile in [Profile::Std, Profile::Codesys] {
        check_in(profile, text, 1, &[("main.x", "12"), ("main.y", "55"), ("main.t.raw", "110"), ("main.f", "TRUE")]);
    }
}

#[test]
fn vendor_forms() {
    check_in(
        Profile::Codesys,
        "FUNCTION_BLOCK ABSTRACT Base VAR n : INT; END_VAR
          METHOD ABSTRACT inc : INT END_METHOD
          METHOD run : INT run := THIS^.inc() + THIS^.n; END_METHOD
          n := n + 1; END_FUNCTION_BLOCK
        FUNCTION_BLOCK FINAL Fast EXTENDS Base
          METHOD inc : INT VAR_INPUT END_VAR inc := 5; n := n + inc; END_METHOD
          SUPER^(); THIS^.n := THIS^.n + 10; END_FUNCTION_BLOCK
        PROGRAM main VAR f : Fast; r, seen : INT; END_VAR
        METHOD PRIVATE twice : INT VAR_INPUT x : INT; END_VAR twice := 2 * x; r := r + 1; END_METHOD
        f(); r := twice(f.run()); seen := f.n; END_PROGRAM",
        1,
        &[("main.f.n", "16"), ("main.seen", "16"), ("main.r", "42")],
    );
}

#[test]
fn recursion_loops_and_globals_in_methods() {
    check(
        "VAR_GLOBAL g : INT := 3; shared : Node; END_VAR
        CLASS Node VAR depth : DINT; sum : LINT; END_VAR
          METHOD PUBLIC fact : DINT VAR_INPUT n : DINT; END_VAR
            IF n <= 1 THEN fact := 1; ELSE fact := n * fact(n - 1); END_IF depth := depth + 1; END_METHOD
          METHOD PUBLIC loop : LINT VAR_EXTERNAL g : INT; END_VAR VAR i : INT; END_VAR
            FOR i := 1 TO 10 DO sum := sum + g; g := g + 1; END_FOR loop := sum; END_METHOD
        END_CLASS
        PROGRAM main VAR_EXTERNAL shared : Node; END_VAR VAR f : DINT; l : LINT; END_VAR
        f := shared.fact(5); l := shared.loop(); END_PROGRAM",
        1,
        &[("main.f", "120"), ("main.l", "75"), ("g", "13"), ("shared.depth", "5")],
    );
}

#[test]
fn constants_and_initial_values_are_inherited() {
    check("FUNCTION_BLOCK Base VAR CONSTANT size : INT := 3; END_VAR VAR list : ARRAY[0..2] OF INT := [1, 2, 3]; t : TON := (PT := T#5ms); END_VAR
          METHOD PUBLIC last : INT last := list[size - 1]; END_METHOD END_FUNCTION_BLOCK
        FUNCTION_BLOCK Derived EXTENDS Base VAR more : ARRAY[0..1] OF INT := [4, 5]; END_VAR
          METHOD PUBLIC sum : INT sum := list[0] + list[1] + list[size - 1] + more[0] + more[1]; END_METHOD END_FUNCTION_BLOCK
        PROGRAM main VAR d : Derived := (more := [7, 8]); e : ARRAY[1..2] OF Derived; a, b, c : INT; END_VAR
        a := d.sum(); b := d.last(); c := e[2].sum(); END_PROGRAM",
        1,
        &[("main.a", "21"), ("main.b", "3"), ("main.c", "15"), ("main.d.t.PT", "T#5ms")]);
}

#[test]
fn inherited_edge_inputs_are_seen_by_both_bodies() {
    check("FUNCTION_BLOCK Base VAR_INPUT clk : BOOL R_EDGE; END_VAR VAR n : INT; END_VAR IF clk THEN n := n + 1; END_IF END_FUNCTION_BLOCK
        FUNCTION_BLOCK Derived EXTENDS Base VAR m : INT; END_VAR IF clk THEN m := m + 1; END_IF SUPER(); END_FUNCTION_BLOCK
        PROGRAM main VAR d : Derived; k : BOOL; END_VAR k := NOT k; d(clk := k); END_PROGRAM",
        6,
        &[("main.d.n", "3"), ("main.d.m", "3")]);
}

#[test]
fn references_to_instances_bind_dynamically() {
    let text = format!("{SHAPES} PROGRAM main VAR sq : Square; cube : Cube; r : REF_TO Square; c : REF_TO Cube; s : Shape; x, y : REAL; a, b : BOOL; END_VAR
        r := REF(sq); x := r^.area(); c ?= r; a := c = NULL;
        r := REF(cube); y := r^.area(); c ?= r; b := c <> NULL; IF b THEN c^.scale(2.0); END_IF
        s := r^; s.scale(2.0); END_PROGRAM");
    check(&text, 1, &[("main.x", "4.0"), ("main.y", "24.0"), ("main.a", "TRUE"), ("main.b", "TRUE"), ("main.cube.side", "8.0")]);
}

#[test]
fn structures_extend_structures_in_codesys() {
    let text = "TYPE A : STRUCT x : INT := 1; y : BYTE := 2; END_STRUCT END_TYPE
        TYPE B EXTENDS A : STRUCT z : LINT := 3; END_STRUCT END_TYPE
        TYPE C : STRUCT EXTENDS B w : INT := 4; END_STRUCT END_TYPE
        PROGRAM main VAR c : C := (x := 10); s : LINT; END_VAR s := c.x + c.z + c.w; END_PROGRAM";
    check_in(Profile::Codesys, text, 1, &[("main.s", "17"), ("main.c.y", "2")]);
}
