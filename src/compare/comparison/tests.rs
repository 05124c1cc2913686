//! Differences of small images.

use super::*;
use crate::film::{Channel, Samples};

fn image(channels: Vec<(ChannelName, Samples)>) -> Image {
    let width = channels[0].1.len() as u32;
    let channels = channels
        .into_iter()
        .map(|(name, samples)| Channel { name, samples })
        .collect();
    Image {
        display_window: (width, 1),
        data_window: PixelBounds::of_film(width, 1),
        channels,
    }
}

fn differences(expected: &Image, found: &Image) -> Vec<Difference> {
    let comparison = Comparison::new(expected, found).unwrap();
    (0..expected.data_window.width() as usize)
        .map(|pixel| comparison.difference(pixel))
        .collect()
}

#[test]
fn the_worst_difference_counts() {
    let next = 1f32.next_up();
    let expected = image(vec![
        (ChannelName::A, Samples::F32(vec![0.0, 0.0, 1.0, 1.0, 1.0])),
        (ChannelName::Prim, Samples::U32(vec![0, 0, 7, 7, 7])),
        (ChannelName::Z, Samples::F32(vec![9.0, 9.0, 1.0, 1.0, 1.0])),
        (ChannelName::T, Samples::F32(vec![9.0, 9.0, 1.0, 1.0, 1.0])),
    ]);
    let found = image(vec![
        (ChannelName::A, Samples::F32(vec![0.0, 1.0, 0.0, 1.0, 1.0])),
        (ChannelName::Prim, Samples::U32(vec![0, 7, 0, 8, 7])),
        (
            ChannelName::Z,
            Samples::F32(vec![5.0, 1.0, 9.0, next, next]),
        ),
        (
            ChannelName::T,
            Samples::F32(vec![5.0, 1.0, 9.0, 1.0, next.next_up()]),
        ),
    ]);
    use Difference::{Depth, FalseHit, MissedHit, None, WrongPrimitive};
    assert_eq!(
        differences(&expected, &found),
        [None, FalseHit, MissedHit, WrongPrimitive, Depth(2)]
    );
}

#[test]
fn surfaces_count_if_they_are_worse_than_depths() {
    let next = 1f32.next_up();
    let measures = |z: [f32; 4], normal: [f32; 4]| {
        let channel = |name, values: [f32; 4]| (name, Samples::F32(values.to_vec()));
        let a = channel(ChannelName::A, [0.0, 1.0, 1.0, 1.0]);
        image(vec![
            a,
            channel(ChannelName::Z, z),
            channel(ChannelName::Nx, normal),
        ])
    };
    let expected = measures([1.0; 4], [1.0; 4]);
    let found = measures(
        [1.0, 1.0, next, next.next_up()],
        [9.0, next, next.next_up(), next],
    );
    use Difference::{Depth, None, Surface};
    assert_eq!(
        differences(&expected, &found),
        [None, Surface(1), Surface(2), Depth(2)]
    );
    assert!(Surface(2).is_beyond(1) && !Surface(1).is_beyond(1));
}

#[test]
fn channels_of_one_image_alone_are_not_compared() {
    let depths = image(vec![(
        ChannelName::Z,
        Samples::F32(vec![f32::INFINITY, 1.0, f32::NAN, 2.0]),
    )]);
    let numbers = image(vec![(ChannelName::Id, Samples::U32(vec![0, 5, 1, 0]))]);
    use Difference::{FalseHit, MissedHit, None};
    assert_eq!(
        differences(&depths, &numbers),
        [None, None, FalseHit, MissedHit]
    );
    assert!(!Comparison::new(&depths, &numbers).unwrap().has_depths());
}

#[test]
fn images_of_other_pixels_units_or_without_hits_cannot_be_compared() {
    let one = image(vec![(ChannelName::A, Samples::F32(vec![0.0]))]);
    let two = image(vec![(ChannelName::A, Samples::F32(vec![0.0; 2]))]);
    assert!(matches!(
        Comparison::new(&one, &two),
        Err(Incomparable::Windows(..))
    ));
    let instances = image(vec![(ChannelName::Instance, Samples::U32(vec![0]))]);
    assert_eq!(
        Comparison::new(&one, &instances).unwrap_err(),
        Incomparable::NoHits
    );
    let depths = image(vec![(ChannelName::Z, Samples::F32(vec![1.0]))]);
    let steps = image(vec![(ChannelName::Z, Samples::U32(vec![1]))]);
    assert_eq!(
        Comparison::new(&depths, &steps).unwrap_err(),
        Incomparable::Units
    );
}

#[test]
fn integer_depths_differ_by_steps() {
    let steps = |z: [u32; 3]| {
        image(vec![
            (ChannelName::A, Samples::F32(vec![0.0, 1.0, 1.0])),
            (ChannelName::Z, Samples::U32(z.to_vec())),
        ])
    };
    use Difference::{Depth, None};
    let (expected, found) = (steps([0, 1000, 7]), steps([9, 1003, 7]));
    assert_eq!(differences(&expected, &found), [None, Depth(3), None]);
}
