//! `takt gcode`: what a part program says, whether it is right, how it would move, how it looks.

use crate::Status;
use crate::diagnostics;
use crate::project::Problem;
use crate::subroutines::{Subroutines, tables};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use takt_base::{Code, Diag, SourceId, Sources};
use takt_motion::canon::Step;
use takt_motion::ngc::{self, HostRef, Interpreter, Options};
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
    sources: Sources,
    pub id: SourceId,
    pub options: Options,
}

impl PartProgram {
    fn read(args: &Args) -> Result<Self, Problem> {
        let mut sources = Sources::new();
        let id = sources.add_bytes(args.file.display().to_string(), crate::project::read(&args.file)?);
        let modes = sources.add("--modes", args.modes.clone());
        let tools = args.tool_table.as_deref().map(|path| tables::tools(path, &mut sources, 1.0)).transpose()?;
        let parameters = args.params.as_deref().map(|path| tables::parameters(path, &mut sources)).transpose()?;
        let folders = args.file.parent().map(Path::to_path_buf).into_iter().chain(args.subs.iter().cloned()).collect();
        let subroutines = Arc::new(Subroutines::new(folders, sources.clone(), HashMap::new()));
        let options = Options {
            skip_deleted: args.skip_deleted,
            tools,
            parameters: parameters.unwrap_or_default().into(),
            host: HostRef::new(subroutines.clone()),
            language: language(args)?,
            ..Options::default()
        };
        match options.with_modes(modes, &args.modes) {
            Ok(options) => Ok(Self { subroutines, sources, id, options }),
            Err(diag) => Err(Problem::Diags(vec![*diag], sources)),
        }
    }

    /// All files that were read, those of subroutines among them.
    pub fn sources(&self) -> Sources {
        self.subroutines.sources()
    }

    fn text(&self) -> &str {
        &self.sources.get(self.id).text
    }

    /// All steps, or the first error.
    pub fn steps(&self) -> Result<Vec<Step>, Problem> {
        let steps: Result<Vec<_>, Box<Diag>> = Interpreter::new(self.id, self.text(), self.options.clone()).collect();
        steps.map_err(|diag| Problem::Diags(vec![*diag], self.sources()))
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
        print_canon(&program, args.number_lines)?;
    }
    if let Some(out) = &args.plot {
        plot(&program, out)?;
    }
    if args.plan || args.trace.is_some() {
        return super::gcode_plan::execute(&program, &args.plan_args, args.plan, args.trace.as_deref());
    }
    Ok(Status::Success)
}

/// True if there is no error.
fn check(program: &PartProgram) -> bool {
    let diags = ngc::check(program.id, program.text(), program.options.clone());
    diagnostics::print(&diags, &program.sources());
    !diagnostics::any_error(&diags)
}

/// Streams, so that a program of any size is printed up to its first error.
fn print_canon(program: &PartProgram, numbered: bool) -> Result<(), Problem> {
    use std::io::Write;
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    for step in Interpreter::new(program.id, program.text(), program.options.clone()) {
        match step {
            Ok(step) => {
                if writeln!(out, "{}", print::line(&step, numbered)).is_err() {
                    return Ok(()); // the reader has gone
                }
            }
            Err(diag) => {
                let _ = out.flush();
                return Err(Problem::Diags(vec![*diag], program.sources()));
            }
        }
    }
    let _ = out.flush();
    Ok(())
}

fn plot(program: &PartProgram, out: &Path) -> Result<(), Problem> {
    let title = program.sources.get(program.id).name.clone();
    let picture = draw::draw(&program.steps()?, &title);
    crate::project::write(out, picture.to_svg().as_bytes())
}
