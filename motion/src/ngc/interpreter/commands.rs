//! Commands as they are asked for, one by one. Runs: background.

use super::*;

impl Interpreter {
    /// The same as `next`, but the command is looked at where it stands, which saves a copy. It is gone with the next call.
    pub fn next_ref(&mut self) -> Option<Result<&Step, Box<Diag>>> {
        self.go_past_seen();
        if self.queue.is_empty()
            && let Some(diag) = self.fill_queue()
        {
            return Some(Err(diag));
        }
        self.seen = !self.queue.is_empty();
        self.queue.front().map(Ok)
    }

    fn go_past_seen(&mut self) {
        if std::mem::take(&mut self.seen) {
            let moves = |s: &Step| matches!(s.command, Canon::StraightFeed(_) | Canon::StraightTraverse(_) | Canon::ArcFeed(_));
            let owns_nothing = self.queue.front().is_some_and(moves);
            let step = self.queue.pop_front();
            if owns_nothing {
                // There is nothing to free, and without the look at it the step need not be copied out of the queue.
                std::mem::forget(step);
            }
        }
    }

    /// Reads rows until there is a command or the program has ended; or the error of the row.
    fn fill_queue(&mut self) -> Option<Box<Diag>> {
        loop {
            if !self.queue.is_empty() {
                return None;
            }
            if let Some(diag) = self.failed.take() {
                return Some(diag);
            }
            if self.ended {
                return None;
            }
            self.advance();
            if !self.diags.is_empty() {
                self.failed = self.diags.drain(..).find(|d| d.severity == Severity::Error).map(Box::new);
                self.ended |= self.failed.is_some();
            }
        }
    }
}

impl Iterator for Interpreter {
    type Item = Result<Step, Box<Diag>>;

    /// The next command, or the error of the next block: then nothing of that block has been given out (in the drop-in form: what stands
    /// before the error), and nothing follows. Warnings are left to [`check`].
    fn next(&mut self) -> Option<Self::Item> {
        if let Err(diag) = self.next_ref()? {
            return Some(Err(diag));
        }
        self.seen = false;
        self.queue.pop_front().map(Ok)
    }
}

impl std::iter::FusedIterator for Interpreter {}
