//! An ordinary file, from end to end.

use super::*;

#[test]
fn an_ordinary_file() {
    let text = "
(* a comment (* nested *) *)
TYPE Light : (Red, Amber, Green) := Amber; Pct : INT (0..100) := 50;
  Point : STRUCT x, y : REAL := 1.5; name : STRING(80); END_STRUCT;
END_TYPE
{external}
FUNCTION Add : INT VAR_INPUT a, b : INT; END_VAR END_FUNCTION
FUNCTION_BLOCK Counter // counts
VAR_INPUT clk : BOOL R_EDGE; END_VAR
VAR_OUTPUT n : DINT; END_VAR
VAR t : TON := (PT := T#1s); a : ARRAY [0..3, 1..2] OF INT := [1, 2(3, 4)]; END_VAR
  IF clk AND NOT t.Q THEN n := n + 1; ELSIF n = 3 THEN RETURN; ELSE t(IN := clk, Q => a.3); END_IF;
END_FUNCTION_BLOCK
CONFIGURATION Cell
  VAR_GLOBAL g AT %QX0.1 : BOOL; END_VAR
  RESOURCE Main ON PLC
    TASK Fast (INTERVAL := T#10ms, PRIORITY := 1);
    PROGRAM p WITH Fast : Motor (in1 := g, out1 => g);
  END_RESOURCE
END_CONFIGURATION
";
    let want = "(type Light (enum Red Amber Green) := Amber) (type Pct INT(0..100) := 50) \
        (type Point (struct (x y : REAL := 1.5) (name : STRING[80]))) \
        (function external Add : INT (input (a b : INT))) \
        (fb Counter (input (clk : BOOL rising)) (output (n : DINT)) \
        (var (t : TON := {PT=TIME#1000000000}) (a : [0..3,1..2]INT := [1 2x(3 4)])) \
        (if (AND clk (NOT t.Q)) {(:= n (+ n 1))} (= n 3) {return} else {(call t IN:=clk Q=>a.%X3)})) \
        (configuration Cell (global (g at %QX0.1 : BOOL)) (resource Main \
        (task Fast interval=TIME#10000000 priority=1) (instance p with Fast : Motor in1:=g out1=>g)))";
    assert_eq!(tree(text), want);
}

#[test]
fn one_mistake_one_message() {
    assert_eq!(codes("PROGRAM p VAR x INT; END_VAR x := 1; END_PROGRAM"), ["P0010 1:17"]);
    assert_eq!(codes("PROGRAM p\nx := ;\ny := 1;\nEND_PROGRAM"), ["P0010 2:6"]);
    assert_eq!(expr("a + b * c ** 2"), "(+ a (* b (** c 2)))");
}
