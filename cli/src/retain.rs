//! The file of retained values (§10.4): read at the start, written about once a second and at the end.
//!
//! The scan copies the values into one of two buffers, if one is there, and hands it over in a ring; a thread of its own writes the
//! file: a new one beside it, flushed, renamed over it. The generation before stays as `FILE.old`.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;
use takt_base::ring::{Rx, Tx, ring};
use takt_base::{Code, Nanos};
use takt_image::Image;
use takt_image::retain::{RetainMap, Start};
use takt_runtime::Resource;

/// Between two copies.
const PERIOD: Nanos = Nanos::from_secs(1);
/// How often the writer looks for a copy.
const LOOK: Duration = Duration::from_millis(20);

/// A copy of the retained variables, and the time of programs when it was made.
type Copy = (Nanos, Vec<u8>);

/// Restores a resource from a file; what is not there or not usable keeps its initial value.
pub fn restore(image: &Image, resource: Resource, file: &Path, start: Start) -> Resource {
    let map = RetainMap::new(image);
    if map.is_empty() {
        return resource;
    }
    resource.restored(|memory| load(&map, memory, file, start))
}

fn load(map: &RetainMap, memory: &mut [u8], file: &Path, start: Start) -> Nanos {
    for path in [file.to_owned(), beside(file, ".old")] {
        let bytes = match fs::read(&path) {
            Ok(bytes) => bytes,
            Err(e) if e.kind() == io::ErrorKind::NotFound => continue,
            Err(e) => {
                warn(Code::RetainDamaged, &format!("{}: {e}", path.display()));
                continue;
            }
        };
        match map.restore(&bytes, memory, start) {
            Ok(done) => {
                for path in &done.changed {
                    warn(Code::RetainChanged, &format!("`{path}` starts from its initial value"));
                }
                return Nanos(done.time.max(0));
            }
            Err(_) => warn(Code::RetainDamaged, &path.display().to_string()),
        }
    }
    Nanos::ZERO
}

/// Writes the values of a resource.
pub fn save(image: &Image, resource: &Resource, file: &Path) -> io::Result<()> {
    let map = RetainMap::new(image);
    if map.is_empty() {
        return Ok(());
    }
    let mut copy = vec![0; map.bytes()];
    map.capture(resource.memory(), &mut copy);
    store(file, &map.encode(&copy, resource.program_time().0))
}

/// Writes and flushes `FILE.new`, which may then be renamed over the file; its path.
pub fn write_beside(file: &Path, bytes: &[u8]) -> io::Result<PathBuf> {
    if let Some(folder) = file.parent() {
        fs::create_dir_all(folder)?;
    }
    let new = beside(file, ".new");
    let mut out = File::create(&new)?;
    out.write_all(bytes)?;
    out.sync_all()?;
    Ok(new)
}

/// Replaces a file, or leaves it as it is.
fn store(file: &Path, bytes: &[u8]) -> io::Result<()> {
    let new = write_beside(file, bytes)?;
    if file.exists() {
        fs::rename(file, beside(file, ".old"))?;
    }
    fs::rename(&new, file)?;
    if let Some(folder) = file.parent().filter(|f| !f.as_os_str().is_empty()) {
        File::open(folder)?.sync_all()?;
    }
    Ok(())
}

fn beside(file: &Path, suffix: &str) -> PathBuf {
    let mut name = OsString::from(file);
    name.push(suffix);
    name.into()
}

fn warn(code: Code, what: &str) {
    eprintln!("warning[{}]: {}: {what}", code.text(), code.title());
}

/// The cyclic end: copies values when it is time.
pub struct Sampler {
    map: Arc<RetainMap>,
    free: Rx<Copy>,
    full: Tx<Copy>,
    next: Nanos,
}

impl Sampler {
    /// After a scan at `now`, which programs see as `time`. Runs: cyclic.
    pub fn sample(&mut self, now: Nanos, time: Nanos, memory: &[u8]) {
        if now < self.next {
            return;
        }
        let Some((at, copy)) = self.free.pop() else { return };
        let mut copy = (at, copy);
        copy.0 = time;
        self.map.capture(memory, &mut copy.1);
        self.next = now + PERIOD;
        let _ = self.full.push(copy); // as many places as buffers
    }
}

/// The other end: a thread that writes.
pub struct Keeper {
    stop: Arc<AtomicBool>,
    thread: JoinHandle<()>,
    file: PathBuf,
}

/// Starts the writer; `None` if nothing is retained. Call it before the thread becomes a real-time one.
pub fn keep(image: &Image, file: PathBuf) -> Option<(Sampler, Keeper)> {
    let map = Arc::new(RetainMap::new(image));
    if map.is_empty() {
        return None;
    }
    let (mut back, free) = ring::<Copy>(2);
    let (full, ready) = ring::<Copy>(2);
    for _ in 0..2 {
        let _ = back.push((Nanos::ZERO, vec![0; map.bytes()]));
    }
    let stop = Arc::new(AtomicBool::new(false));
    let writer = Writer { map: Arc::clone(&map), file: file.clone(), ready, back, stop: Arc::clone(&stop) };
    let thread = std::thread::spawn(move || writer.run());
    Some((Sampler { map, free, full, next: Nanos::ZERO }, Keeper { stop, thread, file }))
}

impl Keeper {
    /// Ends the writer and writes the values as they are now.
    pub fn finish(self, image: &Image, resource: &Resource) {
        self.stop.store(true, Ordering::Release);
        let _ = self.thread.join();
        if let Err(e) = save(image, resource, &self.file) {
            failed(&self.file, &e);
        }
    }
}

fn failed(file: &Path, e: &io::Error) {
    warn(Code::RetainFile, &format!("{}: {e}", file.display()));
}

struct Writer {
    map: Arc<RetainMap>,
    file: PathBuf,
    ready: Rx<Copy>,
    back: Tx<Copy>,
    stop: Arc<AtomicBool>,
}

impl Writer {
    fn run(mut self) {
        let mut complained = false;
        while !self.stop.load(Ordering::Acquire) {
            let Some(copy) = self.ready.pop() else {
                std::thread::sleep(LOOK);
                continue;
            };
            let written = store(&self.file, &self.map.encode(&copy.1, copy.0.0));
            if let (Err(e), false) = (&written, complained) {
                failed(&self.file, e);
            }
            complained = written.is_err();
            let _ = self.back.push(copy);
        }
    }
}
