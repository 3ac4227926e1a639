//! Part programs in RS274/NGC: text to canonical commands (PC-02, PC-05, R1-32..R1-103).
//!
//! Row by row: `lines` cuts the text, [`reader`] compiles a row into [`code`], [`flow`] follows O words and calls, [`request`] computes
//! the words and sorts them by modal group, [`execute`] runs them in the order of RS274/NGC against [`state`], and [`interpreter`]
//! hands out the commands. Rows of loops and subroutines are compiled once. Runs: background.

pub mod arc;
pub mod code;
pub mod comp;
mod contour;
pub mod cycle;
pub mod execute;
pub mod expr;
pub mod fanuc;
pub mod fault;
pub mod flow;
pub mod host;
pub mod interpreter;
mod lenient;
mod limits;
pub mod lines;
pub mod modal;
pub mod motion;
mod number;
pub mod options;
pub mod outside;
pub mod oword;
pub mod param;
pub mod reader;
pub mod request;
pub mod state;
pub mod text;
pub mod tool;
pub mod turning;
pub mod word;

pub use fanuc::{Dialect, Language, Settings};
pub use host::{Host, HostRef};
pub use interpreter::{Interpreter, check, check_each};
pub use lines::Style;
pub use modal::{Distance, Modal, Motion};
pub use options::{Options, Travel};
pub use text::Text;
