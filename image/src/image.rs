//! The image: a compiled program as inert data. The compiler makes it, `encode` stores it, the runtime loads it.

use crate::memory::MemoryMap;
use crate::natives::NativeImport;
use crate::types::{TypeId, TypeTable};
use takt_base::Nanos;

/// A compiled program of one resource.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Image {
    /// Resource or project name.
    pub name: String,
    /// What the code runs on.
    pub target: Target,
    /// All types that symbols and blocks use.
    pub types: TypeTable,
    /// Sizes of the memory's parts.
    pub memory: MemoryMap,
    /// Initial contents; everything else is zero. Offsets into the memory, ascending, not overlapping.
    pub init: Vec<Chunk>,
    /// Named variables: globals, located variables, program instances and access paths. With several resources the name of what
    /// belongs to one begins with the name of that.
    pub symbols: Vec<Symbol>,
    /// What the code calls in its host; the index is the `import` of a native call.
    pub natives: Vec<NativeImport>,
    /// Functions, ascending by `start`, covering `code`.
    pub functions: Vec<Function>,
    /// Position-independent machine code.
    pub code: Vec<u8>,
    /// Instructions that trap, ascending by offset.
    pub traps: Vec<TrapSite>,
    /// Where each source line begins in the code, ascending by offset.
    pub lines: Vec<LineSite>,
    /// Names of source files.
    pub files: Vec<String>,
    /// Tasks, in declaration order.
    pub tasks: Vec<Task>,
    /// Variables that keep their values over a restart.
    pub retained: Vec<Retained>,
    /// Files that the program needs: project file, part programs. Name and contents.
    pub attachments: Vec<(String, Vec<u8>)>,
}

/// What machine the code is for.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Target {
    /// No code: for the interpreter alone.
    #[default]
    None,
    /// x86-64 with SSE4.2 and POPCNT (x86-64-v2), System V calls.
    X86_64V2,
}

/// Bytes at an offset.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Chunk {
    /// Into the memory.
    pub offset: u32,
    /// Contents.
    pub bytes: Vec<u8>,
}

/// A named variable.
#[derive(Clone, PartialEq, Debug)]
pub struct Symbol {
    /// Name as declared; `main` for a program instance.
    pub name: String,
    /// Type.
    pub ty: TypeId,
    /// Where.
    pub place: Place,
    /// Declared CONSTANT.
    pub constant: bool,
    /// Declared RETAIN.
    pub retain: bool,
    /// An access path, and what it allows; `None` for the variable itself.
    pub access: Option<Access>,
}

/// What a path of VAR_ACCESS allows (IEC 61131-3 §6.8.2).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Access {
    /// Reading alone.
    ReadOnly,
    /// Writing too.
    ReadWrite,
}

/// A variable, or a part of one, that keeps its value over a restart.
#[derive(Clone, PartialEq, Debug)]
pub struct Retained {
    /// Instance path.
    pub path: String,
    /// Type: scalars, strings, and arrays and records of those.
    pub ty: TypeId,
    /// Where.
    pub place: Place,
    /// Over a cold start too (PERSISTENT).
    pub persistent: bool,
}

/// Where a symbol lies.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Place {
    /// Offset into the memory.
    Byte(u32),
    /// A bit of the process image: offset of the byte, and bit 0..7. The type is BOOL.
    Bit(u32, u8),
}

impl Place {
    /// A BOOL. `None` if it does not lie inside the memory.
    pub fn bool(self, memory: &[u8]) -> Option<bool> {
        match self {
            Place::Byte(offset) => memory.get(offset as usize).map(|&b| b != 0),
            Place::Bit(offset, bit) => memory.get(offset as usize).map(|&b| b >> (bit & 7) & 1 == 1),
        }
    }
}

/// Compiled code of one unit. Called as `extern "sysv64" fn(memory: *mut u8, frame: u32, args...)`; an entry of a task has one
/// argument, the offset of the program instance (u32).
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Function {
    /// Name of the unit as the user declared it: shown as the POU of a fault.
    pub pou: String,
    /// First byte in `code`.
    pub start: u32,
    /// Bytes of code.
    pub size: u32,
}

/// An instruction that traps.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct TrapSite {
    /// Into `code`.
    pub offset: u32,
    /// Number of a [`crate::Trap`].
    pub trap: u8,
}

/// From here on the code belongs to this line.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct LineSite {
    /// Into `code`.
    pub offset: u32,
    /// Into `files`.
    pub file: u32,
    /// From 1.
    pub line: u32,
}

/// A task (IEC 61131-3 §6.8.2).
#[derive(Clone, PartialEq, Debug)]
pub struct Task {
    /// Name.
    pub name: String,
    /// 0 is the highest.
    pub priority: u32,
    /// Period; `None` with no trigger means: in the background, rescheduled when finished.
    pub interval: Option<Nanos>,
    /// SINGLE: runs at a rising edge of this BOOL.
    pub trigger: Option<Place>,
    /// Programs in declaration order, then the function blocks that have this task.
    pub programs: Vec<Program>,
}

/// A program instance of a task, or a function block with a task of its own.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Program {
    /// Instance name.
    pub name: String,
    /// Index into `functions`.
    pub function: u32,
    /// Offset of the instance.
    pub instance: u32,
}

impl Image {
    /// File and line of a code offset.
    pub fn line_at(&self, offset: u32) -> Option<LineSite> {
        let i = self.lines.partition_point(|l| l.offset <= offset).checked_sub(1)?;
        Some(self.lines[i])
    }
    /// The symbol of this name; case does not matter.
    pub fn symbol(&self, name: &str) -> Option<&Symbol> {
        self.symbols.iter().find(|s| s.name.eq_ignore_ascii_case(name))
    }
}
