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
    NotMade(Name),
}

/// The named materials of a scene.
#[derive(Debug, Default)]
pub(super) struct Materials {
    /// Whether each one is that of surfaces that only bound a medium.
    made: HashMap<Name, bool>,
    /// Shapes whose material had not been made when they were read, by the names of the materials.
    waiting: HashMap<Name, HashSet<u32>>,
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
    /// `MakeNamedMaterial`: a later material takes the name from an earlier one.
    pub(super) fn make(&mut self, entity: &Entity) {
        let types = entity.parameters.iter().rfind(|parameter| parameter.name == "type");
        let only_bounds_media = types.is_some_and(|parameter| match &parameter.values {
            Values::Strings(types) => types.first().is_some_and(|name| bounds_media(&name.text)),
            _ => false,
        });
        self.made.insert(Name::new(&entity.name), only_bounds_media);
    }

    /// The material of a `NamedMaterial` directive.
    pub(super) fn named(&self, name: &Text) -> Material {
        match self.made.get(&*key(name)) {
            Some(true) => Material::MediumBoundary,
            Some(false) => Material::Surface,
            None => Material::NotMade(Name::new(name)),
        }
    }

    /// Notes that `Shape` statement `shape` has a material that is still to be made.
    pub(super) fn wait(&mut self, name: &Name, shape: u32) {
        self.waiting.entry(name.clone()).or_default().insert(shape);
    }

    /// At the end of the scene: the shapes that turn out to only bound a medium, by their numbers.
    pub(super) fn late_boundaries(&mut self) -> HashSet<u32> {
        let made = &self.made;
        self.waiting.retain(|name, _| made.get(name) == Some(&true));
        self.waiting.drain().flat_map(|(_, shapes)| shapes).collect()
    }
}
