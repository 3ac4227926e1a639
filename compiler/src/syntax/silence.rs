//! `{warning disable P6001}` .. `{warning restore P6001}` (the form of CODESYS): in the text between the two the warning is not shown.
//! Errors are always shown, and codes that are not ours are left alone.

use super::ast::File;
use std::collections::HashMap;
use takt_base::{Code, Diag, Severity, Sink, SourceId};

/// A part of a file in which a warning is not shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Silence {
    /// Which warning.
    pub code: Code,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

/// The pragmas of a file, in order.
#[derive(Default)]
pub(crate) struct Silences {
    open: Vec<(Code, u32)>,
    done: Vec<Silence>,
}

impl Silences {
    /// Follows a pragma at this byte; false if it is not one of these.
    pub(crate) fn follow(&mut self, text: &str, at: u32) -> bool {
        let mut words = text.split(|c: char| c.is_whitespace() || c == ',').filter(|w| !w.is_empty());
        if !words.next().is_some_and(|w| w.eq_ignore_ascii_case("warning")) {
            return false;
        }
        let disable = match words.next() {
            Some(w) if w.eq_ignore_ascii_case("disable") => true,
            Some(w) if w.eq_ignore_ascii_case("restore") => false,
            _ => return false,
        };
        for code in words.filter_map(Code::from_text) {
            let open = self.open.iter().position(|o| o.0 == code);
            match (open, disable) {
                (None, true) => self.open.push((code, at)),
                (Some(i), false) => {
                    let (code, start) = self.open.swap_remove(i);
                    self.done.push(Silence { code, start, end: at });
                }
                _ => {}
            }
        }
        true
    }

    /// All regions; those that are open end with the file.
    pub(crate) fn finish(mut self) -> Vec<Silence> {
        let open = self.open.into_iter().map(|(code, start)| Silence { code, start, end: u32::MAX });
        self.done.extend(open);
        self.done
    }
}

/// Takes the warnings out that the files don't want to see.
pub(crate) fn apply(files: &[(SourceId, File)], sink: &mut Sink) {
    let mut regions: HashMap<(SourceId, Code), Vec<Silence>> = HashMap::new();
    for (id, file) in files {
        file.silenced.iter().for_each(|s| regions.entry((*id, s.code)).or_default().push(*s));
    }
    if !regions.is_empty() {
        // Regions of one code don't overlap and come in order.
        let hidden = |d: &Diag| {
            let list = regions.get(&(d.span.source, d.code)).filter(|_| d.severity == Severity::Warning);
            list.is_some_and(|l| l.get(l.partition_point(|s| s.end <= d.span.start)).is_some_and(|s| s.start <= d.span.start))
        };
        sink.diags.retain(|d| !hidden(d));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regions_begin_end_and_last_to_the_end_of_the_file() {
        let mut s = Silences::default();
        assert!(s.follow("warning disable P6001, p6007 C0371", 10));
        assert!(s.follow("warning disable P6001", 20));
        assert!(s.follow("WARNING  restore P6001", 30));
        assert!(s.follow("warning restore P6003", 40));
        assert!(!s.follow("warning 'attention'", 50) && !s.follow("attribute 'disable'", 60));
        let of = |code, start, end| Silence { code, start, end };
        assert_eq!(s.finish(), [of(Code::Unreachable, 10, 30), of(Code::RealEquality, 10, u32::MAX)]);
    }
}
