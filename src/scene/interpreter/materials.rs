//! Materials, as far as geometry depends on them: some surfaces only bound a medium.

use crate::scene::name::{Name, key};
use crate::scene::parser::{Entity, Text, Values};
use crate::scene::source_span::SourceSpan;
use crate::scene::warnings::Warnings;
use std::collections::{HashMap, HashSet};

/// Whether rays hit the shapes of a material.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) enum Kind {
    /// Rays hit them.
    #[default]
    Surface,
    /// `interface` of pbrt-v4: rays pass through, even if the shapes emit light.
    Interface,
    /// `none` and the empty name of pbrt-v3: rays pass through, but hit area lights.
    Absent,
}

impl Kind {
    fn of_type(type_name: &str) -> Kind {
        match type_name {
            "interface" => Kind::Interface,
            "none" | "" => Kind::Absent,
            _ => Kind::Surface,
        }
    }

    /// Whether a shape, which may be an area light, only separates two media.
    fn only_bounds_media(self, is_light: bool) -> bool {
        match self {
            Kind::Surface => false,
            Kind::Interface => true,
            Kind::Absent => !is_light,
        }
    }
}

/// The current material.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Material {
    Known(Kind),
    /// Named and not made yet: pbrt-v4 looks up named materials at the end of the file. In v3 a
    /// name that is never made changes nothing.
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

    /// Whether a shape of it, which may be an area light, is known to only bound a medium.
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
    /// Shapes that were read before their materials were made, by the names of the materials.
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
    /// `MakeNamedMaterial`: a later material takes the name from an earlier one. One without a type
    /// is `none` in pbrt-v3, and an error in v4.
    pub(super) fn make(&mut self, entity: &Entity, at: &SourceSpan, warnings: &mut Warnings) {
        let parameter = entity
            .parameters
            .iter()
            .rfind(|parameter| parameter.name == "type");
        let type_name = match parameter.map(|parameter| &parameter.values) {
            Some(Values::Strings(types)) => types.first(),
            _ => None,
        };
        let kind = type_name.map_or(Kind::Absent, |type_name| Kind::of_type(&type_name.text));
        self.made.insert(Name::new(&entity.name), kind);
        if type_name.is_none() {
            warnings.add("material without type", || {
                let message = "a named material without `\"string type\"`: \
                               shapes under it only bound a medium";
                let diagnostic = at.beside(&entity.name.span).diagnostic(message);
                diagnostic.note("pbrt-v3 reads it so; pbrt-v4 refuses it")
            });
        }
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

    /// Notes the material of `Shape` statement `shape`, which may be made later.
    pub(super) fn wait(&mut self, material: &Material, shape: u32, is_light: bool) {
        if let Material::NotMade { name, before } = material {
            self.waiting.entry(name.clone()).or_default().push(Waiting {
                shape,
                before: *before,
                is_light,
            });
        }
    }

    /// The numbers of the shapes that turn out, at the end of the scene, to only bound a medium.
    pub(super) fn late_boundaries(&mut self) -> HashSet<u32> {
        let mut boundaries = HashSet::new();
        for (name, shapes) in self.waiting.drain() {
            let made = self.made.get(&name);
            boundaries.extend(shapes.iter().filter_map(|waiting| {
                let kind = made.unwrap_or(&waiting.before);
                kind.only_bounds_media(waiting.is_light)
                    .then_some(waiting.shape)
            }));
        }
        boundaries
    }
}
