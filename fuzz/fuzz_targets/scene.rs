//! Any bytes as a scene: all directives, and the scene as far as it needs no other file.
#![no_main]

use feimos::scene::parser::Directives;
use feimos::scene::{LoadOptions, SourceFile, parse};
use libfuzzer_sys::{Corpus, fuzz_target};
use std::path::Path;

fuzz_target!(|bytes: &[u8]| -> Corpus {
    // An absolute name would be the only one of a file that exists.
    if bytes.windows(2).any(|pair| pair == b"\"/") {
        return Corpus::Reject;
    }
    let path = Path::new("/no such folder/fuzz.pbrt");
    Directives::new(&SourceFile::new(path, bytes.to_vec())).for_each(drop);
    let _ = parse(path, bytes.to_vec(), &LoadOptions::default());
    Corpus::Keep
});
