//! Puts compiled functions into one blob: patches calls, collects traps and lines.

use super::Code;
use crate::mir::model::{FuncId, LineId, Module};
use cranelift_codegen::binemit::Reloc;
use cranelift_codegen::ir::{ExternalName, TrapCode, UserExternalNameRef};
use cranelift_codegen::{Final, FinalizedMachReloc, FinalizedRelocTarget, MachBufferFinalized, ir};
use takt_base::index::Index;
use takt_image::Trap;
use takt_image::image::{Function, LineSite, TrapSite};

/// Functions begin at multiples of this.
const ALIGNMENT: usize = 16;
/// `int3` between functions.
const PADDING: u8 = 0xcc;

/// A call to be patched.
struct Call {
    /// Where the distance stands: 4 bytes, into the function.
    offset: u32,
    callee: FuncId,
}

/// One function, before it has a place.
pub(super) struct Compiled {
    id: FuncId,
    bytes: Vec<u8>,
    calls: Vec<Call>,
    /// Offset into the function and trap number.
    traps: Vec<(u32, u8)>,
    /// Offset into the function and line.
    lines: Vec<(u32, LineId)>,
    /// Offset of the trap of the prologue's stack check, which stands behind the function and has no line.
    stack_check: Option<u32>,
}

impl Compiled {
    pub(super) fn new(id: FuncId, buffer: &MachBufferFinalized<Final>, func: &ir::Function) -> Result<Self, String> {
        let calls = buffer.relocs().iter().map(|r| call(r, func)).collect::<Result<_, _>>()?;
        let traps = buffer.traps().iter().map(|t| (t.offset, trap_number(t.code))).collect();
        let spans = buffer.get_srclocs_sorted().iter().filter(|s| !s.loc.is_default());
        let lines = spans.map(|s| (s.start, LineId(s.loc.bits().wrapping_sub(1)))).collect();
        let stack_check = buffer.traps().iter().find(|t| t.code == TrapCode::STACK_OVERFLOW).map(|t| t.offset);
        Ok(Self { id, bytes: buffer.data().to_vec(), calls, traps, lines, stack_check })
    }
}

fn call(reloc: &FinalizedMachReloc, func: &ir::Function) -> Result<Call, String> {
    match (&reloc.target, reloc.kind, reloc.addend) {
        (FinalizedRelocTarget::ExternalName(ExternalName::User(name)), Reloc::X86CallPCRel4, -4) => {
            Ok(Call { offset: reloc.offset, callee: callee(*name, func) })
        }
        _ => Err(format!("needs something from outside: {:?} {:?}", reloc.kind, reloc.target)),
    }
}

fn callee(name: UserExternalNameRef, func: &ir::Function) -> FuncId {
    FuncId(func.params.user_named_funcs()[name].index)
}

fn trap_number(code: TrapCode) -> u8 {
    let trap = match code {
        TrapCode::INTEGER_DIVISION_BY_ZERO | TrapCode::INTEGER_OVERFLOW => Trap::DivisionByZero,
        TrapCode::STACK_OVERFLOW => Trap::StackOverflow,
        other => Trap::from_number(other.as_raw().get()).unwrap_or(Trap::Memory),
    };
    trap as u8
}

impl Compiled {
    /// Lines, with the first one of the unit for the stack check.
    fn lines_with_stack_check(&self, first: Option<LineId>) -> Vec<(u32, LineId)> {
        let mut lines: Vec<_> = self.stack_check.zip(first).into_iter().chain(self.lines.iter().copied()).collect();
        lines.sort_by_key(|&(offset, _)| offset);
        lines
    }
}

/// Collects functions in the order of their ids.
pub(super) struct Linker<'m> {
    module: &'m Module,
    out: Code,
    /// Offset of the distance in the blob, and whom it calls.
    calls: Vec<(usize, FuncId)>,
}

impl<'m> Linker<'m> {
    pub(super) fn new(module: &'m Module) -> Self {
        Self { module, out: Code::default(), calls: Vec::new() }
    }

    pub(super) fn add(&mut self, compiled: Compiled) {
        let start = self.out.code.len();
        let base = start as u32;
        self.out.code.extend_from_slice(&compiled.bytes);
        self.out.code.resize(self.out.code.len().next_multiple_of(ALIGNMENT), PADDING);
        let size = (self.out.code.len() - start) as u32;
        let f = &self.module.functions[compiled.id];
        self.out.functions.push(Function { pou: f.pou.clone(), start: base, size });
        self.out.traps.extend(compiled.traps.iter().map(|&(offset, trap)| TrapSite { offset: base + offset, trap }));
        self.calls.extend(compiled.calls.iter().map(|c| (start + c.offset as usize, c.callee)));
        self.lines(base, f.first_line(), &compiled.lines_with_stack_check(f.first_line()));
    }

    /// Lines of a function. The prologue belongs to the first one.
    fn lines(&mut self, base: u32, first: Option<LineId>, lines: &[(u32, LineId)]) {
        let known = self.out.lines.len();
        for (offset, line) in first.map(|l| (0, l)).into_iter().chain(lines.iter().copied()) {
            let Some(line) = self.module.lines.get(line) else { continue };
            let site = LineSite { offset: base + offset, file: line.file, line: line.line };
            match self.out.lines.get_mut(known..).and_then(|l| l.last_mut()) {
                Some(last) if (last.file, last.line) == (site.file, site.line) => (),
                Some(last) if last.offset == site.offset => *last = site,
                _ => self.out.lines.push(site),
            }
        }
    }

    pub(super) fn finish(mut self) -> Result<Code, String> {
        u32::try_from(self.out.code.len()).ok().filter(|&n| n <= i32::MAX as u32).ok_or("more than 2 GiB of code")?;
        for &(at, callee) in &self.calls {
            let target = self.out.functions.get(callee.index()).ok_or("a call of a function that is not there")?.start;
            let distance = i64::from(target) - (at as i64 + 4);
            let place = self.out.code.get_mut(at..at + 4).ok_or("a call outside of the code")?;
            place.copy_from_slice(&(distance as i32).to_le_bytes());
        }
        Ok(self.out)
    }
}
