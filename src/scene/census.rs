//! Counts the directives and shapes of a scene.

use super::listed::{AlphaTexture, Boundary, Listed, UnusedObject};
use super::parser::{Directive, KEYWORDS, Statement};
use super::place::Place;
use crate::error::grouped;
use std::collections::BTreeMap;

/// How often each directive and each type of shape occurs, in all files of a scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Census {
    /// By the index of the keyword.
    executed: [u64; KEYWORDS.len()],
    /// Directives that hits and depths do not depend on.
    skipped: [u64; KEYWORDS.len()],
    unknown: BTreeMap<String, u64>,
    shapes: BTreeMap<String, ShapeCount>,
    boundaries: Listed<Boundary>,
    unused_objects: Listed<UnusedObject>,
    hidden: Listed<Boundary>,
    textures: Listed<AlphaTexture>,
}

/// How often a type of shape occurs.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ShapeCount {
    /// `Shape` statements.
    pub statements: u64,
    /// The primitives stored for them; those of an object count once.
    pub primitives: u64,
    /// Whether they are left out of the picture because the type is not supported.
    pub is_left_out: bool,
}

/// The most names that are counted separately.
const MAX_NAMES: usize = 200;

/// Stands for all further names.
const OTHER_NAMES: &str = "(other names)";

impl Census {
    /// Counts one directive.
    pub(super) fn count(&mut self, directive: &Directive) {
        let Some(description) = directive.description else {
            if let Statement::Unknown(name) = directive.statement {
                *count_of(&mut self.unknown, name) += 1;
            }
            return;
        };
        let matters = match &directive.statement {
            Statement::Attribute(target) => target.name.text == "shape",
            _ => description.matters,
        };
        let counts = if matters {
            &mut self.executed
        } else {
            &mut self.skipped
        };
        counts[description.number] += 1;
    }

    /// Counts one `Shape` of type `name` and its stored primitives; `None` if it is left out.
    pub(super) fn count_shape(&mut self, name: &str, primitives: Option<usize>) {
        let count = count_of(&mut self.shapes, name);
        count.statements += 1;
        count.primitives += primitives.unwrap_or(0) as u64;
        count.is_left_out |= primitives.is_none();
    }

    /// Notes a shape that only bounds a medium.
    pub(super) fn add_boundary(&mut self, shape: &str, place: impl FnOnce() -> Place) {
        self.boundaries.add(|| Boundary {
            shape: shape.to_owned(),
            place: place().to_string(),
        });
    }

    /// Notes a shape that its alpha hides.
    pub(super) fn add_hidden(&mut self, shape: &str, place: impl FnOnce() -> Place) {
        self.hidden.add(|| Boundary {
            shape: shape.to_owned(),
            place: place().to_string(),
        });
    }

    /// Notes a texture that a shape is the first to use as its alpha.
    pub(super) fn add_texture(&mut self, name: &str, place: impl FnOnce() -> Place) {
        self.textures.add(|| AlphaTexture {
            name: name.to_owned(),
            place: place().to_string(),
        });
    }

    /// Notes the objects that no instance shows: the first ones, and the number of all.
    pub(super) fn set_unused(&mut self, (first, count): (Vec<UnusedObject>, u64)) {
        self.unused_objects = Listed { first, count };
    }

    /// Shapes that only bound a medium, in the order of the file.
    pub fn boundaries(&self) -> &Listed<Boundary> {
        &self.boundaries
    }

    /// Shapes that their alpha hides, in the order of the file.
    pub fn hidden(&self) -> &Listed<Boundary> {
        &self.hidden
    }

    /// Textures that shapes use as their alpha, in the order of their first use.
    pub fn textures(&self) -> &Listed<AlphaTexture> {
        &self.textures
    }

    /// Objects that no instance shows, sorted by name.
    pub fn unused_objects(&self) -> &Listed<UnusedObject> {
        &self.unused_objects
    }

    /// Directives that were executed, sorted by keyword.
    pub fn executed(&self) -> impl Iterator<Item = (&'static str, u64)> {
        KEYWORDS
            .into_iter()
            .zip(self.executed)
            .filter(|(_, count)| *count > 0)
    }

    /// Directives that were skipped because hits and depths do not depend on them, sorted by
    /// keyword.
    pub fn skipped(&self) -> impl Iterator<Item = (&'static str, u64)> {
        KEYWORDS
            .into_iter()
            .zip(self.skipped)
            .filter(|(_, count)| *count > 0)
    }

    /// Directives that no version of pbrt knows, sorted by keyword.
    pub fn unknown(&self) -> impl Iterator<Item = (&str, u64)> {
        self.unknown
            .iter()
            .map(|(name, count)| (name.as_str(), *count))
    }

    /// Types of shape, sorted by name.
    pub fn shapes(&self) -> impl Iterator<Item = (&str, ShapeCount)> {
        self.shapes
            .iter()
            .map(|(name, count)| (name.as_str(), *count))
    }

    /// The number of `Shape` statements that are left out because their type is not supported.
    pub fn left_out(&self) -> u64 {
        self.shapes
            .values()
            .filter(|count| count.is_left_out)
            .map(|count| count.statements)
            .sum()
    }

    /// One line on everything that was skipped or left out because rays do not meet it, if anything
    /// was.
    pub fn summary(&self) -> Option<String> {
        let counts: Vec<String> = self
            .skipped()
            .map(|(keyword, count)| format!("{} {keyword}", grouped(count)))
            .collect();
        let skipped = (!counts.is_empty()).then(|| {
            format!(
                "skipped, without influence on hit and depth: {}",
                counts.join(", ")
            )
        });
        let left_out = match self.boundaries.count {
            0 => None,
            1 => Some("left out, as in pbrt: 1 shape that only bounds a medium".to_owned()),
            count => Some(format!(
                "left out, as in pbrt: {} shapes that only bound a medium",
                grouped(count)
            )),
        };
        let hidden = match self.hidden.count {
            0 => None,
            1 => Some("hidden by its alpha, as in pbrt: 1 shape".to_owned()),
            count => Some(format!(
                "hidden by their alpha, as in pbrt: {} shapes",
                grouped(count)
            )),
        };
        let parts: Vec<String> = skipped.into_iter().chain(left_out).chain(hidden).collect();
        (!parts.is_empty()).then(|| parts.join("; "))
    }
}

impl Default for Census {
    fn default() -> Census {
        let none = [0; KEYWORDS.len()];
        Census {
            executed: none,
            skipped: none,
            unknown: BTreeMap::new(),
            shapes: BTreeMap::new(),
            boundaries: Listed::default(),
            unused_objects: Listed::default(),
            hidden: Listed::default(),
            textures: Listed::default(),
        }
    }
}

/// The count of `name`. A file may have any number of names, so the last ones share a count.
fn count_of<'a, T: Default>(counts: &'a mut BTreeMap<String, T>, name: &str) -> &'a mut T {
    let name = if counts.contains_key(name) || counts.len() < MAX_NAMES {
        name
    } else {
        OTHER_NAMES
    };
    if !counts.contains_key(name) {
        counts.insert(name.to_owned(), T::default());
    }
    counts.get_mut(name).expect("the name just seen")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_of_shape_are_counted_by_name() {
        let mut census = Census::default();
        census.count_shape("sphere", Some(1));
        census.count_shape("nurbs", None);
        census.count_shape("sphere", Some(1));
        let nurbs = ShapeCount {
            statements: 1,
            primitives: 0,
            is_left_out: true,
        };
        let sphere = ShapeCount {
            statements: 2,
            primitives: 2,
            is_left_out: false,
        };
        assert_eq!(
            census.shapes().collect::<Vec<_>>(),
            [("nurbs", nurbs), ("sphere", sphere)]
        );
        assert_eq!(census.left_out(), 1);
    }

    #[test]
    fn further_names_are_counted_together() {
        let mut census = Census::default();
        (0..1000).for_each(|name| census.count_shape(&name.to_string(), Some(1)));
        assert_eq!(census.shapes().count(), MAX_NAMES + 1);
        assert_eq!(
            census.shapes[OTHER_NAMES].statements,
            1000 - MAX_NAMES as u64
        );
        census.count_shape("7", Some(1));
        assert_eq!(census.shapes["7"].statements, 2);
    }
}
