//! Every native that the catalogue promises is there, with the signature that follows from its entry.

mod common;

use std::collections::BTreeSet;
use takt_base::Nanos;
use takt_image::{BindError, NativeCall, NativeImport, NativeKind, Natives, Scalar, Trap, TypeId, TypeTable, header};
use takt_stdlib::catalog::functions;
use takt_stdlib::{ConversionType as C, Library, native_conversion, native_signature};

/// Names of all natives.
fn names() -> BTreeSet<String> {
    let of_functions = functions().flat_map(|f| {
        let types = C::all().filter(move |&ty| match (f.group(), ty) {
            (None, _) => true,
            (Some(group), C::Elementary(e)) => e.is_in(group),
            (Some(group), _) => group == takt_image::Generic::AnyString,
        });
        types.filter_map(|ty| f.native(ty.name()))
    });
    let conversions = C::all().flat_map(|from| C::all().filter_map(move |to| native_conversion(from, to)));
    of_functions.chain(conversions).collect()
}

#[test]
fn every_native_is_bound() {
    let all = names();
    assert!(all.len() > 250, "{}", all.len());
    for name in &all {
        let kind = native_signature(name).unwrap_or_else(|| panic!("{name} has no native"));
        let import = NativeImport { name: name.clone(), kind };
        assert!(Library::new().bind(&import, &TypeTable::new()).is_ok(), "{name}");
    }
    for name in ["SIN_LREAL", "LEN_WSTRING", "INT_TO_STRING", "TIME_TO_DINT", "DT_TO_DATE", "CONCAT_DATE_TOD"] {
        assert!(all.contains(name), "{name}");
    }
}

/// Every native survives zeros, ones and wild addresses in all its slots.
#[test]
fn no_native_panics() {
    for name in names() {
        let Some(NativeKind::Function { params, result }) = native_signature(&name) else { panic!("{name}") };
        for slot in
            [0, 1, header::SIZE.into(), u64::MAX, i64::MIN as u64, i64::MAX as u64, f64::NAN.to_bits(), 5e307f64.to_bits()]
        {
            let mut memory = vec![0x55; 256];
            let slots = vec![slot; params.len()];
            // A trap is an answer too.
            let _ = common::run(&name, params.clone(), result, &slots, &mut memory);
            // ENO is the one byte there that a native may clear.
            let eno = std::mem::replace(&mut memory[header::ENO as usize], 0x55);
            assert!(matches!(eno, 0 | 0x55), "{name}");
            assert!(memory[..header::SIZE as usize].iter().all(|&b| b == 0x55), "{name} wrote into the header");
        }
    }
}

#[test]
fn inline_conversions_have_no_native() {
    for (from, to) in [
        ("INT", "DINT"),
        ("INT", "INT"),
        ("REAL", "INT"),
        ("TIME", "LTIME"),
        ("LTIME", "LINT"),
        ("DATE", "DT"),
        ("TIME", "BOOL"),
        ("BYTE", "CHAR"),
        ("CHAR", "WCHAR"),
        ("TIME", "DATE"),
        ("STRING", "STRING"),
    ] {
        let ends = C::from_name(from).zip(C::from_name(to));
        assert_eq!(ends.map(|(from, to)| native_conversion(from, to)), Some(None), "{from} {to}");
        assert_eq!(native_signature(&format!("{from}_TO_{to}")), None);
    }
}

fn bind(name: &str, params: &[Scalar], result: Option<Scalar>) -> Result<u32, BindError> {
    let kind = NativeKind::Function { params: params.to_vec(), result };
    Library::new().bind(&NativeImport { name: name.to_owned(), kind }, &TypeTable::new())
}

#[test]
fn signatures_are_checked() {
    use Scalar::{F32, F64, I8, I16, I32, I64};
    assert!(bind("SIN_LREAL", &[F64], Some(F64)).is_ok());
    assert!(bind("LEFT_STRING", &[I32, I32, I64, I32, I32], None).is_ok());
    assert!(bind("FIND_STRING", &[I32, I32, I32, I32], Some(I16)).is_ok());
    assert!(bind("CHAR_TO_STRING", &[I8, I32, I32], None).is_ok());
    assert!(bind("TIME_TO_DINT", &[I64], Some(I32)).is_ok());
    assert!(bind("CONCAT_STRING", &[I32; 6], None).is_ok());
    assert!(bind("CONCAT_STRING", &[I32; 30], None).is_ok());
    for (name, params, result) in [
        ("SIN_LREAL", &[F32][..], Some(F64)),
        ("SIN_REAL", &[F32], Some(F64)),
        ("SIN_REAL", &[F32, F32], Some(F32)),
        ("CONCAT_STRING", &[I32; 4], None),
        ("CONCAT_STRING", &[I32; 7], None),
        ("CONCAT_STRING", &[I32; 34], None),
    ] {
        assert!(matches!(bind(name, params, result), Err(BindError::Mismatch(_))), "{name} {params:?}");
    }
    for name in ["MC_Power", "SIN", "SIN_INT", "LEN", "LEN_INT", "ABS_REAL", "INT_TO_DINT", "sin_real", ""] {
        assert_eq!(bind(name, &[], None), Err(BindError::Unknown), "{name}");
    }
    let import = NativeImport { name: "SIN_LREAL".to_owned(), kind: NativeKind::Block { ty: TypeId(0) } };
    assert!(matches!(Library::new().bind(&import, &TypeTable::new()), Err(BindError::Mismatch(_))));
}

#[test]
fn a_number_that_was_never_given_traps() {
    let mut call = NativeCall { memory: &mut [], args: &[], result: 0, now: Nanos::ZERO };
    assert_eq!(Library::new().call(0, &mut call), Err(Trap::NativePanic));
}

#[test]
fn a_string_outside_of_the_memory_traps() {
    let size = 256u64;
    for (offset, capacity) in [(0, 4), (header::SIZE.into(), size), (size, 0), (u32::MAX.into(), u32::MAX.into()), (250, 6)] {
        let slots = [offset, capacity];
        let mut memory = vec![1; size as usize];
        let answer = common::run("LEN_STRING", vec![Scalar::I32; 2], Some(Scalar::I16), &slots, &mut memory);
        assert_eq!(answer, Err(Trap::Memory), "{offset} {capacity}");
    }
}
