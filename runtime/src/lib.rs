//! Loads an image and runs its tasks in real or virtual time; recovers from faults. See ARCHITECTURE.md.
//! Invariant: knows neither compiler nor motion; both come in as data and traits of `takt-image`.

pub mod clock;
pub mod engine;
pub mod fault;
pub mod io;
pub mod load;
mod os;
pub mod progress;
pub mod realtime;
pub mod record;
pub mod resource;
mod safe;
mod scan;
pub mod stats;
mod task;

pub use clock::{Clock, Monotonic, Virtual};
pub use engine::NativeEngine;
pub use fault::prepare as prepare_thread;
pub use io::{Driver, NoIo, SimDriver, Stimulus, StimulusError, When};
pub use load::LoadError;
pub use progress::{Progress, Snapshot};
pub use record::{FaultRecord, FaultReport};
pub use resource::{End, OnFault, Options, Resource, ScanInfo, State, Step};
pub use stats::{Histogram, TaskStats};
