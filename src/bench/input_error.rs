//! How far the rounding of transforms moves what is seen.

/// Bounds over all hits.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct InputError {
    /// In units of the last place of the distance.
    pub max_ulp: f64,
    /// In pixels across the film.
    pub max_pixels: f64,
}

impl InputError {
    /// Of the surfaces and the rays that meet in these pixels.
    pub fn of(
        _scene: &crate::scene::Scene,
        _hits: &[([u32; 2], crate::reference::ReferenceHit)],
    ) -> Option<InputError> {
        None
    }
}
