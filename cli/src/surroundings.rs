//! What surrounds the channels of a project: part programs, subroutines, tables, the variables of the PLC program.
//! Runs: background. A table is replaced as a whole: the new one is written beside it, flushed, and renamed over it.

use crate::project::ProjectFile;
use crate::session::Session;
use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use takt_image::Image;
use takt_motion::feeder::Environment;

/// For the machine of a session; `keeps` tells whether it may store tables.
pub fn environment(session: &Session, keeps: bool) -> Environment {
    let (root, attached) = (session.root().to_owned(), session.image.attachments.clone());
    let tables: Vec<_> =
        session.keys.motion.channel.iter().flat_map(|c| [c.parameter_file.clone(), c.tool_table.clone()]).flatten().collect();
    let files = move |name: &str| {
        let travels = attached.iter().find(|(n, _)| n == name).map(|(_, bytes)| text(bytes));
        // What `takt run` has stored is newer than what travels in the image.
        let on_disk = || fs::read(root.join(name)).map(|bytes| text(&bytes)).map_err(|e| e.to_string());
        match travels {
            Some(text) if tables.iter().any(|t| t == name) => on_disk().or(Ok(text)),
            Some(text) => Ok(text),
            None => on_disk(),
        }
    };
    let root = session.root().to_owned();
    let save = move |name: &str, text: &str| replace(&root.join(name), text.as_bytes()).map_err(|e| e.to_string());
    let symbols: Arc<Image> = Arc::new(session.image.clone());
    Environment {
        files: Arc::new(Box::new(files)),
        save: keeps.then(|| Arc::new(Box::new(save) as takt_motion::feeder::environment::Save)),
        symbols: Some(symbols),
    }
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn replace(file: &Path, bytes: &[u8]) -> io::Result<()> {
    if let Some(folder) = file.parent() {
        fs::create_dir_all(folder)?;
    }
    let mut new = OsString::from(file);
    new.push(".new");
    let new = PathBuf::from(new);
    let mut out = File::create(&new)?;
    out.write_all(bytes)?;
    out.sync_all()?;
    fs::rename(&new, file)
}

/// Files of the channels that travel in an image: subroutines of `subs` folders, tool tables.
pub fn of_channels(root: &Path, keys: &ProjectFile) -> Vec<(String, Vec<u8>)> {
    let mut files = Vec::new();
    for channel in &keys.motion.channel {
        for folder in &channel.subs {
            let folder = folder.trim_end_matches('/');
            let entries = fs::read_dir(root.join(folder)).into_iter().flatten().flatten().map(|e| e.path());
            let mut subs: Vec<_> = entries.filter(|p| p.extension().is_some_and(|e| e == "ngc")).collect();
            subs.sort();
            for path in subs {
                if let (Some(name), Ok(bytes)) = (path.file_name(), fs::read(&path)) {
                    files.push((format!("{folder}/{}", name.to_string_lossy()), bytes));
                }
            }
        }
        if let Some((name, bytes)) = channel.tool_table.as_ref().and_then(|n| Some((n, fs::read(root.join(n)).ok()?))) {
            files.push((name.clone(), bytes));
        }
    }
    files.dedup();
    files
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_or_stays() {
        let folder = std::env::temp_dir().join(format!("takt-replace-{}", std::process::id()));
        let file = folder.join("deep/mill.par");
        replace(&file, b"one").unwrap();
        replace(&file, b"two").unwrap();
        assert_eq!(fs::read(&file).unwrap(), b"two");
        fs::create_dir(folder.join("deep/mill.par.new")).unwrap();
        assert!(replace(&file, b"three").is_err());
        assert_eq!(fs::read(&file).unwrap(), b"two");
        fs::remove_dir_all(folder).unwrap();
    }
}
