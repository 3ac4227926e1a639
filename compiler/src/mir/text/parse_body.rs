//! Text to module: blocks, instructions, ends.

use super::lex::Token;
use super::parse::{Parsed, Parser};
use crate::mir::model::*;
use crate::mir::ops::{BINARY, COMPARE, CONVERT, UNARY, by_mnemonic};
use takt_base::index::IndexVec;
use takt_image::Trap;

/// What a line of a block says.
enum Item {
    Op(Op),
    End(End),
}

impl Parser {
    /// Blocks up to the `}` of the function.
    pub(super) fn blocks(&mut self) -> Parsed<IndexVec<BlockId, Block>> {
        let mut blocks = IndexVec::new();
        let mut line = LineId(0);
        while !self.accept('}') {
            let block = self.block()?;
            if block.0 as usize != blocks.len() {
                return self.fail(format!("b{} stands where b{} should", block.0, blocks.len()));
            }
            self.sign(':')?;
            let block = self.block_body(&mut line)?;
            blocks.push(block);
        }
        Ok(blocks)
    }

    fn block_body(&mut self, line: &mut LineId) -> Parsed<Block> {
        let mut insts = Vec::new();
        loop {
            let item = self.item()?;
            if self.accept('@') {
                *line = LineId(self.u32()?);
            }
            if matches!(self.peek(), Token::Word(_)) && self.line() == self.line_before() {
                return self.fail("an instruction ends with its line");
            }
            match item {
                Item::Op(op) => insts.push(Inst { op, line: *line }),
                Item::End(end) => return Ok(Block { insts, end, end_line: *line }),
            }
        }
    }

    /// `v12`, `b3`: a letter and a number.
    fn numbered(&mut self, letter: char, what: &str) -> Parsed<u32> {
        self.number(|t| t.strip_prefix(letter)?.parse().ok(), what)
    }

    pub(super) fn local(&mut self) -> Parsed<Local> {
        self.numbered('v', "a local").map(Local)
    }

    fn block(&mut self) -> Parsed<BlockId> {
        self.numbered('b', "a block").map(BlockId)
    }

    /// `, v1`
    fn next_local(&mut self) -> Parsed<Local> {
        self.sign(',')?;
        self.local()
    }

    fn next_block(&mut self) -> Parsed<BlockId> {
        self.sign(',')?;
        self.block()
    }

    fn next_u32(&mut self) -> Parsed<u32> {
        self.sign(',')?;
        self.u32()
    }

    fn next_addr(&mut self) -> Parsed<Addr> {
        self.sign(',')?;
        self.addr()
    }

    fn addr(&mut self) -> Parsed<Addr> {
        self.sign('[')?;
        let base = if matches!(self.peek(), Token::Number(_)) {
            AddrBase::Static
        } else if self.accept_word("frame") {
            AddrBase::Frame
        } else {
            AddrBase::Local(self.local()?)
        };
        let offset = if base == AddrBase::Static || self.accept('+') { self.u32()? } else { 0 };
        self.sign(']')?;
        Ok(Addr { base, offset })
    }

    fn trap_name(&mut self) -> Parsed<Trap> {
        let name = self.word()?;
        match Trap::ALL.iter().find(|t| t.name() == name) {
            Some(&trap) => Ok(trap),
            None => self.fail(format!("`{name}` is no trap")),
        }
    }

    fn item(&mut self) -> Parsed<Item> {
        let is_local = |w: &str| w.strip_prefix('v').is_some_and(|n| n.parse::<u32>().is_ok());
        if matches!(self.peek(), Token::Word(w) if is_local(w)) {
            let dst = self.local()?;
            self.sign('=')?;
            return self.value(dst).map(Item::Op);
        }
        let word = self.word()?;
        if let Some(end) = self.end(&word)? {
            return Ok(Item::End(end));
        }
        self.effect(&word).map(Item::Op)
    }

    /// Operations without a result.
    fn effect(&mut self, word: &str) -> Parsed<Op> {
        Ok(match word {
            "store" => Op::Store(self.addr()?, self.next_local()?),
            "copy_bytes" => Op::CopyBytes { to: self.addr()?, from: self.next_addr()?, size: self.next_u32()? },
            "fill_bytes" => {
                let (to, size, value) = (self.addr()?, self.next_u32()?, self.next_u32()?);
                let Ok(value) = u8::try_from(value) else { return self.fail("the value is no byte") };
                Op::FillBytes { to, size, value }
            }
            "copy_string" => Op::CopyString {
                to: self.addr()?,
                to_capacity: self.next_u32()?,
                from: self.next_addr()?,
                from_capacity: self.next_u32()?,
                unit: self.next_u32()?,
            },
            "trap_if" => Op::TrapIf(self.trap_name()?, self.next_local()?),
            "call" => self.call(None)?,
            "native" => self.call_native(None)?,
            other => return self.fail(format!("`{other}` is no instruction")),
        })
    }

    /// Operations with a result.
    fn value(&mut self, dst: Local) -> Parsed<Op> {
        let word = self.word()?;
        if let Some(op) = by_mnemonic(UNARY, &word) {
            return Ok(Op::Unary(op, dst, self.local()?));
        }
        if let Some(op) = by_mnemonic(BINARY, &word) {
            return Ok(Op::Binary(op, dst, self.local()?, self.next_local()?));
        }
        if let Some(op) = by_mnemonic(COMPARE, &word) {
            return Ok(Op::Compare(op, dst, self.local()?, self.next_local()?));
        }
        if let Some(op) = by_mnemonic(CONVERT, &word) {
            return Ok(Op::Convert(op, dst, self.local()?));
        }
        self.other_value(&word, dst)
    }

    fn other_value(&mut self, word: &str, dst: Local) -> Parsed<Op> {
        Ok(match word {
            "int" => Op::Int(dst, self.integer()?),
            "float" => Op::Float(dst, self.number(float, "a float")?),
            "copy" => Op::Copy(dst, self.local()?),
            "load" => Op::Load(dst, self.addr()?),
            "address" => Op::Address(dst, self.addr()?),
            "select" => Op::Select { dst, condition: self.local()?, then: self.next_local()?, otherwise: self.next_local()? },
            "compare_string" => Op::CompareString {
                dst,
                a: self.addr()?,
                a_capacity: self.next_u32()?,
                b: self.next_addr()?,
                b_capacity: self.next_u32()?,
                unit: self.next_u32()?,
            },
            "call" => self.call(Some(dst))?,
            "native" => self.call_native(Some(dst))?,
            other => return self.fail(format!("`{other}` is no operation")),
        })
    }

    fn integer(&mut self) -> Parsed<i64> {
        self.number(|t| t.parse().ok(), "an integer")
    }

    fn call(&mut self, dst: Option<Local>) -> Parsed<Op> {
        let name = self.name()?;
        let Some(&function) = self.functions.get(&name) else { return self.fail(format!("function `{name}` is not there")) };
        Ok(Op::Call { dst, function, args: self.list(Self::local)? })
    }

    fn call_native(&mut self, dst: Option<Local>) -> Parsed<Op> {
        let name = self.name()?;
        let Some(&native) = self.natives.get(&name) else { return self.fail(format!("native `{name}` is not declared above")) };
        let args = self.list(|p| Ok(NativeArg { signed: p.accept_word("signed"), local: p.local()? }))?;
        Ok(Op::CallNative { dst, native, args })
    }

    fn end(&mut self, word: &str) -> Parsed<Option<End>> {
        Ok(Some(match word {
            "jump" => End::Jump(self.block()?),
            "branch" => End::Branch { condition: self.local()?, then: self.next_block()?, otherwise: self.next_block()? },
            "switch" => self.switch()?,
            "return" if self.line() == self.line_before() && matches!(self.peek(), Token::Word(_)) => {
                End::Return(Some(self.local()?))
            }
            "return" => End::Return(None),
            "trap" => End::Trap(self.trap_name()?),
            _ => return Ok(None),
        }))
    }

    fn switch(&mut self) -> Parsed<End> {
        let value = self.local()?;
        let mut cases = Vec::new();
        self.sign(',')?;
        while !self.accept_word("else") {
            let case = self.integer()?;
            self.sign(':')?;
            cases.push((case, self.block()?));
            self.sign(',')?;
        }
        Ok(End::Switch { value, cases, otherwise: self.block()? })
    }
}

/// Bits of an F64 from a decimal number, `inf`, `-inf` or hexadecimal bits.
fn float(text: &str) -> Option<u64> {
    match text.strip_prefix("0x") {
        Some(hex) => u64::from_str_radix(hex, 16).ok(),
        None => text.parse::<f64>().ok().filter(|v| !v.is_nan()).map(f64::to_bits),
    }
}
