//! Calls natives as compiled code does. A case is a line: `MID_STRING('ASTR', 2, 2) = 'ST'`. Arguments are `'STRING'`, `"WSTRING"`,
//! integers, reals, `16#FF`, and literals of durations and dates (`T#1h`, `D#2024-02-29`), which are read by the library itself.
#![allow(dead_code)] // each test file uses a part

use takt_base::Nanos;
use takt_image::{NativeCall, NativeImport, NativeKind, Natives, Scalar, Trap, TypeTable, header};
use takt_stdlib::{Library, native_signature};

/// A string is given this capacity.
pub const CAPACITY: usize = 80;

/// An argument or a result.
#[derive(Clone, PartialEq, Debug)]
pub enum Value {
    Slot(u64),
    Text(String),
}

/// Checks every line that is not empty.
#[track_caller]
pub fn check(cases: &str) {
    for case in cases.lines().map(str::trim).filter(|line| !line.is_empty()) {
        let (call, want) = case.rsplit_once(" = ").unwrap_or_else(|| panic!("no result: {case}"));
        let (name, args) = call.strip_suffix(')').and_then(|c| c.split_once('(')).unwrap_or_else(|| panic!("no call: {case}"));
        let NativeKind::Function { params, result } = native_signature(name).unwrap_or_else(|| panic!("unknown: {case}")) else {
            panic!("a block: {case}")
        };
        let args: Vec<&str> = split(args);
        let got = call_text(name, &params, result, &args);
        let want =
            if result.is_some() { Value::Slot(slot(want, result)) } else { Value::Text(want[1..want.len() - 1].to_owned()) };
        let same_nan = |a: &Value, b: &Value| match (a, b, result) {
            (Value::Slot(a), Value::Slot(b), Some(Scalar::F64)) => f64::from_bits(*a).is_nan() && f64::from_bits(*b).is_nan(),
            _ => false,
        };
        assert!(got == want || same_nan(&got, &want), "{case}: got {got:?}, want {want:?}");
    }
}

/// At commas outside of strings.
fn split(args: &str) -> Vec<&str> {
    let (mut parts, mut start, mut quoted) = (Vec::new(), 0, false);
    for (i, c) in args.char_indices() {
        match c {
            '\'' | '"' => quoted = !quoted,
            ',' if !quoted => {
                parts.push(args[start..i].trim());
                start = i + 1;
            }
            _ => {}
        }
    }
    parts.push(args[start..].trim());
    parts
}

fn call_text(name: &str, params: &[Scalar], result: Option<Scalar>, texts: &[&str]) -> Value {
    let (mut memory, mut slots, mut kinds) = (vec![0; header::SIZE as usize], Vec::new(), Vec::new());
    for text in texts {
        let quote = text.chars().next().filter(|c| matches!(c, '\'' | '"'));
        if let Some(quote) = quote {
            let place = string(&mut memory, &text[1..text.len() - 1], if quote == '"' { 2 } else { 1 });
            slots.extend(place);
            kinds.extend([Scalar::I32; 2]);
        } else {
            let kind = params.get(slots.len()).copied();
            slots.push(slot(text, kind));
            kinds.extend(kind);
        }
    }
    let width = if name.ends_with("WSTRING") { 2 } else { 1 };
    let to = result.is_none().then(|| string(&mut memory, "?", width));
    if let Some(to) = to {
        slots.extend(to);
        kinds.extend([Scalar::I32; 2]);
    }
    let value = run(name, kinds, result, &slots, &mut memory).unwrap_or_else(|trap| panic!("{name}: {trap:?}"));
    match to {
        Some([at, _]) => Value::Text(read(&memory, at as usize, width)),
        None => Value::Slot(value),
    }
}

/// Binds and calls.
pub fn run(name: &str, params: Vec<Scalar>, result: Option<Scalar>, slots: &[u64], memory: &mut [u8]) -> Result<u64, Trap> {
    let import = NativeImport { name: name.to_owned(), kind: NativeKind::Function { params, result } };
    let mut library = Library::new();
    let native = library.bind(&import, &TypeTable::new()).unwrap_or_else(|e| panic!("{name}: {e:?}"));
    let mut call = NativeCall { memory, args: slots, result: 0, now: Nanos::ZERO };
    library.call(native, &mut call)?;
    Ok(call.result)
}

/// Appends a string; its slots.
pub fn string(memory: &mut Vec<u8>, text: &str, width: usize) -> [u64; 2] {
    memory.resize(memory.len().next_multiple_of(2), 0);
    let at = memory.len();
    let units: Vec<u16> = text.chars().map(|c| c as u16).collect();
    let capacity = CAPACITY.max(units.len());
    for i in 0..=capacity {
        let unit = units.get(i).copied().unwrap_or(0);
        memory.extend(&unit.to_le_bytes()[..width]);
    }
    [at as u64, capacity as u64]
}

fn read(memory: &[u8], at: usize, width: usize) -> String {
    let unit = |i: usize| {
        let at = at + i * width;
        if width == 1 { memory[at].into() } else { u16::from_le_bytes([memory[at], memory[at + 1]]) }
    };
    (0..).map(unit).take_while(|&u| u != 0).map(|u| char::from_u32(u.into()).unwrap_or('#')).collect()
}

/// A scalar as a slot: what it is follows from its form and the machine type.
pub fn slot(text: &str, kind: Option<Scalar>) -> u64 {
    if let Some(hex) = text.strip_prefix("16#") {
        return u64::from_str_radix(hex, 16).unwrap_or_else(|e| panic!("{text}: {e}"));
    }
    if let Some((prefix, _)) = text.split_once('#') {
        return literal(prefix, text);
    }
    match (kind, text) {
        (Some(Scalar::F32), _) => f32::to_bits(text.parse().unwrap_or_else(|e| panic!("{text}: {e}"))).into(),
        (Some(Scalar::F64), _) => f64::to_bits(text.parse().unwrap_or_else(|e| panic!("{text}: {e}"))),
        (_, "TRUE") => 1,
        (_, "FALSE") => 0,
        _ => text.parse::<i128>().unwrap_or_else(|e| panic!("{text}: {e}")) as u64,
    }
}

fn literal(prefix: &str, text: &str) -> u64 {
    let ty = match prefix {
        "T" => "TIME",
        "D" => "DATE",
        "LD" => "LDATE",
        other => other,
    };
    let name = format!("STRING_TO_{ty}");
    let Value::Slot(slot) = call_text(&name, &[], Some(Scalar::I64), &[&format!("'{text}'")]) else { panic!("{text}") };
    slot
}
