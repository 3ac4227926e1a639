//! The target: x86-64 with SSE4.2 and POPCNT, System V, whatever machine the compiler runs on.
//!
//! One level of optimisation serves all but giants: numbers and loops gain 2-4 times. A network of BOOLs in memory neither gains nor loses (1000
//! rungs of the ladder benchmark: 1.1 us a scan either way; gcc -O2 1.7 us), since accesses have no alias regions: forwarding stores to
//! loads would make hundreds of values live at once, and spilling them costs more than the loads do (3.1 us with BOOLs in locals).

use crate::mir::model::{BlockId, End, Function};
use cranelift_codegen::isa::{self, OwnedTargetIsa, TargetFrontendConfig, TargetIsa};
use cranelift_codegen::settings::{self, Configurable, Flags};

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

/// How much work the compiler puts into the code.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Effort {
    /// Optimised code.
    #[default]
    Full,
    /// Everything as it stands: compiled two to three times faster, runs 2-4 times slower. What giants always get.
    Quick,
}

/// The target: for functions of usual size, and for giants.
pub(super) struct Target {
    usual: OwnedTargetIsa,
    giant: OwnedTargetIsa,
}

/// Instructions and blocks from which on a function is a giant. Optimiser and register allocator take time with the square of a
/// chain of dependent instructions, or of the blocks through which a local lives: seconds here, hours at ten times the size. A giant
/// is compiled as it stands, in a time that grows with its size alone, and runs 2-4 times slower.
const GIANT: (usize, usize) = (40_000, 8_000);

fn is_giant(f: &Function) -> bool {
    let insts: usize = f.blocks.iter().map(|b| b.insts.len()).sum();
    insts > GIANT.0 || f.blocks.len() > GIANT.1
}

impl Target {
    pub(super) fn new() -> Result<Self, String> {
        Ok(Self { usual: isa("speed", "backtracking")?, giant: isa("none", "single_pass")? })
    }

    /// How to compile this function.
    pub(super) fn isa(&self, f: &Function, effort: Effort) -> &dyn TargetIsa {
        if effort == Effort::Quick || is_giant(f) { &*self.giant } else { &*self.usual }
    }

    pub(super) fn frontend(&self) -> TargetFrontendConfig {
        self.usual.frontend_config()
    }
}

fn isa(opt_level: &str, regalloc: &str) -> Result<OwnedTargetIsa, String> {
    let mut shared = settings::builder();
    let checked = if cfg!(debug_assertions) { "true" } else { "false" };
    for (name, value) in [
        ("opt_level", opt_level),
        ("regalloc_algorithm", regalloc),
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
