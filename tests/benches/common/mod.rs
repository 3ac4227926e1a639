//! A loaded program without a scheduler: what a scan costs by itself.

use takt_base::Nanos;
use takt_image::{Engine, Image};
use takt_runtime::NativeEngine;
use takt_stdlib::Library;
use takt_tests::plc::{compile_st, initial_memory};

/// Native code, its memory and the library.
pub struct Loaded {
    image: Image,
    engine: NativeEngine,
    natives: Library,
    memory: Vec<u8>,
    now: Nanos,
}

impl Loaded {
    /// Compiles and loads; panics if the text has errors.
    pub fn new(text: &str) -> Self {
        let compilation = compile_st(text);
        let image = compilation.image.unwrap_or_else(|| panic!("{:?}", compilation.diags));
        let mut natives = Library::new();
        let engine = NativeEngine::new(&image, &mut natives).expect("image loads");
        let memory = initial_memory(&image);
        Self { image, engine, natives, memory, now: Nanos::ZERO }
    }

    /// All programs once, 10 ms later than before.
    pub fn scan(&mut self) {
        self.now += Nanos::from_millis(10);
        for program in self.image.tasks.iter().flat_map(|t| &t.programs) {
            let budget = Nanos::from_secs(1);
            self.engine
                .run(program.function, program.instance, self.now, budget, &mut self.memory, &mut self.natives)
                .expect("no fault");
        }
    }
}
