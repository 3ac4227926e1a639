//! P6011: two programs that write one output in %Q: which of them wins is a matter of order and time. What a program's function blocks and
//! functions write is its own; what is called by several programs counts for none.

use super::walk::{Event, walk};
use crate::hir::builder::Builder;
use crate::hir::model::*;
use std::collections::HashMap;
use takt_base::index::{Index, IndexVec};
use takt_base::{Code, Diag, Span};
use takt_image::image::Place as ImagePlace;

/// For which program a unit works.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Worker {
    Nobody,
    Of(PouId),
    Many,
}

/// A write: bits of the memory, program, and where.
type Written = (u64, u64, PouId, Span);

/// Looks at all units.
pub(super) fn check(builder: &Builder) -> Vec<Diag> {
    let outputs = builder.image.output_bytes();
    if outputs.0 == outputs.1 {
        return Vec::new();
    }
    let workers = workers(builder);
    let mut written: HashMap<(u64, u64, PouId), Span> = HashMap::new();
    for (id, pou) in builder.hir.pous.enumerate() {
        let Worker::Of(program) = workers[id] else { continue };
        walk(&pou.body, &mut |event| {
            if let Event::Write(p, _) = event
                && let Some((first, end)) = bits(builder, pou, p)
                && first >= u64::from(outputs.0) * 8
                && end <= u64::from(outputs.1) * 8
            {
                written.entry((first, end, program)).or_insert(p.span);
            }
        });
    }
    let mut list: Vec<Written> = written.into_iter().map(|((a, b, p), s)| (a, b, p, s)).collect();
    list.sort_by_key(|w| (w.0, w.1, w.3));
    clashes(builder, &list)
}

/// Neighbours that overlap.
fn clashes(builder: &Builder, list: &[Written]) -> Vec<Diag> {
    let mut out = Vec::new();
    let mut widest: Option<&Written> = None;
    for w in list {
        if let Some(first) = widest.filter(|f| f.1 > w.0 && f.2 != w.2) {
            let label = format!("written by `{}`", builder.hir.pous[w.2].name);
            let note = format!("written by `{}` too", builder.hir.pous[first.2].name);
            out.push(
                Diag::new(Code::TwoWriters, w.3, label)
                    .also(first.3, note)
                    .help("let one program write it, from what the others ask for"),
            );
        }
        if widest.is_none_or(|f| f.1 < w.1) {
            widest = Some(w);
        }
    }
    out
}

/// Each program works for itself, and what it calls for it, as far as other programs don't call that too.
fn workers(builder: &Builder) -> IndexVec<PouId, Worker> {
    let pous = &builder.hir.pous;
    let mut called: Vec<Vec<PouId>> = vec![Vec::new(); pous.len()];
    for (from, to, _) in builder.calls.iter().chain(&builder.objects.dynamic_calls) {
        if let Some(from) = from.filter(|_| pous[*to].kind != PouKind::Program) {
            called[from.index()].push(*to);
        }
    }
    let mut workers = IndexVec::new();
    let mut todo = Vec::new();
    for (id, pou) in pous.enumerate() {
        let program = pou.kind == PouKind::Program && pou.reachable;
        workers.push(if program { Worker::Of(id) } else { Worker::Nobody });
        if program {
            todo.push(id);
        }
    }
    // A unit changes twice at most.
    while let Some(id) = todo.pop() {
        for &to in &called[id.index()] {
            let both = match (workers[to], workers[id]) {
                (Worker::Nobody, w) => w,
                (a, b) if a == b => a,
                _ => Worker::Many,
            };
            if both != workers[to] {
                workers[to] = both;
                todo.push(to);
            }
        }
    }
    workers
}

/// The bits of a located place that is a whole variable or some bits of one.
fn bits(builder: &Builder, pou: &Pou, p: &Place) -> Option<(u64, u64)> {
    let (place, ty) = match p.base {
        Base::Image(place) => (place, None),
        Base::Global(g) => (builder.hir.globals[g].place?, Some(builder.hir.globals[g].ty)),
        Base::Var(v) => match pou.vars[v].storage {
            Storage::Image(place) => (place, Some(pou.vars[v].ty)),
            _ => return None,
        },
        _ => return None,
    };
    match (place, p.path.as_slice()) {
        (ImagePlace::Bit(byte, bit), []) => {
            Some((u64::from(byte) * 8 + u64::from(bit), u64::from(byte) * 8 + u64::from(bit) + 1))
        }
        (ImagePlace::Byte(byte), []) => {
            let size = builder.hir.types.layout(ty.unwrap_or(p.ty)).size;
            Some((u64::from(byte) * 8, (u64::from(byte) + u64::from(size)) * 8))
        }
        (ImagePlace::Byte(byte), [Step::Part { bit, width }]) => {
            let first = u64::from(byte) * 8 + u64::from(*bit);
            Some((first, first + u64::from(*width)))
        }
        _ => None,
    }
}
