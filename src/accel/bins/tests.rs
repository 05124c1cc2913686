//! Tests that bins hold everything that rays may meet, against the reference.

use super::chunk::Binner;
use super::film_point::{FilmPoint, Projector, project_all};
use super::footprint::{FilmWindow, Footprint};
use super::grid::{BinGrid, MAX_BINS};
use super::triangle_group::TriangleGroup;
use super::{AnchorSpace, Bins};
use crate::accel::view::CameraView;
use crate::accel::{BuildOptions, SplitMethod};
use crate::camera::{Camera, Projection, ScreenWindow};
use crate::film::PixelBounds;
use crate::geometry::{Matrix, Point, Transform, Vector};
use crate::progress::Progress;
use crate::reference;
use crate::shape::{Geometry, PrimitiveId};
use crate::simd::{LANES, Lanes, Level, SimdKernel};
use proptest::prelude::*;

const SIDE: u32 = 24;

fn camera(is_perspective: bool, eye: [f64; 3]) -> Camera {
    let up = Vector::new(0.1, 1.0, 0.2);
    let look_at = Transform::look_at(Point::from(eye), Point::new(0.1, 0.2, 0.3), up).unwrap();
    let (projection, size) = match is_perspective {
        true => (Projection::perspective(80.0), 1.0),
        false => (Projection::Orthographic, 3.0),
    };
    Camera {
        world_from_camera: look_at.inverse,
        projection,
        screen_window: ScreenWindow {
            x0: -size,
            x1: size,
            y0: -size,
            y1: size,
        },
        resolution: [SIDE; 2],
    }
}

/// Triangles of all sizes around the eye and the origin: many cross the eye's plane.
fn geometry() -> impl Strategy<Value = Geometry> {
    let coordinate = prop_oneof![4 => -4.0..4.0f64, 1 => -400.0..400.0f64, 1 => Just(0.0)];
    let corner = prop::array::uniform3(coordinate);
    let triangle = (prop::array::uniform3(corner), 0..5u32);
    let triangles = prop::collection::vec(triangle, 1..40);
    triangles.prop_map(|triangles| {
        let shrunk = |(corners, shrinks): ([[f64; 3]; 3], u32)| {
            let [a, b, c] = corners.map(Point::from);
            let factor = 0.25f64.powi(shrinks as i32);
            [a, a + (b - a) * factor, a + (c - a) * factor]
        };
        let vertices: Vec<Point> = triangles.into_iter().flat_map(shrunk).collect();
        let corners = |first: usize| [0, 1, 2].map(|k| (first + k) as u32);
        let triangles = (0..vertices.len()).step_by(3).map(corners).collect();
        let mut geometry = Geometry::default();
        geometry
            .add_mesh(vertices, triangles, &Matrix::IDENTITY, 1)
            .unwrap();
        geometry
    })
}

/// The pixels that an entry of a bin covers.
fn pixels_of(bins: &Bins, index: usize) -> Vec<[u32; 4]> {
    let primitive = PrimitiveId::triangle(index);
    let mut found = Vec::new();
    let small = bins.grid.small_bins();
    for (number, level) in bins.grid.levels.iter().enumerate() {
        for y in 0..SIDE {
            for x in 0..SIDE {
                let bin = level.bin_at([x, y]);
                let entries: Vec<_> = match number {
                    0 => bins.chunks.iter().flat_map(|c| c.of_bin(bin)).collect(),
                    _ => bins.large[bin - small].iter().collect(),
                };
                for entry in entries
                    .into_iter()
                    .filter(|entry| entry.primitive == primitive)
                {
                    let is_inside = |ends: [u8; 2], axis: usize, pixel: u32| {
                        let unit = level.offset(axis, pixel) >> level.unit(axis);
                        (u32::from(ends[0])..=u32::from(ends[1])).contains(&unit)
                    };
                    if is_inside(entry.columns, 0, x) && is_inside(entry.rows, 1, y) {
                        found.push([x, y, entry.nearness.to_bits(), number as u32]);
                    }
                }
            }
        }
    }
    found
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(40) })]

    /// Whatever a ray hits is in the bin of its pixel, no nearer than the bin says.
    #[test]
    fn bins_hold_all_hits(
        geometry in geometry(),
        is_perspective: bool,
        eye in prop::array::uniform3(-3.0..3.0f64),
    ) {
        let camera = camera(is_perspective, eye);
        let window = PixelBounds::of_film(SIDE, SIDE);
        let options = BuildOptions::new(SplitMethod::Sah);
        let bins_of = |level| {
            let bins = Bins::new(&geometry, &camera, &window, options, level, Progress::SILENT);
            bins.expect("a usual view")
        };
        let all: Vec<Bins> = Level::available().map(bins_of).collect();
        for index in 0..geometry.triangle_count() {
            let held = all.iter().map(|bins| pixels_of(bins, index));
            let held: Vec<_> = held.collect();
            let mut alone = Geometry::default();
            let corners = geometry.triangle(index).0.to_vec();
            alone.add_mesh(corners, vec![[0, 1, 2]], &Matrix::IDENTITY, 1).unwrap();
            for [x, y] in (0..SIDE * SIDE).map(|pixel| [pixel % SIDE, pixel / SIDE]) {
                let Some(hit) = reference::closest_hit(&alone, &camera.ray(x, y)) else {
                    continue;
                };
                let z = f64::from(hit.z);
                let nearest = if is_perspective { 1.0 / z } else { -z };
                for held in &held {
                    let place = held.iter().find(|held| held[..2] == [x, y]);
                    let [_, _, nearness, _] = place.expect("a hit is in a bin");
                    let nearness = f64::from(f32::from_bits(*nearness));
                    prop_assert!(nearness >= nearest - nearest.abs() * 1e-6);
                }
            }
        }
    }

    /// Sixteen at a time, triangles have the same footprints as one by one.
    #[test]
    fn groups_agree_with_single_triangles(
        geometry in geometry(),
        is_perspective: bool,
        eye in prop::array::uniform3(-3.0..3.0f64),
    ) {
        let camera = camera(is_perspective, eye);
        for level in Level::available() {
            level.run(CheckGroups { camera: &camera, geometry: &geometry });
        }
    }

    /// Entries cover each pixel of a footprint once, and no bin has more than its share.
    #[test]
    fn entries_cover_the_footprint(
        first in prop::array::uniform2(0..40_000u32),
        size in prop::array::uniform2((0..17u32).prop_map(|bits| (1 << bits) - 1)),
        at in prop::array::uniform2(0.0..1.0f64),
    ) {
        let last = [0, 1].map(|axis| first[axis] + size[axis]);
        let window = PixelBounds { x0: 3, x1: 120_000, y0: 5, y1: 120_000 };
        let grid = BinGrid::new(&window);
        let columns = [first[0].max(3), last[0].max(3)];
        let rows = [first[1].max(5), last[1].max(5)];
        let footprint = Footprint { columns, rows, nearness: 0.5 };
        let pixel = [columns, rows];
        let pixel = [0, 1].map(|k| {
            pixel[k][0] + (at[k] * f64::from(pixel[k][1] - pixel[k][0] + 1)) as u32
        });
        let mut entries = Vec::new();
        grid.spread(&footprint, PrimitiveId::FIRST, |bin, entry| entries.push((bin, entry)));
        prop_assert!(entries.len() <= MAX_BINS as usize);
        let mut found = 0;
        for level in &grid.levels {
            for (bin, entry) in &entries {
                let within = |ends: [u8; 2], axis: usize| {
                    let unit = level.offset(axis, pixel[axis]) >> level.unit(axis);
                    (u32::from(ends[0])..=u32::from(ends[1])).contains(&unit)
                };
                let is_here = *bin as usize == level.bin_at(pixel);
                found += usize::from(is_here && within(entry.columns, 0) && within(entry.rows, 1));
            }
        }
        prop_assert_eq!(found, 1);
    }
}

/// Compares the footprints of groups with those of single triangles.
struct CheckGroups<'a> {
    camera: &'a Camera,
    geometry: &'a Geometry,
}

impl SimdKernel for CheckGroups<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) {
        let CheckGroups { camera, geometry } = self;
        let space = AnchorSpace::new(camera.anchor(), 1000.0);
        let view = CameraView::new(camera, &space).expect("a usual view");
        let projector = Projector::new(&view);
        let vertices = project_all(geometry.vertices(), &projector, Level::Portable);
        let window = FilmWindow::new(&PixelBounds::of_film(SIDE, SIDE), view.is_perspective);
        let binner = Binner {
            geometry,
            projector,
            vertices: &vertices,
            window,
            grid: &BinGrid::new(&PixelBounds::of_film(SIDE, SIDE)),
        };
        for first in (0..geometry.triangle_count()).step_by(LANES) {
            let count = LANES.min(geometry.triangle_count() - first);
            let mut group = TriangleGroup::new();
            let corners: Vec<[FilmPoint; 3]> = (first..first + count)
                .map(|index| binner.corners(index))
                .collect();
            for (lane, corners) in corners.iter().enumerate() {
                group.put(lane, *corners);
            }
            let found = group.footprints(simd, &window, (1 << count) - 1);
            for (lane, corners) in corners.iter().enumerate() {
                let alone = window.footprint(*corners);
                let has = |mask: u32| mask >> lane & 1 == 1;
                if has(found.seen) {
                    assert_eq!(Some(found.of(lane)), alone);
                    assert!(geometry.triangle(first + lane).can_be_hit());
                } else if !has(found.unsure) {
                    assert_eq!(alone, None);
                }
            }
        }
    }
}
