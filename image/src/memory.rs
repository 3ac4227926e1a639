//! The one memory of a resource: a flat run of bytes, the same for native code, interpreter, monitor, snapshot and replay.
//!
//! ```text
//! 0        HEADER   inputs  outputs  markers  data (globals, instances)  frames (locals that have an address)  size
//! ```
//! Every address in a program is a 32-bit offset from the start, so a memory can be copied, compared and stored, and a program
//! can't name a byte outside of it. The header holds what a running task needs and is not part of a snapshot.

/// Byte offsets of the header's fields. All little-endian.
pub mod header {
    /// i64: time sample of this activation in nanoseconds; every timer of the activation sees the same.
    pub const NOW: u32 = 0;
    /// u64: lowest native stack address that generated code may use.
    pub const STACK_LIMIT: u32 = 8;
    /// u64: address of the native entry, see [`crate::natives`].
    pub const NATIVE_ENTRY: u32 = 16;
    /// u64: opaque word for the native entry.
    pub const HOST: u32 = 24;
    /// u32: end of the frame area; a call whose frame would pass it traps with `StackOverflow`.
    pub const FRAME_LIMIT: u32 = 32;
    /// u8: cleared by a native that met an error; a call with ENO sets it before and reads it after.
    pub const ENO: u32 = 36;
    /// Bytes of the header.
    pub const SIZE: u32 = 64;
}

/// Where the parts of the memory lie. Each begins where the one before ends, rounded up to 8.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct MemoryMap {
    /// %I.
    pub inputs: Area,
    /// %Q.
    pub outputs: Area,
    /// %M.
    pub markers: Area,
    /// Globals and program instances.
    pub data: Area,
    /// Frames of functions: locals that have an address.
    pub frames: Area,
}

/// A part of the memory.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Area {
    /// First byte.
    pub start: u32,
    /// Bytes.
    pub size: u32,
}

impl Area {
    /// One past the last byte.
    pub const fn end(self) -> u32 {
        self.start + self.size
    }
    /// As an index range.
    pub const fn range(self) -> std::ops::Range<usize> {
        self.start as usize..self.end() as usize
    }
}

impl MemoryMap {
    /// Lays out areas of the given sizes in bytes; `None` if they pass [`MAX_MEMORY`].
    pub fn new(inputs: u32, outputs: u32, markers: u32, data: u32, frames: u32) -> Option<Self> {
        let mut next = header::SIZE;
        let mut area = |size: u32| -> Option<Area> {
            let start = next;
            next = start.checked_add(size)?.checked_next_multiple_of(8)?;
            (next <= MAX_MEMORY).then_some(Area { start, size: next - start })
        };
        Some(Self {
            inputs: area(inputs)?,
            outputs: area(outputs)?,
            markers: area(markers)?,
            data: area(data)?,
            frames: area(frames)?,
        })
    }
    /// Bytes in all.
    pub const fn size(&self) -> u32 {
        self.frames.end()
    }
}

/// Largest memory of a resource in bytes.
pub const MAX_MEMORY: u32 = 1 << 30;
/// Bytes for frames.
pub const FRAME_BYTES: u32 = 1 << 20;
