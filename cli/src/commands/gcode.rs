//! `takt gcode`: what a part program says, whether it is right, how it would move, how it looks.

use crate::Status;
use crate::diagnostics;
use crate::project::{self, Problem};
use crate::subroutines::{self, Subroutines, tables};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use takt_base::{Code, Diag, SourceId, Sources, Span};
use takt_motion::canon::Step;
use takt_motion::ngc::{self, HostRef, Interpreter, Options, Text};
use takt_motion::{draw, print};

/// Print, check, plan or plot a part program
#[derive(clap::Args)]
#[command(after_help = "Example: takt gcode plate.nc --modes G91 --plot plate.svg")]
#[command(group(clap::ArgGroup::new("what").required(true).multiple(true).args(["canon", "check", "plan", "plot", "trace"])))]
pub struct Args {
    /// Part program
    file: PathBuf,
    /// Print the canonical commands
    #[arg(long)]
    canon: bool,
    /// With --canon: the source line in front of each
    #[arg(long, requires = "canon")]
    number_lines: bool,
    /// With --canon: begin at this line, as a block search does; nothing before it is executed
    #[arg(long, value_name = "LINE", requires = "canon", value_parser = clap::value_parser!(u32).range(1..))]
    from_line: Option<u32>,
    /// Find all errors
    #[arg(long)]
    check: bool,
    /// Plan without a machine
    #[arg(long)]
    plan: bool,
    /// Write a picture of the tool path
    #[arg(long, value_name = "OUT.svg")]
    plot: Option<PathBuf>,
    /// Write the set points, a row an interpolation period
    #[arg(long, value_name = "OUT.csv")]
    trace: Option<PathBuf>,
    /// Codes that are active at the start, such as "G21 G91"
    #[arg(long, default_value = "")]
    modes: String,
    /// Skip blocks that start with /
    #[arg(long)]
    skip_deleted: bool,
    /// Language of the program
    #[arg(long, default_value = "ngc", value_parser = ["ngc", "linuxcnc", "fanuc-mill", "fanuc-turn"])]
    dialect: String,
    /// Take files as users stream them: 3-D printer words, `%` inside, a bare G92
    #[arg(long)]
    lenient: bool,
    /// Setting of a Fanuc-style control, such as increments, G100=9010 or rough_depth=1.5; may stand several times
    #[arg(long, value_name = "SETTING", value_parser = setting)]
    set: Vec<String>,
    /// Tool table
    #[arg(long, value_name = "FILE")]
    tool_table: Option<PathBuf>,
    /// Parameter file
    #[arg(long, value_name = "FILE")]
    params: Option<PathBuf>,
    /// Folder with files of subroutines, beside that of the program; may stand several times
    #[arg(long, value_name = "DIR")]
    subs: Vec<PathBuf>,
    #[command(flatten)]
    plan_args: super::gcode_plan::PlanArgs,
}

pub fn run(args: Args) -> Status {
    super::finish(execute(&args))
}

/// A part program that was read.
pub struct PartProgram {
    subroutines: Arc<Subroutines>,
    text: Text,
    pub id: SourceId,
    pub options: Options,
}

impl PartProgram {
    fn read(args: &Args) -> Result<Self, Problem> {
        let mut sources = Sources::new();
        let (id, text) = subroutines::open(&args.file, &mut sources).map_err(|e| project::unreadable(&args.file, &e))?;
        let modes = sources.add("--modes", args.modes.clone());
        let tools = args.tool_table.as_deref().map(|path| tables::tools(path, &mut sources, 1.0)).transpose()?;
        let parameters = args.params.as_deref().map(|path| tables::parameters(path, &mut sources)).transpose()?;
        let folders = args.file.parent().map(Path::to_path_buf).into_iter().chain(args.subs.iter().cloned()).collect();
        let subroutines = Arc::new(Subroutines::new(folders, sources.clone(), (id, text.clone()), HashMap::new()));
        let options = Options {
            skip_deleted: args.skip_deleted,
            tools,
            parameters: parameters.unwrap_or_default().into(),
            host: HostRef::new(subroutines.clone()),
            language: language(args)?,
            ..Options::default()
        };
        match options.with_modes(modes, &args.modes) {
            Ok(options) => Ok(Self { subroutines, text, id, options }),
            Err(diag) => Err(Problem::Diags(vec![*diag], sources)),
        }
    }

    /// A message with the lines that it shows.
    pub fn problem(&self, diag: Diag) -> Problem {
        self.subroutines.problem(vec![diag])
    }

    /// Where a line stands.
    pub fn line(&self, line: u32) -> Span {
        let start = self.text.start_of(line).ok().flatten().unwrap_or(self.text.len());
        let length = self.text.excerpt(start as u32).map_or(0, |e| e.text.len());
        Span::new(self.id, start, start + length)
    }

    /// From line `from` on.
    fn interpreter(&self, from: Option<u32>) -> Result<Interpreter, Problem> {
        let mut interpreter = Interpreter::new(self.id, self.text.clone(), self.options.clone());
        if let Some(line) = from {
            interpreter.seek(line).map_err(|diag| self.problem(*diag))?;
        }
        Ok(interpreter)
    }

    /// All steps, or the first error.
    pub fn steps(&self) -> Result<Vec<Step>, Problem> {
        let steps: Result<Vec<_>, Box<Diag>> = self.interpreter(None)?.collect();
        steps.map_err(|diag| self.problem(*diag))
    }
}

/// Dialect, strictness and settings.
fn language(args: &Args) -> Result<ngc::Language, Problem> {
    ngc::Language::new(&args.dialect, args.lenient, &args.set).map_err(|text| Problem::File(Code::BadValue, text))
}

/// A setting that a control has.
fn setting(text: &str) -> Result<String, String> {
    ngc::Settings::default().set(text).map(|()| text.to_owned())
}

fn execute(args: &Args) -> Result<Status, Problem> {
    let program = PartProgram::read(args)?;
    if args.check && !check(&program) {
        return Ok(Status::Wrong);
    }
    if args.canon {
        print_canon(&program, args.number_lines, args.from_line)?;
    }
    if let Some(out) = &args.plot {
        plot(&program, &args.file, out)?;
    }
    if args.plan || args.trace.is_some() {
        return super::gcode_plan::execute(&program, &args.plan_args, args.plan, args.trace.as_deref());
    }
    Ok(Status::Success)
}

/// Messages that are shown together.
const BATCH: usize = 1000;

/// True if there is no error. Messages are shown as they are found, so that their number does not matter.
fn check(program: &PartProgram) -> bool {
    let (mut batch, mut count) = (Vec::new(), diagnostics::Count::default());
    let mut show = |batch: &mut Vec<Diag>| {
        count.print(batch, &program.subroutines.sources(batch));
        batch.clear();
    };
    ngc::check_each(program.id, program.text.clone(), program.options.clone(), |diag| {
        batch.push(diag);
        if batch.len() >= BATCH {
            show(&mut batch);
        }
    });
    show(&mut batch);
    count.finish();
    !count.any_error()
}

/// Streams, so that a program of any size is printed up to its first error.
fn print_canon(program: &PartProgram, numbered: bool, from: Option<u32>) -> Result<(), Problem> {
    use std::io::Write;
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    for step in program.interpreter(from)? {
        match step {
            Ok(step) => {
                if writeln!(out, "{}", print::line(&step, numbered)).is_err() {
                    return Ok(()); // the reader has gone
                }
            }
            Err(diag) => {
                let _ = out.flush();
                return Err(program.problem(*diag));
            }
        }
    }
    let _ = out.flush();
    Ok(())
}

fn plot(program: &PartProgram, file: &Path, out: &Path) -> Result<(), Problem> {
    let picture = draw::draw(&program.steps()?, &file.display().to_string());
    project::write(out, picture.to_svg().as_bytes())
}
