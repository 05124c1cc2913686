//! Any bytes as a list of cameras.
#![no_main]

use feimos::scene::{LoadOptions, parse, parse_poses};
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|bytes: &[u8]| {
    let Ok(poses) = parse_poses(Path::new("fuzz.json"), bytes) else {
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
        assert!(camera.world_from_camera.is_finite() && !film.crop.is_empty());
    }
});
