//! Vectors of the library reference, by section.

mod common;
use common::check;

/// §2.3.
#[test]
fn s2_3_numbers_to_string() {
    check(
        "INT_TO_STRING(0) = '0'
        INT_TO_STRING(-32768) = '-32768'
        SINT_TO_STRING(-1) = '-1'
        USINT_TO_STRING(255) = '255'
        LINT_TO_STRING(-9223372036854775808) = '-9223372036854775808'
        ULINT_TO_STRING(18446744073709551615) = '18446744073709551615'
        BOOL_TO_STRING(1) = 'TRUE'
        BOOL_TO_STRING(0) = 'FALSE'
        BYTE_TO_STRING(0) = '16#0'
        WORD_TO_STRING(16#AF) = '16#AF'
        LWORD_TO_STRING(16#FFFFFFFFFFFFFFFF) = '16#FFFFFFFFFFFFFFFF'
        INT_TO_WSTRING(-5) = \"-5\"
        REAL_TO_STRING(1.5) = '1.5'
        REAL_TO_STRING(100) = '100.0'
        REAL_TO_STRING(0.1) = '0.1'
        REAL_TO_STRING(-0.0) = '-0.0'
        REAL_TO_STRING(1e20) = '1.0E+20'
        REAL_TO_STRING(3.4028235e38) = '3.4028235E+38'
        REAL_TO_STRING(1e-45) = '1.0E-45'
        REAL_TO_STRING(inf) = 'Inf'
        REAL_TO_STRING(-inf) = '-Inf'
        LREAL_TO_STRING(NaN) = 'NaN'
        LREAL_TO_STRING(0) = '0.0'
        LREAL_TO_STRING(0.1) = '0.1'
        LREAL_TO_STRING(0.00001) = '0.00001'
        LREAL_TO_STRING(0.0000015) = '1.5E-6'
        LREAL_TO_STRING(-123.456) = '-123.456'
        LREAL_TO_STRING(9007199254740993) = '9007199254740992.0'
        LREAL_TO_STRING(1e15) = '1000000000000000.0'
        LREAL_TO_STRING(1e16) = '1.0E+16'
        LREAL_TO_STRING(1.7976931348623157e308) = '1.7976931348623157E+308'
        LREAL_TO_WSTRING(2.5) = \"2.5\"",
    );
}

/// §2.3.
#[test]
fn s2_3_times_to_string() {
    check(
        "TIME_TO_STRING(T#1d2h3m4s5ms) = 'T#1d2h3m4s5ms'
        TIME_TO_STRING(T#0s) = 'T#0s'
        TIME_TO_STRING(T#-5ms) = 'T#-5ms'
        TIME_TO_STRING(T#1h5ms) = 'T#1h5ms'
        TIME_TO_STRING(1001) = 'T#1us1ns'
        LTIME_TO_STRING(LTIME#36h) = 'LTIME#1d12h'
        TIME_TO_STRING(-9223372036854775808) = 'T#-106751d23h47m16s854ms775us808ns'
        DATE_TO_STRING(D#2024-02-29) = 'D#2024-02-29'
        LDATE_TO_STRING(LD#2024-02-29) = 'LD#2024-02-29'
        TOD_TO_STRING(TOD#07:05:03.25) = 'TOD#07:05:03.250'
        TOD_TO_STRING(TOD#07:05:03) = 'TOD#07:05:03'
        LTOD_TO_STRING(LTOD#07:05:03.000000001) = 'LTOD#07:05:03.000000001'
        DT_TO_STRING(DT#2024-02-29-07:05:03) = 'DT#2024-02-29-07:05:03'
        LDT_TO_WSTRING(LDT#1969-12-31-23:00:00.5) = \"LDT#1969-12-31-23:00:00.500\"
        DT_TO_STRING(-9223372036854775808) = 'DT#1677-09-21-00:12:43.145224192'",
    );
}

/// §2.4.
#[test]
fn s2_4_string_to_numbers() {
    check(
        "STRING_TO_INT('42') = 42
        STRING_TO_INT('  -42') = -42
        STRING_TO_INT('+1_000') = 1000
        STRING_TO_INT('16#FF') = 255
        STRING_TO_INT('2#1111_0000') = 240
        STRING_TO_INT('8#17') = 15
        STRING_TO_INT('INT#7') = 7
        STRING_TO_INT('INT#16#7FFF') = 32767
        STRING_TO_DINT('INT#-7') = -7
        STRING_TO_INT('DINT#7') = 0
        STRING_TO_INT('') = 0
        STRING_TO_INT('   ') = 0
        STRING_TO_INT('12x') = 0
        STRING_TO_INT('1__2') = 0
        STRING_TO_INT('12_') = 0
        STRING_TO_INT('_12') = 0
        STRING_TO_INT('-16#1') = 0
        STRING_TO_INT('7#1') = 0
        STRING_TO_INT('2#2') = 0
        STRING_TO_INT('40000') = 32767
        STRING_TO_INT('-40000') = -32768
        STRING_TO_USINT('-1') = 0
        STRING_TO_ULINT('18446744073709551615') = 18446744073709551615
        STRING_TO_ULINT('99999999999999999999999999999999999999999999999') = 18446744073709551615
        STRING_TO_LINT('-99999999999999999999999999999999999999999999999') = -9223372036854775808
        STRING_TO_WORD('16#FFFF') = 65535
        STRING_TO_BYTE('BYTE#16#a5') = 165
        WSTRING_TO_INT(\"-5\") = -5
        WSTRING_TO_INT(\"5\u{100}\") = 0
        STRING_TO_BOOL('TRUE') = 1
        STRING_TO_BOOL('false') = 0
        STRING_TO_BOOL('1') = 1
        STRING_TO_BOOL('BOOL#TRUE') = 1
        STRING_TO_BOOL('yes') = 0
        STRING_TO_BOOL('TRUEX') = 0
        STRING_TO_REAL('1.5') = 1.5
        STRING_TO_REAL('-1.34E-12') = -1.34e-12
        STRING_TO_REAL('1.0e+6') = 1000000.0
        STRING_TO_REAL('3.14159_26') = 3.1415926
        STRING_TO_REAL('REAL#5') = 5.0
        STRING_TO_LREAL('1E6') = 1000000.0
        STRING_TO_LREAL('0.1') = 0.1
        STRING_TO_LREAL('1.') = 0.0
        STRING_TO_LREAL('.5') = 0.0
        STRING_TO_LREAL('inf') = 0.0
        STRING_TO_LREAL('1.5E') = 0.0
        STRING_TO_LREAL('1.5 ') = 0.0
        STRING_TO_LREAL('') = 0.0",
    );
}

/// §2.4; literals of language reference §1.7.
#[test]
fn s2_4_string_to_times() {
    check(
        "STRING_TO_TIME('T#14ms') = 14000000
        STRING_TO_TIME('t#-14ms') = -14000000
        STRING_TO_TIME('14.7h') = 52920000000000
        STRING_TO_TIME('TIME#5d_14h_12m_18s_3.5ms') = 483138003500000
        STRING_TO_LTIME('LTIME#5m_30s_500ms_100.1us') = 330500100100
        STRING_TO_LTIME('LT#1ns') = 1
        STRING_TO_LTIME('T#1ns') = 1
        STRING_TO_TIME('LT#1ns') = 0
        STRING_TO_TIME('T#0.5ns') = 0
        STRING_TO_TIME('T#1.5ns') = 2
        STRING_TO_TIME('T#2.5ns') = 2
        STRING_TO_TIME('T#2.50000000000000000000000001ns') = 3
        STRING_TO_TIME('T#0') = 0
        STRING_TO_TIME('T#25h15m') = 90900000000000
        STRING_TO_TIME('T#1m1h') = 0
        STRING_TO_TIME('T#1.5h1m') = 0
        STRING_TO_TIME('T#1s1s') = 0
        STRING_TO_TIME('T#1x') = 0
        STRING_TO_TIME('T#5') = 0
        STRING_TO_TIME('T#') = 0
        STRING_TO_TIME('T#1s_') = 0
        STRING_TO_TIME('T#999999999999999999999999d') = 9223372036854775807
        STRING_TO_TIME('T#-999999999999999999999999d') = -9223372036854775808
        STRING_TO_DATE('D#1970-01-02') = 86400000000000
        STRING_TO_DATE('1970-1-2') = 86400000000000
        STRING_TO_DATE('DATE#1969-12-31') = -86400000000000
        STRING_TO_DATE('D#2023-02-29') = 0
        STRING_TO_DATE('D#9999-01-01') = 0
        STRING_TO_DATE('D#1970-01') = 0
        STRING_TO_TOD('TOD#7:5:3') = 25503000000000
        STRING_TO_TOD('TIME_OF_DAY#12:00') = 43200000000000
        STRING_TO_LTOD('00:00:00.000_000_001') = 1
        STRING_TO_TOD('24:00:00') = 0
        STRING_TO_DT('DT#1970-01-01-00:00:01.5') = 1500000000
        STRING_TO_DT('DATE_AND_TIME#1970-01-02-00:00:00') = 86400000000000
        STRING_TO_LDT('LDT#1969-12-31-23:59:59') = -1000000000
        STRING_TO_DT('DT#1970-01-01') = 0",
    );
}

/// §2.1 row l, §2.6.
#[test]
fn s2_6_characters() {
    check(
        "STRING_TO_WSTRING('aé') = \"aé\"
        WSTRING_TO_STRING(\"aé\u{20ac}\") = 'aé?'
        STRING_TO_CHAR('xyz') = 120
        STRING_TO_CHAR('') = 0
        WSTRING_TO_CHAR(\"\u{20ac}\") = 63
        WSTRING_TO_WCHAR(\"\u{20ac}\") = 8364
        CHAR_TO_STRING(120) = 'x'
        CHAR_TO_STRING(0) = ''
        WCHAR_TO_WSTRING(8364) = \"\u{20ac}\"
        WCHAR_TO_STRING(8364) = '?'
        WCHAR_TO_CHAR(233) = 233
        WCHAR_TO_CHAR(256) = 63",
    );
}

/// §2.1 row g, §2.6.
#[test]
fn s2_6_times_as_numbers() {
    check(
        "TIME_TO_DINT(T#1s500ms) = 1500
        DINT_TO_TIME(1500) = T#1s500ms
        DINT_TO_TIME(-1) = T#-1ms
        TIME_TO_DINT(T#1.9ms) = 1
        TIME_TO_DINT(T#-1.9ms) = -1
        TIME_TO_REAL(T#1.5ms) = 1.5
        REAL_TO_TIME(1.5) = T#1.5ms
        LREAL_TO_TIME(1e300) = 9223372036854775807
        LREAL_TO_TIME(NaN) = 0
        LREAL_TO_TIME(0.0000005) = 0
        LREAL_TO_TIME(0.0000015) = 2
        TIME_TO_SINT(T#200ms) = -56
        TIME_TO_BYTE(T#-1ms) = 255
        TIME_TO_DWORD(T#5s) = 5000
        DWORD_TO_TIME(16#FFFFFFFF) = T#4294967295ms
        ULINT_TO_TIME(18446744073709551615) = T#-1ms
        BOOL_TO_TIME(1) = T#1ms
        DATE_TO_UDINT(D#1970-01-02) = 86400
        UDINT_TO_DATE(100000) = D#1970-01-02
        DATE_TO_DINT(D#1969-12-31) = -86400
        DT_TO_UDINT(DT#1970-01-02-00:00:01.9) = 86401
        DT_TO_LINT(DT#1969-12-31-23:59:59.9) = -1
        UDINT_TO_DT(86401) = DT#1970-01-02-00:00:01
        LREAL_TO_DT(0.5) = DT#1970-01-01-00:00:00.5
        DT_TO_LREAL(DT#1970-01-01-00:00:00.5) = 0.5
        TOD_TO_UDINT(TOD#00:00:01.25) = 1250
        UDINT_TO_TOD(86400001) = TOD#00:00:00.001
        DINT_TO_TOD(-1) = TOD#23:59:59.999",
    );
}

/// §2.5, §9.
#[test]
fn s2_5_bcd() {
    check(
        "WORD_BCD_TO_UINT(16#1234) = 1234
        WORD_BCD_TO_UINT(16#12A4) = 0
        BCD_TO_USINT(16#99) = 99
        LWORD_BCD_TO_ULINT(16#9999999999999999) = 9999999999999999
        UINT_TO_BCD_WORD(1234) = 16#1234
        UINT_TO_BCD_WORD(51234) = 16#1234
        USINT_TO_BCD_BYTE(42) = 16#42
        TO_BCD_BYTE(142) = 16#42
        ULINT_TO_BCD_LWORD(18446744073709551615) = 16#6744073709551615
        INT_TO_BCD(-5) = 0
        IS_VALID_BCD_WORD(16#1234) = 1
        IS_VALID_BCD_WORD(16#123A) = 0
        IS_VALID_BCD_BOOL(1) = 1",
    );
}

/// §3, §4.
#[test]
fn s3_numeric() {
    check(
        "SIN_LREAL(0.5) = 0.479425538604203
        COS_LREAL(0.5) = 0.8775825618903728
        TAN_LREAL(0.5) = 0.5463024898437905
        ASIN_LREAL(0.5) = 0.5235987755982989
        ACOS_LREAL(0.5) = 1.0471975511965979
        ATAN_LREAL(0.5) = 0.4636476090008061
        ATAN2_LREAL(1, -1) = 2.356194490192345
        ATAN2_LREAL(0, 0) = 0
        ATAN2_LREAL(0, -1) = 3.141592653589793
        LN_LREAL(10) = 2.302585092994046
        LOG_LREAL(1000) = 3
        EXP_LREAL(2) = 7.38905609893065
        EXP_REAL(1) = 2.7182817
        SIN_REAL(0.5) = 0.47942555
        LN_REAL(2) = 0.6931472
        EXP_REAL(100) = inf
        LN_LREAL(0) = -inf
        LN_LREAL(-1) = NaN
        LOG_LREAL(-1) = NaN
        EXP_LREAL(1000) = inf
        SIN_LREAL(inf) = NaN
        ASIN_LREAL(1.5) = NaN
        ACOS_LREAL(-1.5) = NaN
        EXPT_LREAL(2, 10) = 1024
        EXPT_LREAL(0, 0) = 1
        EXPT_LREAL(0, -1) = inf
        EXPT_LREAL(-8, 3) = -512
        EXPT_LREAL(-8, 0.5) = NaN
        EXPT_REAL(3, 4) = 81",
    );
}

/// §7.
#[test]
fn s7_strings() {
    let cases = "LEN_STRING('ASTRING') = 7
        LEN_STRING('') = 0
        LEFT_STRING('ASTR', 3) = 'AST'
        LEFT_STRING('ASTR', 0) = ''
        LEFT_STRING('ASTR', 9) = 'ASTR'
        LEFT_STRING('ASTR', -1) = ''
        LEFT_STRING('', 3) = ''
        RIGHT_STRING('ASTR', 3) = 'STR'
        RIGHT_STRING('ASTR', 9) = 'ASTR'
        RIGHT_STRING('ASTR', -1) = ''
        MID_STRING('ASTR', 2, 2) = 'ST'
        MID_STRING('ABC', 5, 2) = 'BC'
        MID_STRING('ABC', 1, 4) = ''
        MID_STRING('ABC', 1, 0) = ''
        MID_STRING('ABC', -1, 1) = ''
        CONCAT_STRING('AB', 'CD', 'E') = 'ABCDE'
        CONCAT_STRING('AB', 'CD') = 'ABCD'
        CONCAT_STRING('', '', 'x', '') = 'x'
        CONCAT_STRING('a', 'b', 'c', 'd', 'e', 'f', 'g', 'h', 'i', 'j', 'k', 'l', 'm', 'n') = 'abcdefghijklmn'
        INSERT_STRING('ABC', 'XY', 2) = 'ABXYC'
        INSERT_STRING('SUSI', 'XY', 2) = 'SUXYSI'
        INSERT_STRING('ABC', 'X', 0) = 'XABC'
        INSERT_STRING('ABC', 'X', 3) = 'ABCX'
        INSERT_STRING('ABC', 'X', 9) = 'ABCX'
        INSERT_STRING('ABC', 'X', -1) = 'ABC'
        DELETE_STRING('ABXYC', 2, 3) = 'ABC'
        DELETE_STRING('ABC', 9, 2) = 'A'
        DELETE_STRING('ABC', 1, 4) = 'ABC'
        DELETE_STRING('ABC', 1, 0) = 'ABC'
        DELETE_STRING('ABC', 0, 1) = 'ABC'
        DELETE_STRING('ABC', -1, 1) = 'ABC'
        DELETE_STRING('ABC', 9223372036854775807, 9223372036854775807) = 'ABC'
        REPLACE_STRING('ABCDE', 'X', 2, 3) = 'ABXE'
        REPLACE_STRING('ABC', 'WXYZ', 1, 2) = 'AWXYZC'
        REPLACE_STRING('ABC', 'X', 1, 4) = 'ABCX'
        REPLACE_STRING('ABC', 'X', 1, 5) = 'ABC'
        REPLACE_STRING('ABC', 'X', 1, 0) = 'ABC'
        REPLACE_STRING('ABC', 'X', 0, 2) = 'AXBC'
        FIND_STRING('ABCBC', 'BC') = 2
        FIND_STRING('ABC', 'D') = 0
        FIND_STRING('ABC', '') = 0
        FIND_STRING('', 'A') = 0
        FIND_STRING('AB', 'ABC') = 0
        FIND_STRING('ABC', 'abc') = 0
        FIND_STRING('ABC', 'ABC') = 1";
    check(cases);
    check(&cases.replace("_STRING", "_WSTRING").replace('\'', "\""));
    check("FIND_WSTRING(\"\u{142}\u{141}A\", \"A\") = 3");
}

/// §8.
#[test]
fn s8_times() {
    check(
        "ADD_TOD_TIME(TOD#23:59:59, T#2s) = TOD#00:00:01
        SUB_TOD_TIME(TOD#00:00:01, T#2s) = TOD#23:59:59
        ADD_LTOD_LTIME(LTOD#12:00:00, LTIME#-13h) = LTOD#23:00:00
        ADD_TOD_TIME(TOD#12:00:00, 9223372036854775807) = TOD#11:47:16.854775807
        MUL_TIME_LINT(T#1s500ms, 2) = T#3s
        MUL_TIME_LREAL(T#1s, 0.3333) = T#333ms300us
        MUL_TIME_LREAL(T#1s, NaN) = 0
        DIV_TIME_LINT(T#10ms, 4) = T#2ms500us
        DIV_TIME_LINT(-7, 2) = -4
        DIV_TIME_LINT(7, -2) = -4
        DIV_TIME_LINT(5, 2) = 2
        DIV_TIME_LINT(-5, 2) = -2
        DIV_TIME_LINT(5, -2) = -2
        DIV_TIME_LINT(5, 3) = 2
        DIV_TIME_LINT(-5, 3) = -2
        DIV_TIME_LINT(5, -3) = -2
        DIV_TIME_LINT(4, -3) = -1
        DIV_TIME_LINT(T#1s, 0) = 0
        DIV_TIME_LINT(-9223372036854775808, -1) = -9223372036854775808
        DIV_TIME_LREAL(T#1s, 4) = T#250ms
        DIV_TIME_LREAL(T#1s, 0) = 0
        CONCAT_DATE_TOD(D#2024-02-29, TOD#12:30:15.5) = DT#2024-02-29-12:30:15.5
        CONCAT_DATE(2024, 2, 29) = D#2024-02-29
        CONCAT_DATE(2023, 2, 29) = D#1970-01-01
        CONCAT_DATE(9223372036854775807, 1, 1) = D#1970-01-01
        CONCAT_TOD(7, 5, 3, 250) = TOD#07:05:03.250
        CONCAT_TOD(24, 0, 0, 0) = TOD#00:00:00
        CONCAT_LTOD(0, 0, 0, 1000) = LTOD#00:00:00
        CONCAT_DT(2023, 12, 31, 23, 59, 59, 999) = DT#2023-12-31-23:59:59.999
        CONCAT_LDT(2023, 13, 31, 23, 59, 59, 999) = LDT#1970-01-01-00:00:00
        DAY_OF_WEEK(D#1970-01-01) = 4
        DAY_OF_WEEK(D#2000-02-29) = 2
        DAY_OF_WEEK(D#2024-12-31) = 2
        DT_TO_DATE(DT#2024-02-29-23:59:59) = D#2024-02-29
        DT_TO_TOD(DT#2024-02-29-23:59:59) = TOD#23:59:59
        DT_TO_TOD(DT#1969-12-31-23:00:00) = TOD#23:00:00
        DT_TO_DATE(DT#1969-12-31-23:00:00) = D#1969-12-31
        LDT_TO_LTOD(LDT#1969-12-31-23:00:00.5) = LTOD#23:00:00.5",
    );
}
