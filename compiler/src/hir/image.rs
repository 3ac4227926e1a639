//! Direct addresses (§1.9, §3.4): one byte image for each of %I, %Q, %M. `%QWn` lies at byte 2n, `%QDn` at 4n, `%QXb.i` is bit i of
//! byte b, `%QXn` bit n mod 8 of byte n / 8.

use super::builder::Builder;
use super::hierarchy::{self, Hierarchy, is_hierarchical};
use super::model::*;
use super::place::{Access, Target};
use crate::syntax::ast::{self, AddressSize, Area};
use std::collections::HashMap;
use takt_base::{Code, Diag, Span};
use takt_image::image::Place as ImagePlace;
use takt_image::{Elementary, MemoryMap, TypeId};

/// Bytes of each area at most.
const AREA_MAX: u64 = 64 * 1024;

/// Who is located.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Owner {
    Global(GlobalId),
    Var(PouId, VarId),
}

/// A place relative to the start of its area.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Cell {
    pub area: Area,
    pub byte: u32,
    pub bit: Option<u8>,
}

/// Located variables, extents of the areas, and where they start once all are known.
#[derive(Default)]
pub(super) struct ImagePlan {
    pub located: Vec<(Owner, Cell)>,
    pub hierarchy: Hierarchy,
    areas: HashMap<Owner, Area>,
    /// Declared with an address that VAR_CONFIG gives: `%Q*`.
    open: HashMap<Owner, Area>,
    mirrors: Vec<(Mirror, Cell)>,
    pub extent: [u32; 3],
    starts: [u32; 3],
}

impl ImagePlan {
    /// Area of a located global.
    pub fn area_of_global(&self, id: GlobalId) -> Option<Area> {
        self.areas.get(&Owner::Global(id)).copied()
    }
    /// Area of a located variable of a program.
    pub fn area_of_var(&self, pou: PouId, id: VarId) -> Option<Area> {
        self.areas.get(&Owner::Var(pou, id)).copied()
    }

    /// Area of a variable whose address VAR_CONFIG gives.
    pub fn open_area(&self, owner: Owner) -> Option<Area> {
        self.open.get(&owner).copied()
    }
    /// A derived type leaves open what its base does: the variable has the same id there.
    pub fn inherit_open(&mut self, base: PouId, derived: PouId, id: VarId) {
        if let Some(area) = self.open_area(Owner::Var(base, id)) {
            self.open.insert(Owner::Var(derived, id), area);
        }
    }
    /// True if a unit has variables whose address is open.
    pub fn has_open(&self, pou: PouId) -> bool {
        self.open.keys().any(|o| matches!(o, Owner::Var(p, _) if *p == pou))
    }
    /// First byte of %Q in the memory, and the first behind it.
    pub fn output_bytes(&self) -> (u32, u32) {
        let first = self.starts[Area::Output as usize];
        (first, first + self.extent[Area::Output as usize])
    }
    fn place(&self, cell: Cell) -> ImagePlace {
        let byte = self.starts[cell.area as usize] + cell.byte;
        cell.bit.map_or(ImagePlace::Byte(byte), |bit| ImagePlace::Bit(byte, bit))
    }

    fn reserve(&mut self, cell: Cell, bytes: u32) {
        let extent = &mut self.extent[cell.area as usize];
        *extent = (*extent).max(cell.byte + bytes);
    }
}

/// Type of an address without a declaration.
pub(super) fn size_type(size: AddressSize) -> Elementary {
    match size {
        AddressSize::Bit => Elementary::Bool,
        AddressSize::Byte => Elementary::Byte,
        AddressSize::Word => Elementary::Word,
        AddressSize::Dword => Elementary::Dword,
        AddressSize::Lword => Elementary::Lword,
    }
}

/// Name of an anonymous located variable: its address.
pub(super) fn name_of(a: &ast::Address) -> ast::Name {
    let area = ["I", "Q", "M"][a.area as usize];
    let size = match a.size {
        AddressSize::Bit => "X",
        AddressSize::Byte => "B",
        AddressSize::Word => "W",
        AddressSize::Dword => "D",
        AddressSize::Lword => "L",
    };
    let path: Vec<_> = a.path.iter().map(u32::to_string).collect();
    ast::Name { text: format!("%{area}{size}{}", path.join(".")), span: a.span }
}

impl Builder<'_> {
    /// The cell of an address that takes `bytes`; `None` and a report if there is none.
    fn cell(&mut self, a: &ast::Address, bytes: u64) -> Option<Cell> {
        let (byte, bit) = match (a.size, a.path.as_slice()) {
            (_, []) => {
                let help = "only a declaration leaves it open: name AT %Q* : BOOL;";
                self.report(Diag::new(Code::BadAddress, a.span, "an open address").help(help));
                return None;
            }
            (AddressSize::Bit, [n]) => (u64::from(n / 8), Some((n % 8) as u8)),
            (AddressSize::Bit, [byte, bit @ 0..8]) => (u64::from(*byte), Some(*bit as u8)),
            (AddressSize::Bit, [_, bit]) => {
                self.report(Diag::new(Code::BadAddress, a.span, format!("bit {bit}")).help("a byte has the bits 0 to 7"));
                return None;
            }
            (size, [n]) => (u64::from(*n) * u64::from(size_type(size).bytes()), None),
            _ => return self.image.hierarchy.cell(a),
        };
        if byte + bytes > AREA_MAX {
            let help = format!("%I, %Q and %M have {AREA_MAX} bytes each");
            self.report(Diag::new(Code::TypeTooLarge, a.span, format!("byte {byte}")).help(help));
            return None;
        }
        Some(Cell { area: a.area, byte: byte as u32, bit })
    }

    /// Locates a variable of type `ty` (§3.4): its width must be that of the address.
    fn locate(&mut self, owner: Owner, a: &ast::Address, ty: TypeId, span: Span) {
        if ty == self.error || !self.fits_width(a, ty, span) {
            return;
        }
        let bytes = self.hir.types.layout(ty).size;
        if is_hierarchical(a) {
            self.image.hierarchy.note(a, bytes);
            self.image.areas.insert(owner, a.area);
            return self.image.hierarchy.locate(owner, a);
        }
        let Some(cell) = self.cell(a, bytes.into()) else { return };
        self.image.reserve(cell, bytes);
        self.image.areas.insert(owner, cell.area);
        self.image.located.push((owner, cell));
    }

    /// A variable `AT %Q*`: VAR_CONFIG gives its address.
    fn leave_open(&mut self, owner: Owner, a: &ast::Address, ty: TypeId, span: Span) {
        if a.size == AddressSize::Bit || self.fits_width(a, ty, span) {
            self.image.open.insert(owner, a.area);
        }
    }

    /// The address of a field of one instance.
    pub(super) fn mirror(&mut self, a: &ast::Address, mut mirror: Mirror, span: Span) {
        if !self.fits_width(a, mirror.ty, span) {
            return;
        }
        let bytes = self.hir.types.layout(mirror.ty).size;
        let Some(cell) = self.cell(a, bytes.into()) else { return };
        self.image.reserve(cell, bytes);
        mirror.input = cell.area == Area::Input;
        self.image.mirrors.push((mirror, cell));
    }

    /// The mirrors, for their initial values.
    pub(super) fn mirrors(&mut self) -> &mut [(Mirror, Cell)] {
        &mut self.image.mirrors
    }

    /// The width of a type must be that of the address.
    fn fits_width(&mut self, a: &ast::Address, ty: TypeId, span: Span) -> bool {
        let wanted = size_type(a.size);
        let element = self.array_parts(ty).map_or(ty, |(element, _)| element);
        let width = self.hir.types.storage(element).map(Elementary::bits);
        if width != Some(wanted.bits()) || (a.size == AddressSize::Bit && element != ty) {
            let label = format!("{} at {}", self.show(ty), name_of(a).text);
            let help = format!("an address of this size takes {} bit", wanted.bits());
            self.report(Diag::new(Code::AddressMismatch, a.span, label).also(span, "declared").help(help));
            return false;
        }
        true
    }

    /// Locates a global.
    pub fn locate_global(&mut self, id: GlobalId, a: &ast::Address) {
        let (ty, span) = (self.hir.globals[id].ty, self.hir.globals[id].span);
        match a.path.is_empty() {
            true => self.leave_open(Owner::Global(id), a, ty, span),
            false => self.locate(Owner::Global(id), a, ty, span),
        }
    }
    /// Locates a variable of a program.
    pub fn locate_var(&mut self, pou: PouId, id: VarId, a: &ast::Address) {
        let var = &self.hir.pous[pou].vars[id];
        let (ty, span) = (var.ty, var.span);
        match a.path.is_empty() {
            true => self.leave_open(Owner::Var(pou, id), a, ty, span),
            false => self.locate(Owner::Var(pou, id), a, ty, span),
        }
    }

    /// Sizes the areas by all addresses of the project and gives every located variable its place.
    pub fn place_image(&mut self) {
        self.reserve_bodies();
        if let Some(at) = self.image.place_hierarchy(AREA_MAX) {
            let help = format!("%I, %Q and %M have {AREA_MAX} bytes each");
            self.report(Diag::new(Code::TypeTooLarge, at, "no room behind the plain addresses").help(help));
        }
        self.hir.image_bytes = self.image.extent;
        let [i, q, m] = self.image.extent;
        let map = MemoryMap::new(i, q, m, 0, 0).unwrap_or_default();
        self.image.starts = [map.inputs.start, map.outputs.start, map.markers.start];
        self.place_mirrors();
        for (owner, cell) in std::mem::take(&mut self.image.located) {
            let place = self.image.place(cell);
            match owner {
                Owner::Global(id) => self.hir.globals[id].place = Some(place),
                Owner::Var(pou, id) => self.hir.pous[pou].vars[id].storage = Storage::Image(place),
            }
        }
    }

    fn place_mirrors(&mut self) {
        for (mut mirror, cell) in std::mem::take(&mut self.image.mirrors) {
            mirror.place = self.image.place(cell);
            self.hir.mirrors.push(mirror);
        }
    }

    /// Addresses in statements and in the configuration. What is wrong is reported where it is used.
    fn reserve_bodies(&mut self) {
        let mut found: Vec<(Area, u64)> = Vec::new();
        let hierarchy = &mut self.image.hierarchy;
        let mut note = |a: &ast::Address| {
            if is_hierarchical(a) {
                return hierarchy.note(a, hierarchy::width(a));
            }
            let width = u64::from(size_type(a.size).bytes());
            match (a.size, a.path.as_slice()) {
                (AddressSize::Bit, [n]) => found.push((a.area, u64::from(n / 8) + 1)),
                (_, [n, ..]) => found.push((a.area, (u64::from(*n) + 1) * width)),
                (_, []) => {}
            }
        };
        for pou in self.symbols.pous.iter() {
            super::body::addresses(&pou.decl.body, &mut note);
            super::access::addresses(&pou.decl.paths, &mut note);
        }
        self.symbols.configurations.iter().for_each(|c| super::config::addresses(c, &mut note));
        for (area, end) in found.into_iter().filter(|f| f.1 <= AREA_MAX) {
            let extent = &mut self.image.extent[area as usize];
            *extent = (*extent).max(end as u32);
        }
    }

    /// A direct address as a place.
    pub fn direct(&mut self, a: &ast::Address) -> Option<Target> {
        let e = size_type(a.size);
        let cell = self.cell(a, e.bytes().into())?;
        let ty = self.elem(e);
        let access = if a.area == Area::Input { Access::InputImage } else { Access::Write };
        let place = Place { base: Base::Image(self.image.place(cell)), path: Vec::new(), ty, span: a.span };
        Some(Target { place, access })
    }
}
