//! Stores the samples of channels pixel by pixel.

/// Stores `values`, each as `bytes_of` has it, at `place` of the `count` samples of successive
/// pixels.
pub(super) fn interleave<T: Copy>(
    pixels: &mut [u8],
    [place, count]: [usize; 2],
    values: &[T],
    bytes_of: impl Fn(T) -> [u8; 4],
) {
    let samples = pixels.as_chunks_mut().0;
    if count == 1 {
        let pairs = samples.iter_mut().zip(values);
        pairs.for_each(|(sample, value)| *sample = bytes_of(*value));
        return;
    }
    let samples = samples.iter_mut().skip(place).step_by(count);
    for (sample, value) in samples.zip(values) {
        *sample = bytes_of(*value);
    }
}
