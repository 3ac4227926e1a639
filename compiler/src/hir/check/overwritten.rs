//! P6012: an output that is assigned twice in one list of statements, and nothing can see the first value: it is not read, no call comes, and
//! nothing leaves between. An output of a unit, a global variable, or one in %Q; what is local is left alone.

use super::walk::{Event, walk};
use crate::hir::builder::Builder;
use crate::hir::model::*;
use std::collections::HashMap;
use takt_base::{Code, Diag, Span};

/// The output as a whole.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Key {
    Var(VarId),
    Global(GlobalId),
}

/// When what happened; every event has a number.
#[derive(Default)]
struct Search {
    now: u32,
    /// Last read of each output, in whatever list.
    read: HashMap<Key, u32>,
    /// Last time that somebody else might have looked.
    barrier: u32,
    /// For each list around: the last write of each output in the list itself.
    written: Vec<HashMap<Key, (u32, Span)>>,
    /// The statement of the innermost list is this assignment.
    own: Vec<Option<Span>>,
}

/// Looks through a body.
pub(super) fn check(_: &Builder, pou: &Pou, out: &mut Vec<Diag>) {
    let mut search = Search::default();
    walk(&pou.body, &mut |event| search.event(pou, event, out));
}

impl Search {
    fn event(&mut self, pou: &Pou, event: Event, out: &mut Vec<Diag>) {
        self.now += 1;
        match event {
            Event::List => {
                self.written.push(HashMap::new());
                self.own.push(None);
            }
            Event::EndList => {
                self.written.pop();
                self.own.pop();
            }
            Event::Statement(s) => {
                let own = matches!(s.kind, StmtKind::Assign { .. }).then_some(s.span);
                self.own.last_mut().into_iter().for_each(|o| *o = own);
                let leaves = matches!(
                    s.kind,
                    StmtKind::Exit | StmtKind::Continue | StmtKind::Return | StmtKind::Label(_) | StmtKind::Jump(_)
                );
                if leaves {
                    self.barrier = self.now;
                }
            }
            Event::Read(p) | Event::Lend(p) => self.seen(pou, p),
            Event::Write(p, value) => self.write(pou, p, value, out),
            Event::Call => self.barrier = self.now,
            Event::Expr(_) | Event::Loop | Event::EndLoop => {}
        }
    }

    fn seen(&mut self, pou: &Pou, p: &Place) {
        match key(pou, p) {
            Some(key) => drop(self.read.insert(key, self.now)),
            // Whatever is located or referred to may be an output under another name.
            None if !matches!(p.base, Base::Var(v) if matches!(pou.vars[v].role, Role::Local | Role::Temp | Role::Input) && p.path.is_empty()) =>
            {
                self.barrier = self.now;
            }
            None => {}
        }
    }

    fn write(&mut self, pou: &Pou, p: &Place, value: Option<&Expr>, out: &mut Vec<Diag>) {
        let Some(key) = key(pou, p) else { return };
        if !p.path.is_empty() || value.is_none() || self.own.last().is_none_or(Option::is_none) {
            return;
        }
        let since = self.read.get(&key).copied().unwrap_or(0).max(self.barrier);
        let Some(list) = self.written.last_mut() else { return };
        if let Some((at, first)) = list.insert(key, (self.now, p.span))
            && at > since
        {
            let diag = Diag::new(Code::Overwritten, first, "nobody sees this value").also(p.span, "assigned again");
            out.push(diag.help("remove one of the two, or put the second behind a condition"));
        }
    }
}

/// The output that a place belongs to.
fn key(pou: &Pou, p: &Place) -> Option<Key> {
    match p.base {
        Base::Global(g) => Some(Key::Global(g)),
        Base::Var(v) if pou.vars[v].role == Role::Output || matches!(pou.vars[v].storage, Storage::Image(_)) => Some(Key::Var(v)),
        _ => None,
    }
}
