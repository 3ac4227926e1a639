//! All that is wrong with a program, in one go. Runs: background.

use super::Interpreter;
use crate::ngc::options::Options;
use crate::ngc::text::Text;
use std::collections::HashSet;
use takt_base::{Diag, SourceId};

/// Rows that a check executes; a longer program is checked no further.
const CHECKED_ROWS: u64 = 20_000_000;
/// Diagnostics that a check gives.
const DIAGS_MAX: usize = 1_000_000;

/// All errors and warnings of a program, in the order in which it runs up to M2, M30 or a closing `%`, each once. Goes on behind a wrong
/// block with the state that it would have left. Rows that are not executed are read too.
pub fn check(source: SourceId, text: impl Into<Text>, options: Options) -> Vec<Diag> {
    let mut diags = Vec::new();
    check_each(source, text, options, |diag| diags.push(diag));
    diags
}

/// The same one by one, for programs of any size.
pub fn check_each(source: SourceId, text: impl Into<Text>, options: Options, mut found: impl FnMut(Diag)) {
    let mut interpreter = Interpreter::new(source, text, options);
    interpreter.once = true;
    interpreter.flow.thorough = true;
    let (mut seen, mut rows) = (HashSet::new(), 0_u64);
    while !interpreter.ended && rows < CHECKED_ROWS && seen.len() < DIAGS_MAX {
        interpreter.queue.clear();
        interpreter.advance();
        rows += 1;
        interpreter.take_found();
        interpreter.diags.drain(..).filter(|d| seen.insert((d.span, d.code))).for_each(&mut found);
    }
    if let Some(machine) = &mut interpreter.fanuc {
        machine.unread().into_iter().filter(|d| seen.insert((d.span, d.code))).for_each(&mut found);
    }
}
