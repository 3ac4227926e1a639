//! Images made by hand, and hosts for them: the runtime is tested without a compiler.
#![allow(dead_code)] // Each test file uses its part.

use takt_base::Nanos;
use takt_image::image::*;
use takt_image::natives::{BindError, NativeImport, NativeKind, Scalar};
use takt_image::{Cyclic, Elementary, Image, MemoryMap, NativeCall, Natives, Trap, Type, TypeTable};

/// A host without natives or motion.
pub struct Bare;

impl Natives for Bare {
    fn bind(&mut self, _: &NativeImport, _: &TypeTable) -> Result<u32, BindError> {
        Err(BindError::Unknown)
    }
    fn call(&mut self, _: u32, _: &mut NativeCall) -> Result<(), Trap> {
        Err(Trap::NativePanic)
    }
}

impl Cyclic for Bare {
    fn period(&self) -> Option<Nanos> {
        None
    }
    fn tick(&mut self, _: Nanos) {}
    fn safe_stop(&mut self) {}
}

/// Sections of code, one function each, with traps and lines relative to their function.
#[derive(Default)]
pub struct Asm {
    pub image: Image,
}

impl Asm {
    pub fn new() -> Self {
        let memory = MemoryMap::new(8, 8, 8, 64, 4096).unwrap();
        let image = Image {
            name: "test".into(),
            target: Target::X86_64V2,
            memory,
            files: vec!["a.st".into(), "b.st".into()],
            ..Image::default()
        };
        Asm { image }
    }
    /// Appends a function; `traps` are (offset, trap), `lines` are (offset, file, line).
    pub fn function(mut self, pou: &str, code: &[u8], traps: &[(u32, Trap)], lines: &[(u32, u32, u32)]) -> Self {
        let i = &mut self.image;
        let start = i.code.len() as u32;
        i.code.extend(code);
        i.functions.push(Function { pou: pou.into(), start, size: code.len() as u32 });
        i.traps.extend(traps.iter().map(|&(o, t)| TrapSite { offset: start + o, trap: t as u8 }));
        i.lines.extend(lines.iter().map(|&(o, file, line)| LineSite { offset: start + o, file, line }));
        self
    }
    pub fn native(mut self, name: &str, params: usize) -> Self {
        let kind = NativeKind::Function { params: vec![Scalar::I64; params], result: Some(Scalar::I64) };
        self.image.natives.push(NativeImport { name: name.into(), kind });
        self
    }
}

/// A task of one program per entry of `functions`, all on the instance at the start of the data.
pub fn task(name: &str, priority: u32, interval_ms: Option<i64>, functions: &[u32], image: &Image) -> Task {
    let program = |&function: &u32| Program { name: format!("{name}_{function}"), function, instance: image.memory.data.start };
    Task {
        name: name.into(),
        priority,
        interval: interval_ms.map(Nanos::from_millis),
        trigger: None,
        programs: functions.iter().map(program).collect(),
    }
}

/// A symbol of an elementary type.
pub fn symbol(image: &mut Image, name: &str, ty: Elementary, place: Place) {
    let ty = image.types.intern(Type::Elementary(ty));
    image.symbols.push(Symbol { name: name.into(), ty, place, constant: false, retain: false, access: None });
}
