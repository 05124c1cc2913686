//! The surface at the point where a ray meets it.

use super::kept_hits::{SpaceCache, is_narrow, middle, t_on_quadric};
use super::quadric::{PatchPoint, UnitSpace};
use super::{FilterRay, Form, Geometry, InstancedId, Primitive, Quadric, Segment, Triangle};
use crate::geometry::{Point, Ray, Vector};

/// What a surface is like where a ray meets it, in world space.
///
/// All of it is made in `f64` from the primitive and the ray, and from nothing else, so that it
/// depends on no accelerator.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SurfacePoint {
    /// The geometric normal, a unit vector, as pbrt orients it.
    ///
    /// For a triangle it is (b - a) x (c - a), with the corners in the order of the file and in
    /// world space. For a quadric it is dp/du x dp/dv in object space, mapped to the world by the
    /// transposed inverse: away from the centre or the axis, or, for a disk, along its z axis. That
    /// of a hyperboloid is across the line that turns, and points to the axis if z falls from p1 to
    /// p2. For a bilinear patch it is dp/du x dp/dv of its corners in the world. It is turned round if either `ReverseOrientation` holds or the current transform swaps
    /// handedness, but not if both do. So a mirrored mesh shows the same side as before, and a
    /// mirrored sphere the other one, as in pbrt-v3. In an instance it is the normal of the object
    /// as defined, mapped to the world by the transposed inverse of the instance's transform: there
    /// both show the same side as before.
    ///
    /// A curve has the normal of pbrt's `flat` and `cylinder` curves, of the straight segment that is
    /// hit.
    ///
    /// Triangles of `loopsubdiv` are turned round once more, to the side of the vertex normals that
    /// pbrt gives them, and so is what is not a sphere where the radius is below 0 (rule E7).
    ///
    /// If a mesh has vertex normals (`N`), the normal of a triangle is turned to the side of
    /// theirs, interpolated at the point of the hit. `ReverseOrientation` turns it round, and a
    /// transform does not. If they lie in the plane of the triangle, they do not decide.
    pub normal: Vector,
    /// The point where the ray meets the surface.
    pub point: Point,
    /// u and v, as in pbrt-v3. For a triangle, the mean of those at the corners, which are (0, 0),
    /// (1, 0) and (1, 1) if its mesh has none; for a quadric from 0 to 1, except v of a disk with a
    /// negative radius. On a curve u is the position along one of its Bezier pieces, and v goes from
    /// one side to the other.
    pub uv: [f64; 2],
}

/// The parts of a [`SurfacePoint`] that are computed; the others are 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SurfaceWants {
    /// [`SurfacePoint::normal`]; on the right side if the geometry knows which normals are turned.
    pub normal: bool,
    /// [`SurfacePoint::point`].
    pub point: bool,
    /// [`SurfacePoint::uv`]; those of the file if the geometry has kept them.
    pub uv: bool,
}

/// Computes points of many surfaces; faster for consecutive points of one surface.
pub struct SurfacePoints<'a> {
    geometry: &'a Geometry,
    wants: SurfaceWants,
    /// The space of the last quadric.
    spaces: SpaceCache,
}

impl<'a> SurfacePoints<'a> {
    /// The points of `geometry`.
    pub fn new(geometry: &'a Geometry, wants: SurfaceWants) -> SurfacePoints<'a> {
        SurfacePoints {
            geometry,
            wants,
            spaces: SpaceCache::default(),
        }
    }

    /// The point where `ray` first meets `placed`, at a hit that its alpha keeps. If it just misses,
    /// which `f32` may take for a hit, the point where it meets the whole of a cut surface or the
    /// plane of a triangle, or else where it comes nearest.
    pub fn of(&mut self, placed: InstancedId, ray: &Ray) -> SurfacePoint {
        let surface = self.geometry.surface(placed);
        if !ray.can_hit() || !surface.can_be_hit() {
            return SurfacePoint::default();
        }
        match surface {
            Primitive::Triangle(triangle) => self.of_triangle(placed, &triangle, ray),
            Primitive::Quadric(quadric) => self.of_quadric(placed, &quadric, ray),
            Primitive::Segment(segment) => self.of_segment(placed, &segment, ray),
        }
    }

    fn of_triangle(&self, placed: InstancedId, triangle: &Triangle, ray: &Ray) -> SurfacePoint {
        let mut found = SurfacePoint::default();
        if self.wants.normal {
            let (geometry, normal) = (self.geometry, triangle.normal());
            let weights = || triangle.weights(ray);
            let is_turned = geometry
                .has_vertex_normals(placed)
                .then(|| geometry.vertex_normal_turns(placed, normal, weights()))
                .flatten();
            let is_turned = is_turned.unwrap_or_else(|| geometry.turns_normal_of(placed));
            found.normal = if is_turned != self.is_mirrored(placed) {
                -normal
            } else {
                normal
            };
        }
        if self.wants.point {
            found.point = ray.origin + ray.direction * t_on_triangle(triangle, ray);
        }
        if self.wants.uv {
            found.uv = self.geometry.uv_on_triangle(placed, triangle, ray);
        }
        found
    }

    /// Whether the normal of a primitive whose corners are in the world is on the other side. A
    /// mirroring instance mirrors the corners, but not the normal.
    fn turns_corners(&self, placed: InstancedId) -> bool {
        self.geometry.turns_normal_of(placed) != self.is_mirrored(placed)
    }

    /// Whether the instance mirrors the corners of its object, but not the normal.
    fn is_mirrored(&self, placed: InstancedId) -> bool {
        placed.instance().is_some_and(|number| {
            let instance = &self.geometry.instances()[number];
            instance.world_from_instance().swaps_handedness()
        })
    }

    fn of_patch(&mut self, placed: InstancedId, quadric: &Quadric, ray: &Ray) -> SurfacePoint {
        let patch = quadric.patch();
        let t = self
            .t_of_hit(placed, quadric, ray)
            .unwrap_or_else(|| patch.nearest(ray));
        let mut found = SurfacePoint::default();
        if self.wants.point {
            found.point = ray.origin + ray.direction * t;
        }
        if self.wants.normal || self.wants.uv {
            let PatchPoint { uv, normal } = patch.point(ray, t);
            if self.wants.normal {
                found.normal = if self.turns_corners(placed) {
                    -normal
                } else {
                    normal
                };
            }
            if self.wants.uv {
                found.uv = self.geometry.uv_on_patch(placed, uv);
            }
        }
        found
    }

    /// The `t` of the hit that counts, or else of the whole surface.
    fn t_of_hit(&mut self, placed: InstancedId, quadric: &Quadric, ray: &Ray) -> Option<f64> {
        let filter_ray = FilterRay::new(ray);
        let surface = Primitive::Quadric(*quadric);
        let number = self
            .geometry
            .number_of_hit(placed, &surface, &filter_ray, &mut self.spaces);
        t_on_quadric(quadric, &filter_ray, number)
            .or_else(|| Some(middle(quadric.exact_whole(ray)?.bracket())))
    }

    fn of_quadric(&mut self, placed: InstancedId, quadric: &Quadric, ray: &Ray) -> SurfacePoint {
        if quadric.form == Form::Patch {
            return self.of_patch(placed, quadric, ray);
        }
        let wants = self.wants;
        let is_turned = wants.normal && self.geometry.turns_normal_of(placed);
        let t = self
            .t_of_hit(placed, quadric, ray)
            .unwrap_or_else(|| self.spaces.space(placed, quadric).nearest(ray));
        let mut found = SurfacePoint::default();
        if wants.point {
            found.point = ray.origin + ray.direction * t;
        }
        if wants.normal || wants.uv {
            let space = self.spaces.space(placed, quadric);
            let point = space.point(ray, t);
            if wants.normal {
                let normal = space.normal(point);
                found.normal = if is_turned { -normal } else { normal };
            }
            if wants.uv {
                found.uv = space.uv(point);
            }
        }
        found
    }

    fn of_segment(&self, placed: InstancedId, segment: &Segment, ray: &Ray) -> SurfacePoint {
        let mut found = SurfacePoint::default();
        if self.wants.point {
            let t = Primitive::Segment(*segment).t_of_hit(&FilterRay::new(ray));
            let t = t.filter(is_narrow).map(middle);
            let exact = || segment.exact(ray).map(|t| middle(t.bracket()));
            let start = || {
                let d = ray.direction;
                let [start, _] = segment.ends;
                (segment.world_from_object.apply(start) - ray.origin).dot(d) / d.dot(d)
            };
            let t = t.or_else(exact).unwrap_or_else(start);
            found.point = ray.origin + ray.direction * t;
        }
        if self.wants.normal {
            let piece = self.geometry.curve_piece_of(placed);
            let normal = match piece {
                Some(piece) if piece.is_round => {
                    segment.round_normal(ray, segment.place_at(ray).across)
                }
                _ => segment.normal(ray),
            };
            let is_turned = self.geometry.turns_normal_of(placed);
            found.normal = if is_turned { -normal } else { normal };
        }
        if self.wants.uv {
            found.uv = self.geometry.uv_on_segment(placed, segment, ray);
        }
        found
    }
}

impl Quadric {
    /// The unit normal where `ray` meets the surface at `t`: [`SurfacePoint::normal`], never turned
    /// round.
    pub fn normal_at(&self, ray: &Ray, t: f64) -> Vector {
        if self.form == Form::Patch {
            return self.patch().point(ray, t).normal;
        }
        let space = UnitSpace::new(self);
        space.normal(space.point(ray, t))
    }
}

fn t_on_triangle(triangle: &Triangle, ray: &Ray) -> f64 {
    let exact = || triangle.exact_crossing(ray).map(|t| t.bracket());
    let t = triangle
        .t_of_hit(&FilterRay::new(ray))
        .filter(is_narrow)
        .or_else(exact)
        .filter(|t| t.high > 0.0);
    let d = ray.direction;
    t.map_or_else(|| (triangle.0[0] - ray.origin).dot(d) / d.dot(d), middle)
}
