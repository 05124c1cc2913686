//! The geometry of the scene and of its object definitions, each stored once.

use crate::error::Result;
use crate::geometry::Matrix;
use crate::scene::listed::UnusedObject;
use crate::scene::name::{Name, key};
use crate::scene::parser::Text;
use crate::scene::place::Place;
use crate::scene::shapes::TransformCache;
use crate::scene::source_span::SourceSpan;
use crate::scene::spelling;
use crate::scene::warnings::Warnings;
use crate::shape::Geometry;
use std::borrow::Borrow;
use std::collections::{HashMap, HashSet};

/// The scene's own geometry and the objects that its instances show.
#[derive(Default)]
pub(super) struct Objects {
    scene: Store,
    /// The object that is being defined.
    open: Option<Definition>,
    defined: HashMap<Name, Object>,
    /// Instances of objects that are not defined yet, by the names of the objects.
    awaited: HashMap<Name, Awaited>,
    /// The number of different transforms in each object, summed up.
    transform_count: usize,
}

/// Geometry that shapes are added to.
#[derive(Default)]
pub(super) struct Store {
    pub(super) geometry: Geometry,
    pub(super) transforms: TransformCache,
}

/// An object between `ObjectBegin` and `ObjectEnd`.
struct Definition {
    name: Name,
    at: SourceSpan,
    store: Store,
}

/// A finished object.
enum Object {
    /// No instance shows it yet. The place is that of its name.
    Unused(Box<Geometry>, Place),
    /// The number of the object in the scene.
    Used(usize),
}

/// Each `ObjectInstance` of one object before its definition.
struct Awaited {
    /// The name in the first of them.
    first: SourceSpan,
    /// Their numbers among the instances of the scene.
    instances: Vec<usize>,
}

impl Objects {
    /// Lets go of the piece of the text that has been read.
    pub(super) fn settle(&mut self) {
        if let Some(definition) = &mut self.open {
            definition.at = definition.at.kept();
        }
    }

    /// The geometry that the next shape belongs to.
    pub(super) fn store(&mut self) -> &mut Store {
        match &mut self.open {
            Some(definition) => &mut definition.store,
            None => &mut self.scene,
        }
    }

    /// Whether an object is being defined.
    pub(super) fn is_open(&self) -> bool {
        self.open.is_some()
    }

    /// Starts an object.
    pub(super) fn begin(&mut self, name: &Text, keyword: &SourceSpan, warnings: &mut Warnings) {
        if self.is_open() {
            warnings.add("object in object", || {
                let message = "ObjectBegin within an object: the outer object ends here";
                let note = "expected ObjectEnd before it; pbrt-v3 reads it so; pbrt-v4 refuses it";
                keyword.diagnostic(message).note(note)
            });
            self.end(warnings);
        }
        let (name, at) = (Name::new(name), keyword.beside(&name.span));
        self.open = Some(Definition {
            name,
            at,
            store: Store::default(),
        });
    }

    /// Ends the object that is being defined, if there is one.
    pub(super) fn end(&mut self, warnings: &mut Warnings) {
        let Some(Definition { name, at, store }) = self.open.take() else {
            return;
        };
        self.transform_count += store.transforms.len();
        if self.defined.contains_key(&name) {
            let message =
                format!("a second object called `{name}`: instances that follow show this one");
            warnings.add("object defined twice", || at.diagnostic(message));
        }
        self.defined
            .insert(name, Object::Unused(Box::new(store.geometry), at.place()));
    }

    /// Adds an instance of the object `name`, which may be defined later.
    pub(super) fn add_instance(
        &mut self,
        name: &Text,
        keyword: &SourceSpan,
        world_from_instance: Matrix,
        warnings: &mut Warnings,
    ) -> Result<()> {
        if !world_from_instance.is_finite() {
            let message = "an instance under a transform that is not finite is never hit";
            warnings.add("infinite instance", || keyword.diagnostic(message));
        }
        let geometry = &mut self.scene.geometry;
        let added = match number_of(&mut self.defined, geometry, &key(name)) {
            Some(object) => geometry.add_instance(object, world_from_instance),
            None => geometry
                .add_undefined_instance(world_from_instance)
                .map(|instance| {
                    let awaited = self.awaited.entry(Name::new(name));
                    let awaited = awaited.or_insert_with(|| Awaited {
                        first: keyword.beside(&name.span).kept(),
                        instances: Vec::new(),
                    });
                    awaited.instances.push(instance);
                }),
        };
        added.map_err(|error| keyword.error(error.to_string()).note("split the scene"))
    }

    /// Looks up the objects of instances that came before them, as pbrt-v4 does at the end of the
    /// file.
    ///
    /// # Errors
    /// An instance of an object that does not exist.
    pub(super) fn define_awaited(&mut self) -> Result<()> {
        let mut defined = Vec::new();
        let mut awaited: Vec<_> = self.awaited.drain().collect();
        awaited.sort_by_key(|(_, awaited)| awaited.instances[0]);
        for (name, Awaited { first, instances }) in awaited {
            let object = number_of(&mut self.defined, &mut self.scene.geometry, name.borrow());
            let Some(object) = object else {
                let error = first.error(format!("there is no object called `{name}`"));
                let known: Vec<String> = self.defined.keys().map(Name::to_string).collect();
                let known = known.iter().map(String::as_str);
                return Err(match spelling::closest(&name.to_string(), known) {
                    Some(known) => error.note(format!("did you mean `{known}`?")),
                    None => error.note("expected the name of an ObjectBegin"),
                });
            };
            defined.extend(instances.into_iter().map(|instance| (instance, object)));
        }
        if !defined.is_empty() {
            self.scene.geometry.define_instances(&defined);
        }
        Ok(())
    }

    /// Removes the primitives of these shapes from the picture.
    pub(super) fn hide(&mut self, shapes: &HashSet<u32>) {
        self.scene.geometry.hide(shapes);
    }

    /// The objects that no instance shows, sorted by name: the first `most` of them, and the number
    /// of all.
    pub(super) fn unused(&self, most: usize) -> (Vec<UnusedObject>, u64) {
        let unused = self
            .defined
            .iter()
            .filter_map(|(name, object)| match object {
                Object::Unused(_, at) => Some((name, at)),
                Object::Used(_) => None,
            });
        let mut unused: Vec<_> = unused.collect();
        unused.sort_by_key(|(name, _)| *name);
        let listed = unused.iter().take(most).map(|(name, at)| UnusedObject {
            name: name.to_string(),
            place: at.to_string(),
        });
        (listed.collect(), unused.len() as u64)
    }

    /// The geometry of the whole scene, and the number of transforms in it and its objects.
    pub(super) fn finish(self) -> (Geometry, usize) {
        let count = self.scene.transforms.len() + self.transform_count;
        (self.scene.geometry, count)
    }
}

/// The number of the object with this [`key`] in the scene, which shows it from now on.
fn number_of(
    defined: &mut HashMap<Name, Object>,
    scene: &mut Geometry,
    name: &[u8],
) -> Option<usize> {
    let object = defined.get_mut(name)?;
    let number = match object {
        Object::Used(number) => *number,
        Object::Unused(geometry, _) => scene.add_object(std::mem::take(&mut **geometry)),
    };
    *object = Object::Used(number);
    Some(number)
}
