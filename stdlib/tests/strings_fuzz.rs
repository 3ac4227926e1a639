//! String functions against a model that works on vectors: 100,000 random calls of each width. Nothing but the target changes, the
//! target ends with a zero unit, and sources that overlap the target are safe too.

mod common;

use takt_base::Nanos;
use takt_image::{NativeCall, NativeImport, NativeKind, Natives, Trap, TypeTable, header};
use takt_stdlib::{Library, native_signature};

const CALLS: u32 = 100_000;
const MEMORY: usize = 512;

/// xorshift64*.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }
    fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }
    /// Mostly near the lengths of strings, sometimes far out.
    fn number(&mut self) -> i64 {
        match self.below(20) {
            0 => i64::MAX,
            1 => i64::MIN,
            _ => self.below(14) as i64 - 2,
        }
    }
}

/// What a call does, by §7; `None`: the function has a number as result.
fn model(name: &str, texts: &[Vec<u16>], n: &[i64]) -> (Option<Vec<u16>>, u64) {
    let a = &texts[0];
    let len = a.len() as i64;
    let cut = |from: i64, to: i64| a[from.clamp(0, len) as usize..to.clamp(0, len).max(from.clamp(0, len)) as usize].to_vec();
    let text = match name {
        "LEN" => return (None, len as u64),
        "FIND" => {
            let found = !texts[1].is_empty() && texts[1].len() <= a.len();
            let at = if found { a.windows(texts[1].len()).position(|w| w == texts[1]) } else { None };
            return (None, at.map_or(0, |i| i as u64 + 1));
        }
        "LEFT" => cut(0, n[0]),
        "RIGHT" => cut(len - n[0].clamp(0, len), len),
        "MID" if n[1] < 1 || n[0] < 0 => vec![],
        "MID" => cut(n[1] - 1, (n[1] - 1).saturating_add(n[0])),
        "CONCAT" => texts.concat(),
        "INSERT" if n[0] < 0 => a.clone(),
        "INSERT" => [cut(0, n[0]), texts[1].clone(), cut(n[0], len)].concat(),
        "DELETE" if n[1] < 1 || n[0] < 0 => a.clone(),
        "DELETE" => [cut(0, n[1] - 1), cut((n[1] - 1).saturating_add(n[0]), len)].concat(),
        "REPLACE" if n[1] < 1 || n[1] > len + 1 || n[0] < 0 => a.clone(),
        "REPLACE" => [cut(0, n[1] - 1), texts[1].clone(), cut((n[1] - 1).saturating_add(n[0]), len)].concat(),
        _ => panic!("{name}"),
    };
    (Some(text), 0)
}

/// Name, strings, numbers.
const FUNCTIONS: [(&str, usize, usize); 10] = [
    ("LEN", 1, 0),
    ("LEFT", 1, 1),
    ("RIGHT", 1, 1),
    ("MID", 1, 2),
    ("CONCAT", 2, 0),
    ("CONCAT", 5, 0),
    ("INSERT", 2, 1),
    ("DELETE", 1, 2),
    ("REPLACE", 2, 2),
    ("FIND", 2, 0),
];

/// A string in memory.
#[derive(Clone, Copy)]
struct Place {
    at: usize,
    capacity: usize,
}

impl Place {
    fn slots(self) -> [u64; 2] {
        [self.at as u64, self.capacity as u64]
    }
    fn bytes(self, width: usize) -> std::ops::Range<usize> {
        self.at..self.at + (self.capacity + 1) * width
    }
    fn read(self, memory: &[u8], width: usize) -> Vec<u16> {
        let unit = |i: usize| {
            let b = &memory[self.at + i * width..];
            if width == 1 { b[0].into() } else { u16::from_le_bytes([b[0], b[1]]) }
        };
        (0..self.capacity).map(unit).take_while(|&u| u != 0).collect()
    }
}

/// Writes a random string of few different characters, so that FIND finds; now and then without an end.
fn fill(random: &mut Random, memory: &mut [u8], place: Place, width: usize) {
    for (i, unit) in memory[place.bytes(width)].chunks_mut(width).enumerate() {
        let value = if i > 8 || random.below(9) == 0 { 0 } else { random.below(3) as u16 * 0x55 + 0x41 };
        unit.copy_from_slice(&value.to_le_bytes()[..width]);
    }
}

struct Case {
    name: String,
    kind: NativeKind,
    sources: Vec<Place>,
    numbers: Vec<i64>,
    target: Place,
}

impl Case {
    fn call(&self, memory: &mut [u8], has_target: bool) -> Result<u64, Trap> {
        let import = NativeImport { name: self.name.clone(), kind: self.kind.clone() };
        let mut library = Library::new();
        let native = library.bind(&import, &TypeTable::new()).expect("known");
        let mut slots: Vec<u64> = self.sources.iter().flat_map(|s| s.slots()).collect();
        slots.extend(self.numbers.iter().map(|&n| n as u64));
        if has_target {
            slots.extend(self.target.slots());
        }
        let mut call = NativeCall { memory, args: &slots, result: 0, now: Nanos::ZERO };
        library.call(native, &mut call).map(|()| call.result)
    }
}

fn case(random: &mut Random, width: usize, overlapping: bool) -> (Case, &'static str) {
    let (base, strings, numbers) = FUNCTIONS[random.below(FUNCTIONS.len() as u64) as usize];
    let name = format!("{base}_{}STRING", if width == 2 { "W" } else { "" });
    let mut at = header::SIZE as usize;
    let mut place = |random: &mut Random| {
        let capacity = random.below(12) as usize;
        let start = if overlapping { header::SIZE as usize + 2 * random.below(20) as usize } else { at };
        at = start + (capacity + 1) * width + 2 * random.below(3) as usize;
        Place { at: start, capacity }
    };
    let sources: Vec<Place> = (0..strings).map(|_| place(random)).collect();
    let target = place(random);
    let numbers = (0..numbers).map(|_| random.number()).collect();
    let mut kind = native_signature(&name).expect("known");
    if let NativeKind::Function { params, .. } = &mut kind
        && base == "CONCAT"
    {
        params.resize(2 * strings + 2, takt_image::Scalar::I32);
    }
    (Case { name, kind, sources, numbers, target }, base)
}

#[test]
fn functions_agree_with_the_model() {
    for width in [1, 2] {
        let mut random = Random(7341 + width as u64);
        for _ in 0..CALLS {
            let (case, base) = case(&mut random, width, false);
            let mut memory: Vec<u8> = (0..MEMORY).map(|_| random.next() as u8).collect();
            for &source in &case.sources {
                fill(&mut random, &mut memory, source, width);
            }
            let texts: Vec<_> = case.sources.iter().map(|s| s.read(&memory, width)).collect();
            let (text, number) = model(base, &texts, &case.numbers);
            let mut after = memory.clone();
            let got = case.call(&mut after, text.is_some()).unwrap_or_else(|t| panic!("{}: {t:?}", case.name));
            let target = case.target.bytes(width);
            if let Some(mut text) = text {
                text.truncate(case.target.capacity);
                assert_eq!(case.target.read(&after, width), text, "{} {texts:?} {:?}", case.name, case.numbers);
                let end = case.target.at + text.len() * width;
                assert!(after[end..end + width].iter().all(|&b| b == 0), "{} is not ended", case.name);
                after[target.clone()].copy_from_slice(&memory[target]);
            } else {
                assert_eq!(got, number, "{} {texts:?}", case.name);
            }
            after[header::ENO as usize] = memory[header::ENO as usize];
            assert!(after == memory, "{} wrote outside of its target", case.name);
        }
    }
}

#[test]
fn overlapping_strings_are_safe() {
    for width in [1, 2] {
        let mut random = Random(97 + width as u64);
        for _ in 0..CALLS / 4 {
            let (case, base) = case(&mut random, width, true);
            let memory: Vec<u8> = (0..MEMORY).map(|_| random.below(4) as u8).collect();
            let mut after = memory.clone();
            let has_target = !matches!(base, "LEN" | "FIND");
            case.call(&mut after, has_target).unwrap_or_else(|t| panic!("{}: {t:?}", case.name));
            if has_target {
                let target = case.target.bytes(width);
                after[target.clone()].copy_from_slice(&memory[target]);
            }
            after[header::ENO as usize] = memory[header::ENO as usize];
            assert!(after == memory, "{} wrote outside of its target", case.name);
        }
    }
}
