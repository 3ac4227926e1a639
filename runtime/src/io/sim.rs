//! Simulated inputs: values for variables at given times or scans, from a CSV file or one by one.
//!
//! ```text
//! time, %IX0.0, main.setpoint          or   scan, %IX0.0, main.setpoint
//! 0,    TRUE,   12.5                        1,    TRUE,   12.5
//! 1s500ms, ,    20.0                        10,   ,       20.0
//! ```
//! A value is written once, before the first scan at or after its row, and stays until something else writes. A blank cell changes
//! nothing. Times are durations (`1s500ms`, `T#2s`) or numbers of seconds. Lines that begin with `#` are comments.

use super::driver::Driver;
use takt_base::{Code, Nanos};
use takt_image::literal::parse_real;
use takt_image::literal_time::parse_time;
use takt_image::path::{self, Variable};
use takt_image::{AccessError, Elementary, Image, Patch};

/// When a value is written.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum When {
    /// Before the first scan at or after this time.
    Time(Nanos),
    /// Before this scan, from 1.
    Scan(u64),
}

/// What is wrong with a stimulus file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct StimulusError {
    /// Line from 1.
    pub line: u32,
    /// Cell of the line, from 1; 0 if it is the line as a whole.
    pub cell: u32,
    /// Which rule.
    pub code: Code,
    /// What is wrong.
    pub message: String,
    /// What to do.
    pub help: Option<String>,
}

impl StimulusError {
    fn new(line: u32, cell: usize, message: impl Into<String>, help: &str) -> Self {
        Self { line, cell: cell as u32, code: Code::BadStimulus, message: message.into(), help: Some(help.into()) }
    }
    fn of(line: u32, cell: usize, e: AccessError) -> Self {
        Self { line, cell: cell as u32, code: e.code, message: e.message, help: e.help }
    }
}

impl std::fmt::Display for StimulusError {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "line {}: {}", self.line, self.message)
    }
}

/// Values and when they are written, in order. Applying allocates nothing.
#[derive(Clone, Default, Debug, PartialEq)]
pub struct Stimulus {
    by_time: Queue<Nanos>,
    by_scan: Queue<u64>,
}

/// Values in order of their keys, and how many were applied.
#[derive(Clone, Default, Debug, PartialEq)]
struct Queue<K> {
    items: Vec<(K, Patch)>,
    done: usize,
}

impl<K: Ord + Copy> Queue<K> {
    /// Behind all others of the same key.
    fn push(&mut self, key: K, patch: Patch) {
        let at = self.items.partition_point(|(k, _)| *k <= key).max(self.done);
        self.items.insert(at, (key, patch));
    }
    fn apply(&mut self, key: K, memory: &mut [u8]) {
        while let Some((_, patch)) = self.items.get(self.done).filter(|(k, _)| *k <= key) {
            patch.apply(memory);
            self.done += 1;
        }
    }
}

impl Stimulus {
    /// Adds a value; of several at the same moment the last one added wins.
    pub fn push(&mut self, when: When, patch: Patch) {
        match when {
            When::Time(t) => self.by_time.push(t, patch),
            When::Scan(n) => self.by_scan.push(n, patch),
        }
    }

    /// Writes everything that is due before scan `scan` at `now`. Runs: cyclic.
    pub fn apply(&mut self, now: Nanos, scan: u64, memory: &mut [u8]) {
        self.by_time.apply(now, memory);
        self.by_scan.apply(scan, memory);
    }

    /// Reads a CSV file. All errors are reported, at most 20.
    pub fn from_csv(image: &Image, text: &str) -> Result<Self, Vec<StimulusError>> {
        let mut errors = Vec::new();
        let mut lines = (1..).zip(text.trim_start_matches('\u{feff}').lines()).filter(|(_, l)| !skipped(l));
        let Some((n, head)) = lines.next() else {
            return Err(vec![StimulusError::new(1, 0, "the file is empty", HEAD_HELP)]);
        };
        let head = Head::new(image, n, head, &mut errors);
        let mut stimulus = Self::default();
        if let Some(mut head) = head {
            lines.for_each(|(n, line)| head.row(image, n, line, &mut stimulus, &mut errors));
        }
        errors.truncate(20);
        if errors.is_empty() { Ok(stimulus) } else { Err(errors) }
    }
}

const HEAD_HELP: &str = "begin with a line such as `time,%IX0.0,main.speed` or `scan,%IX0.0`";

fn skipped(line: &str) -> bool {
    line.trim().is_empty() || line.trim_start().starts_with('#')
}

/// The first line: what the rows count, and the variable of each column.
struct Head {
    by_time: bool,
    columns: Vec<Option<Variable>>,
    last: i64,
}

impl Head {
    fn new(image: &Image, line: u32, text: &str, errors: &mut Vec<StimulusError>) -> Option<Self> {
        let cells = cells(line, text).map_err(|e| errors.push(e)).ok()?;
        let by_time = cells[0].eq_ignore_ascii_case("time");
        if !by_time && !cells[0].eq_ignore_ascii_case("scan") {
            errors.push(StimulusError::new(
                line,
                1,
                format!("the first column is `{}`, not `time` or `scan`", cells[0]),
                HEAD_HELP,
            ));
            return None;
        }
        let mut column = |(i, name): (usize, &String)| match path::resolve(image, name) {
            Ok(v) => Some(v),
            Err(e) => {
                errors.push(StimulusError::of(line, i + 1, e));
                None
            }
        };
        let columns = cells.iter().enumerate().skip(1).map(&mut column).collect();
        Some(Self { by_time, columns, last: i64::MIN })
    }

    fn row(&mut self, image: &Image, line: u32, text: &str, to: &mut Stimulus, errors: &mut Vec<StimulusError>) {
        let cells = match cells(line, text) {
            Ok(cells) => cells,
            Err(e) => return errors.push(e),
        };
        if cells.len() > self.columns.len() + 1 {
            let message = format!("{} cells, but the first line names {}", cells.len(), self.columns.len() + 1);
            return errors.push(StimulusError::new(line, 0, message, "put text with commas in double quotes"));
        }
        let when = match self.when(line, &cells[0]) {
            Ok(when) => when,
            Err(e) => return errors.push(e),
        };
        for (i, (cell, variable)) in cells[1..].iter().zip(&self.columns).enumerate() {
            let Some(v) = variable.as_ref().filter(|_| !cell.is_empty()) else { continue };
            match Patch::for_variable(image, v, cell) {
                Ok(patch) => to.push(when, patch),
                Err(e) => errors.push(StimulusError::of(line, i + 2, e)),
            }
        }
    }

    fn when(&mut self, line: u32, cell: &str) -> Result<When, StimulusError> {
        let when = if self.by_time { time(cell).map(When::Time) } else { cell.parse().ok().filter(|&n| n > 0).map(When::Scan) };
        let help = if self.by_time { "write a time such as 1s500ms or 1.5 (seconds)" } else { "scans count from 1" };
        let when = when.ok_or_else(|| StimulusError::new(line, 1, format!("`{cell}` is not a {}", self.unit()), help))?;
        let key = match when {
            When::Time(t) => t.0,
            When::Scan(n) => i64::try_from(n).unwrap_or(i64::MAX),
        };
        if key < std::mem::replace(&mut self.last, key) {
            return Err(StimulusError::new(line, 1, format!("{} {cell} comes after a later one", self.unit()), "sort the rows"));
        }
        Ok(when)
    }

    fn unit(&self) -> &'static str {
        if self.by_time { "time" } else { "scan" }
    }
}

/// A duration, or a number of seconds.
fn time(cell: &str) -> Option<Nanos> {
    let seconds = || parse_real(cell).filter(|s| s.is_finite() && s.abs() < 9e9).map(Nanos::from_secs_round);
    seconds().or_else(|| parse_time(Elementary::Time, cell).map(Nanos)).filter(|t| t.0 >= 0)
}

/// The cells of a line, trimmed; double quotes keep commas, and stand doubled for themselves.
fn cells(line: u32, text: &str) -> Result<Vec<String>, StimulusError> {
    let (mut cells, mut cell, mut quoted) = (Vec::new(), String::new(), false);
    let mut chars = text.chars().peekable();
    while let Some(c) = chars.next() {
        match c {
            '"' if quoted && chars.peek() == Some(&'"') => cell.extend(chars.next()),
            '"' if quoted || cell.trim().is_empty() => quoted = !quoted,
            ',' if !quoted => cells.push(std::mem::take(&mut cell).trim().to_owned()),
            c => cell.push(c),
        }
    }
    cells.push(cell.trim().to_owned());
    if quoted {
        return Err(StimulusError::new(line, 0, "a quote is not closed", "close it, or double it inside of a quoted cell"));
    }
    Ok(cells)
}

/// A driver without a world: the stimulus is the inputs, and the outputs go nowhere.
#[derive(Default)]
pub struct SimDriver {
    /// What is written when.
    pub stimulus: Stimulus,
}

impl SimDriver {
    /// With a stimulus.
    pub fn new(stimulus: Stimulus) -> Self {
        Self { stimulus }
    }
}

impl Driver for SimDriver {
    fn read_inputs(&mut self, _: Nanos, _: u64, _: &mut [u8]) {}
    fn write_outputs(&mut self, _: Nanos, _: &[u8]) {}
    fn force(&mut self, now: Nanos, scan: u64, memory: &mut [u8]) {
        self.stimulus.apply(now, scan, memory);
    }
}

#[cfg(test)]
mod tests;
