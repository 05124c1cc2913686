//! feimos: hit and depth images of PBRT scenes.

pub mod decimal;
pub mod error;
pub mod geometry;
pub mod scene;
