//! The parameters that `Attribute "shape"` sets for the shapes that follow.

use crate::scene::parser::Parameter;
use crate::scene::source_file::SourceFile;
use std::sync::Arc;

/// A parameter, and the file that it stands in.
pub(crate) struct ShapeDefault {
    pub(super) parameter: Parameter<'static>,
    pub(super) file: Arc<SourceFile>,
}

/// The defaults in force, in their order: the last one of a name counts. Blocks only ever append.
#[derive(Default)]
pub(crate) struct ShapeDefaults(Vec<ShapeDefault>);

/// The most defaults in force at a time: every shape searches them.
pub(crate) const MAX_DEFAULTS: usize = 1000;

impl ShapeDefaults {
    /// Adds copies of `parameters`, which stand in `file`; returns whether there was room.
    pub(crate) fn add(&mut self, parameters: &[Parameter], file: &Arc<SourceFile>) -> bool {
        if parameters.len() > MAX_DEFAULTS - self.0.len() {
            return false;
        }
        self.0
            .extend(parameters.iter().map(|parameter| ShapeDefault {
                parameter: parameter.to_owned(),
                file: Arc::clone(file),
            }));
        true
    }

    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// Drops all but the first `count`.
    pub(crate) fn truncate(&mut self, count: usize) {
        self.0.truncate(count);
    }

    pub(super) fn as_slice(&self) -> &[ShapeDefault] {
        &self.0
    }
}
