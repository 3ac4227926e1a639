//! The file format: what goes in comes out, and nothing else gets in.

use crate::encode::{ENVELOPE, decode, encode, seal};
use crate::image::*;
use crate::memory::MemoryMap;
use crate::natives::{NativeImport, NativeKind, Scalar};
use crate::types::*;
use crate::{Elementary as E, validate::validate};
use takt_base::Nanos;

/// An image that uses every field and kind of type.
pub(crate) fn sample() -> Image {
    let mut t = TypeTable::new();
    let bool_ = t.intern(Type::Elementary(E::Bool));
    let int = t.intern(Type::Elementary(E::Int));
    let text = t.intern(Type::String { capacity: 7 });
    let wide = t.intern(Type::WString { capacity: 3 });
    let percent = t.add(Type::Subrange { name: "Percent".into(), base: E::Int, low: 0, high: 100 });
    let light = t.add(Type::Enum { name: "Light".into(), base: E::Int, values: vec![("Red".into(), 0), ("Green".into(), -7)] });
    let m = |n: &str, ty, section| (n.to_owned(), ty, section, n == "count");
    let point = t.record("Point", [m("x", int, Section::Var), m("label", text, Section::Var), m("w", wide, Section::Var)]);
    let point = t.add(Type::Struct(point));
    let points = t.intern(Type::Array { element: point, dims: vec![Dim { low: -1, high: 1 }, Dim { low: 0, high: 1 }] });
    let by_ref = t.intern(Type::Reference { target: points });
    let members = [m("go", bool_, Section::Input), m("count", percent, Section::Output), m("table", by_ref, Section::InOut)];
    let pump = t.record("Pump", members.into_iter().chain([m("light", light, Section::Var), m("edge", bool_, Section::Hidden)]));
    let pump = t.add(Type::Instance(pump));
    let memory = MemoryMap::new(8, 8, 8, 400, 64).expect("small");
    let symbol =
        |name: &str, ty, place| Symbol { name: name.into(), ty, place, constant: false, retain: name == "main", access: None };
    let path = |name: &str, ty, place, access| Symbol { access: Some(access), ..symbol(name, ty, place) };
    Image {
        name: "cell".into(),
        target: Target::X86_64V2,
        memory,
        init: vec![Chunk { offset: 64, bytes: vec![1, 2] }, Chunk { offset: 100, bytes: vec![3; 9] }],
        symbols: vec![
            symbol("main", pump, Place::Byte(memory.data.start)),
            symbol("points", points, Place::Byte(memory.data.start + 64)),
            symbol("lamp", bool_, Place::Bit(memory.outputs.start, 3)),
            path("shown", bool_, Place::Bit(memory.outputs.start, 3), Access::ReadOnly),
            path("main.given", percent, Place::Byte(memory.data.start + 2), Access::ReadWrite),
        ],
        natives: vec![
            NativeImport {
                name: "SIN".into(),
                kind: NativeKind::Function { params: vec![Scalar::F64], result: Some(Scalar::F64) },
            },
            NativeImport { name: "LOG".into(), kind: NativeKind::Function { params: vec![Scalar::I32; 2], result: None } },
            NativeImport { name: "MC_Power".into(), kind: NativeKind::Block { ty: pump } },
        ],
        functions: vec![Function { pou: "Pump".into(), start: 0, size: 3 }, Function { pou: "main".into(), start: 4, size: 4 }],
        code: vec![0x90; 8],
        traps: vec![TrapSite { offset: 2, trap: 1 }],
        lines: vec![LineSite { offset: 0, file: 0, line: 1 }, LineSite { offset: 4, file: 0, line: 9 }],
        files: vec!["pump.st".into()],
        retained: vec![
            Retained { path: "main.n".into(), ty: bool_, place: Place::Byte(memory.data.start), persistent: true },
            Retained { path: "lamp".into(), ty: bool_, place: Place::Bit(memory.outputs.start, 3), persistent: false },
        ],
        tasks: vec![
            Task {
                name: "fast".into(),
                priority: 1,
                interval: Some(Nanos::from_millis(10)),
                trigger: None,
                programs: vec![Program { name: "main".into(), function: 1, instance: memory.data.start }],
            },
            Task {
                name: "event".into(),
                priority: 0,
                interval: None,
                trigger: Some(Place::Bit(memory.inputs.start, 7)),
                programs: vec![],
            },
            Task {
                name: "idle".into(),
                priority: 9,
                interval: None,
                trigger: Some(Place::Byte(memory.data.start)),
                programs: vec![],
            },
        ],
        attachments: vec![("takt.toml".into(), b"[tasks]".to_vec())],
        types: t,
    }
}

fn reason(bytes: &[u8]) -> String {
    decode(bytes).map(|i| i.name).expect_err("must be refused").reason
}

#[test]
fn what_goes_in_comes_out() {
    for image in [sample(), Image { memory: MemoryMap::new(0, 0, 0, 0, 0).unwrap(), ..Image::default() }] {
        let bytes = encode(&image);
        assert_eq!(decode(&bytes), Ok(image));
    }
    let mut types = decode(&encode(&sample())).unwrap().types;
    assert_eq!(types.intern(Type::Elementary(E::Int)), TypeId(1));
}

#[test]
fn every_truncation_is_refused() {
    let bytes = encode(&sample());
    for n in 0..bytes.len() {
        assert!(decode(&bytes[..n]).is_err(), "{n} bytes");
    }
    // The same with an envelope that fits: now the fields themselves end too early.
    for n in 0..bytes.len() - ENVELOPE {
        assert!(decode(&seal(&bytes[ENVELOPE..ENVELOPE + n])).is_err(), "{n} bytes of payload");
    }
}

#[test]
fn damage_is_named() {
    let mut bytes = encode(&sample());
    assert_eq!(reason(b"#!/bin/sh, which is long enough"), "the file does not begin as an image does");
    *bytes.last_mut().unwrap() ^= 1;
    assert_eq!(reason(&bytes), "the checksum does not fit the contents: the file is damaged");
    bytes[8] = 9;
    assert_eq!(reason(&bytes), "the image has format version 9, this program reads version 3");
    let mut longer = encode(&sample())[ENVELOPE..].to_vec();
    longer.push(0);
    assert_eq!(reason(&seal(&longer)), "1 bytes too many at the end");
}

/// 100,000 damaged files, nine in ten with a checksum that fits: each is refused, or is an image that can be used.
#[test]
fn random_damage_never_gets_through() {
    let payload = encode(&sample())[ENVELOPE..].to_vec();
    let mut seed = 0x9E37_79B9_7F4A_7C15u64;
    let mut next = move |n: usize| {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        (seed >> 11) as usize % n
    };
    let mut accepted = 0;
    for round in 0..100_000 {
        let mut p = payload.clone();
        for _ in 0..=next(3) {
            let at = next(p.len());
            p[at] = [next(256) as u8, 0xFF, 0, 0x80, p[at] ^ (1 << next(8))][next(5)];
        }
        let bytes = if round % 10 == 0 { [&encode(&sample())[..ENVELOPE], &p].concat() } else { seal(&p) };
        if let Ok(image) = decode(&bytes) {
            accepted += 1;
            assert_eq!(validate(&image), Ok(()));
            assert_eq!(decode(&encode(&image)).as_ref(), Ok(&image));
            let sizes = image.types.iter().map(|(id, _)| (image.types.layout(id).size, image.types.display(id)));
            sizes.for_each(|(size, name)| assert!(size <= 1 << 30, "{name}"));
        }
    }
    assert!(accepted > 1_000, "only {accepted}: the test does not get past the checksum");
}

fn refused(change: impl FnOnce(&mut Image)) -> String {
    let mut image = sample();
    change(&mut image);
    validate(&image).expect_err("must be refused").reason
}

#[test]
fn nonsense_is_named() {
    let last = |i: &mut Image| TypeId(i.types.len() as u32);
    let check = |want: &str, change: fn(&mut Image)| assert_eq!(refused(change), want);
    check("a type contains itself or is nested too deep", |i| {
        i.types.replace(TypeId(7), Type::Array { element: TypeId(7), dims: vec![Dim { low: 0, high: 1 }] })
    });
    check("there is no type 99", |i| i.types.replace(TypeId(8), Type::Reference { target: TypeId(99) }));
    check("a type contains itself or is nested too deep", |i| i.types.replace(TypeId(8), Type::Reference { target: TypeId(8) }));
    check("the bounds of an array make no sense", |i| {
        i.types.replace(TypeId(7), Type::Array { element: TypeId(0), dims: vec![Dim { low: i32::MIN, high: i32::MAX }] })
    });
    check("the code of `main` is out of place", |i| i.functions[1].start = 2);
    check("the code of `main` is out of place", |i| i.functions[1].size = u32::MAX);
    check("a trap is not in the code or not known", |i| i.traps[0].trap = 200);
    check("a line is not in the code or not of a known file", |i| i.lines[0].file = 1);
    check("the tables of traps and lines are not in order", |i| i.lines[0].offset = 5);
    check("initial values at 65 are out of place", |i| i.init[1].offset = 65);
    check("`main` does not lie inside the memory", |i| i.symbols[0].place = Place::Byte(i.memory.size() - 1));
    check("`lamp` does not lie inside the memory", |i| i.symbols[2].place = Place::Bit(i.memory.data.start, 0));
    check("program `main` of task `fast` is not in the image", |i| i.tasks[0].programs[0].function = 2);
    check("program `main` of task `fast` is not in the image", |i| i.tasks[0].programs[0].instance = u32::MAX);
    check("the interval of task `fast` is not positive", |i| i.tasks[0].interval = Some(Nanos(0)));
    check("the parts of the memory do not follow each other, or are too large", |i| i.memory.data.size = 1 << 30);
    check("`MC_Power` is not a function block", |i| i.natives[2].kind = NativeKind::Block { ty: TypeId(0) });
    let mut image = sample();
    let next = last(&mut image);
    image.types.add(Type::Array { element: TypeId(next.0 + 1), dims: vec![Dim { low: 0, high: 9 }] });
    image.types.add(Type::Struct(Record { name: "Empty".into(), fields: vec![], size: 0, align: 1 }));
    assert_eq!(validate(&image), Ok(()));
    image.types.add(Type::Array { element: TypeId(next.0 + 1), dims: vec![Dim { low: 0, high: 1 << 20 }] });
    assert!(validate(&image).is_err(), "a million values that take no memory");
}
