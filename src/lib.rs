//! feimos: hit and depth images of PBRT scenes.

pub mod decimal;
pub mod error;
pub mod film;
pub mod geometry;
