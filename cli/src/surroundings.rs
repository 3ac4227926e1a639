//! What surrounds the channels of a project: part programs, subroutines, tables, the variables of the PLC program.
//! Runs: background. A table is replaced as a whole: the new one is written beside it, flushed, and renamed over it.

use crate::project::ProjectFile;
use crate::retain;
use crate::session::Session;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use takt_motion::feeder::Environment;

/// For the machine of a session; `keeps` tells whether it may store tables.
pub fn environment(session: &Session, keeps: bool) -> Environment {
    let (root, image) = (session.root().to_owned(), Arc::new(session.image.clone()));
    let attached = image.clone();
    let tables: Vec<_> =
        session.keys.motion.channel.iter().flat_map(|c| [c.parameter_file.clone(), c.tool_table.clone()]).flatten().collect();
    let files = move |name: &str| {
        let travels = attached.attachments.iter().find(|(n, _)| n == name).map(|(_, bytes)| text(bytes));
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
    Environment {
        files: Arc::new(Box::new(files)),
        save: keeps.then(|| Arc::new(Box::new(save) as takt_motion::feeder::environment::Save)),
        symbols: Some(image),
    }
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn replace(file: &Path, bytes: &[u8]) -> io::Result<()> {
    fs::rename(retain::write_beside(file, bytes)?, file)
}

/// Files of a folder whose extension is one of `endings`, in the order of their names.
pub fn of_folder(folder: &Path, endings: &[&str]) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path());
    let wanted = |p: &PathBuf| p.extension().and_then(|e| e.to_str()).is_some_and(|e| endings.contains(&e));
    let mut paths: Vec<PathBuf> = entries.filter(wanted).collect();
    paths.sort();
    paths.iter().filter_map(|p| Some((p.file_name()?.to_string_lossy().into_owned(), fs::read(p).ok()?))).collect()
}

/// Files of the channels that travel in an image: subroutines of `subs` folders, tool tables.
pub fn of_channels(root: &Path, keys: &ProjectFile) -> Vec<(String, Vec<u8>)> {
    let mut files = Vec::new();
    for channel in &keys.motion.channel {
        for folder in &channel.subs {
            let folder = folder.trim_end_matches('/');
            let subs = of_folder(&root.join(folder), &["ngc"]);
            files.extend(subs.into_iter().map(|(name, bytes)| (format!("{folder}/{name}"), bytes)));
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
