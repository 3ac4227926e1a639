//! Runs `filetests/mir/*.mir`: a module, and lines that say what its functions give, on interpreter and native code alike.
//!
//! ```text
//! ; f(3, -4) = 7                  result of a call
//! ; f(0) traps Range at 12        a fault, with its line if it is given
//! ; f(1) ends                     no result, no fault
//! ```
//! The data area is 64 to 4159, zero at the start of each line; frames follow. Natives are those of `takt_tests::mir_run`.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use takt_compiler::mir::model::*;
use takt_compiler::mir::{text, verify};
use takt_image::memory::header;
use takt_image::{Fault, MemoryMap, Scalar, Trap};
use takt_tests::mir_run::{interpret, native};

/// Where the result of a call is stored.
const RESULT: u32 = 4152;

fn memory_map() -> MemoryMap {
    MemoryMap::new(0, 0, 0, 4096, 4096).expect("small enough")
}

#[test]
fn filetests() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("filetests/mir");
    let entries = std::fs::read_dir(&folder).expect("the folder is there");
    let mut files: Vec<PathBuf> =
        entries.flatten().map(|e| e.path()).filter(|p| p.extension().is_some_and(|e| e == "mir")).collect();
    files.sort();
    assert!(!files.is_empty());
    let failures: Vec<String> = files.iter().flat_map(|f| file(f)).collect();
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

/// Runs a file; what failed.
fn file(path: &Path) -> Vec<String> {
    let source = std::fs::read_to_string(path).expect("the file is readable");
    let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    let module = text::parse(&source).unwrap_or_else(|e| panic!("{name}: {e}"));
    let problems = verify(&module);
    assert!(problems.is_empty(), "{name}: {}", problems[0]);
    assert_eq!(text::parse(&text::print(&module)).as_ref(), Ok(&module), "{name} does not read back");
    let cases: Vec<(usize, &str)> = (1..).zip(source.lines()).filter_map(|(n, l)| Some((n, case_text(l)?))).collect();
    assert!(!cases.is_empty(), "{name} has no cases");
    let run = |(line, text): (usize, &str)| case(&module, text).err().map(|e| format!("{name}:{line}: {text}: {e}"));
    cases.into_iter().filter_map(run).collect()
}

/// A comment that has a call in it and what it gives.
fn case_text(line: &str) -> Option<&str> {
    let text = line.strip_prefix("; ")?;
    let call = text.find('(')? < text.find(')')?;
    (call && [") = ", ") traps ", ") ends"].iter().any(|s| text.contains(s))).then_some(text)
}

/// What a line wants.
enum Want<'a> {
    Result(&'a str),
    Trap(Trap, Option<u32>),
    End,
}

fn case(module: &Module, text: &str) -> Result<(), String> {
    let (name, rest) = text.split_once('(').ok_or("no call")?;
    let (args, rest) = rest.split_once(')').ok_or("no end of the arguments")?;
    let want = want(rest.trim())?;
    let id = module.functions.indices().find(|&f| module.functions[f].name == name).ok_or("no such function")?;
    let args: Vec<&str> = args.split(',').map(str::trim).filter(|a| !a.is_empty()).collect();
    let (module, entry) = with_entry(module, id, &args)?;
    let module = Arc::new(module);
    let (map, contents) = (memory_map(), vec![0; (memory_map().size() - header::SIZE) as usize]);
    let outcomes = [interpret(&module, map, &contents, entry, 0), native(&module, map, &contents, entry, 0)];
    for (outcome, engine) in outcomes.iter().zip(["interpreter", "native code"]) {
        check(&module.functions[id], &want, &outcome.result, &outcome.memory).map_err(|e| format!("{engine}: {e}"))?;
    }
    if outcomes[0] == outcomes[1] { Ok(()) } else { Err("interpreter and native code differ".into()) }
}

fn want(text: &str) -> Result<Want<'_>, String> {
    if let Some(value) = text.strip_prefix("= ") {
        return Ok(Want::Result(value.trim()));
    }
    let Some(rest) = text.strip_prefix("traps ") else { return Ok(Want::End) };
    let (name, line) = rest.split_once(" at ").map_or((rest, None), |(n, l)| (n, Some(l)));
    let trap = Trap::ALL.iter().find(|t| t.name() == name.trim()).ok_or("no such trap")?;
    Ok(Want::Trap(*trap, line.map(|l| l.trim().parse().map_err(|_| "no line")).transpose()?))
}

/// The module with a function that makes the call and stores its result.
fn with_entry(module: &Module, function: FuncId, args: &[&str]) -> Result<(Module, FuncId), String> {
    let callee = &module.functions[function];
    let line = LineId(0);
    let (mut locals, mut insts, mut values) = (takt_base::index::IndexVec::new(), Vec::new(), Vec::new());
    let params = vec![locals.push(Scalar::I32)];
    if args.len() != callee.params.len() {
        return Err(format!("{} arguments, not {}", callee.params.len(), args.len()));
    }
    for (&param, text) in callee.params.iter().zip(args) {
        let value = locals.push(callee.locals[param]);
        let op = constant(value, callee.locals[param], text)?;
        insts.push(Inst { op, line });
        values.push(value);
    }
    let dst = callee.result.map(|ty| locals.push(ty));
    insts.push(Inst { op: Op::Call { dst, function, args: values }, line });
    let result = Addr { base: AddrBase::Static, offset: RESULT };
    insts.extend(dst.map(|dst| Inst { op: Op::Store(result, dst), line }));
    let blocks = [Block { insts, end: End::Return(None), end_line: line }].into_iter().collect();
    let (name, pou) = (" case".to_string(), String::new());
    let mut module = module.clone();
    let entry = module.functions.push(Function { name, pou, params, result: None, locals, frame: 0, blocks });
    Ok((module, entry))
}

fn constant(dst: Local, ty: Scalar, text: &str) -> Result<Op, String> {
    if ty.is_float() {
        let value = text.parse::<f64>().map_err(|e| format!("{text}: {e}"))?;
        return Ok(Op::Float(dst, if ty == Scalar::F32 { f64::from(value as f32) } else { value }.to_bits()));
    }
    let value = match text.strip_prefix("0x") {
        Some(hex) => u64::from_str_radix(hex, 16).map(|v| v as i64),
        None => text.parse(),
    };
    Ok(Op::Int(dst, value.map_err(|e| format!("{text}: {e}"))?))
}

fn check(f: &Function, want: &Want, result: &Result<(), Fault>, memory: &[u8]) -> Result<(), String> {
    match (want, result) {
        (Want::Trap(trap, line), Err(fault)) if fault.trap == *trap => match line {
            Some(line) if fault.line != *line => Err(format!("at line {}", fault.line)),
            _ => Ok(()),
        },
        (Want::Result(text), Ok(())) => check_value(f.result.ok_or("no result")?, text, memory),
        (Want::End, Ok(())) => Ok(()),
        (_, Ok(())) => Err("ended without a trap".into()),
        (_, Err(fault)) => Err(format!("{} at line {}", fault.trap.name(), fault.line)),
    }
}

fn check_value(ty: Scalar, text: &str, memory: &[u8]) -> Result<(), String> {
    let mut bytes = [0; 8];
    let start = (RESULT - header::SIZE) as usize;
    bytes[..ty.bytes() as usize].copy_from_slice(&memory[start..start + ty.bytes() as usize]);
    let found = u64::from_le_bytes(bytes);
    let bits = match constant(Local(0), ty, text)? {
        Op::Int(_, value) => value as u64 & (u64::MAX >> (64 - 8 * ty.bytes())),
        Op::Float(_, bits) if ty == Scalar::F32 => u64::from((f64::from_bits(bits) as f32).to_bits()),
        Op::Float(_, bits) => bits,
        _ => 0,
    };
    let nan = |bits: u64| if ty == Scalar::F32 { f32::from_bits(bits as u32).is_nan() } else { f64::from_bits(bits).is_nan() };
    if found == bits || ty.is_float() && nan(found) && nan(bits) { Ok(()) } else { Err(format!("{found:#x}, not {bits:#x}")) }
}
