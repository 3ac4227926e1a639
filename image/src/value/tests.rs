use super::*;
use crate::encode_tests::sample;
use crate::path::resolve;

/// Writes a text to a path and reads it back, or gives the error.
fn check(path: &str, text: &str) -> String {
    let image = sample();
    let mut memory = vec![0xA5; image.memory.size() as usize];
    let v = resolve(&image, path).unwrap();
    match write_text(&image.types, &mut memory, v.place, v.ty, text) {
        Ok(()) => read(&image.types, &memory, v.place, v.ty).unwrap().to_string(),
        Err(e) => format!("{}: {} ({})", e.code.text(), e.message, e.help.unwrap_or_default()),
    }
}

#[test]
fn text_goes_in_and_comes_out() {
    for (path, text, want) in [
        ("main.go", "true", "TRUE"),
        ("main.go", "BOOL#0", "FALSE"),
        ("lamp", "1", "TRUE"),
        ("%IX0.1", "FALSE", "FALSE"),
        ("main.count", "INT#16#64", "100"),
        ("main.count", "101", "C0008: 101 does not fit Percent (the range is 0 to 100)"),
        ("main.count", "x", "C0008: `x` is not a Percent (write a number such as 42, -5 or 16#FF)"),
        ("main.light", "green", "Green"),
        ("main.light", "Light#Red", "Red"),
        ("main.light", "-7", "Green"),
        ("main.light", "Gren", "C0008: `Gren` is not a Light (did you mean `Green`?)"),
        ("main.light", "5", "C0008: `5` is not a Light (its values are Red, Green)"),
        ("points[0,0].x", "-32768", "-32768"),
        ("points[0,0].x", "32768", "C0008: 32768 does not fit INT (the range is -32768 to 32767)"),
        ("points[0,0].label", "'it$'s'", "'it$'s'"),
        ("points[0,0].label", "STRING#'1234567'", "'1234567'"),
        ("points[0,0].label", "'12345678'", "C0008: the text has 8 characters, STRING[7] has room for 7 ()"),
        ("points[0,0].w", "\"a€$000D\"", "\"a€$R\""),
        ("%QW1", "16#FFFF", "65535"),
        ("%QW1", "WORD#65536", "C0008: WORD#65536 does not fit WORD (the range is 0 to 65535)"),
        ("%ML0", "18446744073709551615", "18446744073709551615"),
        ("points", "1", "C0008: ARRAY[-1..1, 0..1] OF Point has more than one value (set its members or elements one by one)"),
    ] {
        assert_eq!(check(path, text), want, "{path} {text}");
    }
}

#[test]
fn elementary_values() {
    let show = |e: E, text: &str| {
        let mut memory = [0xA5; 16];
        let place = Place::Byte(4);
        match write_text(&TypeTable::new(), &mut memory, place, VarType::Direct(e), text) {
            Ok(()) => read(&TypeTable::new(), &memory, place, VarType::Direct(e)).unwrap().to_string(),
            Err(e) => e.message,
        }
    };
    for (e, text, want) in [
        (E::Real, "1.5E3", "1500.0"),
        (E::Real, "REAL#0.1", "0.1"),
        (E::Real, "1E39", "1E39 does not fit REAL"),
        (E::Real, "-Infinity", "-Infinity"),
        (E::Lreal, "NaN", "NaN"),
        (E::Lreal, "1e400", "1e400 does not fit LREAL"),
        (E::Lreal, "T#1s", "`T#1s` is not a LREAL"),
        (E::Time, "T#1s500ms", "T#1s500ms"),
        (E::Date, "D#2024-02-30", "`D#2024-02-30` is not a DATE"),
        (E::Tod, "TOD#07:05:03.25", "TOD#07:05:03.25"),
        (E::Ldt, "DT#2024-02-29-07:05:03", "LDT#2024-02-29-07:05:03"),
        (E::Char, "'x'", "'x'"),
        (E::Char, "'xy'", "`'xy'` is not a CHAR"),
        (E::Wchar, "\"€\"", "\"€\""),
        (E::Lint, "-9223372036854775808", "-9223372036854775808"),
        (E::Ulint, "-1", "-1 does not fit ULINT"),
        (E::Sint, "16#80", "16#80 does not fit SINT"),
    ] {
        assert_eq!(show(e, text), want, "{e:?} {text}");
    }
}

#[test]
fn instances_are_trees_without_hidden_members() {
    let image = sample();
    let memory = vec![0; image.memory.size() as usize];
    let main = image.symbol("main").unwrap();
    let value = read(&image.types, &memory, main.place, main.ty).unwrap();
    assert_eq!(value.to_string(), "(go := FALSE, count := 0, light := Red)");
    let points = image.symbol("points").unwrap();
    let Some(Value::Array(rows)) = read(&image.types, &memory, points.place, points.ty) else { panic!() };
    let Value::Array(row) = &rows[2] else { panic!() };
    assert_eq!((rows.len(), row.len(), row[1].to_string().as_str()), (3, 2, "(x := 0, label := '', w := \"\")"));
    assert_eq!(read(&image.types, &memory[..100], points.place, points.ty), None);
}

#[test]
fn bits_and_bytes_around_a_value_stay() {
    let mut memory = [0xFF; 4];
    write_text(&TypeTable::new(), &mut memory, Place::Bit(1, 3), VarType::Direct(E::Bool), "0").unwrap();
    write_text(&TypeTable::new(), &mut memory, Place::Byte(2), VarType::Direct(E::Byte), "0").unwrap();
    assert_eq!(memory, [0xFF, 0xF7, 0, 0xFF]);
    write_text(&TypeTable::new(), &mut memory, Place::Byte(2), VarType::Direct(E::Lword), "0").unwrap();
    assert_eq!(memory, [0xFF, 0xF7, 0, 0xFF]);
}
