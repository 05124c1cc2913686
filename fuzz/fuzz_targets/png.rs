//! Any bytes as a PNG image: its colours, and the words in its header.
#![no_main]

use feimos::film::png_reader;
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(picture) = png_reader::decode(Path::new("fuzz.png"), bytes) {
        assert_eq!(
            picture.pixels.len() as u64,
            u64::from(picture.width) * u64::from(picture.height)
        );
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("fuzz.png");
    std::fs::write(&path, bytes).expect("room");
    let _ = png_reader::read_text(&path, "feimos");
});
