//! What a function block does scan by scan, as tables that people read (`conformance/iec/blocks/*.md`):
//!
//! ```text
//! ## TON PT=T#25ms
//!
//! | scan      | 0 | 1 | 2  |      one column is one call of a fresh instance, every 10 ms
//! |---|---|---|---|
//! | in IN     | 0 | 1 | 1  |      inputs before the call
//! | out Q     | 0 | 0 | 0  |      outputs after it
//! | out ET ms | 0 | 0 | 10 |      a unit: values are durations, or instants since 1970, in it
//! ```
//!
//! The heading names the block and inputs that stay constant, as literals. An optional unit follows the name of a row.

pub use crate::markdown::TableError;
use crate::markdown::{Section, sections};

/// Time between two scans in milliseconds.
pub const CYCLE_MS: i64 = 10;

/// One table.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct CycleTable {
    /// Line of the heading, from 1.
    pub line: usize,
    /// Type of the block.
    pub block: String,
    /// Constant inputs: name and literal.
    pub constants: Vec<(String, String)>,
    /// Inputs that change.
    pub inputs: Vec<Row>,
    /// Expected outputs.
    pub outputs: Vec<Row>,
    /// Number of calls.
    pub scans: usize,
}

/// An input or output over all scans.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Row {
    /// Name of the input or output.
    pub name: String,
    /// Unit of the values (`ms`), if they are durations or dates.
    pub unit: Option<String>,
    /// One per scan, as written: an integer, a decimal fraction, 0 or 1 for BOOL.
    pub values: Vec<String>,
}

impl Row {
    /// The value of a scan as a number: durations and dates in nanoseconds.
    pub fn number(&self, scan: usize) -> Option<f64> {
        let value: f64 = self.values.get(scan)?.parse().ok()?;
        Some(if self.unit.is_some() { value * 1e6 } else { value })
    }
}

/// Reads all tables of a file.
pub fn parse(text: &str) -> Result<Vec<CycleTable>, TableError> {
    sections(text)?.iter().map(table).collect()
}

fn table(section: &Section) -> Result<CycleTable, TableError> {
    let mut words = section.heading.split_whitespace();
    let block = words.next().unwrap_or_default().to_owned();
    let constants = words.map(|word| constant(section.line, word)).collect::<Result<_, _>>()?;
    let mut table = CycleTable { line: section.line, block, constants, inputs: vec![], outputs: vec![], scans: 0 };
    let Some(((line, header), rows)) = section.rows.split_first() else { return Ok(table) };
    table.scans = scans(*line, header)?;
    for (line, cells) in rows {
        row(&mut table, *line, cells)?;
    }
    if table.outputs.is_empty() {
        return Err(TableError::new(section.line, "no output is expected"));
    }
    Ok(table)
}

fn constant(line: usize, word: &str) -> Result<(String, String), TableError> {
    let (name, literal) = word.split_once('=').ok_or_else(|| TableError::new(line, format!("`{word}` is not NAME=LITERAL")))?;
    Ok((name.to_owned(), literal.to_owned()))
}

/// The header counts the scans from 0.
fn scans(line: usize, header: &[&str]) -> Result<usize, TableError> {
    let counts = header.iter().skip(1).enumerate().all(|(i, cell)| *cell == i.to_string());
    if header.first() != Some(&"scan") || !counts {
        return Err(TableError::new(line, "the header is not `scan`, 0, 1, ..."));
    }
    Ok(header.len() - 1)
}

fn row(table: &mut CycleTable, line: usize, cells: &[&str]) -> Result<(), TableError> {
    let (label, values) = cells.split_first().ok_or_else(|| TableError::new(line, "empty row"))?;
    let words: Vec<&str> = label.split_whitespace().collect();
    let (side, name, unit) = match words[..] {
        ["in", name] => (&mut table.inputs, name, None),
        ["in", name, "ms"] => (&mut table.inputs, name, Some("ms")),
        ["out", name] => (&mut table.outputs, name, None),
        ["out", name, "ms"] => (&mut table.outputs, name, Some("ms")),
        _ => return Err(TableError::new(line, format!("`{label}` is not `in NAME`, `out NAME` or the same with `ms`"))),
    };
    if let Some(bad) = values.iter().find(|v| v.parse::<f64>().is_err()) {
        return Err(TableError::new(line, format!("`{bad}` is not a number")));
    }
    let values = values.iter().map(|&v| v.to_owned()).collect();
    side.push(Row { name: name.to_owned(), unit: unit.map(str::to_owned), values });
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TON: &str = "# Timers\n\nProse.\n\n## TON PT=T#25ms X=-1\n\nMore.\n\n| scan | 0 | 1 |\n|---|---|---|\n| in IN | 0 | 1 |\n\
        | out Q | 0 | 1.5 |\n| out ET ms | 0 | 10 |\n\n## SR\n| scan | 0 |\n| out Q1 | 0 |\n";

    #[test]
    fn a_table_is_read() {
        let tables = parse(TON).unwrap();
        assert_eq!(tables.len(), 2);
        let ton = &tables[0];
        assert_eq!((ton.line, ton.block.as_str(), ton.scans), (5, "TON", 2));
        assert_eq!(ton.constants, [("PT".to_owned(), "T#25ms".to_owned()), ("X".to_owned(), "-1".to_owned())]);
        assert_eq!(ton.inputs.len(), 1);
        assert_eq!(ton.outputs[0].number(1), Some(1.5));
        assert_eq!(ton.outputs[1].number(1), Some(1e7));
        assert_eq!(ton.outputs[1].number(2), None);
        assert_eq!(tables[1].block, "SR");
    }

    #[test]
    fn mistakes_have_a_place() {
        for (text, line, message) in [
            ("| scan | 0 |", 1, "table without a heading"),
            ("## A\n\n## B\n", 1, "`A` has no table"),
            ("## A\n| scan | 0 |\n| out Q | 0 | 1 |", 3, "3 cells, but the header has 2"),
            ("## A\n| scan | 1 |\n| out Q | 0 |", 2, "the header is not `scan`, 0, 1, ..."),
            ("## A\n| scan | 0 |\n| Q | 0 |", 3, "`Q` is not `in NAME`, `out NAME` or the same with `ms`"),
            ("## A\n| scan | 0 |\n| out Q | x |", 3, "`x` is not a number"),
            ("## A\n| scan | 0 |\n| in Q | 0 |", 1, "no output is expected"),
            ("## A PT\n| scan | 0 |\n| in Q | 0 |", 1, "`PT` is not NAME=LITERAL"),
        ] {
            assert_eq!(parse(text), Err(TableError::new(line, message)), "{text}");
        }
    }
}
