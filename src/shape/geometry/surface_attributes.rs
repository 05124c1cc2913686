//! Which side the normals of shapes are on, and the coordinates of their surfaces.

use super::Geometry;
use super::attributes::{CornerUv, CurvePiece, PatchUv};
use super::vertex_normals::{CornerNormals, NormalSpace};
use crate::geometry::{Matrix, Vector};
use crate::shape::InstancedId;

impl Geometry {
    /// Puts the normals of the last shape, of this number, on the other side: for pbrt's
    /// `ReverseOrientation`, or if its transform swaps handedness, but not for both.
    pub fn turn_normals(&mut self, shape: u32) {
        self.attributes.get_or_insert_default().turn(shape);
    }

    /// Gives coordinates to the triangles of the last mesh, one for each.
    pub fn add_uv(&mut self, uv: Vec<CornerUv>) {
        let first_triangle = self.triangles.len().checked_sub(uv.len());
        if let Some(first_triangle) = first_triangle.filter(|_| !uv.is_empty()) {
            self.attributes
                .get_or_insert_default()
                .add_uv(first_triangle as u32, uv);
        }
    }

    /// Gives coordinates to the last quadric, which is a bilinear patch.
    pub fn add_patch_uv(&mut self, uv: PatchUv) {
        if let Some(last) = self.quadrics.len().checked_sub(1) {
            let attributes = self.attributes.get_or_insert_default();
            attributes.add_patch_uv(last as u32, uv);
        }
    }

    /// The coordinates at the corners of a patch, if it has any.
    pub(crate) fn uv_of_patch(&self, placed: InstancedId) -> Option<&PatchUv> {
        let attributes = self.owner_of(placed).attributes.as_ref()?;
        attributes.uv_of_patch(placed.primitive().index() as u32)
    }

    /// Adds the Bezier pieces of the curves that are added next, whose segments count from 0.
    pub fn add_curve_pieces(&mut self, pieces: &[CurvePiece]) {
        let first_segment = self.segment_count() as u32;
        let attributes = self.attributes.get_or_insert_default();
        attributes.add_curve_pieces(first_segment, pieces);
    }

    /// The Bezier piece of a segment, if the geometry knows.
    pub(crate) fn curve_piece_of(&self, placed: InstancedId) -> Option<&CurvePiece> {
        let attributes = self.owner_of(placed).attributes.as_ref()?;
        attributes.curve_piece_of(placed.primitive().index() as u32)
    }

    /// Gives vertex normals to the triangles of the last mesh, one for each corner, in the space of
    /// the shape. `world_from_object` is the transform of the shape; in an object, that to the
    /// space of the object. `is_reversed` if `ReverseOrientation` holds.
    pub fn add_normals(
        &mut self,
        normals: Vec<CornerNormals>,
        world_from_object: &Matrix,
        is_reversed: bool,
    ) {
        let first_triangle = self.triangles.len().checked_sub(normals.len());
        if let Some(first_triangle) = first_triangle.filter(|_| !normals.is_empty()) {
            let space = NormalSpace::new(world_from_object, is_reversed);
            let attributes = self.attributes.get_or_insert_default();
            attributes
                .normals
                .add(first_triangle as u32, normals, space);
        }
    }

    /// Whether the geometry that a primitive belongs to has any vertex normals.
    pub(crate) fn has_vertex_normals(&self, placed: InstancedId) -> bool {
        let attributes = self.owner_of(placed).attributes.as_ref();
        attributes.is_some_and(|attributes| !attributes.normals.is_empty())
    }

    /// Whether the vertex normal of a triangle, at a point with these barycentric coordinates, is
    /// on the other side than the right hand of its corners has it. In an instance, that of the
    /// object. `None` if the mesh has no vertex normals, or they do not decide. `normal` is that of
    /// the triangle in no instance.
    pub(crate) fn vertex_normal_turns(
        &self,
        placed: InstancedId,
        normal: Vector,
        weights: [f64; 3],
    ) -> Option<bool> {
        let (owner, index) = (self.owner_of(placed), placed.primitive().index());
        let attributes = owner.attributes.as_ref()?;
        let (space, towards) = attributes.normals.at(index as u32, weights)?;
        // Meshes of objects stay in the space of their files.
        let normal = match placed.instance() {
            Some(_) => space.image(owner.triangle(index).normal()),
            None => normal,
        };
        let cosine = normal.dot(towards);
        // A comparison with NaN fails.
        (cosine.abs() > 0.0).then_some(cosine < 0.0)
    }

    /// Whether the normals of a primitive are on the other side.
    pub(crate) fn turns_normal_of(&self, placed: InstancedId) -> bool {
        let attributes = self.owner_of(placed).attributes.as_ref();
        attributes.is_some_and(|attributes| {
            attributes.has_turned() && attributes.is_turned(self.shape_number(placed))
        })
    }

    /// The coordinates at the corners of a triangle, if its mesh has any.
    pub(crate) fn uv_of(&self, placed: InstancedId) -> Option<&CornerUv> {
        let attributes = self.owner_of(placed).attributes.as_ref()?;
        attributes.uv_of(placed.primitive().index() as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Matrix, Point};
    use crate::shape::PrimitiveId;
    use crate::shape::geometry::attributes::Attributes;

    fn add_triangles(geometry: &mut Geometry, count: usize, shape: u32) {
        geometry
            .add_mesh(
                vec![Point::default(); 3],
                vec![[0, 1, 2]; count],
                &Matrix::IDENTITY,
                shape,
            )
            .unwrap();
    }

    #[test]
    fn triangles_have_the_coordinates_of_their_mesh() {
        let (mut geometry, plain) = (Geometry::default(), size_of::<Attributes>());
        let uv = |first: u8, count: u8| {
            (first..first + count)
                .map(|k| [[k.into(); 2]; 3])
                .collect::<Vec<CornerUv>>()
        };
        add_triangles(&mut geometry, 2, 1);
        let bytes = geometry.bytes();
        assert!(
            geometry
                .uv_of(InstancedId::alone(PrimitiveId::triangle(0)))
                .is_none()
                && geometry.attributes.is_none()
        );
        for (count, shape, coordinates) in [
            (2, 2, uv(1, 2)),
            (1, 3, Vec::new()),
            (0, 4, Vec::new()),
            (1, 5, uv(3, 1)),
        ] {
            add_triangles(&mut geometry, count, shape);
            geometry.add_uv(coordinates);
        }
        let found: Vec<Option<f32>> = (0..6)
            .map(|k| {
                geometry
                    .uv_of(InstancedId::alone(PrimitiveId::triangle(k)))
                    .map(|uv| uv[0][0])
            })
            .collect();
        assert_eq!(found, [None, None, Some(1.0), Some(2.0), None, Some(3.0)]);
        assert!(geometry.bytes() >= bytes + plain + 3 * size_of::<CornerUv>());
    }

    #[test]
    fn normals_are_turned_by_shape() {
        let mut object = Geometry::default();
        for shape in 1..4 {
            object
                .add_object_mesh(vec![Point::default(); 3], vec![[0, 1, 2]], 0, shape)
                .unwrap();
        }
        object.turn_normals(2);
        let mut geometry = Geometry::default();
        let number = geometry.add_object(object);
        geometry.add_instance(number, Matrix::IDENTITY).unwrap();
        add_triangles(&mut geometry, 1, 7);
        geometry.turn_normals(7);
        let turned: Vec<bool> = geometry
            .all()
            .map(|placed| geometry.turns_normal_of(placed))
            .collect();
        assert_eq!(turned, [true, false, true, false]);
    }
}
