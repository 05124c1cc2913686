//! Materials, as far as geometry depends on them: some surfaces only bound a medium.

use super::name::{Name, key};
use super::parser::{Entity, Text, Values};
use std::collections::{HashMap, HashSet};

/// What the current material makes of the shapes under it.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) enum Material {
    /// Rays meet them.
    #[default]
    Surface,
    /// Rays pass through: they only tell where one medium ends and another begins.
    MediumBoundary,
    /// Not known yet: pbrt-v4 looks named materials up at the end of the file.
    NotMade {
        name: Name,
        /// Whether the material before it only bounds a medium: in pbrt-v3 a name that is never made changes nothing.
        otherwise_bounds: bool,
    },
}

/// The named materials of a scene.
#[derive(Debug, Default)]
pub(super) struct Materials {
    /// Whether each one is that of surfaces that only bound a medium.
    made: HashMap<Name, bool>,
    /// Shapes whose material had not been made when they were read, by the names of the materials.
    waiting: HashMap<Name, Vec<Waiting>>,
}

/// A shape that waits for its material.
#[derive(Debug)]
struct Waiting {
    /// The number of the `Shape` statement.
    shape: u32,
    otherwise_bounds: bool,
}

/// Whether a material of this type leaves no surface: `interface` of pbrt-v4, `none` and the empty name of v3.
fn bounds_media(type_name: &str) -> bool {
    matches!(type_name, "interface" | "none" | "")
}

/// The material of a `Material` directive.
pub(super) fn of_type(type_name: &Text) -> Material {
    if bounds_media(&type_name.text) { Material::MediumBoundary } else { Material::Surface }
}

impl Materials {
    /// `MakeNamedMaterial`: a later material takes the name from an earlier one. Tells whether it has a type; without
    /// one it is none in pbrt-v3, and an error in v4.
    pub(super) fn make(&mut self, entity: &Entity) -> bool {
        let type_name = entity.parameters.iter().rfind(|parameter| parameter.name == "type");
        let type_name = type_name.and_then(|parameter| match &parameter.values {
            Values::Strings(types) => types.first(),
            _ => None,
        });
        let only_bounds_media = type_name.is_none_or(|type_name| bounds_media(&type_name.text));
        self.made.insert(Name::new(&entity.name), only_bounds_media);
        type_name.is_some()
    }

    /// The material of a `NamedMaterial` directive after the material `before`.
    pub(super) fn named(&self, name: &Text, before: &Material) -> Material {
        match self.made.get(&*key(name)) {
            Some(true) => Material::MediumBoundary,
            Some(false) => Material::Surface,
            None => Material::NotMade {
                name: Name::new(name),
                otherwise_bounds: match before {
                    Material::Surface => false,
                    Material::MediumBoundary => true,
                    Material::NotMade { otherwise_bounds, .. } => *otherwise_bounds,
                },
            },
        }
    }

    /// Notes that `Shape` statement `shape` has a material that may still have to be made.
    pub(super) fn wait(&mut self, material: &Material, shape: u32) {
        if let Material::NotMade { name, otherwise_bounds } = material {
            let waiting = Waiting { shape, otherwise_bounds: *otherwise_bounds };
            self.waiting.entry(name.clone()).or_default().push(waiting);
        }
    }

    /// At the end of the scene: the shapes that turn out to only bound a medium, by their numbers.
    pub(super) fn late_boundaries(&mut self) -> HashSet<u32> {
        let mut boundaries = HashSet::new();
        for (name, shapes) in self.waiting.drain() {
            let made = self.made.get(&name);
            let bounds = |waiting: &Waiting| made.copied().unwrap_or(waiting.otherwise_bounds);
            boundaries.extend(shapes.iter().filter(|waiting| bounds(waiting)).map(|waiting| waiting.shape));
        }
        boundaries
    }
}
