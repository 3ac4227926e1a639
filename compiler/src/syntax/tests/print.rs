//! Trees as s-expressions, for tests: `a + b * c` is `(+ a (* b c))`.

use crate::syntax::ast::*;

/// A list in parentheses; empty parts are left out.
fn list(parts: impl IntoIterator<Item = String>) -> String {
    let parts: Vec<String> = parts.into_iter().filter(|p| !p.is_empty()).collect();
    format!("({})", parts.join(" "))
}

fn all<T>(items: &[T], print: impl Fn(&T) -> String) -> String {
    items.iter().map(print).collect::<Vec<_>>().join(" ")
}

fn optional<T>(item: &Option<T>, print: impl Fn(&T) -> String) -> String {
    item.as_ref().map_or(String::new(), print)
}

pub(super) fn file(file: &File) -> String {
    all(&file.items, item)
}

fn item(item: &Item) -> String {
    match item {
        Item::Types(list) => all(list, type_decl),
        Item::Pou(p) => pou(p),
        Item::Globals(s) => section(s),
        Item::Configuration(c) => configuration(c),
        Item::Namespace(n) => {
            let usings: String = n.usings.iter().map(|u| format!(" (using {})", u.text)).collect();
            let internal = if n.internal { " internal" } else { "" };
            let items = n.items.iter().map(|i| " ".to_owned() + &self::item(i));
            format!("(namespace{internal} {}{usings}{})", n.name.text, items.collect::<String>())
        }
        Item::Using(names) => all(names, |n| format!("(using {})", n.text)),
    }
}

fn pou(pou: &Pou) -> String {
    let kind = match pou.kind {
        PouKind::Function => "function",
        PouKind::FunctionBlock => "fb",
        PouKind::Program => "program",
        PouKind::Class => "class",
        PouKind::Interface => "interface",
        PouKind::Method => "method",
    };
    let external = if pou.external { "external" } else { "" };
    let result = optional(&pou.result, |t| format!(": {}", type_ref(t)));
    list([
        kind.into(),
        external.into(),
        pou.name.text.clone(),
        result,
        all(&pou.sections, section),
        stmts(&pou.body),
        all(&pou.objects.methods, self::pou),
    ])
}

fn section(s: &VarSection) -> String {
    let constant = if s.constant { "constant" } else { "" };
    let retain = match s.retain {
        Some(true) => "retain",
        Some(false) => "non_retain",
        None => "",
    };
    list([format!("{:?}", s.kind).to_lowercase(), constant.into(), retain.into(), all(&s.decls, var)])
}

fn var(v: &VarDecl) -> String {
    let names = all(&v.names, |n| n.text.clone());
    let at = optional(&v.at, |a| format!("at {}", address(a)));
    let edge = optional(&v.edge, |e| format!("{e:?}").to_lowercase());
    list([
        names,
        at,
        format!(": {}", type_ref(&v.ty)),
        edge,
        optional(&v.arguments, init),
        optional(&v.init, |i| format!(":= {}", init(i))),
    ])
}

fn type_decl(t: &TypeDecl) -> String {
    let body = match &t.body {
        TypeBody::Ref(r) => type_ref(r),
        TypeBody::Enum(e) => enumeration(e),
        TypeBody::Struct(members) => list(["struct".into(), all(members, var)]),
    };
    list(["type".into(), t.name.text.clone(), body, optional(&t.init, |i| format!(":= {}", init(i)))])
}

fn enumeration(e: &EnumDecl) -> String {
    let base = optional(&e.base, |b| b.text.clone());
    let value = |(name, value): &(Name, Option<Expr>)| match value {
        Some(v) => format!("{}={}", name.text, expr(v)),
        None => name.text.clone(),
    };
    list(["enum".into(), base, all(&e.values, value)])
}

fn type_ref(t: &TypeRef) -> String {
    match &t.kind {
        TypeRefKind::Named(n) => n.text.clone(),
        TypeRefKind::String { wide, capacity, .. } => {
            let name = if *wide { "WSTRING" } else { "STRING" };
            format!("{name}{}", optional(capacity, |c| format!("[{}]", expr(c))))
        }
        TypeRefKind::Subrange { base, low, high } => format!("{}({}..{})", base.text, expr(low), expr(high)),
        TypeRefKind::Array { dims, element } => {
            let dims: Vec<_> = dims.iter().map(|(l, h)| format!("{}..{}", expr(l), expr(h))).collect();
            format!("[{}]{}", dims.join(","), type_ref(element))
        }
        TypeRefKind::OpenArray { dims, element } => format!("[{}]{}", vec!["*"; *dims].join(","), type_ref(element)),
        TypeRefKind::Enum(e) => enumeration(e),
        TypeRefKind::Layout(l) => list([if l.union { "union" } else { "layout" }.into(), all(&l.members, var)]),
        TypeRefKind::Struct(members) => list(["struct".into(), all(members, var)]),
        TypeRefKind::Pointer { kind, target } => list([kind.text().to_lowercase().replace(' ', "_"), type_ref(target)]),
        TypeRefKind::Error => "?".into(),
    }
}

fn init(i: &Init) -> String {
    match i {
        Init::Expr(e) => expr(e),
        Init::Array(items, _) => format!("[{}]", all(items, array_init)),
        Init::Positional(items, _) => format!("({})", all(items, expr)),
        Init::Struct(items, _) => format!("{{{}}}", all(items, |(n, i)| format!("{}={}", n.text, init(i)))),
    }
}

fn array_init(a: &ArrayInit) -> String {
    match a {
        ArrayInit::One(i) => init(i),
        ArrayInit::Repeat(n, items) => format!("{}x({})", expr(n), all(items, init)),
    }
}

fn configuration(c: &Configuration) -> String {
    list(["configuration".into(), c.name.text.clone(), all(&c.globals, section), all(&c.resources, resource)])
}

fn resource(r: &Resource) -> String {
    let name = optional(&r.name, |n| n.text.clone());
    list(["resource".into(), name, all(&r.globals, section), all(&r.tasks, task), all(&r.programs, program)])
}

fn task(t: &TaskDecl) -> String {
    let part = |name: &str, e: &Option<Expr>| optional(e, |e| format!("{name}={}", expr(e)));
    list([
        "task".into(),
        t.name.text.clone(),
        part("single", &t.single),
        part("interval", &t.interval),
        part("priority", &t.priority),
    ])
}

fn program(p: &ProgramDecl) -> String {
    let retain = optional(&p.retain, |r| if *r { "retain".into() } else { "non_retain".into() });
    let task = optional(&p.task, |t| format!("with {}", t.text));
    list([
        "instance".into(),
        retain,
        p.name.text.clone(),
        task,
        format!(": {}", p.ty.text),
        all(&p.connections, arg),
        all(&p.blocks, |(b, t)| format!("({} with {})", b.text, t.text)),
    ])
}

pub(super) fn stmts(list: &[Stmt]) -> String {
    all(list, stmt)
}

fn block(stmts_: &[Stmt]) -> String {
    format!("{{{}}}", stmts(stmts_))
}

fn stmt(s: &Stmt) -> String {
    match &s.kind {
        StmtKind::Assign { target, value } => list([":=".into(), expr(target), expr(value)]),
        StmtKind::Chain { targets, value } => {
            let op = |o: &AssignOp| format!("{o:?}").to_ascii_lowercase();
            list([all(targets, |(t, o)| format!("{} {}", op(o), expr(t))), expr(value)])
        }
        StmtKind::Call(e) => expr(e),
        StmtKind::If { branches, otherwise } => {
            let branches = all(branches, |(c, b)| format!("{} {}", expr(c), block(b)));
            let otherwise = if otherwise.is_empty() { String::new() } else { format!("else {}", block(otherwise)) };
            list(["if".into(), branches, otherwise])
        }
        StmtKind::Case { selector, arms, otherwise } => {
            list(["case".into(), expr(selector), all(arms, arm), optional(otherwise, |o| format!("else {}", block(o)))])
        }
        StmtKind::For { variable, from, to, by, body } => {
            list(["for".into(), expr(variable), expr(from), expr(to), optional(by, |b| format!("by {}", expr(b))), block(body)])
        }
        StmtKind::While { condition, body } => list(["while".into(), expr(condition), block(body)]),
        StmtKind::Repeat { body, until } => list(["repeat".into(), block(body), expr(until)]),
        StmtKind::Exit => "exit".into(),
        StmtKind::Continue => "continue".into(),
        StmtKind::Return(value) => format!("return{}", optional(value, |v| format!(" {}", expr(v)))),
        StmtKind::Expression(e) => list(["drop".into(), expr(e)]),
        StmtKind::Label(name) => format!("{}:", name.text),
        StmtKind::Jump(name) => format!("jmp {}", name.text),
        StmtKind::Instructions(lines) => format!("(il {})", lines.len()),
        StmtKind::Empty => ";".into(),
        StmtKind::Attempt { target, value } => list(["?=".into(), expr(target), expr(value)]),
        StmtKind::Bind { target, value } => list(["ref=".into(), expr(target), expr(value)]),
        StmtKind::Error => "?".into(),
    }
}

fn arm(a: &CaseArm) -> String {
    let label = |l: &CaseLabel| format!("{}{}", expr(&l.low), optional(&l.high, |h| format!("..{}", expr(h))));
    let labels: Vec<_> = a.labels.iter().map(label).collect();
    list([labels.join(","), block(&a.body)])
}

pub(super) fn expr(e: &Expr) -> String {
    match &e.kind {
        ExprKind::Literal(l) => literal(l),
        ExprKind::Name(n) => n.text.clone(),
        ExprKind::Enumerator { ty, value } => format!("{}#{}", ty.text, value.text),
        ExprKind::Direct(a) => address(a),
        ExprKind::Unary(op, x) => {
            let op = match op {
                UnaryOp::Neg => "-",
                UnaryOp::Plus => "+",
                UnaryOp::Not => "NOT",
            };
            list([op.into(), expr(x)])
        }
        ExprKind::Binary(op, a, b) => list([op.text().into(), expr(a), expr(b)]),
        ExprKind::Member(base, n) => format!("{}.{}", expr(base), n.text),
        ExprKind::Index(base, items) => format!("{}[{}]", expr(base), all(items, expr)),
        ExprKind::Part { base, size, index } => format!("{}.%{}{index}", expr(base), letter(*size)),
        ExprKind::Call { callee, args } => list(["call".into(), expr(callee), all(args, arg)]),
        ExprKind::Assign { target, value } => list([":=".into(), expr(target), expr(value)]),
        ExprKind::Deref(e) => list(["^".into(), expr(e)]),
        ExprKind::Null => "null".into(),
        ExprKind::Error => "?".into(),
    }
}

fn arg(a: &Arg) -> String {
    match a {
        Arg::Positional(e) => expr(e),
        Arg::Input { name, value } => format!("{}:={}", name.text, optional(value, expr)),
        Arg::Output { name, negated, target } => {
            format!("{}{}=>{}", if *negated { "!" } else { "" }, name.text, optional(target, expr))
        }
    }
}

pub(super) fn literal(l: &Literal) -> String {
    match l {
        Literal::Int { value, based } => format!("{value}{}", if *based { "b" } else { "" }),
        Literal::Real(v) => format!("{v:?}"),
        Literal::Bool(b) => format!("{b}"),
        Literal::String(s) => format!("'{}'", s.escape_ascii()),
        Literal::WString(s) => format!("\"{}\"", String::from_utf16_lossy(s)),
        Literal::Time { ty, nanos } => format!("{}#{nanos}", ty.name()),
        Literal::Typed { ty, value } => format!("{}#{}", ty.name(), literal(value)),
    }
}

pub(super) fn address(a: &Address) -> String {
    let path: Vec<_> = a.path.iter().map(u32::to_string).collect();
    let path = if path.is_empty() { "*".into() } else { path.join(".") };
    let area = match a.area {
        Area::Input => "I",
        Area::Output => "Q",
        Area::Marker => "M",
    };
    format!("%{area}{}{path}", letter(a.size))
}

fn letter(size: AddressSize) -> &'static str {
    match size {
        AddressSize::Bit => "X",
        AddressSize::Byte => "B",
        AddressSize::Word => "W",
        AddressSize::Dword => "D",
        AddressSize::Lword => "L",
    }
}
