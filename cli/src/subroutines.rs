//! Files that a part program uses: subroutines, tool table, parameters, and the values of an INI file.

use crate::project::Problem;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use takt_base::{Diag, SourceId, Sources};
use takt_motion::ngc::{Host, Text};

/// Finds `NAME.ngc` in folders, and numbers of an INI file by `_ini[section]name`.
pub struct Subroutines {
    folders: Vec<PathBuf>,
    files: Mutex<Opened>,
    values: HashMap<String, f64>,
}

/// Files of a program: those that are held whole, and those that are read as they are needed.
struct Opened {
    sources: Sources,
    streamed: Vec<(SourceId, Text)>,
}

/// Opens a part program of any size; a large one has no text in `sources`.
pub fn open(path: &Path, sources: &mut Sources) -> std::io::Result<(SourceId, Text)> {
    let text = Text::open(path)?;
    Ok((sources.add(path.display().to_string(), text.whole().unwrap_or("")), text))
}

impl Subroutines {
    /// Looks in `folders`, in order; `sources` has the files read so far, `program` the one that calls.
    pub fn new(folders: Vec<PathBuf>, sources: Sources, program: (SourceId, Text), values: HashMap<String, f64>) -> Self {
        let mut opened = Opened { sources, streamed: Vec::new() };
        opened.note(program);
        Self { folders, files: Mutex::new(opened), values }
    }

    fn opened(&self) -> MutexGuard<'_, Opened> {
        self.files.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// All files read so far; of large ones the lines that `diags` show.
    pub fn sources(&self, diags: &[Diag]) -> Sources {
        let opened = self.opened();
        let mut sources = opened.sources.clone();
        let spans = diags.iter().flat_map(|d| std::iter::once(d.span).chain(d.related.iter().map(|r| r.0)));
        for place in spans.flat_map(|s| [s, s.end_point()]) {
            let text = opened.streamed.iter().find(|(id, _)| *id == place.source);
            if let Some(excerpt) = text.and_then(|(_, text)| text.excerpt(place.start)) {
                sources.add_excerpt(place.source, excerpt);
            }
        }
        sources
    }

    /// These messages with the lines that they show.
    pub fn problem(&self, diags: Vec<Diag>) -> Problem {
        let sources = self.sources(&diags);
        Problem::Diags(diags, sources)
    }
}

impl Opened {
    fn note(&mut self, (id, text): (SourceId, Text)) {
        if text.whole().is_none() {
            self.streamed.push((id, text));
        }
    }
}

impl Host for Subroutines {
    fn open_text(&self, name: &str) -> Option<(SourceId, Text)> {
        let mut opened = self.opened();
        let paths = self.folders.iter().map(|folder| folder.join(format!("{name}.ngc")));
        let (id, text) = paths.filter_map(|path| open(&path, &mut opened.sources).ok()).next()?;
        opened.note((id, text.clone()));
        Some((id, text))
    }

    fn value(&self, name: &str) -> Option<f64> {
        self.values.get(name).copied()
    }
}

/// Tool tables and parameter files.
pub mod tables {
    use crate::project::{self, Problem};
    use std::path::Path;
    use std::sync::Arc;
    use takt_base::Sources;
    use takt_motion::canon::ToolEntry;
    use takt_motion::ngc::{param, tool};

    /// Reads a tool table whose lengths are in units of `unit_mm`.
    pub fn tools(path: &Path, sources: &mut Sources, unit_mm: f64) -> Result<Arc<[ToolEntry]>, Problem> {
        let id = sources.add_bytes(path.display().to_string(), project::read(path)?);
        match tool::read(id, &sources.get(id).text, unit_mm) {
            Ok(tools) => Ok(tools.into()),
            Err(diags) => Err(Problem::Diags(diags, sources.clone())),
        }
    }

    /// Reads a parameter file.
    pub fn parameters(path: &Path, sources: &mut Sources) -> Result<Vec<(u16, f64)>, Problem> {
        let id = sources.add_bytes(path.display().to_string(), project::read(path)?);
        param::file::read(id, &sources.get(id).text).map_err(|diags| Problem::Diags(diags, sources.clone()))
    }
}
