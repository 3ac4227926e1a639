//! Natural loops of a function.

use super::model::*;
use std::collections::{BTreeMap, BTreeSet};
use takt_base::index::Index;

/// A loop: blocks from which the header is reached again without leaving.
#[derive(Clone, Debug, PartialEq)]
pub struct Loop {
    /// Where it is entered; dominates all its blocks.
    pub header: BlockId,
    /// All its blocks.
    pub blocks: BTreeSet<BlockId>,
}

/// For each block those that lead to it.
pub type Predecessors = Vec<Vec<BlockId>>;

/// All loops, larger ones first; loops with one header count as one.
pub fn loops(f: &Function, predecessors: &Predecessors) -> Vec<Loop> {
    let order = reverse_postorder(f);
    let mut number = vec![usize::MAX; f.blocks.len()];
    order.iter().enumerate().for_each(|(i, b)| number[b.index()] = i);
    let dominators = dominators(&order, &number, predecessors);
    let mut found: BTreeMap<BlockId, BTreeSet<BlockId>> = BTreeMap::new();
    for (tail, block) in f.blocks.enumerate() {
        // Only an edge that goes back in the order can go to a dominator.
        for header in successors(&block.end).into_iter().filter(|h| number[h.index()] <= number[tail.index()]) {
            if dominates(&dominators, header, tail) {
                grow(found.entry(header).or_insert_with(|| BTreeSet::from([header])), tail, predecessors);
            }
        }
    }
    let mut loops: Vec<_> = found.into_iter().map(|(header, blocks)| Loop { header, blocks }).collect();
    loops.sort_by_key(|l| std::cmp::Reverse(l.blocks.len()));
    loops
}

/// Adds everything from which `tail` is reached without passing the header.
fn grow(blocks: &mut BTreeSet<BlockId>, tail: BlockId, predecessors: &Predecessors) {
    let mut todo = vec![tail];
    while let Some(block) = todo.pop() {
        if blocks.insert(block) {
            todo.extend(&predecessors[block.index()]);
        }
    }
}

/// Blocks that lead to each block; one that does so by two ways stands there twice.
pub fn predecessors(f: &Function) -> Predecessors {
    let mut found = vec![Vec::new(); f.blocks.len()];
    for (id, block) in f.blocks.enumerate() {
        successors(&block.end).into_iter().for_each(|s| found[s.index()].push(id));
    }
    found
}

/// Immediate dominators, by the algorithm of Cooper, Harvey and Kennedy. `None` for unreachable blocks; the entry has itself.
fn dominators(order: &[BlockId], number: &[usize], predecessors: &Predecessors) -> Vec<Option<BlockId>> {
    let mut idom = vec![None; predecessors.len()];
    idom[0] = Some(BlockId(0));
    let mut changed = true;
    while changed {
        changed = false;
        for &block in &order[1..] {
            let done = predecessors[block.index()].iter().copied().filter(|p| idom[p.index()].is_some());
            let new = done.reduce(|a, b| meet(&idom, number, a, b));
            if new != idom[block.index()] {
                idom[block.index()] = new;
                changed = true;
            }
        }
    }
    idom
}

fn meet(idom: &[Option<BlockId>], number: &[usize], mut a: BlockId, mut b: BlockId) -> BlockId {
    while a != b {
        let later = if number[a.index()] > number[b.index()] { &mut a } else { &mut b };
        *later = idom[later.index()].unwrap_or(BlockId(0));
    }
    a
}

fn dominates(idom: &[Option<BlockId>], a: BlockId, mut b: BlockId) -> bool {
    while let Some(up) = idom[b.index()] {
        if a == b {
            return true;
        }
        if up == b {
            return false;
        }
        b = up;
    }
    false
}

fn reverse_postorder(f: &Function) -> Vec<BlockId> {
    let mut seen = vec![false; f.blocks.len()];
    let mut order = Vec::new();
    let mut todo = vec![(BlockId(0), false)];
    while let Some((block, finished)) = todo.pop() {
        if finished {
            order.push(block);
        } else if !std::mem::replace(&mut seen[block.index()], true) {
            todo.push((block, true));
            todo.extend(successors(&f.blocks[block].end).into_iter().map(|s| (s, false)));
        }
    }
    order.reverse();
    order
}

/// Blocks that an end leads to.
pub fn successors(end: &End) -> Vec<BlockId> {
    match end {
        End::Jump(b) => vec![*b],
        End::Branch { then, otherwise, .. } => vec![*then, *otherwise],
        End::Switch { cases, otherwise, .. } => cases.iter().map(|c| c.1).chain([*otherwise]).collect(),
        End::Return(_) | End::Trap(_) => vec![],
    }
}

/// The same end with other targets.
pub fn retarget(end: End, mut to: impl FnMut(BlockId) -> BlockId) -> End {
    match end {
        End::Jump(b) => End::Jump(to(b)),
        End::Branch { condition, then, otherwise } => End::Branch { condition, then: to(then), otherwise: to(otherwise) },
        End::Switch { value, cases, otherwise } => {
            let cases = cases.into_iter().map(|(v, b)| (v, to(b))).collect();
            End::Switch { value, cases, otherwise: to(otherwise) }
        }
        other => other,
    }
}
