//! The machine of `takt test`: each `{test}` program has a task of its own, of which the runner starts one at a time.

use super::builder::Builder;
use super::config::{instance, new_task};
use super::model::*;
use takt_base::Span;

/// A unit test of the project.
#[derive(Clone, Debug)]
pub struct Test {
    /// From the pragma, else the program's.
    pub name: String,
    /// Name of the program, and of its task.
    pub pou: String,
    /// How often the body runs.
    pub scans: u64,
    /// Where the program is declared.
    pub span: Span,
}

impl Builder<'_> {
    fn test_pous(&self) -> Vec<PouId> {
        self.symbols.pous.enumerate().filter(|(_, p)| p.decl.test.is_some()).map(|(id, _)| id).collect()
    }

    /// Tasks of tests in place of those of the configuration.
    pub(super) fn test_tasks(&mut self) {
        self.hir.tasks.clear();
        for pou in self.test_pous() {
            let decl = self.symbols.pous[pou].decl;
            self.check_bound(pou, decl.name.span);
            let interval = decl.test.as_ref().map(|t| t.interval);
            let name = self.hir.pous[pou].name.clone();
            let programs = vec![instance(name.clone(), pou)];
            self.hir.tasks.push(Task { interval, programs, ..new_task(&name, 0, 0) });
        }
    }

    /// The tests, in the order of their tasks.
    pub(super) fn test_list(&self) -> Vec<Test> {
        let test = |id: PouId| {
            let decl = self.symbols.pous[id].decl;
            let pragma = decl.test.as_ref()?;
            let pou = decl.name.text.clone();
            Some(Test {
                name: pragma.name.clone().unwrap_or_else(|| pou.clone()),
                pou,
                scans: pragma.scans,
                span: decl.name.span,
            })
        };
        self.test_pous().into_iter().filter_map(test).collect()
    }

    /// The unit at hand is a test: it may write %I and declare instances of programs.
    pub(super) fn in_test(&self) -> bool {
        self.scope.pou.is_some_and(|p| self.symbols.pous[p].decl.test.is_some())
    }
}
