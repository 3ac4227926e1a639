//! Paths of variables: `instance.variable.member[3].x`, globals by their name, `%IX0.1`. Case does not matter; the answer has the
//! declared spelling. Direct addresses are those of IEC reference §3.4 model (a): one byte image per area, `%QWn` at byte 2n.

use crate::access::AccessError;
use crate::elementary::Elementary as E;
use crate::image::{Access, Image, Place, Symbol};
use crate::literal::parse_int;
use crate::types::{Dim, Field, Section, Type, TypeId};
use crate::value::VarType;
use takt_base::nearest;

/// A variable that a path names.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Variable {
    /// Path in the declared spelling.
    pub name: String,
    /// Where.
    pub place: Place,
    /// Type.
    pub ty: VarType,
    /// Declared CONSTANT: the program may not look at it again.
    pub constant: bool,
    /// Reached by an access path that is READ_ONLY.
    pub read_only: bool,
}

type Found = Result<Variable, AccessError>;

/// Finds the variable of a path.
pub fn resolve(image: &Image, path: &str) -> Found {
    let path = path.trim();
    if path.starts_with('%') {
        return address(image, path);
    }
    let steps = steps(path)?;
    let (symbol, rest) = root(image, &steps)?;
    let start = Variable {
        name: symbol.name.clone(),
        place: symbol.place,
        ty: symbol.ty.into(),
        constant: symbol.constant,
        read_only: symbol.access == Some(Access::ReadOnly),
    };
    rest.iter().try_fold(start, |v, step| descend(image, v, step))
}

/// A part of a path.
#[derive(Clone, PartialEq, Debug)]
enum Step {
    Name(String),
    Index(Vec<i128>),
}

fn malformed(path: &str) -> AccessError {
    AccessError::path(format!("`{path}` is not the path of a variable"))
        .help("write it as instance.variable.member[3].x or %IX0.1")
}

fn steps(path: &str) -> Result<Vec<Step>, AccessError> {
    let mut steps = Vec::new();
    for part in path.split('.') {
        let (name, mut rest) = part.split_at(part.find('[').unwrap_or(part.len()));
        let word = |c: char| c.is_alphanumeric() || matches!(c, '_' | '%');
        let name = name.trim();
        if name.is_empty() || !name.chars().all(word) {
            return Err(malformed(path));
        }
        steps.push(Step::Name(name.to_owned()));
        while !rest.trim().is_empty() {
            let (index, behind) = rest.trim().strip_prefix('[').and_then(|r| r.split_once(']')).ok_or_else(|| malformed(path))?;
            let numbers = index.split(',').map(|i| parse_int(i.trim())).collect::<Option<Vec<_>>>();
            steps.push(Step::Index(numbers.ok_or_else(|| malformed(path))?));
            rest = behind;
        }
    }
    Ok(steps)
}

/// The symbol that a path begins with: the longest run of names that is one, since names of symbols may have dots themselves. The
/// name of the resource before it is left out.
fn root<'i, 's>(image: &'i Image, steps: &'s [Step]) -> Result<(&'i Symbol, &'s [Step]), AccessError> {
    let names: Vec<&str> = steps.iter().map_while(|s| if let Step::Name(n) = s { Some(n.as_str()) } else { None }).collect();
    let first = names.first().copied().unwrap_or_default();
    let resource = usize::from(names.len() > 1 && first.eq_ignore_ascii_case(&image.name));
    for from in [0, resource] {
        for to in (from + 1..=names.len()).rev() {
            if let Some(symbol) = image.symbol(&names[from..to].join(".")) {
                return Ok((symbol, &steps[to..]));
            }
        }
    }
    let known = image.symbols.iter().map(|s| s.name.as_str());
    let e = AccessError::path(format!("there is no variable or program instance `{first}`"));
    Err(suggest(e, first, known))
}

fn suggest<'a>(e: AccessError, name: &str, known: impl Iterator<Item = &'a str> + Clone) -> AccessError {
    if let Some(n) = nearest(name, known.clone()) {
        return e.help(format!("did you mean `{n}`?"));
    }
    let some: Vec<_> = known.take(8).collect();
    if some.is_empty() { e } else { e.help(format!("there are {}", some.join(", "))) }
}

fn descend(image: &Image, v: Variable, step: &Step) -> Found {
    let (VarType::Declared(id), Place::Byte(offset)) = (v.ty, v.place) else {
        return Err(AccessError::path(format!("`{}` is a single bit and has no parts", v.name)));
    };
    match (step, image.types.get(id)) {
        (Step::Name(name), Type::Struct(r) | Type::Instance(r)) => member(v, offset, name, &r.fields),
        (Step::Index(index), Type::Array { element, dims }) => {
            let at = element_at(&v.name, index, dims)?;
            let offset = offset.saturating_add(at.saturating_mul(image.types.layout(*element).size));
            let index: Vec<_> = index.iter().map(i128::to_string).collect();
            Ok(Variable {
                name: format!("{}[{}]", v.name, index.join(",")),
                place: Place::Byte(offset),
                ty: (*element).into(),
                ..v
            })
        }
        (Step::Name(name), _) => bit(image, v, offset, id, name),
        (Step::Index(_), _) => Err(AccessError::path(format!("`{}` is no array but {}", v.name, image.types.display(id)))),
    }
}

fn member(v: Variable, offset: u32, name: &str, fields: &[Field]) -> Found {
    let shown = fields.iter().filter(|f| f.section != Section::Hidden);
    let Some(f) = shown.clone().find(|f| f.name.eq_ignore_ascii_case(name)) else {
        let e = AccessError::path(format!("`{}` has no member `{name}`", v.name));
        return Err(suggest(e, name, shown.map(|f| f.name.as_str())));
    };
    if f.section == Section::InOut {
        let e = AccessError::path(format!("`{}.{}` is a VAR_IN_OUT: it has a value during a call alone", v.name, f.name));
        return Err(e.help("name the variable that is passed"));
    }
    let place = Place::Byte(offset.saturating_add(f.offset));
    Ok(Variable { name: format!("{}.{}", v.name, f.name), place, ty: f.ty.into(), ..v })
}

/// Number of an element, row-major.
fn element_at(name: &str, index: &[i128], dims: &[Dim]) -> Result<u32, AccessError> {
    let bounds = || dims.iter().map(|d| format!("{}..{}", d.low, d.high)).collect::<Vec<_>>().join(", ");
    let inside = |(i, d): (&i128, &Dim)| (d.low as i128..=d.high as i128).contains(i);
    if index.len() != dims.len() || !index.iter().zip(dims).all(inside) {
        return Err(
            AccessError::path(format!("this is not an element of `{name}`")).help(format!("its bounds are [{}]", bounds()))
        );
    }
    let at = index.iter().zip(dims).fold(0i128, |n, (i, d)| n * d.len() as i128 + (i - d.low as i128));
    Ok(u32::try_from(at).unwrap_or(u32::MAX))
}

/// `.3` or `.%X3` of an integer or bit string (IEC reference §2.11).
fn bit(image: &Image, v: Variable, offset: u32, id: TypeId, name: &str) -> Found {
    let none = || AccessError::path(format!("`{}` is {} and has no member `{name}`", v.name, image.types.display(id)));
    let storage = image.types.storage(id).filter(|e| (e.is_bit() || e.is_int()) && *e != E::Bool).ok_or_else(none)?;
    let number = name.strip_prefix(['%']).map_or(Some(name), |n| n.strip_prefix(['X', 'x']));
    let number: u32 = number.and_then(|n| n.parse().ok()).ok_or_else(none)?;
    if number >= storage.bits() {
        return Err(none().help(format!("its bits are 0 to {}", storage.bits() - 1)));
    }
    let place = Place::Bit(offset.saturating_add(number / 8), (number % 8) as u8);
    Ok(Variable { name: format!("{}.{number}", v.name), place, ty: VarType::Direct(E::Bool), ..v })
}

fn address(image: &Image, path: &str) -> Found {
    let text = path.to_ascii_uppercase();
    let wrong = || AccessError::path(format!("`{path}` is not a direct address")).help("write %IX0.1, %QB3, %QW3, %MD4 or %ML1");
    let a = parse_address(&text).ok_or_else(wrong)?;
    let area = match a.area {
        'I' => image.memory.inputs,
        'Q' => image.memory.outputs,
        _ => image.memory.markers,
    };
    if a.bit > 7 {
        return Err(wrong().help("the bits of a byte are 0 to 7"));
    }
    if a.byte.checked_add(a.ty.bytes()).is_none_or(|end| end > area.size) {
        let e = AccessError::path(format!("`{path}` lies outside of the process image"));
        return Err(e.help(format!("%{} has {} bytes in this program", a.area, area.size)));
    }
    let offset = area.start + a.byte;
    let place = if a.ty == E::Bool { Place::Bit(offset, a.bit as u8) } else { Place::Byte(offset) };
    Ok(Variable { name: text, place, ty: VarType::Direct(a.ty), constant: false, read_only: false })
}

/// The parts of a direct address.
struct Address {
    area: char,
    ty: E,
    byte: u32,
    bit: u32,
}

/// Takes a direct address in capitals apart; `None` if it is not one.
fn parse_address(text: &str) -> Option<Address> {
    let rest = text.strip_prefix('%')?;
    let area = rest.chars().next().filter(|c| matches!(c, 'I' | 'Q' | 'M'))?;
    let rest = &rest[1..];
    let number = |n: &str| n.parse::<u32>().ok().filter(|_| n.bytes().all(|b| b.is_ascii_digit()));
    let sizes = [("B", E::Byte), ("W", E::Word), ("D", E::Dword), ("L", E::Lword)];
    if let Some((n, ty)) = sizes.iter().find_map(|&(p, ty)| Some((rest.strip_prefix(p)?, ty))) {
        return Some(Address { area, ty, byte: number(n)?.saturating_mul(ty.bytes()), bit: 0 });
    }
    let (byte, bit) = rest.strip_prefix('X').unwrap_or(rest).split_once('.')?;
    Some(Address { area, ty: E::Bool, byte: number(byte)?, bit: number(bit)? })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::encode_tests::sample;

    fn show(path: &str) -> String {
        let image = sample();
        match resolve(&image, path) {
            Ok(v) => {
                let place = match v.place {
                    Place::Byte(o) => format!("{o}"),
                    Place::Bit(o, b) => format!("{o}.{b}"),
                };
                let ty = match v.ty {
                    VarType::Declared(id) => image.types.display(id),
                    VarType::Direct(e) => format!("direct {}", e.name()),
                };
                format!("{} at {place}: {ty}", v.name)
            }
            Err(e) => format!("{}: {} ({})", e.code.text(), e.message, e.help.unwrap_or_default()),
        }
    }

    #[test]
    fn names_members_elements_and_bits() {
        for (path, want) in [
            ("MAIN", "main at 88: Pump"),
            ("main.GO", "main.go at 88: BOOL"),
            ("cell.main.count", "main.count at 90: Percent"),
            ("main.count.%X9", "main.count.9 at 91.1: direct BOOL"),
            ("points[1, 1].X", "points[1,1].x at 242: INT"),
            ("points[-1,0].label", "points[-1,0].label at 154: STRING[7]"),
            ("Lamp", "lamp at 72.3: BOOL"),
            ("SHOWN", "shown at 72.3: BOOL"),
            ("main.GIVEN.%X1", "main.given.1 at 90.1: direct BOOL"),
            ("main.cuont", "C0007: `main` has no member `cuont` (did you mean `count`?)"),
            ("mian.go", "C0007: there is no variable or program instance `mian` (did you mean `main`?)"),
            ("zzz", "C0007: there is no variable or program instance `zzz` (there are main, points, lamp, shown, main.given)"),
            (
                "main.table",
                "C0007: `main.table` is a VAR_IN_OUT: it has a value during a call alone (name the variable that is passed)",
            ),
            ("main.edge", "C0007: `main` has no member `edge` (there are go, count, table, light)"),
            ("points[2, 0]", "C0007: this is not an element of `points` (its bounds are [-1..1, 0..1])"),
            ("points[1]", "C0007: this is not an element of `points` (its bounds are [-1..1, 0..1])"),
            ("main.count.16", "C0007: `main.count` is Percent and has no member `16` (its bits are 0 to 15)"),
            ("main.go.x", "C0007: `main.go` is BOOL and has no member `x` ()"),
            ("main.go[1]", "C0007: `main.go` is no array but BOOL ()"),
            ("lamp.x", "C0007: `lamp` is a single bit and has no parts ()"),
        ] {
            assert_eq!(show(path), want, "{path}");
        }
        for path in ["", ".", "main.", "a b", "points[", "points[1,0", "points[x]", "points[1,0]]", "ma;in", "points[1,0]x"] {
            assert!(show(path).contains("is not the path of a variable"), "{path}: {}", show(path));
        }
    }

    #[test]
    fn direct_addresses() {
        for (path, want) in [
            ("%IX0.1", "%IX0.1 at 64.1: direct BOOL"),
            ("%q1.7", "%Q1.7 at 73.7: direct BOOL"),
            ("%QW3", "%QW3 at 78: direct WORD"),
            ("%md1", "%MD1 at 84: direct DWORD"),
            ("%ML0", "%ML0 at 80: direct LWORD"),
            ("%IB7", "%IB7 at 71: direct BYTE"),
            ("%QW4", "C0007: `%QW4` lies outside of the process image (%Q has 8 bytes in this program)"),
            ("%IX0.8", "C0007: `%IX0.8` is not a direct address (the bits of a byte are 0 to 7)"),
        ] {
            assert_eq!(show(path), want, "{path}");
        }
        for path in ["%", "%I", "%IX", "%IX1", "%XX0.0", "%IW", "%IW-1", "%IW+1", "%IWé", "%é", "%IX0.1.2", "%IX99999999999.0"]
        {
            assert!(show(path).contains("is not a direct address"), "{path}: {}", show(path));
        }
        assert!(show("%QD4294967295").contains("outside"));
    }
}
