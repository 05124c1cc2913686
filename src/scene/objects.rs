//! Object definitions: geometry that is stored once, however often it is instanced.

use super::builder::Builder;
use super::graphics_state::Block;
use super::parser::{Span, Text};
use super::source::{Place, Source};
use super::spelling;
use super::transform_cache::TransformCache;
use crate::error::{Diagnostic, Result};
use crate::shape::Shapes;
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;

/// The objects of a scene, by name.
#[derive(Default)]
pub(super) struct Objects {
    /// The one that is being defined.
    pub(super) open: Option<Definition>,
    defined: HashMap<String, Object>,
    /// Different transforms of the shapes of each object, added up.
    pub(super) transform_count: usize,
}

/// What stands between `ObjectBegin` and `ObjectEnd`.
pub(super) struct Definition {
    name: String,
    pub(super) shapes: Shapes,
    pub(super) transforms: TransformCache,
}

/// A finished object.
enum Object {
    /// Nothing shows it so far, and perhaps nothing ever will.
    Unused(Box<Shapes>),
    /// The scene has it by this number.
    Used(usize),
}

impl Builder<'_> {
    pub(super) fn begin_object(&mut self, name: &Text, keyword: &Span, source: &Rc<Source>) -> Result<()> {
        self.check_in_world("ObjectBegin", keyword, source)?;
        if self.objects.open.is_some() {
            let error = source.error(keyword, "an object within an object");
            return Err(error.note("expected ObjectEnd before the next ObjectBegin"));
        }
        self.state.begin(Block::Object, Place::new(source, keyword));
        let name = name.text.to_string();
        self.objects.open = Some(Definition { name, shapes: Shapes::default(), transforms: TransformCache::default() });
        Ok(())
    }

    pub(super) fn end_object(&mut self, keyword: &Span, source: &Rc<Source>) -> Result<()> {
        self.end(Block::Object, keyword, source)?;
        let Some(Definition { name, shapes, transforms }) = self.objects.open.take() else { return Ok(()) };
        self.objects.transform_count += transforms.len();
        if self.objects.defined.insert(name.clone(), Object::Unused(Box::new(shapes))).is_some() {
            let message = format!("a second object called `{name}`: instances that follow show this one");
            self.warnings.add("object defined twice", || Diagnostic::new(message).at(source.at(keyword)));
        }
        Ok(())
    }

    pub(super) fn instance(&mut self, name: &Text, keyword: &Span, source: &Rc<Source>) -> Result<()> {
        self.check_in_world("ObjectInstance", keyword, source)?;
        if self.objects.open.is_some() {
            let error = source.error(keyword, "an instance within an object");
            return Err(error.note("expected ObjectInstance after ObjectEnd: objects do not nest"));
        }
        let Some(object) = self.objects.defined.get_mut(&*name.text) else {
            let error = source.error(&name.span, format!("there is no object called `{}`", name.text));
            let known = self.objects.defined.keys().map(String::as_str);
            return Err(match spelling::closest(&name.text, known) {
                Some(known) => error.note(format!("did you mean `{known}`?")),
                None => error.note("expected the name of an ObjectBegin before it"),
            });
        };
        let number = match object {
            Object::Used(number) => *number,
            Object::Unused(shapes) => self.shapes.add_object(std::mem::take(&mut **shapes)),
        };
        *object = Object::Used(number);
        self.warn_if_moving(keyword, source);
        let world_from_instance = self.state.current.matrix;
        if !world_from_instance.is_finite() {
            let message = "an instance under a transform that is not finite is never hit";
            self.warnings.add("infinite instance", || Diagnostic::new(message).at(source.at(keyword)));
        }
        let added = self.shapes.add_instance(number, world_from_instance);
        added.map_err(|error| source.error(keyword, error.to_string()).note("split the scene"))?;
        self.places.iter_mut().for_each(|places| places.add_instance(keyword, &source.text));
        if let (Some(roundings), Some(rounded)) = (&mut self.roundings, &self.state.rounded) {
            roundings.instances.push(Arc::clone(rounded));
        }
        Ok(())
    }
}
