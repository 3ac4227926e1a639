//! Bytes to an image: the reverse of [`crate::encode`]. Bounds are checked here, meaning in [`crate::validate`].
//! Invariant: never panics, and takes no more memory than a small multiple of the input.

use crate::elementary::Elementary;
use crate::encode::{ACCESS, ENVELOPE, ImageError, MAGIC, NO_RESULT, SCALARS, SECTIONS, TARGETS, VERSION};
use crate::image::{Chunk, Function, Image, LineSite, Place, Program, Retained, Symbol, Task, TrapSite};
use crate::memory::MemoryMap;
use crate::natives::{NativeImport, NativeKind, Scalar};
use crate::types::{Dim, Field, PointerKind, Record, Type, TypeId, TypeTable};
use takt_base::Nanos;

type Read<T> = Result<T, ImageError>;

/// Reads an image and checks it whole.
pub fn decode(bytes: &[u8]) -> Result<Image, ImageError> {
    let mut r = Reader { rest: open(bytes)? };
    let image = r.image()?;
    if !r.rest.is_empty() {
        return Err(ImageError::new(format!("{} bytes too many at the end", r.rest.len())));
    }
    crate::validate::validate(&image)?;
    Ok(image)
}

/// Checks the envelope and returns the payload.
fn open(bytes: &[u8]) -> Read<&[u8]> {
    let mut r = Reader { rest: bytes };
    if bytes.len() < ENVELOPE || r.take(MAGIC.len())? != MAGIC {
        return Err(ImageError::new("the file does not begin as an image does"));
    }
    let version = r.u32()?;
    if version != VERSION {
        return Err(ImageError::new(format!("the image has format version {version}, this program reads version {VERSION}")));
    }
    let (length, checksum) = (r.u32()? as usize, r.u32()?);
    if r.rest.len() != length {
        return Err(ImageError::new(format!("the image should have {length} bytes of contents and has {}", r.rest.len())));
    }
    if crate::crc::crc32c(r.rest) != checksum {
        return Err(ImageError::new("the checksum does not fit the contents: the file is damaged"));
    }
    Ok(r.rest)
}

/// Takes fields from the front of the payload.
struct Reader<'a> {
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    fn take(&mut self, n: usize) -> Read<&'a [u8]> {
        let (head, rest) = self.rest.split_at_checked(n).ok_or_else(|| ImageError::new("the contents end too early"))?;
        self.rest = rest;
        Ok(head)
    }
    fn array<const N: usize>(&mut self) -> Read<[u8; N]> {
        self.take(N)?.try_into().map_err(|_| ImageError::new("the contents end too early"))
    }
    fn u8(&mut self) -> Read<u8> {
        Ok(self.array::<1>()?[0])
    }
    fn u32(&mut self) -> Read<u32> {
        Ok(u32::from_le_bytes(self.array()?))
    }
    fn i128(&mut self) -> Read<i128> {
        Ok(i128::from_le_bytes(self.array()?))
    }
    fn bytes(&mut self) -> Read<Vec<u8>> {
        let n = self.u32()? as usize;
        Ok(self.take(n)?.to_vec())
    }
    fn text(&mut self) -> Read<String> {
        String::from_utf8(self.bytes()?).map_err(|_| ImageError::new("a name is not UTF-8"))
    }
    /// A counted list whose elements take at least `least` bytes each.
    fn list<T>(&mut self, least: usize, mut each: impl FnMut(&mut Self) -> Read<T>) -> Read<Vec<T>> {
        let n = self.u32()? as usize;
        if n > self.rest.len() / least {
            return Err(ImageError::new(format!("a list of {n} elements does not fit the contents")));
        }
        (0..n).map(|_| each(self)).collect()
    }
    /// The element of a table that the file names by its number.
    fn choice<T: Copy>(&mut self, number: usize, table: &[T], what: &str) -> Read<T> {
        table.get(number).copied().ok_or_else(|| ImageError::new(format!("there is no {what} with the number {number}")))
    }

    fn image(&mut self) -> Read<Image> {
        let name = self.text()?;
        let target = self.u8()? as usize;
        let target = self.choice(target, &TARGETS, "target")?;
        let types = TypeTable::from_types(self.list(5, Self::ty)?);
        let memory = self.memory()?;
        let init = self.list(8, |r| Ok(Chunk { offset: r.u32()?, bytes: r.bytes()? }))?;
        let symbols = self.list(14, Self::symbol)?;
        let natives = self.list(9, |r| Ok(NativeImport { name: r.text()?, kind: r.native()? }))?;
        let functions = self.list(12, |r| Ok(Function { pou: r.text()?, start: r.u32()?, size: r.u32()? }))?;
        let code = self.bytes()?;
        let traps = self.list(5, |r| Ok(TrapSite { offset: r.u32()?, trap: r.u8()? }))?;
        let lines = self.list(12, |r| Ok(LineSite { offset: r.u32()?, file: r.u32()?, line: r.u32()? }))?;
        let files = self.list(4, Self::text)?;
        let tasks = self.list(13, Self::task)?;
        let retained = self.list(10, Self::retained)?;
        let attachments = self.list(8, |r| Ok((r.text()?, r.bytes()?)))?;
        Ok(Image {
            name,
            target,
            types,
            memory,
            init,
            symbols,
            natives,
            functions,
            code,
            traps,
            lines,
            files,
            tasks,
            retained,
            attachments,
        })
    }

    fn retained(&mut self) -> Read<Retained> {
        let (path, ty, place) = (self.text()?, TypeId(self.u32()?), self.place()?);
        Ok(Retained { path, ty, place, persistent: self.u8()? != 0 })
    }

    fn memory(&mut self) -> Read<MemoryMap> {
        let [i, q, m, d, f] = [self.u32()?, self.u32()?, self.u32()?, self.u32()?, self.u32()?];
        MemoryMap::new(i, q, m, d, f).ok_or_else(|| ImageError::new("the memory is larger than a resource may have"))
    }

    fn ty(&mut self) -> Read<Type> {
        let (tag, value) = (self.u8()?, self.u32()?);
        Ok(match tag {
            0 => Type::Elementary(self.elementary(value)?),
            1 => Type::String { capacity: value },
            2 => Type::WString { capacity: value },
            3 => {
                let (base, name) = (self.elementary(value)?, self.text()?);
                Type::Subrange { name, base, low: self.i128()?, high: self.i128()? }
            }
            4 => {
                let (base, name) = (self.elementary(value)?, self.text()?);
                Type::Enum { name, base, values: self.list(20, |r| Ok((r.text()?, r.i128()?)))? }
            }
            5 => {
                let dims = self.list(8, |r| Ok(Dim { low: r.u32()? as i32, high: r.u32()? as i32 }))?;
                Type::Array { element: TypeId(value), dims }
            }
            6 => Type::Struct(self.record(value)?),
            7 => Type::Instance(self.record(value)?),
            8 => Type::Reference { target: TypeId(value) },
            10 => Type::Open { element: TypeId(value), dims: self.u32()? },
            9 => {
                let number = self.u32()? as usize;
                Type::Pointer { target: TypeId(value), kind: self.choice(number, PointerKind::ALL, "kind of pointer")? }
            }
            _ => return Err(ImageError::new(format!("there is no kind of type with the number {tag}"))),
        })
    }

    fn elementary(&mut self, number: u32) -> Read<Elementary> {
        self.choice(number as usize, Elementary::ALL, "elementary type")
    }

    fn record(&mut self, size: u32) -> Read<Record> {
        let (align, name) = (self.u32()?, self.text()?);
        Ok(Record { name, fields: self.list(13, Self::field)?, size, align })
    }

    fn field(&mut self) -> Read<Field> {
        let (name, ty, offset, bits) = (self.text()?, TypeId(self.u32()?), self.u32()?, self.u8()?);
        let section = self.choice(bits as usize & 0x7F, &SECTIONS, "section")?;
        Ok(Field { name, ty, offset, section, retain: bits & 0x80 != 0 })
    }

    fn symbol(&mut self) -> Read<Symbol> {
        let (name, ty, place, bits) = (self.text()?, TypeId(self.u32()?), self.place()?, self.u8()?);
        let access = self.choice(usize::from(bits >> 2), &ACCESS, "access path")?;
        Ok(Symbol { name, ty, place, constant: bits & 1 != 0, retain: bits & 2 != 0, access })
    }

    /// Two flags in a byte.
    fn flags(&mut self) -> Read<u8> {
        let bits = self.u8()?;
        if bits > 3 { Err(ImageError::new("a flag that this version does not know")) } else { Ok(bits) }
    }

    fn place(&mut self) -> Read<Place> {
        match (self.u8()?, self.u32()?) {
            (0, offset) => Ok(Place::Byte(offset)),
            (1, offset) => Ok(Place::Bit(offset, self.u8()?)),
            (tag, _) => Err(ImageError::new(format!("there is no kind of place with the number {tag}"))),
        }
    }

    fn native(&mut self) -> Read<NativeKind> {
        match self.u8()? {
            0 => {
                let params = self.list(1, Self::scalar)?;
                let number = self.u8()?;
                let result =
                    if number == NO_RESULT { None } else { Some(self.choice(number as usize, &SCALARS, "machine type")?) };
                Ok(NativeKind::Function { params, result })
            }
            1 => Ok(NativeKind::Block { ty: TypeId(self.u32()?) }),
            tag => Err(ImageError::new(format!("there is no kind of native with the number {tag}"))),
        }
    }

    fn scalar(&mut self) -> Read<Scalar> {
        let number = self.u8()? as usize;
        self.choice(number, &SCALARS, "machine type")
    }

    fn task(&mut self) -> Read<Task> {
        let (name, priority, bits) = (self.text()?, self.u32()?, self.flags()?);
        let interval = if bits & 1 != 0 { Some(Nanos(i64::from_le_bytes(self.array()?))) } else { None };
        let trigger = if bits & 2 != 0 { Some(self.place()?) } else { None };
        let programs = self.list(12, |r| Ok(Program { name: r.text()?, function: r.u32()?, instance: r.u32()? }))?;
        Ok(Task { name, priority, interval, trigger, programs })
    }
}
