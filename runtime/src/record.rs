//! Faults on record: small on the cyclic side, with names for the user.

use takt_base::{Code, Nanos};
use takt_image::{Fault, Image};

/// A fault, and the activation that it ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct FaultRecord {
    /// Why and where.
    pub fault: Fault,
    /// Index into `Image::tasks`.
    pub task: usize,
    /// Index into the task's programs.
    pub program: usize,
    /// Number of the scan, from 1.
    pub scan: u64,
    /// Time sample of the activation.
    pub time: Nanos,
}

/// A fault in words.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct FaultReport {
    /// Code of the fault.
    pub code: Code,
    /// The code's title.
    pub message: &'static str,
    /// Source file; empty if unknown.
    pub file: String,
    /// Line from 1; 0 if unknown.
    pub line: u32,
    /// Unit that faulted, as declared; the type of the program if unknown.
    pub pou: String,
    /// Program instance.
    pub program: String,
    /// Task.
    pub task: String,
    /// Time sample of the activation.
    pub time: Nanos,
}

impl FaultRecord {
    /// With the names of the image.
    pub fn report(&self, image: &Image) -> FaultReport {
        let task = image.tasks.get(self.task);
        let program = task.and_then(|t| t.programs.get(self.program));
        let function = image.functions.get(self.fault.function as usize);
        let unit = function.or_else(|| image.functions.get(program?.function as usize));
        let code = self.fault.trap.code();
        FaultReport {
            code,
            message: code.title(),
            file: image.files.get(self.fault.file as usize).cloned().unwrap_or_default(),
            line: self.fault.line,
            pou: unit.map(|f| f.pou.clone()).unwrap_or_default(),
            program: program.map(|p| p.name.clone()).unwrap_or_default(),
            task: task.map(|t| t.name.clone()).unwrap_or_default(),
            time: self.time,
        }
    }
}

impl std::fmt::Display for FaultReport {
    /// `F0701: integer division by zero, pump.st:12 in Pump (task fast, program main, at 1s20ms)`.
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "{}: {}", self.code.text(), self.message)?;
        if !self.file.is_empty() {
            write!(f, ", {}:{}", self.file, self.line)?;
        }
        let time = takt_image::literal_time::format_duration(self.time.0);
        write!(f, " in {} (task {}, program {}, at {time})", self.pou, self.task, self.program)
    }
}
