//! Streams, compared with those of the crate whose code this is.

use super::*;
use png::{BitDepth, ColorType, Compression, Encoder, Filter};
use proptest::prelude::*;

/// The zlib stream in a file of the crate `png`, whose fast compression is `fdeflate`.
fn expected(row_bytes: usize, bytes: &[u8]) -> Vec<u8> {
    let mut file = Vec::new();
    let height = bytes.len() / row_bytes;
    let mut encoder = Encoder::new(&mut file, row_bytes as u32, height as u32);
    encoder.set_color(ColorType::Grayscale);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    encoder.set_filter(Filter::Up);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(bytes).unwrap();
    writer.finish().unwrap();
    let mark = file.windows(4).position(|word| word == b"IDAT").unwrap();
    let length = u32::from_be_bytes(file[mark - 4..mark].try_into().unwrap());
    file[mark + 4..][..length as usize].to_vec()
}

fn compressed(row_bytes: usize, bytes: &[u8]) -> Option<Vec<u8>> {
    let fill = |y: usize, row: &mut [u8]| {
        row.copy_from_slice(&bytes[y * row_bytes..][..row_bytes]);
    };
    compress(bytes.len() / row_bytes, row_bytes, &fill, Progress::SILENT).unwrap()
}

/// Compares both streams, on several numbers of threads.
#[track_caller]
fn check(row_bytes: usize, bytes: &[u8]) {
    let expected = expected(row_bytes, bytes);
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().unwrap();
        let found = pool.install(|| compressed(row_bytes, bytes));
        match found {
            Some(found) => assert!(found == expected, "{row_bytes} bytes a row"),
            // Stored: the first block has neither a code nor filtered rows.
            None => assert!(expected[2] & 0b110 == 0, "{row_bytes} bytes a row"),
        }
    }
}

/// Rows whose differences are runs of zeros and other bytes, of many lengths.
fn rows_of_runs(row_bytes: usize, height: usize) -> Vec<u8> {
    let mut bytes = vec![0; row_bytes * height];
    let mut place = 0;
    for step in 0.. {
        place += step * 7 % 61;
        for _ in 0..step % 5 {
            if place >= bytes.len() {
                return bytes;
            }
            bytes[place] = (step * 37) as u8;
            place += 1;
        }
    }
    bytes
}

#[test]
fn runs_of_every_length_and_place_are_the_same() {
    for length in (0..40).chain([
        255, 256, 257, 258, 259, 260, 263, 264, 265, 517, 518, 520, 900,
    ]) {
        for before in [0, 1, 2, 7, 8, 9] {
            for after in [0, 1, 8, 13] {
                let row = [vec![5; before], vec![0; length], vec![9; after]].concat();
                if !row.is_empty() {
                    check(row.len(), &row);
                }
            }
        }
    }
}

#[test]
fn many_bands_are_the_same() {
    for (row_bytes, height) in [(1, 3), (100, 1), (1921, 700), (5760, 333)] {
        check(row_bytes, &rows_of_runs(row_bytes, height));
    }
}

#[test]
fn rows_that_take_more_than_stored_ones_are_refused() {
    let mut state = 1u32;
    let noise = |_| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 24) as u8
    };
    let bytes: Vec<u8> = (0..40_000).map(noise).collect();
    assert_eq!(compressed(200, &bytes), None);
    for height in 1..5 {
        check(200, &bytes[..200 * height]);
    }
    check(200, &bytes);
}

proptest! {
    #[test]
    fn any_rows_are_the_same(
        row_bytes in 1usize..70,
        runs in prop::collection::vec((any::<u8>(), 0usize..90), 1..40),
    ) {
        let mut bytes: Vec<u8> =
            runs.iter().flat_map(|(byte, length)| std::iter::repeat_n(*byte, *length)).collect();
        bytes.resize(bytes.len().next_multiple_of(row_bytes).max(row_bytes), 7);
        check(row_bytes, &bytes);
    }
}
