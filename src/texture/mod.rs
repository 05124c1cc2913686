//! Textures of one number: functions of a surface's u and v.
//!
//! Every value is computed in `f64` by rule A2 of `docs/accuracy.md`, so it is the same on every
//! machine.

mod dots;
mod mapping;
mod noise;
#[cfg(test)]
mod tests;
mod texels;

pub use mapping::UvMapping;
pub use texels::{Filter, Texels, Wrap};

use crate::digest::Digester;
use std::sync::Arc;

/// A function of u and v.
#[derive(Debug, Clone)]
pub enum FloatTexture {
    /// The same value everywhere.
    Constant(f64),
    /// The product of two textures.
    Scale([Arc<FloatTexture>; 2]),
    /// From the first texture, where the amount is 0, to the second one, where it is 1.
    Mix {
        /// The two textures.
        of: [Arc<FloatTexture>; 2],
        /// The weight of the second one.
        amount: Arc<FloatTexture>,
    },
    /// Squares of side 1, the first texture where s and t are between 0 and 1.
    Checkerboard {
        /// Maps u and v to s and t.
        mapping: UvMapping,
        /// The two textures.
        of: [Arc<FloatTexture>; 2],
    },
    /// Dots at random places.
    Dots {
        /// Maps u and v to s and t.
        mapping: UvMapping,
        /// The texture within dots, and that outside.
        of: [Arc<FloatTexture>; 2],
    },
    /// Bilinear interpolation of four values.
    Bilerp {
        /// Maps u and v to s and t.
        mapping: UvMapping,
        /// At (s, t) = (0, 0), (0, 1), (1, 0) and (1, 1).
        corners: [f64; 4],
    },
    /// An image.
    Image(ImageTexture),
}

/// A texture that looks values up in an image.
#[derive(Debug, Clone)]
pub struct ImageTexture {
    /// Maps u and v to s and t.
    pub mapping: UvMapping,
    /// The image.
    pub texels: Arc<Texels>,
    /// What lies beyond its borders.
    pub wrap: Wrap,
    /// What lies between its texels.
    pub filter: Filter,
    /// Multiplies values.
    pub scale: f64,
    /// Subtracts the product from 1; less than 0 becomes 0.
    pub is_inverted: bool,
}

impl FloatTexture {
    /// The value at (u, v); NaN where one of them is not finite.
    pub fn at(&self, uv: [f64; 2]) -> f64 {
        if !(uv[0].is_finite() && uv[1].is_finite()) {
            return f64::NAN;
        }
        match self {
            FloatTexture::Constant(value) => *value,
            FloatTexture::Scale([a, b]) => a.at(uv) * b.at(uv),
            FloatTexture::Mix { of: [a, b], amount } => {
                let amount = amount.at(uv);
                (1.0 - amount) * a.at(uv) + amount * b.at(uv)
            }
            FloatTexture::Checkerboard { mapping, of } => {
                let [s, t] = mapping.apply(uv).map(is_odd);
                of[usize::from(s != t)].at(uv)
            }
            FloatTexture::Dots { mapping, of } => {
                of[usize::from(!dots::is_inside(mapping.apply(uv)))].at(uv)
            }
            FloatTexture::Bilerp { mapping, corners } => {
                let ([s, t], [v00, v01, v10, v11]) = (mapping.apply(uv), corners);
                let left = (1.0 - s) * (1.0 - t) * v00 + (1.0 - s) * t * v01;
                left + (s * (1.0 - t) * v10 + s * t * v11)
            }
            FloatTexture::Image(image) => image.at(uv),
        }
    }

    /// The value, if it is the same everywhere.
    pub fn constant(&self) -> Option<f64> {
        match self {
            FloatTexture::Constant(value) => Some(*value),
            FloatTexture::Scale([a, b]) => Some(a.constant()? * b.constant()?),
            FloatTexture::Mix { of: [a, b], amount } => {
                let amount = amount.constant()?;
                Some((1.0 - amount) * a.constant()? + amount * b.constant()?)
            }
            FloatTexture::Checkerboard { of: [a, b], .. }
            | FloatTexture::Dots { of: [a, b], .. } => {
                let (a, b) = (a.constant()?, b.constant()?);
                (a == b).then_some(a)
            }
            FloatTexture::Bilerp { .. } | FloatTexture::Image(_) => None,
        }
    }

    /// The textures that it is made of.
    fn parts(&self) -> Vec<&FloatTexture> {
        match self {
            FloatTexture::Scale([a, b])
            | FloatTexture::Checkerboard { of: [a, b], .. }
            | FloatTexture::Dots { of: [a, b], .. } => vec![&**a, &**b],
            FloatTexture::Mix { of: [a, b], amount } => vec![&**a, &**b, &**amount],
            FloatTexture::Constant(_) | FloatTexture::Bilerp { .. } | FloatTexture::Image(_) => {
                Vec::new()
            }
        }
    }

    /// Calls `visit` with each image in it.
    pub(crate) fn each_image<'a>(&'a self, visit: &mut impl FnMut(&'a Arc<Texels>)) {
        if let FloatTexture::Image(image) = self {
            visit(&image.texels);
        }
        self.parts()
            .into_iter()
            .for_each(|part| part.each_image(visit));
    }

    /// Adds everything that its values depend on.
    pub(crate) fn digest(&self, digester: &mut Digester) {
        match self {
            FloatTexture::Constant(value) => {
                digester.word(0);
                digester.measures(&[*value]);
            }
            FloatTexture::Scale(_) => digester.word(1),
            FloatTexture::Mix { .. } => digester.word(2),
            FloatTexture::Checkerboard { mapping, .. } => {
                digester.word(3);
                mapping.digest(digester);
            }
            FloatTexture::Dots { mapping, .. } => {
                digester.word(4);
                mapping.digest(digester);
            }
            FloatTexture::Bilerp { mapping, corners } => {
                digester.word(5);
                mapping.digest(digester);
                digester.measures(corners);
            }
            FloatTexture::Image(image) => {
                digester.word(6);
                image.digest(digester);
            }
        }
        self.parts()
            .into_iter()
            .for_each(|part| part.digest(digester));
    }
}

impl ImageTexture {
    fn at(&self, uv: [f64; 2]) -> f64 {
        let found = self
            .texels
            .at(self.mapping.apply(uv), self.wrap, self.filter);
        let value = self.scale * found;
        if self.is_inverted {
            (1.0 - value).max(0.0)
        } else {
            value
        }
    }

    fn digest(&self, digester: &mut Digester) {
        self.mapping.digest(digester);
        digester.word(self.wrap as u64);
        digester.word(self.filter as u64);
        digester.word(self.is_inverted.into());
        digester.measures(&[self.scale]);
        self.texels.digest(digester);
    }
}

/// Whether the integer below `x` is odd.
fn is_odd(x: f64) -> bool {
    x.floor().rem_euclid(2.0) == 1.0
}
