//! The report's names of the enumerators, both ways.

use crate::canon::{Direction, FeedReference, Plane, Units};

/// An enumeration and its names in the report.
macro_rules! names {
    ($name_of:ident, $of_name:ident, $ty:ty, $($value:path => $text:literal),*) => {
        pub(super) fn $name_of(value: $ty) -> &'static str {
            match value { $($value => $text,)* }
        }
        pub(super) fn $of_name(text: &str) -> Option<$ty> {
            match text { $($text => Some($value),)* _ => None }
        }
    };
}
names!(plane_name, plane_of, Plane, Plane::Xy => "CANON_PLANE_XY", Plane::Yz => "CANON_PLANE_YZ", Plane::Xz => "CANON_PLANE_XZ");
names!(units_name, units_of, Units, Units::Inches => "CANON_UNITS_INCHES", Units::Mm => "CANON_UNITS_MM", Units::Cm => "CANON_UNITS_CM");
names!(reference_name, reference_of, FeedReference, FeedReference::Workpiece => "CANON_WORKPIECE", FeedReference::Xyz => "CANON_XYZ");
names!(direction_name, direction_of, Direction, Direction::Clockwise => "CANON_DIRECTION_CLOCKWISE",
    Direction::Counterclockwise => "CANON_DIRECTION_COUNTERCLOCKWISE");
