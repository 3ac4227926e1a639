//! The shape of the typed program that the lowering relies on.

use super::*;
use crate::syntax::ast::Edge;
use takt_image::types::{Section, Type};

#[test]
fn an_instance_has_inputs_outputs_in_outs_variables_and_edge_memory() {
    let text = "FUNCTION_BLOCK fb VAR a : INT := 3; END_VAR VAR_IN_OUT io : DINT; END_VAR VAR_OUTPUT q : BOOL; END_VAR VAR_TEMP t : INT; END_VAR \
        VAR_INPUT c : BOOL R_EDGE; n : INT := 7; END_VAR END_FUNCTION_BLOCK PROGRAM p VAR f : fb; END_VAR END_PROGRAM";
    let built = build(text);
    assert_eq!(built.codes(), "");
    let pou = built.pou("fb");
    let Type::Instance(record) = built.hir.types.get(pou.instance.expect("an instance")) else { panic!("no record") };
    let fields: Vec<_> = record.fields.iter().map(|f| (f.name.as_str(), f.section, f.offset)).collect();
    assert_eq!(
        fields,
        [
            ("c", Section::Input, 0),
            ("n", Section::Input, 2),
            ("q", Section::Output, 4),
            ("io", Section::InOut, 8),
            ("a", Section::Var, 12),
            ("c.edge", Section::Hidden, 14),
        ]
    );
    let vars: Vec<_> = pou.vars.iter().map(|v| (v.name.as_str(), v.role, v.storage)).collect();
    assert_eq!(
        vars,
        [
            ("a", Role::Local, Storage::Field(4)),
            ("io", Role::InOut, Storage::Field(3)),
            ("q", Role::Output, Storage::Field(2)),
            ("t", Role::Temp, Storage::Local),
            ("c", Role::Input, Storage::Field(0)),
            ("n", Role::Input, Storage::Field(1)),
            ("c.edge", Role::Hidden, Storage::Field(5)),
        ]
    );
    assert_eq!(pou.params, [VarId(1), VarId(2), VarId(4), VarId(5)]);
    assert_eq!(pou.vars[VarId(4)].edge, Some((Edge::Rising, VarId(6))));
    assert_eq!(show(&built.pou("p").vars[VarId(0)].init), "[0, 7, 0, 0, 3, 0]");
    assert!(
        matches!(built.hir.types.get(record.fields[3].ty), Type::Reference { target } if built.hir.types.display(*target) == "DINT")
    );
}

#[test]
fn functions_keep_nothing() {
    let text = "FUNCTION f : INT VAR_INPUT a : INT; END_VAR VAR b : INT := 2; END_VAR VAR_OUTPUT c : INT; END_VAR f := a + b; c := 1; END_FUNCTION PROGRAM p END_PROGRAM";
    let built = build(text);
    let pou = built.pou("f");
    assert!(pou.instance.is_none() && pou.vars.iter().all(|v| v.storage == Storage::Local));
    assert_eq!((pou.result, pou.params.clone()), (Some(VarId(0)), vec![VarId(1), VarId(3)]));
    assert_eq!(built.sources.text(pou.end), "END_FUNCTION");
}

#[test]
fn default_arguments_are_written_out() {
    let built = build(&program(TYPES, VARS, "i := F(a := j);"));
    let StmtKind::Assign { value: Expr { kind: ExprKind::Call { args, .. }, .. }, .. } = &built.pou("p").body[0].kind else {
        panic!("no call")
    };
    assert!(matches!(&args[0], Arg::Value(Expr { kind: ExprKind::Load(_), .. })));
    assert!(matches!(&args[1], Arg::Value(Expr { kind: ExprKind::Const(Const::Int(7)), .. })));
}

#[test]
fn outputs_of_functions_nobody_wants() {
    let built = build(&program(TYPES, VARS, "G(a := 1, io := d, NOT q => b2);"));
    let StmtKind::Call(Expr { kind: ExprKind::Call { args, .. }, .. }) = &built.pou("p").body[0].kind else { panic!("no call") };
    let kinds: Vec<_> = args
        .iter()
        .map(|a| match a {
            Arg::Value(_) => "value",
            Arg::Reference(_) => "reference",
            Arg::Output { negated, .. } => {
                if *negated {
                    "complement"
                } else {
                    "output"
                }
            }
            Arg::Unused => "unused",
        })
        .collect();
    assert_eq!(kinds, ["value", "unused", "complement", "reference"]);
}

#[test]
fn implicit_conversions_are_written_out() {
    let how = |body: &str| {
        let built = build(&program(TYPES, VARS, body));
        assert_eq!(built.codes(), "", "{body}");
        match &built.pou("p").body[0].kind {
            StmtKind::Assign { value: Expr { kind: ExprKind::Convert(how, _), .. }, .. } => format!("{how:?}"),
            StmtKind::Assign { value, .. } => format!("{:?}", value.kind).chars().take_while(|c| c.is_alphabetic()).collect(),
            other => format!("{other:?}"),
        }
    };
    for (body, want) in [
        ("vDINT := i;", "Integer"),
        ("vREAL := i;", "IntToReal"),
        ("vLREAL := r;", "Real"),
        ("vWORD := b1;", "Integer"),
        ("vLTIME := t;", "Integer"),
        ("pct := i;", "Subrange"),
        ("i := pct;", "Subrange"),
        ("s := vCHAR;", "String"),
        ("s := s8;", "Load"),
        ("vINT := i;", "Load"),
        ("vBOOL := BYTE_TO_BOOL(vBYTE);", "LowBit"),
        ("vBOOL := INT_TO_BOOL(i);", "NonZero"),
        ("vDWORD := INT_TO_DWORD(i);", "ZeroExtend"),
        ("vUDINT := INT_TO_UDINT(i);", "Integer"),
        ("vREAL := DWORD_TO_REAL(vDWORD);", "Bits"),
        ("i := REAL_TO_INT(r);", "RealToInt"),
        ("i := TIME_TO_INT(t);", "Native"),
        ("s := INT_TO_STRING(i);", "Native"),
        ("i := TRUNC(r);", "Intrinsic"),
        ("t := t * 2;", "Intrinsic"),
        ("r := r ** 2;", "Intrinsic"),
        ("vTOD := vTOD + t;", "Native"),
    ] {
        assert_eq!(how(body), want, "{body}");
    }
}

#[test]
fn a_call_of_a_block() {
    let built = build(&program(TYPES, VARS, "fb(i := vSINT, io := d, e := b1, o => vDINT, NOT q => b2);"));
    assert_eq!(built.codes(), "");
    let StmtKind::CallBlock { pou, inputs, outputs, .. } = &built.pou("p").body[0].kind else { panic!("no call") };
    let name = |v: VarId| built.hir.pous[*pou].vars[v].name.as_str();
    assert_eq!(inputs.iter().map(|(v, _)| name(*v)).collect::<Vec<_>>(), ["i", "e", "io"]);
    let outputs: Vec<_> = outputs.iter().map(|o| (name(o.var), o.negated, o.convert.is_some())).collect();
    assert_eq!(outputs, [("o", false, true), ("q", true, false)]);
}

#[test]
fn case_labels_are_ranges() {
    let built = build(&program(TYPES, VARS, "CASE light OF Green: ; Red..Amber: ; END_CASE;"));
    let StmtKind::Case { arms, .. } = &built.pou("p").body[0].kind else { panic!("no case") };
    assert_eq!(arms.iter().map(|a| a.0.clone()).collect::<Vec<_>>(), [vec![(2, 2)], vec![(0, 1)]]);
}

/// The library itself has nothing to complain about.
#[test]
fn the_library_is_clean() {
    let built = build("PROGRAM p END_PROGRAM");
    assert_eq!(built.text(), "");
    assert!(built.hir.pous.len() > 10);
}

#[test]
fn the_same_text_gives_the_same_program() {
    let text = program(TYPES, VARS, "i := F(a := j); fs(i := 3); light := Red;");
    let once = format!("{:?}{:?}", build(&text).hir.pous, build(&text).hir.globals);
    assert_eq!(once, format!("{:?}{:?}", build(&text).hir.pous, build(&text).hir.globals));
}
