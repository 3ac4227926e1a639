//! JSON forms of values: the contract of `takt sim --format json`.
