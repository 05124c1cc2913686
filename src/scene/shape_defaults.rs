//! `Attribute "shape"`: parameters of the shapes that follow.

use super::parser::Parameter;
use super::source::Source;
use std::rc::Rc;

/// One parameter, and the file that it stands in.
pub(super) struct ShapeDefault {
    pub(super) parameter: Parameter<'static>,
    pub(super) source: Rc<Source>,
}

/// Those in force, in their order: the last one of a name counts. Blocks only ever append.
#[derive(Default)]
pub(super) struct ShapeDefaults(Vec<ShapeDefault>);

/// In force at a time, at most: every shape looks through them.
pub(super) const MAX_DEFAULTS: usize = 1000;

impl ShapeDefaults {
    /// Adds copies of `parameters`, which stand in `source`; whether there was room.
    pub(super) fn add(&mut self, parameters: &[Parameter], source: &Rc<Source>) -> bool {
        if parameters.len() > MAX_DEFAULTS - self.0.len() {
            return false;
        }
        let copy = |parameter: &Parameter| ShapeDefault {
            parameter: parameter.to_owned(),
            source: Rc::clone(source),
        };
        self.0.extend(parameters.iter().map(copy));
        true
    }

    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    /// Takes back all but the first `count`.
    pub(super) fn truncate(&mut self, count: usize) {
        self.0.truncate(count);
    }

    /// All of them.
    pub(super) fn as_slice(&self) -> &[ShapeDefault] {
        &self.0
    }
}
