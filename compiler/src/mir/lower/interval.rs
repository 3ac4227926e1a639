//! What values an integer expression can have: constants, FOR variables with constant bounds, and arithmetic of those. Lets bounds
//! checks be left out.

use super::unit::Unit;
use crate::hir::model::*;
use crate::syntax::ast::BinaryOp;

/// Smallest and largest value.
pub type Interval = (i128, i128);

impl Unit<'_, '_> {
    /// Values that `e` can have; `None` for what is not an integer.
    pub fn interval(&self, e: &Expr) -> Option<Interval> {
        let all = self.hir.elementary(e.ty)?.int_range()?;
        let found = match &e.kind {
            ExprKind::Const(Const::Int(i)) => Some((*i, *i)),
            ExprKind::Const(Const::Zero) => Some((0, 0)),
            ExprKind::Load(p) => self.counter(p).and_then(|c| c.range),
            ExprKind::Convert(Conversion::Integer | Conversion::Subrange, a) => self.interval(a),
            ExprKind::Binary(op, a, b) => self.interval_of(*op, a, b),
            _ => None,
        };
        Some(found.filter(|(low, high)| all.0 <= *low && *high <= all.1).unwrap_or(all))
    }

    fn interval_of(&self, op: BinaryOp, a: &Expr, b: &Expr) -> Option<Interval> {
        let ((a0, a1), (b0, b1)) = (self.interval(a)?, self.interval(b)?);
        match op {
            BinaryOp::Add => Some((a0 + b0, a1 + b1)),
            BinaryOp::Sub => Some((a0 - b1, a1 - b0)),
            BinaryOp::Mul if [a0, a1, b0, b1].iter().all(|v| v.unsigned_abs() < 1 << 62) => {
                let ends = [a0 * b0, a0 * b1, a1 * b0, a1 * b1];
                Some((*ends.iter().min()?, *ends.iter().max()?))
            }
            BinaryOp::Mod if b0 > 0 => Some((if a0 >= 0 { 0 } else { 1 - b1 }, b1 - 1)),
            _ => None,
        }
    }
}
