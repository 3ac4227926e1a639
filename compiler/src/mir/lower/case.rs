//! CASE: wide ranges by comparison, everything else by one switch. Labels don't overlap, so the order of the tests is free.

use super::unit::Unit;
use crate::hir::model::*;
use crate::mir::model::*;
use takt_image::Elementary;

/// Labels of a branch, and its statements.
type Arm = (Vec<(i128, i128)>, Vec<Stmt>);

/// Ranges up to this many values are taken into the switch.
const SMALL: i128 = 8;

impl Unit<'_, '_> {
    /// CASE statement (§5.5).
    pub fn case(&mut self, selector: &Expr, arms: &[Arm], otherwise: &[Stmt]) {
        let e = self.hir.elementary(selector.ty).expect("a selector is a scalar");
        let value = self.value(selector);
        let done = self.f.block();
        let targets: Vec<_> = arms.iter().map(|_| self.f.block()).collect();
        let labels = || arms.iter().zip(&targets).flat_map(|((labels, _), block)| labels.iter().map(|l| (*l, *block)));
        labels().filter(|(l, _)| !is_small(*l)).for_each(|(range, block)| self.range_test(value, e, range, block));
        let default = self.f.block();
        let single = labels().filter(|(l, _)| is_small(*l));
        let cases = single.flat_map(|((low, high), block)| (low..=high).map(move |v| (v, block)));
        let cases: Vec<_> = cases.filter(|(v, _)| in_type(e, *v)).map(|(v, b)| (v as i64, b)).collect();
        self.f.end(if cases.is_empty() { End::Jump(default) } else { End::Switch { value, cases, otherwise: default } });
        for ((_, body), block) in arms.iter().zip(targets) {
            self.f.enter(block);
            self.statements(body);
            self.f.jump(done);
        }
        self.f.enter(default);
        self.statements(otherwise);
        self.f.jump(done);
        self.f.enter(done);
    }

    /// Jumps if the value is in the range: its distance from the lower end, unsigned, is not above the width.
    fn range_test(&mut self, value: Local, e: Elementary, (low, high): (i128, i128), block: BlockId) {
        let Some((min, max)) = e.int_range() else { return };
        let (low, high) = (low.max(min), high.min(max));
        if low > high {
            return;
        }
        let next = self.f.block();
        let distance = self.f.binary_const(BinaryOp::Sub, value, low as i64);
        let inside = self.f.compare_const(Compare::ULe, distance, (high - low) as i64);
        self.f.branch(inside, block, next);
        self.f.enter(next);
    }
}

fn is_small((low, high): (i128, i128)) -> bool {
    high - low < SMALL
}

fn in_type(e: Elementary, value: i128) -> bool {
    e.int_range().is_some_and(|(min, max)| (min..=max).contains(&value))
}
