//! Functions of durations and dates that are more than an addition. A part that is out of its range gives 1970-01-01 or 00:00.
//! From: library reference §8.
//! Runs: cyclic.

use super::Run;
use crate::calendar::{DAY_NS, MILLISECOND_NS, SECOND_NS, date_ns, day_of_week, tod_ns};
use takt_image::{NativeCall, Trap};

/// Code by catalogue name.
pub(super) const RUNS: &[(&str, Run)] = &[
    ("ADD_TOD_TIME", |call, _| tod_plus(call, 1)),
    ("ADD_LTOD_LTIME", |call, _| tod_plus(call, 1)),
    ("SUB_TOD_TIME", |call, _| tod_plus(call, -1)),
    ("SUB_LTOD_LTIME", |call, _| tod_plus(call, -1)),
    ("CONCAT_DATE_TOD", |call, _| date_plus_tod(call)),
    ("CONCAT_DATE_LTOD", |call, _| date_plus_tod(call)),
    ("CONCAT_DATE", |call, _| give(call, date(call, 0))),
    ("CONCAT_TOD", |call, _| give(call, tod(call, 0))),
    ("CONCAT_LTOD", |call, _| give(call, tod(call, 0))),
    ("CONCAT_DT", |call, _| give(call, instant(call))),
    ("CONCAT_LDT", |call, _| give(call, instant(call))),
    ("DAY_OF_WEEK", |call, _| give(call, Some(day_of_week(call.i64(0))))),
];

fn give(call: &mut NativeCall, value: Option<i64>) -> Result<(), Trap> {
    if value.is_none() {
        call.fail();
    }
    call.result = value.unwrap_or(0) as u64;
    Ok(())
}

/// Modulo 24 h.
fn tod_plus(call: &mut NativeCall, sign: i128) -> Result<(), Trap> {
    let sum = i128::from(call.i64(0)) + sign * i128::from(call.i64(1));
    if !(0..i128::from(DAY_NS)).contains(&sum) {
        call.fail();
    }
    give(call, Some(sum.rem_euclid(i128::from(DAY_NS)) as i64))
}

fn date_plus_tod(call: &mut NativeCall) -> Result<(), Trap> {
    give(call, Some(call.i64(0).wrapping_add(call.i64(1))))
}

/// Year, month and day from slot `i` on.
fn date(call: &NativeCall, i: usize) -> Option<i64> {
    date_ns(call.i64(i), call.i64(i + 1), call.i64(i + 2))
}

/// Hour, minute, second and millisecond from slot `i` on.
fn tod(call: &NativeCall, i: usize) -> Option<i64> {
    let milliseconds = Some(call.i64(i + 3)).filter(|ms| (0..SECOND_NS / MILLISECOND_NS).contains(ms))?;
    tod_ns(call.i64(i), call.i64(i + 1), call.i64(i + 2), milliseconds * MILLISECOND_NS)
}

fn instant(call: &NativeCall) -> Option<i64> {
    date(call, 0)?.checked_add(tod(call, 3)?)
}
