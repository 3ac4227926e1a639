//! The whole compiler, in the order it happens. The standard library's blocks are compiled with every program, in front of it.

use crate::codegen::{self, Code};
use crate::mir::{self, Lowered, model::Module};
use crate::syntax::{self, ast};
use crate::{hir, hir::model::Hir};
use takt_base::{Code as DiagCode, Diag, Nanos, Profile, Sink, SourceId, Sources, Span};
use takt_image::Image;
use takt_image::image::Target;

/// What is compiled.
#[derive(Clone, Debug)]
pub struct Project {
    /// Name of the image.
    pub name: String,
    /// Files in order; the standard library is added in front.
    pub files: Vec<File>,
    /// Goes into the image as it is: name and contents.
    pub attachments: Vec<(String, Vec<u8>)>,
    /// Period of the task that a project without CONFIGURATION gets; `None`: [`hir::DEFAULT_INTERVAL`].
    pub interval: Option<Nanos>,
    /// Make machine code; without, the image is for the interpreter alone.
    pub native: bool,
}

/// A source file.
#[derive(Clone, Debug)]
pub struct File {
    /// Path or name, as shown in messages.
    pub name: String,
    /// UTF-8 or Latin-1.
    pub bytes: Vec<u8>,
    /// Declarations that a library brings along: no warnings about it.
    pub library: bool,
    /// Dialect.
    pub profile: Profile,
}

/// What came out.
#[derive(Debug)]
pub struct Compilation {
    /// All files, for showing messages.
    pub sources: Sources,
    /// Messages by place. If one is an error there is neither image nor module.
    pub diags: Vec<Diag>,
    /// The compiled program.
    pub image: Option<Image>,
    /// The form that the interpreter runs.
    pub module: Option<Module>,
}

/// Compiles a project.
pub fn compile(project: Project) -> Compilation {
    let (sources, mut sink) = (sources(&project.files), Sink::new());
    let files = parse(&sources, &mut sink);
    let mut hir = hir::build(&files, &sources, &mut sink);
    syntax::silence::apply(&files, &mut sink);
    set_interval(&mut hir, &files, project.interval);
    drop(files); // the lowering uses their memory again
    compilation(hir, sources, project, sink)
}

/// Compiles the unit tests of a project: the image has a task for each, in the same order, and no others.
pub fn compile_tests(project: Project) -> (Compilation, Vec<hir::Test>) {
    let (sources, mut sink) = (sources(&project.files), Sink::new());
    let files = parse(&sources, &mut sink);
    let (hir, tests) = hir::build_tests(&files, &sources, &mut sink);
    syntax::silence::apply(&files, &mut sink);
    drop(files);
    (compilation(hir, sources, project, sink), tests)
}

fn parse(sources: &Sources, sink: &mut Sink) -> Vec<(SourceId, ast::File)> {
    sources.iter().map(|(id, _)| (id, syntax::parse(sources, id, sink))).collect()
}

fn compilation(hir: Hir, sources: Sources, project: Project, mut sink: Sink) -> Compilation {
    let built = if sink.has_errors() { None } else { finish(hir, &sources, project, &mut sink) };
    let (image, module) = built.unzip();
    Compilation { diags: sink.into_sorted(), sources, image, module }
}

/// The second half: what happens to a program without errors. Its size may still be one.
fn finish(hir: Hir, sources: &Sources, project: Project, sink: &mut Sink) -> Option<(Image, Module)> {
    let lowered = mir::lower(&hir, sources).map_err(|diags| diags.into_iter().for_each(|d| sink.push(d))).ok()?;
    let problems = mir::verify(&lowered.module);
    assert!(problems.is_empty(), "the lowering broke a rule: {}", problems[0]);
    let code = if project.native { codegen::emit(&lowered.module) } else { Ok(Code::default()) };
    let code = code.map_err(|why| sink.push(too_large_for_code(sources, &why))).ok()?;
    let Lowered { module, memory, init, symbols, retained, tasks } = lowered;
    let image = Image {
        name: project.name,
        target: if project.native { Target::X86_64V2 } else { Target::None },
        types: hir.types,
        memory,
        init,
        symbols,
        natives: module.natives.as_slice().to_vec(),
        functions: code.functions,
        code: code.code,
        traps: code.traps,
        lines: code.lines,
        files: module.files.clone(),
        tasks,
        retained,
        attachments: project.attachments,
    };
    Some((image, module))
}

fn sources(files: &[File]) -> Sources {
    let mut sources = Sources::new();
    for (name, text) in takt_stdlib::SOURCES {
        sources.add_library(*name, *text);
    }
    for (name, text, profile) in takt_stdlib::vendor::VENDOR_SOURCES {
        if files.iter().any(|f| takt_stdlib::vendor::has_source(f.profile, *profile)) {
            let id = sources.add_library(*name, *text);
            sources.set_profile(id, *profile);
        }
    }
    let (name, text, profile) = takt_stdlib::PRELUDE;
    if files.iter().any(|f| f.profile == profile) {
        sources.add_library(name, text);
    }
    for file in files {
        let id = match file.library {
            true => sources.add_library_bytes(&file.name, file.bytes.clone()),
            false => sources.add_bytes(&file.name, file.bytes.clone()),
        };
        sources.set_profile(id, file.profile);
    }
    sources
}

/// Gives the tasks of a project without CONFIGURATION their period.
fn set_interval(hir: &mut Hir, files: &[(SourceId, ast::File)], interval: Option<Nanos>) {
    let configured = files.iter().flat_map(|(_, f)| &f.items).any(|i| matches!(i, ast::Item::Configuration(_)));
    if let (Some(interval), false) = (interval, configured) {
        hir.tasks.iter_mut().for_each(|t| t.interval = Some(interval));
    }
}

/// The code generator has limits of its own, far beyond what a unit should be.
fn too_large_for_code(sources: &Sources, why: &str) -> Diag {
    let last = sources.iter().last().map_or(SourceId(0), |(id, _)| id);
    Diag::new(DiagCode::TypeTooLarge, Span::new(last, 0, 0), why)
        .message("no machine code can be made for this program")
        .help("split very large units into several")
}
