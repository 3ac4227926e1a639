//! Whether an image makes sense: the runtime, the monitor and the loader rely on every rule here, so that they need no checks of
//! their own. An image from the compiler passes by construction; one from disk may be anything.

use crate::elementary::Elementary;
use crate::encode::ImageError;
use crate::image::{Image, Place, Task};
use crate::memory::{Area, MAX_MEMORY, MemoryMap, header};
use crate::natives::{MAX_SLOTS, NativeKind};
use crate::traps::Trap;
use crate::types::{Record, Type, TypeId, TypeTable};

/// Deepest nesting of arrays, structures and instances.
pub const MAX_NESTING: u32 = 128;
/// Most tasks of a resource.
pub const MAX_TASKS: usize = 1024;
/// Values that a type without bytes (an array of empty structures) may have.
const FREE_VALUES: u64 = 1 << 16;

type Check = Result<(), ImageError>;

/// Checks everything that the other parts rely on.
pub fn validate(image: &Image) -> Check {
    memory(&image.memory)?;
    types(&image.types)?;
    init(image)?;
    symbols(image)?;
    natives(image)?;
    code(image)?;
    ensure(image.tasks.len() <= MAX_TASKS, || format!("there are more than {MAX_TASKS} tasks"))?;
    image.tasks.iter().try_for_each(|t| task(image, t))
}

fn ensure(ok: bool, reason: impl FnOnce() -> String) -> Check {
    if ok { Ok(()) } else { Err(ImageError::new(reason())) }
}

fn memory(m: &MemoryMap) -> Check {
    let sizes = [m.inputs, m.outputs, m.markers, m.data, m.frames].map(|a| a.size);
    let want = MemoryMap::new(sizes[0], sizes[1], sizes[2], sizes[3], sizes[4]);
    ensure(want == Some(*m), || "the parts of the memory do not follow each other, or are too large".into())
}

/// Types: ids exist, nothing contains itself, sizes are what the members need.
fn types(table: &TypeTable) -> Check {
    table.iter().try_for_each(|(_, ty)| well_formed(table, ty))?;
    let mut names = Walk::new(table, false);
    table.iter().try_for_each(|(id, _)| names.visit(id, 0).map(|_| ()))?;
    let mut parts = Walk::new(table, true);
    table.iter().try_for_each(|(id, _)| parts.visit(id, 0).map(|_| ()))
}

/// What can be said of a type without its parts.
fn well_formed(table: &TypeTable, ty: &Type) -> Check {
    let known = |id: TypeId| ensure((id.0 as usize) < table.len(), || format!("there is no type {}", id.0));
    match ty {
        Type::Elementary(_) => Ok(()),
        Type::String { capacity } | Type::WString { capacity } => {
            ensure(*capacity < MAX_MEMORY / 4, || format!("a string can't have {capacity} characters"))
        }
        Type::Subrange { name, base, low, high } => ensure(low <= high && fits(*base, *low) && fits(*base, *high), || {
            format!("the bounds of `{name}` do not fit its base")
        }),
        Type::Enum { name, base, values } => ensure(!base.is_real() && values.iter().all(|(_, v)| fits(*base, *v)), || {
            format!("a value of `{name}` does not fit its base")
        }),
        Type::Array { element, dims } => {
            let sane = |d: &crate::types::Dim| d.low <= d.high && (d.high as i64 - d.low as i64) < MAX_MEMORY as i64;
            ensure(!dims.is_empty() && dims.len() <= 16 && dims.iter().all(sane), || {
                "the bounds of an array make no sense".into()
            })?;
            known(*element)
        }
        Type::Struct(r) | Type::Instance(r) => r.fields.iter().try_for_each(|f| known(f.ty)),
        Type::Reference { target } | Type::Pointer { target, .. } => known(*target),
    }
}

fn fits(base: Elementary, value: i128) -> bool {
    base.int_range().is_some_and(|(low, high)| low <= value && value <= high)
}

/// Walks the type graph once. With `contents`, along what a value contains, and checks layouts; else along what a name is made of.
struct Walk<'a> {
    table: &'a TypeTable,
    contents: bool,
    /// Per type, when it is done: nesting depth and number of single values.
    done: Vec<Option<(u32, u64)>>,
}

impl<'a> Walk<'a> {
    fn new(table: &'a TypeTable, contents: bool) -> Self {
        Self { table, contents, done: vec![None; table.len()] }
    }

    /// Depth and number of values of a type. A cycle shows as a depth without end.
    fn visit(&mut self, id: TypeId, depth: u32) -> Result<(u32, u64), ImageError> {
        ensure(depth <= MAX_NESTING, || "a type contains itself or is nested too deep".into())?;
        if let Some(done) = self.done[id.0 as usize] {
            return Ok(done);
        }
        let (below, values) = self.parts(id, depth)?;
        ensure(below < MAX_NESTING, || "a type contains itself or is nested too deep".into())?;
        if self.contents {
            self.size(id, values)?;
        }
        self.done[id.0 as usize] = Some((below + 1, values));
        Ok((below + 1, values))
    }

    fn parts(&mut self, id: TypeId, depth: u32) -> Result<(u32, u64), ImageError> {
        match self.table.get(id) {
            Type::Array { element, dims } => {
                let (below, values) = self.visit(*element, depth + 1)?;
                Ok((below, dims.iter().fold(values, |n, d| n.saturating_mul(d.len() as u64))))
            }
            Type::Struct(r) | Type::Instance(r) if self.contents => self.record(r, depth),
            Type::Reference { target } | Type::Pointer { target, .. } if !self.contents => self.visit(*target, depth + 1),
            _ => Ok((0, 1)),
        }
    }

    fn record(&mut self, r: &Record, depth: u32) -> Result<(u32, u64), ImageError> {
        let bad = || format!("the layout of `{}` is wrong", r.name);
        ensure(matches!(r.align, 1 | 2 | 4 | 8) && r.size.is_multiple_of(r.align) && r.size <= MAX_MEMORY, bad)?;
        let mut sum = (0, 1u64);
        for f in &r.fields {
            let (below, values) = self.visit(f.ty, depth + 1)?;
            let l = self.table.layout(f.ty);
            let inside = f.offset.checked_add(l.size).is_some_and(|end| end <= r.size);
            ensure(inside && l.align <= r.align && f.offset.is_multiple_of(l.align), bad)?;
            sum = (sum.0.max(below), sum.1.saturating_add(values));
        }
        Ok(sum)
    }

    /// The parts are checked: the size can be computed without overflow.
    fn size(&self, id: TypeId, values: u64) -> Check {
        let size = self.table.layout(id).size;
        let free = |ty: &Type| matches!(ty, Type::Struct(_) | Type::Instance(_) | Type::Array { .. });
        let dense = !free(self.table.get(id)) || values <= FREE_VALUES.max(64 * size as u64);
        ensure(size <= MAX_MEMORY && dense, || format!("the type {} is larger than the memory may be", id.0))
    }
}

/// True if `size` bytes at `offset` lie behind the header and inside the memory.
fn inside(image: &Image, offset: u32, size: u32) -> bool {
    offset >= header::SIZE && offset.checked_add(size).is_some_and(|end| end <= image.memory.size())
}

fn init(image: &Image) -> Check {
    let mut free = header::SIZE;
    for c in &image.init {
        let size = u32::try_from(c.bytes.len()).unwrap_or(u32::MAX);
        ensure(c.offset >= free && inside(image, c.offset, size), || format!("initial values at {} are out of place", c.offset))?;
        free = c.offset + size;
    }
    Ok(())
}

fn place(image: &Image, place: Place, ty: TypeId) -> bool {
    match place {
        Place::Byte(offset) => inside(image, offset, image.types.layout(ty).size),
        Place::Bit(offset, bit) => bit < 8 && process_image(image, offset) && image.types.storage(ty) == Some(Elementary::Bool),
    }
}

fn process_image(image: &Image, offset: u32) -> bool {
    let m = &image.memory;
    [m.inputs, m.outputs, m.markers].iter().any(|a: &Area| a.range().contains(&(offset as usize)))
}

fn symbols(image: &Image) -> Check {
    image.symbols.iter().try_for_each(|s| {
        ensure(image.types.try_get(s.ty).is_some(), || format!("`{}` has no type", s.name))?;
        ensure(place(image, s.place, s.ty), || format!("`{}` does not lie inside the memory", s.name))
    })
}

fn natives(image: &Image) -> Check {
    image.natives.iter().try_for_each(|n| match &n.kind {
        NativeKind::Function { params, .. } => {
            ensure(params.len() <= MAX_SLOTS, || format!("`{}` has too many parameters", n.name))
        }
        NativeKind::Block { ty } => ensure(matches!(image.types.try_get(*ty), Some(Type::Instance(_))), || {
            format!("`{}` is not a function block", n.name)
        }),
    })
}

fn code(image: &Image) -> Check {
    let size = u32::try_from(image.code.len()).unwrap_or(0);
    let mut free = 0;
    for f in &image.functions {
        let end = f.start.checked_add(f.size).filter(|&end| f.start >= free && end <= size);
        free = end.ok_or_else(|| ImageError::new(format!("the code of `{}` is out of place", f.pou)))?;
    }
    let ordered = image.traps.is_sorted_by_key(|t| t.offset) && image.lines.is_sorted_by_key(|l| l.offset);
    ensure(ordered, || "the tables of traps and lines are not in order".into())?;
    let known = image.traps.iter().all(|t| t.offset < size && Trap::from_number(t.trap).is_some());
    ensure(known, || "a trap is not in the code or not known".into())?;
    let named = image.lines.iter().all(|l| l.offset <= size && (l.file as usize) < image.files.len());
    ensure(named, || "a line is not in the code or not of a known file".into())
}

fn task(image: &Image, t: &Task) -> Check {
    ensure(t.interval.is_none_or(|i| i.0 > 0), || format!("the interval of task `{}` is not positive", t.name))?;
    let trigger = match t.trigger {
        None => true,
        Some(Place::Byte(offset)) => inside(image, offset, 1),
        Some(Place::Bit(offset, bit)) => bit < 8 && process_image(image, offset),
    };
    ensure(trigger, || format!("the trigger of task `{}` does not lie inside the memory", t.name))?;
    t.programs.iter().try_for_each(|p| {
        let known = (p.function as usize) < image.functions.len() && inside(image, p.instance, 0);
        ensure(known, || format!("program `{}` of task `{}` is not in the image", p.name, t.name))
    })
}
