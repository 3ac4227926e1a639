//! Module to text.

use crate::mir::model::*;
use crate::mir::ops::{BINARY, COMPARE, CONVERT, SCALARS, UNARY, mnemonic};
use std::fmt::{self, Write};
use takt_base::index::Index;
use takt_image::{NativeImport, NativeKind, Scalar};

/// The text of a module.
pub fn print(module: &Module) -> String {
    let mut out = String::new();
    for file in &module.files {
        let _ = writeln!(out, "file {}", Quoted(file));
    }
    for line in module.lines.iter() {
        let _ = writeln!(out, "line {}:{}", line.file, line.line);
    }
    for native in module.natives.iter() {
        let _ = print_native(&mut out, native);
    }
    for id in module.functions.indices() {
        if !out.is_empty() {
            out.push('\n');
        }
        out.push_str(&print_function(module, id));
    }
    out
}

/// The text of one function.
pub fn print_function(module: &Module, id: FuncId) -> String {
    let mut printer = Printer { out: String::new(), module, line: LineId(0) };
    let _ = printer.function(&module.functions[id]);
    printer.out
}

fn print_native(out: &mut String, native: &NativeImport) -> fmt::Result {
    write!(out, "native {} ", Name(&native.name))?;
    match &native.kind {
        NativeKind::Block { ty } => write!(out, "block {}", ty.0)?,
        NativeKind::Function { params, result } => {
            write!(out, "({})", List(params.iter().map(|&p| scalar(p))))?;
            print_result(out, *result)?;
        }
    }
    writeln!(out)
}

fn print_result(out: &mut String, result: Option<Scalar>) -> fmt::Result {
    result.map_or(Ok(()), |ty| write!(out, " -> {}", scalar(ty)))
}

fn scalar(ty: Scalar) -> &'static str {
    mnemonic(SCALARS, &ty)
}

/// A name, in quotes if it is no identifier. `func` has them too: the parser finds functions by this word.
struct Name<'a>(&'a str);

impl fmt::Display for Name<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut chars = self.0.chars();
        let identifier = chars.next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_')
            && chars.all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '.');
        if identifier && self.0 != "func" { f.write_str(self.0) } else { Quoted(self.0).fmt(f) }
    }
}

/// Text in quotes; quotes, backslashes and line ends are escaped.
struct Quoted<'a>(&'a str);

impl fmt::Display for Quoted<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_char('"')?;
        for c in self.0.chars() {
            match c {
                '"' | '\\' => write!(f, "\\{c}")?,
                '\n' => f.write_str("\\n")?,
                '\r' => f.write_str("\\r")?,
                c => f.write_char(c)?,
            }
        }
        f.write_char('"')
    }
}

/// Items with commas.
struct List<I>(I);

impl<I: Iterator<Item: fmt::Display> + Clone> fmt::Display for List<I> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, item) in self.0.clone().enumerate() {
            write!(f, "{}{item}", if i == 0 { "" } else { ", " })?;
        }
        Ok(())
    }
}

/// A local.
struct V(Local);

impl fmt::Display for V {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "v{}", self.0.0)
    }
}

/// An address in brackets.
struct At(Addr);

impl fmt::Display for At {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.0.base, self.0.offset) {
            (AddrBase::Static, offset) => write!(f, "[{offset}]"),
            (AddrBase::Frame, offset) => write!(f, "[frame + {offset}]"),
            (AddrBase::Local(base), 0) => write!(f, "[{}]", V(base)),
            (AddrBase::Local(base), offset) => write!(f, "[{} + {offset}]", V(base)),
        }
    }
}

/// An F64: shortest decimal that reads back, or its bits if it is a NaN.
struct Number(u64);

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = f64::from_bits(self.0);
        if value.is_nan() { write!(f, "{:#x}", self.0) } else { write!(f, "{value:?}") }
    }
}

struct Printer<'a> {
    out: String,
    module: &'a Module,
    line: LineId,
}

impl Printer<'_> {
    fn function(&mut self, f: &Function) -> fmt::Result {
        write!(self.out, "func {}", Name(&f.name))?;
        if f.pou != f.name {
            write!(self.out, " pou {}", Name(&f.pou))?;
        }
        if f.frame != 0 {
            write!(self.out, " frame {}", f.frame)?;
        }
        let params = f.params.iter().map(|&p| format!("{}: {}", V(p), scalar(f.locals[p])));
        write!(self.out, " ({})", List(params))?;
        print_result(&mut self.out, f.result)?;
        writeln!(self.out, " {{")?;
        self.locals(f)?;
        for (id, block) in f.blocks.enumerate() {
            writeln!(self.out, "b{}:", id.0)?;
            self.block(block)?;
        }
        writeln!(self.out, "}}")
    }

    fn locals(&mut self, f: &Function) -> fmt::Result {
        let mut declared = vec![false; f.locals.len()];
        f.params.iter().for_each(|p| declared[p.index()] = true);
        for &(name, ty) in SCALARS {
            let mut locals = f.locals.enumerate().filter(|&(l, &t)| t == ty && !declared[l.index()]).peekable();
            if locals.peek().is_some() {
                write!(self.out, "  {name}:")?;
                locals.try_for_each(|(l, _)| write!(self.out, " {}", V(l)))?;
                writeln!(self.out)?;
            }
        }
        Ok(())
    }

    fn block(&mut self, block: &Block) -> fmt::Result {
        for inst in &block.insts {
            self.out.push_str("  ");
            self.op(&inst.op)?;
            self.line(inst.line)?;
        }
        self.out.push_str("  ");
        self.end(&block.end)?;
        self.line(block.end_line)
    }

    /// Ends a text line, with the source line if it is another one.
    fn line(&mut self, line: LineId) -> fmt::Result {
        if line != self.line {
            write!(self.out, " @{}", line.0)?;
            self.line = line;
        }
        writeln!(self.out)
    }

    fn op(&mut self, op: &Op) -> fmt::Result {
        let module = self.module;
        let out = &mut self.out;
        match *op {
            Op::Int(dst, value) => write!(out, "{} = int {value}", V(dst)),
            Op::Float(dst, bits) => write!(out, "{} = float {}", V(dst), Number(bits)),
            Op::Copy(dst, src) => write!(out, "{} = copy {}", V(dst), V(src)),
            Op::Unary(op, dst, a) => write!(out, "{} = {} {}", V(dst), mnemonic(UNARY, &op), V(a)),
            Op::Binary(op, dst, a, b) => write!(out, "{} = {} {}, {}", V(dst), mnemonic(BINARY, &op), V(a), V(b)),
            Op::Compare(op, dst, a, b) => write!(out, "{} = {} {}, {}", V(dst), mnemonic(COMPARE, &op), V(a), V(b)),
            Op::Convert(op, dst, src) => write!(out, "{} = {} {}", V(dst), mnemonic(CONVERT, &op), V(src)),
            Op::Select { dst, condition, then, otherwise } => {
                write!(out, "{} = select {}, {}, {}", V(dst), V(condition), V(then), V(otherwise))
            }
            Op::Load(dst, addr) => write!(out, "{} = load {}", V(dst), At(addr)),
            Op::Store(addr, src) => write!(out, "store {}, {}", At(addr), V(src)),
            Op::Address(dst, addr) => write!(out, "{} = address {}", V(dst), At(addr)),
            Op::CopyBytes { to, from, size } => write!(out, "copy_bytes {}, {}, {size}", At(to), At(from)),
            Op::FillBytes { to, size, value } => write!(out, "fill_bytes {}, {size}, {value}", At(to)),
            Op::CopyString { to, to_capacity, from, from_capacity, unit } => {
                write!(out, "copy_string {}, {to_capacity}, {}, {from_capacity}, {unit}", At(to), At(from))
            }
            Op::CompareString { dst, a, a_capacity, b, b_capacity, unit } => {
                write!(out, "{} = compare_string {}, {a_capacity}, {}, {b_capacity}, {unit}", V(dst), At(a), At(b))
            }
            Op::Call { dst, function, ref args } => {
                let name = module.functions.get(function).map_or("?", |f| &f.name);
                print_dst(out, dst)?;
                write!(out, "call {}({})", Name(name), List(args.iter().map(|&a| V(a))))
            }
            Op::CallNative { dst, native, ref args } => {
                let name = module.natives.get(native).map_or("?", |n| &n.name);
                print_dst(out, dst)?;
                write!(out, "native {}({})", Name(name), List(args.iter().copied().map(native_arg)))
            }
            Op::TrapIf(trap, condition) => write!(out, "trap_if {}, {}", trap.name(), V(condition)),
        }
    }

    fn end(&mut self, end: &End) -> fmt::Result {
        let out = &mut self.out;
        match *end {
            End::Jump(to) => write!(out, "jump b{}", to.0),
            End::Branch { condition, then, otherwise } => {
                write!(out, "branch {}, b{}, b{}", V(condition), then.0, otherwise.0)
            }
            End::Switch { value, ref cases, otherwise } => {
                write!(out, "switch {}, ", V(value))?;
                cases.iter().try_for_each(|(value, to)| write!(out, "{value}: b{}, ", to.0))?;
                write!(out, "else b{}", otherwise.0)
            }
            End::Return(None) => write!(out, "return"),
            End::Return(Some(value)) => write!(out, "return {}", V(value)),
            End::Trap(trap) => write!(out, "trap {}", trap.name()),
        }
    }
}

fn print_dst(out: &mut String, dst: Option<Local>) -> fmt::Result {
    dst.map_or(Ok(()), |dst| write!(out, "{} = ", V(dst)))
}

fn native_arg(arg: NativeArg) -> String {
    format!("{}{}", if arg.signed { "signed " } else { "" }, V(arg.local))
}
