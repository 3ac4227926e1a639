//! One unit becomes one MIR function: parameters, where each variable lives, what happens at entry and at the end.
//!
//! A block or program has one parameter, the offset of its instance. A function has the place of an aggregate result first, then its
//! parameters: scalars by value, everything else as an offset. Outputs are written at the end, so that they can't disturb inputs.

use super::Program;
use super::builder::{Builder, at, behind, fixed};
use super::counted::Counter;
use super::open::OpenArray;
use super::place::{Loc, field};
use super::shape::{Shape, shape};
use super::walk::{self, Event};
use crate::hir::model::*;
use crate::mir::model::*;
use crate::mir::promote::promote;
use crate::mir::region::{Object, Region};
use crate::syntax::ast::Edge;
use std::collections::{HashMap, HashSet};
use takt_base::index::IndexVec;
use takt_base::{Code, Diag, Span};
use takt_image::image::Place as ImagePlace;
use takt_image::memory::FRAME_BYTES;
use takt_image::{Scalar, Trap};

/// Where a variable lives.
#[derive(Clone, Copy)]
pub enum Home {
    /// In a register.
    Register(Local),
    /// In the instance, on the frame, or where a reference points to.
    Memory(Addr),
    /// In the process image.
    Image(ImagePlace),
    /// An array of variable length: its number in [`Unit::open`].
    Open(usize),
}

/// Where EXIT and CONTINUE go.
#[derive(Clone, Copy)]
pub struct LoopEnds {
    pub exit: BlockId,
    pub next: BlockId,
}

/// A unit being lowered.
pub struct Unit<'p, 'h> {
    pub program: &'p mut Program<'h>,
    pub hir: &'h Hir,
    pub f: Builder,
    /// `None` in the entry of a program with connections.
    pub pou: Option<PouId>,
    /// The running instance, and its type.
    pub this: Option<Addr>,
    this_type: Option<takt_image::TypeId>,
    pub homes: IndexVec<VarId, Home>,
    pub open: Vec<OpenArray>,
    pub loops: Vec<LoopEnds>,
    pub counters: Vec<Counter>,
    /// Registers of FOR variables in memory; loops of one variable are never within each other.
    pub counter_registers: HashMap<VarId, Local>,
    /// Blocks of the labels met so far, at the label itself or at a jump to it.
    pub labels: HashMap<LabelId, BlockId>,
    /// Where RETURN goes.
    pub exit: BlockId,
    params: Vec<Local>,
    /// Outputs of a function and the offsets that they are written to at the end.
    outputs: Vec<(VarId, Local)>,
    /// Variables whose address is handed out.
    lent: HashSet<VarId>,
    /// The unit writes nothing but its own variables, so nobody can change an input during the call.
    quiet: bool,
}

/// Lowers a unit that is not external.
pub fn function(program: &mut Program<'_>, id: PouId) -> Function {
    let hir = program.hir;
    let pou = &hir.pous[id];
    let mut unit = Unit::new(program, Some(id), pou.body.first().map_or(pou.end, |s| s.span));
    unit.study(pou);
    unit.parameters(pou);
    unit.edges(pou);
    unit.initial_values(pou);
    unit.statements(&pou.body);
    unit.leave(pou);
    unit.finish(pou.name.clone(), pou.name.clone(), pou.result_scalar(hir), pou.end)
}

impl Pou {
    /// The register of a scalar result.
    fn result_scalar(&self, hir: &Hir) -> Option<Scalar> {
        match shape(&hir.types, self.vars[self.result?].ty) {
            Shape::Scalar(e) => Some(e.scalar()),
            _ => None,
        }
    }
}

impl<'p, 'h> Unit<'p, 'h> {
    /// An empty unit whose first instruction is on the line of `start`.
    pub fn new(program: &'p mut Program<'h>, pou: Option<PouId>, start: Span) -> Self {
        let mut f = Builder::new(program.lines.of(start));
        let exit = f.block();
        f.regions.named_instances = program.data.named_instances.clone();
        Unit {
            hir: program.hir,
            program,
            f,
            pou,
            this: None,
            this_type: None,
            homes: IndexVec::new(),
            open: Vec::new(),
            loops: Vec::new(),
            counters: Vec::new(),
            counter_registers: HashMap::new(),
            labels: HashMap::new(),
            exit,
            params: Vec::new(),
            outputs: Vec::new(),
            lent: HashSet::new(),
            quiet: true,
        }
    }

    /// Adds a parameter of the MIR function.
    pub fn param(&mut self, ty: Scalar) -> Local {
        let local = self.f.local(ty);
        self.params.push(local);
        local
    }

    /// The finished function; reports a frame that is too large.
    pub fn finish(self, name: String, pou: String, result: Option<Scalar>, span: Span) -> Function {
        if self.f.frame_bytes() > FRAME_BYTES as u64 {
            let label = format!("{pou} needs {} bytes for its local variables", self.f.frame_bytes());
            let help = format!("a unit has {} bytes at most; make large variables global", FRAME_BYTES);
            self.program.diags.push(Diag::new(Code::TypeTooLarge, span, label).help(help));
        }
        let (mut function, regions) = self.f.finish(name, pou, self.params, result);
        promote(&mut function, &regions, self.program.natives.as_slice());
        function
    }

    /// Adds the parameter with the offset of an instance.
    pub fn instance_param(&mut self, pou: &Pou) -> Addr {
        let this = self.param(Scalar::I32);
        let size = pou.instance.map_or(0, |ty| self.hir.types.layout(ty).size);
        self.f.regions.set(this, Region { object: Object::Instance, low: 0, high: size as u64, exact: true });
        if pou.kind == PouKind::Program && !self.hir.programs_are_instances {
            self.f.regions.named_instances = 0..0;
        }
        (self.this, self.this_type) = (Some(at(this)), pou.instance);
        at(this)
    }

    /// Type of the running instance.
    pub fn this_type(&self) -> takt_image::TypeId {
        self.this_type.expect("only types have instances")
    }

    /// Adds the parameter with the offset of something of the caller.
    fn reference_param(&mut self) -> Local {
        let local = self.param(Scalar::I32);
        self.f.regions.set(local, Region::whole(Object::Foreign));
        local
    }

    /// Continues on the line of `span`; returns the line before.
    pub fn at_line(&mut self, span: Span) -> LineId {
        std::mem::replace(&mut self.f.line, self.program.lines.of(span))
    }

    /// A variable of the unit.
    pub fn var(&self, id: VarId) -> &'h Var {
        let pou = self.pou.expect("only units have variables");
        &self.hir.pous[pou].vars[id]
    }

    fn study(&mut self, pou: &'h Pou) {
        let (lent, quiet) = (&mut self.lent, &mut self.quiet);
        let own = |p: &Place| match p.variable() {
            Some(v) => pou.vars[v].storage == Storage::Local && !matches!(pou.vars[v].role, Role::InOut | Role::Input),
            _ => false,
        };
        walk::statements(&pou.body, &mut |event| match event {
            Event::Write(p) => *quiet &= own(p),
            Event::Lend(p) | Event::Refer(p) => {
                *quiet &= own(p);
                if let Some(v) = p.variable() {
                    lent.insert(v);
                }
            }
            Event::Call(_) => *quiet = false,
        });
    }

    fn parameters(&mut self, pou: &'h Pou) {
        if let Some(owner) = pou.owner {
            self.instance_param(&self.hir.pous[owner]);
            self.function_parameters(pou);
        } else if pou.kind == PouKind::Function {
            self.function_parameters(pou);
        } else {
            self.instance_parameter(pou);
        }
    }

    fn instance_parameter(&mut self, pou: &'h Pou) {
        let this = self.instance_param(pou);
        let instance = pou.instance.expect("blocks and programs have an instance type");
        for (id, var) in pou.vars.enumerate() {
            let home = match var.storage {
                Storage::Image(place) => Home::Image(place),
                Storage::Local => self.local_home(id, var),
                Storage::Field(i) => {
                    let f = field(&self.hir.types, instance, i).expect("a field of the instance");
                    self.field_home(pou, var, behind(this, f.offset))
                }
            };
            self.homes.push(home);
        }
    }

    /// A VAR_IN_OUT field is read once: it can't be bound to something else during the call.
    fn field_home(&mut self, pou: &Pou, var: &Var, addr: Addr) -> Home {
        if var.role != Role::InOut {
            return Home::Memory(addr);
        }
        let target = self.f.load(Scalar::I32, addr);
        self.f.regions.set(target, Region::whole(Object::Foreign));
        if pou.kind == PouKind::Program || pou.unbinds {
            let unbound = self.f.compare_const(Compare::Eq, target, 0);
            self.f.trap_if(Trap::Reference, unbound);
        }
        self.check_in_out(target, self.hir.types.layout(var.ty).size);
        if self.is_open(var.ty) {
            return self.open_home(target, var.ty);
        }
        Home::Memory(at(target))
    }

    fn function_parameters(&mut self, pou: &'h Pou) {
        let owner = pou.owner.map(|o| &self.hir.pous[o]);
        let result = pou.result.filter(|r| !matches!(self.shape(pou.vars[*r].ty), Shape::Scalar(_)));
        let destination = result.map(|_| self.reference_param());
        let incoming: Vec<_> = pou.params.iter().map(|p| (*p, self.incoming(&pou.vars[*p]))).collect();
        for (id, var) in pou.vars.enumerate() {
            let given = incoming.iter().find(|(p, _)| *p == id).map(|(_, local)| *local);
            let home = match (var.role, given) {
                (_, Some(local)) if self.is_open(var.ty) => self.open_home(local, var.ty),
                (Role::InOut, Some(local)) => Home::Memory(at(local)),
                (Role::InOut, None) => self.borrowed_home(owner.expect("only actions borrow"), var),
                (Role::Input, Some(local)) => self.input_home(id, var, local),
                (Role::Result, _) if destination.is_some() && self.fixed_home(id).is_some() => {
                    self.outputs.push((id, destination.expect("checked")));
                    self.local_home(id, var)
                }
                (Role::Result, _) if destination.is_some() => Home::Memory(at(destination.expect("checked"))),
                (Role::Output, Some(local)) => {
                    self.outputs.push((id, local));
                    self.local_home(id, var)
                }
                _ => self.stored_home(id, var),
            };
            self.homes.push(home);
        }
    }

    /// What a VAR_IN_OUT of the unit is bound to, in one of its actions.
    fn borrowed_home(&mut self, owner: &Pou, var: &Var) -> Home {
        let (Storage::Field(i), Some(this)) = (var.storage, self.this) else { unreachable!("in-outs are fields") };
        let pin = field(&self.hir.types, self.this_type(), i).expect("a field of the instance").offset;
        self.field_home(owner, var, behind(this, pin))
    }

    fn stored_home(&mut self, id: VarId, var: &Var) -> Home {
        match var.storage {
            Storage::Image(place) => Home::Image(place),
            _ => self.local_home(id, var),
        }
    }

    fn incoming(&mut self, var: &Var) -> Local {
        match self.shape(var.ty) {
            Shape::Scalar(e) if var.role == Role::Input => self.param(e.scalar()),
            _ => self.reference_param(),
        }
    }

    /// An input given as `local`. An aggregate is copied unless nobody can change it during the call.
    fn input_home(&mut self, id: VarId, var: &Var, local: Local) -> Home {
        let shape = self.shape(var.ty);
        match shape {
            Shape::Scalar(_) if !self.lent.contains(&id) => Home::Register(local),
            Shape::Scalar(_) => {
                let own = self.own_space(id, var);
                self.f.store(own, local);
                Home::Memory(own)
            }
            _ if self.quiet => Home::Memory(at(local)),
            _ => {
                let own = self.own_space(id, var);
                self.copy_aggregate(own, shape, at(local), shape, var.ty);
                self.set_class(own, var.ty);
                Home::Memory(own)
            }
        }
    }

    fn local_home(&mut self, id: VarId, var: &Var) -> Home {
        match self.shape(var.ty) {
            Shape::Scalar(e) if !self.lent.contains(&id) => Home::Register(self.f.local(e.scalar())),
            _ => Home::Memory(self.own_space(id, var)),
        }
    }

    /// Place of a variable that pointers may point to.
    fn fixed_home(&self, id: VarId) -> Option<Addr> {
        self.program.statics.get(&(self.pou?, id)).map(|offset| fixed(*offset))
    }

    fn own_space(&mut self, id: VarId, var: &Var) -> Addr {
        if let Some(home) = self.fixed_home(id) {
            return home;
        }
        let layout = self.hir.types.layout(var.ty);
        self.f.temp(layout.size, layout.align)
    }

    /// R_EDGE and F_EDGE inputs: the body sees the edge in a register of its own, the field keeps the actual value (§3.3).
    fn edges(&mut self, pou: &'h Pou) {
        for (id, var) in pou.vars.enumerate() {
            let (Some((edge, memory)), Home::Memory(input)) = (var.edge, self.homes[id]) else { continue };
            let Home::Memory(memory) = self.homes[memory] else { continue };
            let now = self.f.load(Scalar::I8, input);
            let before = self.f.load(Scalar::I8, memory);
            self.f.store(memory, now);
            let changed = self.f.binary(BinaryOp::Xor, now, before);
            let wanted = if edge == Edge::Rising { now } else { before };
            let seen = self.f.binary(BinaryOp::And, changed, wanted);
            self.homes[id] = Home::Register(seen);
        }
    }

    /// Locals, outputs and the result of a function start anew at each call, as VAR_TEMP does everywhere.
    fn initial_values(&mut self, pou: &'h Pou) {
        for (id, var) in pou.vars.enumerate() {
            let block_eno = var.role == Role::Output && var.init == Const::Int(1) && var.name.eq_ignore_ascii_case("ENO");
            if let (true, Storage::Field(_), Home::Memory(pin)) = (block_eno, var.storage, self.homes[id]) {
                let on = self.f.int(Scalar::I8, 1);
                self.f.store(pin, on);
            }
            let given = matches!(var.role, Role::Input | Role::InOut);
            let starts_anew = var.storage == Storage::Local || var.role == Role::Temp;
            if !starts_anew || given || self.is_open(var.ty) {
                continue;
            }
            match (self.shape(var.ty), self.homes[id]) {
                (Shape::Scalar(e), home) => {
                    let value = self.constant(e, &var.init);
                    let loc = home_loc(home);
                    self.store(loc, value);
                }
                (_, Home::Memory(addr)) => self.fill(addr, var.ty, &var.init, var.span),
                _ => {}
            }
        }
    }

    /// Writes a constant of an aggregate type.
    fn fill(&mut self, to: Addr, ty: takt_image::TypeId, value: &Const, span: Span) {
        let size = self.hir.types.layout(ty).size;
        if *value == Const::Zero {
            self.f.emit(Op::FillBytes { to, size, value: 0 });
        } else {
            let from = self.pooled(ty, value, span);
            self.f.emit(Op::CopyBytes { to, from, size });
        }
    }

    /// The end of the body, where RETURN goes too.
    fn leave(&mut self, pou: &'h Pou) {
        self.at_line(pou.end);
        self.f.jump(self.exit);
        self.f.enter(self.exit);
        for (var, target) in std::mem::take(&mut self.outputs) {
            let ty = pou.vars[var].ty;
            match (self.shape(ty), self.homes[var]) {
                (Shape::Scalar(_), home) => {
                    let value = self.load(home_loc(home), ty);
                    self.f.store(at(target), value);
                }
                (shape, Home::Memory(from)) => self.copy_aggregate(at(target), shape, from, shape, ty),
                _ => {}
            }
        }
        let result = pou.result.filter(|r| matches!(self.shape(pou.vars[*r].ty), Shape::Scalar(_)));
        let value = result.map(|r| self.load(home_loc(self.homes[r]), pou.vars[r].ty));
        self.f.end(End::Return(value));
    }

    /// Shape of a type.
    pub fn shape(&self, ty: takt_image::TypeId) -> Shape {
        shape(&self.hir.types, ty)
    }
}

fn home_loc(home: Home) -> Loc {
    match home {
        Home::Register(l) => Loc::Register(l),
        Home::Memory(a) => Loc::Memory(a),
        Home::Image(_) | Home::Open(_) => unreachable!("locals are not in the process image"),
    }
}
