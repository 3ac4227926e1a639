//! Keeps numbers in registers over a loop: a memory cell that the loop reads or writes, and that nothing else in the loop can touch,
//! is loaded before the loop, lives in a local, and is stored back where the loop is left. BOOLs stay in memory, where networks of
//! contacts are fastest. A trap within the loop loses the values: the task has faulted.
//!
//! Invariant: what the function does to memory, seen at calls and at its end, stays the same.

use super::loops::{Loop, Predecessors, loops, predecessors, retarget, successors};
use super::model::*;
use super::region::{Region, Regions};
use std::collections::{BTreeMap, BTreeSet};
use takt_base::index::Index;
use takt_image::{NativeImport, NativeKind, Scalar};

/// Most cells that one loop may hold in registers.
const CELLS_MAX: usize = 24;

/// A scalar in memory at an address that is the same all through the function.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
struct Cell {
    base: Base,
    offset: u32,
    /// Bytes, and 1 for a float.
    kind: (u32, bool),
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Base {
    Static,
    Frame,
    Local(Local),
}

/// How an instruction touches memory.
struct Access {
    region: Region,
    /// The cell, if it is a plain load or store.
    cell: Option<Cell>,
    writes: bool,
}

/// Promotes what can be promoted in all loops without calls, the outermost first.
pub fn promote(f: &mut Function, regions: &Regions, natives: &[NativeImport]) {
    let fixed = assigned_once_as_parameter(f);
    let mut predecessors = predecessors(f);
    // One register serves a cell in all loops: loops that hold the same cell are never within each other.
    let mut registers = BTreeMap::new();
    // A change to a loop adds blocks to the loops around it alone, and those are done already.
    for l in loops(f, &predecessors).iter().filter(|l| l.header != BlockId(0)) {
        let Some(accesses) = accesses(f, l, regions, natives, &fixed) else { continue };
        let cells = cells(&accesses, regions);
        if !cells.is_empty() {
            cells.iter().for_each(|(c, _)| _ = registers.entry(*c).or_insert_with(|| f.locals.push(c.scalar())));
            rewrite(f, l, &cells, &registers, &mut predecessors);
        }
    }
}

/// Locals that are never assigned: parameters, so that an address based on them is the same everywhere.
fn assigned_once_as_parameter(f: &Function) -> Vec<Local> {
    let mut fixed = f.params.clone();
    for inst in f.blocks.iter().flat_map(|b| &b.insts) {
        fixed.retain(|l| Some(*l) != inst.op.target());
    }
    fixed
}

/// All memory accesses of a loop; `None` if it calls somebody who can see memory.
fn accesses(f: &Function, l: &Loop, regions: &Regions, natives: &[NativeImport], fixed: &[Local]) -> Option<Vec<Access>> {
    let mut found = Vec::new();
    let mut add = |addr: Addr, size: u64, cell, writes| {
        found.push(Access { region: regions.of(addr, size), cell, writes });
    };
    for inst in l.blocks.iter().flat_map(|b| &f.blocks[*b].insts) {
        match &inst.op {
            Op::Load(d, a) => add(*a, f.locals[*d].bytes() as u64, cell(*a, f.locals[*d], fixed), false),
            Op::Store(a, s) => add(*a, f.locals[*s].bytes() as u64, cell(*a, f.locals[*s], fixed), true),
            Op::CopyBytes { to, from, size } => {
                add(*from, *size as u64, None, false);
                add(*to, *size as u64, None, true);
            }
            Op::FillBytes { to, size, .. } => add(*to, *size as u64, None, true),
            Op::CopyString { to, to_capacity, from, from_capacity, unit } => {
                add(*from, text_bytes(*from_capacity, *unit), None, false);
                add(*to, text_bytes(*to_capacity, *unit), None, true);
            }
            Op::CompareString { a, a_capacity, b, b_capacity, unit, .. } => {
                add(*a, text_bytes(*a_capacity, *unit), None, false);
                add(*b, text_bytes(*b_capacity, *unit), None, false);
            }
            Op::Call { .. } => return None,
            Op::CallNative { native, .. } if !is_pure(natives.get(native.index())?) => return None,
            _ => {}
        }
    }
    Some(found)
}

fn text_bytes(capacity: u32, unit: u32) -> u64 {
    (capacity as u64 + 1) * unit as u64
}

/// True for natives of reals alone: they are not given any place in memory.
fn is_pure(native: &NativeImport) -> bool {
    match &native.kind {
        NativeKind::Function { params, .. } => params.iter().all(|p| p.is_float()),
        NativeKind::Block { .. } => false,
    }
}

fn cell(addr: Addr, ty: Scalar, fixed: &[Local]) -> Option<Cell> {
    let base = match addr.base {
        AddrBase::Static => Base::Static,
        AddrBase::Frame => Base::Frame,
        AddrBase::Local(l) if fixed.contains(&l) => Base::Local(l),
        AddrBase::Local(_) => return None,
    };
    (ty != Scalar::I8).then_some(Cell { base, offset: addr.offset, kind: (ty.bytes(), ty.is_float()) })
}

impl Cell {
    fn addr(self) -> Addr {
        let base = match self.base {
            Base::Static => AddrBase::Static,
            Base::Frame => AddrBase::Frame,
            Base::Local(l) => AddrBase::Local(l),
        };
        Addr { base, offset: self.offset }
    }
    fn scalar(self) -> Scalar {
        match self.kind {
            (4, true) => Scalar::F32,
            (_, true) => Scalar::F64,
            (2, _) => Scalar::I16,
            (4, _) => Scalar::I32,
            _ => Scalar::I64,
        }
    }
}

/// Cells that can live in registers, with whether the loop writes them.
fn cells(accesses: &[Access], regions: &Regions) -> Vec<(Cell, bool)> {
    let mut uses: BTreeMap<Cell, (Region, bool, usize)> = BTreeMap::new();
    for a in accesses {
        if let Some(cell) = a.cell {
            let entry = uses.entry(cell).or_insert((a.region, false, 0));
            entry.1 |= a.writes;
            entry.2 += 1;
        }
    }
    let mut free: Vec<_> = uses
        .into_iter()
        .filter(|(cell, (region, written, _))| {
            let others = accesses.iter().filter(|a| a.cell != Some(*cell) && (a.writes || *written));
            others.into_iter().all(|a| !regions.may_overlap(a.region, *region))
        })
        .collect();
    free.sort_by_key(|(cell, (_, _, count))| (std::cmp::Reverse(*count), *cell));
    free.truncate(CELLS_MAX);
    free.into_iter().map(|(cell, (_, written, _))| (cell, written)).collect()
}

/// Loads the cells before the loop, replaces their accesses, stores what was written on all ways out.
fn rewrite(f: &mut Function, l: &Loop, cells: &[(Cell, bool)], all: &BTreeMap<Cell, Local>, predecessors: &mut Predecessors) {
    let registers: BTreeMap<Cell, Local> = cells.iter().map(|(c, _)| (*c, all[c])).collect();
    let fixed: Vec<Local> = cells.iter().filter_map(|(c, _)| if let Base::Local(l) = c.base { Some(l) } else { None }).collect();
    for block in &l.blocks {
        let Function { blocks, locals, .. } = &mut *f;
        for inst in &mut blocks[*block].insts {
            let register = |a: Addr, ty| cell(a, ty, &fixed).and_then(|c| registers.get(&c).copied());
            match inst.op {
                Op::Load(d, a) => inst.op = register(a, locals[d]).map_or(Op::Load(d, a), |r| Op::Copy(d, r)),
                Op::Store(a, s) => inst.op = register(a, locals[s]).map_or(Op::Store(a, s), |r| Op::Copy(r, s)),
                _ => {}
            }
        }
    }
    let written: Vec<_> = cells.iter().filter(|(_, written)| *written).map(|(c, _)| Op::Store(c.addr(), registers[c])).collect();
    store_at_exits(f, l, &written, predecessors);
    let loads = cells.iter().map(|(c, _)| Op::Load(registers[c], c.addr())).collect();
    load_before(f, l, loads, predecessors);
}

fn store_at_exits(f: &mut Function, l: &Loop, stores: &[Op], predecessors: &mut Predecessors) {
    if stores.is_empty() {
        return;
    }
    for &block in &l.blocks {
        let line = f.blocks[block].end_line;
        let code = || stores.iter().map(|op| Inst { op: op.clone(), line });
        if matches!(f.blocks[block].end, End::Return(_)) {
            f.blocks[block].insts.extend(code());
        }
        let outside: BTreeSet<_> = successors(&f.blocks[block].end).into_iter().filter(|s| !l.blocks.contains(s)).collect();
        for target in outside {
            let between = f.blocks.push(Block { insts: code().collect(), end: End::Jump(target), end_line: line });
            insert(predecessors, between, target, vec![block]);
            let end = f.blocks[block].end.clone();
            f.blocks[block].end = retarget(end, |b| if b == target { between } else { b });
        }
    }
}

/// Puts a block on all ways into the loop.
fn load_before(f: &mut Function, l: &Loop, loads: Vec<Op>, predecessors: &mut Predecessors) {
    let line = f.blocks[l.header].insts.first().map_or(f.blocks[l.header].end_line, |i| i.line);
    let insts: Vec<_> = loads.into_iter().map(|op| Inst { op, line }).collect();
    let outside: Vec<_> = predecessors[l.header.index()].iter().copied().filter(|p| !l.blocks.contains(p)).collect();
    let before = f.blocks.push(Block { insts, end: End::Jump(l.header), end_line: line });
    for &block in &outside {
        let end = f.blocks[block].end.clone();
        f.blocks[block].end = retarget(end, |b| if b == l.header { before } else { b });
    }
    insert(predecessors, before, l.header, outside);
}

/// Notes that the new block `between` stands between `from` and `to`.
fn insert(predecessors: &mut Predecessors, between: BlockId, to: BlockId, from: Vec<BlockId>) {
    debug_assert_eq!(predecessors.len(), between.index());
    predecessors[to.index()].retain(|p| !from.contains(p));
    predecessors[to.index()].push(between);
    predecessors.push(from);
}

#[cfg(test)]
mod tests;
