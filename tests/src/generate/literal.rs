//! Literals of every type, in upper case.

use super::Generator;
use takt_image::Elementary as E;

const REALS: &[&str] = &["0.0", "1.5", "-2.25", "1.0E10", "-3.5E-3", "1000000.5", "0.1", "1.0E-30", "7.0"];
const DATES: &[&str] = &["1970-01-01", "2024-02-29", "1999-12-31", "1969-07-20"];
const CLOCKS: &[&str] = &["00:00:00", "23:59:59.999", "12:30:15.5", "07:05:03.250"];
const CHARS: &[&str] = &["A", "Z", "0", "$$", "$N", " "];
const TEXTS: &[&str] = &["", "A", "ABC", "HELLO WORLD", "12", "-7", "BC", "$'X$$", "1.5E2", "TRUE"];

impl Generator {
    pub(super) fn literal(&mut self, ty: E) -> String {
        let small = self.random.below(20) as i64;
        let name = ty.name();
        let (date, clock) = (self.random.pick(DATES), self.random.pick(CLOCKS));
        match ty {
            E::Bool => if self.one_in(2) { "TRUE" } else { "FALSE" }.into(),
            E::Real | E::Lreal => format!("{name}#{}", self.random.pick(REALS)),
            E::Time | E::Ltime => self.duration(name, small),
            E::Date => format!("D#{date}"),
            E::Tod | E::Ltod => format!("{name}#{clock}"),
            E::Ldate => format!("LDATE#{date}"),
            E::Dt | E::Ldt => format!("{name}#{date}-{clock}"),
            E::Char => format!("CHAR#'{}'", self.random.pick(CHARS)),
            E::Wchar => format!("WCHAR#\"{}\"", self.random.pick(CHARS)),
            _ if ty.is_bit() => format!("{name}#16#{:X}", self.random.bits() >> (64 - ty.bits())),
            _ => self.int_literal(ty, small),
        }
    }

    fn duration(&mut self, name: &str, small: i64) -> String {
        match self.random.below(4) {
            0 => format!("{name}#{small}NS"),
            1 => format!("{name}#-{small}S{small}MS"),
            2 => format!("{name}#{small}D1H2M"),
            _ => format!("{name}#{small}MS"),
        }
    }

    fn int_literal(&mut self, ty: E, small: i64) -> String {
        let (low, high) = ty.int_range().unwrap_or((0, 1));
        let value = match self.random.below(8) {
            0 => low,
            1 => high,
            2 => (self.random.bits() as i128).rem_euclid(high - low + 1) + low,
            3 if low < 0 => -(small as i128),
            _ => small as i128,
        };
        format!("{}#{value}", ty.name())
    }

    pub(super) fn text_literal(&mut self, wide: bool) -> String {
        let text = self.random.pick(TEXTS);
        if wide { format!("\"{}\"", text.replace("$'", "$\"")) } else { format!("'{text}'") }
    }
}
