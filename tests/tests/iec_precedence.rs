//! Precedence and associativity, as constants and with every operand in a variable. From: language reference §5.2 to §5.4, §18.

use takt_tests::plc::check;

const VARS: &str =
    "zero : INT := 0; one : INT := 1; two : INT := 2; three : INT := 3; four : INT := 4; seven : INT := 7; ten : INT := 10;
    xtwo : LREAL := 2.0; xthree : LREAL := 3.0; xfour : LREAL := 4.0; yes : BOOL := TRUE; no : BOOL; f0 : WORD := 16#F0;
    m3c : WORD := 16#3C; w1 : WORD := 16#01; i : INT; x : LREAL; b : BOOL; w : WORD;";

/// Words in the second column stand for the literals of the first.
const LITERALS: [(&str, &str); 15] = [
    ("xtwo", "2.0"),
    ("xthree", "3.0"),
    ("xfour", "4.0"),
    ("zero", "0"),
    ("one", "1"),
    ("two", "2"),
    ("three", "3"),
    ("four", "4"),
    ("seven", "7"),
    ("ten", "10"),
    ("yes", "TRUE"),
    ("no", "FALSE"),
    ("f0", "WORD#16#F0"),
    ("m3c", "WORD#16#3C"),
    ("w1", "WORD#16#01"),
];

/// The expression with variables, and with literals in their places.
fn both(target: &str, text: &str, value: &str) {
    check(VARS, &format!("{target} := {text};"), &[(target, value)]);
    let words: Vec<_> = text.split_inclusive(|c: char| !(c.is_ascii_alphanumeric())).collect();
    let literals: String = words.into_iter().map(literal).collect();
    check(VARS, &format!("{target} := {literals};"), &[(target, value)]);
}

fn literal(word: &str) -> String {
    let name = word.trim_end_matches(|c: char| !c.is_ascii_alphanumeric());
    let found = LITERALS.iter().find(|(variable, _)| *variable == name);
    found.map_or(word.to_owned(), |(_, literal)| word.replacen(name, literal, 1))
}

#[test]
fn products_before_sums() {
    for (text, value) in [
        ("two + three * four", "14"),
        ("two * three + four", "10"),
        ("ten - four / two", "8"),
        ("ten - seven MOD four", "7"),
        ("(two + three) * four", "20"),
        ("ten MOD four * three", "6"),
        ("ten * three MOD four", "2"),
    ] {
        both("i", text, value);
    }
}

#[test]
fn equal_levels_from_left_to_right() {
    for (text, value) in [
        ("ten - four - three", "3"),
        ("ten - (four - three)", "9"),
        ("ten / four / two", "1"),
        ("ten / (four / two)", "5"),
        ("ten - four + three", "9"),
        ("seven MOD four MOD two", "1"),
        ("ten / four * three", "6"),
    ] {
        both("i", text, value);
    }
}

#[test]
fn signs_bind_tightest() {
    for (text, value) in [
        ("-seven / two", "-3"),
        ("-seven MOD two", "-1"),
        ("seven MOD -two", "1"),
        ("-seven + ten", "3"),
        ("ten - -two", "12"),
        ("-two * -three", "6"),
        ("+two - three", "-1"),
    ] {
        both("i", text, value);
    }
    both("x", "-xtwo ** two", "4.0");
    both("x", "xtwo ** -two", "0.25");
}

#[test]
fn power_before_products_and_from_the_left() {
    both("x", "xtwo + xthree * xfour ** two", "50.0");
    both("x", "xtwo ** three ** two", "64.0");
    both("x", "xtwo * xthree ** two", "18.0");
}

#[test]
fn comparisons_before_logic() {
    for (text, value) in [
        ("two + three > four", "TRUE"),
        ("two < three AND three < four", "TRUE"),
        ("two < three = yes", "TRUE"),
        ("two > three = three > four", "TRUE"),
        ("two > three <> three < four", "TRUE"),
        ("NOT yes = no", "TRUE"),
        ("NOT (yes = no)", "TRUE"),
        ("NOT no = no", "FALSE"),
        ("yes OR no AND no", "TRUE"),
        ("(yes OR no) AND no", "FALSE"),
        ("yes OR yes XOR yes", "TRUE"),
        ("yes XOR yes AND no", "TRUE"),
        ("(yes XOR yes) AND no", "FALSE"),
        ("NOT yes OR yes", "TRUE"),
        ("NOT (yes OR yes)", "FALSE"),
        ("yes & no OR yes", "TRUE"),
    ] {
        both("b", text, value);
    }
}

#[test]
fn bit_strings_have_the_same_order() {
    both("w", "f0 AND m3c OR w1", "49");
    both("w", "f0 AND (m3c OR w1)", "48");
    both("w", "f0 XOR m3c AND w1", "240");
    both("w", "f0 OR m3c XOR m3c", "240");
    both("w", "NOT f0 AND m3c", "12");
}
