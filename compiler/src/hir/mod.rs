//! From trees to the typed program: names become ids, every expression gets a type, implicit conversions are written out.
//! Order: collect names, resolve declarations, place %I %Q %M, type bodies, configure tasks, check. See [`model`].
//! Never stops at an error: what is wrong is reported once and stands for itself from then on.

mod assign;
mod block;
mod body;
mod builder;
mod call;
mod chain;
mod check;
mod config;
mod constant;
mod convert;
mod declare;
mod expr;
mod globals;
mod hierarchy;
mod il;
mod image;
mod init;
mod label;
mod lattice;
pub mod model;
mod objects;
mod place;
mod pointer;
mod program;
mod reference;
mod scope;
mod space;
mod stmt;
mod symbols;
mod types;
mod unit;
mod vendor;

#[cfg(test)]
mod tests;

use crate::syntax::ast;
use builder::Builder;
pub use config::DEFAULT_INTERVAL;
use model::Hir;
use takt_base::{Sink, SourceId, Sources};

/// Builds the typed program of all files, library files first. The result can be lowered if nothing was reported as an error.
pub fn build(files: &[(SourceId, ast::File)], sources: &Sources, sink: &mut Sink) -> Hir {
    let mut builder = Builder::new(sources, sink);
    builder.collect(files);
    builder.declare_all();
    builder.check_objects();
    builder.place_image();
    builder.bodies();
    builder.configure();
    check::all(&mut builder);
    builder.hir
}
