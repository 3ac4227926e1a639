//! The tool table: `T1 P2 Z10.5 D6 I.. J.. Q.. ;comment`, one tool a row (LinuxCNC "Tool Table").
//! Runs: background. Lengths of the file are in the unit that the caller names; inside they are millimetres.

use crate::canon::ToolEntry;
use nom::character::complete::{one_of, space0};
use nom::combinator::map;
use nom::multi::many0;
use nom::number::complete::double;
use nom::sequence::preceded;
use nom::{IResult, Parser};
use std::sync::Arc;
use takt_base::{Code, Diag, SourceId, Span};

/// Tools by number. Without a table every tool is allowed and has no offsets.
#[derive(Clone, Debug)]
pub struct Table {
    tools: Option<Arc<[ToolEntry]>>,
    changed: Vec<ToolEntry>,
    spindle: ToolEntry,
}

impl Table {
    /// From a file, or without one.
    pub fn new(tools: Option<Arc<[ToolEntry]>>) -> Self {
        Table { tools, changed: Vec::new(), spindle: ToolEntry::default() }
    }

    /// The row of tool `number`.
    pub fn find(&self, number: u32) -> Option<ToolEntry> {
        if number == 0 {
            return Some(ToolEntry::default());
        }
        if let Some(entry) = self.changed.iter().find(|e| e.tool == number) {
            return Some(*entry);
        }
        match &self.tools {
            Some(tools) => tools.iter().find(|e| e.tool == number).copied(),
            None => Some(ToolEntry { tool: number, pocket: number, index: number, ..ToolEntry::default() }),
        }
    }

    /// True if there is a table.
    pub fn exists(&self) -> bool {
        self.tools.is_some() || !self.changed.is_empty()
    }

    /// Pocket of a tool, 0 if unknown.
    pub fn pocket_of(&self, number: u32) -> u32 {
        self.find(number).map_or(0, |e| e.pocket)
    }

    /// Changes a row (G10 L1).
    pub fn set(&mut self, entry: ToolEntry) {
        match self.changed.iter_mut().find(|e| e.tool == entry.tool) {
            Some(place) => *place = entry,
            None => self.changed.push(entry),
        }
    }

    /// All rows, with what the program has changed; `None` without a table.
    pub fn rows(&self) -> Option<Arc<[ToolEntry]>> {
        let tools = self.tools.as_ref()?;
        let changed = |t: &ToolEntry| self.changed.iter().find(|c| c.tool == t.tool).copied().unwrap_or(*t);
        if self.changed.is_empty() {
            return Some(tools.clone());
        }
        Some(tools.iter().map(changed).collect())
    }

    /// The tool in the spindle.
    pub fn in_spindle(&self) -> ToolEntry {
        self.spindle
    }

    /// Puts a tool into the spindle.
    pub fn load(&mut self, entry: ToolEntry) {
        self.spindle = ToolEntry { index: 0, ..entry };
    }
}

/// Reads a tool table whose lengths are in units of `unit_mm`.
///
/// # Errors
/// Every row that is no tool.
pub fn read(source: SourceId, text: &str, unit_mm: f64) -> Result<Vec<ToolEntry>, Vec<Diag>> {
    let (mut tools, mut diags, mut start) = (Vec::<ToolEntry>::new(), Vec::new(), 0);
    for line in text.split_inclusive('\n') {
        let row = line.split(';').next().unwrap_or("").trim_end();
        match entry(row.trim_start(), tools.len() as u32 + 1, unit_mm) {
            _ if row.trim().is_empty() => {}
            Some(entry) if !tools.iter().any(|t| t.tool == entry.tool) => tools.push(entry),
            _ => diags.push(bad_row(Span::new(source, start, start + row.len()))),
        }
        start += line.len();
    }
    if diags.is_empty() { Ok(tools) } else { Err(diags) }
}

fn bad_row(span: Span) -> Diag {
    Diag::new(Code::BadTable, span, "no row of a tool table")
        .help("write the number, the pocket and the offsets of a tool that stands in no other row, such as T1 P1 Z10.5 D6 ;mill")
}

fn word(input: &str) -> IResult<&str, (char, f64)> {
    preceded(space0, (map(one_of("TPDXYZABCUVWIJQtpdxyzabcuvwijq"), |c| c.to_ascii_uppercase()), double)).parse(input)
}

fn entry(row: &str, index: u32, unit_mm: f64) -> Option<ToolEntry> {
    let (rest, words) = many0(word).parse(row).ok()?;
    if !rest.trim().is_empty() || words.iter().any(|w| !w.1.is_finite()) {
        return None;
    }
    let mut entry = ToolEntry { index, ..ToolEntry::default() };
    let mut named = false;
    for (letter, value) in words {
        match letter {
            'T' => {
                entry.tool = super::word::whole(value)?;
                named = true;
            }
            'P' => entry.pocket = super::word::whole(value)?,
            'D' => entry.diameter = value * unit_mm,
            'I' => entry.front = value,
            'J' => entry.back = value,
            'Q' => entry.orientation = super::word::whole(value).filter(|&q| q <= 9)?,
            _ => {
                let axis = "XYZABCUVW".find(letter)?;
                entry.offset[axis] = if (3..6).contains(&axis) { value } else { value * unit_mm };
            }
        }
    }
    named.then_some(entry)
}

/// The table `old` with the values of `tools`: rows that have not changed stay as they are, the others keep their comment. Lengths in mm.
pub fn write(old: &str, tools: &[ToolEntry]) -> String {
    let (mut out, mut number) = (String::new(), 0);
    for line in old.split_inclusive('\n') {
        let (row, comment) = line.split_once(';').map_or((line, None), |(row, comment)| (row, Some(comment)));
        let Some(before) = entry(row.trim(), number + 1, 1.0).filter(|_| !row.trim().is_empty()) else {
            out.push_str(line);
            continue;
        };
        number += 1;
        match tools.iter().find(|t| t.tool == before.tool) {
            Some(now) if !same(now, &before) => {
                out += &row_of(now);
                let end = if line.ends_with('\n') { "\n" } else { "" };
                out += &comment.map_or_else(|| end.to_owned(), |c| format!(" ;{c}"));
            }
            _ => out.push_str(line),
        }
    }
    out
}

/// What a row says, but for rounding of the decimals that are written.
fn same(a: &ToolEntry, b: &ToolEntry) -> bool {
    row_of(a) == row_of(b)
}

fn row_of(tool: &ToolEntry) -> String {
    let mut row = format!("T{} P{}", tool.tool, tool.pocket);
    let number = |v: f64| format!("{v:+.6}");
    for (letter, value) in "XYZABCUVW".chars().zip(tool.offset).filter(|(_, v)| *v != 0.0) {
        row += &format!(" {letter}{}", number(value));
    }
    for (letter, value) in [('D', tool.diameter), ('I', tool.front), ('J', tool.back)] {
        if value != 0.0 {
            row += &format!(" {letter}{}", number(value));
        }
    }
    if tool.orientation != 0 {
        row += &format!(" Q{}", tool.orientation);
    }
    row
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Comments and rows that did not change stay; a changed row reads back as it is.
    #[test]
    fn write_changes_what_changed() {
        let old = ";my tools\nT1 P1 Z50 D6 ;mill\nt2p2z10\n";
        let mut tools = read(SourceId(0), old, 1.0).unwrap();
        assert_eq!(write(old, &tools), old);
        tools[0].offset[2] = 51.25;
        tools[0].orientation = 3;
        let new = write(old, &tools);
        assert_eq!(new, ";my tools\nT1 P1 Z+51.250000 D+6.000000 Q3 ;mill\nt2p2z10\n");
        assert_eq!(read(SourceId(0), &new, 1.0).unwrap(), tools);
    }
}
