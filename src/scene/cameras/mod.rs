//! Cameras: the `Camera` directive, and lists of cameras in files of their own.

mod camera_directive;
mod intrinsics;
mod json;
mod lens_file;
mod poses;
mod realistic;
mod scalar;
#[cfg(test)]
mod tests;

pub(super) use camera_directive::CameraParameters;
pub use poses::{Pose, parse_poses, read_poses};
