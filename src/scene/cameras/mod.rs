//! Cameras: the `Camera` directive, and lists of cameras in files of their own.

mod camera_directive;
mod lens_file;
mod list;
mod realistic;

pub(super) use camera_directive::CameraParameters;
pub use list::{Pose, calibrated_camera, parse_colmap, parse_poses, pose_files, read_poses};
