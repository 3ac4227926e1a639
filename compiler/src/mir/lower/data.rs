//! The data area: where globals, program instances and constants lie, what they contain at the start, and the symbols that name
//! them. From: language reference §3.6, §3.11.

use super::init::{Chunks, Globals, constant};
use super::pointer::Reach;
use crate::hir::model::*;
use std::collections::{BTreeMap, HashMap};
use std::ops::Range;
use takt_base::index::IndexVec;
use takt_base::{Code, Diag, SourceId, Span};
use takt_image::image::{Chunk, Place as ImagePlace};
use takt_image::memory::{FRAME_BYTES, MAX_MEMORY};
use takt_image::{Elementary, MemoryMap, Type, TypeId};

/// Places of everything that lives as long as the program.
pub struct Data {
    /// Of each global.
    pub globals: IndexVec<GlobalId, ImagePlace>,
    /// Offsets of the program instances, by task and by position in the task.
    pub instances: Vec<Vec<u32>>,
    /// Constants that code refers to, by contents and unit of alignment.
    pool: HashMap<Vec<u8>, u32>,
    /// Initial contents of globals and instances, then of the pool.
    chunks: Chunks,
    /// Offsets between which all global variables with function blocks in them lie.
    pub named_instances: Range<u64>,
    start: u32,
    next: u64,
}

/// Memory map without data: the process image lies in front of it, so its offsets don't depend on the data.
pub fn process_image(hir: &Hir) -> Option<MemoryMap> {
    let [i, q, m] = hir.image_bytes;
    MemoryMap::new(i, q, m, 0, 0)
}

impl Data {
    /// Lays out globals in order, then the program instances of all tasks in order.
    pub fn new(hir: &Hir) -> Result<Self, Diag> {
        let map = process_image(hir).ok_or_else(|| too_large(nowhere(), "the process image"))?;
        let start = map.data.start;
        let mut data = Data {
            globals: IndexVec::new(),
            instances: Vec::new(),
            pool: HashMap::new(),
            chunks: Chunks::default(),
            named_instances: 0..0,
            start,
            next: start as u64,
        };
        for g in hir.globals.iter() {
            let place = g.place.map_or_else(|| data.global(hir, g), Ok)?;
            data.globals.push(place);
        }
        for task in &hir.tasks {
            let places: Result<_, _> = task.programs.iter().map(|p| data.instance(hir, p)).collect();
            data.instances.push(places?);
        }
        data.contents(hir, &map);
        Ok(data)
    }

    /// Initial values, when all places are known: a reference may refer to what comes later.
    fn contents(&mut self, hir: &Hir, map: &MemoryMap) {
        let (globals, chunks) = (&self.globals, &mut self.chunks);
        image_contents(hir, map, globals, chunks);
        for (g, place) in hir.globals.iter().zip(globals.iter()).filter(|(g, _)| g.place.is_none()) {
            let seen = seen_by(hir, globals, g.resource);
            let globals = seen.as_ref().unwrap_or(globals);
            if let ImagePlace::Byte(offset) = *place {
                constant(&hir.types, globals, g.ty, &g.init, &mut |at, bytes| chunks.put(offset + at, bytes));
            }
        }
        let programs = hir.tasks.iter().zip(&self.instances).flat_map(|(t, offsets)| t.programs.iter().zip(offsets));
        for (program, offset) in programs.filter(|(p, _)| p.global.is_none()) {
            let pou = &hir.pous[program.pou];
            let seen = seen_by(hir, globals, Some(program.resource));
            let globals = seen.as_ref().unwrap_or(globals);
            let Some(ty) = pou.instance else { continue };
            if let Some(init) = &program.init {
                constant(&hir.types, globals, ty, init, &mut |at, bytes| chunks.put(offset + at, bytes));
                continue;
            }
            for var in pou.vars.iter() {
                if let Some(field) = field_offset(hir, ty, var) {
                    constant(&hir.types, globals, var.ty, &var.init, &mut |at, bytes| chunks.put(offset + field + at, bytes));
                }
            }
        }
    }

    /// Resource and offset of a program instance.
    pub fn program(&self, hir: &Hir, root: &Root) -> Option<(u32, u32)> {
        self.programs(hir).find(|(p, _)| p.root() == *root).map(|(p, offset)| (p.resource, offset))
    }

    fn programs<'d>(&'d self, hir: &'d Hir) -> impl Iterator<Item = (&'d ProgramInstance, u32)> {
        let tasks = hir.tasks.iter().zip(&self.instances);
        tasks.flat_map(|(t, offsets)| t.programs.iter().zip(offsets.iter().copied()))
    }

    /// Offsets of the instances of a function block that have a task of their own.
    pub fn bound(&self, hir: &Hir, pou: PouId) -> Vec<u32> {
        let blocks = hir.tasks.iter().flat_map(|t| &t.blocks).filter(|b| b.pou == pou);
        blocks.filter_map(|b| Some(self.program(hir, &b.program)?.1 + b.offset)).collect()
    }

    /// Where something lies that is known before anything runs. What stands for an address is that address.
    pub fn place(&self, hir: &Hir, spot: &Spot) -> Option<ImagePlace> {
        let (root, offset) = match spot {
            Spot::Image(place) => return Some(*place),
            Spot::Part(root, offset) => (self.variable(hir, root), *offset),
        };
        let covers = |m: &&Mirror| m.root == root && m.offset <= offset && offset - m.offset < hir.types.layout(m.ty).size;
        if let Some(m) = hir.mirrors.iter().find(covers) {
            return Some(behind(m.place, offset - m.offset));
        }
        match root {
            Root::Global(g) => Some(behind(self.globals[g], offset)),
            program => Some(ImagePlace::Byte(self.program(hir, &program)?.1 + offset)),
        }
    }

    /// A program instance may be a variable (vendor).
    fn variable(&self, hir: &Hir, root: &Root) -> Root {
        let found = self.programs(hir).find(|(p, _)| p.root() == *root).and_then(|(p, _)| p.global);
        found.map_or_else(|| root.clone(), Root::Global)
    }

    /// Bytes without a name behind all variables.
    pub fn reserve_bytes(&mut self, size: u32, align: u32) -> Option<u32> {
        self.take(size, align)
    }

    /// What pointers may reach: everything that is there now.
    pub fn reach(&self, hir: &Hir) -> Reach {
        let map = process_image(hir).unwrap_or_default();
        let end = u32::try_from(self.next).unwrap_or(MAX_MEMORY);
        Reach { read: map.inputs.start, write: map.outputs.start, end }
    }

    fn global(&mut self, hir: &Hir, g: &Global) -> Result<ImagePlace, Diag> {
        let offset = self.reserve(hir, g.ty, g.span, &g.name)?;
        if hir.types.holds(g.ty, |t| matches!(t, Type::Instance(_))) {
            let first = if self.named_instances.is_empty() { offset as u64 } else { self.named_instances.start };
            self.named_instances = first..self.next;
        }
        Ok(ImagePlace::Byte(offset))
    }

    fn instance(&mut self, hir: &Hir, program: &ProgramInstance) -> Result<u32, Diag> {
        let pou = &hir.pous[program.pou];
        if let Some(ImagePlace::Byte(offset)) = program.global.and_then(|g| self.globals.get(g)) {
            return Ok(*offset);
        }
        let Some(ty) = pou.instance else { return Ok(self.start) };
        self.reserve(hir, ty, pou.end, &program.name)
    }

    fn reserve(&mut self, hir: &Hir, ty: TypeId, span: Span, name: &str) -> Result<u32, Diag> {
        let layout = hir.types.layout(ty);
        self.take(layout.size, layout.align).ok_or_else(|| too_large(span, name))
    }

    fn take(&mut self, size: u32, align: u32) -> Option<u32> {
        let offset = self.next.next_multiple_of(align.max(1) as u64);
        let end = offset + size as u64;
        if end > MAX_MEMORY as u64 {
            return None;
        }
        self.next = end;
        Some(offset as u32)
    }

    /// Place of constant bytes, shared by all who need the same. `None` if the memory is full.
    pub fn pooled(&mut self, bytes: Vec<u8>) -> Option<u32> {
        if let Some(&offset) = self.pool.get(&bytes) {
            return Some(offset);
        }
        let offset = self.take(u32::try_from(bytes.len()).ok()?, 8)?;
        self.chunks.put(offset, &bytes);
        self.pool.insert(bytes, offset);
        Some(offset)
    }

    /// The finished memory.
    pub fn finish(self, hir: &Hir) -> Option<(MemoryMap, Vec<Chunk>)> {
        let [i, q, m] = hir.image_bytes;
        let size = u32::try_from(self.next - self.start as u64).ok()?;
        Some((MemoryMap::new(i, q, m, size, FRAME_BYTES)?, self.chunks.finish()))
    }
}

fn behind(place: ImagePlace, bytes: u32) -> ImagePlace {
    match place {
        ImagePlace::Byte(offset) => ImagePlace::Byte(offset + bytes),
        bit => bit,
    }
}

/// The globals as one of several resources sees them: references in its initial values refer to its own.
fn seen_by(hir: &Hir, globals: &Globals, resource: Option<u32>) -> Option<Globals> {
    let renamed = &hir.views.get(resource? as usize)?.renamed;
    let mut seen = globals.clone();
    renamed.iter().for_each(|(from, to)| seen[*from] = globals[*to]);
    Some(seen)
}

/// Offset of an instance variable in its record; `None` for temporaries, located and reference variables.
fn field_offset(hir: &Hir, instance: TypeId, var: &Var) -> Option<u32> {
    match var.storage {
        Storage::Field(i) if var.role != Role::InOut => super::place::field(&hir.types, instance, i).map(|f| f.offset),
        _ => None,
    }
}

/// Initial values of located variables. Those on %I are ignored (§3.4).
fn image_contents(hir: &Hir, map: &MemoryMap, globals: &Globals, chunks: &mut Chunks) {
    let mut bytes = BTreeMap::new();
    let located = hir.globals.iter().filter_map(|g| Some((g.place?, g.ty, &g.init)));
    let programs = hir.pous.iter().filter(|p| p.reachable && p.kind == PouKind::Program);
    let in_programs = programs.flat_map(|p| p.vars.iter()).filter_map(|v| match v.storage {
        Storage::Image(place) => Some((place, v.ty, &v.init)),
        _ => None,
    });
    let mirrors = hir.mirrors.iter().map(|m| (m.place, m.ty, &m.init));
    for (place, ty, init) in located.chain(in_programs).chain(mirrors) {
        constant(&hir.types, globals, ty, init, &mut |at, value| match place {
            ImagePlace::Byte(offset) => {
                value.iter().enumerate().for_each(|(i, b)| _ = bytes.insert(offset + at + i as u32, *b));
            }
            ImagePlace::Bit(offset, bit) => {
                let set = value.first().is_some_and(|b| *b != 0);
                *bytes.entry(offset).or_insert(0) |= u8::from(set) << (bit & 7);
            }
        });
    }
    let kept = bytes.into_iter().filter(|(o, _)| !map.inputs.range().contains(&(*o as usize)));
    kept.for_each(|(offset, byte)| chunks.put(offset, &[byte]));
}

/// The message for memory that is not there.
pub fn too_large(span: Span, what: &str) -> Diag {
    Diag::new(Code::TypeTooLarge, span, format!("{what} does not fit"))
        .help(format!("a program has {} MiB of memory in all; make arrays smaller", MAX_MEMORY >> 20))
}

pub fn nowhere() -> Span {
    Span::new(SourceId(0), 0, 0)
}

/// Bytes of a constant of a type, zeros included.
pub fn bytes_of(hir: &Hir, globals: &Globals, ty: TypeId, value: &Const) -> Vec<u8> {
    let mut bytes = vec![0; hir.types.layout(ty).size as usize];
    constant(&hir.types, globals, ty, value, &mut |at, part| {
        if let Some(place) = bytes.get_mut(at as usize..at as usize + part.len()) {
            place.copy_from_slice(part);
        }
    });
    bytes
}

/// The stored form of an integer or real constant.
pub fn scalar_bytes(e: Elementary, value: &Const) -> Vec<u8> {
    match (value, e) {
        (Const::Int(i), Elementary::Real) => (*i as f32).to_le_bytes().to_vec(),
        (Const::Int(i), Elementary::Lreal) => (*i as f64).to_le_bytes().to_vec(),
        (Const::Int(i), _) => i.to_le_bytes()[..e.bytes() as usize].to_vec(),
        (Const::Real(r), Elementary::Real) => (*r as f32).to_le_bytes().to_vec(),
        (Const::Real(r), _) => r.to_le_bytes()[..e.bytes() as usize].to_vec(),
        _ => vec![0; e.bytes() as usize],
    }
}
