//! From a project or an image file to a resource that can run: compile, read the machine, bind, load.

use crate::diagnostics;
use crate::host::PlcHost;
use crate::project::{self, Problem, Project, ProjectFile};
use crate::surroundings;
use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;
use takt_base::{Code, Nanos, Profile};
use takt_compiler::driver::{self, Compilation, File};
use takt_compiler::hir::Test;
use takt_compiler::mir::{Interpreter, model::Module};
use takt_image::value::VarType;
use takt_image::{Elementary, Engine, Image, encode};
use takt_motion::machine::{Background, Machine, MachineConfig};
use takt_runtime::{LoadError, NativeEngine, OnFault, Options, Resource, SimDriver, Stimulus};

/// Name of the project file inside an image.
const TOML: &str = "takt.toml";
/// Files that travel in an image: part programs and stimuli.
const ATTACHED: &[&str] = &["nc", "ngc", "tap", "gcode", "cnc", "csv"];
/// How long axes may take to come to rest at the end of a run.
const RUN_DOWN: Nanos = Nanos::from_millis(500);

/// A program that compiled, with what it needs to run.
pub struct Session {
    pub name: String,
    pub image: Image,
    /// For the interpreter; an image file has none.
    pub module: Option<Arc<Module>>,
    pub keys: ProjectFile,
    pub machine: MachineConfig,
    root: PathBuf,
}

/// Which engine runs the program.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum EngineKind {
    Native,
    Interpreter,
}

/// Parses, checks and compiles; messages stay in the answer.
pub fn compile(project: &Project) -> Result<Compilation, Problem> {
    Ok(driver::compile(to_compile(project)?))
}

/// Compiles without making machine code: all messages but the one of a unit too large for that.
pub fn check(project: &Project) -> Result<Compilation, Problem> {
    Ok(driver::compile(driver::Project { native: false, ..to_compile(project)? }))
}

/// What the compiler is given.
fn to_compile(project: &Project) -> Result<driver::Project, Problem> {
    let machine = project::machine(&project.keys)?;
    let interval = project.keys.task.interval.as_deref();
    let text = Machine::declarations(&machine).into_bytes();
    let declarations = File { name: "machine.st".into(), bytes: text, library: true, profile: Profile::Std };
    let sources =
        project.sources.iter().map(|s| File { name: s.name.clone(), bytes: s.bytes.clone(), library: false, profile: s.profile });
    Ok(driver::Project {
        name: project.name.clone(),
        files: std::iter::once(declarations).chain(sources).collect(),
        attachments: attachments(project),
        interval: interval.map(task_interval).transpose()?,
        native: true,
    })
}

/// `task.interval`, which can't be zero.
fn task_interval(text: &str) -> Result<Nanos, Problem> {
    let interval = project::time("task.interval", Some(text), Nanos::ZERO)?;
    if interval > Nanos::ZERO {
        return Ok(interval);
    }
    let text = format!("takt.toml: task.interval = \"{text}\" is no period; write for example \"10ms\"");
    Err(Problem::File(Code::BadProjectFile, text))
}

impl Session {
    /// Compiles a project, or opens an image file. Messages go to stderr; `None` if there are errors.
    pub fn open(paths: &[PathBuf], profile: Option<Profile>) -> Result<Option<Self>, Problem> {
        if let [file] = paths
            && is_image(file)
        {
            return Self::from_image(file).map(Some);
        }
        let project = project::load(paths, profile)?;
        let machine = project::machine(&project.keys)?;
        let compilation = compile(&project)?;
        diagnostics::print(&compilation.diags, &compilation.sources);
        let Some(image) = compilation.image else { return Ok(None) };
        if image.tasks.iter().all(|t| t.programs.is_empty()) {
            let text = format!("{}: {}", project.name, Code::NoProgram.title());
            return Err(Problem::File(Code::NoProgram, text));
        }
        let module = compilation.module.map(Arc::new);
        Ok(Some(Self { name: project.name, image, module, keys: project.keys, machine, root: project.root }))
    }

    /// Compiles the unit tests of a project. Messages go to stderr; `None` if there are errors.
    pub fn open_tests(paths: &[PathBuf], profile: Option<Profile>) -> Result<Option<(Self, Vec<Test>)>, Problem> {
        let project = project::load(paths, profile)?;
        let machine = project::machine(&project.keys)?;
        let (compilation, tests) = driver::compile_tests(to_compile(&project)?);
        diagnostics::print(&compilation.diags, &compilation.sources);
        let Some(image) = compilation.image else { return Ok(None) };
        let module = compilation.module.map(Arc::new);
        let session = Self { name: project.name, image, module, keys: project.keys, machine, root: project.root };
        Ok(Some((session, tests)))
    }

    fn from_image(file: &Path) -> Result<Self, Problem> {
        let bad = |e: &dyn std::fmt::Display| Problem::File(Code::BadImage, format!("{}: {e}", file.display()));
        let image = encode::decode(&project::read(file)?).map_err(|e| bad(&e))?;
        let toml = image.attachments.iter().find(|(name, _)| name == TOML);
        let text = toml.map(|(_, bytes)| String::from_utf8_lossy(bytes).into_owned()).unwrap_or_default();
        let keys = project::parse_keys(TOML, &text)?;
        let machine = project::machine(&keys)?;
        Ok(Self { name: image.name.clone(), image, module: None, keys, machine, root: PathBuf::new() })
    }

    /// A file that the project names: from the image if it travels there, else from the folder.
    pub fn file(&self, name: &str) -> Result<Vec<u8>, Problem> {
        match self.image.attachments.iter().find(|(n, _)| n == name) {
            Some((_, bytes)) => Ok(bytes.clone()),
            None => project::read(&self.root.join(name)),
        }
    }

    /// The machine, reading part programs as [`Session::file`] does. In real time parameters and tools are stored.
    pub fn machine(&self, background: Background) -> Rc<RefCell<Machine>> {
        let environment = surroundings::environment(self, background == Background::Thread);
        let machine = Machine::with_environment(&self.machine, environment, takt_motion::feeder::ngc_reader(), background);
        Rc::new(RefCell::new(machine))
    }

    /// The folder of the project; of an image, the working folder.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// A resource on this host. Call it on the thread that will run it.
    pub fn resource(&self, host: PlcHost, engine: EngineKind, options: Options) -> Result<Resource, Problem> {
        self.resource_of(self.image.clone(), host, engine, options)
    }

    /// The same with the tasks of another image.
    pub fn resource_of(
        &self,
        image: Image,
        mut host: PlcHost,
        engine: EngineKind,
        options: Options,
    ) -> Result<Resource, Problem> {
        let engine: Box<dyn Engine> = match (engine, &self.module) {
            (EngineKind::Native, _) => Box::new(NativeEngine::new(&image, &mut host).map_err(refused)?),
            (EngineKind::Interpreter, Some(module)) => {
                let bound = Interpreter::bind(module, &mut host, &image.types).map_err(|e| refused_text(format!("{e:?}")))?;
                let engine = Interpreter::new(Arc::clone(module), bound, image.memory.frames);
                Box::new(engine.map_err(|e| refused_text(format!("{e:?}")))?)
            }
            (EngineKind::Interpreter, None) => return Err(refused_text("an image file holds native code alone".into())),
        };
        Resource::new(image, engine, Box::new(host), options).map_err(refused)
    }

    /// Where `takt run` keeps retained values.
    pub fn retain_file(&self) -> PathBuf {
        self.root.join(self.keys.run.retain.as_deref().unwrap_or(".takt/retain"))
    }

    /// Run options of the project file.
    pub fn options(&self) -> Result<Options, Problem> {
        let run = &self.keys.run;
        let on_fault = match run.on_fault.as_deref().unwrap_or("stop-resource") {
            "stop-resource" => OnFault::StopResource,
            "stop-task" => OnFault::StopTask,
            other => {
                let text = format!("takt.toml: on_fault = \"{other}\"; write \"stop-resource\" or \"stop-task\"");
                return Err(Problem::File(Code::BadProjectFile, text));
            }
        };
        let defaults = Options::default();
        let watchdog = project::time("run.watchdog", run.watchdog.as_deref(), defaults.watchdog)?;
        let run_down = if self.machine.axes.is_empty() { Nanos::ZERO } else { RUN_DOWN };
        Ok(Options { on_fault, watchdog, run_down, ..defaults })
    }

    /// `run.duration` of the project file.
    pub fn duration(&self) -> Result<Option<Nanos>, Problem> {
        let text = self.keys.run.duration.as_deref();
        text.map(|t| project::time("run.duration", Some(t), Nanos::ZERO)).transpose()
    }

    /// The stimulus of a CSV file; of the project file if `file` is `None`; empty if neither names one.
    pub fn stimulus(&self, file: Option<&Path>) -> Result<Stimulus, Problem> {
        let (name, bytes) = match (file, &self.keys.run.stimulus) {
            (Some(path), _) => (path.display().to_string(), project::read(path)?),
            (None, Some(name)) => (name.clone(), self.file(name)?),
            (None, None) => return Ok(Stimulus::default()),
        };
        Stimulus::from_csv(&self.image, &String::from_utf8_lossy(&bytes)).map_err(|errors| {
            let lines: Vec<_> = errors.iter().map(|e| format!("{name}: {e}")).collect();
            Problem::File(Code::BadStimulus, lines.join("\n  "))
        })
    }

    /// The BOOL variable of `run.stop_when`.
    pub fn stop_when(&self) -> Result<Option<takt_image::path::Variable>, Problem> {
        let path = self.keys.run.stop_when.as_deref();
        path.map(|p| {
            let variable = takt_image::path::resolve(&self.image, p).map_err(|e| Problem::access(&e))?;
            if self.is_bool(&variable) {
                return Ok(variable);
            }
            let text = format!("takt.toml: stop_when = \"{p}\" is not a BOOL; name a variable that becomes TRUE");
            Err(Problem::File(Code::BadProjectFile, text))
        })
        .transpose()
    }

    fn is_bool(&self, v: &takt_image::path::Variable) -> bool {
        match v.ty {
            VarType::Declared(ty) => self.image.types.storage(ty) == Some(Elementary::Bool),
            VarType::Direct(e) => e == Elementary::Bool,
        }
    }
}

/// Connects a stimulus to a resource.
pub fn with_stimulus(resource: Resource, stimulus: Stimulus) -> Resource {
    resource.with_driver(Box::new(SimDriver::new(stimulus)))
}

fn refused(e: LoadError) -> Problem {
    Problem::File(e.code(), format!("{e}\n  help: {}", e.help()))
}

fn refused_text(text: String) -> Problem {
    Problem::File(Code::BadImage, text)
}

fn is_image(file: &Path) -> bool {
    let start = std::fs::File::open(file).and_then(|mut f| {
        let mut magic = [0; encode::MAGIC.len()];
        std::io::Read::read_exact(&mut f, &mut magic).map(|()| magic)
    });
    start.is_ok_and(|magic| magic == encode::MAGIC)
}

/// What travels in an image: the project file and the data files of its folder.
fn attachments(project: &Project) -> Vec<(String, Vec<u8>)> {
    let mut files = vec![(TOML.to_owned(), project.toml.clone().into_bytes())];
    files.extend(surroundings::of_channels(&project.root, &project.keys));
    if !project.toml.is_empty() {
        files.extend(surroundings::of_folder(&project.root, ATTACHED));
    }
    files
}
