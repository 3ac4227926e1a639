//! The right to write: constants, inputs, outputs from outside, the input image, control variables (§3.1, §5.6).

use super::builder::Builder;
use super::model::*;
use super::part::ends_in_part;
use super::place::{Access, Target};
use crate::syntax::ast;
use takt_base::{Code, Diag, Severity, Span};
use takt_image::TypeId;

impl Builder<'_> {
    /// A place to write to; `None` and a report if it can't be written.
    pub fn writable(&mut self, e: &ast::Expr) -> Option<Place> {
        if let ast::ExprKind::Name(n) = &e.kind
            && self.is_enumerator(e)
            && self.global_id(n).is_none()
        {
            self.error(Code::NotAVariable, e.span, "a value of an enumeration");
            return None;
        }
        let target = self.place(e)?;
        self.check_write(&target, e.span).then_some(target.place)
    }

    pub(super) fn check_write(&mut self, target: &Target, span: Span) -> bool {
        let diag = match target.access {
            Access::Write => return self.check_control(&target.place, span),
            Access::Constant(at) => Diag::new(Code::AssignToConstant, span, "a constant").also(at, "declared CONSTANT"),
            Access::OwnInput(at) if self.profile(span).writes_inputs() => {
                self.warn_input_written(at, span);
                return true;
            }
            Access::OwnInput(at) => Diag::new(Code::AssignToInput, span, "an input of this unit")
                .also(at, "declared")
                .help("copy the input to a variable and change that"),
            Access::Inside => Diag::new(Code::AssignToOutput, span, "belongs to the function block")
                .help("only inputs of a function block can be assigned from outside"),
            Access::InputImage if self.in_test() => return true,
            Access::InputImage => Diag::new(Code::WriteToInputImage, span, "part of %I")
                .help("inputs come from the hardware; use %Q or %M for what the program writes"),
        };
        self.report(diag);
        false
    }

    /// A vendor form (§0): the caller keeps its value, the next call overwrites it.
    fn warn_input_written(&mut self, at: Span, span: Span) {
        self.report(
            Diag::new(Code::AssignToInput, span, "an input of this unit")
                .severity(Severity::Warning)
                .message("an input is assigned inside its own unit")
                .also(at, "declared")
                .help("copy the input to a variable and change that"),
        );
    }

    /// Control variables belong to their loop; also remembers that a function's result was written.
    fn check_control(&mut self, place: &Place, span: Span) -> bool {
        let Base::Var(id) = place.base else { return true };
        if self.scope.controls.contains(&id) {
            let help = "the loop counts by itself; use WHILE to step freely";
            let diag = Diag::new(Code::ForVariable, span, "controls the loop around this statement").help(help);
            let vendor = self.profile(span).is_vendor();
            self.report(if vendor { diag.severity(Severity::Warning) } else { diag });
            return vendor;
        }
        if let Some(pou) = self.scope.pou {
            self.objects.written.insert((pou, id));
        }
        if self.scope.pou.is_some_and(|p| self.hir.pous[p].result == Some(id)) {
            self.scope.result_written = true;
        }
        true
    }

    /// A place that a VAR_IN_OUT of type `ty` can be bound to (§4.7).
    pub fn bindable(&mut self, e: &ast::Expr, ty: TypeId, note: (Span, String), param: Option<(PouId, VarId)>) -> Option<Place> {
        let place = self.writable(e)?;
        if place.ty == self.error || ty == self.error {
            return None;
        }
        if ends_in_part(&place) || matches!(place.path.last(), Some(Step::Character(_))) {
            let help = "copy it to a variable, and copy the variable back after the call";
            let label = "a part of a variable, which has no address of its own";
            self.report(Diag::new(Code::NotAVariable, e.span, label).also(note.0, note.1).help(help));
            return None;
        }
        if param.is_some_and(|(id, var)| self.takes_string(id, var, place.ty)) {
            return Some(place);
        }
        if place.ty != ty && !self.open_takes(ty, place.ty) && !self.derives(place.ty, ty) {
            let label = format!("{}, exactly {} wanted", self.show(place.ty), self.show(ty));
            let help = "a VAR_IN_OUT refers to the variable itself, so nothing can be converted";
            self.report(Diag::new(Code::TypeMismatch, e.span, label).also(note.0, note.1).help(help));
            return None;
        }
        Some(place)
    }

    /// `target := value;`
    pub fn assign(&mut self, target: &ast::Expr, value: &ast::Expr) -> Option<StmtKind> {
        if let Some(call) = self.property_write(target, value) {
            return call;
        }
        let Some(target) = self.writable(target) else {
            self.operand(value, None);
            return None;
        };
        let ty = target.ty;
        let value = self.operand(value, Some(ty));
        let value = self.fit(value, ty);
        Some(StmtKind::Assign { target, value })
    }
}
