//! The grammar of one block: `[/] [N number] (word | comment)*`, blanks anywhere, letters of either case (R1-33..R1-39).
//!
//! A grammar without recursion: time is linear in the length of the block, which has no limit. Expressions in brackets, parameters
//! and O words are refused (N0014).

use super::number;
use super::word::{self, Action};
use nom::branch::alt;
use nom::bytes::complete::take_while;
use nom::character::complete::{anychar, char};
use nom::combinator::{map, opt, rest};
use nom::error::{ErrorKind, ParseError};
use nom::{IResult, Parser};
use takt_base::{Code, Diag, SourceId, Span};

/// One block as written.
#[derive(Clone, PartialEq, Debug)]
pub struct Block {
    /// All of it.
    pub span: Span,
    /// Source line, from 1.
    pub line: u32,
    /// Starts with `/` (R1-39).
    pub deleted: bool,
    /// N word.
    pub n: Option<u32>,
    /// The other words, in order.
    pub words: Vec<Word>,
    /// Comments in parentheses, in order. Those behind `;` are dropped, as LinuxCNC does.
    pub comments: Vec<Comment>,
}

/// A letter and its number.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Word {
    /// Upper case.
    pub letter: char,
    /// As written.
    pub value: f64,
    /// Letter and number.
    pub span: Span,
}

/// A comment in parentheses (R1-38).
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Comment {
    /// Logged.
    Plain(String),
    /// `(MSG, text)`: shown to the operator. The text is all that follows the comma.
    Message(String),
}

impl Word {
    /// What a G or M word asks for; `None` for other letters and unknown codes.
    pub fn action(&self) -> Option<Action> {
        match self.letter {
            'G' => word::g(self.tenths()?),
            'M' => word::m(self.whole()?),
            _ => None,
        }
    }
    /// The value in tenths, if it is a whole number of them.
    pub fn tenths(&self) -> Option<u32> {
        whole(self.value * 10.0)
    }
    /// The value, if it is a whole number that is not negative.
    pub fn whole(&self) -> Option<u32> {
        whole(self.value)
    }
}

/// Whole to within the rounding of decimal numbers.
fn whole(value: f64) -> Option<u32> {
    let near = value.round();
    ((value - near).abs() < 1e-6 && (0.0..=f64::from(u32::MAX)).contains(&near)).then_some(near as u32)
}

/// Reads one block. `text` stands at byte `start` of the file `source`, in line `line`.
///
/// # Errors
/// The first thing that is no word and no comment.
pub fn read(source: SourceId, start: usize, line: u32, text: &str) -> Result<Block, Diag> {
    let place = |from: usize, to: usize| Span::new(source, start + text.len() - from, start + text.len() - to);
    let mut block = Block { span: place(text.len(), 0), line, deleted: false, n: None, words: Vec::new(), comments: Vec::new() };
    fill(&mut block, text, &place).map_err(|fault| fault.diag(text, &place))?;
    Ok(block)
}

fn fill(block: &mut Block, text: &str, place: &impl Fn(usize, usize) -> Span) -> Result<(), Fault> {
    let (mut input, deleted) = parse(delete_mark, text)?;
    block.deleted = deleted;
    while !input.is_empty() {
        let (after, item) = parse(item, input)?;
        match item {
            Item::Word('N', value) => {
                let first = block.words.is_empty() && block.n.is_none();
                block.n = Some(block_number(value, first).ok_or_else(|| Fault::block_number(input, after, first))?);
            }
            Item::Word(letter, value) => block.words.push(Word { letter, value, span: place(input.len(), after.len()) }),
            Item::Comment(text) => block.comments.push(comment(text)),
            Item::Nothing => {}
        }
        input = parse(blanks, after)?.0;
    }
    Ok(())
}

fn block_number(value: f64, first: bool) -> Option<u32> {
    whole(value).filter(|_| first)
}

enum Item<'a> {
    Word(char, f64),
    Comment(&'a str),
    Nothing,
}

fn delete_mark(input: &str) -> IResult<&str, bool, Fault> {
    map((blanks, opt(char('/')), blanks), |(_, mark, _)| mark.is_some()).parse(input)
}

fn blanks(input: &str) -> IResult<&str, &str, Fault> {
    take_while(|c| c == ' ' || c == '\t').parse(input)
}

fn item(input: &str) -> IResult<&str, Item<'_>, Fault> {
    alt((parenthesised, line_comment, word, refuse)).parse(input)
}

/// `( text )`: no nesting, ends on its line.
fn parenthesised(input: &str) -> IResult<&str, Item<'_>, Fault> {
    let (inside, _) = char('(').parse(input)?;
    let (after, text) = take_while(|c| c != ')' && c != '(').parse(inside)?;
    match after.strip_prefix(')') {
        Some(after) => Ok((after, Item::Comment(text))),
        None => Err(nom::Err::Failure(Fault::open_comment(input, after))),
    }
}

/// `; text` up to the end of the line.
fn line_comment(input: &str) -> IResult<&str, Item<'_>, Fault> {
    map((char(';'), rest), |_| Item::Nothing).parse(input)
}

fn word(input: &str) -> IResult<&str, Item<'_>, Fault> {
    let (after, letter) = anychar(input)?;
    if !letter.is_ascii_alphabetic() {
        return Err(nom::Err::Error(Fault::from_error_kind(input, ErrorKind::Alpha)));
    }
    let (number, _) = blanks(after)?;
    let letter = letter.to_ascii_uppercase();
    match number::scan(number) {
        _ if letter == 'O' => Err(nom::Err::Failure(Fault::not_supported(input, after, "O words call subprograms and loops"))),
        Some((value, length)) => Ok((&number[length..], Item::Word(letter, value))),
        None => Err(nom::Err::Failure(no_number(input, number))),
    }
}

fn refuse(input: &str) -> IResult<&str, Item<'_>, Fault> {
    let (after, c) = anychar(input)?;
    Err(nom::Err::Failure(match c {
        '#' => Fault::not_supported(input, after, PARAMETER),
        '[' | ']' => Fault::not_supported(input, after, EXPRESSION),
        _ => Fault::bad_character(input, after),
    }))
}

fn comment(text: &str) -> Comment {
    let is_message = |head: &str| head.trim_matches([' ', '\t']).eq_ignore_ascii_case("msg");
    match text.split_once(',') {
        Some((head, message)) if is_message(head) => Comment::Message(message.to_owned()),
        _ => Comment::Plain(text.to_owned()),
    }
}

fn parse<'a, T>(mut parser: impl Parser<&'a str, Output = T, Error = Fault>, input: &'a str) -> Result<(&'a str, T), Fault> {
    parser.parse(input).map_err(|e| match e {
        nom::Err::Error(fault) | nom::Err::Failure(fault) => fault,
        nom::Err::Incomplete(_) => Fault::bad_character(input, input),
    })
}

const PARAMETER: &str = "a numbered or named parameter";
const EXPRESSION: &str = "an expression in brackets";

/// Why a text is no block: a rule and the bytes that were left before and behind the place.
#[derive(Debug)]
struct Fault {
    code: Code,
    from: usize,
    to: usize,
    label: &'static str,
    help: &'static str,
}

impl ParseError<&str> for Fault {
    fn from_error_kind(input: &str, _: ErrorKind) -> Self {
        Fault::bad_character(input, input)
    }
    fn append(_: &str, _: ErrorKind, other: Self) -> Self {
        other
    }
}

fn no_number(word: &str, number: &str) -> Fault {
    match number.chars().next() {
        Some('#') => Fault::not_supported(word, number, PARAMETER),
        Some('[') => Fault::not_supported(word, number, EXPRESSION),
        Some(c) if c.is_ascii_digit() || matches!(c, '+' | '-' | '.') => {
            let end = number.len() - number.find(|c: char| !matches!(c, '0'..='9' | '+' | '-' | '.')).unwrap_or(number.len());
            let help = "write a sign, digits and one point, such as -12.5; up to 1000000000000";
            Fault { code: Code::BadWord, from: word.len(), to: end, label: "not a number", help }
        }
        _ => {
            let help = "write a number behind the letter, such as X12.5";
            Fault { code: Code::BadWord, from: word.len(), to: number.len(), label: "a letter without a number", help }
        }
    }
}

impl Fault {
    fn bad_character(from: &str, to: &str) -> Self {
        let help = "a block consists of words such as G1 and X12.5 and of comments in parentheses";
        Fault { code: Code::BadCharacter, from: from.len(), to: to.len(), label: "neither a word nor a comment", help }
    }
    fn not_supported(from: &str, to: &str, label: &'static str) -> Self {
        let help = "write plain numbers and repeat the blocks; the CAM system can expand them";
        Fault { code: Code::NotInThisVersion, from: from.len(), to: to.len(), label, help }
    }
    fn open_comment(from: &str, at: &str) -> Self {
        let help = if at.starts_with('(') { "comments can't be nested" } else { "close the comment with `)` on the same line" };
        Fault { code: Code::CommentNotClosed, from: from.len(), to: at.len(), label: "the comment starts here", help }
    }
    fn block_number(from: &str, to: &str, first: bool) -> Self {
        let (label, help) = if first {
            ("not a whole number", "write N and digits, up to N4294967295")
        } else {
            ("the block number stands behind other words", "put the N word first; a block has one")
        };
        Fault { code: Code::BadWord, from: from.len(), to: to.len(), label, help }
    }
    fn diag(self, text: &str, place: &impl Fn(usize, usize) -> Span) -> Diag {
        let to = if self.to < self.from { self.to } else { self.from.saturating_sub(1) };
        debug_assert!(self.from <= text.len());
        Diag::new(self.code, place(self.from, to), self.label).help(self.help)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Words as `X1 Y2`, or code and bytes of the fault.
    fn shown(text: &str) -> String {
        match read(SourceId(0), 0, 1, text) {
            Ok(block) => {
                let n = block.n.map(|n| format!("N{n}"));
                let words = block.words.iter().map(|w| format!("{}{}", w.letter, w.value));
                n.into_iter().chain(words).collect::<Vec<_>>().join(" ")
            }
            Err(diag) => format!("{} {}..{}", diag.code.text(), diag.span.start, diag.span.end),
        }
    }

    #[test]
    fn blocks() {
        let cases = [
            ("N1G0X20Y30Z0", "N1 G0 X20 Y30 Z0"),
            (" / n 1 g 0 1 x - 1 2 . 5", "N1 G1 X-12.5"),
            ("(a)G1(b ; c)X2;Y3", "G1 X2"),
            ("X1E2", "X1 E2"),
            ("", ""),
            ("G1 X", "N0002 3..4"),
            ("G1 X Y2", "N0002 3..5"),
            ("X1.2.3", "N0001 4..5"),
            ("X--1 Y2", "N0002 0..4"),
            ("X[1+2]", "N0014 0..1"),
            ("#1=2", "N0014 0..1"),
            ("o100 sub", "N0014 0..1"),
            ("G1 X1 ä", "N0001 6..8"),
            ("G1 (a (b)) X1", "N0011 3..6"),
            ("G1 (a", "N0011 3..5"),
            ("G1 X1 )", "N0001 6..7"),
            ("G1 N2", "N0002 3..5"),
            ("N1 N2", "N0002 3..5"),
            ("N1.5", "N0002 0..4"),
            ("N-1", "N0002 0..3"),
        ];
        for (text, want) in cases {
            assert_eq!(shown(text), want, "{text}");
        }
    }

    #[test]
    fn comments_and_messages() {
        let block = read(SourceId(0), 0, 1, "(one) ( msg , two, 2) (MSG three)").unwrap();
        let want = [Comment::Plain("one".into()), Comment::Message(" two, 2".into()), Comment::Plain("MSG three".into())];
        assert_eq!(block.comments, want);
    }

    #[test]
    fn long_blocks_are_read() {
        let text = format!("G1{}X1({})", " ".repeat(10_000), "c".repeat(10_000));
        assert_eq!(shown(&text), "G1 X1");
    }
}
