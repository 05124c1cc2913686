//! Any bytes as an OpenEXR image.
#![no_main]

use feimos::film::exr_reader;
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(image) = exr_reader::decode(Path::new("fuzz.exr"), bytes) {
        assert_eq!(image.validate(), Ok(()));
    }
});
