//! Looks through statements for what changes memory: writes, places handed out by reference, calls.

use crate::hir::model::*;

/// Something that may change memory.
pub enum Event<'a> {
    /// Assigned here.
    Write(&'a Place),
    /// Handed to somebody by address: VAR_IN_OUT, or VAR_OUTPUT of a function.
    Lend(&'a Place),
    /// A reference to it is made.
    Refer(&'a Place),
    /// A unit is called.
    Call(PouId),
}

/// Reports all events of the statements, nested ones included.
pub fn statements<'a>(body: &'a [Stmt], on: &mut dyn FnMut(Event<'a>)) {
    body.iter().for_each(|s| statement(s, on));
}

fn statement<'a>(stmt: &'a Stmt, on: &mut dyn FnMut(Event<'a>)) {
    match &stmt.kind {
        StmtKind::Assign { target, value } => {
            write(target, on);
            expression(value, on);
        }
        StmtKind::CallBlock { instance, pou, inputs, outputs } => {
            place(instance, on);
            inputs.iter().for_each(|(_, a)| argument(a, on));
            on(Event::Call(*pou));
            outputs.iter().for_each(|o| write(&o.target, on));
        }
        StmtKind::Call(e) => expression(e, on),
        StmtKind::If { branches, otherwise } => {
            for (condition, body) in branches {
                expression(condition, on);
                statements(body, on);
            }
            statements(otherwise, on);
        }
        StmtKind::Case { selector, arms, otherwise } => {
            expression(selector, on);
            arms.iter().for_each(|(_, body)| statements(body, on));
            statements(otherwise, on);
        }
        StmtKind::For { variable, values, body } => {
            write(variable, on);
            values.iter().for_each(|e| expression(e, on));
            statements(body, on);
        }
        StmtKind::While { condition, body } | StmtKind::Repeat { body, until: condition } => {
            expression(condition, on);
            statements(body, on);
        }
        StmtKind::Exit | StmtKind::Continue | StmtKind::Return | StmtKind::Label(_) | StmtKind::Jump(_) => {}
    }
}

/// Reports all events of an expression.
pub fn expression<'a>(e: &'a Expr, on: &mut dyn FnMut(Event<'a>)) {
    match &e.kind {
        ExprKind::Const(_) => {}
        ExprKind::Load(p) => place(p, on),
        ExprKind::Address(p) => {
            place(p, on);
            on(Event::Refer(p));
        }
        ExprKind::Neg(a) | ExprKind::Not(a) | ExprKind::Convert(_, a) => expression(a, on),
        ExprKind::Binary(_, a, b) => {
            expression(a, on);
            expression(b, on);
        }
        ExprKind::Call { pou, args } => {
            args.iter().for_each(|a| argument(a, on));
            on(Event::Call(*pou));
        }
        ExprKind::Guarded(g) => {
            g.en.iter().for_each(|en| expression(en, on));
            expression(&g.call, on);
            if let Some(eno) = &g.eno {
                write(&eno.target, on);
            }
        }
        ExprKind::CallMethod(c) => {
            match &c.receiver {
                Receiver::Place(p) => place(p, on),
                Receiver::Reference(e) => expression(e, on),
            }
            c.args.iter().for_each(|a| argument(a, on));
            c.targets().into_iter().for_each(|t| on(Event::Call(t)));
        }
        ExprKind::AddressOf(p) => {
            place(p, on);
            on(Event::Lend(p));
        }
        ExprKind::OfClass(a, _) => expression(a, on),
        ExprKind::Stored(s) => {
            expression(&s.1, on);
            write(&s.0, on);
        }
        ExprKind::Intrinsic(_, args) | ExprKind::Native { args, .. } => args.iter().for_each(|a| expression(a, on)),
    }
}

/// Reports all events of an argument.
pub fn argument<'a>(arg: &'a Arg, on: &mut dyn FnMut(Event<'a>)) {
    match arg {
        Arg::Value(e) => expression(e, on),
        Arg::Reference(p) | Arg::Output { target: p, .. } => {
            place(p, on);
            on(Event::Lend(p));
        }
        Arg::Unused => {}
    }
}

fn write<'a>(p: &'a Place, on: &mut dyn FnMut(Event<'a>)) {
    place(p, on);
    on(Event::Write(p));
}

fn place<'a>(p: &'a Place, on: &mut dyn FnMut(Event<'a>)) {
    if let Base::Value(e) = &p.base {
        expression(e, on);
    }
    for step in &p.path {
        match step {
            Step::Index(indices) => indices.iter().for_each(|e| expression(e, on)),
            Step::Character(e) => expression(e, on),
            Step::Deref | Step::Field(_) | Step::Part { .. } => {}
        }
    }
}

/// True if evaluating the expression calls a user's unit, which may change anything.
pub fn calls(e: &Expr) -> bool {
    let mut found = false;
    expression(e, &mut |event| found |= matches!(event, Event::Call(_) | Event::Write(_)));
    found
}

/// Like [`calls`], for an argument.
pub fn argument_calls(arg: &Arg) -> bool {
    let mut found = false;
    argument(arg, &mut |event| found |= matches!(event, Event::Call(_) | Event::Write(_)));
    found
}
