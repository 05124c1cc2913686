//! The shaded view: the colours of depth, lit by a lamp at the eye.

use super::depth;
use super::samples::{measures, normals, pixel_at};
use crate::camera::Camera;
use crate::film::color_map::Rgb;
use crate::film::{ChannelName, ColorMap, ColorRange, Image};
use crate::geometry::Vector;
use rayon::prelude::*;
use std::io;

/// The brightness of a surface that the ray grazes; one that faces the ray has 1.
const GRAZED: f64 = 0.25;

/// The colours of `image` as seen by `camera`, row by row from the top: those of [`depth()`], darker
/// where the surface turns away from the ray. Both sides of a surface are lit. Misses are not.
///
/// # Errors
/// The image lacks `Z`, `A` or the channels of `N`.
pub fn shaded(
    image: &Image,
    camera: &Camera,
    colors: ColorMap,
    range: ColorRange,
) -> io::Result<Vec<Rgb>> {
    let mut pixels = depth(image, colors, range)?;
    let [x, y, z] = normals(image)?;
    let a = measures(image, ChannelName::A)?;
    let light = |(place, pixel): (usize, &mut Rgb)| {
        if a[place] == 0.0 {
            return;
        }
        let [x, y, z] = [x[place], y[place], z[place]].map(f64::from);
        let [column, row] = pixel_at(image, place);
        let direction = camera.ray(column, row).direction.normalized();
        let cosine = Vector::new(x, y, z).dot(direction).abs().min(1.0);
        let brightness = GRAZED + (1.0 - GRAZED) * cosine;
        *pixel = pixel.map(|value| (f64::from(value) * brightness).round() as u8);
    };
    pixels.par_iter_mut().enumerate().for_each(light);
    Ok(pixels)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Projection, ScreenWindow};
    use crate::film::view::MISS_IN_DEPTH;
    use crate::film::{Channel, PixelBounds, Samples};
    use crate::geometry::Matrix;

    #[test]
    fn surfaces_darken_as_they_turn_away() {
        let channel = |name, values: [f32; 4]| Channel {
            name,
            samples: Samples::F32(values.to_vec()),
        };
        let image = Image {
            display_window: (4, 1),
            data_window: PixelBounds::of_film(4, 1),
            channels: vec![
                channel(ChannelName::Z, [1.0; 4]),
                channel(ChannelName::A, [1.0, 1.0, 1.0, 0.0]),
                channel(ChannelName::Nx, [0.0, 0.0, 1.0, 0.0]),
                channel(ChannelName::Ny, [0.0; 4]),
                channel(ChannelName::Nz, [1.0, -1.0, 0.0, 0.0]),
            ],
        };
        let camera = Camera {
            world_from_camera: Matrix::IDENTITY,
            projection: Projection::Orthographic,
            screen_window: ScreenWindow::of_aspect(4.0),
            resolution: [4, 1],
        };
        let range = ColorRange {
            start: 1.0,
            end: 2.0,
        };
        let pixels = shaded(&image, &camera, ColorMap::Gray, range).unwrap();
        assert_eq!(pixels, [[255; 3], [255; 3], [64; 3], MISS_IN_DEPTH]);
    }
}
