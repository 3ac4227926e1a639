//! FOR. The variable never passes a value that its type can't hold: before each step the distance to the end is compared with the
//! step, as unsigned numbers. From: language reference §5.6.

use super::interval::Interval;
use super::operator::compare_op;
use super::place::Loc;
use super::unit::{Home, LoopEnds, Unit};
use super::walk::{self, Event};
use crate::hir::model::*;
use crate::mir::model::*;
use crate::syntax::ast::BinaryOp as Operator;
use takt_image::{Elementary, Trap, Type, TypeId};

/// A FOR variable that nothing but its own loop changes: the loop's statements read it from a register.
#[derive(Clone, Copy)]
pub struct Counter {
    pub var: VarId,
    pub register: Local,
    /// Values within the loop.
    pub range: Option<Interval>,
}

/// Which way a loop counts.
#[derive(Clone, Copy)]
enum Direction {
    Up,
    Down,
    /// Known when it runs: the local is 1 for up.
    Either(Local),
}

/// A loop's registers.
struct Count {
    variable: Loc,
    ty: TypeId,
    e: Elementary,
    /// Values behind a step, if known.
    range: Option<Interval>,
    /// Holds the variable's value if it is steady.
    register: Option<Local>,
    to: Local,
    by: Local,
    direction: Direction,
}

impl Unit<'_, '_> {
    /// The counter that this place reads.
    pub fn counter(&self, p: &Place) -> Option<Counter> {
        let Base::Var(var) = p.base else { return None };
        self.counters.iter().rev().find(|c| c.var == var && p.path.is_empty()).copied()
    }

    /// FOR statement: `values` are FROM, TO and BY.
    pub fn for_loop(&mut self, variable: &Place, values: &[Expr; 3], body: &[Stmt]) {
        let line = self.f.line;
        let e = self.hir.elementary(variable.ty).expect("a FOR variable is an integer");
        let steady = self.steady(variable, body);
        let loc = self.place(variable);
        let [from, to, by] = values.each_ref().map(|v| self.held(v));
        let direction = self.direction(&values[2], by, e);
        let register = steady.map(|var| match loc {
            Loc::Register(l) => l,
            _ => *self.counter_registers.entry(var).or_insert_with(|| self.f.local(self.f.ty(from))),
        });
        let range = self.range(&values[0], &values[1], direction);
        let count = Count { variable: loc, ty: variable.ty, e, range, register, to, by, direction };
        let (inside, step, done) = (self.f.block(), self.f.block(), self.f.block());
        self.set(&count, from, self.interval(&values[0]));
        let beyond = self.passed(&count, from);
        self.f.branch(beyond, done, inside);
        self.f.enter(inside);
        let counter = steady.zip(register).map(|(var, register)| Counter { var, register, range });
        self.counters.extend(counter);
        self.loop_body(body, LoopEnds { exit: done, next: step });
        self.counters.truncate(self.counters.len() - counter.iter().count());
        self.f.line = line;
        self.f.jump(step);
        self.f.enter(step);
        self.step_on(&count, variable, inside, done);
        self.f.enter(done);
    }

    /// A value that the loop body can't change.
    fn held(&mut self, e: &Expr) -> Local {
        let value = self.value(e);
        if matches!(e.kind, ExprKind::Const(_)) { value } else { self.f.duplicate(value) }
    }

    fn direction(&mut self, by: &Expr, value: Local, e: Elementary) -> Direction {
        match self.interval(by) {
            Some((low, _)) if low > 0 => return Direction::Up,
            Some((_, high)) if high < 0 => return Direction::Down,
            _ => {}
        }
        let zero = self.f.compare_const(Compare::Eq, value, 0);
        self.f.trap_if(Trap::ForStep, zero);
        if !e.is_signed_storage() {
            return Direction::Up;
        }
        Direction::Either(self.f.compare_const(Compare::SGt, value, 0))
    }

    /// Values of the variable inside of the loop.
    fn range(&self, from: &Expr, to: &Expr, direction: Direction) -> Option<Interval> {
        let ((f0, f1), (t0, t1)) = (self.interval(from)?, self.interval(to)?);
        match direction {
            Direction::Up => Some((f0, t1.max(f0))),
            Direction::Down => Some((t0.min(f1), f1)),
            Direction::Either(_) => None,
        }
    }

    /// Stores a value of which `known` is known; it may be outside of the variable's subrange.
    fn set(&mut self, count: &Count, value: Local, known: Option<Interval>) {
        self.check_subrange(value, count.e, count.ty, known);
        if let Some(register) = count.register {
            self.f.copy(register, value);
        }
        self.store(count.variable, value);
    }

    /// True if a value is behind the end.
    fn passed(&mut self, count: &Count, value: Local) -> Local {
        let above = compare_op(Operator::Gt, count.e);
        let below = compare_op(Operator::Lt, count.e);
        self.by_direction(count, |unit, up| unit.f.compare(if up { above } else { below }, value, count.to))
    }

    fn by_direction(&mut self, count: &Count, mut make: impl FnMut(&mut Self, bool) -> Local) -> Local {
        match count.direction {
            Direction::Up => make(self, true),
            Direction::Down => make(self, false),
            Direction::Either(up) => {
                let (a, b) = (make(self, true), make(self, false));
                self.f.select(up, a, b)
            }
        }
    }

    /// The end of a pass: next value and back, or the last value and out.
    fn step_on(&mut self, count: &Count, variable: &Place, inside: BlockId, done: BlockId) {
        let value = match count.register {
            Some(register) => register,
            None => self.load(count.variable, variable.ty),
        };
        let (to, by) = (count.to, count.by);
        let left = self.by_direction(count, |unit, up| {
            let (a, b) = if up { (to, value) } else { (value, to) };
            unit.f.binary(BinaryOp::Sub, a, b)
        });
        let size = self.by_direction(count, |unit, up| if up { by } else { unit.f.unary(UnaryOp::Neg, by) });
        let mut last = self.f.compare(Compare::ULt, left, size);
        if count.register.is_none() {
            let beyond = self.passed(count, value);
            last = self.f.binary(BinaryOp::Or, last, beyond);
        }
        let next = self.f.binary(BinaryOp::Add, value, by);
        let (again, out) = (self.f.block(), self.f.block());
        self.f.branch(last, out, again);
        self.f.enter(again);
        self.set(count, next, count.range);
        self.f.jump(inside);
        self.f.enter(out);
        self.final_value(count, variable, value, next);
        self.f.jump(done);
    }

    /// The first value that failed the test, unless the type can't hold it.
    fn final_value(&mut self, count: &Count, variable: &Place, value: Local, next: Local) {
        let (gt, lt) = (compare_op(Operator::Gt, count.e), compare_op(Operator::Lt, count.e));
        let mut fits = self.by_direction(count, |unit, up| unit.f.compare(if up { gt } else { lt }, next, value));
        if let Type::Subrange { low, high, .. } = self.hir.types.get(variable.ty) {
            let distance = self.f.binary_const(BinaryOp::Sub, next, *low as i64);
            let inside = self.f.compare_const(Compare::ULe, distance, (high - low) as i64);
            fits = self.f.binary(BinaryOp::And, fits, inside);
        }
        let kept = self.f.select(fits, next, value);
        self.store(count.variable, kept);
    }

    /// The variable, if nothing in the body can change it: it is the unit's own, is neither written nor lent there, and the unit
    /// can't be entered again with the same instance.
    fn steady(&self, variable: &Place, body: &[Stmt]) -> Option<VarId> {
        let (&Base::Var(var), true) = (&variable.base, variable.path.is_empty()) else { return None };
        let own = matches!(self.var(var).role, Role::Local | Role::Temp | Role::Result | Role::Hidden);
        let mut changed = false;
        let mut calls = false;
        walk::statements(body, &mut |event| match event {
            Event::Write(p) if p.derefs() => calls |= self.program.wild || self.program.referred,
            Event::Write(p) | Event::Lend(p) | Event::Refer(p) => changed |= p.variable() == Some(var),
            Event::Call(_) => calls = true,
        });
        let private = match self.homes[var] {
            Home::Register(_) => true,
            Home::Memory(addr) if addr.base == AddrBase::Frame => !calls,
            Home::Memory(_) if calls && self.program.referred => false,
            Home::Memory(_) => !(calls && self.pou.is_none_or(|p| self.program.recursive[p])),
            Home::Image(_) | Home::Open(_) => false,
        };
        (own && !changed && private).then_some(var)
    }
}
