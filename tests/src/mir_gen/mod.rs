//! Random modules: well typed, sure to end, all operations. What they leave in memory is defined, so two engines must agree on it.
//!
//! - Addresses are static, in the frame, or a masked number plus the start of the data area: always inside.
//! - Blocks go forward; the few edges back each have a counter that is set once. Functions call those before them.
//! - A float that an operation makes is replaced by one fixed NaN if it is a NaN, since its payload is not defined.
//! - Some modules are networks of BOOLs, which the code generator treats in its own way.

mod body;
mod insts;

use crate::rng::Rng;
use body::Body;
use takt_compiler::mir::model::*;
use takt_image::memory::header;
use takt_image::{MemoryMap, NativeImport, NativeKind, Scalar};

/// Bytes of data.
pub const DATA: u32 = 4096;
/// Bytes of frames.
pub const FRAMES: u32 = 1 << 14;
/// All machine types.
pub const SCALARS: [Scalar; 6] = [Scalar::I8, Scalar::I16, Scalar::I32, Scalar::I64, Scalar::F32, Scalar::F64];

/// A random module and what it runs on.
#[derive(Clone, Debug)]
pub struct Case {
    /// Its last function is the entry.
    pub module: Module,
    /// Memory.
    pub map: MemoryMap,
    /// Contents of the memory behind the header.
    pub contents: Vec<u8>,
}

impl Case {
    /// The function to run; its argument is any number.
    pub fn entry(&self) -> FuncId {
        FuncId(self.module.functions.len() as u32 - 1)
    }
}

/// The memory of all random modules.
pub fn memory_map() -> MemoryMap {
    MemoryMap::new(0, 0, 0, DATA, FRAMES).expect("small enough")
}

/// The module of a seed.
pub fn generate(seed: u64) -> Case {
    let mut rng = Rng::new(seed);
    let mut module = Module { files: vec!["a.st".into(), "b c.st".into()], ..Module::default() };
    natives(&mut module);
    let network = rng.one_in(6);
    for i in 0..rng.range(1, 4) {
        let body = Body::new(&mut rng, &mut module, network);
        let function = body.function(format!("f{i}"));
        module.functions.push(function);
    }
    let entry = Body::new(&mut rng, &mut module, network).entry();
    module.functions.push(entry);
    let map = memory_map();
    let contents = contents(&mut rng, (map.size() - header::SIZE) as usize);
    Case { module, map, contents }
}

fn natives(module: &mut Module) {
    use Scalar::{F32, F64, I8, I16, I32, I64};
    let mut add = |name: &str, params: &[Scalar], result| {
        let kind = NativeKind::Function { params: params.to_vec(), result };
        module.natives.push(NativeImport { name: name.into(), kind });
    };
    add("mix_i64", &[I8, I16, I32, I64, F32, F64, I8, I16, I32], Some(I64));
    add("mix_i8", &[I32, I8], Some(I8));
    add("mix_f32", &[F32], Some(F32));
    add("mix_f64", &[F64, I64], Some(F64));
    add("now", &[], Some(I64));
    add("fail", &[I8], None); // the last: it is called seldom
}

/// Bytes of which many or few are zero, so that strings are short or long; a few values, so that strings are alike.
fn contents(rng: &mut Rng, size: usize) -> Vec<u8> {
    let (rarity, most) = (rng.pick(&[4, 8, 60, 400]), rng.pick(&[255, 255, 2, 1]));
    (0..size).map(|_| if rng.one_in(rarity) { 0 } else { rng.bits() as u8 & most | 1 }).collect()
}
