//! The tree of an Instruction List: lines as written, operators not yet typed.
//! From: IEC 61131-3 §7.2 (language reference §6).
#![allow(missing_docs)] // the names of fields and variants say it; what they do not say stands beside them

use super::ast::{BinaryOp, Expr, Name};
use takt_base::Span;

/// `label: instruction`; either may be missing.
#[derive(Clone, Debug)]
pub struct Line {
    pub label: Option<Name>,
    pub instr: Option<Instr>,
}

/// An instruction.
#[derive(Clone, Debug)]
pub struct Instr {
    pub kind: InstrKind,
    /// All of it.
    pub span: Span,
}

#[derive(Clone, Debug)]
pub enum InstrKind {
    /// LD, ST, S, R, NOT, logic, arithmetic, comparisons, and the input operators of function blocks.
    Simple {
        op: Op,
        negated: bool,
        operand: Option<Expr>,
    },
    /// `ADD( operand` up to `)`: an operand that stands behind the parenthesis is the first LD of the list.
    Deferred {
        op: Op,
        negated: bool,
        list: Vec<Instr>,
    },
    Jump {
        when: When,
        label: Name,
    },
    Call {
        when: When,
        instance: Expr,
        args: Vec<Arg>,
    },
    Return(When),
    /// A function; informal ones take the current result as their first argument.
    Function {
        name: Name,
        args: Vec<Arg>,
        formal: bool,
    },
    /// Something was wrong here and has been reported.
    Error,
}

/// What an operator does with the current result and its operand.
#[derive(Clone, Debug, PartialEq)]
pub enum Op {
    Load,
    Store,
    /// `ST?`
    Attempt,
    Set,
    Reset,
    Not,
    Binary(BinaryOp),
    /// `CU`, `PT`, ...: stores into this input of an instance and calls it.
    Input(Name),
}

/// The condition of JMP, CAL and RET.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum When {
    Always,
    /// C
    True,
    /// CN
    False,
}

/// An argument.
#[derive(Clone, Debug)]
pub enum Arg {
    Positional(Expr),
    Input { name: Name, value: Value },
    Output { name: Name, negated: bool, target: Expr },
}

/// The value of a named argument.
#[derive(Clone, Debug)]
pub enum Value {
    Operand(Expr),
    /// `( LD a  AND b )`
    List(Vec<Instr>),
}

impl Instr {
    /// The expressions that stand in it, nested instructions included. Keeps its own stack.
    pub fn expressions(&self) -> Vec<&Expr> {
        let (mut todo, mut found) = (vec![self], Vec::new());
        while let Some(instr) = todo.pop() {
            match &instr.kind {
                InstrKind::Simple { operand, .. } => found.extend(operand),
                InstrKind::Deferred { list, .. } => todo.extend(list),
                InstrKind::Call { instance, args, .. } => {
                    found.push(instance);
                    arguments(args, &mut todo, &mut found);
                }
                InstrKind::Function { args, .. } => arguments(args, &mut todo, &mut found),
                InstrKind::Jump { .. } | InstrKind::Return(_) | InstrKind::Error => {}
            }
        }
        found
    }
}

fn arguments<'t>(args: &'t [Arg], todo: &mut Vec<&'t Instr>, found: &mut Vec<&'t Expr>) {
    for arg in args {
        match arg {
            Arg::Positional(e) | Arg::Output { target: e, .. } => found.push(e),
            Arg::Input { value: Value::Operand(e), .. } => found.push(e),
            Arg::Input { value: Value::List(list), .. } => todo.extend(list),
        }
    }
}
