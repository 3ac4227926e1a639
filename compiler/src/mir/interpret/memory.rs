//! Memory accesses of the interpreter: every one is checked, and outside of the memory is `Trap::Memory`.

use takt_image::Trap;

/// `size` bytes at an address, as an index range.
fn range(memory: &[u8], at: u64, size: u64) -> Result<std::ops::Range<usize>, Trap> {
    let end = at.checked_add(size).filter(|&end| end <= memory.len() as u64).ok_or(Trap::Memory)?;
    Ok(at as usize..end as usize)
}

/// Reads 1 to 8 bytes, little-endian.
pub(super) fn load(memory: &[u8], at: u64, size: u32) -> Result<u64, Trap> {
    let bytes = &memory[range(memory, at, u64::from(size))?];
    let mut value = [0; 8];
    value[..bytes.len()].copy_from_slice(bytes);
    Ok(u64::from_le_bytes(value))
}

/// Writes the low 1 to 8 bytes, little-endian.
pub(super) fn store(memory: &mut [u8], at: u64, size: u32, value: u64) -> Result<(), Trap> {
    let range = range(memory, at, u64::from(size))?;
    let bytes = &mut memory[range];
    bytes.copy_from_slice(&value.to_le_bytes()[..bytes.len()]);
    Ok(())
}

/// Copies; the ranges may overlap.
pub(super) fn copy(memory: &mut [u8], to: u64, from: u64, size: u32) -> Result<(), Trap> {
    let (to, from) = (range(memory, to, u64::from(size))?, range(memory, from, u64::from(size))?);
    memory.copy_within(from, to.start);
    Ok(())
}

/// Fills.
pub(super) fn fill(memory: &mut [u8], to: u64, size: u32, value: u8) -> Result<(), Trap> {
    let range = range(memory, to, u64::from(size))?;
    memory[range].fill(value);
    Ok(())
}

/// A string in memory: where, its capacity in units, bytes of a unit.
#[derive(Clone, Copy)]
pub(super) struct Text {
    pub at: u64,
    pub capacity: u32,
    pub unit: u32,
}

impl Text {
    /// Unit `i`; 0 behind the end.
    fn unit(self, memory: &[u8], i: u32) -> Result<u64, Trap> {
        if i < self.capacity { load(memory, self.place(i), self.unit) } else { Ok(0) }
    }
    fn place(self, i: u32) -> u64 {
        self.at + u64::from(i) * u64::from(self.unit)
    }
}

/// Copies up to the first zero unit or the smaller capacity, then writes a zero unit.
pub(super) fn copy_string(memory: &mut [u8], to: Text, from: Text) -> Result<(), Trap> {
    for i in 0..to.capacity {
        let unit = from.unit(memory, i)?;
        store(memory, to.place(i), to.unit, unit)?;
        if unit == 0 {
            return Ok(());
        }
    }
    store(memory, to.place(to.capacity), to.unit, 0)
}

/// Order of two strings as -1, 0, 1.
pub(super) fn compare_strings(memory: &[u8], a: Text, b: Text) -> Result<i8, Trap> {
    for i in 0..=a.capacity.max(b.capacity) {
        let (x, y) = (a.unit(memory, i)?, b.unit(memory, i)?);
        if x != y || x == 0 {
            return Ok(x.cmp(&y) as i8);
        }
    }
    Ok(0)
}
