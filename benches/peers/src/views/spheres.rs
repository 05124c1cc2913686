//! Many small spheres.

use super::place::camera;
use crate::Result;
use crate::random::Random;
use crate::view::View;
use feimos::geometry::{Matrix, Point};
use feimos::shape::Geometry as SceneGeometry;

const COUNT: u32 = 1_000_000;

/// A million spheres of many sizes, all small, in a cube two units wide.
pub(super) fn view() -> Result<View> {
    let mut random = Random(1);
    let mut shapes = SceneGeometry::default();
    for shape in 1..=COUNT {
        let centre = [(); 3].map(|()| random.between(-1.0, 1.0));
        let transform = shapes.add_transform(Matrix::translate(centre));
        let added = shapes.add_sphere(random.between(0.002, 0.006), None, transform, shape);
        added.map_err(|error| error.to_string())?;
    }
    let eye = Point::new(1.1, 1.6, -3.4);
    View::new(
        camera(eye, Point::new(0.0, 0.0, 0.0), 40.0, [1024, 1024]),
        shapes,
    )
}
