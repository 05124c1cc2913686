//! The `uv` mapping of pbrt: from u and v to a texture's own s and t.

use crate::digest::Digester;

/// s is `scale[0] * u + delta[0]`, and t likewise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UvMapping {
    /// `uscale` and `vscale`.
    pub scale: [f64; 2],
    /// `udelta` and `vdelta`.
    pub delta: [f64; 2],
}

impl Default for UvMapping {
    fn default() -> UvMapping {
        UvMapping {
            scale: [1.0; 2],
            delta: [0.0; 2],
        }
    }
}

impl UvMapping {
    /// s and t.
    pub fn apply(&self, uv: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| self.scale[axis] * uv[axis] + self.delta[axis])
    }

    pub(super) fn digest(&self, digester: &mut Digester) {
        digester.measures(&self.scale);
        digester.measures(&self.delta);
    }
}
