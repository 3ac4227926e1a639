//! Memory from the system: pages of code, and the memory of a resource inside a reserve that no 32-bit offset can leave.
#![allow(unsafe_code)] // Mapping pages has no safe interface.

use super::LoadError;
use std::ops::{Deref, DerefMut};
use takt_image::{Image, ImageError};

/// Reserve of address space for a memory: every 32-bit offset and the widest access behind it stay inside, so that a wild offset is
/// a fault of the program and never a write into the controller.
const RESERVE: usize = (1 << 32) + (1 << 16);

/// Pages owned by this value.
struct Pages {
    base: *mut u8,
    size: usize,
}

// SAFETY: the pages belong to this value alone, like those of a `Box`.
unsafe impl Send for Pages {}
// SAFETY: shared access reads only.
unsafe impl Sync for Pages {}

impl Pages {
    /// Maps `size` bytes of zeros with a protection.
    fn map(size: usize, protection: i32) -> Result<Self, LoadError> {
        let flags = libc::MAP_PRIVATE | libc::MAP_ANONYMOUS | libc::MAP_NORESERVE;
        // SAFETY: a fresh anonymous mapping touches nothing that exists.
        let base = unsafe { libc::mmap(std::ptr::null_mut(), size, protection, flags, -1, 0) };
        if base == libc::MAP_FAILED { Err(LoadError::last("mapping memory")) } else { Ok(Self { base: base.cast(), size }) }
    }

    fn protect(&mut self, size: usize, protection: i32) -> Result<(), LoadError> {
        // SAFETY: the range lies inside the mapping, which nobody else uses yet.
        let status = unsafe { libc::mprotect(self.base.cast(), size, protection) };
        if status == 0 { Ok(()) } else { Err(LoadError::last("protecting memory")) }
    }
}

impl Drop for Pages {
    fn drop(&mut self) {
        // SAFETY: the mapping is ours, and nothing borrows it any more.
        unsafe { libc::munmap(self.base.cast(), self.size) };
    }
}

/// Machine code, readable and executable, never writable while it can run.
pub struct CodeMap {
    pages: Pages,
    size: usize,
}

impl CodeMap {
    /// Copies the code into pages of its own.
    pub fn new(code: &[u8]) -> Result<Self, LoadError> {
        let mut pages = Pages::map(code.len().max(1), libc::PROT_READ | libc::PROT_WRITE)?;
        // SAFETY: the mapping is writable and at least as long as the code.
        unsafe { std::ptr::copy_nonoverlapping(code.as_ptr(), pages.base, code.len()) };
        let size = pages.size;
        pages.protect(size, libc::PROT_READ | libc::PROT_EXEC)?;
        Ok(Self { pages, size: code.len() })
    }
    /// Address of a code offset, which must lie inside the code.
    pub fn address(&self, offset: u32) -> *const u8 {
        assert!((offset as usize) < self.size, "an entry outside of the code");
        self.pages.base.wrapping_add(offset as usize)
    }
    /// First address, and one past the last.
    pub fn bounds(&self) -> (u64, u64) {
        (self.pages.base as u64, self.pages.base as u64 + self.size as u64)
    }
}

/// The memory of a resource: zeroed, page-aligned, with its initial values applied.
pub struct Memory {
    pages: Pages,
    size: usize,
}

impl Memory {
    /// Allocates the memory of an image and writes the initial values.
    pub fn new(image: &Image) -> Result<Self, LoadError> {
        let size = image.memory.size() as usize;
        let access = libc::PROT_READ | libc::PROT_WRITE;
        // Where address space is limited, the plain memory must do.
        let mut pages = Pages::map(RESERVE, libc::PROT_NONE).or_else(|_| Pages::map(size.max(1), access))?;
        pages.protect(size, access)?;
        let mut memory = Self { pages, size };
        memory.init(image)?;
        Ok(memory)
    }

    /// Writes the initial values (cold start): everything else becomes zero.
    pub fn init(&mut self, image: &Image) -> Result<(), LoadError> {
        self.fill(0);
        for chunk in &image.init {
            let start = chunk.offset as usize;
            let place = start.checked_add(chunk.bytes.len()).and_then(|end| self.get_mut(start..end));
            let place = place.ok_or_else(|| ImageError { reason: format!("initial values at {start} are out of place") })?;
            place.copy_from_slice(&chunk.bytes);
        }
        Ok(())
    }
}

impl Deref for Memory {
    type Target = [u8];
    fn deref(&self) -> &[u8] {
        // SAFETY: `size` bytes at `base` are mapped readable for the life of `self`.
        unsafe { std::slice::from_raw_parts(self.pages.base, self.size) }
    }
}

impl DerefMut for Memory {
    fn deref_mut(&mut self) -> &mut [u8] {
        // SAFETY: as in `deref`, writable, and borrowed exclusively.
        unsafe { std::slice::from_raw_parts_mut(self.pages.base, self.size) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use takt_image::MemoryMap;
    use takt_image::image::Chunk;

    #[test]
    fn memory_is_zero_but_for_its_initial_values() {
        let map = MemoryMap::new(8, 8, 0, 100, 64).unwrap();
        let image = Image { memory: map, init: vec![Chunk { offset: 80, bytes: vec![1, 2] }], ..Image::default() };
        let mut m = Memory::new(&image).unwrap();
        assert_eq!((m.len(), m[79], m[80], m[81], m[82]), (map.size() as usize, 0, 1, 2, 0));
        m[90] = 7;
        m.init(&image).unwrap();
        assert_eq!(m[90], 0);
        let bad = Image { init: vec![Chunk { offset: map.size(), bytes: vec![1] }], ..image };
        assert!(matches!(Memory::new(&bad), Err(LoadError::Image(_))));
    }
}
