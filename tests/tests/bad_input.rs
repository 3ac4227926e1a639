//! Any bytes as ST, image, stimulus or g-code: a diagnostic or a refusal with a reason; never a panic, a hang or a partial run.

use takt_base::{Severity, SourceId};
use takt_compiler::driver::{File, Project, compile};
use takt_image::{Image, encode};
use takt_motion::ngc;
use takt_runtime::{NativeEngine, Options, Resource, Stimulus};
use takt_stdlib::Library;
use takt_tests::generate::{Shape, program};
use takt_tests::plc::compile_st;
use takt_tests::rng::Rng;

const BLINK: &str = include_str!("../../examples/01-blink/blink.st");
const PLOTTER: &str = include_str!("../../examples/02-plotter/plotter.st");

/// `text` with some bytes replaced, doubled or left out, or pieces of it exchanged.
fn mutated(rng: &mut Rng, text: &[u8]) -> Vec<u8> {
    let mut bytes = text.to_vec();
    for _ in 0..1 + rng.below(4) {
        let at = rng.below(bytes.len().max(1));
        match rng.below(5) {
            0 if at < bytes.len() => bytes[at] = rng.bits() as u8,
            1 if at < bytes.len() => drop(bytes.remove(at)),
            2 => bytes.insert(at.min(bytes.len()), b";:=()[]'\"%#.$\x00\xff\n09AZ_"[rng.below(21)]),
            3 => bytes.truncate(at),
            _ => {
                let (from, len) = (rng.below(text.len()), rng.below(40));
                let piece = text[from..(from + len).min(text.len())].to_vec();
                let at = at.min(bytes.len());
                bytes.splice(at..at, piece);
            }
        }
    }
    bytes
}

/// A number from the environment.
fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(default)
}

fn random(rng: &mut Rng) -> Vec<u8> {
    (0..rng.below(300)).map(|_| rng.bits() as u8).collect()
}

#[test]
fn any_bytes_as_st() {
    let mut rng = Rng::new(setting("TAKT_SEED", 1));
    let seeds = [BLINK.to_owned(), PLOTTER.to_owned(), program(3, Shape { statements: 4, scalars: 6, units: 1 })];
    for i in 0..setting("TAKT_INPUTS", 2000) {
        let seed = &seeds[rng.below(seeds.len())];
        let bytes = if i % 10 == 0 { random(&mut rng) } else { mutated(&mut rng, seed.as_bytes()) };
        let file = File { name: "x.st".into(), bytes, library: false, profile: takt_base::Profile::Std };
        let c = compile(Project { name: "x".into(), files: vec![file], attachments: vec![], interval: None, native: false });
        let wrong = c.diags.iter().any(|d| d.severity == Severity::Error);
        assert_eq!(wrong, c.image.is_none(), "an image or a reason");
    }
}

fn image() -> Image {
    compile_st(BLINK).image.expect("blink is right")
}

/// Loads the image if it decodes. It is not run: its code may be anything.
fn load(bytes: &[u8]) -> Result<(), String> {
    let image = encode::decode(bytes).map_err(|e| e.to_string())?;
    let mut natives = Library::new();
    let engine = NativeEngine::new(&image, &mut natives).map_err(|e| e.to_string())?;
    let options = Options::default();
    struct Bare;
    impl takt_image::Natives for Bare {
        fn bind(&mut self, _: &takt_image::NativeImport, _: &takt_image::TypeTable) -> Result<u32, takt_image::BindError> {
            Err(takt_image::BindError::Unknown)
        }
        fn call(&mut self, _: u32, _: &mut takt_image::NativeCall) -> Result<(), takt_image::Trap> {
            Err(takt_image::Trap::NativePanic)
        }
    }
    impl takt_image::Cyclic for Bare {
        fn period(&self) -> Option<takt_base::Nanos> {
            None
        }
        fn tick(&mut self, _: takt_base::Nanos) {}
        fn safe_stop(&mut self) {}
    }
    Resource::new(image, Box::new(engine), Box::new(Bare), options).map(drop).map_err(|e| e.to_string())
}

#[test]
fn any_bytes_as_image() {
    let good = encode::encode(&image());
    assert_eq!(load(&good), Ok(()));
    let mut rng = Rng::new(2);
    for i in 0..20_000 {
        let bytes = if i % 10 == 0 { random(&mut rng) } else { mutated(&mut rng, &good) };
        match load(&bytes) {
            Ok(()) => assert_eq!(bytes, good, "a damaged image was loaded"),
            Err(reason) => assert!(!reason.is_empty()),
        }
    }
}

#[test]
fn any_bytes_as_stimulus() {
    let (image, mut rng) = (image(), Rng::new(3));
    let good = include_str!("../../examples/01-blink/stimulus.csv");
    assert!(Stimulus::from_csv(&image, good).is_ok());
    for i in 0..20_000 {
        let bytes = if i % 10 == 0 { random(&mut rng) } else { mutated(&mut rng, good.as_bytes()) };
        if let Err(errors) = Stimulus::from_csv(&image, &String::from_utf8_lossy(&bytes)) {
            assert!(errors.iter().all(|e| e.line > 0 && !e.message.is_empty()));
        }
    }
}

#[test]
fn any_bytes_as_g_code() {
    let mut rng = Rng::new(4);
    let good = include_bytes!("../../examples/02-plotter/plate.nc");
    for i in 0..20_000 {
        let bytes = if i % 10 == 0 { random(&mut rng) } else { mutated(&mut rng, good) };
        let text = String::from_utf8_lossy(&bytes).into_owned();
        for diag in ngc::check(SourceId(0), text.as_str(), ngc::Options::default()) {
            assert!(diag.span.start as usize <= text.len() && !diag.message.is_empty());
        }
    }
}
