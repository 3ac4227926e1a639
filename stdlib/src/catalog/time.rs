//! Functions of durations and dates. All are i64 nanoseconds; dates count from 1970-01-01, times of day from midnight.
//! ADD_TIME, SUB_TIME and their L forms are typed names of ADD and SUB. From: library reference §8.

use super::Intrinsic::{Add, Div, Mul, Now, Sub};
use super::Lowering::{Inline, Native};
use super::Pattern::{Is, Own};
use super::{Function, Pattern, f, p};
use takt_image::{Elementary as E, Generic as G};

const TIME: Pattern = Is(E::Time);
const LTIME: Pattern = Is(E::Ltime);
const TOD: Pattern = Is(E::Tod);
const LTOD: Pattern = Is(E::Ltod);
const DATE: Pattern = Is(E::Date);
const LDATE: Pattern = Is(E::Ldate);
const DT: Pattern = Is(E::Dt);
const LDT: Pattern = Is(E::Ldt);
const INT: Pattern = Own(G::AnyInt);
const NUM: Pattern = Own(G::AnyNum);

macro_rules! two {
    ($a:expr, $b:expr) => {
        &[p("IN1", $a), p("IN2", $b)]
    };
}

/// The table.
pub const FUNCTIONS: &[Function] = &[
    f("TIME", &[], TIME, Inline(Now), "Time sample of the activation: since the start of the controller"),
    f("LTIME", &[], LTIME, Inline(Now), "Time sample of the activation: since the start of the controller"),
    f("ADD_TOD_TIME", two!(TOD, TIME), TOD, Native, "Time of day after a duration, modulo 24 h"),
    f("ADD_LTOD_LTIME", two!(LTOD, LTIME), LTOD, Native, "Time of day after a duration, modulo 24 h"),
    f("ADD_DT_TIME", two!(DT, TIME), DT, Inline(Add), "Instant after a duration"),
    f("ADD_LDT_LTIME", two!(LDT, LTIME), LDT, Inline(Add), "Instant after a duration"),
    f("SUB_DATE_DATE", two!(DATE, DATE), TIME, Inline(Sub), "Duration from IN2 to IN1"),
    f("SUB_LDATE_LDATE", two!(LDATE, LDATE), LTIME, Inline(Sub), "Duration from IN2 to IN1"),
    f("SUB_TOD_TIME", two!(TOD, TIME), TOD, Native, "Time of day before a duration, modulo 24 h"),
    f("SUB_LTOD_LTIME", two!(LTOD, LTIME), LTOD, Native, "Time of day before a duration, modulo 24 h"),
    f("SUB_TOD_TOD", two!(TOD, TOD), TIME, Inline(Sub), "Duration from IN2 to IN1"),
    f("SUB_LTOD_LTOD", two!(LTOD, LTOD), LTIME, Inline(Sub), "Duration from IN2 to IN1"),
    f("SUB_DT_TIME", two!(DT, TIME), DT, Inline(Sub), "Instant before a duration"),
    f("SUB_LDT_LTIME", two!(LDT, LTIME), LDT, Inline(Sub), "Instant before a duration"),
    f("SUB_DT_DT", two!(DT, DT), TIME, Inline(Sub), "Duration from IN2 to IN1"),
    f("SUB_LDT_LDT", two!(LDT, LDT), LTIME, Inline(Sub), "Duration from IN2 to IN1"),
    f("MUL_TIME", two!(TIME, NUM), TIME, Inline(Mul), "Duration times a number, to the nearest nanosecond"),
    f("MUL_LTIME", two!(LTIME, NUM), LTIME, Inline(Mul), "Duration times a number, to the nearest nanosecond"),
    f("MULTIME", two!(TIME, NUM), TIME, Inline(Mul), "MUL_TIME of edition 2"),
    f("DIV_TIME", two!(TIME, NUM), TIME, Inline(Div), "Duration divided by a number, to the nearest nanosecond"),
    f("DIV_LTIME", two!(LTIME, NUM), LTIME, Inline(Div), "Duration divided by a number, to the nearest nanosecond"),
    f("DIVTIME", two!(TIME, NUM), TIME, Inline(Div), "DIV_TIME of edition 2"),
    f("CONCAT_DATE_TOD", &[p("DATE", DATE), p("TOD", TOD)], DT, Native, "Instant from date and time of day"),
    f("CONCAT_DATE_LTOD", &[p("DATE", DATE), p("LTOD", LTOD)], LDT, Native, "Instant from date and time of day"),
    f("CONCAT_DATE", &[p("YEAR", INT), p("MONTH", INT), p("DAY", INT)], DATE, Native, "Date; 1970-01-01 if there is no such day"),
    f("CONCAT_TOD", CLOCK, TOD, Native, "Time of day; 00:00 if there is no such time"),
    f("CONCAT_LTOD", CLOCK, LTOD, Native, "Time of day; 00:00 if there is no such time"),
    f("CONCAT_DT", CALENDAR, DT, Native, "Instant; 1970-01-01-00:00 if there is no such day or time"),
    f("CONCAT_LDT", CALENDAR, LDT, Native, "Instant; 1970-01-01-00:00 if there is no such day or time"),
    f("DAY_OF_WEEK", &[p("IN", DATE)], Is(E::Int), Native, "0 = Sunday to 6 = Saturday"),
];

const CLOCK: &[super::Param] = &[p("HOUR", INT), p("MINUTE", INT), p("SECOND", INT), p("MILLISECOND", INT)];
const CALENDAR: &[super::Param] =
    &[p("YEAR", INT), p("MONTH", INT), p("DAY", INT), p("HOUR", INT), p("MINUTE", INT), p("SECOND", INT), p("MILLISECOND", INT)];
