//! The safe state of outputs: zero, or configured bytes.
//!
//! Runs: cyclic. When the resource stops, all outputs go there. When a task stops alone, those outputs go there whose last change was
//! this task's, bit by bit: what other tasks drive is left to them. To know that, the outputs are compared after each activation.

use crate::load::LoadError;

/// Nobody changed the bit yet.
const NOBODY: u16 = u16::MAX;

/// Safe values, and who changed which output bit last.
pub struct SafeOutputs {
    safe: Vec<u8>,
    before: Vec<u8>,
    owners: Vec<[u16; 8]>,
}

impl SafeOutputs {
    /// For an output area of `size` bytes that begins as `outputs`; `safe` may be shorter, the rest is zero.
    pub fn new(outputs: &[u8], safe: &[u8]) -> Result<Self, LoadError> {
        if safe.len() > outputs.len() {
            let what = format!("{} bytes of safe outputs, but the program has {}", safe.len(), outputs.len());
            return Err(LoadError::Option(what));
        }
        let mut padded = safe.to_vec();
        padded.resize(outputs.len(), 0);
        Ok(Self { safe: padded, before: outputs.to_vec(), owners: vec![[NOBODY; 8]; outputs.len()] })
    }

    /// Notes what an activation of `task` changed.
    pub fn note(&mut self, task: usize, outputs: &[u8]) {
        if self.before == outputs {
            return;
        }
        for ((before, now), owners) in self.before.iter_mut().zip(outputs).zip(&mut self.owners) {
            let changed = *before ^ now;
            for (bit, owner) in owners.iter_mut().enumerate() {
                if changed >> bit & 1 == 1 {
                    *owner = task as u16;
                }
            }
            *before = *now;
        }
    }

    /// Brings the outputs of one task to their safe state.
    pub fn release(&mut self, task: usize, outputs: &mut [u8]) {
        for ((out, safe), owners) in outputs.iter_mut().zip(&self.safe).zip(&self.owners) {
            let mask = owners.iter().enumerate().fold(0, |m, (bit, &o)| m | u8::from(o == task as u16) << bit);
            *out = *out & !mask | safe & mask;
        }
        self.before.copy_from_slice(outputs);
    }

    /// Brings all outputs to their safe state.
    pub fn release_all(&mut self, outputs: &mut [u8]) {
        outputs.copy_from_slice(&self.safe);
        self.before.copy_from_slice(outputs);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_bit_belongs_to_who_changed_it_last() {
        let mut s = SafeOutputs::new(&[0b1000, 0, 0], &[0b0001]).unwrap();
        let mut outputs = [0b1011, 0xFF, 0];
        s.note(1, &outputs);
        outputs[1] = 0x0F;
        s.note(2, &outputs);
        s.release(1, &mut outputs);
        // Bit 3 was nobody's; task 1 gave up bits 0 and 1 and the low half of byte 1.
        assert_eq!(outputs, [0b1001, 0, 0]);
        s.release_all(&mut outputs);
        assert_eq!(outputs, [1, 0, 0]);
        assert!(SafeOutputs::new(&[0], &[0, 0]).is_err());
    }
}
