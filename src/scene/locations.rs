//! Where the files of a scene state its shapes and instances.

use super::place::Place;
use super::source_span::SourceSpan;
use std::path::Path;
use std::sync::Arc;

/// The places of all `Shape` and `ObjectInstance` statements.
#[derive(Debug, Clone, Default)]
pub struct Locations {
    shapes: Vec<(Box<str>, Place)>,
    instances: Vec<Place>,
}

impl Locations {
    /// The one shape of a mesh file that is rendered without a scene.
    pub(super) fn of_mesh(path: &Path, shape: &str) -> Locations {
        let place = Place {
            path: Arc::from(path),
            position: None,
        };
        Locations {
            shapes: vec![(shape.into(), place)],
            instances: Vec::new(),
        }
    }

    /// Adds the next `Shape`, by its type and its keyword.
    pub(super) fn add_shape(&mut self, name: &str, keyword: &SourceSpan) {
        self.shapes.push((name.into(), keyword.place()));
    }

    /// Adds the next `ObjectInstance`, by its keyword.
    pub(super) fn add_instance(&mut self, keyword: &SourceSpan) {
        self.instances.push(keyword.place());
    }

    /// Type and place of `Shape` statement `number`, counted from 1.
    pub fn shape(&self, number: u32) -> Option<(&str, &Place)> {
        let (name, place) = self.shapes.get((number as usize).checked_sub(1)?)?;
        Some((name, place))
    }

    /// Place of `ObjectInstance` statement `number`, counted from 0.
    pub fn instance(&self, number: usize) -> Option<&Place> {
        self.instances.get(number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::source_file::SourceFile;

    #[test]
    fn shapes_and_instances_are_found_by_number() {
        let file = |path: &str, text: &str| {
            Arc::new(SourceFile::new(Path::new(path), text.as_bytes().to_vec()))
        };
        let (outer, inner) = (file("outer", "\nS\n I"), file("inner", "  S"));
        let mut locations = Locations::default();
        locations.add_shape("a", &SourceSpan::new(&outer, &(1..2)));
        locations.add_shape("b", &SourceSpan::new(&inner, &(2..3)));
        locations.add_instance(&SourceSpan::new(&outer, &(4..5)));
        let shape = |number| {
            locations
                .shape(number)
                .map(|(name, at)| format!("{name} {at}"))
        };
        assert_eq!(shape(1).unwrap(), "a outer:2:1");
        assert_eq!(shape(2).unwrap(), "b inner:1:3");
        assert_eq!(locations.instance(0).unwrap().to_string(), "outer:3:2");
        assert_eq!((shape(0), shape(3)), (None, None));
        let mesh = Locations::of_mesh(Path::new("m.ply"), "plymesh");
        assert_eq!(mesh.shape(1).unwrap().1.to_string(), "m.ply");
    }
}
