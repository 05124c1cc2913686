//! What of shapes only the channels `N`, `u` and `v` depend on: kept where somebody asks for them, and nowhere else.

use super::Geometry;
use crate::digest::Digester;
use crate::shape::InstancedId;

/// u and v at the corners of a triangle.
pub type CornerUv = [[f32; 2]; 3];

/// What shapes say about their surface.
#[derive(Debug, Default)]
pub(super) struct Attributes {
    /// The numbers of the shapes whose normals are turned round, in their order.
    turned: Vec<u32>,
    /// Of the triangles of some meshes, one mesh after the other.
    uv: Vec<CornerUv>,
    uv_runs: Vec<UvRun>,
}

/// The coordinates of one mesh.
#[derive(Debug)]
struct UvRun {
    first_triangle: u32,
    /// Their place among all coordinates.
    first_uv: usize,
}

impl Attributes {
    pub(super) fn bytes(&self) -> usize {
        size_of_val(self)
            + size_of_val(&self.turned[..])
            + size_of_val(&self.uv[..])
            + size_of_val(&self.uv_runs[..])
    }

    pub(super) fn digest(&self, digester: &mut Digester) {
        digester.list(&self.turned, |shape| [(*shape).into()]);
        digester.list(&self.uv, |corners| {
            corners.map(|[u, v]| u64::from(u.to_bits()) << 32 | u64::from(v.to_bits()))
        });
        digester.list(&self.uv_runs, |run| {
            [run.first_triangle.into(), run.first_uv as u64]
        });
    }

    fn uv_of(&self, triangle: u32) -> Option<&CornerUv> {
        let next = self
            .uv_runs
            .partition_point(|run| run.first_triangle <= triangle);
        let run = &self.uv_runs[next.checked_sub(1)?];
        let end = self
            .uv_runs
            .get(next)
            .map_or(self.uv.len(), |next| next.first_uv);
        self.uv[run.first_uv..end].get((triangle - run.first_triangle) as usize)
    }
}

impl Geometry {
    /// Has the normals of the shape of this number, which was added last, point to the other side: for pbrt's `ReverseOrientation`,
    /// or where its transform swaps handedness, but not for both.
    pub fn turn_normals(&mut self, shape: u32) {
        let turned = &mut self.attributes.get_or_insert_default().turned;
        debug_assert!(turned.last().is_none_or(|last| *last < shape));
        turned.push(shape);
    }

    /// Gives coordinates to the triangles of the mesh that was added last: as many as it has.
    pub fn add_uv(&mut self, mut uv: Vec<CornerUv>) {
        let Some(first_triangle) = self
            .triangles
            .len()
            .checked_sub(uv.len())
            .filter(|_| !uv.is_empty())
        else {
            return;
        };
        let attributes = self.attributes.get_or_insert_default();
        attributes.uv_runs.push(UvRun {
            first_triangle: first_triangle as u32,
            first_uv: attributes.uv.len(),
        });
        if attributes.uv.is_empty() {
            attributes.uv = uv;
        } else {
            attributes.uv.append(&mut uv);
        }
    }

    /// Whether the normals of a primitive are those of its shape, turned round.
    pub(in crate::shape) fn turns_normal_of(&self, placed: InstancedId) -> bool {
        let geometry = placed
            .instance()
            .map_or(self, |instance| self.object_of(instance).geometry());
        let turned = geometry
            .attributes
            .as_ref()
            .map_or(&[][..], |attributes| &attributes.turned);
        !turned.is_empty() && turned.binary_search(&self.shape_number(placed)).is_ok()
    }

    /// The coordinates at the corners of a triangle, where its mesh has any.
    pub(in crate::shape) fn uv_of(&self, placed: InstancedId) -> Option<&CornerUv> {
        let geometry = placed
            .instance()
            .map_or(self, |instance| self.object_of(instance).geometry());
        geometry
            .attributes
            .as_ref()?
            .uv_of(placed.primitive().index() as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Matrix, Point};
    use crate::shape::PrimitiveId;

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
