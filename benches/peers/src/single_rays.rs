//! Pictures by one ray after the other.

use crate::camera_rays::{CameraRays, Ray32};
use crate::picture::{Band, Picture};
use feimos::accel::Tracer;
use feimos::camera::Camera;
use feimos::shape::Geometry;

/// Columns that follow each other through all rows of a band: with its 8 rows a square.
const SQUARE: usize = 8;

/// A hit: t, and the primitive's place from 0.
pub(crate) type Hit = (f32, u32);

/// Asks `closest_hit` for every ray, square by square, on the threads of the current pool.
pub(crate) fn trace(
    rays: &CameraRays,
    picture: &mut Picture,
    closest_hit: impl Fn(&Ray32) -> Option<Hit> + Sync,
) {
    picture.fill_bands(|band| fill(rays, band, &closest_hit));
}

fn fill(rays: &CameraRays, mut band: Band, closest_hit: impl Fn(&Ray32) -> Option<Hit>) {
    fill_squares(&mut band, |x, y| closest_hit(&rays.ray(x, y)));
}

/// Asks feimos for every ray of a band: the depth is rounded exactly.
pub(crate) fn fill_exactly(camera: &Camera, shapes: &Geometry, mut tracer: Tracer, mut band: Band) {
    fill_squares(&mut band, |x, y| {
        let ray = camera.ray(x as u32, y as u32);
        let hit = tracer.closest_hit(&ray)?;
        let number = shapes.image_number(hit.primitive);
        Some((tracer.depth(&ray, &hit).z, number - 1))
    });
}

/// Fills a band with what `hit` returns for a column and a row of the picture.
#[inline]
fn fill_squares(band: &mut Band, mut hit: impl FnMut(usize, usize) -> Option<Hit>) {
    for x0 in (0..band.width).step_by(SQUARE) {
        for row in 0..band.height {
            for x in x0..(x0 + SQUARE).min(band.width) {
                let hit = hit(x, band.y0 + row);
                let place = row * band.width + x;
                band.depths[place] = hit.map_or(f32::INFINITY, |(t, _)| t);
                band.primitives[place] = hit.map_or(0, |(_, primitive)| primitive + 1);
            }
        }
    }
}
