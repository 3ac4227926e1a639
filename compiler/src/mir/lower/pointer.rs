//! What pointers may reach, and the checks in front of it. From: language reference §2.10, §11.
//!
//! A pointer may hold any number. Before memory is touched through one, NULL traps (NullReference), and so do bytes that are not all
//! within the variables (WildPointer): reading is allowed in %I, %Q, %M, globals and instances, writing in the same without %I. The
//! header, constants and frames are out of reach, so that what generated code relies on can't be changed by the program.
//! A variable of a function whose place is taken (vendor) gets a fixed place of its own; nothing refers to a frame.

use super::Program;
use super::builder::{at, fixed};
use super::place::Loc;
use super::unit::Unit;
use super::walk::{self, Event};
use crate::hir::model::*;
use crate::mir::model::*;
use crate::mir::region::{Object, Region};
use std::collections::HashMap;
use takt_base::{Code, Diag};
use takt_image::types::PointerKind;
use takt_image::{Scalar, Trap, Type, TypeId, header};

/// What a place is wanted for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Purpose {
    Read,
    Write,
    /// Its address, to be kept: checked when it is used.
    Address,
}

/// Offsets that pointers may reach.
#[derive(Clone, Copy, Default, Debug)]
pub struct Reach {
    /// First byte to read.
    pub read: u32,
    /// First byte to write.
    pub write: u32,
    /// One past the last byte.
    pub end: u32,
}

/// Variables of functions, and temporaries, with a fixed place.
pub type Statics = HashMap<(PouId, VarId), u32>;

/// True if the program has pointers that may hold any number.
pub fn has_pointers(hir: &Hir) -> bool {
    hir.types.iter().any(|(_, t)| matches!(t, Type::Pointer { kind: PointerKind::Pointer, .. }))
}

impl Program<'_> {
    /// Gives fixed places to the variables that pointers may point to, and decides what pointers may reach.
    pub fn prepare_pointers(&mut self) {
        let hir = self.hir;
        if has_pointers(hir) {
            let lowered = hir.pous.enumerate().filter(|(id, _)| self.view.functions[*id].is_some());
            lowered.map(|(id, pou)| (id, pou, taken(pou))).collect::<Vec<_>>().into_iter().for_each(|(id, pou, taken)| {
                taken.into_iter().for_each(|(var, kept)| self.make_static(id, pou, var, kept));
            });
            // A string behind the last variable may be shorter than what the pointer promises.
            let texts = hir.types.iter().filter(|(_, t)| matches!(t, Type::String { .. } | Type::WString { .. }));
            let slack = texts.map(|(ty, _)| hir.types.layout(ty).size).max().unwrap_or(0);
            self.data.reserve_bytes(slack, 1);
        }
        self.reach = self.data.reach(hir);
    }

    fn make_static(&mut self, id: PouId, pou: &Pou, var: VarId, kept: bool) {
        let v = &pou.vars[var];
        if matches!(self.hir.types.get(v.ty), Type::Open { .. }) {
            return;
        }
        if self.recursive[id] {
            if kept {
                let help = "declare it in a function block, or pass it as VAR_IN_OUT";
                let label = "each of its nested calls has its own";
                let diag = Diag::new(Code::NotReferable, v.span, label);
                self.diags.push(diag.message("a pointer to a variable of a function that calls itself").help(help));
            }
            return;
        }
        let layout = self.hir.types.layout(v.ty);
        match self.data.reserve_bytes(layout.size, layout.align) {
            Some(offset) => _ = self.statics.insert((id, var), offset),
            None => self.diags.push(super::data::too_large(v.span, &v.name)),
        }
    }
}

/// Variables on the frame that are handed out by address, in order; true for those whose address is kept.
fn taken(pou: &Pou) -> Vec<(VarId, bool)> {
    let mut found: HashMap<VarId, bool> = HashMap::new();
    walk::statements(&pou.body, &mut |event| {
        let (place, kept) = match event {
            Event::Lend(p) => (p, false),
            Event::Refer(p) => (p, true),
            _ => return,
        };
        if let Some(var) = place.variable() {
            *found.entry(var).or_default() |= kept;
        }
    });
    let on_frame = |v: &VarId| pou.vars[*v].storage == Storage::Local && pou.vars[*v].role != Role::InOut;
    let mut list: Vec<_> = found.into_iter().filter(|(v, _)| on_frame(v)).collect();
    list.sort();
    list
}

impl Unit<'_, '_> {
    /// The value of a reference as an address; traps if it is NULL, unless only an address is wanted.
    pub(super) fn pointer(&mut self, loc: Loc, ty: TypeId, purpose: Purpose) -> Local {
        let pointer = self.load(loc, ty);
        let pointer = self.f.duplicate(pointer);
        if purpose != Purpose::Address {
            let null = self.f.compare_const(Compare::Eq, pointer, 0);
            self.f.trap_if(Trap::NullReference, null);
        }
        self.f.regions.set(pointer, Region::whole(Object::Foreign));
        pointer
    }

    /// The same address in a local of its own; traps unless pointers may reach all of its `size` bytes.
    pub(super) fn reachable(&mut self, addr: Addr, size: u32, purpose: Purpose) -> Addr {
        let reach = self.program.reach;
        let low = if purpose == Purpose::Write { reach.write } else { reach.read };
        let start = self.f.address(addr);
        let from_low = self.f.binary_const(BinaryOp::Sub, start, low.into());
        match (reach.end - low).checked_sub(size) {
            Some(room) => {
                let outside = self.f.compare_const(Compare::UGt, from_low, room.into());
                self.f.trap_if(Trap::WildPointer, outside);
            }
            None => {
                let always = self.f.int(Scalar::I8, 1);
                self.f.trap_if(Trap::WildPointer, always);
            }
        }
        self.f.regions.set(start, Region::whole(Object::Foreign));
        at(start)
    }

    /// What a VAR_IN_OUT of an instance refers to, when pointers could have changed it: traps outside of the memory.
    pub(super) fn check_in_out(&mut self, target: Local, size: u32) {
        if !self.program.wild {
            return;
        }
        let limit = self.f.load(Scalar::I32, fixed(header::FRAME_LIMIT));
        let room = self.f.binary_const(BinaryOp::Sub, limit, i64::from(size) + i64::from(header::SIZE));
        let from_header = self.f.binary_const(BinaryOp::Sub, target, header::SIZE.into());
        let outside = self.f.compare(Compare::UGt, from_header, room);
        self.f.trap_if(Trap::WildPointer, outside);
    }
}
