//! From trees to the typed program: names become ids, every expression gets a type, implicit conversions are written out.
//! Order: collect names, resolve declarations, place %I %Q %M, type bodies, configure tasks, check. See [`model`].
//! Never stops at an error: what is wrong is reported once and stands for itself from then on.

mod access;
mod assert;
mod assign;
mod block;
mod body;
mod builder;
mod call;
mod chain;
mod check;
mod config;
mod configured;
mod connect;
mod constant;
mod convert;
mod declare;
mod expr;
mod globals;
mod hierarchy;
mod il;
mod image;
mod init;
mod instance;
mod label;
mod late;
mod lattice;
pub mod model;
mod objects;
mod part;
mod place;
mod pointer;
mod program;
mod query;
mod reference;
mod resource;
mod scope;
mod space;
mod startup;
mod stmt;
mod symbols;
mod test_tasks;
mod text_case;
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
pub use test_tasks::Test;

/// Builds the typed program of all files, library files first. The result can be lowered if nothing was reported as an error.
pub fn build(files: &[(SourceId, ast::File)], sources: &Sources, sink: &mut Sink) -> Hir {
    passes(Builder::new(sources, sink), files).hir
}

/// The same, but every `{test}` program gets a task of its own, and nothing else runs. Tests and tasks are in the same order.
pub fn build_tests(files: &[(SourceId, ast::File)], sources: &Sources, sink: &mut Sink) -> (Hir, Vec<Test>) {
    let mut builder = Builder::new(sources, sink);
    builder.tests = true;
    let builder = passes(builder, files);
    let tests = builder.test_list();
    (builder.hir, tests)
}

fn passes<'a>(mut builder: Builder<'a>, files: &'a [(SourceId, ast::File)]) -> Builder<'a> {
    builder.collect(files);
    builder.declare_all();
    builder.check_objects();
    builder.plan_programs();
    builder.var_config();
    builder.place_image();
    builder.bodies();
    builder.configure();
    if builder.tests {
        builder.test_tasks();
    }
    builder.start_up();
    check::all(&mut builder);
    builder
}
