//! The margin of a hit: how far it is from a miss.

use super::film_space::FilmSpace;
use crate::camera::Camera;
use crate::exact::Dyadic;
use crate::geometry::Ray;
use crate::shape::{Primitive, Triangle};

/// How far inside a primitive a hit is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Margin {
    /// In a triangle.
    Triangle {
        /// The barycentric coordinates, in the order of the corners: ratios of integers, each
        /// rounded once. If one is 0 the hit is exactly on an edge, if two are on a corner.
        barycentric: [f64; 3],
        /// Distance on the film from the pixel's centre to the nearest edge, in pixels.
        on_film: Option<f64>,
    },
    /// On a quadric, or on a curve, which has no clearance.
    Quadric {
        /// [`crate::shape::Quadric::clearance`].
        clearance: Option<f64>,
    },
}

impl Margin {
    /// The margin of the hit of `ray`, through this pixel, on `surface`.
    pub(super) fn new(camera: &Camera, pixel: [u32; 2], ray: &Ray, surface: &Primitive) -> Margin {
        match surface {
            Primitive::Triangle(triangle) => Margin::Triangle {
                barycentric: barycentric(triangle, ray),
                on_film: FilmSpace::new(camera, pixel).and_then(|film| film.distance(triangle)),
            },
            Primitive::Quadric(quadric) => {
                let clearance = quadric.clearance(ray);
                Margin::Quadric { clearance }
            }
            Primitive::Segment(_) => Margin::Quadric { clearance: None },
        }
    }

    /// Returns true if the hit is exactly on the rim: on an edge of a triangle, or where the ray
    /// touches a quadric.
    pub fn is_on_rim(&self) -> bool {
        match self {
            Margin::Triangle { barycentric, .. } => barycentric.contains(&0.0),
            Margin::Quadric { clearance } => *clearance == Some(0.0),
        }
    }
}

fn barycentric(triangle: &Triangle, ray: &Ray) -> [f64; 3] {
    let edges = triangle.exact_edges(ray);
    let sum = &(&edges[0] + &edges[1]) + &edges[2];
    // A coordinate that is not 0 is not rounded to 0.
    let share = |edge: &Dyadic| match edge.quotient_to_f64(&sum).abs() {
        0.0 if !edge.is_zero() => f64::from_bits(1),
        share => share,
    };
    edges.each_ref().map(share)
}
