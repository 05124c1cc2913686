//! The error of the input: how far the roundings of rules R2 to R5 move hits. No ray test can
//! repair it.

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

/// Upper bounds of how far roundings from the file to rays and vertices (rules R2 to R5) move hits.
///
/// Every hit is a point of a ray and of a surface. Without roundings both points would be
/// elsewhere; the sum of the two bounds is the displacement: a length in the world, in any
/// direction. If a ray grazes the surface, its depth may change by more.
///
/// The numbers of the file count as they were read (R1), and the vertices of a subdivision surface
/// as they were refined (R6). Field names are JSON keys.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct InputError {
    /// The largest displacement of a hit, in units in the last place of its distance in `f32`.
    pub max_ulp: f64,
    /// The largest displacement of a hit, in pixels across the film.
    pub max_pixels: f64,
}

impl InputError {
    /// The largest bounds over `hits`, each with its pixel. `None` if the scene was read without
    /// its transform history, or without hits.
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

/// A displacement in units in the last place of `distance`; at a power of two, in the smaller units
/// below it.
fn in_ulps(displacement: f64, distance: f32) -> f64 {
    if !distance.is_finite() {
        return f64::INFINITY;
    }
    with_slack(displacement / (f64::from(distance) - f64::from(distance.next_down())))
}

#[cfg(test)]
mod tests;
