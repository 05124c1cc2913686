//! Text in pieces: whole, in order, with all errors.

use super::*;
use std::io::Write;

fn gzip(text: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    encoder.write_all(text).expect("memory");
    encoder.finish().expect("memory")
}

/// The text of the file `path` in pieces of `size` bytes, and the length of each.
fn read(path: &Path, size: usize) -> Result<(Vec<u8>, Vec<usize>)> {
    let budget = Budget::default();
    let mut stream = TextStream::open_named(path, &budget)?;
    let (mut text, mut lengths) = (Vec::new(), Vec::new());
    loop {
        let before = text.len();
        let goes_on = stream.read(&mut text, size, &budget)?;
        lengths.push(text.len() - before);
        if !goes_on {
            return Ok((text, lengths));
        }
    }
}

#[test]
fn pieces_make_up_the_text_with_and_without_threads() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a");
    let text: Vec<u8> = (0..3_000_000).map(|at: u32| (at ^ at >> 9) as u8).collect();
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(2)
        .build()
        .expect("a pool");
    for bytes in [text.clone(), gzip(&text)] {
        fs::write(&path, bytes).expect("room for it");
        for size in [999, 1 << 18, 1_500_000, 5_000_000] {
            let (here, lengths) = read(&path, size).expect("text");
            assert!(here == text);
            let whole = &lengths[..lengths.len() - 1];
            assert!(whole.iter().all(|length| *length == size));
            assert!(pool.install(|| read(&path, size)) == Ok((here, lengths)));
        }
    }
}

#[test]
fn a_file_that_shrinks_ends_early() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a");
    fs::write(&path, vec![b'a'; 3 * PIECE]).expect("room for it");
    let budget = Budget::default();
    let mut stream = TextStream::open_named(&path, &budget).expect("a file");
    let mut text = Vec::new();
    assert_eq!(stream.read(&mut text, PIECE, &budget), Ok(true));
    let file = File::options().write(true).open(&path).expect("a file");
    file.set_len(PIECE as u64 + 7).expect("a shorter file");
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(2)
        .build()
        .expect("a pool");
    let rest = pool.install(|| stream.read(&mut text, 2 * PIECE, &budget));
    assert_eq!((rest, text.len()), (Ok(false), PIECE + 7));
}

#[test]
fn damage_is_found_behind_what_is_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a");
    let mut bytes = gzip(&b"one or two ".repeat(100_000));
    let checksum = bytes.len() - 8;
    bytes[checksum] ^= 1;
    fs::write(&path, bytes).expect("room for it");
    let budget = Budget::default();
    let mut stream = TextStream::open_named(&path, &budget).expect("a file");
    let mut text = Vec::new();
    assert_eq!(stream.read(&mut text, 10, &budget), Ok(true));
    let error = stream.check_rest(&budget).unwrap_err().to_string();
    assert!(
        error.contains("the gzip data are damaged or cut off"),
        "{error}"
    );
}
