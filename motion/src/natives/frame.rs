//! The memory of a block instance during a call: pins by number, at offsets that were fixed when the block was bound.
//! Runs: cyclic. Every access is checked against the memory; what lies outside reads as 0 and is not written.

use super::Bound;

/// One call.
pub struct Frame<'a> {
    memory: &'a mut [u8],
    instance: u32,
    bound: &'a Bound,
}

impl<'a> Frame<'a> {
    /// The instance at `instance` of a block bound as `bound`; `None` if it does not lie in the memory.
    pub fn new(memory: &'a mut [u8], instance: u32, bound: &'a Bound) -> Option<Self> {
        let end = (instance as usize).checked_add(bound.size as usize)?;
        (end <= memory.len()).then_some(Self { memory, instance, bound })
    }

    fn at(&self, pin: impl Into<usize>) -> u32 {
        self.bound.offsets.get(pin.into()).map_or(u32::MAX, |o| self.instance.saturating_add(*o))
    }

    fn read<const N: usize>(&self, at: u32) -> [u8; N] {
        let at = at as usize;
        self.memory.get(at..at.saturating_add(N)).and_then(|b| b.try_into().ok()).unwrap_or([0; N])
    }

    fn write<const N: usize>(&mut self, at: u32, bytes: [u8; N]) {
        let at = at as usize;
        if let Some(to) = self.memory.get_mut(at..at.saturating_add(N)) {
            to.copy_from_slice(&bytes);
        }
    }

    /// Offset of the instance: its identity.
    pub fn instance(&self) -> u32 {
        self.instance
    }
    /// BOOL
    pub fn bool(&self, pin: impl Into<usize>) -> bool {
        self.read::<1>(self.at(pin)) != [0]
    }
    /// BOOL
    pub fn set_bool(&mut self, pin: impl Into<usize>, value: bool) {
        self.write(self.at(pin), [u8::from(value)]);
    }
    /// LREAL
    pub fn lreal(&self, pin: impl Into<usize>) -> f64 {
        f64::from_le_bytes(self.read(self.at(pin)))
    }
    /// LREAL
    pub fn set_lreal(&mut self, pin: impl Into<usize>, value: f64) {
        self.write(self.at(pin), value.to_le_bytes());
    }
    /// Element of an ARRAY OF LREAL, from 0.
    pub fn set_lreal_at(&mut self, pin: impl Into<usize>, i: u32, value: f64) {
        self.write(self.at(pin).saturating_add(8 * i), value.to_le_bytes());
    }
    /// Element of an ARRAY OF LREAL, from 0.
    pub fn lreal_at(&self, pin: impl Into<usize>, i: u32) -> f64 {
        f64::from_le_bytes(self.read(self.at(pin).saturating_add(8 * i)))
    }
    /// Element of an ARRAY OF BOOL, from 0.
    pub fn bool_at(&self, pin: impl Into<usize>, i: u32) -> bool {
        self.read::<1>(self.at(pin).saturating_add(i)) != [0]
    }
    /// Element of an ARRAY OF BOOL, from 0.
    pub fn set_bool_at(&mut self, pin: impl Into<usize>, i: u32, value: bool) {
        self.write(self.at(pin).saturating_add(i), [u8::from(value)]);
    }
    /// TIME
    pub fn set_i64(&mut self, pin: impl Into<usize>, value: i64) {
        self.write(self.at(pin), value.to_le_bytes());
    }
    /// UINT, WORD
    pub fn u16(&self, pin: impl Into<usize>) -> u16 {
        u16::from_le_bytes(self.read(self.at(pin)))
    }
    /// UINT, WORD
    pub fn set_u16(&mut self, pin: impl Into<usize>, value: u16) {
        self.write(self.at(pin), value.to_le_bytes());
    }
    /// Element of an ARRAY OF UINT, from 0.
    pub fn set_u16_at(&mut self, pin: impl Into<usize>, i: u32, value: u16) {
        self.write(self.at(pin).saturating_add(2 * i), value.to_le_bytes());
    }
    /// INT, enumeration
    pub fn i16(&self, pin: impl Into<usize>) -> i16 {
        i16::from_le_bytes(self.read(self.at(pin)))
    }
    /// INT, enumeration
    pub fn set_i16(&mut self, pin: impl Into<usize>, value: i16) {
        self.write(self.at(pin), value.to_le_bytes());
    }
    /// UDINT
    pub fn u32(&self, pin: impl Into<usize>) -> u32 {
        u32::from_le_bytes(self.read(self.at(pin)))
    }
    /// UDINT
    pub fn set_u32(&mut self, pin: impl Into<usize>, value: u32) {
        self.write(self.at(pin), value.to_le_bytes());
    }
    /// USINT
    pub fn set_u8(&mut self, pin: impl Into<usize>, value: u8) {
        self.write(self.at(pin), [value]);
    }
    /// STRING: the bytes before the zero, at most `capacity`.
    pub fn string(&self, pin: impl Into<usize>, capacity: usize) -> &[u8] {
        let at = self.at(pin) as usize;
        let bytes = self.memory.get(at..at.saturating_add(capacity)).unwrap_or(&[]);
        bytes.split(|&b| b == 0).next().unwrap_or(&[])
    }
    /// STRING: at most `capacity` bytes, which need no zero at the end.
    pub fn set_string(&mut self, pin: impl Into<usize>, capacity: usize, value: &[u8]) {
        let at = self.at(pin) as usize;
        let Some(to) = self.memory.get_mut(at..at.saturating_add(capacity + 1)) else { return };
        let n = value.iter().position(|&b| b == 0).unwrap_or(value.len()).min(capacity);
        to.fill(0);
        to[..n].copy_from_slice(&value[..n]);
    }
    /// Number in the AXIS_REF or CNC_REF that a VAR_IN_OUT pin refers to; 0 if it refers to nothing.
    pub fn reference(&self, pin: impl Into<usize>) -> u16 {
        match self.u32(pin) {
            0 => 0,
            place => u16::from_le_bytes(self.read(place.saturating_add(self.bound.number_offset))),
        }
    }
    /// Sets a member of the structure of a pin; `i` counts the members of [`crate::machine::declarations::CNC_STATUS`].
    pub fn set_member<const N: usize>(&mut self, pin: impl Into<usize>, i: usize, bytes: [u8; N]) {
        self.set_member_at(pin, i, 0, bytes);
    }
    /// The same at some bytes behind the start of the member: an element of an array.
    pub fn set_member_at<const N: usize>(&mut self, pin: impl Into<usize>, i: usize, behind: u32, bytes: [u8; N]) {
        if let Some(offset) = self.bound.members.get(i) {
            self.write(self.at(pin).saturating_add(*offset).saturating_add(behind), bytes);
        }
    }
}
