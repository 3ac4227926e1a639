//! Which locals an instruction writes and reads.

use super::model::*;

impl Op {
    /// The local that is assigned.
    pub fn target(&self) -> Option<Local> {
        match self {
            Op::Int(d, _) | Op::Float(d, _) | Op::Copy(d, _) | Op::Unary(_, d, _) | Op::Binary(_, d, ..) => Some(*d),
            Op::Compare(_, d, ..) | Op::Convert(_, d, _) | Op::Load(d, _) | Op::Address(d, _) => Some(*d),
            Op::Select { dst, .. } | Op::CompareString { dst, .. } => Some(*dst),
            Op::Call { dst, .. } | Op::CallNative { dst, .. } => *dst,
            Op::Store(..) | Op::CopyBytes { .. } | Op::FillBytes { .. } | Op::CopyString { .. } | Op::TrapIf(..) => None,
        }
    }

    /// Hands out every local that is read, bases of addresses included.
    pub fn reads(&self, mut on: impl FnMut(Local)) {
        match self {
            Op::Int(..) | Op::Float(..) => {}
            Op::Copy(_, a) | Op::Unary(_, _, a) | Op::Convert(_, _, a) | Op::TrapIf(_, a) => on(*a),
            Op::Binary(_, _, a, b) | Op::Compare(_, _, a, b) => [*a, *b].into_iter().for_each(on),
            Op::Select { condition, then, otherwise, .. } => [*condition, *then, *otherwise].into_iter().for_each(on),
            Op::Load(_, addr) | Op::Address(_, addr) | Op::FillBytes { to: addr, .. } => {
                addr.base_local().into_iter().for_each(on)
            }
            Op::Store(addr, a) => addr.base_local().into_iter().chain([*a]).for_each(on),
            Op::CopyBytes { to, from, .. } | Op::CopyString { to, from, .. } => {
                [to, from].into_iter().filter_map(|a| a.base_local()).for_each(on);
            }
            Op::CompareString { a, b, .. } => [a, b].into_iter().filter_map(|a| a.base_local()).for_each(on),
            Op::Call { args, .. } => args.iter().copied().for_each(on),
            Op::CallNative { args, .. } => args.iter().for_each(|a| on(a.local)),
        }
    }
}

impl Addr {
    /// The local that it is based on.
    pub fn base_local(&self) -> Option<Local> {
        if let AddrBase::Local(l) = self.base { Some(l) } else { None }
    }
}

impl End {
    /// The local that decides, or that is returned.
    pub fn read(&self) -> Option<Local> {
        match self {
            End::Branch { condition, .. } => Some(*condition),
            End::Switch { value, .. } => Some(*value),
            End::Return(value) => *value,
            End::Jump(_) | End::Trap(_) => None,
        }
    }
}

impl Function {
    /// For each local whether it lives within one block: never read there before it is written, and nowhere else.
    pub fn block_local(&self) -> Vec<bool> {
        let mut home: Vec<Option<BlockId>> = vec![None; self.locals.len()];
        let mut local = vec![true; self.locals.len()];
        self.params.iter().for_each(|p| local[p.0 as usize] = false);
        for (id, block) in self.blocks.enumerate() {
            for inst in &block.insts {
                inst.op.reads(|l| local[l.0 as usize] &= home[l.0 as usize] == Some(id));
                if let Some(l) = inst.op.target() {
                    local[l.0 as usize] &= home[l.0 as usize].is_none_or(|h| h == id);
                    home[l.0 as usize] = Some(id);
                }
            }
            block.end.read().into_iter().for_each(|l| local[l.0 as usize] &= home[l.0 as usize] == Some(id));
        }
        local
    }
}

#[cfg(test)]
mod tests {
    use super::super::text;
    use super::*;

    #[test]
    fn a_local_of_one_block_is_told_from_others() {
        let source = "func f (v0: i32) -> i32 {\n  i32: v1 v2 v3 v4\nb0:\n  v1 = add v0, v0\n  v2 = add v1, v1\n  v3 = add v3, v1\n  \
                      jump b1\nb1:\n  v4 = add v2, v3\n  return v4\n}\n";
        let module = text::parse(source).expect("a module");
        assert_eq!(module.functions[FuncId(0)].block_local(), [false, true, false, false, true]);
    }
}
