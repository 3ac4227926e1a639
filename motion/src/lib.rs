//! Motion: part program -> interpreter -> canonical commands -> look-ahead -> interpolation -> position control -> drive.
//! Everything before the ring runs in the background, everything behind it is cyclic. See ARCHITECTURE.md.

pub mod canon;
pub mod draw;
pub mod ngc;
pub mod print;
pub mod stats;
pub mod svg;
pub mod toolpath;
