//! Object definitions: geometry that is stored once, however often it is instanced.

use super::blocks::Block;
use super::builder::Builder;
use super::name::{Name, key};
use super::parser::{Span, Text};
use super::source::{Place, Source};
use super::spelling;
use super::transform_cache::TransformCache;
use crate::error::{Diagnostic, Result};
use crate::shape::Geometry;
use std::borrow::Borrow;
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;

/// The objects of a scene, by name.
#[derive(Default)]
pub(super) struct Objects {
    /// The one that is being defined.
    pub(super) open: Option<Definition>,
    defined: HashMap<Name, Object>,
    /// Instances of objects that are not defined yet.
    awaited: Vec<Awaited>,
    /// Different transforms of the shapes of each object, added up.
    pub(super) transform_count: usize,
}

/// What stands between `ObjectBegin` and `ObjectEnd`.
pub(super) struct Definition {
    name: Name,
    place: Place,
    pub(super) geometry: Geometry,
    pub(super) transforms: TransformCache,
}

/// A finished object.
enum Object {
    /// Nothing shows it so far, and perhaps nothing ever will. Where its name stands.
    Unused(Box<Geometry>, Place),
    /// The scene has it by this number.
    Used(usize),
}

/// An `ObjectInstance` that stands before its object.
struct Awaited {
    name: Name,
    place: Place,
    /// Its number among the instances of the scene.
    instance: usize,
}

/// The name of an object that no instance shows, and where it was given.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnusedObject {
    /// As the file spells it.
    pub name: String,
    /// File, line and column.
    pub place: String,
}

impl Builder<'_> {
    pub(super) fn begin_object(
        &mut self,
        name: &Text,
        keyword: &Span,
        source: &Rc<Source>,
    ) -> Result<()> {
        self.check_in_world("ObjectBegin", keyword, source)?;
        if self.objects.open.is_some() {
            self.warnings.add("object in object", || {
                let message = "ObjectBegin within an object: the outer object ends here";
                let diagnostic = Diagnostic::new(message).at(source.at(keyword));
                diagnostic
                    .note("expected ObjectEnd before it; pbrt-v3 reads it so; pbrt-v4 refuses it")
            });
            self.define_object();
        }
        self.state.begin(Block::Object, Place::new(source, keyword));
        let (name, place) = (Name::new(name), Place::new(source, &name.span));
        let (geometry, transforms) = (Geometry::default(), TransformCache::default());
        self.objects.open = Some(Definition {
            name,
            place,
            geometry,
            transforms,
        });
        Ok(())
    }

    pub(super) fn end_object(&mut self, keyword: &Span, source: &Rc<Source>) {
        self.end(Block::Object, keyword, source);
        self.define_object();
    }

    /// Whatever is being defined is an object from now on.
    pub(super) fn define_object(&mut self) {
        let Some(Definition {
            name,
            place,
            geometry,
            transforms,
        }) = self.objects.open.take()
        else {
            return;
        };
        self.objects.transform_count += transforms.len();
        if self.objects.defined.contains_key(&name) {
            let message =
                format!("a second object called `{name}`: instances that follow show this one");
            self.warnings.add("object defined twice", || {
                Diagnostic::new(message).at(place.location())
            });
        }
        self.objects
            .defined
            .insert(name, Object::Unused(Box::new(geometry), place));
    }

    pub(super) fn instance(
        &mut self,
        name: &Text,
        keyword: &Span,
        source: &Rc<Source>,
    ) -> Result<()> {
        self.check_in_world("ObjectInstance", keyword, source)?;
        if self.objects.open.is_some() {
            let error = source.error(keyword, "an instance within an object");
            return Err(error.note("expected ObjectInstance after ObjectEnd: objects do not nest"));
        }
        self.check_usable("ObjectInstance", keyword, source)?;
        self.warn_if_moving(keyword, source);
        let world_from_instance = self.state.current.matrix;
        if !world_from_instance.is_finite() {
            let message = "an instance under a transform that is not finite is never hit";
            self.warnings.add("infinite instance", || {
                Diagnostic::new(message).at(source.at(keyword))
            });
        }
        let added = match self.number_of_object(&key(name)) {
            Some(object) => self.geometry.add_instance(object, world_from_instance),
            None => self
                .geometry
                .add_undefined_instance(world_from_instance)
                .map(|instance| {
                    let (name, place) = (Name::new(name), Place::new(source, &name.span));
                    self.objects.awaited.push(Awaited {
                        name,
                        place,
                        instance,
                    });
                }),
        };
        added.map_err(|error| {
            source
                .error(keyword, error.to_string())
                .note("split the scene")
        })?;
        self.places
            .iter_mut()
            .for_each(|places| places.add_instance(keyword, &source.text));
        if let (Some(roundings), Some(rounded)) = (&mut self.roundings, &self.state.rounded) {
            roundings.instances.push(Arc::clone(rounded));
        }
        Ok(())
    }

    /// The number of the object of that [`key`] among those that the scene shows, now that it does.
    fn number_of_object(&mut self, name: &[u8]) -> Option<usize> {
        let object = self.objects.defined.get_mut(name)?;
        let number = match object {
            Object::Used(number) => *number,
            Object::Unused(geometry, _) => {
                self.geometry.add_object(std::mem::take(&mut **geometry))
            }
        };
        *object = Object::Used(number);
        Some(number)
    }

    /// Looks up the objects of instances that stood before them, as pbrt-v4 does at the end of the file.
    ///
    /// # Errors
    /// An instance of an object that is nowhere.
    pub(super) fn define_awaited(&mut self) -> Result<()> {
        let awaited = std::mem::take(&mut self.objects.awaited);
        let mut defined = Vec::with_capacity(awaited.len());
        for Awaited {
            name,
            place,
            instance,
        } in awaited
        {
            let Some(object) = self.number_of_object(name.borrow()) else {
                let error = place.error(format!("there is no object called `{name}`"));
                let (name, known) = (
                    name.to_string(),
                    self.objects.defined.keys().map(Name::to_string),
                );
                let known: Vec<String> = known.collect();
                return Err(
                    match spelling::closest(&name, known.iter().map(String::as_str)) {
                        Some(known) => error.note(format!("did you mean `{known}`?")),
                        None => error.note("expected the name of an ObjectBegin"),
                    },
                );
            };
            defined.push((instance, object));
        }
        if !defined.is_empty() {
            self.geometry.define_instances(&defined);
        }
        Ok(())
    }
}

impl Objects {
    /// The objects that no instance shows, sorted by name: the first `most` of them, and the number of all.
    pub(super) fn unused(&self, most: usize) -> (Vec<UnusedObject>, u64) {
        let unused = self
            .defined
            .iter()
            .filter_map(|(name, object)| match object {
                Object::Unused(_, place) => Some((name, place)),
                Object::Used(_) => None,
            });
        let mut unused: Vec<_> = unused.collect();
        unused.sort_by_key(|(name, _)| *name);
        let shown = unused.iter().take(most);
        let shown = shown.map(|(name, place)| UnusedObject {
            name: name.to_string(),
            place: place.location().to_string(),
        });
        (shown.collect(), unused.len() as u64)
    }
}
