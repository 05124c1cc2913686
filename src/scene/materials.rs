//! Materials, as far as geometry depends on them: some surfaces only bound a medium.

use super::name::{Name, key};
use super::parser::{Entity, Text, Values};
use std::collections::{HashMap, HashSet};

/// What a material makes of the shapes under it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) enum Kind {
    /// Rays meet them.
    #[default]
    Primitive,
    /// `interface` of pbrt-v4: rays pass through, whether they emit light or not.
    Interface,
    /// `none` and the empty name of pbrt-v3: rays pass through, but an area light is seen.
    Absent,
}

impl Kind {
    fn of_type(type_name: &str) -> Kind {
        match type_name {
            "interface" => Kind::Interface,
            "none" | "" => Kind::Absent,
            _ => Kind::Primitive,
        }
    }

    /// Whether a shape, which may be an area light, only tells where one medium ends and another begins.
    fn only_bounds_media(self, is_light: bool) -> bool {
        match self {
            Kind::Primitive => false,
            Kind::Interface => true,
            Kind::Absent => !is_light,
        }
    }
}

/// The current material.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Material {
    Known(Kind),
    /// Named and not made yet: pbrt-v4 looks named materials up at the end of the file. In v3 a name that is never made
    /// changes nothing.
    NotMade {
        name: Name,
        before: Kind,
    },
}

impl Default for Material {
    fn default() -> Material {
        Material::Known(Kind::default())
    }
}

impl Material {
    /// The material of a `Material` directive.
    pub(super) fn of_type(type_name: &Text) -> Material {
        Material::Known(Kind::of_type(&type_name.text))
    }

    /// Whether a shape under it, which may be an area light, is known to only bound a medium.
    pub(super) fn only_bounds_media(&self, is_light: bool) -> bool {
        match self {
            Material::Known(kind) => kind.only_bounds_media(is_light),
            Material::NotMade { .. } => false,
        }
    }
}

/// The named materials of a scene.
#[derive(Debug, Default)]
pub(super) struct Materials {
    made: HashMap<Name, Kind>,
    /// Shapes whose material had not been made when they were read, by the names of the materials.
    waiting: HashMap<Name, Vec<Waiting>>,
}

/// A shape that waits for its material.
#[derive(Debug)]
struct Waiting {
    /// The number of the `Shape` statement.
    shape: u32,
    before: Kind,
    is_light: bool,
}

impl Materials {
    /// `MakeNamedMaterial`: a later material takes the name from an earlier one. Tells whether it has a type; without
    /// one it is none in pbrt-v3, and an error in v4.
    pub(super) fn make(&mut self, entity: &Entity) -> bool {
        let type_name = entity
            .parameters
            .iter()
            .rfind(|parameter| parameter.name == "type");
        let type_name = type_name.and_then(|parameter| match &parameter.values {
            Values::Strings(types) => types.first(),
            _ => None,
        });
        let kind = type_name.map_or(Kind::Absent, |type_name| Kind::of_type(&type_name.text));
        self.made.insert(Name::new(&entity.name), kind);
        type_name.is_some()
    }

    /// The material of a `NamedMaterial` directive after the material `before`.
    pub(super) fn named(&self, name: &Text, before: &Material) -> Material {
        match (self.made.get(&*key(name)), before) {
            (Some(kind), _) => Material::Known(*kind),
            (None, Material::Known(before) | Material::NotMade { before, .. }) => {
                Material::NotMade {
                    name: Name::new(name),
                    before: *before,
                }
            }
        }
    }

    /// Notes that `Shape` statement `shape` has a material that may still have to be made.
    pub(super) fn wait(&mut self, material: &Material, shape: u32, is_light: bool) {
        if let Material::NotMade { name, before } = material {
            self.waiting.entry(name.clone()).or_default().push(Waiting {
                shape,
                before: *before,
                is_light,
            });
        }
    }

    /// At the end of the scene: the shapes that turn out to only bound a medium, by their numbers.
    pub(super) fn late_boundaries(&mut self) -> HashSet<u32> {
        let mut boundaries = HashSet::new();
        for (name, shapes) in self.waiting.drain() {
            let made = self.made.get(&name).copied();
            let bounds = |waiting: &Waiting| {
                made.unwrap_or(waiting.before)
                    .only_bounds_media(waiting.is_light)
            };
            boundaries.extend(
                shapes
                    .iter()
                    .filter(|waiting| bounds(waiting))
                    .map(|waiting| waiting.shape),
            );
        }
        boundaries
    }
}
