//! Files that a part program uses: subroutines, tool table, parameters, and the values of an INI file.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use takt_base::{SourceId, Sources};
use takt_motion::ngc::Host;

/// Finds `NAME.ngc` in folders, and numbers of an INI file by `_ini[section]name`.
pub struct Subroutines {
    folders: Vec<PathBuf>,
    sources: Mutex<Sources>,
    values: HashMap<String, f64>,
}

impl Subroutines {
    /// Looks in `folders`, in order; `sources` has the files read so far.
    pub fn new(folders: Vec<PathBuf>, sources: Sources, values: HashMap<String, f64>) -> Self {
        Self { folders, sources: Mutex::new(sources), values }
    }

    /// All files read so far.
    pub fn sources(&self) -> Sources {
        self.sources.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

impl Host for Subroutines {
    fn open(&self, name: &str) -> Option<(SourceId, Arc<str>)> {
        if name.is_empty() || name.contains(['/', '\\', '\0']) || name.starts_with('.') {
            return None;
        }
        let paths = self.folders.iter().map(|folder| folder.join(format!("{name}.ngc")));
        let (path, bytes) = paths.filter_map(|p| Some((p.clone(), std::fs::read(p).ok()?))).next()?;
        let mut sources = self.sources.lock().unwrap_or_else(PoisonError::into_inner);
        let id = sources.add_bytes(path.display().to_string(), bytes);
        Some((id, sources.get(id).text.as_str().into()))
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
