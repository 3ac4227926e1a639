//! What all passes share: the program so far, the names, the current scope, and how to report.

use super::convert::Notice;
use super::image::ImagePlan;
use super::model::*;
use super::scope::Scope;
use super::symbols::Symbols;
use std::collections::{BTreeMap, HashMap, HashSet};
use takt_base::{Code, Diag, Profile, Severity, Sink, Sources, Span};
use takt_image::types::{Record, Type};
use takt_image::{Elementary, TypeId};

/// Nesting of expressions, statements and types together.
const DEPTH_MAX: u32 = 700;
/// Scalars in all initial values together that are not zero: keeps the compiler's memory within bounds.
const LEAVES_MAX: usize = 1 << 22;

/// The program under construction.
pub(super) struct Builder<'a> {
    pub sources: &'a Sources,
    pub sink: &'a mut Sink,
    pub hir: Hir,
    pub symbols: Symbols<'a>,
    pub scope: Scope,
    /// Stands for a type that was wrong; absorbs whatever follows.
    pub error: TypeId,
    /// Default values of declared types; a type that is not here starts as zero.
    pub defaults: HashMap<TypeId, Const>,
    /// Enumerations with a declared base: their values are numbers (§2.5).
    pub named_values: HashSet<TypeId>,
    /// Anonymous enumerations of global variables.
    pub global_enums: Vec<TypeId>,
    /// Located variables and the size of the process image.
    pub image: ImagePlan,
    /// Who calls whom, and where. `None`: the connections of a program in the configuration.
    pub calls: Vec<(Option<PouId>, PouId, Span)>,
    /// Who uses globals whose names mean different variables in different resources, and where. `None`: the default of a type.
    pub uses: Vec<(Option<PouId>, GlobalId, Span)>,
    /// Only the place of a variable is wanted, which may be that of a global whose value is being resolved.
    pub place_only: bool,
    /// What is unusual about the conversion in progress.
    pub notices: Vec<Notice>,
    /// Members that are one bit of their byte, by structure and index: which bit.
    pub bit_members: HashMap<(TypeId, u32), u32>,
    /// The next standard function has EN or ENO.
    pub guards_next: bool,
    /// A call with EN or ENO is being put together: it stays for the run time, where it tells its errors by ENO.
    pub unfolded: bool,
    /// The tests are the machine: see `hir::build_tests`.
    pub tests: bool,
    /// Declarations of variables that some text mentions.
    pub used: HashSet<Span>,
    /// Types with their methods and heritage.
    pub objects: super::objects::Table,
    /// Program instances of all resources.
    pub planned: Vec<super::instance::Planned>,
    /// Initial values of program instances that VAR_CONFIG changes.
    pub values: BTreeMap<Root, Const>,
    /// Implicit instances of programs (vendor).
    pub program_globals: HashMap<PouId, GlobalId>,
    /// VAR_IN_OUT strings that are declared without a length.
    pub open_strings: HashSet<(PouId, VarId)>,
    /// What happens before the first scan.
    pub startup: super::startup::Startup,
    /// Parts of the initial value at hand that are computed later, if they may be.
    pub late_now: Option<super::late::Found>,
    leaves: usize,
    depth: u32,
}

impl<'a> Builder<'a> {
    /// Nothing yet.
    pub fn new(sources: &'a Sources, sink: &'a mut Sink) -> Self {
        let mut hir = Hir::default();
        let record = Record { name: "?".to_owned(), fields: Vec::new(), size: 0, align: 1 };
        let error = hir.types.add(Type::Struct(record));
        Self {
            sources,
            sink,
            hir,
            symbols: Symbols::default(),
            scope: Scope::default(),
            error,
            defaults: HashMap::new(),
            named_values: HashSet::new(),
            global_enums: Vec::new(),
            image: ImagePlan::default(),
            calls: Vec::new(),
            uses: Vec::new(),
            place_only: false,
            notices: Vec::new(),
            bit_members: HashMap::new(),
            guards_next: false,
            unfolded: false,
            tests: false,
            used: HashSet::new(),
            objects: super::objects::Table::default(),
            planned: Vec::new(),
            values: BTreeMap::new(),
            program_globals: HashMap::new(),
            open_strings: HashSet::new(),
            startup: super::startup::Startup::default(),
            late_now: None,
            leaves: 0,
            depth: 0,
        }
    }

    /// Reports; warnings about library files are nobody's business.
    pub fn report(&mut self, diag: Diag) {
        if diag.severity == Severity::Error || !self.in_library(diag.span) {
            self.sink.push(diag);
        }
    }
    /// Reports without help.
    pub fn error(&mut self, code: Code, span: Span, label: impl Into<String>) {
        self.report(Diag::new(code, span, label));
    }
    /// True for the standard library and generated declarations.
    pub fn in_library(&self, span: Span) -> bool {
        self.sources.get(span.source).library
    }
    /// The dialect of the file that this stands in.
    pub fn profile(&self, span: Span) -> Profile {
        self.sources.get(span.source).profile
    }
    /// A feature that this version does not have.
    pub fn unsupported(&mut self, span: Span, what: &str, help: &str) {
        self.report(Diag::new(Code::NotSupportedYet, span, what).help(help));
    }

    /// `what` at this place is understood in every profile, and an error in one that is not CODESYS.
    pub fn codesys_form(&mut self, span: Span, what: &str) {
        if !self.profile(span).is_codesys() && !self.in_library(span) {
            self.report(Diag::new(Code::VendorForm, span, what).help(Profile::CODESYS_HELP));
        }
    }

    /// Type id of an elementary type.
    pub fn elem(&mut self, e: Elementary) -> TypeId {
        self.hir.types.intern(Type::Elementary(e))
    }
    /// BOOL.
    pub fn bool(&mut self) -> TypeId {
        self.elem(Elementary::Bool)
    }
    /// The type itself.
    pub fn ty(&self, id: TypeId) -> &Type {
        self.hir.types.get(id)
    }
    /// The elementary type that it is, subranges and enumerations excluded.
    pub fn elementary(&self, id: TypeId) -> Option<Elementary> {
        if let Type::Elementary(e) = self.ty(id) { Some(*e) } else { None }
    }
    /// As the user writes it.
    pub fn show(&self, id: TypeId) -> String {
        self.hir.types.display(id)
    }

    /// Runs `f` one level deeper; `None` and a report if that is too deep.
    pub fn deeper<T>(&mut self, span: Span, f: impl FnOnce(&mut Self) -> T) -> Option<T> {
        if self.depth >= DEPTH_MAX {
            let help = "split it up: name a part of it and use the name";
            self.report(Diag::new(Code::NestedTooDeep, span, format!("more than {DEPTH_MAX} levels")).help(help));
            return None;
        }
        self.depth += 1;
        let result = f(self);
        self.depth -= 1;
        Some(result)
    }

    /// Counts a level of nesting, as [`Self::deeper`] does; false and a report if that is too deep.
    pub fn depth_enter(&mut self, span: Span) -> bool {
        let fine = self.deeper(span, |_| ()).is_some();
        self.depth += u32::from(fine);
        fine
    }
    /// Pairs with a [`Self::depth_enter`] that gave true.
    pub fn depth_leave(&mut self) {
        self.depth -= 1;
    }

    /// Counts initial values; false and a report if there are too many of them.
    pub fn charge(&mut self, leaves: usize, span: Span) -> bool {
        let before = self.leaves;
        self.leaves = before.saturating_add(leaves);
        if self.leaves <= LEAVES_MAX {
            return true;
        }
        if before <= LEAVES_MAX {
            let label = format!("more than {LEAVES_MAX} initial values that are not zero");
            let help = "leave large arrays at zero and fill them in the program";
            self.report(Diag::new(Code::TypeTooLarge, span, label).help(help));
        }
        false
    }
}
