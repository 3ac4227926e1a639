//! What keeps its value over a restart: RETAIN, NON_RETAIN and PERSISTENT through instances, structures and arrays.
//! From: language reference §3.2, §10.4. References and class numbers are never kept: they
//! would mean something else in a changed program.

use super::data::{Data, process_image, too_large};
use crate::hir::model::*;
use std::collections::HashMap;
use takt_base::{Diag, Span};
use takt_image::image::{Place as ImagePlace, Retained};
use takt_image::types::{Field, Record, Section};
use takt_image::{CLASS_FIELD, Type, TypeId};

/// Variables at most: more of them are better kept as one array.
const RETAINED_MAX: usize = 1 << 18;

/// All retained variables, each as a whole where it can be.
pub fn retained(hir: &Hir, data: &Data) -> Result<Vec<Retained>, Diag> {
    // The unit of a type comes before the one that sets up its instances.
    let units =
        hir.pous.enumerate().filter_map(|(id, p)| Some((p.instance?, id))).collect::<Vec<_>>().into_iter().rev().collect();
    let mut walk = Walk { hir, units, plain: HashMap::new(), says: HashMap::new(), found: Vec::new() };
    for (id, g) in hir.globals.enumerate().filter(|(_, g)| !g.constant) {
        let root = Root::Global(id);
        walk.variable(&At { root: &root, start: 0, span: g.span }, &hir.global_path(g), g.ty, data.globals[id], g.keep)?;
    }
    let programs = hir.tasks.iter().zip(&data.instances).flat_map(|(t, offsets)| t.programs.iter().zip(offsets));
    for (p, offset) in programs {
        let (pou, root) = (&hir.pous[p.pou], p.root());
        let (at, name) = (At { root: &root, start: *offset, span: pou.end }, hir.path(Some(p.resource), &p.name));
        if let Some(ty) = pou.instance.filter(|_| p.global.is_none()) {
            walk.part(&at, name.clone(), ty, *offset, p.keep)?;
        }
        for v in pou.vars.iter() {
            if let Storage::Image(place) = v.storage {
                walk.variable(&at, &format!("{name}.{}", v.name), v.ty, place, p.keep.or(v.keep))?;
            }
        }
    }
    Ok(walk.found)
}

struct Walk<'h> {
    hir: &'h Hir,
    units: HashMap<TypeId, PouId>,
    /// Types whose values are all there is: can be kept as a whole.
    plain: HashMap<TypeId, bool>,
    /// Types with a part that says RETAIN itself.
    says: HashMap<TypeId, bool>,
    found: Vec<Retained>,
}

/// What a walk is in.
struct At<'r> {
    root: &'r Root,
    /// Offset of the program instance; of a global nothing, since mirrors count from its start.
    start: u32,
    span: Span,
}

impl Walk<'_> {
    fn variable(&mut self, at: &At, path: &str, ty: TypeId, place: ImagePlace, keep: Keep) -> Result<(), Diag> {
        let inputs = process_image(self.hir).unwrap_or_default().inputs;
        match place {
            ImagePlace::Byte(o) | ImagePlace::Bit(o, _) if inputs.range().contains(&(o as usize)) => Ok(()),
            ImagePlace::Byte(offset) => {
                let start = if matches!(at.root, Root::Global(_)) { offset } else { at.start };
                self.part(&At { start, ..*at }, path.to_owned(), ty, offset, keep)
            }
            bit if keep.is_kept() => self.push(at, path.to_owned(), ty, bit, keep),
            _ => Ok(()),
        }
    }

    fn push(&mut self, at: &At, path: String, ty: TypeId, place: ImagePlace, keep: Keep) -> Result<(), Diag> {
        if self.found.len() == RETAINED_MAX {
            return Err(too_large(at.span, "the list of retained variables"));
        }
        self.found.push(Retained { path, ty, place, persistent: keep == Keep::Persistent });
        Ok(())
    }

    fn part(&mut self, at: &At, path: String, ty: TypeId, offset: u32, keep: Keep) -> Result<(), Diag> {
        if !keep.is_kept() && !self.says(ty) {
            return Ok(());
        }
        if let Some(m) = self.hir.mirrors.iter().find(|m| m.root == *at.root && at.start + m.offset == offset && m.ty == ty) {
            return if m.input || !keep.is_kept() { Ok(()) } else { self.push(at, path, ty, m.place, keep) };
        }
        let types = &self.hir.types;
        match types.get(ty) {
            Type::Instance(r) => self.unit(at, path, ty, r, offset, keep),
            _ if keep.is_kept() && self.plain(ty) => self.push(at, path, ty, ImagePlace::Byte(offset), keep),
            Type::Struct(r) => {
                r.fields.iter().try_for_each(|f| self.part(at, format!("{path}.{}", f.name), f.ty, offset + f.offset, keep))
            }
            Type::Array { element, dims } => {
                let (size, low) = (types.layout(*element).size, dims.first().map_or(0, |d| i64::from(d.low)));
                let count = dims.iter().fold(1u32, |n, d| n.saturating_mul(d.len()));
                let name = |i: u32| if dims.len() == 1 { low + i64::from(i) } else { i64::from(i) };
                (0..count).try_for_each(|i| self.part(at, format!("{path}[{}]", name(i)), *element, offset + i * size, keep))
            }
            _ => Ok(()),
        }
    }

    fn unit(&mut self, at: &At, path: String, ty: TypeId, r: &Record, offset: u32, keep: Keep) -> Result<(), Diag> {
        let Some(&pou) = self.units.get(&ty) else { return Ok(()) };
        let hir = self.hir;
        let kept = |v: &&Var| v.role != Role::InOut && v.name != CLASS_FIELD;
        for v in hir.pous[pou].vars.iter().filter(kept) {
            let Storage::Field(i) = v.storage else { continue };
            let Some(f) = r.fields.get(i as usize) else { continue };
            self.part(at, format!("{path}.{}", f.name), f.ty, offset + f.offset, keep.or(v.keep))?;
        }
        Ok(())
    }

    /// True if nothing in a value must be left out.
    fn plain(&mut self, ty: TypeId) -> bool {
        if let Some(&known) = self.plain.get(&ty) {
            return known;
        }
        self.plain.insert(ty, false);
        let hir = self.hir;
        let plain = match hir.types.get(ty) {
            Type::Elementary(_) | Type::Subrange { .. } | Type::Enum { .. } | Type::String { .. } | Type::WString { .. } => true,
            Type::Array { element, .. } => self.plain(*element),
            Type::Struct(r) => r.fields.iter().all(|f| self.plain(f.ty)),
            Type::Instance(r) => {
                let own = self.units.get(&ty).is_some_and(|p| hir.pous[*p].vars.iter().all(|v| v.keep == Keep::Unsaid));
                let whole = |f: &Field| f.section != Section::InOut && f.name != CLASS_FIELD;
                own && hir.mirrors.is_empty() && r.fields.iter().all(|f| whole(f) && self.plain(f.ty))
            }
            _ => false,
        };
        self.plain.insert(ty, plain);
        plain
    }

    fn says(&mut self, ty: TypeId) -> bool {
        if let Some(&known) = self.says.get(&ty) {
            return known;
        }
        self.says.insert(ty, false);
        let hir = self.hir;
        let says = match hir.types.get(ty) {
            Type::Array { element, .. } => self.says(*element),
            Type::Struct(r) => r.fields.iter().any(|f| self.says(f.ty)),
            Type::Instance(r) => {
                let own = self.units.get(&ty).is_some_and(|p| hir.pous[*p].vars.iter().any(|v| v.keep.is_kept()));
                own || r.fields.iter().any(|f| f.section != Section::InOut && self.says(f.ty))
            }
            _ => false,
        };
        self.says.insert(ty, says);
        says
    }
}
