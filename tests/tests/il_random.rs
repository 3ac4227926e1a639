//! Random expressions in Instruction List and in ST give the same values, on both engines (language reference §6.4).

use takt_tests::plc::Plc;
use takt_tests::rng::Rng;

/// An expression in both languages; the list leaves it as the current result.
struct Both {
    st: String,
    il: String,
}

/// A tree over variables and literals of the type. The right side is deferred unless it is an operand.
fn tree(random: &mut Rng, depth: usize, leaves: &[&str], operators: &[(&str, &str)]) -> Both {
    if depth == 0 || random.one_in(6) {
        let leaf = random.pick(leaves);
        return Both { st: leaf.to_owned(), il: format!("LD {leaf}\n") };
    }
    let left = tree(random, depth - 1, leaves, operators);
    let (st, il) = random.pick(operators);
    let right = tree(random, depth - 1, leaves, operators);
    let negated = il.ends_with('N');
    let not = if negated { "NOT " } else { "" };
    let deferred = match right.il.lines().count() {
        1 if random.one_in(2) => format!("{il} {}\n", right.st),
        1 if random.one_in(2) => format!("{il}( {}\n)\n", right.st),
        _ => format!("{il}(\n{})\n", right.il),
    };
    Both { st: format!("({} {st} {not}({}))", left.st, right.st), il: left.il + &deferred }
}

/// 40 expressions of a type in one program: `s0` in ST and `i0` in a function in Instruction List, and so on.
fn compare(ty: &str, values: [&str; 3], literal: &str, operators: &[(&str, &str)], seed: u64) {
    let mut random = Rng::new(seed);
    let (mut functions, mut body, mut vars) = (String::new(), String::new(), String::new());
    let params = format!("VAR_INPUT a, b, c : {ty}; END_VAR");
    for i in 0..40 {
        let both = tree(&mut random, 4, &["a", "b", "c", literal], operators);
        functions += &format!("FUNCTION f{i} : {ty} {params}\n{}ST f{i}\nEND_FUNCTION\n", both.il);
        body += &format!("s{i} := {};\ni{i} := f{i}(a, b, c);\n", both.st);
        vars += &format!("s{i}, i{i} : {ty}; ");
    }
    let [a, b, c] = values;
    let vars = format!("VAR a : {ty} := {a}; b : {ty} := {b}; c : {ty} := {c}; {vars} END_VAR");
    let mut plc = Plc::new(&format!("{functions}PROGRAM p {vars}\n{body}END_PROGRAM"));
    plc.scans(1);
    for i in 0..40 {
        assert_eq!(plc.get(&format!("p.s{i}")), plc.get(&format!("p.i{i}")), "{ty}, expression {i}, seed {seed}");
    }
}

#[test]
fn lists_and_statements_agree() {
    let numbers = [("+", "ADD"), ("-", "SUB"), ("*", "MUL")];
    let bits = [("AND", "AND"), ("OR", "OR"), ("XOR", "XOR"), ("AND", "ANDN"), ("OR", "ORN"), ("XOR", "XORN"), ("&", "&")];
    for seed in 0..4 {
        for ty in ["SINT", "INT", "DINT", "LINT"] {
            compare(ty, ["7", "-100", "55"], &format!("{ty}#3"), &numbers, seed);
        }
        for ty in ["USINT", "UINT", "UDINT", "ULINT"] {
            compare(ty, ["7", "200", "55"], &format!("{ty}#3"), &numbers, seed);
        }
        for ty in ["REAL", "LREAL"] {
            compare(ty, ["0.1", "-7.25", "1000.5"], &format!("{ty}#0.3"), &numbers, seed);
        }
        compare("BOOL", ["TRUE", "FALSE", "TRUE"], "BOOL#1", &bits, seed);
        for ty in ["BYTE", "WORD", "DWORD", "LWORD"] {
            compare(ty, ["16#5A", "16#0F", "16#81"], &format!("{ty}#16#3"), &bits, seed);
        }
    }
}
