//! Variables of the PLC program as part programs use them: `#<_plc_NAME>`.
//! Runs: cyclic; [`symbols`] finds them in the background. A variable is read and written between two scans, as a number.

pub mod symbols;

pub use symbols::{PlcError, Symbols};

use takt_image::Elementary as E;
use takt_image::image::Place;

/// Variables that one row of a part program may read.
pub const READS: usize = 16;

/// A variable with a place in the memory of the PLC program.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Variable {
    /// Where.
    pub place: Place,
    /// BOOL, an integer, a bit string, REAL or LREAL.
    pub ty: E,
    /// Smallest value.
    pub low: f64,
    /// Largest value.
    pub high: f64,
    /// A part program may set it.
    pub writable: bool,
}

impl Variable {
    /// Its value; 0 if it lies outside of the memory.
    pub fn read(&self, memory: &[u8]) -> f64 {
        let offset = match self.place {
            Place::Bit(..) => return f64::from(u8::from(self.place.bool(memory).unwrap_or(false))),
            Place::Byte(offset) => offset as usize,
        };
        let size = self.ty.bytes() as usize;
        let mut word = [0; 8];
        let Some(bytes) = memory.get(offset..offset.saturating_add(size)) else { return 0.0 };
        word[..size].copy_from_slice(bytes);
        let raw = u64::from_le_bytes(word);
        let unused = 64 - 8 * size as u32;
        match self.ty {
            E::Bool => f64::from(u8::from(raw != 0)),
            E::Real => f64::from(f32::from_bits(raw as u32)),
            E::Lreal => f64::from_bits(raw),
            E::Sint | E::Int | E::Dint | E::Lint => ((raw << unused) as i64 >> unused) as f64,
            _ => raw as f64,
        }
    }

    /// Sets it. `value` must fit: see [`Variable::fits`].
    pub fn write(&self, memory: &mut [u8], value: f64) {
        match self.place {
            Place::Bit(offset, bit) => {
                if let Some(byte) = memory.get_mut(offset as usize) {
                    let mask = 1 << (bit & 7);
                    *byte = if value != 0.0 { *byte | mask } else { *byte & !mask };
                }
            }
            Place::Byte(offset) => self.write_bytes(memory, offset as usize, value),
        }
    }

    fn write_bytes(&self, memory: &mut [u8], offset: usize, value: f64) {
        let raw = match self.ty {
            E::Bool => u64::from(value != 0.0),
            E::Real => u64::from((value as f32).to_bits()),
            E::Lreal => value.to_bits(),
            E::Sint | E::Int | E::Dint | E::Lint => value.round() as i64 as u64,
            _ => value.round() as u64,
        };
        let size = self.ty.bytes() as usize;
        if let Some(to) = memory.get_mut(offset..offset.saturating_add(size)) {
            to.copy_from_slice(&raw.to_le_bytes()[..size]);
        }
    }

    /// True if the variable can hold the value: an integer takes whole numbers (to within 0.0001) in its range, a BOOL 0 and 1.
    pub fn fits(&self, value: f64) -> bool {
        let whole = matches!(self.ty, E::Real | E::Lreal) || (value - value.round()).abs() <= 1e-4;
        whole && (self.low - 1e-4..=self.high + 1e-4).contains(&value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn variable(place: Place, ty: E) -> Variable {
        let (low, high) = symbols::range(ty).expect("a number");
        Variable { place, ty, low, high, writable: true }
    }

    #[test]
    fn what_is_written_reads_back() {
        let mut memory = [0xAA; 32];
        for (ty, values) in [
            (E::Bool, &[0.0, 1.0][..]),
            (E::Sint, &[-128.0, 127.0]),
            (E::Uint, &[0.0, 65535.0]),
            (E::Dint, &[-2147483648.0, 7.0]),
            (E::Lint, &[-9007199254740992.0, 3.0]),
            (E::Lword, &[9007199254740992.0, 0.0]),
            (E::Real, &[0.5, -1e20f32 as f64]),
            (E::Lreal, &[0.1, -1e300]),
        ] {
            let v = variable(Place::Byte(8), ty);
            for &value in values {
                assert!(v.fits(value), "{ty:?} {value}");
                v.write(&mut memory, value);
                assert_eq!(v.read(&memory), value, "{ty:?}");
            }
            assert!(memory[..8].iter().chain(&memory[16..]).all(|&b| b == 0xAA), "{ty:?}");
        }
        let bit = variable(Place::Bit(3, 5), E::Bool);
        bit.write(&mut memory, 0.0);
        assert_eq!((memory[3], bit.read(&memory)), (0x8A, 0.0));
        bit.write(&mut memory, 1.0);
        assert_eq!((memory[3], bit.read(&memory)), (0xAA, 1.0));
    }

    #[test]
    fn what_does_not_fit_and_what_lies_outside() {
        let int = variable(Place::Byte(0), E::Int);
        assert!(!int.fits(32768.0) && !int.fits(0.5) && int.fits(2.00005) && !int.fits(f64::NAN));
        assert!(!variable(Place::Byte(0), E::Bool).fits(2.0));
        assert!(!variable(Place::Byte(0), E::Real).fits(1e39));
        let far = variable(Place::Byte(u32::MAX), E::Lreal);
        let mut memory = [0; 8];
        far.write(&mut memory, 1.0);
        assert_eq!((far.read(&memory), memory), (0.0, [0; 8]));
    }
}
