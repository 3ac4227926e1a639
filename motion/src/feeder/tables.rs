//! Parameters and tools of a channel: read from their files, handed to each program, kept from what programs did, stored when a program
//! has ended.
//! Runs: background. What a program has changed counts from the synchronisation point or end that it has reached, not from when it was
//! read ahead. From: RS274/NGC §3.2.1, LinuxCNC "Parameters", "Tool Table".

use super::environment::Environment;
use crate::canon::ToolEntry;
use crate::ngc::param::file;
use crate::ngc::tool;
use crate::segment::ErrorNote;
use std::sync::Arc;
use takt_base::{Code, Diag, Sources};

/// What outlives a program.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Kept {
    /// Numbered parameters that are not 0.
    pub parameters: Arc<[(u16, f64)]>,
    /// The tool table, if there is one.
    pub tools: Option<Arc<[ToolEntry]>>,
    /// Tool in the spindle.
    pub tool: u32,
}

/// A file and its text as last read or written.
#[derive(Clone, Debug, Default)]
struct Stored {
    name: Option<String>,
    text: Option<String>,
}

/// The tables of a channel.
#[derive(Clone, Debug, Default)]
pub struct Tables {
    /// In force.
    pub kept: Kept,
    parameters: Stored,
    tools: Stored,
    /// Parameters that the file has beyond those that every file has.
    extra: Vec<u16>,
}

impl Tables {
    /// With these files.
    pub fn new(parameter_file: Option<String>, tool_table: Option<String>) -> Self {
        let stored = |name| Stored { name, text: None };
        Self { parameters: stored(parameter_file), tools: stored(tool_table), ..Self::default() }
    }

    /// Reads the files that are new or have changed.
    ///
    /// # Errors
    /// F0626 with the first row that can't be read. A parameter file that does not exist is empty.
    pub fn refresh(&mut self, environment: &Environment) -> Result<(), Box<ErrorNote>> {
        if let Some(name) = self.parameters.name.clone() {
            let text = (environment.files)(&name).unwrap_or_default();
            if self.parameters.text.as_ref() != Some(&text) {
                let mut sources = Sources::new();
                let id = sources.add(name.clone(), &text);
                let values = file::read(id, &text).map_err(|diags| bad_row(&diags, &sources, &name))?;
                self.extra = values.iter().map(|v| v.0).collect();
                self.kept.parameters = values.into();
                self.parameters.text = Some(text);
            }
        }
        if let Some(name) = self.tools.name.clone() {
            let text = (environment.files)(&name)
                .map_err(|why| Box::new(ErrorNote::new(Code::TableFile, 0, 0, &format!("{name}: {why}"))))?;
            if self.tools.text.as_ref() != Some(&text) {
                let mut sources = Sources::new();
                let id = sources.add(name.clone(), &text);
                let tools = tool::read(id, &text, 1.0).map_err(|diags| bad_row(&diags, &sources, &name))?;
                self.kept.tools = Some(tools.into());
                self.tools.text = Some(text);
            }
        }
        Ok(())
    }

    /// Stores what differs from the files.
    ///
    /// # Errors
    /// F0625; the old files stay.
    pub fn store(&mut self, environment: &Environment) -> Result<(), Box<ErrorNote>> {
        let Some(save) = &environment.save else { return Ok(()) };
        let failed = |name: &str, why: String| Box::new(ErrorNote::new(Code::KeptFile, 0, 0, &format!("{name}: {why}")));
        if let (Some(name), Some(old)) = (&self.parameters.name, &self.parameters.text) {
            let value = |i: u16| self.kept.parameters.iter().find(|p| p.0 == i).map_or(0.0, |p| p.1);
            let text = file::write_values(value, self.extra.iter().copied());
            if text != *old && !(old.is_empty() && self.kept.parameters.is_empty()) {
                save(name, &text).map_err(|why| failed(name, why))?;
                self.parameters.text = Some(text);
            }
        }
        if let (Some(name), Some(old), Some(tools)) = (&self.tools.name, &self.tools.text, &self.kept.tools) {
            let text = tool::write(old, tools);
            if text != *old {
                save(name, &text).map_err(|why| failed(name, why))?;
                self.tools.text = Some(text);
            }
        }
        Ok(())
    }
}

fn bad_row(diags: &[Diag], sources: &Sources, name: &str) -> Box<ErrorNote> {
    let Some(first) = diags.first() else { return Box::new(ErrorNote::new(Code::TableFile, 0, 0, name)) };
    let at = sources.line_col(first.span.source, first.span.start);
    Box::new(ErrorNote::new(Code::TableFile, at.line, at.column, &format!("{name}: {}", first.label)))
}
