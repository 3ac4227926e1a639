//! The target: x86-64 with SSE4.2 and POPCNT, System V, whatever machine the compiler runs on. Two variants of it.
//!
//! Optimisation pays for numbers and loops (2-4 times). For networks of BOOLs in memory it does harm: forwarding stores to loads
//! makes hundreds of values live at once, and spilling them costs more than the loads did. Such functions are compiled as they stand.

use crate::mir::model::{Block, BlockId, End, Function, Op};
use cranelift_codegen::isa::{self, OwnedTargetIsa, TargetFrontendConfig, TargetIsa};
use cranelift_codegen::settings::{self, Configurable, Flags};
use takt_base::index::Index;
use takt_image::Scalar;

/// How a function is compiled.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Style {
    /// Optimised.
    Numbers,
    /// As it stands: a network of BOOLs.
    Contacts,
}

/// Instructions of a function from which on the style matters.
const SMALLEST_NETWORK: usize = 64;

/// Chooses the style: contacts if there are no loops, and at least half of the instructions load or store an I8 or combine such
/// values, and they are enough to matter.
pub fn style(f: &Function) -> Style {
    let total: usize = f.blocks.iter().map(|b| b.insts.len()).sum();
    let bools: usize = f.blocks.iter().map(|b| bool_insts(f, b)).sum();
    let accesses: usize = f.blocks.iter().map(|b| bool_accesses(f, b)).sum();
    let network = total >= SMALLEST_NETWORK && accesses * 3 >= total && bools * 4 >= total * 3;
    if network && !has_loop(f) { Style::Contacts } else { Style::Numbers }
}

/// Loads and stores of I8.
fn bool_accesses(f: &Function, block: &Block) -> usize {
    let is_access = |op: &Op| matches!(*op, Op::Load(local, _) | Op::Store(_, local) if f.locals[local] == Scalar::I8);
    block.insts.iter().filter(|i| is_access(&i.op)).count()
}

/// Instructions on I8 alone.
fn bool_insts(f: &Function, block: &Block) -> usize {
    let is_bool = |op: &Op| match *op {
        Op::Load(local, _)
        | Op::Store(_, local)
        | Op::Int(local, _)
        | Op::Copy(local, _)
        | Op::Unary(_, local, _)
        | Op::Binary(_, local, _, _) => f.locals[local] == Scalar::I8,
        Op::Compare(_, _, a, _) => f.locals[a] == Scalar::I8,
        Op::Select { dst, .. } => f.locals[dst] == Scalar::I8,
        _ => false,
    };
    block.insts.iter().filter(|i| is_bool(&i.op)).count()
}

/// True if a block goes to itself or to one before. The lowering numbers blocks in program order.
fn has_loop(f: &Function) -> bool {
    f.blocks.enumerate().any(|(id, block)| successors(&block.end).any(|to| to.index() <= id.index()))
}

/// Blocks that may follow; a block may stand there more than once.
pub(super) fn successors(end: &End) -> impl Iterator<Item = BlockId> {
    let (cases, rest): (&[(i64, BlockId)], [Option<BlockId>; 2]) = match end {
        End::Jump(to) => (&[], [Some(*to), None]),
        End::Branch { then, otherwise, .. } => (&[], [Some(*then), Some(*otherwise)]),
        End::Switch { cases, otherwise, .. } => (cases, [Some(*otherwise), None]),
        End::Return(_) | End::Trap(_) => (&[], [None, None]),
    };
    cases.iter().map(|c| c.1).chain(rest.into_iter().flatten())
}

/// The target in both styles.
pub(super) struct Isas {
    numbers: OwnedTargetIsa,
    contacts: OwnedTargetIsa,
}

impl Isas {
    pub(super) fn new() -> Result<Self, String> {
        Ok(Self { numbers: target("speed")?, contacts: target("none")? })
    }

    pub(super) fn get(&self, style: Style) -> &dyn TargetIsa {
        match style {
            Style::Numbers => &*self.numbers,
            Style::Contacts => &*self.contacts,
        }
    }

    pub(super) fn frontend(&self) -> TargetFrontendConfig {
        self.numbers.frontend_config()
    }
}

fn target(opt_level: &str) -> Result<OwnedTargetIsa, String> {
    let mut shared = settings::builder();
    let checked = if cfg!(debug_assertions) { "true" } else { "false" };
    for (name, value) in [
        ("opt_level", opt_level),
        ("is_pic", "true"),
        ("enable_verifier", checked),
        ("unwind_info", "false"),
        ("preserve_frame_pointers", "false"),
        ("enable_probestack", "true"),
        ("probestack_strategy", "inline"),
    ] {
        shared.set(name, value).map_err(|e| e.to_string())?;
    }
    let mut builder = isa::lookup_by_name("x86_64-unknown-linux-gnu").map_err(|e| e.to_string())?;
    for feature in ["has_sse3", "has_ssse3", "has_sse41", "has_sse42", "has_popcnt"] {
        builder.enable(feature).map_err(|e| e.to_string())?;
    }
    builder.finish(Flags::new(shared)).map_err(|e| format!("{e:?}"))
}
