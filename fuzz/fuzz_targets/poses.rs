//! Any bytes as a list of cameras: JSON, or the two files of a COLMAP model with a NUL between.
#![no_main]

use feimos::scene::{LoadOptions, Pose, parse, parse_colmap, parse_poses};
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fn poses(bytes: &[u8]) -> Option<Vec<Pose>> {
    let Some(end) = bytes.iter().position(|byte| *byte == 0) else {
        return parse_poses(Path::new("fuzz.json"), bytes).ok();
    };
    let cameras = (Path::new("cameras.txt"), &bytes[..end]);
    let images = (Path::new("images.txt"), &bytes[end + 1..]);
    parse_colmap(cameras, images).ok()
}

fuzz_target!(|bytes: &[u8]| {
    let Some(poses) = poses(bytes) else {
        return;
    };
    let scene = parse(
        Path::new("fuzz.pbrt"),
        b"WorldBegin".to_vec(),
        &LoadOptions::default(),
    )
    .unwrap();
    for pose in poses {
        let (camera, film) = pose.place(&scene);
        assert_eq!(camera.resolution, film.resolution);
        let _ = camera.ray(0, 0);
        assert!(camera.world_from_camera.is_finite() && !film.crop.is_empty());
    }
});
