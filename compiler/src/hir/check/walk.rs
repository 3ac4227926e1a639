//! A walk over statements in the order in which they run, for the rules of advice: what is read, written and lent, and where loops are.

use crate::hir::model::*;

/// What a rule may want to know.
pub(super) enum Event<'a> {
    /// A list of statements begins.
    List,
    /// The innermost list ends.
    EndList,
    /// A statement of the innermost list begins.
    Statement(&'a Stmt),
    /// A loop begins; what is in it may run again.
    Loop,
    EndLoop,
    /// An expression, before its parts.
    Expr(&'a Expr),
    /// A variable is read.
    Read(&'a Place),
    /// A variable gets a value: of this expression, or of a call.
    Write(&'a Place, Option<&'a Expr>),
    /// A variable is handed out: VAR_IN_OUT, a reference to it, a call of it.
    Lend(&'a Place),
    /// Something of the user's runs here that may read and write whatever it sees.
    Call,
}

/// Walks through a body.
pub(super) fn walk<'a>(body: &'a [Stmt], on: &mut dyn FnMut(Event<'a>)) {
    on(Event::List);
    for stmt in body {
        on(Event::Statement(stmt));
        statement(stmt, on);
    }
    on(Event::EndList);
}

fn statement<'a>(stmt: &'a Stmt, on: &mut dyn FnMut(Event<'a>)) {
    match &stmt.kind {
        StmtKind::Assign { target, value } => {
            expression(value, on);
            write(target, Some(value), on);
        }
        StmtKind::CallBlock { instance, inputs, outputs, .. } => {
            steps(instance, on);
            inputs.iter().for_each(|(_, a)| argument(a, on));
            on(Event::Lend(instance));
            on(Event::Call);
            outputs.iter().for_each(|o| write(&o.target, None, on));
        }
        StmtKind::Call(e) => expression(e, on),
        StmtKind::If { branches, otherwise } => {
            for (condition, body) in branches {
                expression(condition, on);
                walk(body, on);
            }
            walk(otherwise, on);
        }
        StmtKind::Case { selector, arms, otherwise } => {
            expression(selector, on);
            arms.iter().for_each(|(_, body)| walk(body, on));
            walk(otherwise, on);
        }
        StmtKind::For { variable, values, body } => {
            values.iter().for_each(|e| expression(e, on));
            write(variable, None, on);
            on(Event::Loop);
            on(Event::Read(variable));
            walk(body, on);
            on(Event::EndLoop);
        }
        StmtKind::While { condition, body } => {
            on(Event::Loop);
            expression(condition, on);
            walk(body, on);
            on(Event::EndLoop);
        }
        StmtKind::Repeat { body, until } => {
            on(Event::Loop);
            walk(body, on);
            expression(until, on);
            on(Event::EndLoop);
        }
        StmtKind::Exit | StmtKind::Continue | StmtKind::Return | StmtKind::Label(_) | StmtKind::Jump(_) => {}
    }
}

fn expression<'a>(e: &'a Expr, on: &mut dyn FnMut(Event<'a>)) {
    on(Event::Expr(e));
    match &e.kind {
        ExprKind::Const(_) => {}
        ExprKind::Load(p) => {
            steps(p, on);
            on(Event::Read(p));
        }
        ExprKind::Address(p) | ExprKind::AddressOf(p) => lend(p, on),
        ExprKind::Neg(a) | ExprKind::Not(a) | ExprKind::Convert(_, a) | ExprKind::OfClass(a, _) => expression(a, on),
        ExprKind::Stored(s) => {
            expression(&s.1, on);
            write(&s.0, Some(&s.1), on);
            on(Event::Read(&s.0));
        }
        ExprKind::Binary(_, a, b) => {
            expression(a, on);
            expression(b, on);
        }
        ExprKind::Call { args, .. } => {
            args.iter().for_each(|a| argument(a, on));
            on(Event::Call);
        }
        ExprKind::CallMethod(call) => method(call, on),
        ExprKind::Intrinsic(_, args) | ExprKind::Native { args, .. } => args.iter().for_each(|a| expression(a, on)),
        ExprKind::Guarded(g) => {
            g.en.iter().for_each(|en| expression(en, on));
            expression(&g.call, on);
            g.eno.iter().for_each(|eno| write(&eno.target, None, on));
        }
    }
}

fn method<'a>(call: &'a MethodCall, on: &mut dyn FnMut(Event<'a>)) {
    match &call.receiver {
        Receiver::Place(p) => lend(p, on),
        Receiver::Reference(e) => expression(e, on),
    }
    call.args.iter().for_each(|a| argument(a, on));
    on(Event::Call);
}

fn argument<'a>(arg: &'a Arg, on: &mut dyn FnMut(Event<'a>)) {
    match arg {
        Arg::Value(e) => expression(e, on),
        Arg::Reference(p) => lend(p, on),
        Arg::Output { target, .. } => write(target, None, on),
        Arg::Unused => {}
    }
}

fn write<'a>(p: &'a Place, value: Option<&'a Expr>, on: &mut dyn FnMut(Event<'a>)) {
    steps(p, on);
    on(Event::Write(p, value));
}

fn lend<'a>(p: &'a Place, on: &mut dyn FnMut(Event<'a>)) {
    steps(p, on);
    on(Event::Lend(p));
}

/// The expressions on the way to a place.
fn steps<'a>(p: &'a Place, on: &mut dyn FnMut(Event<'a>)) {
    if let Base::Value(e) = &p.base {
        expression(e, on);
    }
    for step in &p.path {
        match step {
            Step::Index(list) => list.iter().for_each(|e| expression(e, on)),
            Step::Character(e) => expression(e, on),
            Step::Deref | Step::Field(_) | Step::Part { .. } => {}
        }
    }
}

/// Where the bytes of a place are, as far as that is known before it runs: the variable, and whether a reference is followed from it.
pub(super) fn is_followed(p: &Place) -> bool {
    matches!(p.base, Base::Value(_)) || p.path.iter().any(|s| matches!(s, Step::Deref))
}

/// True if both are the same variable or member for sure; elements count if their indices are equal constants.
pub(super) fn same(a: &Place, b: &Place) -> bool {
    let base = match (&a.base, &b.base) {
        (Base::Var(x), Base::Var(y)) => x == y,
        (Base::Global(x), Base::Global(y)) => x == y,
        (Base::Image(x), Base::Image(y)) => x == y && a.ty == b.ty,
        (Base::This, Base::This) => true,
        _ => false,
    };
    base && a.path.len() == b.path.len() && a.path.iter().zip(&b.path).all(|(x, y)| same_step(x, y))
}

fn same_step(a: &Step, b: &Step) -> bool {
    match (a, b) {
        (Step::Field(x), Step::Field(y)) => x == y,
        (Step::Part { bit, width }, Step::Part { bit: b, width: w }) => (bit, width) == (b, w),
        (Step::Index(x), Step::Index(y)) => x.len() == y.len() && x.iter().zip(y).all(|(x, y)| same_index(x, y)),
        _ => false,
    }
}

fn same_index(a: &Expr, b: &Expr) -> bool {
    match (&a.kind, &b.kind) {
        (ExprKind::Const(x), ExprKind::Const(y)) => x == y,
        (ExprKind::Load(x), ExprKind::Load(y)) => same(x, y),
        (ExprKind::Convert(c, x), ExprKind::Convert(d, y)) => c == d && same_index(x, y),
        _ => false,
    }
}
