//! Part programs in RS274/NGC: text to canonical commands (PC-02, PC-05, R1-32..R1-103).
//!
//! One pass, block by block: `lines` cuts the text into blocks, [`block`] reads words and comments, `request` sorts the words by
//! modal group and checks that each is used, `execute` runs them in the order of RS274/NGC against the [`modal`] state, and
//! [`interpreter`] hands out the commands. Runs: background.

pub mod arc;
pub mod block;
mod execute;
pub mod interpreter;
mod limits;
pub mod lines;
pub mod modal;
mod motion;
mod number;
pub mod options;
mod request;
pub mod word;

pub use interpreter::{Interpreter, check};
pub use lines::Style;
pub use modal::{Distance, Modal, Motion};
pub use options::{Options, Travel};
