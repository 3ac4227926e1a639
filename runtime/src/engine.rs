//! The engine of native code: what `takt_image::Engine` promises, on machine code mapped from an image.
//! Runs: `new` in the background, `run` cyclic.

use crate::fault::{self, Call, Stop};
use crate::load::{self, Bound, CodeMap, LoadError};
use takt_base::Nanos;
use takt_image::image::{Function, LineSite, TrapSite};
use takt_image::{Engine, Fault, Image, MemoryMap, Natives, Trap, header};

/// Runs an image's machine code.
pub struct NativeEngine {
    code: CodeMap,
    imports: Vec<Bound>,
    functions: Vec<Function>,
    traps: Vec<TrapSite>,
    lines: Vec<LineSite>,
    memory: MemoryMap,
}

impl NativeEngine {
    /// Checks the image, maps its code and binds its imports. The thread that calls is made fit to run it; another thread calls
    /// [`crate::prepare_thread`] first, or does so at its first activation.
    pub fn new(image: &Image, natives: &mut dyn Natives) -> Result<Self, LoadError> {
        takt_image::validate::validate(image)?;
        load::check_target(image.target)?;
        fault::prepare()?;
        Ok(Self {
            imports: load::bind(image, natives)?,
            code: CodeMap::new(&image.code)?,
            functions: image.functions.clone(),
            traps: image.traps.clone(),
            lines: image.lines.clone(),
            memory: image.memory,
        })
    }

    /// Bytes of machine code.
    pub fn code_bytes(&self) -> usize {
        let (start, end) = self.code.bounds();
        (end - start) as usize
    }

    /// What the program reads from the header of the memory.
    fn write_header(&self, memory: &mut [u8], now: Nanos, stack: fault::Stack) {
        put(memory, header::NOW, &now.0.to_le_bytes());
        put(memory, header::STACK_LIMIT, &stack.limit.to_le_bytes());
        put(memory, header::NATIVE_ENTRY, &fault::native_entry().to_le_bytes());
        put(memory, header::HOST, &0u64.to_le_bytes());
        put(memory, header::FRAME_LIMIT, &self.memory.frames.end().to_le_bytes());
    }

    fn trap(&self, stop: &Stop, stack: fault::Stack) -> Trap {
        if stop.signal == libc::SIGRTMIN() {
            return Trap::Watchdog;
        }
        let site = self.traps.binary_search_by_key(&stop.offset, |t| t.offset).ok();
        match site.and_then(|i| Trap::from_number(self.traps[i].trap)) {
            // A native failed, and the code raised what stands for all of them: the native said what it really was.
            Some(Trap::NativePanic) => {
                u8::try_from(stop.native_trap).ok().and_then(Trap::from_number).unwrap_or(Trap::NativePanic)
            }
            Some(trap) => trap,
            None => unlisted(stop, stack),
        }
    }

    /// Function and line of a code offset. The head of a function has no line of its own: it gets the first one.
    fn locate(&self, offset: u32, trap: Trap) -> Fault {
        let unknown = Fault { trap, function: u32::MAX, file: u32::MAX, line: 0 };
        let Some(index) = self.functions.partition_point(|f| f.start <= offset).checked_sub(1) else { return unknown };
        let f = &self.functions[index];
        let end = f.start + f.size;
        if offset >= end {
            return unknown;
        }
        let next = self.lines.partition_point(|l| l.offset <= offset);
        let before = next.checked_sub(1).map(|i| self.lines[i]).filter(|l| l.offset >= f.start);
        let line = before.or_else(|| self.lines.get(next).copied().filter(|l| l.offset < end));
        let known = Fault { function: index as u32, ..unknown };
        line.map_or(known, |l| Fault { file: l.file, line: l.line, ..known })
    }
}

/// A fault at an instruction that is not in the table of traps.
fn unlisted(stop: &Stop, stack: fault::Stack) -> Trap {
    match stop.signal {
        libc::SIGFPE => Trap::DivisionByZero,
        libc::SIGSEGV if stack.overflowed(stop.address) => Trap::StackOverflow,
        _ => Trap::Memory,
    }
}

fn put(memory: &mut [u8], offset: u32, bytes: &[u8]) {
    let at = offset as usize;
    memory[at..at + bytes.len()].copy_from_slice(bytes);
}

impl Engine for NativeEngine {
    /// A function, a memory or a thread that does not fit is a [`Trap::Memory`] without a place.
    fn run(
        &mut self,
        function: u32,
        instance: u32,
        now: Nanos,
        budget: Nanos,
        memory: &mut [u8],
        natives: &mut dyn Natives,
    ) -> Result<(), Fault> {
        let misuse = Fault { trap: Trap::Memory, function: u32::MAX, file: u32::MAX, line: 0 };
        let f = self.functions.get(function as usize).filter(|f| f.size > 0).ok_or(misuse)?;
        let stack = fault::prepare().map_err(|_| misuse)?;
        if memory.len() != self.memory.size() as usize {
            return Err(misuse);
        }
        let frame = self.memory.frames.start;
        let call = Call { code: &self.code, start: f.start, frame, instance, imports: &self.imports, now, budget };
        self.write_header(memory, now, stack);
        fault::activate(&call, memory, natives).map_err(|stop| self.locate(stop.offset, self.trap(&stop, stack)))
    }
}
