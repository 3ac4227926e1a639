//! Every function name of the library reference, §2 to §9 and §13, typed names included, is found.

use takt_image::{Elementary as E, Generic as G};
use takt_stdlib::{Found, lookup};

/// Overloaded functions with the family of their inputs.
const OVERLOADED: &[(&str, G)] = &[
    ("ABS", G::AnyNum),
    ("SQRT LN LOG EXP SIN COS TAN ASIN ACOS ATAN ATAN2 EXPT IS_VALID", G::AnyReal),
    ("ADD SUB", G::AnyMagnitude),
    ("MUL DIV", G::AnyNum),
    ("MOD", G::AnyInt),
    ("MOVE SEL MUX TO_LITTLE_ENDIAN FROM_LITTLE_ENDIAN", G::Any),
    ("SHL SHR ROL ROR AND OR XOR NOT IS_VALID_BCD", G::AnyBit),
    ("MAX MIN LIMIT GT GE EQ LE LT NE TO_BIG_ENDIAN FROM_BIG_ENDIAN", G::AnyElementary),
];

/// Functions without typed names.
const OTHERS: &str = "LEN LEFT RIGHT MID CONCAT INSERT DELETE REPLACE FIND TIME LTIME TRUNC
    ADD_TIME ADD_LTIME ADD_TOD_TIME ADD_LTOD_LTIME ADD_DT_TIME ADD_LDT_LTIME
    SUB_TIME SUB_LTIME SUB_DATE_DATE SUB_LDATE_LDATE SUB_TOD_TIME SUB_LTOD_LTIME SUB_TOD_TOD SUB_LTOD_LTOD
    SUB_DT_TIME SUB_LDT_LTIME SUB_DT_DT SUB_LDT_LDT MUL_TIME MUL_LTIME MULTIME DIV_TIME DIV_LTIME DIVTIME
    CONCAT_DATE_TOD CONCAT_DATE_LTOD CONCAT_DATE CONCAT_TOD CONCAT_LTOD CONCAT_DT CONCAT_LDT DAY_OF_WEEK
    ADD_TIME_OF_DAY_TIME ADD_DATE_AND_TIME_TIME SUB_DATE_AND_TIME_DATE_AND_TIME CONCAT_DATE_TIME_OF_DAY";

/// Conversions that the paper names one by one; the pairs are in the tests of the matrix.
const CONVERSIONS: &str = "LTIME_TO_TIME TIME_TO_LTIME LDT_TO_DT LDT_TO_DATE LDT_TO_LTOD LDT_TO_TOD DT_TO_LDT DT_TO_DATE DT_TO_LTOD
    DT_TO_TOD LTOD_TO_TOD TOD_TO_LTOD DATE_TO_LDATE LDATE_TO_DATE DATE_TO_DT
    WSTRING_TO_STRING WSTRING_TO_WCHAR STRING_TO_WSTRING STRING_TO_CHAR WCHAR_TO_WSTRING WCHAR_TO_CHAR CHAR_TO_STRING CHAR_TO_WCHAR
    DATE_AND_TIME_TO_DATE DATE_AND_TIME_TO_TIME_OF_DAY TIME_OF_DAY_TO_DINT DINT_TO_DATE_AND_TIME DATE_AND_TIME_TO_STRING
    DWORD_TO_TIME DWORD_TO_REAL TIME_TO_DWORD TIME_TO_REAL INT_TO_DWORD INT_TO_STRING BOOL_TO_BYTE DWORD_TO_INT DATE_TO_DWORD
    REAL_TO_DWORD DT_TO_DWORD STRING_TO_REAL STRING_TO_TIME";

/// Binary-coded decimals, §2.5.
const BCD: &str = "BYTE_BCD_TO_USINT WORD_BCD_TO_UINT DWORD_BCD_TO_UDINT LWORD_BCD_TO_ULINT BCD_TO_USINT BCD_TO_UINT BCD_TO_UDINT
    BCD_TO_ULINT USINT_TO_BCD_BYTE UINT_TO_BCD_WORD UDINT_TO_BCD_DWORD ULINT_TO_BCD_LWORD TO_BCD_BYTE TO_BCD_WORD TO_BCD_DWORD
    TO_BCD_LWORD WORD_BCD_TO_INT BCD_TO_INT INT_TO_BCD";

fn missing(names: impl Iterator<Item = String>, is: impl Fn(&Found) -> bool) -> Vec<String> {
    names.filter(|name| !lookup(name).is_some_and(|found| is(&found))).collect()
}

fn words(text: &str) -> impl Iterator<Item = String> {
    text.split_whitespace().map(str::to_owned)
}

#[test]
fn s13_functions() {
    let overloaded = OVERLOADED.iter().flat_map(|(names, _)| words(names));
    let function = |found: &Found| matches!(found, Found::Function { .. });
    assert!(missing(overloaded.chain(words(OTHERS)).chain(words(BCD)), function).is_empty());
}

/// §1: `NAME_TYPE` for every type of the family, and for no other.
#[test]
fn s1_typed_names() {
    let mut count = 0;
    for (names, group) in OVERLOADED {
        for name in words(names) {
            for e in E::ALL {
                let typed = format!("{name}_{}", e.name());
                let found = matches!(lookup(&typed), Some(Found::Function { fixed: Some(ty), .. }) if ty == *e);
                assert_eq!(found, e.is_in(*group), "{typed}");
                count += usize::from(found);
            }
        }
    }
    assert!(count > 400, "{count}");
}

#[test]
fn s2_conversions_named_one_by_one() {
    assert!(missing(words(CONVERSIONS), |found| matches!(found, Found::Conversion { from: Some(_), .. })).is_empty());
}

/// §2.1: `TO_X`, `TRUNC_X`, `X_TRUNC_Y` and long names.
#[test]
fn s2_1_overloaded_conversions_and_truncations() {
    let all = E::ALL.iter().map(|e| e.name()).chain(["STRING", "WSTRING", "DATE_AND_TIME", "TIME_OF_DAY"]);
    assert!(missing(all.map(|to| format!("TO_{to}")), |found| matches!(found, Found::Conversion { from: None, .. })).is_empty());
    for to in E::ALL {
        for name in [format!("TRUNC_{}", to.name()), format!("REAL_TRUNC_{}", to.name()), format!("LREAL_TRUNC_{}", to.name())] {
            let found = matches!(lookup(&name), Some(Found::Conversion { truncate: true, .. }));
            assert_eq!(found, to.is_int(), "{name}");
        }
    }
}
