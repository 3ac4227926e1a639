//! The part of Markdown that case files use: `## ` headings and the tables below them. Everything else is prose.

/// Why a case file can't be read, and where.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct TableError {
    /// From 1.
    pub line: usize,
    /// What is wrong.
    pub message: String,
}

impl TableError {
    pub(crate) fn new(line: usize, message: impl Into<String>) -> Self {
        Self { line, message: message.into() }
    }
}

/// A heading with its table.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Section<'a> {
    /// Line of the heading, from 1.
    pub line: usize,
    /// Without `## `.
    pub heading: &'a str,
    /// Rows with their line; the first is the header, the rule below it is left out.
    pub rows: Vec<(usize, Vec<&'a str>)>,
}

/// All sections in order. A section without a table, a table without a heading and rows of different length are errors.
pub(crate) fn sections(text: &str) -> Result<Vec<Section<'_>>, TableError> {
    let mut sections: Vec<Section> = Vec::new();
    for (i, line) in text.lines().enumerate() {
        let (number, line) = (i + 1, line.trim());
        if let Some(heading) = line.strip_prefix("## ") {
            sections.push(Section { line: number, heading: heading.trim(), rows: Vec::new() });
        } else if let Some(cells) = cells(line) {
            let section = sections.last_mut().ok_or_else(|| TableError::new(number, "table without a heading"))?;
            section.add(number, cells)?;
        }
    }
    match sections.iter().find(|s| s.rows.len() < 2) {
        Some(empty) => Err(TableError::new(empty.line, format!("`{}` has no table", empty.heading))),
        None => Ok(sections),
    }
}

impl<'a> Section<'a> {
    fn add(&mut self, line: usize, cells: Vec<&'a str>) -> Result<(), TableError> {
        if cells.iter().all(|c| !c.is_empty() && c.bytes().all(|b| b == b'-')) {
            return Ok(());
        }
        if let Some((_, first)) = self.rows.first()
            && first.len() != cells.len()
        {
            return Err(TableError::new(line, format!("{} cells, but the header has {}", cells.len(), first.len())));
        }
        self.rows.push((line, cells));
        Ok(())
    }
}

/// The cells of a table row.
fn cells(line: &str) -> Option<Vec<&str>> {
    let inner = line.strip_prefix('|')?.strip_suffix('|')?;
    Some(inner.split('|').map(str::trim).collect())
}
