//! Where inputs come from and outputs go.

pub mod driver;
pub mod sim;

pub use driver::{Driver, NoIo};
pub use sim::{SimDriver, Stimulus, StimulusError, When};
