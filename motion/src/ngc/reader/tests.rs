use super::*;
use crate::ngc::code::CommentKind;
use takt_base::SourceId;

/// Words as `X1 Y2`, or code and bytes of the fault.
fn shown(text: &str) -> String {
    let mut arena = Arena::default();
    match Reader::default().read(text, 0, 1, &mut arena) {
        Ok(row) => {
            let n = row.n.map(|n| format!("N{n}"));
            let words = arena.words.iter().map(|w| match w.value {
                Value::Number(value) => format!("{}{value}", w.letter),
                Value::Code(code) => format!("{}{:?}", w.letter, &arena.ops[code.range()]),
            });
            n.into_iter().chain(words).collect::<Vec<_>>().join(" ")
        }
        Err(fault) => {
            let diag = fault.diag(SourceId(0));
            format!("{} {}..{}", diag.code.text(), diag.span.start, diag.span.end)
        }
    }
}

#[test]
fn blocks() {
    let cases = [
        ("N1G0X20Y30Z0", "N1 G0 X20 Y30 Z0"),
        (" / n 1 g 0 1 x - 1 2 . 5", "N1 G1 X-12.5"),
        ("(a)G1(b ; c)X2;Y3", "G1 X2"),
        ("X1E2", "X1 E2"),
        ("", ""),
        ("G1 X", "N0002 3..4"),
        ("G1 X Y2", "N0002 3..5"),
        ("X1.2.3", "N0001 4..5"),
        ("X--1 Y2", "N0002 0..4"),
        ("X[1+2]", "X[Number(1.0), Number(2.0), Binary(Plus)]"),
        ("X[1]Y-[2]", "X1 Y[Number(2.0), Function(Negate)]"),
        ("X#3 Y##3", "X[Parameter(3)] Y[Parameter(3), ParameterAt]"),
        ("X SIN [ 3 0 ]", "X[Number(30.0), Function(Sin)]"),
        ("X[1", "N0016 1..2"),
        ("X[1+]", "N0016 4..5"),
        ("X[1 FOO 2]", "N0016 4..5"),
        ("X[FOO[2]]", "N0016 2..5"),
        ("[1]", "N0016 0..1"),
        ("#1", "N0017 0..2"),
        ("#<a", "N0017 1..2"),
        ("o100 foo", "N0019 0..8"),
        ("o100 if", "N0019 0..7"),
        ("G1 o100 sub", "N0019 3..4"),
        ("G1 X1 ä", "N0001 6..8"),
        ("G1 (a (b)) X1", "N0011 3..6"),
        ("G1 (a", "N0011 3..5"),
        ("G1 X1 )", "N0001 6..7"),
        ("G1 N2", "N0002 3..5"),
        ("N1 N2", "N0002 3..5"),
        ("N1.5", "N1"),
        ("N-1", "N0002 0..3"),
    ];
    for (text, want) in cases {
        assert_eq!(shown(text), want, "{text}");
    }
}

#[test]
fn comments_and_messages() {
    let mut arena = Arena::default();
    let text = "(one) ( msg , two, 2) (MSG three)";
    Reader::default().read(text, 0, 1, &mut arena).unwrap();
    let found: Vec<_> = arena.comments.iter().map(|c| (c.kind, &text[c.place.0 as usize..c.place.1 as usize])).collect();
    assert_eq!(found, [(CommentKind::Plain, "one"), (CommentKind::Message, " two, 2"), (CommentKind::Plain, "MSG three")]);
}

#[test]
fn long_blocks_are_read() {
    let text = format!("G1{}X1({})", " ".repeat(10_000), "c".repeat(10_000));
    assert_eq!(shown(&text), "G1 X1");
    assert!(shown(&format!("X{}1{}", "[".repeat(100_000), "]".repeat(100_000))).starts_with("N0016"));
}
