//! Any bytes as a PNG image: its depths, and the texts in its header.
#![no_main]

use feimos::film::{ChannelName, png_reader};
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(image) = png_reader::decode(Path::new("fuzz.png"), bytes) {
        let depths = image.numbers(ChannelName::Z).expect("depths");
        assert_eq!(depths.len() as u64, image.data_window.area());
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("fuzz.png");
    std::fs::write(&path, bytes).expect("room");
    let _ = png_reader::read_text(&path, "feimos");
});
