//! Binding: finds the block of an import, checks each pin by name and type, and fixes the offsets.
//! Runs: before the start.

use super::BLOCKS;
use super::pins::{Block, Pin, Section};
use crate::machine::declarations::CNC_STATUS;
use takt_image::types::{Record, Section as ImageSection, Type};
use takt_image::{BindError, NativeImport, NativeKind, TypeTable};

/// A block with its offsets.
#[derive(Clone)]
pub struct Bound {
    /// The block.
    pub block: &'static Block,
    /// Offset of each pin in the instance.
    pub offsets: Vec<u32>,
    /// Bytes of the instance.
    pub size: u32,
    /// Offset of the number in AXIS_REF or CNC_REF.
    pub number_offset: u32,
    /// Offsets of the members of a CNC_STATUS.
    pub members: Vec<u32>,
}

/// Binds an import.
pub fn bind(import: &NativeImport, types: &TypeTable) -> Result<Bound, BindError> {
    let block = BLOCKS.iter().find(|b| b.name.eq_ignore_ascii_case(&import.name)).ok_or(BindError::Unknown)?;
    let NativeKind::Block { ty } = import.kind else { return Err(mismatch(block, "it is a function block, not a function")) };
    let Some(Type::Instance(record)) = types.try_get(ty) else { return Err(mismatch(block, "its type is not an instance")) };
    let mut bound = Bound { block, offsets: Vec::new(), size: record.size, number_offset: 0, members: Vec::new() };
    for pin in block.pins {
        bound.pin(pin, record, types).map_err(|why| mismatch(block, &why))?;
    }
    Ok(bound)
}

fn mismatch(block: &Block, why: &str) -> BindError {
    BindError::Mismatch(format!("{}: {why}", block.name))
}

impl Bound {
    fn pin(&mut self, pin: &Pin, record: &Record, types: &TypeTable) -> Result<(), String> {
        let name = pin.st_name();
        let field = record.field(&name).ok_or_else(|| format!("pin `{name}` is missing"))?;
        let got = types.display(field.ty);
        if !same_type(&got, pin.ty) {
            return Err(format!("pin `{name}` is {got}, not {}", pin.ty));
        }
        let reference = match types.try_get(field.ty) {
            Some(Type::Reference { target }) => types.try_get(*target),
            _ => None,
        };
        if (pin.section == Section::InOut) != (field.section == ImageSection::InOut && reference.is_some()) {
            return Err(format!("pin `{name}` stands in another section"));
        }
        if let Some(Type::Struct(target)) = reference {
            self.number_offset = number_offset(target, types)?;
        }
        if let Some(Type::Struct(status)) = types.try_get(field.ty) {
            self.members = members(status, types)?;
        }
        if field.offset.checked_add(types.layout(field.ty).size).is_none_or(|end| end > record.size) {
            return Err(format!("pin `{name}` lies outside of the instance"));
        }
        self.offsets.push(field.offset);
        Ok(())
    }
}

/// AXIS_REF and CNC_REF begin with their number.
fn number_offset(target: &Record, types: &TypeTable) -> Result<u32, String> {
    let number = target.field("AxisNo").or(target.field("ChannelNo"));
    let number = number.filter(|f| types.display(f.ty) == "UINT").ok_or_else(|| format!("{} has no number", target.name))?;
    Ok(number.offset)
}

fn members(status: &Record, types: &TypeTable) -> Result<Vec<u32>, String> {
    let of = |(name, ty): &(&str, &str)| {
        let field = status.field(name).filter(|f| same_type(&types.display(f.ty), ty));
        field.map(|f| f.offset).ok_or_else(|| format!("{} has no member `{name}` of type {ty}", status.name))
    };
    CNC_STATUS.iter().map(of).collect()
}

fn same_type(a: &str, b: &str) -> bool {
    let plain = |t: &str| t.chars().filter(|c| !c.is_whitespace()).collect::<String>().to_ascii_uppercase();
    plain(a) == plain(b)
}
