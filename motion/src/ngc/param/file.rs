//! The parameter file: rows `number<TAB>value`, ascending (RS274/NGC §3.2.1, LinuxCNC "Parameters").

use super::LAST;
use crate::ngc::state::State;
use nom::Parser;
use nom::character::complete::{space0, space1, u16};
use nom::combinator::all_consuming;
use nom::number::complete::double;
use std::collections::BTreeSet;
use std::fmt::Write;
use takt_base::{Code, Diag, SourceId, Span};

/// Parameters that every file has.
const KEPT: [std::ops::RangeInclusive<u16>; 4] = [5161..=5169, 5181..=5189, 5210..=5220, 5221..=5390];

/// True for the numbers that every file has: of the work offsets the first ten of each twenty.
fn is_kept(index: u16) -> bool {
    KEPT.iter().any(|r| r.contains(&index)) && (index < 5221 || (index - 5221) % 20 < 10)
}

/// Reads a parameter file.
///
/// # Errors
/// Every row that is no parameter, or that is not in ascending order.
pub fn read(source: SourceId, text: &str) -> Result<Vec<(u16, f64)>, Vec<Diag>> {
    let (mut values, mut diags, mut start) = (Vec::<(u16, f64)>::new(), Vec::new(), 0);
    for line in text.split_inclusive('\n') {
        let row = line.split(['#', ';']).next().unwrap_or("").trim_end();
        match row_of(row) {
            _ if row.trim().is_empty() => {}
            Some((index, value)) if values.last().is_none_or(|last| last.0 < index) => values.push((index, value)),
            _ => diags.push(bad_row(Span::new(source, start, start + row.len()))),
        }
        start += line.len();
    }
    if diags.is_empty() { Ok(values) } else { Err(diags) }
}

fn row_of(row: &str) -> Option<(u16, f64)> {
    let parsed: nom::IResult<&str, (&str, u16, &str, f64, &str)> =
        all_consuming((space0, u16, space1, double, space0)).parse(row);
    let (_, (_, index, _, value, _)) = parsed.ok()?;
    ((1..=LAST).contains(&index) && value.is_finite()).then_some((index, value))
}

fn bad_row(span: Span) -> Diag {
    Diag::new(Code::BadTable, span, "no row of a parameter file")
        .help("write a number from 1 to 5601 and a value, such as 5221 10.5; the numbers ascend")
}

/// The file for the parameters of `state`: those that every file has, and those of the file that was read.
pub fn write(state: &State) -> String {
    write_values(|i| state.params.get(i), state.options.parameters.iter().map(|p| p.0))
}

/// The file for the values of `value`: those that every file has, and `extra`.
pub fn write_values(value: impl Fn(u16) -> f64, extra: impl Iterator<Item = u16>) -> String {
    let all: BTreeSet<u16> = (5161..=5390).filter(|&i| is_kept(i)).chain(extra).collect();
    let mut out = String::new();
    for index in all {
        let _ = writeln!(out, "{index}\t{:.6}", value(index));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ngc::{Interpreter, Options};

    #[test]
    fn what_is_written_reads_back() {
        let parameters = read(SourceId(0), "# mine\n31\t7.5\n5220 2\n5241  3\n").unwrap();
        assert_eq!(parameters, [(31, 7.5), (5220, 2.0), (5241, 3.0)]);
        let options = Options { parameters: parameters.into(), ..Options::default() };
        let mut interpreter = Interpreter::new(SourceId(0), "G10 L2 P1 X4\n#31=8\nG92 Y1\nM2", options);
        assert!(interpreter.by_ref().all(|s| s.is_ok()));
        let text = write(interpreter.state());
        assert_eq!(text.lines().count(), 119 + 1);
        for row in ["31\t8.000000", "5210\t1.000000", "5212\t-1.000000", "5220\t1.000000", "5221\t4.000000", "5241\t3.000000"] {
            assert!(text.lines().any(|r| r == row), "{row}\n{text}");
        }
        assert!(read(SourceId(0), &text).is_ok());
    }

    #[test]
    fn bad_rows_are_named() {
        for (text, start) in [("5221", 0), ("1 2\n1 3", 4), ("9999 1", 0), ("5 x", 0), ("0 1", 0), ("5 inf", 0)] {
            let diags = read(SourceId(0), text).unwrap_err();
            assert_eq!((diags[0].code, diags[0].span.start), (Code::BadTable, start), "{text}");
        }
    }
}
