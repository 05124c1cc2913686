//! From what a tile knows of its pixels to their depths.

use super::frame::Frame;
use super::pixels::{BLOCKS, Held, LANE_COLUMNS, LANE_ROWS, Pixel, Pixels};
use super::search::Searcher;
use super::traced::TracedTile;
use crate::accel::{Depth, Fallbacks, Precision};
use crate::camera::{Camera, Projection};
use crate::simd::{F32s, F64s, LANES, Lanes, Mask};

/// What of the hits is wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Wanted {
    /// Planar depth.
    pub(crate) z: bool,
    /// The distance.
    pub(crate) t: bool,
}

/// The numbers that rays of a tile are made of (rule R5): X of its columns and Y of its rows.
struct RayCoordinates {
    x: [f64; LANES],
    y: [f64; LANES],
}

impl RayCoordinates {
    fn of(camera: &Camera, first: [u32; 2]) -> RayCoordinates {
        let coordinates = |k: usize| camera.plane_coordinates(first[0] + k as u32, first[1] + k as u32);
        RayCoordinates { x: std::array::from_fn(|k| coordinates(k)[0]), y: std::array::from_fn(|k| coordinates(k)[1]) }
    }

    /// The X and Y of the pixels of a block.
    #[inline(always)]
    fn of_block(&self, block: usize) -> [[f64; LANES]; 2] {
        let (mut x, mut y) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            let pixel = Pixel::of(block, lane);
            x[lane] = self.x[pixel.column() as usize];
            y[lane] = self.y[pixel.row() as usize];
        }
        [x, y]
    }
}

/// Lengths of the directions of a block's rays, off by 2^-51 of themselves at most.
#[inline(always)]
fn speeds<S: Lanes>(simd: S, camera: &Camera, coordinates: &RayCoordinates, block: usize) -> S::D {
    let [x, y] = coordinates.of_block(block);
    let (x, y) = (simd.load_wide(&x), simd.load_wide(&y));
    let c = &camera.world_from_camera.rows;
    let is_perspective = matches!(camera.projection, Projection::Perspective { .. });
    let mut square = simd.splat_wide(0.0);
    for k in 0..3 {
        let along = simd.splat_wide(c[k][2]);
        let component =
            if is_perspective { simd.splat_wide(c[k][0]) * x + simd.splat_wide(c[k][1]) * y + along } else { along };
        square = square + component * component;
    }
    square.sqrt()
}

/// Puts the hits of all pixels into `traced`, with what is wanted of them.
#[inline(always)]
pub(super) fn resolve<S: Lanes>(
    simd: S,
    frame: &Frame,
    searcher: &Searcher,
    wanted: Wanted,
    pixels: &Pixels,
    traced: &mut TracedTile,
    fallbacks: &mut Fallbacks,
) {
    let with_depth = wanted.z || wanted.t;
    let coordinates = wanted.t.then(|| RayCoordinates::of(searcher.camera, frame.first));
    for block in 0..BLOCKS {
        let mut planes = Gathered::new();
        let hit = planes.gather(pixels, block, traced);
        if hit == 0 || !with_depth {
            continue;
        }
        let (mut z, mut t) = ([0.0; LANES], [0.0; LANES]);
        let mut of_rays = None;
        if let Some(coordinates) = &coordinates {
            of_rays = Some(speeds(simd, searcher.camera, coordinates, block));
        }
        let mut unsure = match searcher.precision {
            Precision::Exact => planes.depths(simd, frame, block, of_rays, &mut z, &mut t),
            Precision::Fast => {
                fast_depths(simd, frame, &pixels.nearness[block], of_rays, &mut z, &mut t);
                0
            }
        };
        unsure = (unsure | planes.searched) & hit;

        while unsure != 0 {
            let lane = unsure.trailing_zeros() as usize;
            unsure &= unsure - 1;
            let pixel = Pixel::of(block, lane);
            let depth = match pixels.held(pixel) {
                Held::Hit(place) => searcher.depth_of(frame.first, pixel, &pixels.hits[place], fallbacks),
                Held::Plane(place) => searcher.depth(frame.first, pixel, pixels.planes[place].primitive, fallbacks),
                Held::Nothing => Depth::default(),
            };
            (z[lane], t[lane]) = (depth.z, depth.t);
        }
        traced.put_depths(block, &z, &t);
    }
}

/// The depth planes of a block's pixels.
struct Gathered {
    nearness: [[f64; LANES]; 3],
    error: [f32; LANES],
    /// Pixels whose hit was searched for, pixel k as bit k.
    searched: u32,
}

impl Gathered {
    fn new() -> Gathered {
        Gathered { nearness: [[0.0; LANES], [0.0; LANES], [1.0; LANES]], error: [0.0; LANES], searched: 0 }
    }

    /// Notes what was hit, and returns the pixels that hit anything.
    #[inline(always)]
    fn gather(&mut self, pixels: &Pixels, block: usize, traced: &mut TracedTile) -> u32 {
        let mut hit = 0;
        for lane in 0..LANES {
            let pixel = Pixel::of(block, lane);
            match pixels.held(pixel) {
                Held::Nothing => {}
                Held::Plane(place) => {
                    let plane = &pixels.planes[place];
                    for k in 0..3 {
                        self.nearness[k][lane] = plane.nearness[k];
                    }
                    self.error[lane] = plane.error;
                    traced.put_hit(pixel.column(), pixel.row(), plane.primitive);
                    hit |= 1 << lane;
                }
                Held::Hit(place) => {
                    traced.put_hit(pixel.column(), pixel.row(), pixels.hits[place].primitive);
                    self.searched |= 1 << lane;
                    hit |= 1 << lane;
                }
            }
        }
        hit
    }

    /// Both depths, and the pixels of which one could be rounded another way.
    #[inline(always)]
    fn depths<S: Lanes>(
        &self,
        simd: S,
        frame: &Frame,
        block: usize,
        speeds: Option<S::D>,
        z: &mut [f32; LANES],
        t: &mut [f32; LANES],
    ) -> u32 {
        let first = Pixel::of(block, 0);
        let x = (simd.load(&LANE_COLUMNS) + simd.splat(first.column() as f32)).widen();
        let y = (simd.load(&LANE_ROWS) + simd.splat(first.row() as f32)).widen();
        let [per_column, per_row, first] = &self.nearness;
        let nearness = simd.load_wide(per_column) * x + simd.load_wide(per_row) * y + simd.load_wide(first);
        let error = simd.load(&self.error).widen();
        let (depth, error) = if frame.view.is_perspective {
            let depth = simd.splat_wide(1.0) / nearness;
            (depth, error * depth)
        } else {
            (simd.splat_wide(0.0) - nearness, error)
        };
        let (low, high) = (depth - error, depth + error);
        let unsure = put_if_sure(simd, low, high, z);
        let Some(speeds) = speeds else { return unsure };
        let (less, more) = (1.0 - 2f64.powi(-49), 1.0 + 2f64.powi(-49));
        unsure | put_if_sure(simd, low * speeds * simd.splat_wide(less), high * speeds * simd.splat_wide(more), t)
    }
}

/// Stores the `f32` next to numbers between `low` and `high`, and returns the lanes where there are two.
#[inline(always)]
fn put_if_sure<S: Lanes>(_simd: S, low: S::D, high: S::D, to: &mut [f32; LANES]) -> u32 {
    let (low, high) = (low.narrow(), high.narrow());
    low.store(to);
    high.above(low).bits()
}

#[inline(always)]
fn fast_depths<S: Lanes>(
    simd: S,
    frame: &Frame,
    nearness: &[f32; LANES],
    speeds: Option<S::D>,
    z: &mut [f32; LANES],
    t: &mut [f32; LANES],
) {
    let nearness = simd.load(nearness);
    let depth = if frame.view.is_perspective { simd.splat(1.0) / nearness } else { simd.splat(0.0) - nearness };
    depth.store(z);
    if let Some(speeds) = speeds {
        (depth.widen() * speeds).narrow().store(t);
    }
}
