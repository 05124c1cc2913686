//! Peers as whole programs: from a scene file to depths in an array.

mod embree;
mod loader;
mod npy;
mod report;
mod zbuffer;

pub(crate) use embree::run as run_embree;
pub(crate) use loader::Pose;
pub(crate) use report::{Agreement, Report};
pub(crate) use zbuffer::run as run_zbuffer;
