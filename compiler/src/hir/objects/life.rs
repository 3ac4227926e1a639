//! FB_init (vendor, §4.4): runs once for each instance before the first scan, that of the base first. Its arguments stand in the
//! declaration of the instance: `x : fb(a := 1)`.

use crate::hir::builder::Builder;
use crate::hir::model::*;
use crate::syntax::ast;
use takt_base::{Code, Diag, Span};
use takt_image::TypeId;
use takt_image::types::Type;

/// Parameters that the start gives.
const GIVEN: [&str; 2] = ["bInitRetains", "bInCopyCode"];

impl Builder<'_> {
    /// FB_init of a type and its bases, the base first.
    pub(in crate::hir) fn initialisers(&self, id: PouId) -> Vec<PouId> {
        let line = self.line(id).into_iter().rev();
        let found = line.filter_map(|t| self.objects.methods.get(&(t, "FB_INIT".to_owned())).copied());
        found.filter(|m| self.profile(self.symbols.pous[*m].decl.name.span).is_codesys()).collect()
    }

    /// The type of the instances in a variable that have FB_init, if they do.
    pub(in crate::hir) fn initialised_unit(&self, ty: TypeId) -> Option<PouId> {
        match self.ty(ty) {
            Type::Array { element, .. } => self.initialised_unit(*element),
            Type::Instance(_) => self.objects.types.get(&ty).copied().filter(|id| !self.initialisers(*id).is_empty()),
            _ => None,
        }
    }

    /// The calls for one instance.
    pub(in crate::hir) fn initialiser_calls(&mut self, id: PouId, place: &Place, arguments: Option<&ast::Init>) -> Vec<Stmt> {
        let list = self.initialisers(id);
        let given = self.named_arguments(&list, arguments);
        self.check_names(&list, &given);
        list.into_iter().filter_map(|method| self.initialiser_call(method, place, &given)).collect()
    }

    fn named_arguments(&mut self, methods: &[PouId], arguments: Option<&ast::Init>) -> Vec<(ast::Name, ast::Expr)> {
        let list = match arguments {
            None => return Vec::new(),
            Some(ast::Init::Struct(list, _)) => list,
            Some(ast::Init::Positional(list, span)) => return self.positional_arguments(methods, list, *span),
            Some(other) => {
                self.error(Code::BadInitializer, other.span(), "FB_init takes arguments with names: (a := 1)");
                return Vec::new();
            }
        };
        let mut given = Vec::new();
        for (name, init) in list {
            match init {
                ast::Init::Expr(e) => given.push((name.clone(), e.clone())),
                other => self.error(Code::BadInitializer, other.span(), "an argument of FB_init is an expression"),
            }
        }
        given
    }

    /// `(1, a)`: the parameters of the last FB_init, that of the type itself, in order.
    fn positional_arguments(&mut self, methods: &[PouId], list: &[ast::Expr], span: Span) -> Vec<(ast::Name, ast::Expr)> {
        let params =
            methods.last().map(|m| &self.hir.pous[*m]).into_iter().flat_map(|p| p.params.iter().map(|v| &p.vars[*v].name));
        let names: Vec<String> = params.filter(|n| !GIVEN.iter().any(|g| n.eq_ignore_ascii_case(g))).cloned().collect();
        if list.len() > names.len() {
            let label = format!("{} given, FB_init takes {} here", list.len(), names.len());
            self.error(Code::WrongArgumentCount, span, label);
        }
        names.into_iter().zip(list).map(|(text, e)| (ast::Name { text, span: e.span }, e.clone())).collect()
    }

    /// Reports arguments that no FB_init of the type has.
    fn check_names(&mut self, list: &[PouId], given: &[(ast::Name, ast::Expr)]) {
        for (name, _) in given {
            let own = GIVEN.iter().any(|g| name.is(g));
            if own || !list.iter().any(|m| self.parameter(*m, name).is_some()) {
                let inputs = list.iter().flat_map(|m| self.hir.pous[*m].vars.iter()).filter(|v| v.role == Role::Input);
                let known = inputs.map(|v| v.name.clone()).filter(|n| !GIVEN.contains(&n.as_str())).collect();
                self.unknown(Code::UnknownParameter, name, known);
            }
        }
    }

    fn parameter(&self, method: PouId, name: &ast::Name) -> Option<usize> {
        let pou = &self.hir.pous[method];
        pou.params.iter().position(|v| name.is(&pou.vars[*v].name))
    }

    fn initialiser_call(&mut self, method: PouId, place: &Place, given: &[(ast::Name, ast::Expr)]) -> Option<Stmt> {
        let span = place.span;
        let mut args = Vec::new();
        for (name, e) in given.iter().filter(|(name, _)| self.parameter(method, name).is_some()) {
            args.push(ast::Arg::Input { name: name.clone(), value: Some(e.clone()) });
        }
        self.check_all_given(method, &args, span);
        let mut args = self.user_arguments(method, &args, span)?;
        if let Some(i) = self.parameter(method, &ast::Name { text: GIVEN[0].to_owned(), span }) {
            args[i] = Arg::Value(self.retains_start_anew(span));
        }
        self.note_call(method, span);
        let ty = self.type_of_result(method);
        let call = MethodCall { receiver: Receiver::Place(place.clone()), method, dynamic: Vec::new(), args };
        let call = Expr { kind: ExprKind::CallMethod(Box::new(call)), ty, span };
        Some(Stmt { kind: StmtKind::Call(call), span })
    }

    /// Inputs without a default must stand in the declaration.
    fn check_all_given(&mut self, method: PouId, args: &[ast::Arg], span: Span) {
        let decl = self.symbols.pous[method].decl;
        let inputs = decl.sections.iter().filter(|s| s.kind == ast::SectionKind::Input).flat_map(|s| &s.decls);
        let open: Vec<&ast::Name> = inputs.filter(|d| d.init.is_none()).flat_map(|d| &d.names).collect();
        let is_given = |n: &ast::Name| args.iter().any(|a| matches!(a, ast::Arg::Input { name, .. } if name.is(&n.text)));
        let missing = open.into_iter().find(|n| !GIVEN.iter().any(|g| n.is(g)) && !is_given(n));
        if let Some(name) = missing {
            let label = format!("`{}` of FB_init is missing", name.text);
            let help = format!("write it behind the type: instance : type({} := value)", name.text);
            self.report(Diag::new(Code::WrongArgumentCount, span, label).also(name.span, "declared").help(help));
        }
    }

    /// TRUE unless retained variables were restored: then their mark, which is retained too, was set.
    fn retains_start_anew(&mut self, span: Span) -> Expr {
        let ty = self.bool();
        let mark = match self.objects.kept_mark {
            Some(mark) => mark,
            None => {
                let mark = self.new_global("restored at start".to_owned(), ty, Const::Zero, span);
                self.hir.globals[mark].keep = Keep::Retain;
                *self.objects.kept_mark.insert(mark)
            }
        };
        let place = Place { base: Base::Global(mark), path: Vec::new(), ty, span };
        let read = Expr { kind: ExprKind::Load(place), ty, span };
        Expr { kind: ExprKind::Not(Box::new(read)), ty, span }
    }

    /// The life-cycle methods that nothing calls here.
    pub(super) fn check_life_cycle(&mut self, decl: &ast::Pou) {
        let name = &decl.name;
        let label = "a method like any other here";
        let message = match () {
            () if name.is("FB_INIT") && !self.profile(name.span).is_codesys() => {
                "FB_init runs at the start in the CODESYS profiles only"
            }
            () if name.is("FB_REINIT") => "FB_reinit is not called: a program is not changed while it runs",
            () if name.is("FB_EXIT") => "FB_exit is not called: instances last until the controller stops",
            () => return,
        };
        let diag = Diag::new(Code::NotSupportedYet, name.span, label).severity(takt_base::Severity::Warning);
        self.report(diag.message(message).help("call it where it is wanted"));
    }
}
