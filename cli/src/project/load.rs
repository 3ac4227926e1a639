//! Reads a project from disk. Every failure is a message with a code, and a place where there is one.

use super::file::ProjectFile;
use std::path::{Path, PathBuf};
use takt_base::{Code, Diag, Profile, Sources, Span};

/// A project as read: keys, sources and where they came from.
#[derive(Clone, Debug, Default)]
pub struct Project {
    /// Folder that relative paths start from.
    pub root: PathBuf,
    /// For reports.
    pub name: String,
    /// Keys of `takt.toml`; all default for plain source files.
    pub keys: ProjectFile,
    /// Text of `takt.toml`, to travel in an image.
    pub toml: String,
    /// Source files in order.
    pub sources: Vec<SourceFile>,
}

/// A source file as read.
#[derive(Clone, Debug)]
pub struct SourceFile {
    /// As shown in messages.
    pub name: String,
    /// Contents.
    pub bytes: Vec<u8>,
    /// Dialect: of the command line, else of `[profiles]`, else as the extension says, else of the project.
    pub profile: Profile,
}

/// Why a project can't be read.
pub enum Problem {
    /// A file or folder can't be read: code and sentence.
    File(Code, String),
    /// The project file is wrong.
    Diags(Vec<Diag>, Sources),
}

impl Problem {
    /// A path or value that does not work.
    pub fn access(e: &takt_image::access::AccessError) -> Self {
        let help = e.help.as_ref().map(|h| format!("\n  = help: {h}")).unwrap_or_default();
        Problem::File(e.code, format!("{}{help}", e.message))
    }
    /// The thread of the programs could not be started, or ended by itself.
    pub fn thread(e: &std::io::Error) -> Self {
        Problem::File(Code::FileError, e.to_string())
    }
    /// Shows the problem on stderr.
    pub fn print(&self) {
        match self {
            Problem::File(code, text) => eprintln!("error[{}]: {text}", code.text()),
            Problem::Diags(diags, sources) => crate::diagnostics::print(diags, sources),
        }
    }
}

const SOURCE_EXTENSIONS: &[&str] = &["st", "il", "exp"];

/// Reads the project that `paths` name: one folder, or one or more source files. A profile given here is that of every file.
pub fn load(paths: &[PathBuf], profile: Option<Profile>) -> Result<Project, Problem> {
    let mut project = match paths {
        [dir] if dir.is_dir() => folder(dir)?,
        [toml] if toml.file_name().is_some_and(|n| n == "takt.toml") => folder(parent(toml))?,
        files => plain_files(files)?,
    };
    if let Some(profile) = profile {
        project.sources.iter_mut().for_each(|s| s.profile = profile);
    }
    Ok(project)
}

/// The folder of a file; that of a bare name is the current one.
fn parent(file: &Path) -> &Path {
    file.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Parses the text of a project file; `name` is shown in messages.
pub fn parse_keys(name: &str, text: &str) -> Result<ProjectFile, Problem> {
    toml::from_str(text).map_err(|e| {
        let mut sources = Sources::new();
        let id = sources.add(name, text);
        let span = e.span().unwrap_or(0..0);
        let diag = toml_diag(e.message(), Span::new(id, span.start, span.end));
        Problem::Diags(vec![diag], sources)
    })
}

fn folder(dir: &Path) -> Result<Project, Problem> {
    let path = dir.join("takt.toml");
    let (toml, keys) = if path.exists() {
        let text = String::from_utf8_lossy(&read(&path)?).into_owned();
        let keys = parse_keys(&path.display().to_string(), &text)?;
        (text, keys)
    } else {
        (String::new(), ProjectFile::default())
    };
    let names = match &keys.project.sources {
        Some(names) => names.iter().map(|n| dir.join(n)).collect(),
        None => sources_in(dir)?,
    };
    if names.is_empty() {
        return Err(Problem::File(
            Code::BadProjectFile,
            format!("{} has no takt.toml and no source file (*.st, *.il, *.exp)", dir.display()),
        ));
    }
    let name = keys.project.name.clone().unwrap_or_else(|| folder_name(dir));
    let sources = read_all(&names, keys.project.profile.into())?;
    let mut project = Project { root: dir.to_owned(), name, keys, toml, sources };
    set_profiles(&mut project, &names)?;
    Ok(project)
}

fn plain_files(files: &[PathBuf]) -> Result<Project, Problem> {
    for file in files {
        if file.exists() && !is_source(file) {
            let text = format!("{}: this version reads *.st, *.il, *.exp and project folders", file.display());
            return Err(Problem::File(Code::BadProjectFile, text));
        }
    }
    let root = files.first().and_then(|f| f.parent()).unwrap_or(Path::new("")).to_owned();
    let name = files.first().and_then(|f| f.file_stem()).map_or("project".into(), |n| n.to_string_lossy().into_owned());
    Ok(Project { root, name, keys: ProjectFile::default(), toml: String::new(), sources: read_all(files, Profile::Std)? })
}

fn folder_name(dir: &Path) -> String {
    let full = dir.canonicalize().unwrap_or_else(|_| dir.to_owned());
    full.file_name().map_or("project".into(), |n| n.to_string_lossy().into_owned())
}

fn sources_in(dir: &Path) -> Result<Vec<PathBuf>, Problem> {
    let entries = dir.read_dir().map_err(|e| unreadable(dir, &e))?;
    let mut names: Vec<_> = entries.flatten().map(|e| e.path()).filter(|p| is_source(p)).collect();
    names.sort();
    Ok(names)
}

/// Reads source files; a CODESYS 2 export is told by its extension unless the project has a profile of its own.
fn read_all(names: &[PathBuf], profile: Profile) -> Result<Vec<SourceFile>, Problem> {
    let profile_of = |name: &Path| match profile {
        Profile::Std if has_extension(name, "exp") => Profile::Codesys2,
        profile => profile,
    };
    names.iter().map(|n| Ok(SourceFile { name: n.display().to_string(), bytes: read(n)?, profile: profile_of(n) })).collect()
}

fn is_source(path: &Path) -> bool {
    SOURCE_EXTENSIONS.iter().any(|e| has_extension(path, e))
}

fn has_extension(path: &Path, wanted: &str) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case(wanted))
}

/// `[profiles]`: each key is a source file or a folder; the longest one that fits a file decides.
fn set_profiles(project: &mut Project, names: &[PathBuf]) -> Result<(), Problem> {
    for (key, profile) in &project.keys.profiles {
        let place = project.root.join(key);
        let mut fits = false;
        // Keys come in order, so a file inside of a folder comes behind the folder.
        for (_, source) in names.iter().zip(&mut project.sources).filter(|(n, _)| n.starts_with(&place)) {
            source.profile = (*profile).into();
            fits = true;
        }
        if !fits {
            let text = format!("takt.toml: [profiles] names \"{key}\", and no source file stands there");
            return Err(Problem::File(Code::BadProjectFile, text));
        }
    }
    Ok(())
}

/// Reads a file whole.
pub fn read(path: &Path) -> Result<Vec<u8>, Problem> {
    std::fs::read(path).map_err(|e| unreadable(path, &e))
}

/// Writes a file whole.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), Problem> {
    let failed = |e: std::io::Error| Problem::File(Code::FileError, format!("can't write {}: {e}", path.display()));
    std::fs::write(path, bytes).map_err(failed)
}

pub fn unreadable(path: &Path, e: &std::io::Error) -> Problem {
    Problem::File(Code::FileError, format!("can't read {}: {e}", path.display()))
}

/// Makes a diagnostic of the TOML reader's message; for an unknown key it names the nearest known one.
fn toml_diag(message: &str, span: Span) -> Diag {
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let first_line = message.lines().next().unwrap_or("");
    match quoted.split_first() {
        Some((key, known)) if message.starts_with("unknown field") => {
            let near = takt_base::nearest(key, known.iter().copied());
            let help = near.map_or("`takt explain takt.toml` lists all keys".into(), |k| {
                format!("did you mean `{k}`? `takt explain takt.toml` lists all keys")
            });
            Diag::new(Code::UnknownKey, span, "unknown key").help(help)
        }
        _ => Diag::new(Code::BadProjectFile, span, first_line).help("`takt explain takt.toml` lists all keys"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str) -> String {
        match parse_keys("takt.toml", text) {
            Err(Problem::Diags(d, s)) => takt_base::diag::render(&d[0], &s),
            _ => "accepted".into(),
        }
    }

    #[test]
    fn unknown_key_is_an_error_with_a_suggestion() {
        let text = message("[run]\nstimulsu = \"a.csv\"\n");
        assert!(text.starts_with("error[C0002]"), "{text}");
        assert!(text.contains("takt.toml:2:1") && text.contains("did you mean `stimulus`?"), "{text}");
    }

    #[test]
    fn wrong_type_and_bad_syntax_have_a_place() {
        assert!(message("[run]\nduration = 5\n").contains("takt.toml:2:12"));
        assert!(message("[run\n").starts_with("error[C0001]"));
        assert_eq!(message(""), "accepted");
    }

    #[test]
    fn every_key_stands_in_the_reference() {
        let full = toml::to_string(&ProjectFile::default()).unwrap_or_default();
        for line in full.lines().filter_map(|l| l.split_once('=')) {
            assert!(super::super::REFERENCE.contains(line.0.trim()), "{} is not explained", line.0);
        }
    }
}
