//! An image as bytes: magic, format version, length, checksum, then the fields in the order of [`Image`], little-endian.
//!
//! Invariant: `decode(encode(image)) == image` for every image that [`crate::validate`] accepts, and any other bytes give an error
//! with a reason. Every count is checked against the bytes that are left before memory is taken.

use crate::image::{Access, Image, Place, Target, Task};
use crate::natives::{NativeKind, Scalar};
use crate::types::{Field, Record, Section, Type};
use takt_base::{Code, Nanos};

pub use crate::decode::decode;

/// First bytes of an image file.
pub const MAGIC: [u8; 8] = *b"TAKTIMG\n";
/// Version of the format. A reader takes its own version alone.
pub const VERSION: u32 = 3;
/// Bytes before the payload: magic, version, payload length, CRC-32C of the payload.
pub(crate) const ENVELOPE: usize = 8 + 4 + 4 + 4;

/// Why bytes are not an image that this version can run.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ImageError {
    /// What is wrong, as a sentence without a full stop.
    pub reason: String,
}

impl ImageError {
    pub(crate) fn new(reason: impl Into<String>) -> Self {
        Self { reason: reason.into() }
    }
    /// The diagnostic code.
    pub const fn code(&self) -> Code {
        Code::BadImage
    }
    /// What to do.
    pub const fn help(&self) -> &'static str {
        "build the project again with `takt build`"
    }
}

impl std::fmt::Display for ImageError {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(&self.reason)
    }
}

impl std::error::Error for ImageError {}

/// The image as a file's contents.
pub fn encode(image: &Image) -> Vec<u8> {
    let mut w = Writer::default();
    w.image(image);
    seal(&w.0)
}

/// Puts magic, version, length and checksum before a payload.
pub(crate) fn seal(payload: &[u8]) -> Vec<u8> {
    let mut out = Vec::with_capacity(ENVELOPE + payload.len());
    out.extend(MAGIC);
    out.extend(VERSION.to_le_bytes());
    out.extend((payload.len() as u32).to_le_bytes());
    out.extend(crate::crc::crc32c(payload).to_le_bytes());
    out.extend(payload);
    out
}

/// Appends fields to the payload. The order here and in `decode` is the format.
#[derive(Default)]
struct Writer(Vec<u8>);

impl Writer {
    fn u8(&mut self, v: u8) {
        self.0.push(v);
    }
    fn u32(&mut self, v: u32) {
        self.0.extend(v.to_le_bytes());
    }
    fn i128(&mut self, v: i128) {
        self.0.extend(v.to_le_bytes());
    }
    fn bytes(&mut self, v: &[u8]) {
        self.u32(v.len() as u32);
        self.0.extend(v);
    }
    fn text(&mut self, v: &str) {
        self.bytes(v.as_bytes());
    }
    fn list<T>(&mut self, items: &[T], mut each: impl FnMut(&mut Self, &T)) {
        self.u32(items.len() as u32);
        items.iter().for_each(|i| each(self, i));
    }

    fn image(&mut self, image: &Image) {
        self.text(&image.name);
        self.u8(image.target as u8);
        self.u32(image.types.len() as u32);
        image.types.iter().for_each(|(_, ty)| self.ty(ty));
        let m = &image.memory;
        [m.inputs, m.outputs, m.markers, m.data, m.frames].iter().for_each(|a| self.u32(a.size));
        self.list(&image.init, |w, c| {
            w.u32(c.offset);
            w.bytes(&c.bytes);
        });
        self.list(&image.symbols, |w, s| {
            w.text(&s.name);
            w.u32(s.ty.0);
            w.place(s.place);
            let access = ACCESS.iter().position(|a| *a == s.access).unwrap_or(0) as u8;
            w.u8(u8::from(s.constant) | u8::from(s.retain) << 1 | access << 2);
        });
        self.list(&image.natives, |w, n| {
            w.text(&n.name);
            w.native(&n.kind);
        });
        self.code(image);
        self.list(&image.tasks, Self::task);
        self.list(&image.retained, |w, r| {
            w.text(&r.path);
            w.u32(r.ty.0);
            w.place(r.place);
            w.u8(u8::from(r.persistent));
        });
        self.list(&image.attachments, |w, (name, contents)| {
            w.text(name);
            w.bytes(contents);
        });
    }

    fn code(&mut self, image: &Image) {
        self.list(&image.functions, |w, f| {
            w.text(&f.pou);
            w.u32(f.start);
            w.u32(f.size);
        });
        self.bytes(&image.code);
        self.list(&image.traps, |w, t| {
            w.u32(t.offset);
            w.u8(t.trap);
        });
        self.list(&image.lines, |w, l| [l.offset, l.file, l.line].iter().for_each(|&v| w.u32(v)));
        self.list(&image.files, |w, f| w.text(f));
    }

    fn ty(&mut self, ty: &Type) {
        match ty {
            Type::Elementary(e) => self.tagged(0, *e as u32),
            Type::String { capacity } => self.tagged(1, *capacity),
            Type::WString { capacity } => self.tagged(2, *capacity),
            Type::Subrange { name, base, low, high } => {
                self.tagged(3, *base as u32);
                self.text(name);
                self.i128(*low);
                self.i128(*high);
            }
            Type::Enum { name, base, values } => {
                self.tagged(4, *base as u32);
                self.text(name);
                self.list(values, |w, (name, value)| {
                    w.text(name);
                    w.i128(*value);
                });
            }
            Type::Array { element, dims } => {
                self.tagged(5, element.0);
                self.list(dims, |w, d| {
                    w.u32(d.low as u32);
                    w.u32(d.high as u32);
                });
            }
            Type::Struct(r) => self.record(6, r),
            Type::Instance(r) => self.record(7, r),
            Type::Reference { target } => self.tagged(8, target.0),
            Type::Open { element, dims } => {
                self.tagged(10, element.0);
                self.u32(*dims);
            }
            Type::Pointer { target, kind } => {
                self.tagged(9, target.0);
                self.u32(*kind as u32);
            }
        }
    }

    fn tagged(&mut self, tag: u8, value: u32) {
        self.u8(tag);
        self.u32(value);
    }

    fn record(&mut self, tag: u8, r: &Record) {
        self.tagged(tag, r.size);
        self.u32(r.align);
        self.text(&r.name);
        self.list(&r.fields, |w, f: &Field| {
            w.text(&f.name);
            w.u32(f.ty.0);
            w.u32(f.offset);
            w.u8(f.section as u8 | u8::from(f.retain) << 7);
        });
    }

    fn place(&mut self, place: Place) {
        match place {
            Place::Byte(o) => self.tagged(0, o),
            Place::Bit(o, bit) => {
                self.tagged(1, o);
                self.u8(bit);
            }
        }
    }

    fn native(&mut self, kind: &NativeKind) {
        match kind {
            NativeKind::Function { params, result } => {
                self.u8(0);
                self.list(params, |w, &s| w.u8(s as u8));
                self.u8(result.map_or(NO_RESULT, |s| s as u8));
            }
            NativeKind::Block { ty } => self.tagged(1, ty.0),
        }
    }

    fn task(&mut self, t: &Task) {
        self.text(&t.name);
        self.u32(t.priority);
        self.u8(u8::from(t.interval.is_some()) | u8::from(t.trigger.is_some()) << 1);
        if let Some(Nanos(n)) = t.interval {
            self.0.extend(n.to_le_bytes());
        }
        if let Some(p) = t.trigger {
            self.place(p);
        }
        self.list(&t.programs, |w, p| {
            w.text(&p.name);
            w.u32(p.function);
            w.u32(p.instance);
        });
    }
}

/// Stands for a native function without a result.
pub(crate) const NO_RESULT: u8 = 0xFF;
/// Machine types by their number in the file.
pub(crate) const SCALARS: [Scalar; 6] = [Scalar::I8, Scalar::I16, Scalar::I32, Scalar::I64, Scalar::F32, Scalar::F64];
/// Sections by their number in the file.
pub(crate) const SECTIONS: [Section; 5] = [Section::Var, Section::Input, Section::Output, Section::InOut, Section::Hidden];
/// Directions of access paths by their number in the file.
pub(crate) const ACCESS: [Option<Access>; 3] = [None, Some(Access::ReadOnly), Some(Access::ReadWrite)];
/// Targets by their number in the file.
pub(crate) const TARGETS: [Target; 2] = [Target::None, Target::X86_64V2];
