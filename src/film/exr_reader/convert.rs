//! Converts samples of a file to those of an image.

use crate::film::Samples;
use exr::meta::attribute::SampleType;
use exr::prelude::f16;

/// A sample that the channel's type cannot hold.
pub(super) struct Wrong {
    /// The place of the sample in its row.
    pub(super) place: usize,
    pub(super) value: String,
    pub(super) expected: &'static str,
}

/// Converts samples of one type, in native byte order, into the channel from place `start` on.
pub(super) fn put(
    from: SampleType,
    bytes: &[u8],
    samples: &mut Samples,
    start: usize,
) -> Result<(), Wrong> {
    match (samples, from) {
        (Samples::F32(to), SampleType::F32) => convert(bytes, &mut to[start..], |bytes| {
            Ok(f32::from_ne_bytes(bytes))
        }),
        (Samples::F32(to), SampleType::F16) => convert(bytes, &mut to[start..], |bytes| {
            Ok(f16::from_ne_bytes(bytes).to_f32())
        }),
        (Samples::F32(to), SampleType::U32) => convert(bytes, &mut to[start..], |bytes| {
            measure(u32::from_ne_bytes(bytes))
        }),
        (Samples::U32(to), SampleType::U32) => convert(bytes, &mut to[start..], |bytes| {
            Ok(u32::from_ne_bytes(bytes))
        }),
        (Samples::U32(to), SampleType::F32) => convert(bytes, &mut to[start..], |bytes| {
            number(f32::from_ne_bytes(bytes))
        }),
        (Samples::U32(to), SampleType::F16) => convert(bytes, &mut to[start..], |bytes| {
            number(f16::from_ne_bytes(bytes).to_f32())
        }),
    }
}

/// A value that does not fit: the value, and what was expected.
type Unfit = (String, &'static str);

fn convert<const N: usize, T>(
    bytes: &[u8],
    to: &mut [T],
    one: impl Fn([u8; N]) -> Result<T, Unfit>,
) -> Result<(), Wrong> {
    for (place, (bytes, to)) in bytes.as_chunks().0.iter().zip(to).enumerate() {
        *to = one(*bytes).map_err(|(value, expected)| Wrong {
            place,
            value,
            expected,
        })?;
    }
    Ok(())
}

fn number(value: f32) -> Result<u32, Unfit> {
    // A cast turns NaN into 0 and clamps values that are out of range.
    let number = value as u32;
    let is_same = number as f32 == value && value < u32::MAX as f32;
    if is_same {
        Ok(number)
    } else {
        Err((value.to_string(), "a whole number from 0 to 4294967295"))
    }
}

fn measure(number: u32) -> Result<f32, Unfit> {
    let value = number as f32;
    // The largest `u32` values round to 2^32, which is not a `u32`.
    let is_same = value < u32::MAX as f32 && value as u32 == number;
    if is_same {
        Ok(value)
    } else {
        Err((number.to_string(), "a number that an f32 can hold"))
    }
}
