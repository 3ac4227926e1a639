//! `takt rs274`: the options, the listing and the exit status of LinuxCNC's stand-alone interpreter, for scripts that call it.

use crate::Status;
use crate::project::{self, Problem};
use crate::subroutines::{self, Subroutines, tables};
use std::collections::HashMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use takt_base::{Code, Diag, Sources};
use takt_motion::canon::{Canon, MotionMode, ToolEntry, Units};
use takt_motion::ngc::{HostRef, Interpreter, Options, Style, param};
use takt_motion::print::rs274::Listing;

/// List canonical calls as LinuxCNC's rs274 does
#[derive(clap::Args)]
#[command(after_help = "Example: takt rs274 -g -t tool.tbl -v params.var part.ngc out.txt")]
pub struct Args {
    /// Batch mode; it is always on
    #[arg(short = 'g')]
    batch: bool,
    /// INI file: SUBROUTINE_PATH, PROGRAM_PREFIX and the values of `#<_ini[section]name>`
    #[arg(short = 'i', value_name = "INI")]
    ini: Option<PathBuf>,
    /// Tool table
    #[arg(short = 't', value_name = "TOOLS")]
    tools: Option<PathBuf>,
    /// Parameter file: read at the start, written at the end
    #[arg(short = 'v', value_name = "PARAMS")]
    params: Option<PathBuf>,
    /// Behind an error: 0 goes on with the next row, 2 stops
    #[arg(short = 'n', value_name = "N", default_value = "2", value_parser = ["0", "1", "2"])]
    on_error: String,
    /// Skip blocks that start with /
    #[arg(short = 'b')]
    block_delete: bool,
    /// Print the stack: accepted, and of no effect
    #[arg(short = 's')]
    stack: bool,
    /// Log level: accepted, and of no effect
    #[arg(short = 'l', value_name = "LEVEL", hide = true)]
    level: Option<String>,
    /// Part program
    file: PathBuf,
    /// Where the listing goes; else to the console
    out: Option<PathBuf>,
}

pub fn run(args: Args) -> Status {
    super::finish(execute(&args))
}

/// Lengths of tables are inches, as without an INI file there.
const TABLE_MM: f64 = 25.4;

/// Tools 1 to 3, which that program has when it is given no table.
fn default_tools() -> Arc<[ToolEntry]> {
    (1..=3).map(|i| ToolEntry { index: i, tool: i, pocket: i, ..ToolEntry::default() }).collect()
}

fn execute(args: &Args) -> Result<Status, Problem> {
    let mut sources = Sources::new();
    let (id, text) = subroutines::open(&args.file, &mut sources).map_err(|e| project::unreadable(&args.file, &e))?;
    let tools = match &args.tools {
        Some(path) => tables::tools(path, &mut sources, TABLE_MM)?,
        None => default_tools(),
    };
    let existing = args.params.as_deref().filter(|path| path.exists());
    let parameters = existing.map(|path| tables::parameters(path, &mut sources)).transpose()?.unwrap_or_default();
    let ini = args.ini.as_deref().map(Ini::read).transpose()?.unwrap_or_default();
    let folders = ini.folders(&args.file);
    let orient_offset = ini.values.get("_ini[rs274ngc]orient_offset").copied().unwrap_or(0.0);
    let host = Arc::new(Subroutines::new(folders, sources, (id, text.clone()), ini.values));
    let options = Options {
        drop_in: true,
        style: Style::Ngc,
        skip_deleted: args.block_delete,
        control: MotionMode::Continuous(0.0),
        table_units: Units::Inches,
        tools: Some(tools),
        parameters: parameters.into(),
        host: HostRef::new(host.clone()),
        calls_max: 9,
        orient_offset,
        ..Options::default()
    };
    eprintln!("executing");
    let mut interpreter = Interpreter::new(id, text, options);
    let wrong = list(args, &mut interpreter, &host)?;
    if let Some(path) = &args.params {
        if path.exists() {
            let _ = std::fs::copy(path, path.with_extension("var.bak"));
        }
        project::write(path, param::file::write(interpreter.state()).as_bytes())?;
    }
    Ok(if wrong { Status::Wrong } else { Status::Success })
}

/// Writes the listing; true if an error stopped the program.
fn list(args: &Args, interpreter: &mut Interpreter, host: &Subroutines) -> Result<bool, Problem> {
    let file = match &args.out {
        Some(path) => Some(
            std::fs::File::create(path)
                .map_err(|e| Problem::File(Code::FileError, format!("can't write {}: {e}", path.display())))?,
        ),
        None => None,
    };
    let mut out = Output { file, rows: Vec::new(), gone: false };
    let (mut listing, mut wrong) = (Listing::new(TABLE_MM), false);
    while !out.gone {
        match interpreter.next_ref() {
            Some(Ok(step)) => {
                if let Canon::Print(text) = &step.command {
                    out.print(text);
                }
                listing.step(step, &mut out.rows);
            }
            Some(Err(diag)) => {
                out.flush();
                complain(&diag, host);
                if args.on_error == "0" {
                    interpreter.go_on();
                    continue;
                }
                wrong = true;
            }
            None => break,
        }
        if out.rows.len() > 1 << 15 {
            out.flush();
        }
    }
    // With an INI file that program leaves out what it calls at its exit.
    listing.finish(args.ini.is_none(), &mut out.rows);
    out.flush();
    Ok(wrong)
}

/// The listing on its way to a file or the console.
struct Output {
    file: Option<std::fs::File>,
    rows: Vec<u8>,
    /// The reader has gone.
    gone: bool,
}

impl Output {
    fn flush(&mut self) {
        let written = match &mut self.file {
            Some(file) => file.write_all(&self.rows),
            None => std::io::stdout().lock().write_all(&self.rows).and_then(|()| std::io::stdout().flush()),
        };
        self.gone |= written.is_err();
        self.rows.clear();
    }

    /// Text for the console, in order with what is listed there.
    fn print(&mut self, text: &str) {
        if self.file.is_none() {
            self.rows.extend_from_slice(text.as_bytes());
            self.rows.push(b'\n');
        } else {
            self.gone |= writeln!(std::io::stdout(), "{text}").is_err();
        }
    }
}

/// The message, and the row that it is about.
fn complain(diag: &Diag, host: &Subroutines) {
    let sources = host.sources(std::slice::from_ref(diag));
    let at = sources.line_col(diag.span.source, diag.span.start);
    let row = sources.get(diag.span.source).line(at.line);
    eprintln!("{}: {} (line {}, column {}: {})", diag.code.text(), diag.message, at.line, at.column, diag.label);
    eprintln!("{row}");
}

/// What counts of an INI file.
#[derive(Default)]
struct Ini {
    values: HashMap<String, f64>,
    paths: Vec<PathBuf>,
}

impl Ini {
    fn read(path: &Path) -> Result<Self, Problem> {
        let bytes = project::read(path)?;
        let text = String::from_utf8_lossy(&bytes);
        let folder = path.parent().unwrap_or(Path::new("."));
        let (mut ini, mut section) = (Ini::default(), String::new());
        for row in text.lines().map(str::trim).filter(|row| !row.starts_with(['#', ';'])) {
            if let Some(name) = row.strip_prefix('[').and_then(|r| r.split(']').next()) {
                section = name.trim().to_ascii_lowercase();
            } else if let Some((name, value)) = row.split_once('=') {
                ini.add(&section, name.trim(), value.trim(), folder);
            }
        }
        Ok(ini)
    }

    fn add(&mut self, section: &str, name: &str, value: &str, folder: &Path) {
        let name = name.to_ascii_lowercase();
        if matches!(name.as_str(), "subroutine_path" | "program_prefix") {
            self.paths.extend(value.split(':').filter(|p| !p.is_empty()).map(|p| folder.join(p)));
        }
        if let Ok(number) = value.parse::<f64>() {
            self.values.entry(format!("_ini[{section}]{name}")).or_insert(number);
        }
    }

    /// Where files of subroutines are looked for.
    fn folders(&self, program: &Path) -> Vec<PathBuf> {
        let own = program.parent().map(Path::to_path_buf);
        self.paths.iter().cloned().chain(own).chain([PathBuf::from(".")]).collect()
    }
}
