use super::*;
use takt_image::image::{Place, Symbol};
use takt_image::{MemoryMap, Type};

/// `n : INT`, `s : STRING[7]`, and 8 bytes of inputs.
fn image() -> Image {
    let mut image = Image { memory: MemoryMap::new(8, 8, 0, 16, 0).unwrap(), ..Image::default() };
    let at = image.memory.data.start;
    for (name, ty, offset) in [("n", Type::Elementary(Elementary::Int), 0), ("s", Type::String { capacity: 7 }, 2)] {
        let ty = image.types.intern(ty);
        image.symbols.push(Symbol {
            name: name.into(),
            ty,
            place: Place::Byte(at + offset),
            constant: false,
            retain: false,
            access: None,
        });
    }
    image
}

fn errors(text: &str) -> Vec<String> {
    let show = |e: StimulusError| format!("{}:{} {}: {}", e.line, e.cell, e.code.text(), e.message);
    Stimulus::from_csv(&image(), text).expect_err(text).into_iter().map(show).collect()
}

#[test]
fn rows_apply_from_their_time_on() {
    let image = image();
    let csv = "\u{feff}# a comment\r\nTIME, %IX0.0, N, s\r\n0, TRUE, 1, \"'a,b'\"\r\n\r\nT#10ms,,2,\r\n0.02,FALSE,,'c'\r\n";
    let mut s = Stimulus::from_csv(&image, csv).unwrap();
    let mut memory = vec![0; image.memory.size() as usize];
    let data = image.memory.data.start as usize;
    let mut at = |ms| {
        s.apply(Nanos::from_millis(ms), 1, &mut memory);
        (memory[64], memory[data], memory[data + 2..data + 5].to_vec())
    };
    assert_eq!(at(0), (1, 1, b"a,b".to_vec()));
    assert_eq!(at(9), (1, 1, b"a,b".to_vec()));
    assert_eq!(at(10), (1, 2, b"a,b".to_vec()));
    assert_eq!(at(500), (0, 2, b"c\0b".to_vec()));
}

#[test]
fn rows_apply_before_their_scan_and_the_last_one_wins() {
    let image = image();
    let mut s = Stimulus::from_csv(&image, "scan,n\n2,5\n2,6\n9,7").unwrap();
    s.push(When::Scan(2), Patch::from_path(&image, "n", "8").unwrap());
    let mut memory = vec![0; image.memory.size() as usize];
    let data = image.memory.data.start as usize;
    let mut before = |scan| {
        s.apply(Nanos(0), scan, &mut memory);
        memory[data]
    };
    assert_eq!([1, 2, 3, 8, 9, 10].map(&mut before), [0, 8, 8, 8, 7, 7]);
}

#[test]
fn errors_name_line_and_cell() {
    for (text, want) in [
        ("", vec!["1:0 C0006: the file is empty"]),
        ("t,n", vec!["1:1 C0006: the first column is `t`, not `time` or `scan`"]),
        ("time,m,n\n0,1,x", vec!["1:2 C0007: there is no variable or program instance `m`", "2:3 C0008: `x` is not a INT"]),
        ("time,n\nsoon,1", vec!["2:1 C0006: `soon` is not a time"]),
        ("time,n\n-1,1", vec!["2:1 C0006: `-1` is not a time"]),
        ("time,n\n1e300,1", vec!["2:1 C0006: `1e300` is not a time"]),
        ("scan,n\n0,1", vec!["2:1 C0006: `0` is not a scan"]),
        ("scan,n\n5,1\n\n4,1", vec!["4:1 C0006: scan 4 comes after a later one"]),
        ("scan,n\n1,2,3", vec!["2:0 C0006: 3 cells, but the first line names 2"]),
        ("scan,\"n", vec!["1:0 C0006: a quote is not closed"]),
        ("scan,n\n1,\"2", vec!["2:0 C0006: a quote is not closed"]),
        ("scan,n\n1,32768", vec!["2:2 C0008: 32768 does not fit INT"]),
    ] {
        assert_eq!(errors(text), want, "{text}");
    }
    let many = format!("scan,n\n{}", "x,1\n".repeat(1000));
    assert_eq!(errors(&many).len(), 20);
}

/// Random text made of what stimulus files are made of: an answer, never a panic, and errors have a place.
#[test]
fn any_text_gets_an_answer() {
    const WORDS: [&str; 22] = [
        "time",
        "scan",
        ",",
        ",",
        "\n",
        "\n",
        "%IX0.0",
        "%IB9",
        "n",
        "s",
        "n.3",
        "n[1]",
        "\"",
        "'",
        "$",
        "1",
        "-99999999999999999999",
        "T#1s",
        "1e308",
        "ä",
        "\r",
        "#",
    ];
    let (image, mut seed, mut good) = (image(), 1u32, 0);
    let mut next = move |n: usize| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as usize % n
    };
    for _ in 0..50_000 {
        let tail: String = (0..next(14)).map(|_| WORDS[next(WORDS.len())]).collect();
        let text = format!("{}{tail}", ["", "time,n", "scan,%IX0.0,s"][next(3)]);
        match Stimulus::from_csv(&image, &text) {
            Ok(mut s) => {
                s.apply(Nanos(i64::MAX), u64::MAX, &mut vec![0; image.memory.size() as usize]);
                good += 1;
            }
            Err(errors) => assert!(errors.iter().all(|e| e.line >= 1 && !e.message.is_empty()) && !errors.is_empty(), "{text}"),
        }
    }
    assert!(good > 1_000, "{good}");
}
