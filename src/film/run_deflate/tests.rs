//! Streams of runs and noise, by the decoder of another crate.

use super::*;
use flate2::read::ZlibDecoder;
use proptest::prelude::*;
use std::io::Read;

fn compressed(bytes: &[u8]) -> Vec<u8> {
    let mut out = Vec::new();
    compress(bytes, &mut out);
    out
}

#[track_caller]
fn assert_survives(bytes: &[u8]) {
    let (mut back, compressed) = (Vec::new(), compressed(bytes));
    let mut decoder = ZlibDecoder::new(&compressed[..]);
    decoder.read_to_end(&mut back).unwrap();
    assert!(back == bytes && decoder.total_in() == compressed.len() as u64);
}

/// Bytes without a pattern.
fn noise(length: usize) -> Vec<u8> {
    (0..length as u32)
        .map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8)
        .collect()
}

/// `noise`, then `length` bytes of one pattern, then `noise` again.
fn run_in_noise(before: usize, length: usize, after: usize) -> Vec<u8> {
    let pattern = (0..length).map(|i| [7, 9][i % 2]);
    noise(before)
        .into_iter()
        .chain(pattern)
        .chain(noise(after))
        .collect()
}

#[test]
fn runs_of_every_length_survive() {
    for length in 0..=1100 {
        assert_survives(&run_in_noise(0, length, 0));
        assert_survives(&run_in_noise(length % 37, length, length % 41));
    }
}

#[test]
fn noise_survives_and_takes_a_few_bytes_more() {
    for length in [
        0,
        1,
        2,
        3,
        9,
        10,
        1000,
        MAX_STORED - 1,
        MAX_STORED,
        MAX_STORED + 1,
        3 * MAX_STORED,
    ] {
        assert_survives(&noise(length));
        assert!(compressed(&noise(length)).len() <= length + 16 + length / 10_000);
    }
}

#[test]
fn no_long_run_is_missed() {
    for before in 0..40 {
        let bytes = run_in_noise(before, PERIOD + MIN_RUN + 1000, 40);
        assert_survives(&bytes);
        assert!(compressed(&bytes).len() < before + 40 + 60, "{before}");
    }
}

#[test]
fn every_length_has_its_symbol() {
    // The ends of the table in RFC 1951, 3.2.5.
    let known = [
        (3, 257, 0),
        (10, 264, 0),
        (11, 265, 0),
        (12, 265, 1),
        (13, 266, 0),
        (18, 268, 1),
        (19, 269, 0),
    ];
    let further = [
        (34, 272, 3),
        (35, 273, 0),
        (130, 280, 15),
        (131, 281, 0),
        (257, 284, 30),
        (258, 285, 0),
    ];
    for (length, symbol, extra) in known.into_iter().chain(further) {
        let (found, bits, found_extra) = length_symbol(length);
        assert_eq!((found, found_extra), (symbol, extra), "{length}");
        assert!(found_extra < 1 << bits || found_extra == 0);
    }
}

proptest! {
    #[test]
    fn any_bytes_survive(runs in prop::collection::vec((any::<[u8; 2]>(), 0usize..600), 0..20)) {
        let bytes: Vec<u8> =
            runs.iter().flat_map(|(pattern, length)| (0..*length).map(|i| pattern[i % 2])).collect();
        assert_survives(&bytes);
    }
}
