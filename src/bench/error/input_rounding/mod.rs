//! How far rules R2 to R5 move what a picture sees: the error of its input, which no test of a ray can mend.

mod bound;
mod displacement;
#[cfg(test)]
mod high_precision;
mod rounded_transform;
mod roundings;
mod view;

use crate::reference::ReferenceHit;
use crate::scene::Scene;
use bound::with_slack;
use displacement::of_primitive;
use rayon::prelude::*;
use roundings::Roundings;
use serde::Serialize;
use view::View;

/// How far roundings on the way from the file to rays and vertices (rules R2 to R5) move what hits see, at most.
///
/// Every hit is a point of a ray and of a surface. Without a rounding the ray's point would be elsewhere, and so would the surface's: the
/// bounds of both ways, added up, are the displacement. It is a length in the world, in whatever direction. Where a ray grazes the
/// surface, its depth may change by more than that.
///
/// The numbers of the file count as they were read (R1), and the vertices of a subdivision surface as they were refined (R6).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct InputError {
    /// The largest displacement of a hit, in units in the last place of its distance `t` in `f32`.
    pub max_ulp: f64,
    /// The largest displacement of a hit, in pixels across the film.
    pub max_pixels: f64,
}

impl InputError {
    /// The largest of `hits`, which are those of the rays of some pixels. `None` if the scene was read without its transform
    /// history, or if there is no hit.
    pub fn of(scene: &Scene, hits: &[([u32; 2], ReferenceHit)]) -> Option<InputError> {
        let roundings = Roundings::of(scene.transform_history.as_ref()?);
        let view = View {
            camera: &scene.camera,
            rounded: roundings.camera(),
        };
        let errors = hits.par_iter().map(|(pixel, hit)| {
            let of_ray = view.displacement(*pixel, hit.z);
            let of_surface = of_primitive(&scene.geometry, &roundings, hit.primitive);
            let displacement = with_slack(of_ray + of_surface);
            InputError {
                max_ulp: in_ulps(displacement, hit.distance),
                max_pixels: view.in_pixels(displacement, *pixel, hit.z),
            }
        });
        errors.reduce_with(|a, b| InputError {
            max_ulp: a.max_ulp.max(b.max_ulp),
            max_pixels: a.max_pixels.max(b.max_pixels),
        })
    }
}

/// In units of the last place of `t`; at a power of two of those below it, which are smaller.
fn in_ulps(displacement: f64, t: f32) -> f64 {
    if t.is_finite() {
        with_slack(displacement / (f64::from(t) - f64::from(t.next_down())))
    } else {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests;
