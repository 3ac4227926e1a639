//! What the interpreter asks of its surroundings: files of subroutines, variables of the PLC program.

use super::text::Text;
use crate::plc::{PlcError, Variable};
use std::sync::Arc;
use takt_base::SourceId;

/// The surroundings. Called in the background.
pub trait Host: Send + Sync {
    /// The file of subroutine `name`, which has no path and no extension.
    fn open(&self, _name: &str) -> Option<(SourceId, Arc<str>)> {
        None
    }
    /// The same for a file of any size; what the interpreter calls.
    fn open_text(&self, name: &str) -> Option<(SourceId, Text)> {
        self.open(name).map(|(source, text)| (source, text.into()))
    }
    /// The PLC variable of a path, which is what stands behind `_plc_`; `None`: there is no PLC program.
    fn plc(&self, _path: &str) -> Option<Result<Variable, PlcError>> {
        None
    }
    /// Value of a named parameter such as `_ini[axis]max`.
    fn value(&self, _name: &str) -> Option<f64> {
        None
    }
    /// Sets it; false if that is not allowed.
    fn set_value(&self, _name: &str, _value: f64) -> bool {
        false
    }
}

/// A host, or none.
#[derive(Clone, Default)]
pub struct HostRef(Option<Arc<dyn Host>>);

/// A name that leads out of no folder.
fn is_plain(name: &str) -> bool {
    !(name.is_empty() || name.contains(['/', '\\', '\0']) || name.starts_with('.'))
}

impl HostRef {
    /// With a host.
    pub fn new(host: Arc<dyn Host>) -> Self {
        HostRef(Some(host))
    }
    /// See [`Host::open_text`].
    pub fn open_text(&self, name: &str) -> Option<(SourceId, Text)> {
        self.0.as_ref().filter(|_| is_plain(name))?.open_text(name)
    }
    /// See [`Host::plc`].
    pub fn plc(&self, path: &str) -> Option<Result<Variable, PlcError>> {
        self.0.as_ref()?.plc(path)
    }
    /// See [`Host::value`].
    pub fn value(&self, name: &str) -> Option<f64> {
        self.0.as_ref()?.value(name)
    }
    /// See [`Host::set_value`].
    pub fn set_value(&self, name: &str, value: f64) -> bool {
        self.0.as_ref().is_some_and(|host| host.set_value(name, value))
    }
}

impl PartialEq for HostRef {
    fn eq(&self, other: &Self) -> bool {
        match (&self.0, &other.0) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            (None, None) => true,
            _ => false,
        }
    }
}

impl std::fmt::Debug for HostRef {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(if self.0.is_some() { "Host" } else { "no host" })
    }
}
