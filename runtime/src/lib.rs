//! Loads an image and runs its tasks in real or virtual time; recovers from faults. See ARCHITECTURE.md.
//! Invariant: knows neither compiler nor motion; both come in as data and traits of `takt-image`.

pub mod engine;
pub mod fault;
pub mod load;

pub use engine::NativeEngine;
pub use fault::prepare as prepare_thread;
pub use load::LoadError;
