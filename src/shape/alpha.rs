//! The alpha of a surface: a texture that cuts holes into it.

use crate::digest::Digester;
use crate::texture::{FloatTexture, Texels};
use std::fmt;
use std::sync::Arc;

/// Hits with an alpha up to this number do not count (rule A1); from 0 to below 1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct AlphaCutoff(f64);

impl AlphaCutoff {
    /// Hits with an alpha of 0 do not count, as in pbrt-v3.
    pub const ZERO: AlphaCutoff = AlphaCutoff(0.0);

    /// `cutoff`, if it is from 0 to below 1.
    pub fn new(cutoff: f64) -> Option<AlphaCutoff> {
        (0.0..1.0).contains(&cutoff).then_some(AlphaCutoff(cutoff))
    }

    /// Whether a hit with this alpha counts. One that is not a number does, as in pbrt.
    pub fn keeps(self, alpha: f64) -> bool {
        alpha > self.0 || alpha.is_nan()
    }
}

impl fmt::Display for AlphaCutoff {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// The alpha of a surface as a function of its u and v, and the cutoff.
#[derive(Debug, Clone)]
pub struct Alpha {
    texture: Arc<FloatTexture>,
    cutoff: AlphaCutoff,
}

impl Alpha {
    /// The alpha that `texture` gives to a surface.
    pub fn new(texture: Arc<FloatTexture>, cutoff: AlphaCutoff) -> Alpha {
        Alpha { texture, cutoff }
    }

    /// The alpha at (u, v).
    pub fn at(&self, uv: [f64; 2]) -> f64 {
        self.texture.at(uv)
    }

    /// Whether a hit at (u, v) counts.
    pub fn keeps(&self, uv: [f64; 2]) -> bool {
        self.cutoff.keeps(self.at(uv))
    }

    /// Whether both are certainly the same.
    pub(super) fn is_same_as(&self, other: &Alpha) -> bool {
        Arc::ptr_eq(&self.texture, &other.texture) && self.cutoff == other.cutoff
    }

    pub(super) fn each_image<'a>(&'a self, visit: &mut impl FnMut(&'a Arc<Texels>)) {
        self.texture.each_image(visit);
    }

    pub(super) fn digest(&self, digester: &mut Digester) {
        self.texture.digest(digester);
        digester.measures(&[self.cutoff.0]);
    }
}
