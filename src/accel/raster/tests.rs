//! Tests that computed edge functions, nearness and depths stay within their error bounds.

use super::depth_planes::DepthPlanes;
use super::setup::EdgePlanes;
use crate::accel::space::AnchorSpace;
use crate::accel::tree::{Run, primitive_blocks};
use crate::accel::view::{CameraView, TileFrame};
use crate::camera::{Camera, Projection, ScreenWindow};
use crate::geometry::{Matrix, Point, Transform, Vector};
use crate::shape::{Geometry, InstancedId, PrimitiveId, Triangle};
use crate::simd::{LANES, Lanes, Level, SimdKernel};
use proptest::prelude::*;

/// Sixteen triangles in front of a camera, and the first pixel of a tile.
#[derive(Debug, Clone)]
struct Scene {
    camera: Camera,
    triangles: Vec<[Point; 3]>,
    first: [u32; 2],
}

/// A camera at `eye` that looks at `target`, with an angle of view of `degrees` in a perspective.
pub(super) fn camera(eye: Point, target: Point, is_perspective: bool, degrees: f64) -> Camera {
    let up = Vector::new(0.1, 1.0, 0.2);
    let look_at = Transform::look_at(eye, target, up).unwrap();
    let (projection, size) = if is_perspective {
        (Projection::perspective(degrees), 1.0)
    } else {
        (Projection::Orthographic, 3.0)
    };
    let screen_window = ScreenWindow {
        x0: -size,
        x1: size,
        y0: -size,
        y1: size,
    };
    Camera {
        world_from_camera: look_at.inverse,
        projection,
        screen_window,
        resolution: [256, 256],
    }
}

/// The triangles lie around points that rays of the tile pass, from small ones to some that are
/// larger than the tile.
fn scene() -> impl Strategy<Value = Scene> {
    let eye = prop::array::uniform3(3.0..9.0f64);
    let corner = prop::array::uniform3(-1.0..1.0f64);
    let triangle = (
        prop::array::uniform2(0u32..16),
        4.0..40.0f64,
        -9..2i32,
        prop::array::uniform3(corner),
    );
    let triangles = prop::collection::vec(triangle, LANES);
    (
        eye,
        any::<bool>(),
        prop::array::uniform2(0u32..16),
        triangles,
    )
        .prop_map(|(eye, is_perspective, tile, triangles)| {
            let target = Point::new(0.1, 0.2, 0.3);
            let camera = camera(Point::from(eye), target, is_perspective, 40.0);
            let first = tile.map(|k| 16 * k);
            let place = |(pixel, depth, size, corners): ([u32; 2], f64, i32, [[f64; 3]; 3])| {
                let ray = camera.ray(first[0] + pixel[0], first[1] + pixel[1]);
                let centre = ray.origin + ray.direction * depth;
                corners.map(|corner| centre + Vector::from(corner) * 2f64.powi(size))
            };
            let triangles = triangles.into_iter().map(place).collect();
            Scene {
                camera,
                triangles,
                first,
            }
        })
}

struct Check<'a>(&'a Scene);

/// A scene after setup.
struct Prepared<'a> {
    scene: &'a Scene,
    geometry: Geometry,
    planes: EdgePlanes,
    depth_planes: DepthPlanes,
}

impl SimdKernel for Check<'_> {
    type Output = ();

    /// Compares computed numbers and their bounds with `f64` results from the scene's own corners.
    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) {
        let Scene {
            camera,
            triangles,
            first,
        } = self.0;
        let mut geometry = Geometry::default();
        let indices = (0..triangles.len() as u32)
            .map(|k| [3 * k, 3 * k + 1, 3 * k + 2])
            .collect();
        geometry
            .add_mesh(
                triangles.iter().flatten().copied().collect(),
                indices,
                &Matrix::IDENTITY,
                1,
            )
            .unwrap();
        let order: Vec<PrimitiveId> = (0..triangles.len()).map(PrimitiveId::triangle).collect();
        let block = &primitive_blocks(
            &[Run {
                first: 0,
                count: LANES as u32,
            }],
            &order,
            &geometry,
        )[0];
        let view = CameraView::new(camera, &AnchorSpace::new(camera.anchor(), 256.0)).unwrap();
        let frame = TileFrame::new(&view, *first);
        let mut planes = EdgePlanes::new();
        let usable = planes
            .set_up_f32::<S, true>(simd, &frame, block, view.least_nearness())
            .usable;
        let mut depth_planes = DepthPlanes::new();
        for (lane, primitive) in order.iter().enumerate() {
            depth_planes.push_f32(
                InstancedId::alone(*primitive),
                &block.corner,
                &block.edges,
                lane,
            );
        }
        depth_planes.compute(simd, &frame);
        let prepared = Prepared {
            scene: self.0,
            geometry,
            planes,
            depth_planes,
        };
        for lane in (0..LANES).filter(|lane| usable >> lane & 1 != 0) {
            let footprint = prepared.planes.footprints.of(lane);
            for row in footprint.rows[0]..=footprint.rows[1] {
                for column in footprint.columns[0]..=footprint.columns[1] {
                    prepared.check(&frame, lane, [column as u32, row as u32]);
                }
            }
        }
    }
}

impl Prepared<'_> {
    fn check(&self, frame: &TileFrame, lane: usize, pixel: [u32; 2]) {
        let planes = &self.planes;
        let first = planes.first(lane);
        let local = [pixel[0] - first[0], pixel[1] - first[1]].map(|k| k as f32);
        let at = |f: &[[f32; LANES]; 3]| {
            f64::from(f[0][lane] + f[1][lane] * local[0] + f[2][lane] * local[1])
        };
        let truth = Truth::of(frame, &self.geometry.triangle(lane), pixel.map(f64::from));
        for (edge, truth) in planes.edges.iter().zip(truth.edges) {
            let off = (at(edge) - truth).abs();
            assert!(
                off <= f64::from(planes.edge_error[lane]),
                "{off} is more than {}",
                planes.edge_error[lane]
            );
        }
        if truth.edges.iter().all(|edge| *edge > 0.0) {
            let unit = if frame.view.is_perspective {
                truth.nearness
            } else {
                1.0
            };
            assert!(
                (at(&planes.nearness) - truth.nearness).abs()
                    < f64::from(frame.view.tolerance) * unit
            );
            self.check_depth(frame, lane, pixel);
        }
    }

    fn check_depth(&self, frame: &TileFrame, lane: usize, pixel: [u32; 2]) {
        let plane = self.depth_planes.plane(lane);
        let [start, per_column, per_row] = plane.nearness;
        let nearness = start + per_column * f64::from(pixel[0]) + per_row * f64::from(pixel[1]);
        let is_perspective = frame.view.is_perspective;
        let depth = if is_perspective {
            1.0 / nearness
        } else {
            -nearness
        };
        let Scene { camera, first, .. } = self.scene;
        let ray = camera.ray(first[0] + pixel[0], first[1] + pixel[1]);
        let [a, b, c] = self.geometry.triangle(lane).0;
        let normal = (b - a).cross(c - a);
        let t = normal.dot(a - ray.origin) / normal.dot(ray.direction);
        let allowed = f64::from(plane.error) * if is_perspective { t } else { 1.0 };
        assert!(
            (depth - t).abs() <= allowed,
            "{depth} is not {t}, by more than {allowed}"
        );
    }
}

/// A triangle at a pixel of the tile, computed in `f64`.
struct Truth {
    edges: [f64; 3],
    nearness: f64,
}

impl Truth {
    fn of(frame: &TileFrame, triangle: &Triangle, [x, y]: [f64; 2]) -> Truth {
        let on_film = triangle.0.map(|corner| {
            let from_eye = corner - frame.eye();
            let row = |k: usize| Vector::from(frame.tile_from_world[k]).dot(from_eye);
            if frame.view.is_perspective {
                ([row(0) / row(2), row(1) / row(2)], 1.0 / row(2))
            } else {
                (
                    [row(0) + frame.offset[0], row(1) + frame.offset[1]],
                    -row(2),
                )
            }
        });
        let twice_area = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        };
        let [(a, at_a), (b, at_b), (c, at_c)] = on_film;
        let (pixel, area) = ([x, y], twice_area(a, b, c));
        let edges = [
            twice_area(pixel, b, c),
            twice_area(a, pixel, c),
            twice_area(a, b, pixel),
        ];
        let nearness = (edges[0] * at_a + edges[1] * at_b + edges[2] * at_c) / area;
        Truth {
            edges: edges.map(|edge| edge * area.signum()),
            nearness,
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::with_cases(300)
    })]

    #[test]
    fn computed_numbers_stay_within_their_bounds(scene in scene()) {
        for level in Level::available() {
            level.run(Check(&scene));
        }
    }
}
