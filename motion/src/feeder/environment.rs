//! What the background half of a machine is given: files to read, a way to store some, the variables of the PLC program.
//! Runs: background.

use super::Files;
use crate::ngc::Host;
use crate::plc::{PlcError, Symbols, Variable};
use std::sync::{Arc, Mutex, PoisonError};
use takt_base::{SourceId, Sources};

/// Replaces a file as a whole or leaves it as it is; the error in words.
pub type Save = Box<dyn Fn(&str, &str) -> Result<(), String> + Send + Sync>;

/// Shared by all channels.
#[derive(Clone)]
pub struct Environment {
    /// Reads a file by name.
    pub files: Arc<Files>,
    /// Stores parameters and tool tables; without it they live until the end.
    pub save: Option<Arc<Save>>,
    /// Variables of the PLC program, if there is one.
    pub symbols: Option<Arc<dyn Symbols>>,
}

impl Environment {
    /// Reads files, and nothing else.
    pub fn reading(files: Files) -> Self {
        Self { files: Arc::new(files), save: None, symbols: None }
    }
}

/// What the interpreter of one program asks for.
pub struct ChannelHost {
    environment: Environment,
    /// Where subroutines are looked for.
    folders: Vec<String>,
    sources: Mutex<Sources>,
}

impl ChannelHost {
    /// For a program whose text is in `sources`; subroutines are looked for in its own folder, then in `subs`.
    pub fn new(environment: Environment, program: &str, subs: &[String], sources: Sources) -> Self {
        let own = program.rsplit_once('/').map_or("", |(folder, _)| folder).to_owned();
        let folders = std::iter::once(own).chain(subs.iter().cloned()).collect();
        Self { environment, folders, sources: Mutex::new(sources) }
    }

    /// The files read so far.
    pub fn sources(&self) -> Sources {
        self.sources.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

impl Host for ChannelHost {
    fn open(&self, name: &str) -> Option<(SourceId, Arc<str>)> {
        let paths = self.folders.iter().map(|f| if f.is_empty() { format!("{name}.ngc") } else { format!("{f}/{name}.ngc") });
        let (path, text) = paths.filter_map(|p| Some((p.clone(), (self.environment.files)(&p).ok()?))).next()?;
        let mut sources = self.sources.lock().unwrap_or_else(PoisonError::into_inner);
        let id = sources.add(path, &text);
        Some((id, text.into()))
    }

    fn plc(&self, path: &str) -> Option<Result<Variable, PlcError>> {
        self.environment.symbols.as_ref().map(|s| s.find(path))
    }
}
