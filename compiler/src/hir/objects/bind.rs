//! THIS and the variables of the running instance, seen from methods; bodies of bases.

use crate::hir::builder::Builder;
use crate::hir::image::Owner;
use crate::hir::model::*;
use crate::hir::place::{Access, Target};
use crate::hir::scope::ReadOnly;
use crate::syntax::ast::{self, ExprKind as E};
use takt_base::{Code, Diag, Span};

impl Builder<'_> {
    /// True if the name is the word THIS and no variable.
    pub(in crate::hir) fn is_this(&self, name: &ast::Name) -> bool {
        name.is("THIS") && self.local("THIS").is_none() || name.is("SUPER") && self.local("SUPER").is_none()
    }

    /// THIS, or SUPER in front of a variable.
    pub(in crate::hir) fn this_place(&mut self, name: &ast::Name) -> Option<Target> {
        let object = if name.is("SUPER") {
            self.base_object(name.span)?
        } else if let Some(object) = self.this_object(name.span) {
            object
        } else {
            if self.own_type().is_none() {
                self.no_this(name.span, "THIS");
            }
            return None;
        };
        let Receiver::Place(place) = object.receiver else { return None };
        Some(Target { place, access: Access::Write })
    }

    /// A variable of the type that the running method belongs to.
    pub(in crate::hir) fn own_member(&mut self, id: VarId, name: &ast::Name) -> Option<Target> {
        let owner = self.own_type()?;
        if self.hir.pous[owner].vars[id].role == Role::InOut {
            let var = &self.hir.pous[owner].vars[id];
            let (span, help) = (var.span, "give the method a VAR_IN_OUT of its own, and pass the variable on");
            let diag = Diag::new(Code::NotSupportedYet, name.span, "a VAR_IN_OUT of the function block").also(span, "declared");
            self.report(
                diag.message("a VAR_IN_OUT can't be used in a method: it is bound during calls of the body only").help(help),
            );
            return None;
        }
        if self.edge_in_action(id, name.span) {
            return None;
        }
        let var = &self.hir.pous[owner].vars[id];
        let access = match self.scope.fixed_members.get(&id) {
            Some(ReadOnly::Constant) => Access::Constant(var.span),
            Some(ReadOnly::Input) => Access::OwnInput(var.span),
            None if self.image.area_of_var(owner, id) == Some(ast::Area::Input) => Access::InputImage,
            None if self.image.open_area(Owner::Var(owner, id)) == Some(ast::Area::Input) => Access::InputImage,
            None => Access::Write,
        };
        let (base, path) = match var.storage {
            Storage::Field(i) => (Base::This, vec![Step::Field(i)]),
            Storage::Image(place) => (Base::Image(place), Vec::new()),
            Storage::Local => return None,
        };
        Some(Target { place: Place { base, path, ty: var.ty, span: name.span }, access })
    }

    /// The value of a CONSTANT of the running instance.
    pub(in crate::hir) fn member_constant(&self, place: &Place) -> Option<Const> {
        let owner = &self.hir.pous[self.own_type()?];
        let [Step::Field(i), rest @ ..] = &place.path[..] else { return None };
        let (id, var) = owner.vars.enumerate().find(|(_, v)| v.storage == Storage::Field(*i))?;
        let fixed =
            self.scope.fixed_members.get(&id).or_else(|| self.scope.read_only.get(&id).filter(|_| self.scope.members.is_empty()));
        if fixed != Some(&ReadOnly::Constant) {
            return None;
        }
        self.constant_part(&var.init, var.ty, rest)
    }

    /// `SUPER()` and `THIS()`: the body of the base, or of the running instance. `None` for other callees.
    pub(in crate::hir) fn body_call(&mut self, callee: &ast::Expr, args: &[ast::Arg], span: Span) -> Option<Option<StmtKind>> {
        let E::Name(name) = &callee.kind else { return None };
        if !name.is("SUPER") || !self.is_this(name) {
            return None;
        }
        Some(self.super_body(name, args, span))
    }

    fn super_body(&mut self, name: &ast::Name, args: &[ast::Arg], span: Span) -> Option<StmtKind> {
        let object = self.base_object(name.span)?;
        let Receiver::Place(instance) = object.receiver else { return None };
        let running = self.scope.pou.map(|p| self.hir.pous[p].kind);
        if running != Some(PouKind::FunctionBlock) {
            let help = "a method calls the method of the base: SUPER.name()";
            self.report(Diag::new(Code::NotCallable, name.span, "SUPER() outside of the body").help(help));
            return None;
        }
        if self.hir.pous[object.ty].kind != PouKind::FunctionBlock {
            self.error(Code::NotCallable, name.span, "a class has no body");
            return None;
        }
        if let Some(first) = args.iter().find_map(crate::hir::body::arg_expr) {
            self.report(
                Diag::new(Code::WrongArgumentCount, first.span, "SUPER() has no arguments").help("assign the inputs before"),
            );
            return None;
        }
        self.note_call(object.ty, span);
        Some(StmtKind::CallBlock { instance, pou: object.ty, inputs: Vec::new(), outputs: Vec::new() })
    }

    /// A derived function block without statements runs the body of its base; not in CODESYS, where that needs SUPER^().
    pub(in crate::hir) fn inherited_body(&mut self, id: PouId, decl: &ast::Pou) -> Option<Stmt> {
        let base = self.hir.pous[id].base?;
        let wanted = decl.body.is_empty() && !self.profile(decl.name.span).is_codesys();
        if !wanted || self.hir.pous[base].kind != PouKind::FunctionBlock {
            return None;
        }
        let span = self.hir.pous[id].end;
        let instance = Place { base: Base::This, path: Vec::new(), ty: self.hir.pous[base].instance?, span };
        self.note_call(base, span);
        Some(Stmt { kind: StmtKind::CallBlock { instance, pou: base, inputs: Vec::new(), outputs: Vec::new() }, span })
    }

    /// Remembers that the bodies of derived function blocks may run too.
    pub(in crate::hir) fn note_bodies(&mut self, place: &Place, id: PouId, span: Span) {
        if self.is_dynamic(place) {
            let derived: Vec<PouId> = self.classes_of(id).into_iter().map(|c| c.1).collect();
            let from = self.scope.pou;
            self.objects.dynamic_calls.extend(derived.into_iter().map(|to| (from, to, span)));
        }
    }
}
