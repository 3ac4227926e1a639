//! Text to module: declarations. Function bodies are in [`super::parse_body`].

use super::lex::{Token, tokens};
use crate::mir::model::*;
use crate::mir::ops::{SCALARS, by_mnemonic};
use std::collections::HashMap;
use std::fmt;
use takt_base::index::Index;
use takt_image::{NativeImport, NativeKind, Scalar, TypeId};

/// Why a text is no module.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParseError {
    /// Line of the text, from 1.
    pub line: u32,
    /// What is wrong.
    pub text: String,
}

impl fmt::Display for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.text)
    }
}

/// The module of a text. It is not verified.
pub fn parse(text: &str) -> Result<Module, ParseError> {
    let tokens = tokens(text)?;
    let functions = function_names(&tokens);
    let mut parser = Parser { tokens, next: 0, functions, natives: HashMap::new(), module: Module::default() };
    while !parser.done() {
        parser.declaration()?;
    }
    Ok(parser.module)
}

/// Functions can be called before they are declared, so their names come first.
fn function_names(tokens: &[(Token, u32)]) -> HashMap<String, FuncId> {
    let mut names = HashMap::new();
    let mut count = 0;
    for pair in tokens.windows(2) {
        if let ((Token::Word(word), _), (Token::Word(name) | Token::Quoted(name), _)) = (&pair[0], &pair[1])
            && word == "func"
        {
            names.entry(name.clone()).or_insert(FuncId(count));
            count += 1;
        }
    }
    names
}

pub(super) struct Parser {
    tokens: Vec<(Token, u32)>,
    next: usize,
    pub(super) functions: HashMap<String, FuncId>,
    pub(super) natives: HashMap<String, NativeId>,
    module: Module,
}

pub(super) type Parsed<T> = Result<T, ParseError>;

impl Parser {
    pub(super) fn peek(&self) -> &Token {
        self.tokens.get(self.next).map_or(&Token::End, |t| &t.0)
    }

    fn done(&self) -> bool {
        *self.peek() == Token::End
    }

    /// Line of the next token.
    pub(super) fn line(&self) -> u32 {
        self.tokens.get(self.next).or(self.tokens.last()).map_or(0, |t| t.1)
    }

    /// Line of the token before.
    pub(super) fn line_before(&self) -> u32 {
        self.next.checked_sub(1).and_then(|i| self.tokens.get(i)).map_or(0, |t| t.1)
    }

    /// An error about what was read last.
    pub(super) fn fail<T>(&self, text: impl Into<String>) -> Parsed<T> {
        Err(ParseError { line: self.line_before(), text: text.into() })
    }

    /// An error about the next token.
    fn expected<T>(&self, what: &str) -> Parsed<T> {
        let found = match self.peek() {
            Token::Word(text) | Token::Number(text) => format!("`{text}`"),
            Token::Quoted(text) => format!("\"{text}\""),
            Token::Sign(c) => format!("`{c}`"),
            Token::End => "the end".into(),
        };
        Err(ParseError { line: self.line(), text: format!("expected {what}, found {found}") })
    }

    /// Takes a sign if it is next.
    pub(super) fn accept(&mut self, sign: char) -> bool {
        let found = *self.peek() == Token::Sign(sign);
        self.next += usize::from(found);
        found
    }

    pub(super) fn sign(&mut self, sign: char) -> Parsed<()> {
        if self.accept(sign) { Ok(()) } else { self.expected(&format!("`{sign}`")) }
    }

    /// Takes a word if it is next.
    pub(super) fn accept_word(&mut self, word: &str) -> bool {
        let found = matches!(self.peek(), Token::Word(w) if w == word);
        self.next += usize::from(found);
        found
    }

    pub(super) fn word(&mut self) -> Parsed<String> {
        let Token::Word(word) = self.peek() else { return self.expected("a word") };
        let word = word.clone();
        self.next += 1;
        Ok(word)
    }

    /// A name, with or without quotes.
    pub(super) fn name(&mut self) -> Parsed<String> {
        let (Token::Word(name) | Token::Quoted(name)) = self.peek() else { return self.expected("a name") };
        let name = name.clone();
        self.next += 1;
        Ok(name)
    }

    /// A number that `read` understands.
    pub(super) fn number<T>(&mut self, read: impl Fn(&str) -> Option<T>, what: &str) -> Parsed<T> {
        let (Token::Number(text) | Token::Word(text)) = self.peek() else { return self.expected(what) };
        let Some(value) = read(text) else { return self.expected(what) };
        self.next += 1;
        Ok(value)
    }

    pub(super) fn u32(&mut self) -> Parsed<u32> {
        self.number(|t| t.parse().ok(), "a number below 2^32")
    }

    /// Items with commas up to `)`; the `(` stands before.
    pub(super) fn list<T>(&mut self, mut item: impl FnMut(&mut Self) -> Parsed<T>) -> Parsed<Vec<T>> {
        let mut items = Vec::new();
        self.sign('(')?;
        while !self.accept(')') {
            if !items.is_empty() {
                self.sign(',')?;
            }
            items.push(item(self)?);
        }
        Ok(items)
    }

    pub(super) fn scalar(&mut self) -> Parsed<Scalar> {
        let Token::Word(word) = self.peek() else { return self.expected("a type") };
        let Some(ty) = by_mnemonic(SCALARS, word) else { return self.expected("a type") };
        self.next += 1;
        Ok(ty)
    }

    fn declaration(&mut self) -> Parsed<()> {
        match self.word()?.as_str() {
            "file" => self.file(),
            "line" => self.source_line(),
            "native" => self.native(),
            "func" => self.function(),
            other => self.fail(format!("`{other}` is none of file, line, native, func")),
        }
    }

    fn file(&mut self) -> Parsed<()> {
        let name = self.name()?;
        self.module.files.push(name);
        Ok(())
    }

    fn source_line(&mut self) -> Parsed<()> {
        let file = self.u32()?;
        self.sign(':')?;
        let line = self.u32()?;
        self.module.lines.push(Line { file, line });
        Ok(())
    }

    fn native(&mut self) -> Parsed<()> {
        let name = self.name()?;
        let kind = if self.accept_word("block") {
            NativeKind::Block { ty: TypeId(self.u32()?) }
        } else {
            NativeKind::Function { params: self.list(Self::scalar)?, result: self.result()? }
        };
        let id = self.module.natives.push(NativeImport { name: name.clone(), kind });
        self.natives.entry(name).or_insert(id);
        Ok(())
    }

    fn result(&mut self) -> Parsed<Option<Scalar>> {
        if self.accept('>') { self.scalar().map(Some) } else { Ok(None) }
    }

    fn function(&mut self) -> Parsed<()> {
        let name = self.name()?;
        let pou = if self.accept_word("pou") { self.name()? } else { name.clone() };
        let frame = if self.accept_word("frame") { self.u32()? } else { 0 };
        let mut types = Vec::new();
        let params = self.list(|p| p.param(&mut types))?;
        let result = self.result()?;
        self.sign('{')?;
        let locals = self.locals(types)?;
        let blocks = self.blocks()?;
        self.module.functions.push(Function { name, pou, params, result, locals, frame, blocks });
        Ok(())
    }

    fn param(&mut self, types: &mut Vec<Option<Scalar>>) -> Parsed<Local> {
        let local = self.local()?;
        self.sign(':')?;
        let ty = self.scalar()?;
        self.declare(types, local, ty)?;
        Ok(local)
    }

    fn declare(&self, types: &mut Vec<Option<Scalar>>, local: Local, ty: Scalar) -> Parsed<()> {
        let i = local.index();
        if i >= self.tokens.len() {
            return self.fail(format!("v{i} has too high a number"));
        }
        if i >= types.len() {
            types.resize(i + 1, None);
        }
        if types[i].replace(ty).is_some() {
            return self.fail(format!("v{i} is declared twice"));
        }
        Ok(())
    }

    /// Declarations such as `i32: v1 v2`, up to the first block.
    fn locals(&mut self, mut types: Vec<Option<Scalar>>) -> Parsed<takt_base::index::IndexVec<Local, Scalar>> {
        while matches!(self.peek(), Token::Word(w) if by_mnemonic(SCALARS, w).is_some()) {
            let ty = self.scalar()?;
            self.sign(':')?;
            while matches!(self.peek(), Token::Word(w) if w.starts_with('v')) {
                let local = self.local()?;
                self.declare(&mut types, local, ty)?;
            }
        }
        match types.iter().position(Option::is_none) {
            Some(i) => self.fail(format!("v{i} has no type")),
            None => Ok(types.into_iter().flatten().collect()),
        }
    }
}
