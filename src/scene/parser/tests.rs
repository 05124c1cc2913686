//! The grammar as a whole: what it takes, what it says, what it survives.

mod brief_messages;
mod forms;
mod lexical;
mod messages;
mod properties;

use std::path::Path;

use super::{Directive, Directives, Parameter, Statement, Values};
use crate::error::Result;
use crate::scene::source_file::SourceFile;

/// A scene file, which lives as long as the test.
fn file(source: &[u8]) -> &'static SourceFile {
    Box::leak(Box::new(SourceFile::new(
        Path::new("a.pbrt"),
        source.to_vec(),
    )))
}

fn parse(source: &[u8]) -> Result<Vec<Directive<'static>>> {
    Directives::new(file(source)).collect()
}

fn statements(source: &str) -> Vec<Statement<'static>> {
    let directives = parse(source.as_bytes()).unwrap_or_else(|error| panic!("{error}"));
    directives
        .into_iter()
        .map(|directive| directive.statement)
        .collect()
}

/// The one statement of `source`.
fn statement(source: &str) -> Statement<'static> {
    let mut statements = statements(source);
    assert_eq!(statements.len(), 1, "{statements:?}");
    statements.remove(0)
}

/// The parameters of the one shape of `source`.
fn parameters(source: &str) -> Vec<Parameter<'static>> {
    match statement(source) {
        Statement::Shape(entity) => entity.parameters,
        other => panic!("no shape: {other:?}"),
    }
}

/// The values of a shape's parameter that is written as `parameter`.
fn values(parameter: &str) -> Values<'static> {
    parameters(&format!("Shape \"s\" {parameter}"))
        .remove(0)
        .values
}

fn message(source: impl AsRef<[u8]>) -> String {
    let mut directives = Directives::new(file(source.as_ref()));
    let error = directives.by_ref().find_map(Result::err).expect("an error");
    assert!(directives.next().is_none(), "an error is the end");
    error.to_string()
}
