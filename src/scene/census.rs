//! What a scene file says, counted.

use super::objects::UnusedObject;
use super::parser::{Directive, KEYWORDS, Statement};
use crate::error::SourceLocation;
use std::collections::BTreeMap;

/// How often each directive and each type of shape occurs, in all files of a scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Census {
    /// By the place of the keyword.
    obeyed: [u64; KEYWORDS.len()],
    /// Those without influence on hit and depth.
    skipped: [u64; KEYWORDS.len()],
    private: BTreeMap<String, u64>,
    shapes: BTreeMap<String, ShapeCount>,
    boundaries: Listed<Boundary>,
    unused_objects: Listed<UnusedObject>,
}

/// The first 20 of something, and the number of all.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Listed<T> {
    /// The first of them.
    pub first: Vec<T>,
    /// How many there are.
    pub count: u64,
}

/// A shape that only bounds a medium: rays pass through.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Boundary {
    /// The type of the shape.
    pub shape: String,
    /// File, line and column of the `Shape` statement.
    pub place: String,
}

/// Places that are listed, at most.
pub(super) const MAX_LISTED: usize = 20;

impl<T> Default for Listed<T> {
    fn default() -> Listed<T> {
        Listed {
            first: Vec::new(),
            count: 0,
        }
    }
}

/// How often a type of shape occurs.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ShapeCount {
    /// `Shape` statements.
    pub statements: u64,
    /// What is stored for them, that of an object once.
    pub primitives: u64,
    /// Whether they are not in the picture, since the type is not supported.
    pub is_left_out: bool,
}

/// Names from files that are told apart.
const MAX_NAMES: usize = 200;

/// In place of the names after them.
const OTHER_NAMES: &str = "(other names)";

impl Census {
    /// Counts one directive.
    pub(super) fn count(&mut self, directive: &Directive) {
        let counts = match &directive.statement {
            Statement::Private(name) => return *count_of(&mut self.private, name) += 1,
            Statement::Ignored(_) | Statement::TransformTimes(_) => &mut self.skipped,
            Statement::Material(_)
            | Statement::MakeNamedMaterial(_)
            | Statement::NamedMaterial(_) => &mut self.skipped,
            Statement::Attribute(target) if target.name.text != "shape" => &mut self.skipped,
            _ => &mut self.obeyed,
        };
        if let Some(number) = directive.keyword_number {
            counts[number] += 1;
        }
    }

    /// Counts one `Shape` of type `name`, for which so many primitives are stored, or `None` where it is left out.
    pub(super) fn count_shape(&mut self, name: &str, primitives: Option<usize>) {
        let count = count_of(&mut self.shapes, name);
        count.statements += 1;
        count.primitives += primitives.unwrap_or(0) as u64;
        count.is_left_out |= primitives.is_none();
    }

    /// Notes a shape that only bounds a medium.
    pub(super) fn add_boundary(&mut self, shape: &str, place: impl FnOnce() -> SourceLocation) {
        self.boundaries.count += 1;
        if self.boundaries.first.len() < MAX_LISTED {
            self.boundaries.first.push(Boundary {
                shape: shape.to_owned(),
                place: place().to_string(),
            });
        }
    }

    /// Notes the objects that no instance shows: the first ones, and the number of all.
    pub(super) fn set_unused(&mut self, (first, count): (Vec<UnusedObject>, u64)) {
        self.unused_objects = Listed { first, count };
    }

    /// Shapes that only bound a medium, in the order of the file: no ray meets them.
    pub fn boundaries(&self) -> &Listed<Boundary> {
        &self.boundaries
    }

    /// Objects that no instance shows, sorted by name.
    pub fn unused_objects(&self) -> &Listed<UnusedObject> {
        &self.unused_objects
    }

    /// Directives that were obeyed, sorted by keyword.
    pub fn obeyed(&self) -> impl Iterator<Item = (&'static str, u64)> {
        KEYWORDS
            .into_iter()
            .zip(self.obeyed)
            .filter(|(_, count)| *count > 0)
    }

    /// Directives that were skipped because hit and depth do not depend on them, sorted by keyword.
    pub fn skipped(&self) -> impl Iterator<Item = (&'static str, u64)> {
        KEYWORDS
            .into_iter()
            .zip(self.skipped)
            .filter(|(_, count)| *count > 0)
    }

    /// Directives that no pbrt knows, sorted by keyword.
    pub fn private(&self) -> impl Iterator<Item = (&str, u64)> {
        self.private
            .iter()
            .map(|(name, count)| (name.as_str(), *count))
    }

    /// Types of shape, sorted by name.
    pub fn shapes(&self) -> impl Iterator<Item = (&str, ShapeCount)> {
        self.shapes
            .iter()
            .map(|(name, count)| (name.as_str(), *count))
    }

    /// `Shape` statements whose geometry is not in the picture, since their type is not supported.
    pub fn left_out(&self) -> u64 {
        self.shapes
            .values()
            .filter(|count| count.is_left_out)
            .map(|count| count.statements)
            .sum()
    }

    /// One line on what was skipped or left out since rays do not meet it, where anything was.
    pub fn summary(&self) -> Option<String> {
        let counts: Vec<String> = self
            .skipped()
            .map(|(keyword, count)| format!("{count} {keyword}"))
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
                "left out, as in pbrt: {count} shapes that only bound a medium"
            )),
        };
        let parts: Vec<String> = skipped.into_iter().chain(left_out).collect();
        (!parts.is_empty()).then(|| parts.join("; "))
    }
}

impl Default for Census {
    fn default() -> Census {
        let none = [0; KEYWORDS.len()];
        Census {
            obeyed: none,
            skipped: none,
            private: BTreeMap::new(),
            shapes: BTreeMap::new(),
            boundaries: Listed::default(),
            unused_objects: Listed::default(),
        }
    }
}

/// What is counted under `name`; a file has no end of names.
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
    fn names_without_end_are_counted_together() {
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
