//! The depth16 view: depth as 16-bit integers, for programs.

use super::samples::{measures, pixel_at};
use crate::film::{ChannelName, Image};
use rayon::prelude::*;
use std::fmt;
use std::io;

/// The conversion of depths to integers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Depth16 {
    /// Steps a scene unit; positive and finite.
    pub scale: f64,
    /// The value of a miss, which no hit may have.
    pub miss: u16,
}

/// A depth that does not fit into 16 bits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unfit {
    /// Column and row of the first such pixel, on the film.
    pub pixel: [u32; 2],
    /// Its depth.
    pub depth: f32,
    /// A scale that fits all depths, if there is one.
    pub fitting_scale: Option<f64>,
}

impl fmt::Display for Unfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Unfit {
            pixel: [x, y],
            depth,
            ..
        } = self;
        write!(
            f,
            "the depth {depth} of pixel ({x}, {y}) does not fit into 16 bits"
        )
    }
}

impl Depth16 {
    /// The default scale: millimetres of metres.
    pub const SCALE: f64 = 1000.0;

    /// The values of `image`, row by row from the top: for a hit its depth times the scale,
    /// rounded, halves away from 0.
    ///
    /// # Errors
    /// The image lacks `Z` or `A`. The inner error is a depth that does not fit: none is clamped or
    /// wrapped.
    pub fn of(&self, image: &Image) -> io::Result<Result<Vec<u16>, Unfit>> {
        let (z, a) = (
            measures(image, ChannelName::Z)?,
            measures(image, ChannelName::A)?,
        );
        let number = |(z, a): (&f32, &f32)| {
            if *a != 0.0 {
                self.number(*z)
            } else {
                Some(self.miss)
            }
        };
        let numbers: Option<Vec<u16>> = z.par_iter().zip(a).map(number).collect();
        let Some(numbers) = numbers else {
            let place = z
                .iter()
                .zip(a)
                .position(|sample| number(sample).is_none())
                .unwrap_or(0);
            return Ok(Err(Unfit {
                pixel: pixel_at(image, place),
                depth: z[place],
                fitting_scale: self.fitting_scale(z, a),
            }));
        };
        Ok(Ok(numbers))
    }

    fn number(&self, z: f32) -> Option<u16> {
        let number = (f64::from(z) * self.scale).round();
        let fits = (0.0..=f64::from(u16::MAX)).contains(&number) && number != f64::from(self.miss);
        fits.then_some(number as u16)
    }

    /// The largest scale of one digit 1, 2 or 5 that fits all hits.
    fn fitting_scale(&self, z: &[f32], a: &[f32]) -> Option<f64> {
        let hits = || z.iter().zip(a).filter(|(_, a)| **a != 0.0).map(|(z, _)| *z);
        let far = f64::from(hits().fold(0.0, f32::max));
        let largest = (f64::from(u16::MAX) / far).log10().floor();
        let scales = [1.0, 0.0, -1.0]
            .map(|down| [5.0, 2.0, 1.0].map(|digit| digit * 10f64.powf(largest + down)));
        let fits = |scale: &f64| {
            let other = Depth16 {
                scale: *scale,
                ..*self
            };
            hits().all(|z| other.number(z).is_some())
        };
        scales
            .into_iter()
            .flatten()
            .find(|scale| scale.is_finite() && fits(scale))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Channel, PixelBounds, Samples};

    fn numbers(depth16: Depth16, z: &[f32], a: &[f32]) -> Result<Vec<u16>, Unfit> {
        let channel = |name, values: &[f32]| Channel {
            name,
            samples: Samples::F32(values.to_vec()),
        };
        let channels = vec![channel(ChannelName::A, a), channel(ChannelName::Z, z)];
        let data_window = PixelBounds {
            x0: 5,
            x1: 5 + z.len() as u32,
            y0: 2,
            y1: 3,
        };
        depth16
            .of(&Image {
                display_window: (20, 20),
                data_window,
                channels,
            })
            .unwrap()
    }

    const PLAIN: Depth16 = Depth16 {
        scale: Depth16::SCALE,
        miss: 0,
    };

    #[test]
    fn depths_are_rounded_to_steps_and_misses_are_0() {
        let z = [1.0, 0.0014, 0.0016, 65.535, f32::INFINITY];
        assert_eq!(
            numbers(PLAIN, &z, &[1.0, 1.0, 1.0, 1.0, 0.0]),
            Ok(vec![1000, 1, 2, 65535, 0])
        );
        let other = Depth16 {
            scale: 2.0,
            miss: 9,
        };
        assert_eq!(
            numbers(other, &[0.1, 3.0, 7.0], &[1.0, 1.0, 0.0]),
            Ok(vec![0, 6, 9])
        );
    }

    #[test]
    fn a_depth_that_does_not_fit_is_reported_with_a_scale_that_does() {
        let unfit = numbers(PLAIN, &[1.0, 65.536, 3.0, 700.0], &[1.0; 4]).unwrap_err();
        assert_eq!(
            unfit,
            Unfit {
                pixel: [6, 2],
                depth: 65.536,
                fitting_scale: Some(50.0)
            }
        );
        assert_eq!(
            unfit.to_string(),
            "the depth 65.536 of pixel (6, 2) does not fit into 16 bits"
        );
        let near = numbers(PLAIN, &[1.0, 0.0001], &[1.0; 2]).unwrap_err();
        assert_eq!((near.pixel, near.fitting_scale), ([6, 2], Some(50_000.0)));
        let miss = numbers(
            Depth16 {
                miss: 1000,
                ..PLAIN
            },
            &[1.0],
            &[1.0],
        )
        .unwrap_err();
        assert_eq!(miss.fitting_scale, Some(50_000.0));
    }

    #[test]
    fn if_no_scale_fits_none_is_suggested() {
        for z in [[1e-3, 1e4], [f32::INFINITY, 1.0], [-1.0, 1.0]] {
            assert_eq!(
                numbers(PLAIN, &z, &[1.0; 2]).unwrap_err().fitting_scale,
                None,
                "{z:?}"
            );
        }
    }
}
