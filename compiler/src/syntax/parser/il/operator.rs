//! The words of Instruction List: operators with their modifiers, joined. From: IEC 61131-3 §7.2.4 (language reference §6.2).

use crate::syntax::ast::{BinaryOp, Name};
use crate::syntax::il::{Op, When};

/// What an operator word says.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Word {
    /// The operator, complemented or not.
    Simple(Op, bool),
    Jump(When),
    Call(When),
    Return(When),
}

/// Operators that are nothing but themselves, and may have `(`.
const BINARY: [(&str, BinaryOp, bool); 14] = [
    ("AND", BinaryOp::And, true),
    ("&", BinaryOp::And, true),
    ("OR", BinaryOp::Or, true),
    ("XOR", BinaryOp::Xor, true),
    ("ADD", BinaryOp::Add, false),
    ("SUB", BinaryOp::Sub, false),
    ("MUL", BinaryOp::Mul, false),
    ("DIV", BinaryOp::Div, false),
    ("MOD", BinaryOp::Mod, false),
    ("GT", BinaryOp::Gt, false),
    ("GE", BinaryOp::Ge, false),
    ("EQ", BinaryOp::Eq, false),
    ("NE", BinaryOp::Ne, false),
    ("LE", BinaryOp::Le, false),
];

/// Input operators of the standard function blocks that are no other operators as well.
const INPUTS: [&str; 8] = ["S1", "R1", "CLK", "CU", "CD", "PV", "IN", "PT"];

/// All words, for the nearest one.
pub(super) const WORDS: [&str; 33] = [
    "LD", "LDN", "ST", "STN", "S", "R", "AND", "ANDN", "OR", "ORN", "XOR", "XORN", "NOT", "ADD", "SUB", "MUL", "DIV", "MOD",
    "GT", "GE", "EQ", "NE", "LE", "LT", "JMP", "JMPC", "JMPCN", "CAL", "CALC", "CALCN", "RET", "RETC", "RETCN",
];

/// The operator of a word; `None` for the name of a function, and for nonsense.
pub(super) fn of(name: &Name) -> Option<Word> {
    let text = name.key();
    let plain = |op| Some(Word::Simple(op, false));
    match text.as_str() {
        "LD" => plain(Op::Load),
        "LDN" => Some(Word::Simple(Op::Load, true)),
        "ST" => plain(Op::Store),
        "STN" => Some(Word::Simple(Op::Store, true)),
        "S" => plain(Op::Set),
        "R" => plain(Op::Reset),
        "NOT" => plain(Op::Not),
        "LT" => plain(Op::Binary(BinaryOp::Lt)),
        _ if INPUTS.contains(&text.as_str()) => plain(Op::Input(name.clone())),
        _ => binary(&text).or_else(|| flow(&text)),
    }
}

fn binary(text: &str) -> Option<Word> {
    BINARY.iter().find_map(|(word, op, has_n)| match text.strip_prefix(word)? {
        "" => Some(Word::Simple(Op::Binary(*op), false)),
        "N" if *has_n => Some(Word::Simple(Op::Binary(*op), true)),
        _ => None,
    })
}

fn flow(text: &str) -> Option<Word> {
    let make = [("JMP", Word::Jump as fn(When) -> Word), ("CAL", Word::Call), ("RET", Word::Return)];
    make.iter().find_map(|(word, make)| condition(text.strip_prefix(word)?).map(make))
}

/// The modifier behind JMP, CAL and RET; N alone is a vendor's short form of CN.
pub(super) fn condition(text: &str) -> Option<When> {
    match text {
        "" => Some(When::Always),
        "C" => Some(When::True),
        "CN" | "N" => Some(When::False),
        _ => None,
    }
}

impl Word {
    /// The same with a modifier that stands apart; `None` if it does not take it.
    pub(super) fn modified(&self, modifier: &str) -> Option<Word> {
        let modifier = modifier.to_ascii_uppercase();
        let when = || condition(&modifier);
        match self {
            Word::Simple(op @ (Op::Load | Op::Store | Op::Binary(BinaryOp::And | BinaryOp::Or | BinaryOp::Xor)), false) => {
                (modifier == "N").then(|| Word::Simple(op.clone(), true))
            }
            Word::Jump(When::Always) => when().map(Word::Jump),
            Word::Call(When::Always) => when().map(Word::Call),
            Word::Return(When::Always) => when().map(Word::Return),
            _ => None,
        }
    }
    /// True if `(` may follow and defer it.
    pub(super) fn defers(&self) -> bool {
        matches!(self, Word::Simple(Op::Binary(_), _))
    }
}
