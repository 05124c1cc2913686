//! The bounds of an object, and the magnitudes that bound the errors of placing its boxes.

use crate::geometry::{Bounds, Matrix, Point};
use crate::per_axis::per_axis;
use crate::shape::{Form, Geometry, Pose, Primitive, PrimitiveId};
use rayon::prelude::*;

/// The bounds of an object in the space of its instances, and the magnitudes of their computation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Outline {
    /// Encloses everything that may be hit in some instance.
    pub(super) bounds: Bounds,
    pub(super) terms: TermBounds,
}

/// Magnitudes of all points of an object, as its shapes' transforms take them from the spaces of
/// their files to the space of its instances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TermBounds {
    /// Bounds the sum of the absolute terms of each coordinate. Infinite if sums may overflow.
    pub(super) in_instance: [f64; 3],
    /// Bounds the coordinates in files.
    pub(super) in_file: f64,
}

/// Larger sums of terms might overflow depending on their order.
const LARGEST: f64 = 1e250;

impl Outline {
    /// The outline of an object. It includes everything that may be hit in some instance: also
    /// primitives without area in the space of the instances, because rounding may give them one,
    /// and those under a singular transform.
    pub(super) fn of(object: &Geometry) -> Outline {
        let primitives: Vec<PrimitiveId> = object.primitives().collect();
        let of_chunk = |chunk: &[PrimitiveId]| {
            let mut pose = Pose::new(object, Matrix::IDENTITY);
            chunk.iter().fold(
                Outline::NOTHING,
                |outline, primitive| match Outline::of_one(object, &mut pose, *primitive) {
                    Some(one) => outline.union(one),
                    None => outline,
                },
            )
        };
        let outlines = primitives.par_chunks(1 << 14).map(of_chunk);
        let outline = outlines.reduce(|| Outline::NOTHING, Outline::union);
        let mut terms = outline.terms.in_instance.iter();
        let fits = terms.all(|terms| *terms < LARGEST);
        if fits { outline } else { Outline::ANYWHERE }
    }

    /// Tests whether nothing may be hit.
    pub(super) fn is_empty(&self) -> bool {
        self.bounds.is_empty()
    }

    /// Tests whether the object's place is unknown.
    pub(super) fn is_anywhere(&self) -> bool {
        *self == Outline::ANYWHERE
    }

    const ANYWHERE: Outline = Outline {
        bounds: Bounds {
            low: Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
            high: Point::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        },
        terms: TermBounds {
            in_instance: [f64::INFINITY; 3],
            in_file: f64::INFINITY,
        },
    };

    const NOTHING: Outline = Outline {
        bounds: Bounds::EMPTY,
        terms: TermBounds {
            in_instance: [0.0; 3],
            in_file: 0.0,
        },
    };

    fn union(self, other: Outline) -> Outline {
        let in_instance = per_axis(|k| self.terms.in_instance[k].max(other.terms.in_instance[k]));
        let in_file = self.terms.in_file.max(other.terms.in_file);
        Outline {
            bounds: self.bounds.union(other.bounds),
            terms: TermBounds {
                in_instance,
                in_file,
            },
        }
    }

    /// The outline of one primitive; `None` if it cannot be hit in any instance.
    pub(super) fn of_one(
        object: &Geometry,
        pose: &mut Pose,
        primitive: PrimitiveId,
    ) -> Option<Outline> {
        let (extent, instance_from_file) = match object.own_surface(primitive) {
            Primitive::Triangle(triangle) => {
                let mut corners = triangle.0.iter();
                corners.all(|corner| corner.is_finite()).then_some(())?;
                let [a, b, c] = triangle.0;
                let extent = per_axis(|k| a[k].abs().max(b[k].abs()).max(c[k].abs()));
                (extent, *object.transform_of_mesh(primitive.index() as u32))
            }
            Primitive::Quadric(quadric) if quadric.form == Form::Patch => {
                let transform = object.transform_of_patch(primitive.index());
                quadric.world_from_object.is_finite().then_some(())?;
                (quadric.extent()?, *transform)
            }
            Primitive::Quadric(quadric) => (quadric.extent()?, quadric.world_from_object),
            Primitive::Segment(segment) => (segment.extent()?, segment.world_from_object),
        };
        instance_from_file.is_finite().then_some(())?;
        let sum =
            |row: &[f64; 4]| (0..3).map(|j| row[j].abs() * extent[j]).sum::<f64>() + row[3].abs();
        let in_instance = instance_from_file.rows.each_ref().map(sum);
        let in_file = extent.into_iter().fold(0.0, f64::max);
        Some(Outline {
            bounds: pose.surface(primitive).bounds(),
            terms: TermBounds {
                in_instance,
                in_file,
            },
        })
    }
}
