//! How close it was.

use super::film_space::FilmSpace;
use crate::camera::Camera;
use crate::exact::Dyadic;
use crate::geometry::Ray;
use crate::shape::{Primitive, Triangle};

/// How far inside a surface a hit is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Margin {
    /// Of a triangle.
    Triangle {
        /// The barycentric coordinates, of the corners in their order: ratios of integers, each rounded once. The hit is exactly
        /// on an edge where one is 0, and on a corner where two are.
        barycentric: [f64; 3],
        /// Pixels on the film from the pixel's centre to the nearest edge, where the camera has a film.
        on_film: Option<f64>,
    },
    /// Of a sphere, a cylinder or a disk.
    Quadric {
        /// As [`crate::shape::Quadric::clearance`] tells it.
        clearance: Option<f64>,
    },
}

impl Margin {
    /// Of the hit of `ray`, through that pixel, on a surface that it hits.
    pub(super) fn new(camera: &Camera, pixel: [u32; 2], ray: &Ray, surface: &Primitive) -> Margin {
        match surface {
            Primitive::Triangle(triangle) => Margin::Triangle {
                barycentric: barycentric(triangle, ray),
                on_film: FilmSpace::new(camera, pixel).and_then(|film| film.distance(triangle)),
            },
            Primitive::Quadric(quadric) => Margin::Quadric {
                clearance: quadric.clearance(ray),
            },
        }
    }

    /// Whether the hit is exactly on the rim: an edge of a triangle, or where the ray touches.
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
    // What is not 0 is not told to be.
    let share = |edge: &Dyadic| match edge.quotient_to_f64(&sum).abs() {
        0.0 if !edge.is_zero() => f64::from_bits(1),
        share => share,
    };
    edges.each_ref().map(share)
}
