//! The calendar of DATE and DT: proleptic Gregorian, no leap seconds, no zone. Instants are i64 nanoseconds since 1970-01-01, which
//! reach from the year 1677 to 2262. From: library reference §8.2.

use takt_image::literal_time::civil;
pub use takt_image::literal_time::day_number as days_from_date;

/// Nanoseconds in a day.
pub const DAY_NS: i64 = 86_400_000_000_000;
/// Nanoseconds in a second.
pub const SECOND_NS: i64 = 1_000_000_000;
/// Nanoseconds in a millisecond.
pub const MILLISECOND_NS: i64 = 1_000_000;

/// Year, month and day of an instant.
pub fn date_of(instant_ns: i64) -> (i64, i64, i64) {
    civil(instant_ns.div_euclid(DAY_NS))
}

/// Midnight of a day in nanoseconds since 1970-01-01; `None` if there is no such day or it can't be represented.
pub fn date_ns(year: i64, month: i64, day: i64) -> Option<i64> {
    days_from_date(year, month, day)?.checked_mul(DAY_NS)
}

/// Time of day in nanoseconds since midnight; `None` if a part is out of its range. `fraction` is in nanoseconds.
pub fn tod_ns(hour: i64, minute: i64, second: i64, fraction: i64) -> Option<i64> {
    let in_range =
        (0..24).contains(&hour) && (0..60).contains(&minute) && (0..60).contains(&second) && (0..SECOND_NS).contains(&fraction);
    in_range.then(|| ((hour * 60 + minute) * 60 + second) * SECOND_NS + fraction)
}

/// Midnight before an instant; wraps at the end of the range.
pub fn midnight_of(instant_ns: i64) -> i64 {
    instant_ns.wrapping_sub(time_of_day(instant_ns))
}

/// Nanoseconds since midnight, never negative.
pub fn time_of_day(instant_ns: i64) -> i64 {
    instant_ns.rem_euclid(DAY_NS)
}

/// 0 = Sunday to 6 = Saturday.
pub fn day_of_week(instant_ns: i64) -> i64 {
    (instant_ns.div_euclid(DAY_NS) + 4).rem_euclid(7)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_and_dates_are_inverse() {
        let mut expected = days_from_date(1677, 9, 22).unwrap_or_default();
        for year in 1677..=2262 {
            for month in 1..=12 {
                for day in 1..=31 {
                    let Some(days) = days_from_date(year, month, day) else { continue };
                    let Some(ns) = days.checked_mul(DAY_NS) else { continue };
                    assert_eq!((days, date_of(ns)), (expected, (year, month, day)));
                    assert_eq!(date_of(ns.saturating_add(DAY_NS - 1)), (year, month, day));
                    expected += 1;
                }
            }
        }
        assert_eq!(days_from_date(1970, 1, 1), Some(0));
    }

    /// Library reference §8.2.
    #[test]
    fn days_of_the_week() {
        for (y, m, d, want) in [(1970, 1, 1, 4), (2000, 2, 29, 2), (2024, 12, 31, 2), (1969, 12, 31, 3)] {
            assert_eq!(date_ns(y, m, d).map(day_of_week), Some(want));
        }
    }

    #[test]
    fn days_that_are_not_there() {
        for (y, m, d) in
            [(2023, 2, 29), (1900, 2, 29), (2024, 13, 1), (2024, 0, 1), (2024, 4, 31), (2024, 1, 0), (2500, 1, 1), (0, 1, 1)]
        {
            assert_eq!(date_ns(y, m, d), None, "{y}-{m}-{d}");
        }
        assert_eq!(tod_ns(24, 0, 0, 0), None);
        assert_eq!(tod_ns(23, 59, 59, 999_999_999), Some(DAY_NS - 1));
    }
}
