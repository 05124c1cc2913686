//! Known faults, put into an image: the comparison finds these, and no other.

mod common;

use assert_cmd::cargo::cargo_bin;
use common::{cases, picture, scene, whole};
use feimos::accel::{BuildOptions, Precision, SplitMethod};
use feimos::compare::picture::{FALSE_HIT, MISSED_HIT, WRONG_PRIMITIVE};
use feimos::compare::{Comparison, Details, Difference, difference_picture};
use feimos::film::{ChannelName, Image, Metadata, Samples, exr_file, exr_reader};
use feimos::progress::Progress;
use proptest::prelude::*;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::Path;
use std::sync::LazyLock;

/// A fault of a pixel that is hit, or of one that is missed.
#[derive(Debug, Clone, Copy)]
enum Fault {
    /// Hits become misses and misses hits.
    Flip,
    /// A depth is so many steps further, or nearer.
    Shift {
        channel: ChannelName,
        ulps: u32,
        is_nearer: bool,
    },
    /// A number is another one.
    Swap { channel: ChannelName, add: u32 },
}

fn fault() -> impl Strategy<Value = Fault> {
    let depth = prop::sample::select(vec![ChannelName::Z, ChannelName::T]);
    let number = prop::sample::select(vec![
        ChannelName::Id,
        ChannelName::Prim,
        ChannelName::Instance,
    ]);
    let ulps = prop_oneof![4 => 1u32..5, 1 => 1u32..1_000_000];
    prop_oneof![
        Just(Fault::Flip),
        (depth, ulps, any::<bool>()).prop_map(|(channel, ulps, is_nearer)| Fault::Shift {
            channel,
            ulps,
            is_nearer
        }),
        (number, 1u32..u32::MAX).prop_map(|(channel, add)| Fault::Swap { channel, add }),
    ]
}

/// A small picture with hits and misses, every channel of it.
static PICTURE: LazyLock<Image> = LazyLock::new(|| {
    let scene = scene(Path::new("tests/hard/g05_touching_spheres.pbrt"));
    let options = BuildOptions::new(SplitMethod::Sah);
    picture(
        &scene.camera,
        &scene.geometry,
        options,
        Precision::Exact,
        1,
        whole(&scene.camera),
    )
    .image
});

fn measures(image: &mut Image, name: ChannelName) -> &mut Vec<f32> {
    let channel = image
        .channels
        .iter_mut()
        .find(|channel| channel.name == name)
        .unwrap();
    match &mut channel.samples {
        Samples::F32(values) => values,
        Samples::U32(_) => panic!("{name:?} holds measures"),
    }
}

fn numbers(image: &mut Image, name: ChannelName) -> &mut Vec<u32> {
    let channel = image
        .channels
        .iter_mut()
        .find(|channel| channel.name == name)
        .unwrap();
    match &mut channel.samples {
        Samples::U32(values) => values,
        Samples::F32(_) => panic!("{name:?} holds numbers"),
    }
}

/// Puts a fault into a pixel; returns the difference it makes.
fn put(image: &mut Image, pixel: usize, fault: Fault) -> Difference {
    let is_hit = image.measures(ChannelName::A).unwrap()[pixel] != 0.0;
    match fault {
        Fault::Flip => {
            let (a, z) = if is_hit {
                (0.0, f32::INFINITY)
            } else {
                (1.0, 3.5)
            };
            measures(image, ChannelName::A)[pixel] = a;
            measures(image, ChannelName::Z)[pixel] = z;
            numbers(image, ChannelName::Prim)[pixel] = u32::from(!is_hit);
            if is_hit {
                Difference::MissedHit
            } else {
                Difference::FalseHit
            }
        }
        // What a miss holds is of no account.
        Fault::Shift {
            channel,
            ulps,
            is_nearer,
        } => {
            let depth = &mut measures(image, channel)[pixel];
            let bits = depth.to_bits();
            *depth = f32::from_bits(if is_nearer { bits - ulps } else { bits + ulps });
            if is_hit {
                Difference::Depth(ulps)
            } else {
                Difference::None
            }
        }
        Fault::Swap { channel, add } => {
            let number = &mut numbers(image, channel)[pixel];
            *number = number.wrapping_add(add);
            if is_hit {
                Difference::WrongPrimitive
            } else {
                Difference::None
            }
        }
    }
}

fn through_a_file(image: &Image) -> (Vec<u8>, Image) {
    let mut file = Cursor::new(Vec::new());
    exr_file::write(image, &Metadata::default(), &mut file, Progress::SILENT).unwrap();
    let read = exr_reader::decode(Path::new("b.exr"), file.get_ref()).unwrap();
    (file.into_inner(), read)
}

/// The image with a fault in each of some pixels, and what is different.
fn faulty(faults: &BTreeMap<usize, Fault>) -> (Image, BTreeMap<usize, Difference>) {
    let mut image = PICTURE.clone();
    let differences: BTreeMap<usize, Difference> = faults
        .iter()
        .map(|(pixel, fault)| (*pixel, put(&mut image, *pixel, *fault)))
        .collect();
    (
        image,
        differences
            .into_iter()
            .filter(|(_, difference)| *difference != Difference::None)
            .collect(),
    )
}

fn faults() -> impl Strategy<Value = BTreeMap<usize, Fault>> {
    let area = PICTURE.data_window.area() as usize;
    prop::collection::btree_map(0..area, fault(), 0..40)
}

/// How many of the differences are of this kind.
fn count(differences: &BTreeMap<usize, Difference>, is_kind: impl Fn(Difference) -> bool) -> u64 {
    differences
        .values()
        .filter(|difference| is_kind(**difference))
        .count() as u64
}

/// The error that `percent` of the depths compared do not exceed, by the sorted list of all.
fn percentile(mut errors: Vec<u32>, percent: f64) -> Option<u32> {
    errors.sort();
    let rank = (errors.len() as f64 * percent / 100.0).ceil() as usize;
    errors.get(rank.max(1) - 1).copied()
}

/// The errors of all depths of a channel that are compared.
fn errors_of(channel: ChannelName, faults: &BTreeMap<usize, Fault>) -> Vec<u32> {
    let a = PICTURE.measures(ChannelName::A).unwrap();
    let error = |pixel: usize| match faults.get(&pixel) {
        Some(Fault::Flip | Fault::Swap { .. }) => None,
        Some(Fault::Shift {
            channel: shifted,
            ulps,
            ..
        }) if *shifted == channel => Some(*ulps),
        _ => Some(0),
    };
    (0..a.len())
        .filter(|pixel| a[*pixel] != 0.0)
        .filter_map(error)
        .collect()
}

proptest! {
    #![proptest_config(cases(128))]

    #[test]
    fn the_library_finds_exactly_what_is_wrong(faults in faults(), max_ulp in 0u32..6) {
        let (image, expected) = faulty(&faults);
        let (_, found) = through_a_file(&image);
        let comparison = Comparison::new(&PICTURE, &found).unwrap();
        let pixels = PICTURE.data_window.area() as usize;
        for pixel in 0..pixels {
            let difference = expected.get(&pixel).copied().unwrap_or(Difference::None);
            prop_assert_eq!(comparison.difference(pixel), difference, "{}", pixel);
        }
        let details = Details::of(&comparison, pixels, max_ulp, pixels);
        let beyond = expected.iter().filter(|(_, difference)| difference.is_beyond(max_ulp));
        let beyond: Vec<usize> = beyond.map(|(pixel, _)| *pixel).collect();
        prop_assert_eq!(&details.first, &beyond);
        prop_assert_eq!(details.tally.different(max_ulp), details.first.len() as u64);
        let count = |wanted| count(&expected, |kind| kind == wanted);
        prop_assert_eq!(details.tally.false_hits, count(Difference::FalseHit));
        prop_assert_eq!(details.tally.missed_hits, count(Difference::MissedHit));
        prop_assert_eq!(details.tally.wrong_primitives, count(Difference::WrongPrimitive));
        for (channel, ulps) in &details.measures {
            let errors = errors_of(*channel, &faults);
            prop_assert_eq!(ulps.total(), errors.len() as u64);
            for percent in [50.0, 99.0, 99.9, 100.0] {
                prop_assert_eq!(ulps.percentile(percent), percentile(errors.clone(), percent));
            }
        }
        let largest = details.tally.depths.max().unwrap_or(0);
        let colors = difference_picture(&comparison, pixels, largest);
        let of_color =
            |color: [u8; 3]| colors.iter().filter(|other| **other == color).count() as u64;
        prop_assert_eq!(of_color(FALSE_HIT), details.tally.false_hits);
        prop_assert_eq!(of_color(MISSED_HIT), details.tally.missed_hits);
        prop_assert_eq!(of_color(WRONG_PRIMITIVE), details.tally.wrong_primitives);
    }
}

proptest! {
    #![proptest_config(cases(12))]

    #[test]
    fn the_program_finds_exactly_what_is_wrong(faults in faults(), max_ulp in 0u32..6) {
        let (image, expected) = faulty(&faults);
        let folder = tempfile::tempdir().unwrap();
        for (name, image) in [("a.exr", &*PICTURE), ("b.exr", &image)] {
            std::fs::write(folder.path().join(name), through_a_file(image).0).unwrap();
        }
        let mut command = std::process::Command::new(cargo_bin!("feimos"));
        command.current_dir(folder.path()).args(["compare", "a.exr", "b.exr"]);
        command.args(["--json", "-v", "--max-ulp"]);
        let output = command.arg(max_ulp.to_string()).output().unwrap();
        let found: Value = serde_json::from_slice(&output.stdout).unwrap();
        let beyond = expected.iter().filter(|(_, difference)| difference.is_beyond(max_ulp));
        let beyond: Vec<_> = beyond.collect();
        prop_assert_eq!(output.status.code(), Some(i32::from(!beyond.is_empty())));
        prop_assert_eq!(&found["different"], beyond.len());
        let width = PICTURE.data_window.width() as usize;
        let listed = found["first"].as_array().unwrap();
        prop_assert_eq!(listed.len(), beyond.len());
        for (pixel, (place, difference)) in listed.iter().zip(beyond) {
            let place = [json!(place % width), json!(place / width)];
            prop_assert_eq!([&pixel["x"], &pixel["y"]], [&place[0], &place[1]]);
            let (kind, ulps) = match difference {
                Difference::FalseHit => ("false hit", None),
                Difference::MissedHit => ("missed hit", None),
                Difference::WrongPrimitive => ("wrong primitive", None),
                Difference::Depth(ulps) => ("wrong depth", Some(*ulps)),
                Difference::Surface(_) => panic!("no such fault is put in"),
                Difference::None => panic!("listed"),
            };
            prop_assert_eq!((&pixel["kind"], &pixel["ulps"]), (&json!(kind), &json!(ulps)));
        }
        for (channel, name) in [(ChannelName::Z, "Z"), (ChannelName::T, "t")] {
            let errors = errors_of(channel, &faults);
            prop_assert_eq!(&found["ulps"][name]["compared"], errors.len());
            prop_assert_eq!(&found["ulps"][name]["largest"], &json!(errors.iter().max()));
            prop_assert_eq!(&found["ulps"][name]["p99"], &json!(percentile(errors.clone(), 99.0)));
            let above = errors.iter().filter(|error| **error > max_ulp).count();
            prop_assert_eq!(&found["ulps"][name]["above"], above);
        }
    }
}
