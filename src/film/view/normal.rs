//! The normal view: the orientation of surfaces.

use super::samples::{NOTHING, measures, normals};
use crate::film::color_map::Rgb;
use crate::film::{ChannelName, Image};
use crate::parallel::CollectVec;
use rayon::prelude::*;
use std::io;

/// The colours of `image`, row by row from the top: x, y and z of the normal in world space, from
/// -1 to 1, as red, green and blue from 0 to 255. A miss is black, which is no normal.
///
/// # Errors
/// The image lacks the channels of `N`, or `A`.
pub fn normal(image: &Image) -> io::Result<Vec<Rgb>> {
    let [x, y, z] = normals(image)?;
    let a = measures(image, ChannelName::A)?;
    let pixel = |(((x, y), z), a): (((&f32, &f32), &f32), &f32)| {
        if *a != 0.0 {
            [*x, *y, *z].map(component)
        } else {
            NOTHING
        }
    };
    Ok(x.par_iter().zip(y).zip(z).zip(a).map(pixel).collect_vec())
}

fn component(x: f32) -> u8 {
    (127.5 * (f64::from(x) + 1.0)).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Channel, PixelBounds, Samples};

    #[test]
    fn components_are_stretched_from_0_to_255() {
        let channel = |name, values: [f32; 3]| Channel {
            name,
            samples: Samples::F32(values.to_vec()),
        };
        let channels = vec![
            channel(ChannelName::Nx, [1.0, -1.0, 0.0]),
            channel(ChannelName::Ny, [0.0, 0.0, 0.0]),
            channel(ChannelName::Nz, [0.0, 0.0, 0.0]),
            channel(ChannelName::A, [1.0, 1.0, 0.0]),
        ];
        let image = Image {
            display_window: (3, 1),
            data_window: PixelBounds::of_film(3, 1),
            channels,
        };
        assert_eq!(
            normal(&image).unwrap(),
            [[255, 128, 128], [0, 128, 128], NOTHING]
        );
    }
}
