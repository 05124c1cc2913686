//! Where the files of a scene state its shapes and instances.

use super::place::Place;
use super::source_span::SourceSpan;
use crate::geometry::Matrix;
use std::path::Path;
use std::sync::Arc;

/// The places of all `Shape` and `ObjectInstance` statements.
#[derive(Debug, Clone, Default)]
pub struct Locations {
    shapes: Vec<StatedShape>,
    instances: Vec<Place>,
}

/// A `Shape` statement.
#[derive(Debug, Clone)]
pub struct StatedShape {
    /// Its type, such as `sphere`.
    pub name: Box<str>,
    /// The place of its keyword.
    pub place: Place,
    /// The [stretch](crate::geometry::Matrix::stretch) of its transform.
    pub stretch: f64,
    /// Whether it is the shape of an `AreaLightSource`.
    pub is_light: bool,
}

impl Locations {
    /// The one shape of a mesh file that is rendered without a scene.
    pub(super) fn of_mesh(path: &Path, shape: &str) -> Locations {
        let place = Place {
            path: Arc::from(path),
            position: None,
        };
        Locations {
            shapes: vec![StatedShape {
                name: shape.into(),
                place,
                stretch: 1.0,
                is_light: false,
            }],
            instances: Vec::new(),
        }
    }

    /// Adds the next `Shape`, by its type, its keyword and its transform.
    pub(super) fn add_shape(
        &mut self,
        name: &str,
        keyword: &SourceSpan,
        world_from_object: &Matrix,
        is_light: bool,
    ) {
        self.shapes.push(StatedShape {
            name: name.into(),
            place: keyword.place(),
            stretch: world_from_object.stretch(),
            is_light,
        });
    }

    /// Adds the next `ObjectInstance`, by its keyword.
    pub(super) fn add_instance(&mut self, keyword: &SourceSpan) {
        self.instances.push(keyword.place());
    }

    /// Type and place of `Shape` statement `number`, counted from 1.
    pub fn shape(&self, number: u32) -> Option<(&str, &Place)> {
        let StatedShape { name, place, .. } = self.stated_shape(number)?;
        Some((name, place))
    }

    /// `Shape` statement `number`, counted from 1.
    pub fn stated_shape(&self, number: u32) -> Option<&StatedShape> {
        self.shapes.get((number as usize).checked_sub(1)?)
    }

    /// All `Shape` statements with their numbers.
    pub fn stated_shapes(&self) -> impl Iterator<Item = (u32, &StatedShape)> {
        (1..).zip(&self.shapes)
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
        let mut add = |name: &str, at: SourceSpan, factors: [f64; 3], is_light: bool| {
            locations.add_shape(name, &at, &Matrix::scale(factors), is_light);
        };
        add("a", SourceSpan::new(&outer, &(1..2)), [1.0; 3], true);
        add(
            "b",
            SourceSpan::new(&inner, &(2..3)),
            [1.0, 1.0, 8.0],
            false,
        );
        locations.add_instance(&SourceSpan::new(&outer, &(4..5)));
        let shape = |number| {
            locations
                .shape(number)
                .map(|(name, at)| format!("{name} {at}"))
        };
        assert_eq!(shape(1).unwrap(), "a outer:2:1");
        assert_eq!(shape(2).unwrap(), "b inner:1:3");
        let stated = |(number, shape): (u32, &StatedShape)| (number, shape.stretch, shape.is_light);
        let stated: Vec<_> = locations.stated_shapes().map(stated).collect();
        assert_eq!(stated, [(1, 1.0, true), (2, 8.0, false)]);
        assert_eq!(locations.instance(0).unwrap().to_string(), "outer:3:2");
        assert_eq!((shape(0), shape(3)), (None, None));
        let mesh = Locations::of_mesh(Path::new("m.ply"), "plymesh");
        assert_eq!(mesh.shape(1).unwrap().1.to_string(), "m.ply");
    }
}
