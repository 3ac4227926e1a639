//! What a value is as text reads back as the same value (library reference §2.3, §2.4), and no text makes a conversion panic.

mod common;

use common::{run, string};
use takt_image::{Elementary, NativeKind, Scalar, header};
use takt_stdlib::native_signature;

struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 ^ self.0 >> 29
    }
}

fn signature(name: &str) -> (Vec<Scalar>, Option<Scalar>) {
    match native_signature(name) {
        Some(NativeKind::Function { params, result }) => (params, result),
        other => panic!("{name}: {other:?}"),
    }
}

/// Value to text and back.
fn round_trip(ty: Elementary, slot: u64) -> (u64, String) {
    let mut memory = vec![0; header::SIZE as usize];
    let place = string(&mut memory, "", 1);
    let to = format!("{}_TO_STRING", ty.name());
    let (params, result) = signature(&to);
    run(&to, params, result, &[slot, place[0], place[1]], &mut memory).unwrap_or_else(|t| panic!("{to}: {t:?}"));
    let back = format!("STRING_TO_{}", ty.name());
    let (params, result) = signature(&back);
    let value = run(&back, params, result, &place, &mut memory).unwrap_or_else(|t| panic!("{back}: {t:?}"));
    let text = memory[place[0] as usize..].iter().take_while(|&&b| b != 0).map(|&b| char::from(b)).collect();
    (value, text)
}

/// A slot as the type has it: extended, in range, for dates whole.
fn legal(ty: Elementary, bits: u64) -> Option<u64> {
    use Elementary as E;
    let day = takt_stdlib::calendar::DAY_NS;
    match ty {
        E::Real => Some(f32::from_bits(bits as u32)).filter(|x| x.is_finite()).map(|x| x.to_bits().into()),
        E::Lreal => Some(f64::from_bits(bits)).filter(|x| x.is_finite()).map(f64::to_bits),
        E::Date | E::Ldate => Some(((bits as i64 / 2).div_euclid(day) * day) as u64),
        E::Dt | E::Ldt => Some((bits as i64 / 2) as u64),
        E::Tod | E::Ltod => Some((bits as i64).rem_euclid(day) as u64),
        _ => {
            let (low, high) = ty.int_range()?;
            Some(((i128::from(bits) % (high - low + 1)) + low) as u64)
        }
    }
}

#[test]
fn values_come_back() {
    let mut random = Random(1);
    for &ty in Elementary::ALL.iter().filter(|ty| !ty.is_char()) {
        for i in 0..5_000 {
            let bits = random.next() >> (i % 64);
            let Some(slot) = legal(ty, bits) else { continue };
            let (back, text) = round_trip(ty, slot);
            assert_eq!(back, slot, "{ty:?} {text}");
        }
    }
}

/// Every character but the last few of this list may stand in a literal.
const CHARACTERS: &[u8] = b"0123456789__..##--++::eETtdhmsunDLTRUEFALSE16 \x09\xff\x01";

#[test]
fn no_text_makes_a_conversion_panic() {
    let mut random = Random(2);
    for i in 0..50_000 {
        let len = random.next() % 20;
        let text: String = (0..len).map(|_| char::from(CHARACTERS[(random.next() % CHARACTERS.len() as u64) as usize])).collect();
        let ty = Elementary::ALL[i % Elementary::ALL.len()];
        let text = if i % 3 == 0 { format!("{}#{text}", ty.name()) } else { text };
        for (width, name) in [(1, "STRING"), (2, "WSTRING")] {
            let mut memory = vec![0; header::SIZE as usize];
            let place = string(&mut memory, &text, width);
            let name = format!("{name}_TO_{}", ty.name());
            let (params, result) = signature(&name);
            let value = run(&name, params, result, &place, &mut memory).unwrap_or_else(|t| panic!("{name}: {t:?}"));
            let range = ty.int_range().unwrap_or((i128::MIN, i128::MAX));
            let value = if ty.is_signed_storage() { i128::from(value as i64) } else { i128::from(value) };
            assert!((range.0..=range.1).contains(&value), "{name} {text:?} gives {value}");
        }
    }
}

#[test]
fn long_texts() {
    for (text, want) in [("9".repeat(1024), i16::MAX as u64), ("9".repeat(1025), 0), (" ".repeat(5000) + "7", 7)] {
        let mut memory = vec![0; header::SIZE as usize];
        let place = string(&mut memory, &text, 1);
        let (params, result) = signature("STRING_TO_INT");
        assert_eq!(run("STRING_TO_INT", params, result, &place, &mut memory), Ok(want));
    }
}
