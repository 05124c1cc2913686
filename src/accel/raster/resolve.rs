//! From what a tile knows of its pixels to their depths.

use super::frame::Frame;
use super::pixels::{BLOCKS, Held, LANE_COLUMNS, LANE_ROWS, Pixel, Pixels};
use super::search::Searcher;
use super::traced::TracedTile;
use crate::accel::{ExactFallbacks, Precision};
use crate::camera::{Camera, Projection};
use crate::simd::{F32s, F64s, LANES, Lanes, Mask};

/// What of the hits is wanted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Wanted {
    /// Planar depth.
    pub(crate) z: bool,
    /// The distance.
    pub(crate) t: bool,
    /// Both, of what hits nothing.
    pub(crate) miss: f32,
}

/// The numbers that rays of a tile are made of (rule R5): X of its columns and Y of its rows.
struct RayCoordinates {
    x: [f64; LANES],
    y: [f64; LANES],
}

impl RayCoordinates {
    fn of(camera: &Camera, first: [u32; 2]) -> RayCoordinates {
        let coordinates =
            |k: usize| camera.plane_coordinates(first[0] + k as u32, first[1] + k as u32);
        RayCoordinates {
            x: std::array::from_fn(|k| coordinates(k)[0]),
            y: std::array::from_fn(|k| coordinates(k)[1]),
        }
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
        let component = if is_perspective {
            simd.splat_wide(c[k][0]) * x + simd.splat_wide(c[k][1]) * y + along
        } else {
            along
        };
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
    pixels: &mut Pixels,
    traced: &mut TracedTile,
    fallbacks: &mut ExactFallbacks,
) {
    let with_depth = wanted.z || wanted.t;
    if with_depth && searcher.precision == Precision::Exact {
        pixels.kept.fill_planes(simd, frame);
    }
    let coordinates = wanted
        .t
        .then(|| RayCoordinates::of(searcher.camera, frame.first));
    let miss = simd.splat(wanted.miss);
    let mut planes = Gathered::new();
    let mut open = Open::new();
    for block in 0..BLOCKS {
        // All hits are nearer than what pixels began with; and pixels that are not wanted.
        let is_hit = simd
            .load(&pixels.nearness[block])
            .above(simd.splat(pixels.least));
        let hit = planes.gather(pixels, block, is_hit.bits(), traced);
        if !with_depth {
            continue;
        }
        let (mut z, mut t) = ([wanted.miss; LANES], [wanted.miss; LANES]);
        if hit != 0 {
            let mut of_rays = None;
            if let Some(coordinates) = &coordinates {
                of_rays = Some(speeds(simd, searcher.camera, coordinates, block));
            }
            let Depths {
                z: block_z,
                t: block_t,
                unsure,
            } = match searcher.precision {
                Precision::Exact => planes.depths(simd, frame, block, of_rays),
                Precision::Fast => fast_depths(simd, frame, &pixels.nearness[block], of_rays),
            };
            is_hit.select(block_z, miss).store(&mut z);
            is_hit.select(block_t, miss).store(&mut t);
            open.add(
                simd,
                searcher,
                pixels,
                block,
                (unsure | planes.searched) & hit,
            );
        }
        traced.put_depths(block, &z, &t);
    }
    if with_depth {
        open.prefetch_corners(simd, searcher, pixels);
        for pixel in open.pixels() {
            let depth = match pixels.held(pixel) {
                Held::Hit(place) => {
                    searcher.depth_of(frame.first, pixel, &pixels.hits[place], fallbacks)
                }
                Held::Triangle(place) => {
                    searcher.depth(frame.first, pixel, pixels.kept.primitive(place), fallbacks)
                }
                Held::Nothing => continue,
            };
            traced.put_depth(pixel.column(), pixel.row(), depth);
        }
    }
}

/// Pixels whose depths lanes could not work out.
struct Open {
    pixels: [Pixel; BLOCKS * LANES],
    count: usize,
}

impl Open {
    fn new() -> Open {
        Open {
            pixels: [Pixel::at(0, 0); BLOCKS * LANES],
            count: 0,
        }
    }

    fn pixels(&self) -> impl Iterator<Item = Pixel> + '_ {
        self.pixels[..self.count].iter().copied()
    }

    /// Adds pixels of a block, and has what they hit fetched: it will be needed when all blocks are done.
    #[inline(always)]
    fn add<S: Lanes>(
        &mut self,
        simd: S,
        searcher: &Searcher,
        pixels: &Pixels,
        block: usize,
        mut lanes: u32,
    ) {
        while lanes != 0 {
            let pixel = Pixel::of(block, lanes.trailing_zeros() as usize);
            lanes &= lanes - 1;
            self.pixels[self.count] = pixel;
            self.count += 1;
            if let Some(index) = triangle_at(pixels, pixel) {
                simd.prefetch(searcher.geometry.corners_of(index));
            }
        }
    }

    #[inline(always)]
    fn prefetch_corners<S: Lanes>(&self, simd: S, searcher: &Searcher, pixels: &Pixels) {
        for pixel in self.pixels() {
            if let Some(index) = triangle_at(pixels, pixel) {
                for place in searcher.geometry.corners_of(index) {
                    simd.prefetch(searcher.geometry.vertex(*place));
                }
            }
        }
    }
}

/// The triangle that a pixel holds, if it is in no instance.
#[inline(always)]
fn triangle_at(pixels: &Pixels, pixel: Pixel) -> Option<usize> {
    let Held::Triangle(place) = pixels.held(pixel) else {
        return None;
    };
    let placed = pixels.kept.primitive(place);
    placed
        .instance()
        .is_none()
        .then(|| placed.primitive().index())
}

/// Depths of a block's pixels.
struct Depths<S: Lanes> {
    z: S::F,
    t: S::F,
    /// Pixels of which one could be rounded another way, pixel k as bit k.
    unsure: u32,
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
        Gathered {
            nearness: [[1.0; LANES], [0.0; LANES], [0.0; LANES]],
            error: [0.0; LANES],
            searched: 0,
        }
    }

    /// Notes what was hit by those pixels of a block that may have, and returns those that have.
    #[inline(always)]
    fn gather(
        &mut self,
        pixels: &Pixels,
        block: usize,
        mut lanes: u32,
        traced: &mut TracedTile,
    ) -> u32 {
        let mut hit = 0;
        self.searched = 0;
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize;
            lanes &= lanes - 1;
            let pixel = Pixel::of(block, lane);
            match pixels.held(pixel) {
                Held::Nothing => {}
                Held::Triangle(place) => {
                    let plane = pixels.kept.plane(place);
                    for k in 0..3 {
                        self.nearness[k][lane] = plane.nearness[k];
                    }
                    self.error[lane] = plane.error;
                    traced.put_hit(pixel.column(), pixel.row(), pixels.kept.primitive(place));
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

    #[inline(always)]
    fn depths<S: Lanes>(
        &self,
        simd: S,
        frame: &Frame,
        block: usize,
        speeds: Option<S::D>,
    ) -> Depths<S> {
        let first = Pixel::of(block, 0);
        let x = (simd.load(&LANE_COLUMNS) + simd.splat(first.column() as f32)).widen();
        let y = (simd.load(&LANE_ROWS) + simd.splat(first.row() as f32)).widen();
        let [first, per_column, per_row] = &self.nearness;
        let nearness =
            simd.load_wide(per_column) * x + simd.load_wide(per_row) * y + simd.load_wide(first);
        let error = simd.load(&self.error);
        // Neither is what has no error to speak of, where planes are seen edge-on.
        let unknown = !simd.splat(MAX_ERROR).above(error).bits();
        let error = error.widen();
        let (depth, error) = if frame.view.is_perspective {
            let depth = simd.splat_wide(1.0) / nearness;
            (depth, error * depth)
        } else {
            (simd.splat_wide(0.0) - nearness, error)
        };
        let (low, high) = (depth - error, depth + error);
        let (z, unsure) = rounded::<S>(low, high);
        let Some(speeds) = speeds else {
            return Depths {
                z,
                t: z,
                unsure: unsure | unknown,
            };
        };
        let (less, more) = (1.0 - 2f64.powi(-49), 1.0 + 2f64.powi(-49));
        let (t, unsure_t) = rounded::<S>(
            low * speeds * simd.splat_wide(less),
            high * speeds * simd.splat_wide(more),
        );
        Depths {
            z,
            t,
            unsure: unsure | unsure_t | unknown,
        }
    }
}

/// More does not leave `f64` its sense; relative, orthographic in units of depth.
const MAX_ERROR: f32 = 1024.0;

/// The `f32` next to numbers between `low` and `high`, and the lanes where there are two.
#[inline(always)]
fn rounded<S: Lanes>(low: S::D, high: S::D) -> (S::F, u32) {
    let (low, high) = (low.narrow(), high.narrow());
    (low, high.above(low).bits())
}

#[inline(always)]
fn fast_depths<S: Lanes>(
    simd: S,
    frame: &Frame,
    nearness: &[f32; LANES],
    speeds: Option<S::D>,
) -> Depths<S> {
    let nearness = simd.load(nearness);
    let z = if frame.view.is_perspective {
        simd.splat(1.0) / nearness
    } else {
        simd.splat(0.0) - nearness
    };
    let t = match speeds {
        Some(speeds) => (z.widen() * speeds).narrow(),
        None => z,
    };
    Depths { z, t, unsure: 0 }
}
