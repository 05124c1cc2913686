//! feimos: hit and depth images of PBRT scenes.

pub mod accel;
pub mod camera;
pub mod decimal;
pub mod error;
pub mod exact;
pub mod film;
pub mod geometry;
pub mod mesh;
pub mod progress;
pub mod render;
pub mod scene;
pub mod shape;
