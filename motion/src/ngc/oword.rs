//! O words: subroutines, branches and loops (LinuxCNC "O Codes").

use super::expr::{Slice, Value};
use super::param::Name;

/// Which subroutine or block.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Label {
    /// `o100`.
    Number(u32),
    /// `o<name>`.
    Name(Name),
    /// `o[#1]`, `o#1`.
    Computed(Value),
}

/// What an O word says.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Keyword {
    Sub,
    EndSub,
    Call,
    Return,
    If,
    ElseIf,
    Else,
    EndIf,
    While,
    EndWhile,
    Do,
    Repeat,
    EndRepeat,
    Break,
    Continue,
    /// `O100` alone: the start of a Fanuc-style program.
    Program,
}

impl Keyword {
    /// As written.
    pub const fn text(self) -> &'static str {
        match self {
            Keyword::Sub => "sub",
            Keyword::EndSub => "endsub",
            Keyword::Call => "call",
            Keyword::Return => "return",
            Keyword::If => "if",
            Keyword::ElseIf => "elseif",
            Keyword::Else => "else",
            Keyword::EndIf => "endif",
            Keyword::While => "while",
            Keyword::EndWhile => "endwhile",
            Keyword::Do => "do",
            Keyword::Repeat => "repeat",
            Keyword::EndRepeat => "endrepeat",
            Keyword::Break => "break",
            Keyword::Continue => "continue",
            Keyword::Program => "",
        }
    }

    /// All that are written, longer ones before their beginnings.
    pub const ALL: [Keyword; 15] = [
        Keyword::EndSub,
        Keyword::EndIf,
        Keyword::EndWhile,
        Keyword::EndRepeat,
        Keyword::ElseIf,
        Keyword::Else,
        Keyword::Sub,
        Keyword::Call,
        Keyword::Return,
        Keyword::Repeat,
        Keyword::If,
        Keyword::While,
        Keyword::Do,
        Keyword::Break,
        Keyword::Continue,
    ];

    /// Conditions and counts that must follow.
    pub const fn arguments(self) -> std::ops::RangeInclusive<usize> {
        match self {
            Keyword::If | Keyword::ElseIf | Keyword::While | Keyword::Repeat => 1..=1,
            Keyword::Call => 0..=30,
            Keyword::Return | Keyword::EndSub => 0..=1,
            _ => 0..=0,
        }
    }
}

/// One O word.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct OWord {
    /// Which.
    pub label: Label,
    /// What it does.
    pub keyword: Keyword,
    /// Into the arguments of the arena.
    pub args: Slice,
    /// Bytes of the text.
    pub place: (u32, u32),
}
