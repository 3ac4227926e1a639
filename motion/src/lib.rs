//! Motion: part program -> interpreter -> canonical commands -> look-ahead -> interpolation -> position control -> drive.
//! Everything before the ring runs in the background, everything behind it is cyclic. See ARCHITECTURE.md.

pub mod canon;
pub mod execution;
pub mod geometry;
pub mod lookahead;
pub mod plan;
pub mod profile;
pub mod pulse;
pub mod run;
pub mod segment;
